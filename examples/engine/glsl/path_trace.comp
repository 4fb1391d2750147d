#version 450
// Lighting at one path per pixel: see include/lighting.glsl.
#extension GL_GOOGLE_include_directive : require
#include "lighting.glsl"
