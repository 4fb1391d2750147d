#version 450
// Lighting of a scene with glass, at one path for each layer of a pixel: see include/lighting.glsl.
#extension GL_GOOGLE_include_directive : require
#define GLASS
#include "lighting.glsl"
