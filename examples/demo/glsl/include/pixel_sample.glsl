// The surface and the seed of a pixel: all that lighting takes from the visibility pass, fetched in this one place.
// A-SVGF swaps both for those of a previous pixel here [Schied et al. 2018, eq. 6]; the light path then follows.
#ifndef PIXEL_SAMPLE_GLSL
#define PIXEL_SAMPLE_GLSL
#include "surface.glsl"

layout(set = 1, binding = 0, rgba32ui) uniform readonly uimage2D visibility_image;
layout(set = 1, binding = 1, r32ui) uniform readonly uimage2D seed_image;

struct PixelSample {
    Visibility visibility;
    uint seed;
};

PixelSample fetch_pixel_sample(ivec2 pixel) {
    uvec4 packed = imageLoad(visibility_image, pixel);
    return PixelSample(Visibility(packed.x, packed.y, uintBitsToFloat(packed.zw)), imageLoad(seed_image, pixel).r);
}

#endif
