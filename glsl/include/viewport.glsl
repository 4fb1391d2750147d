// Where a pixel lies in the image of a binding: the picture may be a part of the host's images.
// A shader that may read or write one of them asks for each texel. Without such images the question vanishes when the pipeline is made.
#ifndef VIEWPORT_GLSL
#define VIEWPORT_GLSL

#include "frame.glsl"

layout(constant_id = 29) const uint OF_HOST = 0u;  // bit i: binding i has an image of the host, in which the picture is a part

ivec2 host_pixel(uint binding, ivec2 p) { return p + ivec2(OF_HOST >> binding & 1u) * ivec2(frame.viewport_origin); }

#endif
