#version 450
// The G-buffer: see include/gbuffer.glsl.
#extension GL_GOOGLE_include_directive : require
#include "gbuffer.glsl"
