#version 450
// The G-buffer of a scene with glass: see include/gbuffer.glsl.
#extension GL_GOOGLE_include_directive : require
#define GLASS
#include "gbuffer.glsl"
