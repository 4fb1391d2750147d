// Packing of the per-pixel features that steer the filters. Bits: docs/specification/packed_images.md. Twin: src/reference/guide.rs.
#ifndef GUIDE_GLSL
#define GUIDE_GLSL

// A texel of an image of guides, as it is stored. A type of its own, so that no unpacker takes another image for one.
struct GuideBits {
    uvec4 bits;
};

struct Guide {
    float linear_depth;  // scene units; 0: background
    bool is_apart;       // takes no light from surfaces that are not: the albedo is dark or unknown
    vec3 normal;         // world space
    vec2 gradient;       // of the depth, scene units per pixel
    uint id8;            // folded surface_id
};

uint half_bits(float x) { return packHalf2x16(vec2(x, 0.0)) & 0xffffu; }
float half_value(uint bits) { return unpackHalf2x16(bits).x; }

vec2 sign_not_zero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

vec2 octahedral(vec3 n) {
    vec2 e = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z < 0.0 ? (1.0 - abs(e.yx)) * sign_not_zero(e) : e;
}

// Of any length but 0. Where z is negative, x and y move towards 0 by as much.
vec3 octahedral_direction(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float folded = max(-n.z, 0.0);
    return vec3(n.x + (n.x >= 0.0 ? -folded : folded), n.y + (n.y >= 0.0 ? -folded : folded), n.z);
}

vec3 from_octahedral(vec2 e) { return normalize(octahedral_direction(e)); }

// An even number of steps, so that 0 and thereby the axes are exact.
uint pack_octahedral(vec3 n, float half_steps, uint bits) {
    uvec2 u = uvec2(floor(octahedral(n) * half_steps + (half_steps + 0.5)));
    return u.x | u.y << bits;
}

vec3 unpack_octahedral(uint packed, float half_steps, uint bits) {
    uint mask = (1u << bits) - 1u;
    return from_octahedral(vec2(packed & mask, packed >> bits & mask) / half_steps - 1.0);
}

uint pcg(uint v) {
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return word >> 22 ^ word;
}

// 8 bits of a surface id: exact up to 255, folded above; 0 stays the background.
uint fold_id(uint id) { return id <= 255u ? id : 1u + pcg(id) % 255u; }

// Steps from 0 to 1 of a component of the normal. An even number of them from -1 to 1, so that 0 and thereby the axes are exact.
const float NORMAL_STEPS = 127.0;

// The depth is a float of this exponent less, so that its two upper bits are free, between the least and the largest of these.
const uint DEPTH_EXPONENT = 96u << 23;
const float DEPTH_SCALE = 79228162514264337593543950336.0;
const float LEAST_GUIDE_DEPTH = 1.0 / 1073741824.0;
const float LARGEST_GUIDE_DEPTH = 4294967296.0;
const uint DEPTH_BITS = 0x1ffff800u;
const uint APART_BIT = 0x80000000u;

// The gradient of depth takes what the depth leaves, as a direction on a diamond, for which axes are exact, and the sum of its components over
// the depth: taps on the plane of a surface ask how the two relate, more than how large they are.
const float DIRECTIONS = 128.0;
// Code 1 is 2^-14, and one step is a quarter of a power of 2.
const uint LEAST_SLOPE = 451u;

uint pack_gradient(vec2 gradient, float linear_depth) {
    float sum = abs(gradient.x) + abs(gradient.y);
    vec2 direction = gradient / max(sum, 1e-37);
    float turn = direction.y >= 0.0 ? 1.0 - direction.x : 3.0 + direction.x;
    uint slope = clamp(floatBitsToUint(sum / linear_depth) + 0x100000u >> 21, LEAST_SLOPE, LEAST_SLOPE + 63u) - LEAST_SLOPE;
    return slope == 0u ? 0u : slope << 7 | uint(floor(turn * (DIRECTIONS / 4.0) + 0.5)) & 127u;
}

vec2 unpack_gradient(uint code, float linear_depth) {
    float turn = float(code & 127u) * (4.0 / DIRECTIONS);
    vec2 direction = vec2(abs(2.0 - turn) - 1.0, turn <= 2.0 ? 1.0 - abs(turn - 1.0) : abs(turn - 3.0) - 1.0);
    uint slope = code >> 7;
    return slope == 0u ? vec2(0.0) : direction * (uintBitsToFloat(slope + LEAST_SLOPE << 21) * linear_depth);
}

float guide_depth_of(float linear_depth) { return clamp(linear_depth, LEAST_GUIDE_DEPTH, LARGEST_GUIDE_DEPTH); }

// `gradient`: its code.
GuideBits pack_guide(Guide g, uint gradient) {
    float linear_depth = guide_depth_of(g.linear_depth);
    uint depth = floatBitsToUint(linear_depth) - DEPTH_EXPONENT + 0x400u & DEPTH_BITS | (g.is_apart ? APART_BIT : 0u);
    uint word = depth | gradient & 0x7ffu | gradient >> 11 << 29;
    uvec3 n = uvec3(floor(g.normal * NORMAL_STEPS + (NORMAL_STEPS + 0.5)));
    return GuideBits(uvec4(word & 0xffffu, word >> 16, n.x | n.y << 8, n.z | g.id8 << 8));
}

GuideBits pack_guide(Guide g) { return pack_guide(g, pack_gradient(g.gradient, guide_depth_of(g.linear_depth))); }

uint guide_word(GuideBits packed) { return packed.bits.x | packed.bits.y << 16; }
// Negative where light is kept apart, 0 in the background; else of a size that says nothing.
float guide_side(GuideBits packed) { return uintBitsToFloat(guide_word(packed) & (DEPTH_BITS | APART_BIT)); }
float signed_guide_depth(GuideBits packed) { return guide_side(packed) * DEPTH_SCALE; }
float guide_depth(GuideBits packed) { return abs(signed_guide_depth(packed)); }
// Scene units per pixel.
vec2 guide_gradient(GuideBits packed) {
    uint word = guide_word(packed);
    return unpack_gradient(word & 0x7ffu | (word >> 29 & 3u) << 11, guide_depth(packed));
}
uint guide_id(GuideBits packed) { return packed.bits.w >> 8; }
bool guide_is_apart(GuideBits packed) { return packed.bits.y >= 0x8000u; }

// The normal in steps, from 0 to twice NORMAL_STEPS: what differences of normals are made of.
vec3 guide_normal_steps(GuideBits packed) {
    return vec3(packed.bits.z & 0xffu, packed.bits.z >> 8, packed.bits.w & 0xffu);
}

vec3 guide_normal(GuideBits packed) { return normalize(guide_normal_steps(packed) - NORMAL_STEPS); }

#endif
