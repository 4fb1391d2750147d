// Transforms of the host's instances: to world space of the previous frame from that of this one, three rows of four by id. Twin:
// src/reference/reprojection.rs, equal to the bit. Needs the buffer `instance_transforms` at the binding INSTANCE_TRANSFORMS, and optional.glsl.
#ifndef INSTANCE_TRANSFORM_GLSL
#define INSTANCE_TRANSFORM_GLSL
#include "finite.glsl"
#include "frame.glsl"

// A coordinate that is carried farther is of a transform that is none. NaN is not below it either.
const float FARTHEST = 1e15;

// A transform of the host's world space as one of the world seen from the eye: (R - 1)·eye is added to its translation, which is exactly 0
// where nothing turns.
vec4 row_about_eye(vec4 row, uint i) {
    precise float moved = (row.x - (i == 0u ? 1.0 : 0.0)) * frame.eye.x;
    moved = moved + (row.y - (i == 1u ? 1.0 : 0.0)) * frame.eye.y;
    moved = moved + (row.z - (i == 2u ? 1.0 : 0.0)) * frame.eye.z;
    precise float w = row.w + moved;
    return vec4(row.xyz, w);
}

// The transform of an instance, of the world seen from the eye. False: it did not move, since there is no entry, or one that is not finite.
bool instance_rows(uint id, out vec4 rows[3]) {
    rows[0] = rows[1] = rows[2] = vec4(0.0);
    uint count = is_present(INSTANCE_TRANSFORMS) ? uint(instance_transforms.rows.length()) / 3u : 0u;
    if (id >= count) return false;
    bool finite = true;
    for (uint i = 0u; i < 3u; ++i) {
        vec4 row = instance_transforms.rows[id * 3u + i];
        finite = finite && is_finite(row);
        rows[i] = row_about_eye(row, i);
    }
    return finite;
}

vec3 turned(vec4 rows[3], vec3 v) { return vec3(dot(rows[0].xyz, v), dot(rows[1].xyz, v), dot(rows[2].xyz, v)); }

// Of a point; false: too far for a transform that is one.
bool carried(vec4 rows[3], vec4 world, out vec4 to) {
    to = vec4(dot(rows[0], world), dot(rows[1], world), dot(rows[2], world), 1.0);
    return all(lessThan(abs(to.xyz), vec3(FARTHEST)));
}

#endif
