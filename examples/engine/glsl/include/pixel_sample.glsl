// The surface and the seed of a pixel: all that lighting takes from the visibility pass, fetched in this one place.
// With RESHADE defined, gradient samples take those of a pixel of the previous frame instead [ASVGF eq. 6]; the light path then follows.
#ifndef PIXEL_SAMPLE_GLSL
#define PIXEL_SAMPLE_GLSL
#include "surface.glsl"

layout(set = 1, binding = 0, rgba32ui) uniform readonly uimage2D visibility_image;
layout(set = 1, binding = 1, r32ui) uniform readonly uimage2D seed_image;

struct PixelSample {
    Visibility visibility;
    uint seed;
    vec3 eye; // from where the surface is seen
};

Visibility unpack_visibility(uvec4 packed) { return Visibility(packed.x, packed.y, uintBitsToFloat(packed.zw)); }

Visibility fetch_visibility(ivec2 pixel) { return unpack_visibility(imageLoad(visibility_image, pixel)); }

#ifndef RESHADE

// `pixel`: of the light; `seen`: of the picture.
PixelSample fetch_pixel_sample(ivec2 pixel, ivec2 seen) {
    return PixelSample(fetch_visibility(seen), imageLoad(seed_image, seen).r, frame.camera.eye.xyz);
}

#else

// What was shaded, for the next frame: the surface as the visibility pass has it, a place on a triangle, which moves along with its object;
// and x: the seed, yzw: the eye that saw it, world space. The sample is shaded for this frame's eye, so that it is a sample of this frame's
// picture, and a highlight that moves with the eye is a change of light; or, with `kept_eye`, for its own: then only the scene can differ.
layout(set = 1, binding = 10) uniform utexture2D gradient_samples;
layout(set = 1, binding = 11) uniform utexture2D previous_surfaces;
layout(set = 1, binding = 12) uniform utexture2D previous_seeds;
layout(set = 1, binding = 13, rgba32ui) uniform writeonly uimage2D surfaces;
layout(set = 1, binding = 14, rgba32ui) uniform writeonly uimage2D seeds;
layout(push_constant) uniform Push {
    int stratum_size;
    uint kept_eye;
} push;

#define ATROUS_GRADIENT_SAMPLES gradient_samples
#define ATROUS_STRATUM_SIZE push.stratum_size
#include "gradient_sample.glsl"

PixelSample fetch_pixel_sample(ivec2 pixel, ivec2 seen) {
    uvec4 surface = imageLoad(visibility_image, seen);
    uvec4 seed = uvec4(imageLoad(seed_image, seen).r, floatBitsToUint(frame.camera.eye.xyz));
    ivec2 previous_pixel;
    if (atrous_gradient_sample(pixel, previous_pixel)) {
        surface = texelFetch(previous_surfaces, previous_pixel, 0);
        uvec4 before = texelFetch(previous_seeds, previous_pixel, 0);
        seed = push.kept_eye != 0u ? before : uvec4(before.x, seed.yzw);
    }
    imageStore(surfaces, pixel, surface);
    imageStore(seeds, pixel, seed);
    return PixelSample(unpack_visibility(surface), seed.x, uintBitsToFloat(seed.yzw));
}

#endif
#endif
