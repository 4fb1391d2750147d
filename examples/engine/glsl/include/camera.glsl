// Pixels and rays. Pixel positions are continuous, y down, centres at .5; depth is along the view axis.
#ifndef CAMERA_GLSL
#define CAMERA_GLSL
#include "scene.glsl"

// Unit depth along the view axis, so not normalised.
vec3 ray_direction(CameraFrame camera, vec2 pixel_position) {
    vec2 ndc = pixel_position / vec2(frame.extent_frame_seed.xy) * 2.0 - 1.0;
    return camera.forward.xyz + ndc.x * camera.right.xyz - ndc.y * camera.up.xyz;
}

// xy: pixel position, z: linear depth (scene units). `offset` is relative to the eye; a direction works as well.
vec3 project(CameraFrame camera, vec3 offset) {
    float depth = dot(offset, camera.forward.xyz);
    // right and up carry the tangents, so each is divided by its square.
    float x = dot(offset, camera.right.xyz) / dot(camera.right.xyz, camera.right.xyz);
    float y = dot(offset, camera.up.xyz) / dot(camera.up.xyz, camera.up.xyz);
    float divisor = abs(depth) < 1.0e-6 ? 1.0e-6 : depth;
    vec2 ndc = vec2(x, -y) / divisor;
    return vec3((ndc * 0.5 + 0.5) * vec2(frame.extent_frame_seed.xy), depth);
}

#endif
