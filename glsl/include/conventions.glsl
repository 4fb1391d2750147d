// The host's conventions, known when the pipeline is made, so that code for other ones vanishes. Bits: Flags in src/frame_constants.rs.
#ifndef CONVENTIONS_GLSL
#define CONVENTIONS_GLSL

layout(constant_id = 30) const uint CONVENTIONS = 0u;

const uint DEPTH_SHIFT = 1u;
const uint NORMAL_SHIFT = 3u;
const uint NORMAL_VIEW = 1u << 5;
const uint MOTION_UNIT_SHIFT = 6u;
const uint MOTION_NEGATED = 1u << 8;
const uint MOTION_Y_UP = 1u << 9;
const uint MOTION_JITTERED = 1u << 10;
const uint MOTION_DEPTH_SHIFT = 11u;
const uint VIEW_POSITIVE_Z = 1u << 13;
const uint ROUGHNESS_ALPHA = 1u << 14;
const uint ROUGHNESS_CHANNEL_SHIFT = 17u;
const uint DEMODULATED = 1u << 19;

bool has_convention(uint flag) { return (CONVENTIONS & flag) != 0u; }

// One of the choices that take two bits.
uint convention(uint shift) { return CONVENTIONS >> shift & 3u; }

// View-space z of unit linear depth.
float forward_sign() { return has_convention(VIEW_POSITIVE_Z) ? 1.0 : -1.0; }

#endif
