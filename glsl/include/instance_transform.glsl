// A transform of the host's world space as one of the world seen from the eye: (R - 1)·eye is added to its translation, which is exactly 0
// where nothing turns. Twin: src/reference/reprojection.rs, equal to the bit.
#ifndef INSTANCE_TRANSFORM_GLSL
#define INSTANCE_TRANSFORM_GLSL
#include "frame.glsl"

vec4 row_about_eye(vec4 row, uint i) {
    precise float moved = (row.x - (i == 0u ? 1.0 : 0.0)) * frame.eye.x;
    moved = moved + (row.y - (i == 1u ? 1.0 : 0.0)) * frame.eye.y;
    moved = moved + (row.z - (i == 2u ? 1.0 : 0.0)) * frame.eye.z;
    precise float w = row.w + moved;
    return vec4(row.xyz, w);
}

#endif
