// For a host's path tracer in HLSL or Slang: which pixels of this frame repeat a sample of the previous frame, so that the denoiser sees how
// light changed. What the host has to do, and what it must not do: gradient_sample.glsl, which this is a translation of.
//
// A worked example. STRATUM_SIZE is Config::stratum_size; `surfaces` and `seeds` are the host's own images.
//
//     [[vk::binding(0, 1)]] Texture2D<uint4> gradient_samples;
//     #define ATROUS_GRADIENT_SAMPLES gradient_samples
//     #define ATROUS_STRATUM_SIZE STRATUM_SIZE
//     #include "gradient_sample.hlsl"
//
//     [numthreads(8, 8, 1)]
//     void main(uint3 id : SV_DispatchThreadID) {
//         int2 pixel = int2(id.xy);
//         uint4 surface = trace_primary_ray(pixel);                // instance, triangle, barycentrics
//         uint seed = hash(pixel, frame_index);
//         int2 previous_pixel;
//         if (atrous_gradient_sample(pixel, previous_pixel)) {
//             surface = previous_surfaces.Load(int3(previous_pixel, 0));
//             seed = previous_seeds.Load(int3(previous_pixel, 0)).x;
//         }
//         surfaces[pixel] = surface;
//         seeds[pixel] = seed;
//         noisy_radiance[pixel] = float4(shade(surface, seed), 1.0);  // direct and indirect light of this frame, for its eye
//     }
#ifndef ATROUS_GRADIENT_SAMPLE_HLSL
#define ATROUS_GRADIENT_SAMPLE_HLSL

#ifndef ATROUS_GRADIENT_SAMPLES
#error "define ATROUS_GRADIENT_SAMPLES as the name of the Texture2D<uint4> that is bound to the denoiser's `gradient_samples`"
#endif
#ifndef ATROUS_STRATUM_SIZE
#define ATROUS_STRATUM_SIZE 3
#endif

// Whether `pixel` repeats a sample of the previous frame, and of which pixel there.
bool atrous_gradient_sample(int2 pixel, out int2 previous_pixel) {
    int2 stratum = pixel / ATROUS_STRATUM_SIZE;
    int2 offset = pixel - stratum * ATROUS_STRATUM_SIZE;
    uint4 texel = ATROUS_GRADIENT_SAMPLES.Load(int3(stratum, 0));
    previous_pixel = int2(texel.xy);
    return texel.z == uint(1 + offset.x + offset.y * ATROUS_STRATUM_SIZE);
}

#endif
