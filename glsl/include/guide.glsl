// Packing of the per-pixel features that steer the filters. Bits: docs/stages.md. Twin: src/reference/guide.rs.
#ifndef GUIDE_GLSL
#define GUIDE_GLSL

struct Guide {
    float linear_depth;  // scene units; 0: background
    vec3 normal;         // world space
    float roughness;     // 0..1
    uint id8;            // folded surface_id
};

uint half_bits(float x) { return packHalf2x16(vec2(x, 0.0)) & 0xffffu; }
float half_value(uint bits) { return unpackHalf2x16(bits).x; }

vec2 sign_not_zero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

vec2 octahedral(vec3 n) {
    vec2 e = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z < 0.0 ? (1.0 - abs(e.yx)) * sign_not_zero(e) : e;
}

// Where z is negative, x and y move towards 0 by as much.
vec3 from_octahedral(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float folded = max(-n.z, 0.0);
    return normalize(vec3(n.x + (n.x >= 0.0 ? -folded : folded), n.y + (n.y >= 0.0 ? -folded : folded), n.z));
}

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

// The lowest 4 bits of the depth's mantissa make room for the roughness, or for another number below 16.
uvec4 pack_guide(Guide g) {
    uint depth = floatBitsToUint(g.linear_depth) & ~0xfu | uint(floor(g.roughness * 15.0 + 0.5));
    uvec3 n = uvec3(floor(g.normal * NORMAL_STEPS + (NORMAL_STEPS + 0.5)));
    return uvec4(depth & 0xffffu, depth >> 16, n.x | n.y << 8, n.z | g.id8 << 8);
}

float unpack_depth(uvec4 packed) { return uintBitsToFloat(packed.x & 0xfff0u | packed.y << 16); }
float unpack_roughness(uvec4 packed) { return float(packed.x & 0xfu) / 15.0; }
uint unpack_id(uvec4 packed) { return packed.w >> 8; }

// The normal in steps, from 0 to twice NORMAL_STEPS: what differences of normals are made of.
vec3 normal_steps(uvec4 packed) { return vec3(packed.z & 0xffu, packed.z >> 8, packed.w & 0xffu); }

vec3 unpack_normal(uvec4 packed) { return normalize(normal_steps(packed) - NORMAL_STEPS); }

#endif
