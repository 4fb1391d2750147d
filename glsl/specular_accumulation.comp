#version 450
// Blends what is seen in glossy surfaces with its own past, looked up where the surface was and where the image behind it was.
// Source: virtual motion of reflections [Zimmer et al. 2015]; two reprojections of which the better one counts [Stachowiak 2015]; the blend is
// that of [SVGF] 4.1. How much each past is worth is ours: as many frames as it takes until its error in pixels passes the width of the lobe, or
// its error in light the noise of a sample. Without hit distances the image is sought where that of a thing at infinity was.
// In:  guide (current, previous), surface_motion; noisy: specular irradiance, hit distance; roughness of the host; history and
//      moments of the previous frame, and its reflection; history_confidence as in temporal_accumulation.comp; by which instances the mirror
//      and the thing in it move: specular_hit_id, surface_id, instance_transforms; or the thing by the host: specular_motion, scene units.
//      Of mixed light: albedo and specular_albedo, which tell how much of it a lobe explains; light_ratio, of what is no image. material_class.
// Out: statistics; accumulated: irradiance, history length; new_luminance; reflection: filtered hit distance (scene units), roughness, which past was taken.
// Constants: FILTERED: what is accumulated was filtered, so that what is kept longer is blurred more often.
// MIXED: diffuse and specular light are one signal. The lobe is as wide as both together allow, and a past counts by how far it is off for the
// part of the light that moves otherwise.
// BESIDE_DIFFUSE: history_confidence has that of specular light, or of images in mixed light, in its last bits. STRATUM_SIZE: with light_ratio.
// SHARP: irradiance by the cubic of Catmull and Rom (1974) over 4x4 taps, so that motion does not blur it; taps count as far as normals agree.
// optional: roughness, history_confidence, specular_hit_id, specular_motion, surface_id, instance_transforms, albedo, specular_albedo, material_class, light_ratio
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Of storage images in packed_image.glsl.
#define SIGNALS 1

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool FILTERED = false;
layout(constant_id = 2) const bool SHARP = false;
layout(constant_id = 3) const bool MIXED = false;
layout(constant_id = 4) const bool BESIDE_DIFFUSE = false;

layout(push_constant) uniform Push {
    uint present;
    float alpha;
    float alpha_moments;
    float max_history_length;
    float depth_tolerance;
    float normal_tolerance;
} push;

#include "both_confidences.glsl"
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "packed_image.glsl"
#include "surface_motion.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "history_blend.glsl"
#include "surface_test.glsl"
#include "view_position.glsl"
#include "forward_projection.glsl"
#include "roughness.glsl"
#include "reflection.glsl"
#include "cubic.glsl"
#include "demodulation.glsl"

const uint ROUGHNESS = 6u;
const uint HISTORY_CONFIDENCE = 7u;
const uint SPECULAR_HIT_ID = 14u;
const uint SURFACE_ID = 15u;
const uint INSTANCE_TRANSFORMS = 16u;
const uint SPECULAR_MOTION = 18u;
const uint ALBEDO = 19u;
const uint SPECULAR_ALBEDO = 20u;
const uint MATERIAL_CLASS = 21u;
const uint LIGHT_RATIO = 22u;

layout(set = 0, binding = 2) uniform utexture2D previous_guide;
layout(set = 0, binding = 3) uniform utexture2D surface_motion;
layout(set = 0, binding = 5) uniform texture2D noisy;
layout(set = 0, binding = ROUGHNESS) uniform texture2D roughness;
layout(set = 0, binding = HISTORY_CONFIDENCE) uniform texture2D history_confidence;
layout(set = 0, binding = 8) uniform texture2D history;
layout(set = 0, binding = 9) uniform utexture2D previous_luminance_history;
layout(set = 0, binding = 10) uniform utexture2D previous_reflection;
layout(set = 0, binding = 11, rgba16f) uniform writeonly image2D accumulated;
layout(set = 0, binding = 12, r32ui) uniform writeonly uimage2D new_luminance;
layout(set = 0, binding = 13, r32ui) uniform writeonly uimage2D reflection;
PACKED_IMAGE(17, guide);
layout(set = 0, binding = SPECULAR_HIT_ID) uniform utexture2D specular_hit_id;
layout(set = 0, binding = SPECULAR_MOTION) uniform texture2D specular_motion;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = SPECULAR_ALBEDO) uniform texture2D specular_albedo;
layout(set = 0, binding = MATERIAL_CLASS) uniform utexture2D material_class;
layout(set = 0, binding = LIGHT_RATIO) uniform texture2D light_ratio;
layout(set = 0, binding = SURFACE_ID) uniform utexture2D surface_id;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;

#include "scenery.glsl"
#include "material.glsl"
#include "ratio_at_pixel.glsl"

Material material;

// The surface of a pixel, with what is expected of it in the previous frame.
struct Centre {
    Mirror mirror;
    float depth;
    Expected expected;  // of the surface in the previous frame, at its position
    float origin;       // of contrast: luminance_origin
    vec3 ratio;         // by which its history is scaled
};

// Pixels: a picture that moves by as much from frame to frame does not stand still.
const float STILL = 0.01;
// Radians: seen from a side that turns by as much from frame to frame, what a lobe gathers does not stand still.
const float TURNED = 1e-3;
// Of a past that is sure, the smallest weight of the new sample, as a share of that of others: a mirror is accumulated and not filtered, so that
// all noise of what it shows is left to its history.
const float STEADY_ALPHA = 0.4;

// Pixels that a past may be off in each frame where no lobe blurs it.
const float SHARPEST = 0.5;
// Pixels that a past may be off: a lobe of four and more blurs what it shows by more than bilinear taps do.
const float BLURRED_ANYWAY = 2.5;

// Of a pixel, to which a position is rounded before 4x4 taps are looked up: which of them count is then no matter of the last bit.
const float LOOKUP_STEPS = 256.0;
// Nor is then which of 2x2 taps are in the range of a past.
const float LEAST_IN_RANGE = 0.5 / LOOKUP_STEPS;

// Of light that is mixed, the share that a lobe explains where nobody says how much base and coat reflect.
const float UNKNOWN_SHARE = 0.5;

// Depths to a thing whose hit distance nobody knows: what is far away, or in a curved mirror, is seen next to where this is.
const float UNKNOWN_REACH = 1e4;

// The same of the nearest thing that a surface may show.
const float NEAREST_REACH = 0.125;

// Of the difference between the reach of a past and that of a pixel, whose own may be chance at an edge.
const float OWN_DIFFERENCE = 0.35;
// The least that a tap counts which shows another thing.
const float LEAST_LIKE = 1e-3;
// Standard deviations of a past that are noise; twice as many are another thing.
const float NOISE_OF_PAST = 2.0;
// By noise alone, the variance of the means of taps over that of a sample, as a ratio of light to base 2: ln(2)² for the base, and a third.
const float NOISE_OF_MEANS = 0.16;

// What the past holds at one position.
struct Past {
    bool found;
    float frames;
    float nearness;  // mean of hit distance / (depth + hit distance)
    float reach;     // the same, 1 where the hit distance is unknown
    float roughness;
    float image_share;  // as unpack_image_share
    float contrast;     // variance of the means of its taps
    History light;
};

#include "light_agreement.glsl"
#include "image_evidence.glsl"

Centre centre_of(ivec2 p, GuideBits packed, float origin) {
    SurfaceMotion m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    vec2 gradient = guide_gradient(packed);
    Expected expected = with_tolerances(expected_surface(packed, m, gradient, m.previous_normal), material.depth, material.normal);
    return Centre(mirror_at(p, packed, m.motion), guide_depth(packed), expected, origin, vec3(1.0));
}

// As nearness_of, where what nobody knows may be beyond the scene.
float reach_of(float linear_depth, float hit_distance) { return hit_distance > 0.0 ? nearness_of(linear_depth, hit_distance) : 1.0; }

// Weight of a hit distance one pixel away, and the least at which a pixel may show what is seen there, by the radius of its lobe.
const float SMALLEST_ASIDE = 0.01;
float weight_aside(float radius) { return exp2(-min(1.0 / max(radius * radius, 1e-6), 64.0)); }

// Hit distance of this frame, over as many of 3x3 pixels as the lobe blurs. `own`: negative where there is no sample. `reaches`: the least and the
// greatest there.
float hit_distance_now(Centre c, float own, float roughness, out vec2 reaches) {
    float aside = weight_aside(lobe_radius(c.depth, Reflection(max(own, 0.0), roughness)));
    vec2 sum = vec2(0.0);
    float known = 0.0, unknown = 0.0;
    reaches = vec2(1.0, 0.0);
    // Registers are scarce here: unrolled, its taps would all be in flight at once.
    [[dont_unroll]] for (int y = -1; y <= 1; ++y)
        [[dont_unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 q = c.mirror.p + ivec2(x, y), tap = nearest_inside(q);
            float distance = texelFetch(noisy, tap, 0).a;
            GuideBits packed = GuideBits(packed_at(guide, tap));
            bool same = q == tap && distance >= 0.0 && guide_depth(packed) != 0.0 && guide_id(packed) == guide_id(c.mirror.packed);
            float reach = reach_of(guide_depth(packed), distance);
            float weight = same && distance > 0.0 ? (x == 0 ? 1.0 : aside) * (y == 0 ? 1.0 : aside) : 0.0;
            sum += weight * vec2(reach, 1.0);
            known += float(same && distance > 0.0);
            unknown += float(same && distance == 0.0);
            reaches = same ? vec2(min(reaches.x, reach), max(reaches.y, reach)) : reaches;
        }
    if (reaches.x > reaches.y) reaches = vec2(0.0, 1.0);
    float mean = sum.y > 0.0 ? hit_distance_of(c.depth, sum.x / sum.y) : 0.0;
    // A mirror that shows nothing of known distance does not show what is seen beside it, unless that is most of what is around: a bad distance.
    return own == 0.0 && unknown > known && weight_aside(lobe_radius(c.depth, Reflection(mean, roughness))) < SMALLEST_ASIDE ? 0.0 : mean;
}

// Of a pixel that may lie far from where the surface was: on its plane.
bool is_same_surface(Centre c, ivec2 tap) {
    if (!is_inside_previous(tap)) return false;
    GuideBits packed = GuideBits(texelFetch(previous_guide, tap, 0));
    vec2 aside = vec2(tap) - c.mirror.surface_position;
    Expected there = c.expected;
    there.depth += dot(there.gradient, aside);
    float slack = 0.1 * length(aside) * (abs(there.gradient.x) + abs(there.gradient.y));
    return surface_refusal(packed, there, slack) == REASON_NONE && normal_refusal(guide_normal(packed), there) == REASON_NONE;
}

Past nothing() { return Past(false, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NO_HISTORY); }

float likeness(Centre c, ivec2 tap) {
    return SHARP ? normal_likeness(guide_normal(GuideBits(texelFetch(previous_guide, tap, 0))), c.expected) : 1.0;
}

// What is seen in a surface, and how much less a tap counts that shows something else, in powers of e per squared difference of reach.
struct Thing {
    float reach;
    float sharpness;
};

const Thing ANY_THING = Thing(0.0, 0.0);

Thing thing_of(float reach, float roughness) {
    float width = 0.05 + lobe_width(roughness);
    return Thing(reach, 2.0 * mirror_share(roughness) / (width * width));
}

float likeness_of(Thing thing, float reach) {
    float other = reach - thing.reach;
    return max(exp(-other * other * thing.sharpness), LEAST_LIKE);
}

// The tested 2x2 taps around a position, as a mean.
Past past_at(Centre c, vec2 position, Thing thing) {
    Past sum = nothing();
    // Of taps; as far as they show the same thing; and the same surface.
    float whole = 0.0, alike = 0.0, weights = 0.0;
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        vec2 centre = floor(position) + vec2(i & 1, i >> 1), tent = 1.0 - abs(position - centre);
        ivec2 tap = ivec2(centre);
        float weight = tent.x * tent.y;
        if (!(weight > 0.0) || !is_same_surface(c, tap)) continue;
        whole += weight;
        LuminanceHistory m = unpack_luminance_history(texelFetch(previous_luminance_history, tap, 0).x);
        if (weight >= LEAST_IN_RANGE) widen_range(sum.light, m.mean);
        uint packed = texelFetch(previous_reflection, tap, 0).x;
        Reflection r = unpack_reflection(packed);
        float image_share = unpack_image_share(packed);
        float reach = reach_of(c.depth, r.hit_distance);
        weight *= likeness_of(thing, reach);
        alike += weight;
        weight *= likeness(c, tap);
        weights += weight;
        sum.frames += weight * m.history_length;
        sum.nearness += weight * nearness_of(c.depth, r.hit_distance);
        sum.reach += weight * reach;
        sum.roughness += weight * r.roughness;
        sum.image_share += weight * (image_share == NO_PAST ? CHANCE_AT_FIRST : image_share);
        add_history(sum.light, texelFetch(history, tap, 0).rgb, m, weight);
        float aside = m.mean - c.origin;
        sum.contrast += weight * aside * aside;
    }
    if (whole < SMALLEST_WEIGHT_SUM) return nothing();
    float scale = 1.0 / weights;
    History light = scaled(sum.light, scale);
    float aside = light.mean - c.origin, contrast = max(0.0, sum.contrast * scale - aside * aside);
    return Past(true, sum.frames / alike, sum.nearness * scale, sum.reach * scale, sum.roughness * scale, sum.image_share * scale, contrast, light);
}

// Irradiance by the cubic; false where one of 4x4 taps that count is another surface, or the position lies on a pixel.
bool sharp_irradiance(Centre c, vec2 position, out vec3 irradiance) {
    vec2 at = floor(position * LOOKUP_STEPS + 0.5) / LOOKUP_STEPS, corner = floor(at), f = at - corner;
    vec4 x_weights = cubic_weights(f.x), y_weights = cubic_weights(f.y);
    bool whole = f != vec2(0.0);
    irradiance = vec3(0.0);
    [[dont_unroll]] for (int i = 0; i < 16 && whole; ++i) {
        ivec2 tap = ivec2(corner) + ivec2(i % 4, i / 4) - 1;
        float weight = x_weights[i % 4] * y_weights[i / 4];
        whole = weight == 0.0 || is_same_surface(c, tap);
        irradiance += weight * texelFetch(history, nearest_inside_previous(tap), 0).rgb;
    }
    return whole;
}

// Whether the surface at a pixel of the previous frame mirrored the same thing: the lobe there holds the direction to it.
bool is_in_lobe(vec2 position, vec3 thing, float roughness) {
    ivec2 q = ivec2(floor(position + 0.5));
    if (!is_inside_previous(q)) return false;
    GuideBits packed = GuideBits(texelFetch(previous_guide, q, 0));
    float z = guide_depth(packed);
    if (z == 0.0) return false;
    vec3 at = previous_world_position(q, z).xyz, beyond = previous_world_position(q, 2.0 * z).xyz;
    vec3 mirrored = reflect(normalize(beyond - at), guide_normal(packed));
    vec3 difference = mirrored - normalize(thing - at);
    // Normals of the guide are rounded to half a degree, and a mirror doubles that.
    float tolerance = 0.06 + 2.0 * lobe_width(roughness);
    return dot(difference, difference) <= tolerance * tolerance;
}

// How sure it is by the light of a pixel that it shows another thing than its past: what differs by little does no harm, and what differs by more
// than the noise of the past is no chance. Between the two a sample may have met the other side of an outline.
float sureness_of_own(Centre c, Past past) {
    vec4 value = texelFetch(noisy, c.mirror.p, 0);
    if (value.a < 0.0) return 1.0;
    History light = in_light(past.light, vec3(1.0), frame.exposure_ratio);
    float now = luminance(value.rgb), then = max(luminance(light.irradiance), 0.0), difference = abs(now - then);
    float beyond = difference * inversesqrt(max(light.variance, 1e-12)) / NOISE_OF_PAST - 1.0;
    return max(1.0 - difference / max(now + then, 1e-6), clamp(beyond, 0.0, 1.0));
}

// By how much the reach of a past lies outside of what is seen now, or a part of how much it differs from that of the pixel alone, beside what
// is small for the lobe: another thing is seen there.
float other_thing(Centre c, Past past, float here, vec2 reaches, float roughness) {
    float own = OWN_DIFFERENCE * sureness_of_own(c, past) * abs(here - past.reach);
    float outside = max(max(reaches.x - past.reach, past.reach - reaches.y), own);
    return max(outside, 0.0) * mirror_share(roughness) / (0.05 + lobe_width(roughness));
}

// Frames that a past is worth whose content is `error` pixels off in each of them.
float worth(float frames, float error, float tolerance) { return min(frames, tolerance / max(error, 1e-4)); }

// `mirrored`: the part of the light that moves as an image does.
float change_at(ivec2 p, float mirrored) {
    if (!is_present(HISTORY_CONFIDENCE)) return 0.0;
    float confidence = texelFetch(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), 0).x;
    if (!BESIDE_DIFFUSE) return 1.0 - confidence;
    float of_image = 1.0 - specular_confidence(confidence);
    return MIXED ? mix(change_by(confidence), of_image, mirrored) : of_image;
}

Past mixed(Past a, Past b, float share) {
    History light = History(mix(a.light.irradiance, b.light.irradiance, share), mix(a.light.mean, b.light.mean, share),
                            mix(a.light.variance, b.light.variance, share),
                            vec2(min(a.light.range.x, b.light.range.x), max(a.light.range.y, b.light.range.y)));
    return Past(true, mix(a.frames, b.frames, share), mix(a.nearness, b.nearness, share), mix(a.reach, b.reach, share),
                mix(a.roughness, b.roughness, share), mix(a.image_share, b.image_share, share), mix(a.contrast, b.contrast, share), light);
}

// How sure it is that a past shows what is seen now, at most 1: of a mirror, whose image was followed, and of a picture that stands still before
// an eye that does. Where the eye moves around what stands still, light may change that a wide lobe gathers: half as much, as where history is
// filtered.
float steadiness_of(Centre c, float radius, vec2 image_position) {
    vec2 still = previous_position(c.mirror.p, vec2(0.0), frame.render_extent, frame.previous_render_extent) - 0.5;
    float moved = max(distance(image_position, still), distance(c.mirror.surface_position, still));
    vec3 sight = -normalize(previous_eye_from(c.mirror.position));
    float turned = FILTERED ? 1.0 : min(1.0, distance(sight, c.mirror.sight) / TURNED);
    return max(1.0 - radius, (1.0 - moved / STILL) * (1.0 - 0.5 * turned));
}

// A past that counts by the light of now, as `chance` tells how likely it is.
void count_by_light(Centre c, vec2 position, float chance, inout Past past) {
    ByLight told = by_light(c, position, past, AGREES_WIDEST, true);
    past.frames = chance * told.frames;
    float noise = told.noise < 0.0 ? past.contrast : NOISE_OF_MEANS * told.noise * past.light.mean * past.light.mean;
    past.light.variance += min(past.contrast, noise);
}

// The better of two pasts, or a blend of both, in the light of this frame; its frames are what it is worth. `hit_distance`: of this frame, then with its past.
// `unknown`: the roughness with which an unknown distance is tried. `reaches`: see hit_distance_now. `image_share`: of the blend, from where the
// image was; how likely that is where nobody knows the distance.
// `steadiness`: see steadiness_of.
Past best_past(Centre c, float roughness, float unknown, float explained, vec2 reaches, inout float hit_distance, out float image_share, out float steadiness) {
    float here = reach_of(c.depth, hit_distance);
    float radius = lobe_radius(c.depth, Reflection(hit_distance, roughness));
    bool is_known = hit_distance > 0.0;
    Thing thing = ANY_THING;
    if (is_known && !MIXED) thing = thing_of(here, roughness);
    Past surface = past_at(c, c.mirror.surface_position, thing);
    if (surface.found && surface.nearness > 0.0 && is_known) {
        // A lobe that covers pixels is blurred anyway, and its hits are noisy.
        float share = radius * radius / (1.0 + radius * radius) * surface.frames / (1.0 + surface.frames);
        hit_distance = hit_distance_of(c.depth, mix(nearness_of(c.depth, hit_distance), surface.nearness, share));
    }
    Reflection seen = Reflection(hit_distance, roughness);
    // What nobody knows is tried as a mirror, and the light of now tells.
    if (!is_known) seen = Reflection(UNKNOWN_REACH * c.depth, unknown);
    Curvature curvature = curvature_at(c.mirror);
    float share = mirror_share(seen.roughness);
    float tolerance = SHARPEST + 0.5 * lobe_radius(c.depth, Reflection(mirror_image_distance(seen.hit_distance, curvature.mean), seen.roughness));
    vec2 position = c.mirror.surface_position;
    bool told_by_light = !MIXED && !is_known;
    float chance = CHANCE_AT_FIRST;
    Past image = nothing();
    BadMotion bad;
    Scenery before = scenery_before(c.mirror, curvature, Reflection(hit_distance, roughness), bad);
    if (bad.transform) count_bad(BAD_HIT_ID);
    if (bad.motion) count_bad(BAD_SPECULAR_MOTION);
    if (!is_known) {
        // What lies at infinity is where it was, whatever the mirror did.
        before.mirror.position = previous_surface(c.mirror.surface_position, c.expected.depth);
        before.image = image_at_rest(seen.hit_distance);
    }
    bool found = virtual_position(c.mirror, curvature, before.mirror, before.image, seen.roughness, position);
    float moved = distance(position, c.mirror.surface_position);
    // The part of the light that moves as an image does.
    float mirrored = MIXED ? explained * share : 1.0;
    bool in_lobe = found && (!is_known || is_in_lobe(position, before.thing, seen.roughness));
    bool moves = found && moved > STILL;
    if (told_by_light && surface.found) chance = image_chance(c, moves, position, surface);
    // An image at the place of the surface tells nothing, and in mixed light it would blur the sharp past that is there.
    bool is_tried = MIXED ? in_lobe && moves : is_known ? in_lobe : moves && (!surface.found || chance > UNLIKELY);
    if (is_tried) image = past_at(c, position, before.followed ? ANY_THING : thing);
    if (!told_by_light) {
        vec2 nearest = position;
        if (MIXED && !is_known) {
            // The thing may be anywhere from there on.
            vec3 near = image_at_rest(NEAREST_REACH * c.depth);
            if (!virtual_position(c.mirror, curvature, before.mirror, near, seen.roughness, nearest)) nearest = position;
        }
        float least = min(moved, distance(nearest, c.mirror.surface_position));
        steadiness = found && !MIXED ? share * steadiness_of(c, radius, position) : 0.0;
        // Of mixed light, each past is off for the part of the other, and no lobe blurs what is diffuse.
        if (found) surface.frames = worth(surface.frames, mirrored * least, tolerance);
        float off = (1.0 - mirrored) * moved / SHARPEST + mirrored * distance(position, nearest) / tolerance;
        if (MIXED) image.frames = worth(image.frames, off, 1.0);
    } else {
        steadiness = 0.0;
        bool both = surface.found && image.found;
        if (surface.found) count_by_light(c, c.mirror.surface_position, both ? 1.0 - chance : 1.0, surface);
        if (image.found) count_by_light(c, position, both ? chance : 1.0, image);
    }
    if (surface.found && !MIXED) surface.frames = worth(surface.frames, other_thing(c, surface, here, reaches, roughness), 2.0);
    if (image.found && told_by_light) image.frames = worth(image.frames, other_thing(c, image, here, reaches, roughness), 2.0);
    if (image.found && is_known) {
        vec2 remembered = position;
        vec3 image_there = vec3(before.image.xy, hit_distance_of(c.depth, image.nearness));
        bool known = virtual_position(c.mirror, curvature, before.mirror, image_there, seen.roughness, remembered);
        image.frames = worth(image.frames, known ? distance(position, remembered) : 0.0, tolerance);
        // Another thing is seen there now, or another finish of the surface. Of a thing that was followed, lobes and outlines change the distance.
        // Of light that is mixed the roughness goes with the hit distance.
        float change = MIXED ? 0.0 : abs(seen.roughness - image.roughness) * 8.0;
        if (!before.followed) change += abs(nearness_of(c.depth, before.image.z) - image.nearness) * share / (0.05 + lobe_width(seen.roughness));
        image.frames = worth(image.frames, change, 2.0);
    }
    float a = surface.frames * surface.frames, b = image.frames * image.frames;
    image_share = !surface.found ? 1.0 : !image.found ? 0.0 : b / max(a + b, 1e-20);
    // Of the past that counts more alone, the image where both count the same: it takes as long as all else.
    bool of_image = image_share > 0.49;
    vec2 chosen = of_image ? position : c.mirror.surface_position;
    vec3 sharp;
    if (SHARP && (MIXED || tolerance < BLURRED_ANYWAY) && sharp_irradiance(c, chosen, sharp)) {
        if (of_image) image.light.irradiance = sharp;
        else surface.light.irradiance = sharp;
    }
    Past past = !surface.found ? image : !image.found ? surface : mixed(surface, image, image_share);
    if (!told_by_light && past.found && (!MIXED || share > 0.0)) {
        float agreeing = by_light(c, chosen, past, share > 0.0 ? AGREES : AGREES_WIDEST, false).frames;
        past.frames = MIXED ? mix(past.frames, agreeing, mirrored) : agreeing;
    }
    if (told_by_light) image_share = chance;
    else past.light.variance += past.contrast * (1.0 - share * explained);
    past.light = in_light(past.light, c.ratio, light_scale(c.ratio));
    return past;
}

// Of light that is mixed, the share that a lobe explains: that of the coat in all that is reflected.
float explained_share(ivec2 p) {
    if (!is_present(ALBEDO) || !is_present(SPECULAR_ALBEDO)) return UNKNOWN_SHARE;
    ivec2 traced = guide_pixel(p);
    float base = luminance(reflectance_of(texelFetch(albedo, host_pixel(ALBEDO, traced), 0).rgb));
    float coat = luminance(reflectance_of(texelFetch(specular_albedo, host_pixel(SPECULAR_ALBEDO, traced), 0).rgb));
    return base + coat > 0.0 ? coat / (base + coat) : UNKNOWN_SHARE;
}

// Frames of a past, with this one, which is worth `worth` of them and whose weight is at least `least`.
float length_with(float frames, float worth, float least) {
    float history_length = min(frames + worth, min(push.max_history_length, material.longest_history));
    return is_present(HISTORY_CONFIDENCE) ? min(history_length, 1.0 / max(least, 1e-6)) : history_length;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    vec4 value = texelFetch(noisy, p, 0);
    float stored = UNKNOWN_ROUGHNESS;
    if (is_present(ROUGHNESS)) stored = stored_roughness(texelFetch(roughness, host_pixel(ROUGHNESS, guide_pixel(p)), 0));
    float rough = roughness_of(stored);
    bool background = guide_depth(packed) == 0.0;
    float worth = sample_worth(value.a);
    LuminanceHistory luminance_history = first_luminance(value.rgb, worth, background ? REASON_NONE : REASON_RESET);
    Reflection seen = Reflection(0.0, rough);
    vec3 irradiance = value.rgb;
    float image_share = NO_PAST;
    material = USUAL_MATERIAL;
    if (is_present(MATERIAL_CLASS)) material = material_at(p);
    // Of light apart, temporal_accumulation.comp counts them.
    if (MIXED && is_present(MATERIAL_CLASS) && !background && !is_class(class_at(p))) count_bad(BAD_MATERIAL_CLASS);
    if (!background) {
        Centre c = centre_of(p, packed, luminance_origin(value.rgb));
        vec2 reaches;
        seen.hit_distance = hit_distance_now(c, value.a, rough, reaches);
        float explained = MIXED ? explained_share(p) : 1.0;
        if (MIXED) seen.roughness = mixed_roughness(c.depth, seen, explained);
        // The part of the light that moves as an image does. No ratio scales that.
        float mirrored = explained * mirror_share(seen.roughness);
        if (MIXED) c.ratio = pow(light_ratio_at(p), vec3(1.0 - mirrored));
        if (!has_flag(FLAG_RESET)) {
            float share, steadiness;
            float unknown = MIXED || stored != UNKNOWN_ROUGHNESS ? seen.roughness : 0.0;
            Past past = best_past(c, seen.roughness, unknown, explained, reaches, seen.hit_distance, share, steadiness);
            luminance_history = first_luminance(value.rgb, worth, REASON_DEPTH);
            if (past.found) {
                image_share = share;
                float change = change_at(p, mirrored);
                vec2 floors = vec2(push.alpha, push.alpha_moments) * mix(1.0, STEADY_ALPHA, clamp(steadiness, 0.0, 1.0));
                float history_length = length_with(past.frames, worth, adapted(floors.x, change));
                irradiance = blend(irradiance, past.light, history_length, worth, adapted(floors * worth, change), luminance_history);
            }
        }
    }
    imageStore(accumulated, p, vec4(signed_storable(irradiance), length_or_reason(luminance_history)));
    imageStore(new_luminance, p, uvec4(pack_new_luminance(luminance_history)));
    imageStore(reflection, p, uvec4(pack_reflection(seen, image_share)));
}
