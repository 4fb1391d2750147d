#ifndef LUMINANCE_GLSL
#define LUMINANCE_GLSL

// Rec. 709.
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// What a half-float image can hold; NaN becomes 0.
vec3 storable(vec3 c) { return min(max(c, vec3(0.0)), vec3(65504.0)); }

#endif
