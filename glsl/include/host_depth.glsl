// Linear depth of a host's depth. Needs the binding `depth` at DEPTH, and the id of a pixel as `id_at`. Twin: Projections in src/reference/projection.rs.
#ifndef HOST_DEPTH_GLSL
#define HOST_DEPTH_GLSL
#include "finite.glsl"
#include "view_position.glsl"
#include "viewport.glsl"

const uint DEPTH_DEVICE = 1u;
const uint DEPTH_RAY_LENGTH = 2u;

// Scene units: squares of what is nearer, and sums of tolerances there, are 0.
const float NEAREST_DEPTH = 1e-30;

bool is_orthographic() { return frame.clip_from_view[2][3] == 0.0; }

// 0 for the background.
float depth_of(float d, uint id, ivec2 p) {
    float z = d;
    if (convention(DEPTH_SHIFT) == DEPTH_DEVICE) {
        mat4 clip = frame.clip_from_view;
        float denominator = clip[2][2] - d * clip[2][3];
        z = denominator == 0.0 ? 0.0 : abs((d * clip[3][3] - clip[3][2]) / denominator);
    }
    if (convention(DEPTH_SHIFT) == DEPTH_RAY_LENGTH) z = is_orthographic() ? d : d / length(view_position(p, 1.0));
    bool background = !is_finite(z) || z < NEAREST_DEPTH || z >= frame.background_depth || id == 0u;
    return background ? 0.0 : z;
}

float host_depth_at(ivec2 p) { return depth_of(texelFetch(depth, host_pixel(DEPTH, p), 0).x, id_at(p), p); }

#endif
