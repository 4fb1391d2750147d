#version 450
// Temporal upscaling: jittered frames of the past and this one, gathered at the size of the output. At ratio 1 temporal anti-aliasing.
// Source: [Karis 2014] High Quality Temporal Supersampling; the clip is the variance clip of [Salvi 2016] in YCoCg.
// Ours: the history is radiance divided by the light around, so that light that changes causes no lag; and it knows its weight.
// In:  radiance of surfaces, of a volume, or of both, which are added; albedo of the host; guide; surface_motion, or where
//      SURFACE_ID is defined the host's motion, of which every rendered pixel has none else; upscale_history. All but the last one per
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

layout(local_size_x = 8, local_size_y = 8) in;

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
const uint UPSCALED_RADIANCE = 8u;

layout(set = 0, binding = RADIANCE_0) uniform texture2D radiance_0;
layout(set = 0, binding = RADIANCE_1) uniform texture2D radiance_1;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
// Storage images where neighbours are read, for the reasons that packed_image.glsl has.
layout(set = 0, binding = 4, rgba16ui) uniform restrict readonly uimage2D guide;
#ifdef SURFACE_ID
layout(set = 0, binding = MOTION) uniform texture2D motion;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;
#if SURFACE_ID
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;
#endif
#else
layout(set = 0, binding = 5) uniform utexture2D surface_motion;
#endif
layout(set = 0, binding = 6, rgba16ui) uniform restrict readonly uimage2D previous_upscale_history;
layout(set = 0, binding = 7, rgba16ui) uniform writeonly uimage2D upscale_history;
layout(set = 0, binding = UPSCALED_RADIANCE, OUTGOING_FORMAT) uniform writeonly image2D upscaled_radiance;

#ifdef SURFACE_ID
#include "surface_id.glsl"
#include "host_motion.glsl"
#endif

// Of the surface of a rendered pixel at a depth.
SurfaceMotion motion_at(ivec2 p, float depth) {
#ifdef SURFACE_ID
    return motion_of(p, depth, id_at(p), vec3(0.0, 0.0, 1.0));
#else
    return unpack_surface_motion(texelFetch(surface_motion, p, 0));
#endif
}

// Sharpness of the Gaussian of samples: of a first picture, by squared rendered pixels; of one with a past, by squared pixels of the output.
const float SHARPNESS = 2.29;
// That of the light around and of the box which clips the past, by squared rendered pixels.
const float BOX_SHARPNESS = 0.5;
// Share of the first one's that every later picture has, since few pixels of the output have a sample close by.
const float LEAST_SHARE = 1e-3;
// Weight of a frame without any sample close by.
const float LEAST_WEIGHT = 0.02;
// Light of the filter that is as good as none: with it nothing is divided by 0.
const float DARKNESS = 0.01;
// The longest past of what stands still, over that of what moves.
const float STILL_PAST = 4.0;
// Falls to half at a seventeenth of a pixel of the output.
const float STILL_SHARPNESS = 200.0;
// Largest difference of depth to a past of the same surface, as a share.
const float DEPTH_TOLERANCE = 0.05;

// That of the brightest light of the history, over the light around.
const float LEAST_EVENNESS = 1e-4;
// Beyond any light, so that sums and quotients are finite.
const float BRIGHTEST_SAMPLE = 1e30;
// Beyond any depth.
const float NOWHERE = 3e38;

vec3 ycocg(vec3 c) { return vec3(dot(c, vec3(0.25, 0.5, 0.25)), dot(c, vec3(0.5, 0.0, -0.5)), dot(c, vec3(-0.25, 0.5, -0.25))); }
vec3 rgb(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

// As ToneCurve in src/contract/tuning.rs.
const uint CURVE_ACES = 0u;
const uint CURVE_LINEAR = 2u;
// The curve of ACES is so much steeper in the dark than x/(1 + x).
const float ACES_STEEPNESS = 4.0;

// From the filter's exposure to that of the display.
float display_exposure() { return SHOWN ? push.exposure * frame.inverse_filter_exposure : 1.0; }

float steepness() {
    float shown = push.tone_curve == CURVE_LINEAR ? 0.0 : display_exposure() * (push.tone_curve == CURVE_ACES ? ACES_STEEPNESS : 1.0);
    return SHOWN ? shown : 1.0;
}

// What a curve without a shoulder shows as white is as bright as all beyond: an edge of a lamp would stay jagged.
float brightest_sample() { return SHOWN && push.tone_curve == CURVE_LINEAR ? min(1.0 / display_exposure(), BRIGHTEST_SAMPLE) : BRIGHTEST_SAMPLE; }

// A bright sample counts less [Karis 2014]: as if means were taken of c/(1 + luminance).
float evenness(vec3 c) { return 1.0 / (1.0 + steepness() * luminance(c)); }

struct Sample {
    vec3 radiance;    // in the filter's exposure
    vec3 irradiance;
    float depth;      // 0: background
};

Sample sample_at(ivec2 q) {
    vec3 radiance = texelFetch(radiance_0, host_pixel(RADIANCE_0, q), 0).rgb;
    if (is_present(RADIANCE_1)) radiance += texelFetch(radiance_1, host_pixel(RADIANCE_1, q), 0).rgb;
    Sample s;
    s.radiance = clamp(exposed(radiance), 0.0, brightest_sample());
    s.irradiance = clamp(exposed(radiance), 0.0, BRIGHTEST_SAMPLE);
    s.depth = guide_depth(GuideBits(imageLoad(guide, q)));
    if (is_present(ALBEDO) && s.depth > 0.0) s.irradiance /= divisor_of(texelFetch(albedo, host_pixel(ALBEDO, q), 0).rgb);
    return s;
}

struct Neighbourhood {
    vec3 first, later;  // colours over evenness, for a first picture and for one with a past
    float first_evenness, later_evenness;
    float weight;       // of the samples close by
    vec3 light;         // irradiance around
    vec3 mean, deviation;  // YCoCg of colours times evenness
    ivec2 nearest;      // pixel of the nearest surface
    float depth;        // its depth; 0: background alone
};

// Position of a pixel of the output among rendered pixels.
vec2 rendered_position(ivec2 p) { return (vec2(p) + 0.5) * extent_ratio(frame.output_extent, frame.render_extent); }

Neighbourhood neighbourhood(ivec2 p) {
    vec2 centre = rendered_position(p);
    ivec2 middle = ivec2(floor(centre - frame.jitter));
    vec2 offset = vec2(middle) + 0.5 + frame.jitter - centre;  // of the nearest sample
    vec3 dx = offset.x + vec3(-1.0, 0.0, 1.0), dy = offset.y + vec3(-1.0, 0.0, 1.0);
    vec2 scale = extent_ratio(frame.render_extent, frame.output_extent);
    vec3 bx = exp(-BOX_SHARPNESS * dx * dx), by = exp(-BOX_SHARPNESS * dy * dy);
    vec3 fx = exp(-SHARPNESS * dx * dx), fy = exp(-SHARPNESS * dy * dy);
    dx *= scale.x;
    dy *= scale.y;
    vec3 lx = exp(-SHARPNESS * dx * dx), ly = exp(-SHARPNESS * dy * dy);

    Neighbourhood around;
    around.first = around.later = around.light = around.mean = around.deviation = vec3(0.0);
    around.first_evenness = around.later_evenness = around.weight = 0.0;
    around.nearest = nearest_inside(middle);
    float total = 0.0, box_total = 0.0, light_total = 0.0, depth = NOWHERE;
    // Moments around one of the colours: the difference of squares would cancel otherwise.
    vec3 pivot = clamp(exposed(texelFetch(radiance_0, host_pixel(RADIANCE_0, around.nearest), 0).rgb), 0.0, brightest_sample());
    pivot = ycocg(pivot * evenness(pivot));
    [[unroll]] for (int y = 0; y < 3; ++y)
        [[unroll]] for (int x = 0; x < 3; ++x) {
            ivec2 q = middle + ivec2(x, y) - 1, tap = nearest_inside(q);
            Sample s = sample_at(tap);
            float exists = q == tap ? 1.0 : 0.0, even = evenness(s.radiance);
            vec3 colour = s.radiance * even;
            float first = exists * fx[x] * fy[y], later = exists * lx[x] * ly[y];
            around.first += first * colour;
            around.first_evenness += first * even;
            around.later += later * colour;
            around.later_evenness += later * even;
            around.weight += later;
            total += first;
            vec3 c = ycocg(colour) - pivot;
            float box = exists * bx[x] * by[y];
            around.mean += box * c;
            around.deviation += box * c * c;
            float lit = box / (1.0 + luminance(s.irradiance));
            around.light += lit * s.irradiance;
            light_total += lit;
            box_total += box;
            bool nearer = s.depth > 0.0 && s.depth < depth;
            around.nearest = nearer ? tap : around.nearest;
            depth = nearer ? s.depth : depth;
        }
    around.depth = depth == NOWHERE ? 0.0 : depth;
    around.first /= total;
    around.first_evenness /= total;
    float share = 1.0 / (around.weight + LEAST_SHARE);
    around.later = (around.later + LEAST_SHARE * around.first) * share;
    around.later_evenness = (around.later_evenness + LEAST_SHARE * around.first_evenness) * share;
    // Means of a display have white in them, by which no light divides.
    around.light = SHOWN ? vec3(1.0) : around.light / light_total + DARKNESS;
    around.mean /= box_total;
    around.deviation = sqrt(max(around.deviation / box_total - around.mean * around.mean, 0.0));
    around.mean += pivot;
    return around;
}

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

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, ivec2(frame.output_extent)))) return;
    Neighbourhood around = neighbourhood(p);
    vec3 colour = around.first / around.first_evenness;
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
            float known = min(past, 1.0), even = evenness(history), now = around.weight + LEAST_WEIGHT;
            vec3 new_colour = mix(around.first, around.later, known) * now;
            float new_evenness = mix(around.first_evenness, around.later_evenness, known) * now;
            colour = (new_colour + past * even * history) / (new_evenness + past * even);
        }
    }
    vec3 ratio = colour / around.light;
    UpscaleHistory kept = UpscaleHistory(ratio / (1.0 + luminance(ratio)), past + around.weight, around.depth);
    imageStore(upscale_history, p, pack_upscale_history(kept));
    imageStore(upscaled_radiance, host_pixel(UPSCALED_RADIANCE, p), vec4(outgoing(colour * frame.inverse_filter_exposure), 1.0));
}
