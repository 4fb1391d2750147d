// What the filters of a volume know of a pixel: how far one sees through it. Normals and ids of surfaces say nothing of it.
// Twin: src/reference/volume.rs.
#ifndef VOLUME_GLSL
#define VOLUME_GLSL
#include "guide.glsl"

// Where nothing is hit: beyond every surface, and finite.
const float VOLUME_FAR = 1e30;

float sight(float depth) { return depth == 0.0 ? VOLUME_FAR : min(depth, VOLUME_FAR); }

float volume_depth(GuideBits packed) { return sight(guide_depth(packed)); }

// Pixels of the previous frame.
vec2 unpack_volume_motion(uint packed) { return unpackHalf2x16(packed); }

// Difference of two depths as a share of the larger one: 0 to 1.
float relative_difference(float z, float z_tap) { return abs(z - z_tap) / max(z, z_tap); }

#endif
