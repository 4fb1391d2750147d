// The curve of sRGB [IEC 61966-2-1], both ways; 0..1.
#ifndef SRGB_GLSL
#define SRGB_GLSL

vec3 srgb(vec3 x) { return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308))); }

vec3 from_srgb(vec3 x) { return mix(x / 12.92, pow((x + 0.055) / 1.055, vec3(2.4)), greaterThan(x, vec3(0.04045))); }

#endif
