#version 450
// How far the history of a pixel is still true: unless the frame departs from it by more than noise explains. No re-shaded samples are needed.
// Source: ours, in the place of the rule of [PSVGF]: a test of the mean difference against its standard error, over 24x24 pixels, which works
// in both directions; and where light has next to no noise, of each difference against that (src/nodes/change_test/specification.md).
// In:  per signal block_difference. Out: history_confidence, 1 (keep) to 0 (drop), and steadiness, one texel a block: 1 where neither the mean
//      nor one of its blocks departs by what could be more than noise, to 0; the least of the signals.
// optional: block_difference_1, steadiness
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
    float adaptivity;
    float change_threshold;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "guide.glsl"
#include "blocks.glsl"

layout(local_size_x = ROW_PIXELS) in;

const uint HISTORY_CONFIDENCE = 1u;
const uint BLOCK_DIFFERENCE_1 = 3u;
const uint STEADINESS = 4u;

layout(set = 0, binding = HISTORY_CONFIDENCE, r32f) uniform writeonly image2D history_confidence;
layout(set = 0, binding = 2) uniform utexture2D block_difference_0;
layout(set = 0, binding = BLOCK_DIFFERENCE_1) uniform utexture2D block_difference_1;
layout(set = 0, binding = STEADINESS, r32f) uniform writeonly image2D steadiness;

float lin(float a, float b, float x) { return clamp((x - a) / (b - a), 0.0, 1.0); }

// A change of the mean that is smaller than this share of it is not worth the history, however certain it is.
const float CHANGE_EPSILON = 0.01;

// Noise up to here, as a share of the light, hides no change.
const float QUIET = 0.1;

// Shares of the threshold between which steadiness falls from 1 to 0: of the mean, and of the worst of nine blocks, whose noise is larger.
const vec2 STEADY_MEAN = vec2(0.6, 1.2);
const vec2 STEADY_BLOCK = vec2(1.0, 1.6);

// The blocks of the row with two around them, and the change of these with one around them.
const uint WIDTH = ROW_BLOCKS + 4u;
const uint CHANGES_WIDTH = ROW_BLOCKS + 2u;
const uint CHANGES = CHANGES_WIDTH * 3u;
shared BlockDifference blocks[WIDTH * 5u];
shared float changes[CHANGES];
shared float departures[CHANGES];

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

struct Change {
    float of_mean;       // 0 to 1, over 3x3 blocks, in standard errors, against the threshold
    float of_pixels;     // the same of the differences of the block in the middle, where the noise explains none
    float unsteadiness;
};

Change change_of(uint corner) {
    float count = 0.0, sum = 0.0, variance = 0.0, brighter = 0.0, worst = 0.0, noise = 0.0, past_noise = 0.0;
    // Few invocations come here, and where branches are masked instead of skipped only a loop ends.
    [[dont_unroll]] for (uint i = 0u; i < 9u; ++i) {
        BlockDifference block = blocks[corner + i % 3u + WIDTH * (i / 3u)];
        float of_sum = block.count * block.mean, of_variance = block.count * block.deviation * block.deviation;
        float of_brighter = block.count * block.brighter;
        count += block.count;
        sum += of_sum;
        variance += of_variance;
        brighter += of_brighter;
        noise += block.count * block.noise * block.noise;
        past_noise = max(past_noise, block.past_noise);
        if (is_present(STEADINESS)) worst = max(worst, errors_of(of_sum, of_variance, of_brighter));
    }
    float errors = errors_of(sum, variance, brighter);
    vec2 mean = push.change_threshold * STEADY_MEAN, block = push.change_threshold * STEADY_BLOCK;
    float steady = count == 0.0 ? 0.0 : (1.0 - lin(mean.x, mean.y, errors)) * (1.0 - lin(block.x, block.y, worst));
    noise = sqrt(noise / max(count, 1.0));
    BlockDifference own = blocks[corner + 1u + WIDTH];
    float explained = own.brighter * max(noise, CHANGE_EPSILON * push.change_threshold), square = own.mean * own.mean + own.deviation * own.deviation;
    float departs = (1.0 - lin(QUIET, LOUD, max(noise, past_noise))) * lin(1.0, 2.0, square / max(explained * explained, 1e-12));
    return Change(lin(push.change_threshold, 2.0 * push.change_threshold, errors), departs, 1.0 - steady);
}

// Of the worst signal.
void load_changes() {
    uint i = gl_LocalInvocationIndex;
    uint corner = i % CHANGES_WIDTH + WIDTH * (i / CHANGES_WIDTH);
    Change change = Change(0.0, 0.0, 0.0);
    load_blocks(block_difference_0);
    barrier();
    if (i < CHANGES) change = change_of(corner);
    if (is_present(BLOCK_DIFFERENCE_1)) {
        barrier();
        load_blocks(block_difference_1);
        barrier();
        if (i < CHANGES) {
            Change other = change_of(corner);
            change.of_mean = max(change.of_mean, other.of_mean);
            change.of_pixels = max(change.of_pixels, other.of_pixels);
            change.unsteadiness = max(change.unsteadiness, other.unsteadiness);
        }
    }
    if (i < CHANGES) {
        changes[i] = change.of_mean;
        departures[i] = change.of_pixels;
    }
    ivec2 block = first_block() - 1 + ivec2(i % CHANGES_WIDTH, i / CHANGES_WIDTH);
    bool is_own = i > CHANGES_WIDTH && i < 2u * CHANGES_WIDTH - 1u;
    if (is_present(STEADINESS) && is_own && is_block(block)) imageStore(steadiness, block, vec4(1.0 - change.unsteadiness));
    barrier();
}

// The changes of the blocks above, here and below, of the nearest existing ones in that column.
vec3 column(int x) {
    ivec2 last = block_extent() - 1, origin = first_block() - 1;
    int row = int(gl_WorkGroupID.y), place = clamp(x, 0, last.x) - origin.x;
    ivec3 rows = clamp(ivec3(row - 1, row, row + 1), 0, last.y) - origin.y;
    return vec3(changes[place + rows.x * int(CHANGES_WIDTH)], changes[place + rows.y * int(CHANGES_WIDTH)],
        changes[place + rows.z * int(CHANGES_WIDTH)]);
}

// The largest departure of the 3x3 blocks around one: an edge that moves is about to leave its own.
float departure(ivec2 block) {
    uint corner = uint(block.x - first_block().x);
    float most = 0.0;
    for (uint i = 0u; i < 9u; ++i) most = max(most, departures[corner + i % 3u + CHANGES_WIDTH * (i / 3u)]);
    return most;
}

void main() {
    // Every invocation of a workgroup takes part in the barriers.
    load_changes();
    ivec2 p = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    if (!is_inside(p)) return;
    vec2 position = block_position(p), corner = floor(position);
    vec3 left = column(int(corner.x)), right = column(int(corner.x) + 1);
    float fraction = position.x - corner.x, departs = departure(p / BLOCK_SIZE);
    [[unroll]] for (int y = 0; y < BLOCK_SIZE; ++y) {
        ivec2 q = p + ivec2(0, y);
        float at = block_position(q).y, f = at - floor(at);
        // The upper half of a block lies between its centre and that of the one above.
        vec4 around = y < BLOCK_SIZE / 2 ? vec4(left.x, right.x, left.y, right.y) : vec4(left.y, right.y, left.z, right.z);
        float change = (1.0 - fraction) * (1.0 - f) * around.x;
        change += fraction * (1.0 - f) * around.y;
        change += (1.0 - fraction) * f * around.z;
        change += fraction * f * around.w;
        if (is_inside(q)) imageStore(history_confidence, host_pixel(HISTORY_CONFIDENCE, q), vec4(1.0 - push.adaptivity * max(change, departs)));
    }
}
