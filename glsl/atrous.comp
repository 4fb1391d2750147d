#version 450
// One level of the edge-avoiding à-trous wavelet transform, guided by variance, which it filters along.
// Source: [SVGF] 4.3, eq. 1 to 5, on [EAW]. Deviation: the standard deviation is stored, not the variance.
// In:  guide, irradiance and deviation per signal. Out: the same after this level.
// Constants: KERNEL: 0: the 5x5 B3 spline; 1: the 3x3 box of [ASVGF].
// OURS: the luminance weight is a Gauss curve over deviations of means, which taps share; some of what it refuses stays on the centre, so that
// rare light keeps its mean. Else [SVGF] eq. 5. VOLUME: steered by the depth of the surface behind alone, and less strictly [PSVGF]; the
// background takes part. LAST: of a volume, what goes out: in the exposure of the host. MARKED: OURS of specular light alone, whose
// deviation says whether light is rare.
// With SPECULAR the last signal no wider than the lobe of the surface blurs what is seen in it: by its radius on the screen, by normals within it,
// and by hit distance [ours]; a mirror is not filtered at all. Things in it are told apart by their hue as well, and where no hit distance is
// known more strictly.
// MATERIAL is a set of bindings of its own, since no other image could stand in for material_class.
// variants: SIGNALS=1 SIGNALS=2 SIGNALS=1,SPECULAR=1 SIGNALS=2,SPECULAR=1
// variants: SIGNALS=1,MATERIAL=1 SIGNALS=2,MATERIAL=1 SIGNALS=1,SPECULAR=1,MATERIAL=1 SIGNALS=2,SPECULAR=1,MATERIAL=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint KERNEL = 0u;
layout(constant_id = 2) const bool VOLUME = false;
layout(constant_id = 3) const bool OURS = false;
layout(constant_id = 4) const bool LAST = false;
layout(constant_id = 5) const bool MARKED = false;

layout(push_constant) uniform Push {
    uint level;
    float sigma_l;
    float sigma_n;
    float sigma_z;
    float volume_sigma_z;
#ifdef SPECULAR
    float specular_blur;
#endif
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "centre_geometry.glsl"
#include "luminance.glsl"
// Vulkan guarantees four storage images alone. With two signals and their reflections those are the packed ones: on software Vulkan it costs more to
// sample them than halves.
#if SIGNALS == 2 && defined(SPECULAR)
#define PACKED_IN_STORAGE
#define INPUT(number, name) layout(set = 0, binding = number) uniform texture2D name
#define input_at(name, pixel) texelFetch(name, pixel, 0)
#else
#define INPUT(number, name) layout(set = 0, binding = number, rgba16f) uniform restrict readonly image2D name
#define input_at(name, pixel) imageLoad(name, pixel)
#endif
#include "packed_image.glsl"
#include "rare_light.glsl"
#ifdef SPECULAR
#include "reflection.glsl"
const bool SPECULAR_0 = MARKED && SIGNALS == 1;
const bool SPECULAR_1 = MARKED;
#else
const bool SPECULAR_0 = false;
const bool SPECULAR_1 = false;
#endif

// Storage images are read where there may be as many, for the reasons that packed_image.glsl has.
PACKED_IMAGE(1, guide);
const uint INPUT_0 = 3u;
const uint OUTPUT_0 = 4u;
const uint INPUT_1 = 5u;
const uint OUTPUT_1 = 6u;
INPUT(INPUT_0, input_0);
layout(set = 0, binding = OUTPUT_0, rgba16f) uniform writeonly image2D output_0;
#if SIGNALS == 2
INPUT(INPUT_1, input_1);
layout(set = 0, binding = OUTPUT_1, rgba16f) uniform writeonly image2D output_1;
#endif

#if SIGNALS == 2
const uint REFLECTION = 7u;
#else
const uint REFLECTION = 5u;
#endif
#ifdef SPECULAR
PACKED_IMAGE_32(REFLECTION, reflection);
const uint MATERIAL_CLASS = REFLECTION + 1u;
#else
const uint MATERIAL_CLASS = REFLECTION;
#endif
#ifdef MATERIAL
layout(set = 0, binding = MATERIAL_CLASS) uniform utexture2D material_class;
#include "material.glsl"
#endif

const uint SPLINE_KERNEL = 0u;
const uint BOX_KERNEL = 1u;
const int RADIUS = KERNEL == SPLINE_KERNEL ? 2 : 1;
const float SPLINE[3] = float[](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);
const float LUMINANCE_EPSILON = 1e-4;
// Of the tolerated deviation by that of the tap: a pixel that rare light never hit takes some of what was hit.
const float TAP_SHARE = 0.38;
// Of the weight that a difference of luminance takes from a tap, the part that stays on the centre.
const float KEPT_SHARE = 0.5;
// Where no hit distance is known, the most that a deviation around counts, over the own one, unless light is rare there.
const float UNKNOWN_SHARE = 1.5;
const float ANY_DEVIATION = 65504.0;
// The most that a difference of hue counts, squared, over the luminance of the centre: of what is dark it says little.
const float MOST_OF_HUE = 4.0;

const float CENTRE_KERNEL = KERNEL == SPLINE_KERNEL ? 9.0 / 64.0 : 1.0 / 9.0;

float kernel_at(ivec2 offset) { return KERNEL == SPLINE_KERNEL ? SPLINE[abs(offset.x)] * SPLINE[abs(offset.y)] : CENTRE_KERNEL; }

// Taps are 2^level pixels apart, those of the box from level 3 on one less: with even steps alone no level but the first mixes even pixels with odd
// ones, and where the first refuses outliers their difference stays as a lattice [ours].
int step_of(uint level) { return (1 << level) - (KERNEL == BOX_KERNEL && level >= 3u ? 1 : 0); }

// Of the widest kernel: reflection knows no length that depends on a constant.
const int TAPS = 25;

// A pixel that exists, and the one that is asked for where that exists: one operation fewer for each axis than the nearest.
ivec2 any_inside(ivec2 q) { return ivec2(min(uvec2(q), frame.render_extent - 1u)); }

int index_of(ivec2 offset) { return TAPS / 2 + 5 * offset.y + offset.x; }

// Log2 of the weight of what does not exist or is background.
const float REFUSED = -1e4;

// Of the geometry; without OURS in powers of 2, as the luminance weight is to be added.
const float CENTRE_WEIGHT = OURS ? 1.0 : 0.0;

float weight_of(bool counts, float log2_weight) {
    if (OURS) return counts ? exp2(log2_weight) : 0.0;
    return counts ? log2_weight : REFUSED;
}

struct Sum {
    vec3 irradiance;
    float variance;
    float weight;
    float kept;
};

struct Centre {
    float luminance;
    float deviation;
    float sharpness;  // of luminance
    bool is_specular;
    float tolerated;  // of a tap whose light is not rare, the largest deviation that counts
    vec3 hue;
};

// Of the material.
float sigma_l;

// log2(e) over the denominator of eq. 5.
float luminance_sharpness(float deviation) { return LOG2_E / (sigma_l * deviation + LUMINANCE_EPSILON); }

Centre centre_of(vec4 value, float variance, bool is_specular, float tolerated) {
    float deviation = sqrt(variance);
    float l = luminance(value.rgb);
    return Centre(l, deviation, luminance_sharpness(deviation), is_specular, tolerated, value.rgb / max(l, 1e-12));
}

// Of a tap.
float counted_deviation(float deviation, bool is_specular, float tolerated) {
    return is_specular && !is_rare(deviation) ? min(deviation, tolerated) : deviation;
}

// Squared: things in a mirror may be as bright as each other. Of what is dark a hue says little.
float difference_of_hue(vec3 tap, float tap_luminance, Centre centre) {
    vec3 difference = tap - tap_luminance * centre.hue;
    return min(dot(difference, difference), MOST_OF_HUE * centre.luminance * centre.luminance);
}

// `geometry`: a weight with OURS, else in powers of 2.
void add_tap(inout Sum sum, vec4 value, Centre centre, float geometry, float kernel) {
    float l = luminance(value.rgb), difference = abs(l - centre.luminance), weight;
    if (OURS) {
        // In the background the deviation is negative.
        float tap = counted_deviation(max(value.a, 0.0), centre.is_specular, centre.tolerated);
        float sharpness = luminance_sharpness(mix(centre.deviation, tap, TAP_SHARE));
        float x = difference * sharpness, squared = x * x;
        if (centre.is_specular) squared = max(squared, difference_of_hue(value.rgb, l, centre) * sharpness * sharpness);
        float share = exp2(-0.5 / LOG2_E * squared), whole = kernel * geometry;
        weight = whole * share;
        sum.kept += KEPT_SHARE * (whole - weight);
    } else {
        weight = kernel * exp2(geometry - difference * centre.sharpness);
    }
    sum.irradiance += weight * value.rgb;
    sum.variance += weight * weight * value.a * value.a;
    sum.weight += weight;
}

Sum start(vec4 value) {
    return Sum(CENTRE_KERNEL * value.rgb, CENTRE_KERNEL * CENTRE_KERNEL * value.a * value.a, CENTRE_KERNEL, 0.0);
}

vec4 result(Sum sum, vec4 centre, bool is_specular) {
    sum.irradiance += sum.kept * centre.rgb;
    // Of the same sample as the centre's own weight: weights add up before they are squared.
    sum.variance += sum.kept * (sum.kept + 2.0 * CENTRE_KERNEL) * centre.a * centre.a;
    vec4 mean = vec4(sum.irradiance, sqrt(sum.variance)) / (sum.weight + sum.kept);
    if (is_specular) mean.a = marked(mean.a, is_rare(centre.a));
    return storable(LAST ? mean * frame.inverse_filter_exposure : mean);
}

// g3x3 of eq. 5, beside the pixel on every level: it steadies an estimate of one pixel.
vec2 variances_beside(ivec2 p) {
    vec2 sum = vec2(0.0);
    float weight_sum = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 q = p + ivec2(x, y), tap = nearest_inside(q);
            float kernel = q == tap ? 0.25 / float(1 << (abs(x) + abs(y))) : 0.0;
            float deviation = input_at(input_0, host_pixel(INPUT_0, tap)).a;
            // In the background it is negative.
            float weight = deviation >= 0.0 ? kernel : 0.0;
            sum.x += weight * deviation * deviation;
#if SIGNALS == 2
            deviation = input_at(input_1, host_pixel(INPUT_1, tap)).a;
            sum.y += weight * deviation * deviation;
#endif
            weight_sum += weight;
        }
    return sum / max(weight_sum, 0.25);
}

// g3x3 over the nine taps around the centre, by how far they show its surface: wider levels have estimates of their own.
float variance_of_taps(vec4 values[TAPS], float weights[TAPS], bool is_specular, float tolerated) {
    float sum = 0.0, weight_sum = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            int i = index_of(ivec2(x, y));
            float weight = weights[i] / float(1 << (abs(x) + abs(y)));
            float deviation = counted_deviation(values[i].a, is_specular, tolerated);
            sum += weight * deviation * deviation;
            weight_sum += weight;
        }
    return sum / weight_sum;
}

#ifdef SPECULAR
// What is seen in the centre of a window, and how much less a tap weighs, in powers of 2.
struct Lobe {
    float nearness;            // hit distance over the way from the eye; 0: unknown
    float spatial_sharpness;   // per squared pixel
    float distance_sharpness;  // per squared difference of nearness
};

// Narrows the tolerance of normals as well.
Lobe lobe_of(ivec2 p, GuideBits packed, inout EdgeCentre surface) {
    Reflection r = unpack_reflection(packed_at(reflection, p).x);
    float share = mirror_share(r.roughness), width = lobe_width(r.roughness);
    float radius = max(push.specular_blur * lobe_radius(guide_depth(packed), r), 0.01);
    float sigma_n = share / (width * width + 1e-3);
    surface.normal_sharpness += LOG2_E * sigma_n * (0.5 / (NORMAL_STEPS * NORMAL_STEPS));
    float distance_sharpness = r.hit_distance > 0.0 ? LOG2_E * 4.0 * share / (width * width + 0.02) : 0.0;
    return Lobe(nearness_of(guide_depth(packed), r.hit_distance), LOG2_E * 0.5 * share / (radius * radius), distance_sharpness);
}

float tolerated_by(Lobe lobe, vec4 centre) { return lobe.nearness > 0.0 ? ANY_DEVIATION : UNKNOWN_SHARE * centre.a; }

float log2_lobe_weight(Lobe lobe, ivec2 offset, ivec2 tap, GuideBits packed_tap) {
    float distance = unpack_reflection(packed_at(reflection, tap).x).hit_distance;
    float difference = nearness_of(guide_depth(packed_tap), distance) - lobe.nearness;
    return -(float(offset.x * offset.x + offset.y * offset.y) * lobe.spatial_sharpness + difference * difference * lobe.distance_sharpness);
}
#endif

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec4 value_0 = input_at(input_0, host_pixel(INPUT_0, p));
#if SIGNALS == 2
    vec4 value_1 = input_at(input_1, host_pixel(INPUT_1, p));
#endif
    GuideBits packed = GuideBits(packed_at(guide, p));
    if (!is_filtered(packed)) {
        imageStore(output_0, host_pixel(OUTPUT_0, p), value_0);
#if SIGNALS == 2
        imageStore(output_1, host_pixel(OUTPUT_1, p), value_1);
#endif
        return;
    }
    Geometry geometry = geometry_of(packed);
    sigma_l = push.sigma_l;
#ifdef MATERIAL
    Material material = material_at(p);
    sigma_l *= material.light;
    // Tolerated depth is the gradient's share.
    geometry.surface.gradient *= material.depth;
    geometry.surface.normal_sharpness /= material.normal;
#endif
#ifdef SPECULAR
    Geometry glossy = geometry;
    Lobe lobe = lobe_of(p, packed, glossy.surface);
#endif
    int step_size = step_of(push.level);
    float weights_0[TAPS];
    weights_0[index_of(ivec2(0))] = CENTRE_WEIGHT;
#if SIGNALS == 2
    float weights_1[TAPS];
    weights_1[index_of(ivec2(0))] = CENTRE_WEIGHT;
#endif
    // With OURS, where they are needed twice.
    vec4 values_0[TAPS];
    values_0[index_of(ivec2(0))] = value_0;
#if SIGNALS == 2
    vec4 values_1[TAPS];
    values_1[index_of(ivec2(0))] = value_1;
#endif
    [[unroll]] for (int y = 0; y <= RADIUS; ++y)
        [[unroll]] for (int x = -RADIUS; x <= RADIUS; ++x) {
            if (y == 0 && x <= 0) continue;
            ivec2 offset = ivec2(x, y) * step_size;
            float sharpness = depth_sharpness(geometry, vec2(offset));
            // The tap on the other side has the same tolerance of depth.
            [[unroll]] for (int side = 1; side >= -1; side -= 2) {
                ivec2 q = p + side * offset, tap = any_inside(q);
                GuideBits packed_q = GuideBits(packed_at(guide, tap));
                int i = index_of(side * ivec2(x, y));
                bool counts = q == tap && takes_part(geometry, packed_q);
#if !defined(SPECULAR)
                weights_0[i] = weight_of(counts, log2_weight(geometry, packed_q, sharpness));
#if SIGNALS == 2
                weights_1[i] = weights_0[i];
#endif
#else
                float last = weight_of(counts, log2_weight(glossy, packed_q, sharpness) + log2_lobe_weight(lobe, offset, tap, packed_q));
#if SIGNALS == 2
                weights_0[i] = weight_of(counts, log2_weight(geometry, packed_q, sharpness));
                weights_1[i] = last;
#else
                weights_0[i] = last;
#endif
#endif
                if (OURS) {
                    values_0[i] = input_at(input_0, host_pixel(INPUT_0, tap));
#if SIGNALS == 2
                    values_1[i] = input_at(input_1, host_pixel(INPUT_1, tap));
#endif
                }
            }
        }
    vec2 beside = OURS ? vec2(0.0) : variances_beside(p);
#if defined(SPECULAR) && SIGNALS == 2
    float tolerated = tolerated_by(lobe, value_1);
#elif defined(SPECULAR)
    float tolerated = tolerated_by(lobe, value_0);
#else
    const float tolerated = ANY_DEVIATION;
#endif
    float variance_0 = OURS ? variance_of_taps(values_0, weights_0, SPECULAR_0, tolerated) : beside.x;
    Centre centre_0 = centre_of(value_0, variance_0, SPECULAR_0, tolerated);
    Sum sum_0 = start(value_0);
#if SIGNALS == 2
    float variance_1 = OURS ? variance_of_taps(values_1, weights_1, SPECULAR_1, tolerated) : beside.y;
    Centre centre_1 = centre_of(value_1, variance_1, SPECULAR_1, tolerated);
    Sum sum_1 = start(value_1);
#endif
    [[unroll]] for (int y = 0; y <= RADIUS; ++y)
        [[unroll]] for (int x = -RADIUS; x <= RADIUS; ++x) {
            if (y == 0 && x <= 0) continue;
            [[unroll]] for (int side = 1; side >= -1; side -= 2) {
                ivec2 offset = side * ivec2(x, y), tap = any_inside(p + offset * step_size);
                int i = index_of(offset);
                float kernel = kernel_at(offset);
                add_tap(sum_0, OURS ? values_0[i] : input_at(input_0, host_pixel(INPUT_0, tap)), centre_0, weights_0[i], kernel);
#if SIGNALS == 2
                add_tap(sum_1, OURS ? values_1[i] : input_at(input_1, host_pixel(INPUT_1, tap)), centre_1, weights_1[i], kernel);
#endif
            }
        }
    imageStore(output_0, host_pixel(OUTPUT_0, p), result(sum_0, value_0, SPECULAR_0));
#if SIGNALS == 2
    imageStore(output_1, host_pixel(OUTPUT_1, p), result(sum_1, value_1, SPECULAR_1));
#endif
}
