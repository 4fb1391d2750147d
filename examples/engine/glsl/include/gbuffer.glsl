// Visibility: one primary ray through each pixel centre (plus jitter); what it hits becomes the G-buffer and the seed. With GLASS, the line of sight
// is followed through glass, and guides are those of what is seen behind it: see include/glass.glsl.
// Out: visibility, seed, linear_depth (scene units, 0 = background), normal and object_normal (world, object space),
// albedo (a: roughness), which is the sum of diffuse_albedo and specular_albedo; roughness; motion (xy: previous - current, pixels, y down,
// unjittered; z: previous linear depth), surface_id, emission (seen directly; no noise).
#ifndef GBUFFER_GLSL
#define GBUFFER_GLSL
#include "scene.glsl"
#include "camera.glsl"
#include "bvh.glsl"
#include "bsdf.glsl"
#include "random.glsl"
#ifdef GLASS
#include "glass.glsl"
#endif

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
layout(set = 1, binding = 11, rgba32f) uniform writeonly image2D emission_image;

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
    imageStore(emission_image, pixel, vec4(environment(normalize(direction)) * medium_transmittance(1.0e30), 1.0));
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
    imageStore(emission_image, pixel, vec4(s.emission * medium_transmittance(length(offset)), 1.0));
}

#ifdef GLASS

vec3 previous_position(Hit hit) {
    TriangleAttributes t = load_triangle(load_instance(hit.instance).first_triangle + hit.triangle);
    return transform_point(load_previous_world_from_object(hit.instance), object_position(t, hit.barycentrics));
}

// All that it reflects, tinted by the glass in between. The share that glass mirrors is no albedo: it would be as dark as what albedo does not divide.
vec3 whole_albedo(Surface s, Sight sight) {
    vec3 tint = sight.id >= ID_REFLECTED ? vec3(1.0) : sight.weight;
    return tint * (diffuse_albedo(s) + specular_albedo(s, clamp(-dot(s.normal, sight.direction), 0.0, 1.0)));
}

Surface surface_of(Sight sight) { return surface_at(Visibility(sight.hit.instance, sight.hit.triangle, sight.hit.barycentrics), sight.from); }

// `reflection`: what the specular light of the layers is divided by.
void write_sight(ivec2 pixel, vec2 position, vec3 ray, Sight sight, vec3 reflection) {
    Surface s = surface_of(sight);
    bool mirrored = frame.glass.x == GLASS_REFLECTION;
    float depth = (sight.distance + sight.hit.distance) / length(ray);
    vec3 point = previous_position(sight.hit), before = vec3(position, depth);
    // What stands still before a camera that does moves by exactly nothing.
    if (point != s.position || frame.previous_camera != frame.camera)
        before = find_through_glass(frame.previous_camera, position, point, mirrored, sight.meetings);
    vec3 albedo = whole_albedo(s, sight);
    imageStore(depth_image, pixel, vec4(depth));
    imageStore(normal_image, pixel, vec4(sight.turn * s.normal, 0.0));
    imageStore(object_normal_image, pixel, vec4(s.object_normal, 0.0));
    imageStore(albedo_image, pixel, vec4(albedo, s.roughness));
    imageStore(diffuse_albedo_image, pixel, vec4(albedo, 0.0));
    imageStore(specular_albedo_image, pixel, vec4(reflection, 0.0));
    imageStore(roughness_image, pixel, vec4(0.0));
    imageStore(motion_image, pixel, vec4(before.xy - position, before.z, 0.0));
    imageStore(surface_id_image, pixel, uvec4(s.surface_id + sight.id));
    imageStore(emission_image, pixel, vec4(s.emission * sight.weight, 1.0));
}

// The glass itself, whose light is all specular.
void write_glass(ivec2 pixel, Visibility visibility) {
    write_surface(pixel, visibility);
    imageStore(albedo_image, pixel, vec4(1.0, 1.0, 1.0, 0.0));
    imageStore(diffuse_albedo_image, pixel, vec4(0.0));
    imageStore(specular_albedo_image, pixel, vec4(1.0, 1.0, 1.0, 0.0));
    imageStore(roughness_image, pixel, vec4(0.0));
    imageStore(emission_image, pixel, vec4(0.0, 0.0, 0.0, 1.0));
}

vec3 albedo_of_reflection(vec3 direction) {
    Sight sight = follow(frame.camera.eye.xyz, direction, true, GLASS_LIMIT);
    return sight.hit.instance == NO_INSTANCE ? vec3(1.0) : whole_albedo(surface_of(sight), sight);
}

// Nothing is seen through it that has guides, so its reflection has those of the glass.
void write_glass_before_sky(ivec2 pixel, vec3 direction) {
    Hit hit = follow(frame.camera.eye.xyz, direction, false, 0u).hit;
    write_glass(pixel, Visibility(hit.instance, hit.triangle, hit.barycentrics));
    imageStore(specular_albedo_image, pixel, vec4(albedo_of_reflection(direction), 0.0));
}

void write_pixel(ivec2 pixel, vec2 position, vec3 ray) {
    vec3 direction = normalize(ray);
    uint limit = frame.glass.x == GLASS_ITSELF ? 0u : GLASS_LIMIT;
    Sight sight = follow(frame.camera.eye.xyz, direction, frame.glass.x == GLASS_REFLECTION, limit);
    Visibility visibility = Visibility(sight.hit.instance, sight.hit.triangle, sight.hit.barycentrics);
    // Lamps and ambient occlusion that are apart are those of surfaces that the eye sees directly.
    bool direct = sight.meetings == 0u && sight.hit.mask < MASK_PANE;
    imageStore(visibility_image, pixel, uvec4(direct ? visibility.instance : NO_INSTANCE, visibility.triangle, floatBitsToUint(visibility.barycentrics)));
    if (frame.glass.x == GLASS_REFLECTION && sight.meetings == 0u) {
        write_background(pixel, ray);
        imageStore(emission_image, pixel, vec4(0.0, 0.0, 0.0, 1.0));
    } else if (sight.hit.instance == NO_INSTANCE) {
        if (frame.glass.x == GLASS_LAYERS && sight.meetings > 0u) write_glass_before_sky(pixel, direction);
        else write_background(pixel, ray);
        imageStore(emission_image, pixel, vec4(environment(sight.direction) * sight.weight, 1.0));
    } else if (sight.meetings > 0u) {
        vec3 reflection = frame.glass.x == GLASS_LAYERS ? albedo_of_reflection(direction) : vec3(0.0);
        write_sight(pixel, position, ray, sight, reflection);
    } else if (sight.hit.mask >= MASK_PANE) {
        write_glass(pixel, visibility);
    } else {
        write_surface(pixel, visibility);
    }
}

#else

void write_pixel(ivec2 pixel, vec2 position, vec3 ray) {
    Hit hit = closest_hit(frame.camera.eye.xyz, ray);
    imageStore(visibility_image, pixel, uvec4(hit.instance, hit.triangle, floatBitsToUint(hit.barycentrics)));
    if (hit.instance == NO_INSTANCE) write_background(pixel, ray);
    else write_surface(pixel, Visibility(hit.instance, hit.triangle, hit.barycentrics));
}

#endif

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    imageStore(seed_image, pixel, uvec4(pixel_seed(uvec2(pixel), frame.extent_frame_seed.z, frame.extent_frame_seed.w)));
    vec2 position = vec2(pixel) + 0.5 + frame.jitter_epsilon_weight.xy;
    write_pixel(pixel, position, ray_direction(frame.camera, position));
}

#endif
