// World-space normal of a host's. Needs the binding `normal` at NORMAL. Twin: src/nodes/import/twin.rs.
#ifndef HOST_NORMAL_GLSL
#define HOST_NORMAL_GLSL
#include "conventions.glsl"
#include "finite.glsl"
#include "guide.glsl"
#include "viewport.glsl"

const uint NORMAL_XYZ_UNORM = 1u;
const uint NORMAL_OCTAHEDRAL = 2u;
const uint NORMAL_OCTAHEDRAL_UNORM = 3u;

vec3 decode_normal(vec3 v) {
    uint encoding = convention(NORMAL_SHIFT);
    if (encoding == NORMAL_XYZ_UNORM || encoding == NORMAL_OCTAHEDRAL_UNORM) v = v * 2.0 - 1.0;
    return encoding >= NORMAL_OCTAHEDRAL ? octahedral_direction(v.xy) : v;
}

// Towards the camera where it has no direction.
vec3 world_normal(ivec2 p, out bool bad) {
    vec3 towards_camera = normalize(mat3(frame.world_from_view) * vec3(0.0, 0.0, -forward_sign()));
    vec3 n = decode_normal(texelFetch(normal, host_pixel(NORMAL, p), 0).xyz);
    if (has_convention(NORMAL_VIEW)) n = mat3(frame.world_from_view) * n;
    // Not finite either where a component is not, or is too large to be squared.
    float squared = dot(n, n);
    bad = !is_finite(squared);
    return !bad && squared >= 1e-8 ? n * inversesqrt(squared) : towards_camera;
}

#endif
