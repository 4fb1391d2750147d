#version 450
// Visibility: one primary ray through each pixel centre (plus jitter); what it hits becomes the G-buffer and the seed.
// Out: visibility, seed, linear_depth (scene units, 0 = background), normal and object_normal (world, object space),
// albedo (a: roughness), which is the sum of diffuse_albedo and specular_albedo; roughness; motion (xy: previous - current, pixels, y down, unjittered; z: previous linear depth), surface_id.
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"
#include "camera.glsl"
#include "bvh.glsl"
#include "bsdf.glsl"
#include "random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 0, rgba32ui) uniform writeonly uimage2D visibility_image;
layout(set = 1, binding = 1, r32ui) uniform writeonly uimage2D seed_image;
layout(set = 1, binding = 2, r32f) uniform writeonly image2D depth_image;
layout(set = 1, binding = 3, rgba16f) uniform writeonly image2D normal_image;
layout(set = 1, binding = 4, rgba16f) uniform writeonly image2D object_normal_image;
layout(set = 1, binding = 5, rgba16f) uniform writeonly image2D albedo_image;
layout(set = 1, binding = 6, rgba32f) uniform writeonly image2D motion_image;
layout(set = 1, binding = 7, r32ui) uniform writeonly uimage2D surface_id_image;
layout(set = 1, binding = 8, rgba16f) uniform writeonly image2D diffuse_albedo_image;
layout(set = 1, binding = 9, rgba16f) uniform writeonly image2D specular_albedo_image;
layout(set = 1, binding = 10, r32f) uniform writeonly image2D roughness_image;

// The same function projects both ends, so that what stands still moves by exactly nothing.
vec4 motion(vec3 offset, vec3 previous_offset) {
    vec3 current = project(frame.camera, offset);
    vec3 previous = project(frame.previous_camera, previous_offset);
    return vec4(previous.xy - current.xy, previous.z, 0.0);
}

void write_background(ivec2 pixel, vec3 direction) {
    imageStore(depth_image, pixel, vec4(0.0));
    imageStore(normal_image, pixel, vec4(0.0));
    imageStore(object_normal_image, pixel, vec4(0.0));
    imageStore(albedo_image, pixel, vec4(1.0));
    imageStore(diffuse_albedo_image, pixel, vec4(1.0));
    imageStore(specular_albedo_image, pixel, vec4(1.0));
    imageStore(roughness_image, pixel, vec4(1.0));
    imageStore(motion_image, pixel, vec4(motion(direction, direction).xy, 0.0, 0.0));
    imageStore(surface_id_image, pixel, uvec4(0u));
}

void write_surface(ivec2 pixel, Visibility visibility) {
    Surface s = surface_at(visibility, frame.camera.eye.xyz);
    TriangleAttributes t = load_triangle(load_instance(visibility.instance).first_triangle + visibility.triangle);
    vec4 previous_rows[3] = load_previous_world_from_object(visibility.instance);
    vec3 previous = transform_point(previous_rows, object_position(t, visibility.barycentrics));
    vec3 offset = s.position - frame.camera.eye.xyz;
    float view_cosine = clamp(dot(s.normal, -normalize(offset)), 0.0, 1.0);
    imageStore(depth_image, pixel, vec4(dot(offset, frame.camera.forward.xyz)));
    imageStore(normal_image, pixel, vec4(s.normal, 0.0));
    imageStore(object_normal_image, pixel, vec4(s.object_normal, 0.0));
    vec3 diffuse = diffuse_albedo(s), specular = specular_albedo(s, view_cosine);
    imageStore(albedo_image, pixel, vec4(diffuse + specular, s.roughness));
    imageStore(diffuse_albedo_image, pixel, vec4(diffuse, 0.0));
    imageStore(specular_albedo_image, pixel, vec4(specular, 0.0));
    imageStore(roughness_image, pixel, vec4(s.roughness));
    imageStore(motion_image, pixel, motion(offset, previous - frame.previous_camera.eye.xyz));
    imageStore(surface_id_image, pixel, uvec4(s.surface_id));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    vec3 direction = ray_direction(frame.camera, vec2(pixel) + 0.5 + frame.jitter_epsilon_weight.xy);
    Hit hit = closest_hit(frame.camera.eye.xyz, direction);
    imageStore(visibility_image, pixel, uvec4(hit.instance, hit.triangle, floatBitsToUint(hit.barycentrics)));
    imageStore(seed_image, pixel, uvec4(pixel_seed(uvec2(pixel), frame.extent_frame_seed.z, frame.extent_frame_seed.w)));
    if (hit.instance == NO_INSTANCE) write_background(pixel, direction);
    else write_surface(pixel, Visibility(hit.instance, hit.triangle, hit.barycentrics));
}
