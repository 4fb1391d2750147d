#version 450
// Temporal upscaling: jittered frames of the past and this one, gathered at the size of the output. At ratio 1 temporal anti-aliasing.
// Source: [Karis 2014] High Quality Temporal Supersampling; the clip is the variance clip of [Salvi 2016] in YCoCg.
// Ours: the history is radiance divided by the light around, so that light that changes causes no lag; and it knows its weight.
// In:  radiance of surfaces, of a volume, or of both, which are added; albedo of the host; guide; surface_motion, or where
//      SURFACE_ID is defined depth and motion of the host, since light has fewer pixels; upscale_history. All but the last one per
//      rendered pixel, linear Rec. 709.
// Out: upscale_history and upscaled_radiance, per pixel of the output.
// Constant SHOWN: a tone map follows, so means are those of a display.
// variants: FLOAT=0 FLOAT=1
// variants: FLOAT=0,SURFACE_ID=0 FLOAT=0,SURFACE_ID=1 FLOAT=1,SURFACE_ID=0 FLOAT=1,SURFACE_ID=1
// optional: radiance_1, albedo, motion, instance_transforms
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool SHOWN = false;

layout(push_constant) uniform Push {
    uint present;
    uint tone_curve;
    float exposure;
    float taa_alpha;
    float taa_gamma;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "surface_motion.glsl"
#include "outgoing.glsl"
#include "demodulation.glsl"
#include "cubic.glsl"
#include "upscale_history.glsl"

layout(local_size_x = 32, local_size_y = 2) in;

#ifdef SURFACE_ID
#include "statistics.glsl"
const uint RADIANCE_0 = 10u;
const uint MOTION = 5u;
const uint INSTANCE_TRANSFORMS = 9u;
const uint SURFACE_ID_IMAGE = 11u;
#else
const uint RADIANCE_0 = 1u;
#endif
const uint RADIANCE_1 = 2u;
const uint ALBEDO = 3u;
const uint DEPTH = 4u;
const uint UPSCALED_RADIANCE = 8u;

layout(set = 0, binding = RADIANCE_0) uniform texture2D radiance_0;
layout(set = 0, binding = RADIANCE_1) uniform texture2D radiance_1;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
// Storage images where neighbours are read, for the reasons that packed_image.glsl has.
#ifdef SURFACE_ID
layout(set = 0, binding = DEPTH) uniform texture2D depth;
layout(set = 0, binding = MOTION) uniform texture2D motion;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;
#if SURFACE_ID
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;
#endif
#else
layout(set = 0, binding = DEPTH, rgba16ui) uniform restrict readonly uimage2D guide;
layout(set = 0, binding = 5) uniform utexture2D surface_motion;
#endif
layout(set = 0, binding = 6, rgba16ui) uniform restrict readonly uimage2D previous_upscale_history;
layout(set = 0, binding = 7, rgba16ui) uniform writeonly uimage2D upscale_history;
layout(set = 0, binding = UPSCALED_RADIANCE, OUTGOING_FORMAT) uniform writeonly image2D upscaled_radiance;

#ifdef SURFACE_ID
#include "surface_id.glsl"
#include "host_motion.glsl"
#endif

// Of a rendered pixel; 0: background.
float depth_at(ivec2 p) {
#ifdef SURFACE_ID
    return host_depth_at(p);
#else
    return guide_depth(GuideBits(imageLoad(guide, p)));
#endif
}

// Of the surface of a rendered pixel at a depth.
SurfaceMotion motion_at(ivec2 p, float depth) {
#ifdef SURFACE_ID
    return motion_of(p, depth, id_at(p), vec3(0.0, 0.0, 1.0));
#else
    return unpack_surface_motion(texelFetch(surface_motion, p, 0));
#endif
}

// Weight of a frame without any sample close by.
const float LEAST_WEIGHT = 0.02;
// The longest past of what stands still, over that of what moves.
const float STILL_PAST = 4.0;
// Falls to half at a seventeenth of a pixel of the output.
const float STILL_SHARPNESS = 200.0;
// Largest difference of depth to a past of the same surface, as a share.
const float DEPTH_TOLERANCE = 0.05;

// That of the brightest light of the history, over the light around.
const float LEAST_EVENNESS = 1e-4;

#include "upscale_samples.glsl"

const int HIDDEN = 0;
const int PARTLY_VISIBLE = 1;
const int VISIBLE = 2;

vec3 uneven(vec3 even) { return even / max(1.0 - luminance(even), LEAST_EVENNESS); }

struct Past {
    vec3 colour;
    vec3 around;  // mean of its texels, where a tone map follows
    float weight;
    int visibility;
};

// The history at a position, in this light. rgb by Catmull and Rom, which blurs less from frame to frame. Within its texels, since beside a
// lamp negative weights would take all light from what is dark. The weight bilinearly.
// Visibility says how far its texels belong to a surface at this depth: all of 2x2, or one of 4x4, since jitter hides what is thin in every
// other frame.
Past past_at(vec2 position, vec3 light, float expected) {
    vec2 corner = floor(position - 0.5), f = position - 0.5 - corner;
    vec4 wx = cubic_weights(f.x), wy = cubic_weights(f.y);
    vec4 bx = vec4(0.0, 1.0 - f.x, f.x, 0.0), by = vec4(0.0, 1.0 - f.y, f.y, 0.0);
    ivec2 last = ivec2(frame.previous_output_extent) - 1;
    vec4 gx = exp(-BOX_SHARPNESS * (vec4(-1.0, 0.0, 1.0, 2.0) - f.x) * (vec4(-1.0, 0.0, 1.0, 2.0) - f.x));
    vec4 gy = exp(-BOX_SHARPNESS * (vec4(-1.0, 0.0, 1.0, 2.0) - f.y) * (vec4(-1.0, 0.0, 1.0, 2.0) - f.y));
    vec3 mean = vec3(0.0);
    vec3 sum = vec3(0.0), least = vec3(NOWHERE), most = vec3(0.0);
    float weight = 0.0;
    bool some = false, whole = true;
    [[unroll]] for (int y = 0; y < 4; ++y)
        [[unroll]] for (int x = 0; x < 4; ++x) {
            ivec2 q = clamp(ivec2(corner) + ivec2(x, y) - 1, ivec2(0), last);
            UpscaleHistory texel = unpack_upscale_history(imageLoad(previous_upscale_history, q));
            sum += wx[x] * wy[y] * texel.even;
            if (SHOWN) mean += gx[x] * gy[y] * texel.even;
            least = min(least, texel.even);
            most = max(most, texel.even);
            weight += bx[x] * by[y] * texel.weight;
            bool same = expected > 0.0 ? abs(texel.depth - expected) <= DEPTH_TOLERANCE * expected : texel.depth == 0.0;
            some = some || same;
            whole = whole && (same || x == 0 || x == 3 || y == 0 || y == 3);
        }
    sum = clamp(sum, least, most);
    mean /= dot(gx, vec4(1.0)) * dot(gy, vec4(1.0));
    return Past(uneven(sum) * light, uneven(mean), max(weight, 0.0), !some ? HIDDEN : whole ? VISIBLE : PARTLY_VISIBLE);
}

// Half a step of an 8-bit display in the middle. Less is the rounding of halves, by which a grey neighbourhood, a box without any width
// in chroma, would lose its whole history.
const float SMALLEST_BOX = 1.0 / 512.0;

// The box where the history was divided by light, over that where it was not.
const float SHOWN_BOX = 3.0;
// The widest box, in deviations, where the past lies beside another surface: what was just uncovered would keep that one's colour.
const float WIDEST_BESIDE = 1.5;

// Means that differ by less are noise or edges: in deviations, and as a share of the mean.
const float SAME_DEVIATION = 0.5;
const float SAME_SHARE = 0.1;

// What the light around changed by, where nothing was divided by it: from none of it to all, at twice the difference that is none.
vec3 change_of_light(Past before, Neighbourhood around) {
    vec3 offset = ycocg(before.around * evenness(before.around)) - around.mean;
    vec3 ratio = abs(offset) / max(SAME_DEVIATION * around.deviation, max(SAME_SHARE * around.mean.x, 1e-6));
    return offset * clamp(max(ratio.x, max(ratio.y, ratio.z)) - 1.0, 0.0, 1.0);
}

// Towards the mean and not per channel, which would shift the hue.
vec3 clip_to_box(Past before, Neighbourhood around) {
    vec3 offset = ycocg(before.colour * evenness(before.colour)) - around.mean;
    vec3 change = SHOWN ? change_of_light(before, around) : vec3(0.0);
    offset -= change;
    // Light that changes is for the box to find where nothing was divided by it.
    float gamma = SHOWN ? push.taa_gamma / SHOWN_BOX : push.taa_gamma;
    if (before.visibility == PARTLY_VISIBLE) gamma = min(gamma, WIDEST_BESIDE);
    vec3 extent = max(gamma * around.deviation, max(SMALLEST_BOX * around.mean.x, 1e-6));
    vec3 ratio = abs(offset) / extent;
    float excess = max(ratio.x, max(ratio.y, ratio.z));
    if (excess <= 1.0 && change == vec3(0.0)) return before.colour;
    vec3 clipped = max(rgb(around.mean + offset / max(excess, 1.0)), 0.0);
    return clipped / max(1.0 - steepness() * luminance(clipped), 1e-4);
}

// Weight of the past: what moves is resampled in every frame, and blurs.
float past_limit(vec2 moved) {
    float moving = 1.0 / push.taa_alpha - 1.0;
    return moving * mix(1.0, STILL_PAST, exp(-STILL_SHARPNESS * dot(moved, moved)));
}

void write(ivec2 p, Neighbourhood around) {
    vec3 colour = around.first.rgb / around.first.a;
    float past = 0.0;
    if (!has_flag(FLAG_RESET)) {
        SurfaceMotion m = motion_at(around.nearest, around.depth);
        vec2 moved = m.motion * extent_ratio(frame.previous_render_extent, frame.previous_output_extent);
        vec2 position = previous_position(p, moved, frame.output_extent, frame.previous_output_extent);
        bool inside = all(greaterThanEqual(position, vec2(0.0))) && all(lessThan(position, vec2(frame.previous_output_extent)));
        Past before = past_at(position, around.light, around.depth * (1.0 + m.depth_ratio));
        if (inside && before.visibility != HIDDEN) {
            vec3 history = clip_to_box(before, around);
            vec2 wider = extent_ratio(frame.output_extent, frame.previous_output_extent);
            past = min(before.weight * wider.x * wider.y, past_limit(moved));
            vec4 now = mix(around.first, around.later, min(past, 1.0)) * (around.weight + LEAST_WEIGHT);
            vec4 sum = now + past * share_of(history) * vec4(history, 1.0);
            colour = sum.rgb / sum.a;
        }
    }
    vec3 ratio = colour / around.light;
    UpscaleHistory kept = UpscaleHistory(ratio / (1.0 + luminance(ratio)), past + around.weight, around.depth);
    imageStore(upscale_history, p, pack_upscale_history(kept));
    imageStore(upscaled_radiance, host_pixel(UPSCALED_RADIANCE, p), vec4(outgoing(colour * frame.inverse_filter_exposure), 1.0));
}

void main() {
    ivec2 top = ivec2(gl_GlobalInvocationID.xy) * ivec2(1, COLUMN);
    if (any(greaterThanEqual(top, ivec2(frame.output_extent)))) return;
    Neighbourhood around[COLUMN];
    gather(top, around);
    [[unroll]] for (int k = 0; k < COLUMN; ++k)
        if (top.y + k < int(frame.output_extent.y)) write(top + ivec2(0, k), around[k]);
}
