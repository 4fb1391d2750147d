// Packing of the per-pixel features that steer the filters. Bits: docs/specification/packed_images.md. Twin: src/reference/guide.rs.
#ifndef GUIDE_GLSL
#define GUIDE_GLSL

// A texel of an image of guides, as it is stored. A type of its own, so that no unpacker takes another image for one.
struct GuideBits {
    uvec4 bits;
};

struct Guide {
    float linear_depth;  // scene units; 0: background
    bool is_dark;        // the albedo divides little or nothing of the light
    vec3 normal;         // world space
    float roughness;     // 0..1
    uint id8;            // folded surface_id
};

uint half_bits(float x) { return packHalf2x16(vec2(x, 0.0)) & 0xffffu; }
float half_value(uint bits) { return unpackHalf2x16(bits).x; }

// Scene units per pixel.
vec2 unpack_depth_gradient(uint packed) { return unpackHalf2x16(packed); }

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

// The lowest 4 bits of the depth's mantissa make room for the roughness, or for another number below 16; its sign says what is dark.
GuideBits pack_guide(Guide g) {
    uint depth = floatBitsToUint(g.linear_depth) & ~0xfu | uint(floor(g.roughness * 15.0 + 0.5));
    depth |= g.is_dark ? 0x80000000u : 0u;
    uvec3 n = uvec3(floor(g.normal * NORMAL_STEPS + (NORMAL_STEPS + 0.5)));
    return GuideBits(uvec4(depth & 0xffffu, depth >> 16, n.x | n.y << 8, n.z | g.id8 << 8));
}

// Negative where the albedo is dark, 0 in the background.
float signed_guide_depth(GuideBits packed) { return uintBitsToFloat(packed.bits.x & 0xfff0u | packed.bits.y << 16); }
float guide_depth(GuideBits packed) { return abs(signed_guide_depth(packed)); }
float guide_roughness(GuideBits packed) { return float(packed.bits.x & 0xfu) / 15.0; }
uint guide_id(GuideBits packed) { return packed.bits.w >> 8; }
bool guide_is_dark(GuideBits packed) { return packed.bits.y >= 0x8000u; }

// The normal in steps, from 0 to twice NORMAL_STEPS: what differences of normals are made of.
vec3 guide_normal_steps(GuideBits packed) {
    return vec3(packed.bits.z & 0xffu, packed.bits.z >> 8, packed.bits.w & 0xffu);
}

vec3 guide_normal(GuideBits packed) { return normalize(guide_normal_steps(packed) - NORMAL_STEPS); }

#endif
