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

// Luminance of the past between pixels, to the right of `first`, which lies on a row.
void luminance_row(float first, int y, out float row[EVIDENCE_SIDE]) {
    float left = luminance_then(ivec2(floor(first), y)), f = fract(first);
    [[unroll]] for (int x = 0; x < EVIDENCE_SIDE; ++x) {
        float right = luminance_then(ivec2(floor(first) + x + 1, y));
        row[x] = mix(left, right, f);
        left = right;
    }
}

// By how much the light of now makes it likelier that the image is seen, not the surface, as logarithm of the odds. Both pasts are compared with it
// over 7x7 pixels, as logarithms, by the differences about their mean: logarithms of samples lie below those of what they are samples of.
float evidence_for_image(Centre c, vec2 image_position, Past surface) {
    vec2 position = c.mirror.surface_position;
    vec2 f = fract(vec2(position.y, image_position.y));
    vec3 past = half_range(surface.light.irradiance * frame.exposure_ratio);
    float dark = DARK * luminance(past) + 1e-6;
    // Of the surface and of the image.
    float above[2][EVIDENCE_SIDE], below[2][EVIDENCE_SIDE];
    vec2 sum = vec2(0.0), squares = vec2(0.0);
    float count = 0.0, apart = 0.0;
    [[dont_unroll]] for (int y = -EVIDENCE_REACH; y <= EVIDENCE_REACH + 1; ++y) {
        luminance_row(position.x - EVIDENCE_REACH, int(floor(position.y)) + y, below[0]);
        luminance_row(image_position.x - EVIDENCE_REACH, int(floor(image_position.y)) + y, below[1]);
        [[unroll]] for (int x = 0; x < EVIDENCE_SIDE; ++x) {
            ivec2 q = c.mirror.p + ivec2(x - EVIDENCE_REACH, y - 1), tap = nearest_inside(q);
            vec4 value = texelFetch(noisy, tap, 0);
            GuideBits packed = GuideBits(packed_at(guide, tap));
            // Of the first row, there is nothing above.
            bool tells = y > -EVIDENCE_REACH && q == tap && value.a >= 0.0 && guide_depth(packed) != 0.0 && guide_id(packed) == guide_id(c.mirror.packed);
            vec2 then = mix(vec2(above[0][x], above[1][x]), vec2(below[0][x], below[1][x]), f);
            vec2 difference = tells ? log2(luminance(value.rgb) + dark) - log2(then + dark) : vec2(0.0);
            sum += difference;
            squares += difference * difference;
            apart += (difference.x - difference.y) * (difference.x - difference.y);
            count += float(tells);
            above[0][x] = below[0][x];
            above[1][x] = below[1][x];
        }
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
