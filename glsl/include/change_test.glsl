// Unless a frame departs from its history by more than noise explains, that is still true. Twin: src/nodes/change_test/twin.rs.
// Needs `float adaptivity` and `float change_threshold` in the shader's block `push`, a workgroup of eight blocks with an invocation a column, the
// images block_difference_0 and _1, the latter at the binding BLOCK_DIFFERENCE_1, `bool wants_steadiness()`: whether gradients are known besides, so that it
// takes more to drop a history; and `bool tests_each()`: whether each signal is tested by itself.
#ifndef CHANGE_TEST_GLSL
#define CHANGE_TEST_GLSL
#include "blocks.glsl"
#include "light_ratio.glsl"
#include "optional.glsl"

float lin(float a, float b, float x) { return clamp((x - a) / (b - a), 0.0, 1.0); }

// A change of the mean that is smaller than this share of it is not worth the history, however certain it is.
const float CHANGE_EPSILON = 0.01;

// Noise up to here, as a share of the light, hides no change.
const float QUIET = 0.1;
// Samples of the past that spread by more than this share of the light were rare. A shadow that moves spreads them by less.
const float SPREAD = 1.0;

// Shares of the threshold between which steadiness falls from 1 to 0: of the mean, and of the worst of nine blocks, whose noise is larger.
const vec2 STEADY_MEAN = vec2(0.6, 1.2);
const vec2 STEADY_BLOCK = vec2(1.0, 1.6);

// Times the threshold from which a block counts alone, where it became darker and where brighter: what moves takes from one block as much as
// it gives to the next. Old light that stays is a ghost, while new light may be a cluster of outliers.
const vec2 ALONE = vec2(1.5, 2.0);
// Fewer pixels tell nothing of their noise.
const float ALONE_PIXELS = 8.0;

// Shares of the noise that count where it is usual, of that of single pixels and of that which blocks have in common: neither were samples of the past
// rare, nor is there new light, which may be a cluster of outliers.
const vec2 USUAL = vec2(0.6, 0.85);
// The brightest block of this frame over that of the history: up to the first, light is not new.
const vec2 NEW_LIGHT = vec2(1.05, 1.3);

// A change of a component is worth the history from this share on of a change of the mean that is.
const float WORTH_OF_PART = 0.5;

// Errors of the mean, as shares of the light, between which a ratio of light is no longer known.
const vec2 KNOWN = vec2(0.1, 0.2);

// The blocks of the row with two around them, and the change of these with one around them.
const uint WIDTH = ROW_BLOCKS + 4u;
const uint CHANGES_WIDTH = ROW_BLOCKS + 2u;
const uint CHANGES = CHANGES_WIDTH * 3u;
shared BlockDifference blocks[WIDTH * 5u];
shared float changes[2u * CHANGES];
shared float departures[2u * CHANGES];
// 1, sure that nothing changed, to -1, sure that something did.
shared float verdicts[2u * CHANGES];
// Of the light of all signals, or of the first, where each is tested by itself.
shared vec4 ratios[CHANGES];

ivec2 first_block() { return ivec2(gl_WorkGroupID.xy) * ivec2(ROW_BLOCKS, 1); }

void load_blocks(utexture2D block_difference) {
    uint i = gl_LocalInvocationIndex;
    if (i >= WIDTH * 5u) return;
    ivec2 block = first_block() + ivec2(int(i % WIDTH), int(i / WIDTH)) - 2;
    blocks[i] = unpack_block_difference(is_block(block) ? texelFetch(block_difference, block, 0) : uvec4(0u));
}

// A difference in standard errors.
float errors_of(float sum, float variance, float brighter) {
    float floor_of_error = CHANGE_EPSILON * brighter;
    return abs(sum) / max(sqrt(variance + floor_of_error * floor_of_error), 1e-6);
}

float middle_of(float a, float b, float c) { return max(min(a, b), min(max(a, b), c)); }

// The median of nine numbers: columns first.
float median_of(mat3 rows) {
    vec3 upper = min(rows[0], rows[1]), lower = max(rows[0], rows[1]);
    vec3 least = min(upper, rows[2]), middle = max(upper, min(lower, rows[2])), most = max(lower, rows[2]);
    return middle_of(max(least.x, max(least.y, least.z)), middle_of(middle.x, middle.y, middle.z), min(most.x, min(most.y, most.z)));
}

// Standard deviation of normal noise over the median of its sizes.
const float DEVIATION_BY_MEDIAN = 1.4826;

vec3 means_from(uint block) { return vec3(blocks[block].mean, blocks[block + 1u].mean, blocks[block + 2u].mean); }

// Of the means of 3x3 blocks. Medians, so that an edge that moves through three of them is no noise of all.
float spread_from(uint corner) {
    mat3 means = mat3(means_from(corner), means_from(corner + WIDTH), means_from(corner + 2u * WIDTH));
    vec3 median = vec3(median_of(means));
    return DEVIATION_BY_MEDIAN * median_of(mat3(abs(means[0] - median), abs(means[1] - median), abs(means[2] - median)));
}

struct Change {
    float of_mean;       // 0 to 1, over 3x3 blocks or the one in the middle alone, in standard errors, against the threshold
    float of_pixels;     // the same of the differences of the block in the middle, where the noise explains none
    float unsteadiness;
    // For the ratio of light:
    vec3 now;
    vec3 before;
    float power;  // 1, to be applied, to 0; -1: there is no history
};

const Change NO_CHANGE = Change(0.0, 0.0, 0.0, vec3(0.0), vec3(0.0), -1.0);

// In standard errors, of the component of light that changed most; it has noise as far as it has part in the luminance.
float errors_of_parts(vec3 now, vec3 before, float variance, float brighter) {
    vec3 difference = LUMINANCE_PARTS * (now - before);
    vec3 share = LUMINANCE_PARTS * max(now, before) / max(max(luminance(now), luminance(before)), 1e-6);
    float red = errors_of(difference.r, variance * share.r * share.r, WORTH_OF_PART * brighter);
    return max(red, errors_of(difference.b, variance * share.b * share.b, WORTH_OF_PART * brighter));
}

// `spread`: of the means of the blocks around.
float change_alone(BlockDifference block, float spread) {
    if (block.count < ALONE_PIXELS) return 0.0;
    float variance = max(block.count * block.deviation * block.deviation, block.count * block.count * spread * spread);
    float least = push.change_threshold * (block.mean < 0.0 ? ALONE.x : ALONE.y);
    return lin(least, 2.0 * least, errors_of(block.count * block.mean, variance, block.count * block.brighter));
}

Change change_of(uint corner) {
    float count = 0.0, sum = 0.0, variance = 0.0, brighter = 0.0, worst = 0.0, noise = 0.0, past_noise = 0.0;
    float squares = 0.0, spread = 0.0, brightest_now = 0.0, brightest_before = 0.0;
    vec3 now = vec3(0.0), before = vec3(0.0);
    bool complete = true;
    // Few invocations come here, and where branches are masked instead of skipped only a loop ends.
    [[dont_unroll]] for (uint i = 0u; i < 9u; ++i) {
        BlockDifference block = blocks[corner + i % 3u + WIDTH * (i / 3u)];
        float of_sum = block.count * block.mean, of_variance = block.count * block.deviation * block.deviation;
        float of_brighter = block.count * block.brighter;
        squares += block.count * block.count;
        complete = complete && block.count > 0.0;
        count += block.count;
        sum += of_sum;
        variance += of_variance;
        brighter += of_brighter;
        now += block.count * block.now;
        before += block.count * block.before;
        brightest_now = max(brightest_now, block.brighter + min(block.mean, 0.0));
        brightest_before = max(brightest_before, block.brighter - max(block.mean, 0.0));
        noise += block.count * block.noise * block.noise;
        past_noise = max(past_noise, block.past_noise);
        if (wants_steadiness()) worst = max(worst, errors_of(of_sum, of_variance, of_brighter));
    }
    // Noise that neighbours share is not averaged within a block.
    if (complete) spread = spread_from(corner);
    float shared_variance = squares * spread * spread;
    float errors = errors_of(sum, max(variance, shared_variance), brighter);
    vec2 mean = push.change_threshold * STEADY_MEAN, block = push.change_threshold * STEADY_BLOCK;
    float steady = count == 0.0 ? 0.0 : (1.0 - lin(mean.x, mean.y, errors)) * (1.0 - lin(block.x, block.y, worst));
    noise = sqrt(noise / max(count, 1.0));
    BlockDifference own = blocks[corner + 1u + WIDTH];
    float explained = own.brighter * max(noise, CHANGE_EPSILON * push.change_threshold), square = own.mean * own.mean + own.deviation * own.deviation;
    float is_quiet = (1.0 - lin(QUIET, LOUD, noise)) * (1.0 - lin(SPREAD, RARE, past_noise));
    float departs = is_quiet * lin(1.0, 2.0, square / max(explained * explained, 1e-12));
    float is_known = 1.0 - lin(KNOWN.x, KNOWN.y, sqrt(max(variance, shared_variance)) / max(luminance(now), 1e-6));
    float is_new = lin(NEW_LIGHT.x, NEW_LIGHT.y, brightest_now / max(brightest_before, 1e-6));
    if (!wants_steadiness()) {
        vec2 counted = mix(USUAL, vec2(1.0), max(is_new, lin(SPREAD, RARE, past_noise)));
        variance = max(counted.x * counted.x * variance, counted.y * counted.y * shared_variance);
        // Light may change its colour alone.
        errors = max(errors_of(sum, variance, brighter), errors_of_parts(now, before, variance, brighter));
    }
    float of_mean = max(lin(push.change_threshold, 2.0 * push.change_threshold, errors), change_alone(own, spread));
    float power = own.count == 0.0 ? -1.0 : own.count < ALONE_PIXELS ? 0.0 : of_mean * is_known;
    return Change(of_mean, departs, 1.0 - steady, own.now, own.before, power);
}

void share(uint place, Change change) {
    changes[place] = change.of_mean;
    departures[place] = change.of_pixels;
    verdicts[place] = 1.0 - change.unsteadiness - push.adaptivity * change.of_mean;
}

// By which each component of the light changed; in alpha -1 where there is no history.
vec4 ratio_of(Change change) {
    vec3 now = max(change.now, 0.0), before = max(change.before, 0.0);
    float least = floor_of_ratio(before);
    vec3 ratio = clamp((now + least) / (before + least), 1.0 / LARGEST_RATIO, LARGEST_RATIO);
    return vec4(pow(ratio, vec3(push.adaptivity * max(change.power, 0.0))), change.power < 0.0 ? -1.0 : 1.0);
}

// Of each signal, or of the worst. Every invocation of a workgroup takes part in the barriers.
void load_changes() {
    uint i = gl_LocalInvocationIndex;
    uint corner = i % CHANGES_WIDTH + WIDTH * (i / CHANGES_WIDTH);
    Change change = NO_CHANGE;
    load_blocks(block_difference_0);
    barrier();
    if (i < CHANGES) change = change_of(corner);
    if (is_wired(BLOCK_DIFFERENCE_1)) {
        barrier();
        load_blocks(block_difference_1);
        barrier();
        if (i < CHANGES) {
            Change other = change_of(corner);
            if (tests_each()) share(CHANGES + i, other);
            else {
                change.of_mean = max(change.of_mean, other.of_mean);
                change.of_pixels = max(change.of_pixels, other.of_pixels);
                change.unsteadiness = max(change.unsteadiness, other.unsteadiness);
                change.now += other.now;
                change.before += other.before;
                change.power = max(change.power, other.power);
            }
        }
    }
    if (i < CHANGES) {
        share(i, change);
        ratios[i] = ratio_of(change);
    }
    barrier();
}

// The changes of the blocks above, here and below, of the nearest existing ones in that column.
vec3 column(uint test, int x) {
    ivec2 last = block_extent() - 1, origin = first_block() - 1;
    int row = int(gl_WorkGroupID.y), place = clamp(x, 0, last.x) - origin.x;
    ivec3 rows = clamp(ivec3(row - 1, row, row + 1), 0, last.y) - origin.y;
    rows = rows * int(CHANGES_WIDTH) + place + int(test * CHANGES);
    return vec3(changes[rows.x], changes[rows.y], changes[rows.z]);
}

// The largest departure of the 3x3 blocks around one: an edge that moves is about to leave its own.
float departure(uint test, ivec2 block) {
    uint corner = uint(block.x - first_block().x) + test * CHANGES;
    float most = 0.0;
    for (uint i = 0u; i < 9u; ++i) most = max(most, departures[corner + i % 3u + CHANGES_WIDTH * (i / 3u)]);
    return most;
}

// What the pixels of a column of a block share.
struct Column {
    vec3 left;
    vec3 right;
    float fraction;
    float departs;
};

Column column_of(uint test, ivec2 top) {
    vec2 position = block_position(top), corner = floor(position);
    return Column(column(test, int(corner.x)), column(test, int(corner.x) + 1), position.x - corner.x, departure(test, top / BLOCK_SIZE));
}

// Confidence in the history of the pixel `y` rows below the top of a column.
float tested_confidence(Column c, ivec2 top, int y) {
    float at = block_position(top + ivec2(0, y)).y, f = at - floor(at);
    // The upper half of a block lies between its centre and that of the one above.
    vec4 around = y < BLOCK_SIZE / 2 ? vec4(c.left.x, c.right.x, c.left.y, c.right.y) : vec4(c.left.y, c.right.y, c.left.z, c.right.z);
    float change = (1.0 - c.fraction) * (1.0 - f) * around.x;
    change += c.fraction * (1.0 - f) * around.y;
    change += (1.0 - c.fraction) * f * around.z;
    change += c.fraction * f * around.w;
    return 1.0 - push.adaptivity * max(change, c.departs);
}

#endif
