#version 450
// Ground truth of a scene with glass: see include/reference.glsl.
#extension GL_GOOGLE_include_directive : require
#define GLASS
#include "reference.glsl"
