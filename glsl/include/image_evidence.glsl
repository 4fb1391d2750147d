// Where nobody knows the hit distance: how likely it is that a surface shows an image, and not a light of its own. Twin:
// src/nodes/specular_accumulation/twin/evidence.rs. Needs the types Centre and Past, and the images guide, noisy and history.
#ifndef IMAGE_EVIDENCE_GLSL
#define IMAGE_EVIDENCE_GLSL
#include "frame.glsl"
#include "guide.glsl"
#include "light_agreement.glsl"
#include "luminance.glsl"

// How likely it is at first that a surface shows an image, and how much of the odds, as logarithms, is kept.
const float CHANCE_AT_FIRST = 0.076;
const float ODDS_KEPT = 0.8;
// The most that one frame tells, and that all of them tell, as logarithms of odds.
const float LARGEST_EVIDENCE = 8.0;
const float LARGEST_ODDS = 4.8;
// An image that is less likely is not looked up.
const float UNLIKELY = 0.1;
// Pixels to each side, and the fewest that tell which past is seen.
const int EVIDENCE_REACH = 3;
const int EVIDENCE_SIDE = 2 * EVIDENCE_REACH + 1;
const float FEWEST_TELLING = 6.0;
// Variance of a past of one frame beside that of a sample, both as logarithms.
const float PAST_NOISE = 0.35;

float log_odds(float chance) { return log(chance / (1.0 - chance)); }

float luminance_then(ivec2 q) { return luminance(half_range(texelFetch(history, nearest_inside_previous(q), 0).rgb * frame.exposure_ratio)); }

// Luminance of the past between two pixels of a row.
float luminance_between(ivec2 left, float f) { return mix(luminance_then(left), luminance_then(left + ivec2(1, 0)), f); }

// By how much the light of now makes it likelier that the image is seen, not the surface, as logarithm of the odds. Both pasts are compared with it
// over 7x7 pixels, as logarithms, by the differences about their mean: logarithms of samples lie below those of what they are samples of.
float evidence_for_image(Centre c, vec2 image_position, Past surface) {
    vec2 position = c.mirror.surface_position;
    vec3 past = half_range(surface.light.irradiance * frame.exposure_ratio);
    float dark = DARK * luminance(past) + 1e-6;
    ivec2 corner = ivec2(floor(position)), image_corner = ivec2(floor(image_position));
    vec2 f = fract(position), image_f = fract(image_position), above = vec2(0.0);
    vec2 sum = vec2(0.0), squares = vec2(0.0);
    float count = 0.0, apart = 0.0;
    // Column by column, a pixel at a time: where branches are masked instead of skipped, a loop ends after one round.
    [[dont_unroll]] for (int i = 0; i < EVIDENCE_SIDE * (EVIDENCE_SIDE + 1); ++i) {
        ivec2 offset = ivec2(i / (EVIDENCE_SIDE + 1), i % (EVIDENCE_SIDE + 1)) - EVIDENCE_REACH;
        // Of the surface and of the image.
        vec2 below = vec2(luminance_between(corner + offset, f.x), luminance_between(image_corner + offset, image_f.x));
        ivec2 q = c.mirror.p + offset - ivec2(0, 1), tap = nearest_inside(q);
        vec4 value = texelFetch(noisy, tap, 0);
        GuideBits packed = GuideBits(packed_at(guide, tap));
        // Of the first row, there is nothing above.
        bool tells = offset.y > -EVIDENCE_REACH && q == tap && value.a >= 0.0 && guide_depth(packed) != 0.0 && guide_id(packed) == guide_id(c.mirror.packed);
        vec2 then = mix(above, below, vec2(f.y, image_f.y));
        vec2 difference = tells ? log2(luminance(value.rgb) + dark) - log2(then + dark) : vec2(0.0);
        sum += difference;
        squares += difference * difference;
        apart += (difference.x - difference.y) * (difference.x - difference.y);
        count += float(tells);
        above = below;
    }
    if (count < FEWEST_TELLING) return 0.0;
    squares -= sum * sum / count;
    apart -= (sum.x - sum.y) * (sum.x - sum.y) / count;
    float noise = min(squares.x, squares.y) / count + LOG_ROUNDED;
    // Pasts also differ by their own noise, which tells nothing.
    float of_noise = 2.0 * PAST_NOISE * noise * count / max(surface.frames, 1.0);
    float share = clamp(1.0 - of_noise / max(apart, 1e-6), 0.0, 1.0);
    return clamp(share * (squares.x - squares.y) / (2.0 * noise), -LARGEST_EVIDENCE, LARGEST_EVIDENCE);
}

// How likely it is that the image at a position is seen where nobody knows the distance, by all frames of the surface.
float image_chance(Centre c, bool moves, vec2 image_position, Past surface) {
    float odds = clamp(log_odds(clamp(surface.image_share, 1e-3, 0.999)), -LARGEST_ODDS, LARGEST_ODDS);
    odds = mix(log_odds(CHANCE_AT_FIRST), odds, ODDS_KEPT);
    if (moves) odds += evidence_for_image(c, image_position, surface);
    return 1.0 / (1.0 + exp(-clamp(odds, -LARGEST_ODDS, LARGEST_ODDS)));
}

#endif
