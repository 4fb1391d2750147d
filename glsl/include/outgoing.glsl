// Light in the unit of the host, as the image that goes out holds it: halves, or with the variant FLOAT=1 floats of 32 bits.
// Twin: src/reference/outgoing.rs.
#ifndef OUTGOING_GLSL
#define OUTGOING_GLSL
#include "luminance.glsl"

#if FLOAT
#define OUTGOING_FORMAT rgba32f
#else
#define OUTGOING_FORMAT rgba16f
#endif

// Nobody sets it: its default tells the variant.
layout(constant_id = 9) const bool WIDE = FLOAT == 1;

const float BRIGHTEST = WIDE ? 3e38 : 65504.0;

// NaN becomes 0.
vec3 outgoing_range(vec3 c) { return min(max(c, vec3(0.0)), vec3(BRIGHTEST)); }

vec3 outgoing(vec3 c) { return WIDE ? outgoing_range(c) : storable(c); }

// Whether the image cannot hold a light.
bool is_too_bright(vec3 c) { return max(max(c.r, c.g), c.b) > BRIGHTEST; }

#endif
