#version 450
// Temporal anti-aliasing: the jittered frames of the past, fetched by motion, clipped to the colours around, and blended.
// Source: [Karis 2014] High Quality Temporal Supersampling; the clip is the variance clip of [Salvi 2016] in YCoCg.
// In:  tone_mapped and taa_history, display-referred linear; guide; surface_motion. Out: taa_history, display.
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "surface_motion.glsl"
#include "luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Push {
    float taa_alpha;
    float taa_gamma;
} push;

// Storage images where neighbours are read, for the reasons that packed_image.glsl has.
layout(set = 0, binding = 1, rgba16ui) uniform restrict readonly uimage2D guide;
layout(set = 0, binding = 2) uniform utexture2D surface_motion;
layout(set = 0, binding = 3) uniform texture2D tone_mapped;
layout(set = 0, binding = 4, rgba16f) uniform restrict readonly image2D previous_history;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D taa_history;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D display;

vec3 ycocg(vec3 c) { return vec3(dot(c, vec3(0.25, 0.5, 0.25)), dot(c, vec3(0.5, 0.0, -0.5)), dot(c, vec3(-0.25, 0.5, -0.25))); }
vec3 rgb(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

// The nearest surface decides, so that silhouettes move with the object in front; of background alone the pixel's own.
vec2 nearest_motion(ivec2 p) {
    ivec2 nearest = p;
    float nearest_depth = uintBitsToFloat(0x7f800000u);  // infinity
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            // Beyond the border the pixel on it counts once more, which changes nothing.
            ivec2 q = nearest_inside(p + ivec2(x, y));
            float z = guide_depth(GuideBits(imageLoad(guide, q)));
            bool nearer = z > 0.0 && z < nearest_depth;
            nearest = nearer ? q : nearest;
            nearest_depth = nearer ? z : nearest_depth;
        }
    return unpack_surface_motion(texelFetch(surface_motion, nearest, 0)).motion;
}

vec4 catmull_rom_weights(float t) {
    float t2 = t * t, t3 = t2 * t;
    return vec4(-0.5 * t3 + t2 - 0.5 * t, 1.5 * t3 - 2.5 * t2 + 1.0, -1.5 * t3 + 2.0 * t2 + 0.5 * t, 0.5 * t3 - 0.5 * t2);
}

vec3 history_at(vec2 position) {
    vec2 corner = floor(position - 0.5);
    vec2 f = position - 0.5 - corner;
    vec4 wx = catmull_rom_weights(f.x), wy = catmull_rom_weights(f.y);
    ivec2 last = ivec2(frame.previous_render_extent) - 1;
    vec3 sum = vec3(0.0);
    [[unroll]] for (int y = 0; y < 4; ++y) {
        vec3 row = vec3(0.0);
        [[unroll]] for (int x = 0; x < 4; ++x)
            row += wx[x] * imageLoad(previous_history, clamp(ivec2(corner) + ivec2(x, y) - 1, ivec2(0), last)).rgb;
        sum += wy[y] * row;
    }
    return max(sum, 0.0);
}

struct Neighbourhood {
    vec3 resolved;   // current colour at the pixel centre, jitter removed
    vec3 mean;       // YCoCg, of the box
    vec3 deviation;  // YCoCg, of the box
};

// Sharpness of the Gaussians, by squared pixels: that of the colour, and the wider one of the box.
const float COLOUR_SHARPNESS = 2.29;
const float BOX_SHARPNESS = 1.39;

Neighbourhood neighbourhood(ivec2 p) {
    vec3 sum = vec3(0.0), first = vec3(0.0), second = vec3(0.0);
    float weight_sum = 0.0, box_sum = 0.0;
    // Distances of the samples, by column and by row.
    vec3 dx = vec3(-1.0, 0.0, 1.0) + frame.jitter.x, dy = vec3(-1.0, 0.0, 1.0) + frame.jitter.y;
    vec3 wx = exp(-COLOUR_SHARPNESS * dx * dx), wy = exp(-COLOUR_SHARPNESS * dy * dy);
    vec3 bx = exp(-BOX_SHARPNESS * dx * dx), by = exp(-BOX_SHARPNESS * dy * dy);
    // Moments around the centre's colour: the difference of squares would cancel otherwise.
    vec3 centre = ycocg(texelFetch(tone_mapped, p, 0).rgb);
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 q = p + ivec2(x, y), tap = nearest_inside(q);
            vec3 c = texelFetch(tone_mapped, tap, 0).rgb;
            float exists = q == tap ? 1.0 : 0.0;
            float weight = exists * wx[x + 1] * wy[y + 1];
            sum += weight * c;
            weight_sum += weight;
            c = ycocg(c) - centre;
            weight = exists * bx[x + 1] * by[y + 1];
            first += weight * c;
            second += weight * c * c;
            box_sum += weight;
        }
    first /= box_sum;
    return Neighbourhood(sum / weight_sum, centre + first, sqrt(max(second / box_sum - first * first, 0.0)));
}

// Half a step of an 8-bit display in the middle. Less is the rounding of halves, by which a grey neighbourhood, a box without any width
// in chroma, would lose its whole history.
const float SMALLEST_BOX = 1.0 / 512.0;

// Towards the mean and not per channel, which would shift the hue.
vec3 clip_to_box(vec3 history, Neighbourhood around) {
    vec3 offset = ycocg(history) - around.mean;
    vec3 extent = max(push.taa_gamma * around.deviation, max(SMALLEST_BOX * around.mean.x, 1e-6));
    vec3 ratio = abs(offset) / extent;
    return rgb(around.mean + offset / max(1.0, max(ratio.x, max(ratio.y, ratio.z))));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    Neighbourhood around = neighbourhood(p);
    vec3 colour = around.resolved;
    if (!has_flag(FLAG_RESET)) {
        vec2 position = previous_position(p, nearest_motion(p), frame.render_extent, frame.previous_render_extent);
        if (all(greaterThanEqual(position, vec2(0.0))) && all(lessThan(position, vec2(frame.previous_render_extent)))) {
            vec3 history = max(clip_to_box(history_at(position), around), 0.0);
            float weight_new = push.taa_alpha / (1.0 + luminance(colour));
            float weight_old = (1.0 - push.taa_alpha) / (1.0 + luminance(history));
            colour = (weight_new * colour + weight_old * history) / (weight_new + weight_old);
        }
    }
    imageStore(taa_history, p, vec4(storable(colour), 1.0));
    imageStore(display, p, vec4(storable(colour), 1.0));
}
