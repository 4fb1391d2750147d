// What is seen in a glossy surface: how far behind it, how wide its lobe. Twin: src/reference/reflection.rs.
// Source: [Lagarde and de Rousiers 2014] dominant direction of GGX; the mirror equation for curved surfaces, as [Zimmer et al. 2015] use it.
#ifndef REFLECTION_GLSL
#define REFLECTION_GLSL
#include "frame.glsl"
#include "view_position.glsl"

struct Reflection {
    float hit_distance;  // scene units; 0: unknown
    float roughness;     // perceptual, 0..1
};

// Stored for what is beyond the scene.
const float FARTHEST_HIT = 65504.0;

const float NO_PAST = -1.0;
const float ROUGHNESS_STEPS = 1023.0;
const float SHARE_STEPS = 62.0;

// `image_share`: of the past that was taken, how much comes from where the image was, or NO_PAST; where the hit distance is unknown, how likely it
// is that the image is seen.
uint pack_reflection(Reflection r, float image_share) {
    uint share = image_share < 0.0 ? 0u : 1u + uint(image_share * SHARE_STEPS + 0.5);
    uint roughness = uint(r.roughness * ROUGHNESS_STEPS + 0.5);
    return packHalf2x16(vec2(min(r.hit_distance, FARTHEST_HIT), 0.0)) | roughness << 16 | share << 26;
}

Reflection unpack_reflection(uint packed) {
    return Reflection(unpackHalf2x16(packed).x, float(packed >> 16 & 0x3ffu) / ROUGHNESS_STEPS);
}

float unpack_image_share(uint packed) { return packed >> 26 == 0u ? NO_PAST : float((packed >> 26) - 1u) / SHARE_STEPS; }

// Width parameter of the GGX distribution.
float lobe_width(float roughness) { return roughness * roughness; }

// Share of a lobe's light that moves as an image in a mirror does: 1, a mirror, to 0, a surface that is as bright from everywhere.
float mirror_share(float roughness) {
    float smoothness = 1.0 - lobe_width(roughness);
    return clamp(smoothness * (sqrt(smoothness) + lobe_width(roughness)), 0.0, 1.0);
}

// Pixels that the lobe of a surface covers at the distance of what is seen in it.
float lobe_radius(float linear_depth, Reflection r) {
    if (r.hit_distance == 0.0) return 65504.0;
    return min(lobe_width(r.roughness) * r.hit_distance / pixel_size(linear_depth + r.hit_distance).y, 65504.0);
}

// Of a lobe that explains half of the light: its width, and its radius in pixels, both squared.
const float MIXED_WIDTH = 1e-3;
const float MIXED_RADIUS = 4.0;

// Roughness of diffuse and specular light together: the less of it the lobe explains, the wider the light may be blurred.
float mixed_roughness(float linear_depth, Reflection r, float explained) {
    float width = lobe_width(r.roughness), radius = lobe_radius(linear_depth, Reflection(r.hit_distance, 1.0)), share = max(explained, 1e-3);
    float squared = width * width / share + (1.0 / share - 1.0) * (MIXED_WIDTH + MIXED_RADIUS / max(radius * radius, 1e-6));
    return sqrt(sqrt(min(squared, 1.0)));
}

// Hit distance as a share of the way from the eye: bounded, and next to what moves on the screen, so that means are taken of it. 0 of the
// background, too.
float nearness_of(float linear_depth, float hit_distance) { return hit_distance / max(linear_depth + hit_distance, 1e-20); }

float hit_distance_of(float linear_depth, float nearness) {
    return nearness > 0.0 ? clamp(linear_depth * nearness / max(1.0 - nearness, 1e-6), 1.0 / 16384.0, FARTHEST_HIT) : 0.0;
}

// Distance behind a mirror of the image of what it reflects. Convex surfaces, of positive curvature, pull it near.
float mirror_image_distance(float hit_distance, float curvature) { return hit_distance / max(1.0 + 2.0 * curvature * hit_distance, 0.1); }

#endif
