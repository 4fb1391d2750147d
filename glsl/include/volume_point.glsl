// A point of a volume in a pixel: how far it is, and how much it contributes. Bits: docs/specification/packed_images.md. Twin: src/nodes/volume_points/twin.rs.
#ifndef VOLUME_POINT_GLSL
#define VOLUME_POINT_GLSL

// A texel of volume_points, as it is stored: its depth has all bits of a float, unlike that of a guide.
struct PointBits {
    uvec4 bits;
};

PointBits pack_point(float linear_depth, uint contribution) {
    uint depth = floatBitsToUint(linear_depth);
    return PointBits(uvec4(depth & 0xffffu, depth >> 16, contribution, 0u));
}

// Scene units; 0: there is no point.
float point_depth(PointBits packed) { return uintBitsToFloat(packed.bits.x | packed.bits.y << 16); }

// The upper half of the luminance as a float.
uint point_contribution(PointBits packed) { return packed.bits.z; }

#endif
