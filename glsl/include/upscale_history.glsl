// A texel of the history of temporal_upscale, in 64 bits. Bits: docs/specification/packed_images.md. Twin: src/reference/upscale_history.rs.
#ifndef UPSCALE_HISTORY_GLSL
#define UPSCALE_HISTORY_GLSL

struct UpscaleHistory {
    vec3 even;     // r/(1 + luminance(r)) of the radiance r divided by the light around: so means of few bright texels are no spots
    float weight;  // of what was gathered
    float depth;   // of the surface that it belongs to, scene units; 0: background
};

// The exponent of the largest component, below which that has as many bits as a half.
const int LEAST_EXPONENT = -15;
// The longest past, and the steps of its root.
const float LARGEST_WEIGHT = 128.0;
const float WEIGHT_STEPS = 1023.0;

uvec4 pack_upscale_history(UpscaleHistory h) {
    vec3 c = clamp(h.even, 0.0, 65504.0);
    int exponent = max(int(floatBitsToUint(max(max(c.r, c.g), c.b)) >> 23) - 126, LEAST_EXPONENT);
    uvec3 mantissa = min(uvec3(c * uintBitsToFloat(uint(138 - exponent) << 23) + 0.5), 2047u);
    uint weight = uint(sqrt(min(h.weight, LARGEST_WEIGHT) / LARGEST_WEIGHT) * WEIGHT_STEPS + 0.5);
    uint low = mantissa.r | mantissa.g << 11 | weight << 22;
    return uvec4(low & 0xffffu, low >> 16, mantissa.b | uint(exponent - LEAST_EXPONENT) << 11, floatBitsToUint(h.depth) + 0x4000u >> 15);
}

UpscaleHistory unpack_upscale_history(uvec4 packed) {
    uint low = packed.x | packed.y << 16;
    vec3 mantissa = vec3(low & 0x7ffu, low >> 11 & 0x7ffu, packed.z & 0x7ffu);
    float weight = float(low >> 22) * (1.0 / WEIGHT_STEPS);
    float scale = uintBitsToFloat((packed.z >> 11) + uint(116 + LEAST_EXPONENT) << 23);
    return UpscaleHistory(mantissa * scale, weight * weight * LARGEST_WEIGHT, uintBitsToFloat(packed.w << 15));
}

#endif
