#version 450
// Lighting at one path per pixel, where one pixel in a stratum repeats a sample of the previous frame: see include/pixel_sample.glsl.
// In addition in: gradient_samples of the denoiser, surfaces and seeds of the previous frame. Out: surfaces and seeds of this one.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#define RESHADE
#include "lighting.glsl"
