#version 450
// Ground truth: see include/reference.glsl.
#extension GL_GOOGLE_include_directive : require
#include "reference.glsl"
