// For a host's path tracer: which pixels of this frame repeat a sample of the previous frame, so that the denoiser sees how light changed.
// Source: [ASVGF] 3.1, 3.3. Needs GL_EXT_samplerless_texture_functions. The presets `asvgf`, `best` and `stabilize` with forward-projected
// gradients write `gradient_samples` in their phase BeforeLighting; trace after it, and set FrameParams::reshaded. The same in HLSL, which Slang
// reads as well, and in WGSL: gradient_sample.hlsl, gradient_sample.wgsl.
//
// One pixel in a stratum (3x3 by default) is a gradient sample. It shades the surface that `previous_pixel` saw in the previous frame, moved along
// with its object, with the random numbers that were used there, for the eye of this frame: all that may differ is the light that reaches the
// eye. Shade it as every other pixel, into the same image, and do not read `noisy_radiance` of the previous frame: the denoiser keeps that
// luminance itself. No G-buffer changes: depth, normal, motion and albedo that the denoiser reads stay those of this frame, of the pixel's own
// surface; the denoiser remembers the albedo of the sample.
//
// The random seed belongs to the sample, not to the frame: keep one in an image, since a seed that was taken over can be taken over again.
// What the surface record holds is the host's business: whatever its shading reads, in a space that moves along with the object (a triangle
// and barycentrics do). Two copies of both images, read the previous and write the current one.
//
// A worked example. STRATUM_SIZE is Config::stratum_size; `surfaces` and `seeds` are the host's own images.
//
//     #extension GL_EXT_samplerless_texture_functions : require
//     layout(set = 1, binding = 0) uniform utexture2D gradient_samples;
//     #define ATROUS_GRADIENT_SAMPLES gradient_samples
//     #define ATROUS_STRATUM_SIZE STRATUM_SIZE
//     #include "gradient_sample.glsl"
//
//     void main() {
//         ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
//         uvec4 surface = trace_primary_ray(pixel);                // instance, triangle, barycentrics
//         uint seed = hash(pixel, frame_index);
//         ivec2 previous_pixel;
//         if (atrous_gradient_sample(pixel, previous_pixel)) {
//             surface = texelFetch(previous_surfaces, previous_pixel, 0);
//             seed = texelFetch(previous_seeds, previous_pixel, 0).x;
//         }
//         imageStore(surfaces, pixel, surface);
//         imageStore(seeds, pixel, uvec4(seed));
//         vec3 radiance = shade(surface, seed);                    // direct and indirect light of this frame, for its eye
//         imageStore(noisy_radiance, pixel, vec4(radiance, 1.0));
//     }
//
// For the change to be exactly 0 where nothing changed, `shade` must depend on surface, seed, scene and eye alone. The eye is that of this frame
// [ASVGF, Figure 1]: a highlight that moves with the camera is a change, and the sample is one of this frame's picture. With Signals::Specular
// reflections are followed by themselves: keep the eye that saw the sample in the record there, and shade for that, so that nothing is seen but
// changes of the scene. docs/lab/stages.md, forward_project, has what either is worth.
#ifndef ATROUS_GRADIENT_SAMPLE_GLSL
#define ATROUS_GRADIENT_SAMPLE_GLSL

#ifndef ATROUS_GRADIENT_SAMPLES
#error "define ATROUS_GRADIENT_SAMPLES as the name of the utexture2D that is bound to the denoiser's `gradient_samples`"
#endif
#ifndef ATROUS_STRATUM_SIZE
#define ATROUS_STRATUM_SIZE 3
#endif

// Whether `pixel` repeats a sample of the previous frame, and of which pixel there.
bool atrous_gradient_sample(ivec2 pixel, out ivec2 previous_pixel) {
    ivec2 stratum = pixel / ATROUS_STRATUM_SIZE;
    ivec2 offset = pixel - stratum * ATROUS_STRATUM_SIZE;
    uvec4 texel = texelFetch(ATROUS_GRADIENT_SAMPLES, stratum, 0);
    previous_pixel = ivec2(texel.xy);
    return texel.z == uint(1 + offset.x + offset.y * ATROUS_STRATUM_SIZE);
}

#endif
