#version 450
// How far the history of a pixel is still true: unless the frame departs from it by more than noise explains. No re-shaded samples are needed.
// Source: ours, in the place of the rule of [PSVGF]: a test of the mean difference against its standard error, over 24x24 pixels, which works
// in both directions; and where light has next to no noise, of each difference against that (src/nodes/change_test/specification.md).
// In:  per signal block_difference. Out: history_confidence, 1 (keep) to 0 (drop), and steadiness, one texel a block: 1 where neither the mean
//      nor one of its blocks departs by what could be more than noise, to -1 where they changed for sure; the least of the signals.
//      With RATIO light_ratio as well, one texel a block: by which the light of each component changed, in alpha 1, -1 where there is no history.
// Constants: BOTH: block_difference_1 is of specular light, whose confidence is beside that of diffuse light. Without that image all light is one, and
// both confidences are of it.
// optional: block_difference_1, steadiness
// variants: RATIO=0 RATIO=1
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
#include "both_confidences.glsl"

layout(local_size_x = ROW_PIXELS) in;

const uint HISTORY_CONFIDENCE = 1u;
const uint BLOCK_DIFFERENCE_1 = 3u;
const uint STEADINESS = 4u;

layout(set = 0, binding = HISTORY_CONFIDENCE, r32f) uniform writeonly image2D history_confidence;
layout(set = 0, binding = 2) uniform utexture2D block_difference_0;
layout(set = 0, binding = BLOCK_DIFFERENCE_1) uniform utexture2D block_difference_1;
layout(set = 0, binding = STEADINESS, r32f) uniform writeonly image2D steadiness;

#if RATIO
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D light_ratio;
#endif

bool wants_steadiness() { return is_present(STEADINESS); }
layout(constant_id = 1) const bool BOTH = false;
bool tests_each() { return BOTH; }
#include "change_test.glsl"

void main() {
    load_changes();
    uint i = gl_LocalInvocationIndex;
    ivec2 block = first_block() + ivec2(i, 0);
    if (wants_steadiness() && i < ROW_BLOCKS && is_block(block)) imageStore(steadiness, block, vec4(verdicts[i + 1u + CHANGES_WIDTH]));
#if RATIO
    if (i < ROW_BLOCKS && is_block(block)) imageStore(light_ratio, block, ratios[i + 1u + CHANGES_WIDTH]);
#endif
    ivec2 top = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    if (!is_inside(top)) return;
    Column c = column_of(0u, top), other = c;
    if (BOTH && is_wired(BLOCK_DIFFERENCE_1)) other = column_of(1u, top);
    [[unroll]] for (int y = 0; y < BLOCK_SIZE; ++y) {
        ivec2 p = top + ivec2(0, y);
        if (!is_inside(p)) continue;
        float confidence = tested_confidence(c, top, y);
        if (BOTH) confidence = both_confidences(confidence, tested_confidence(other, top, y));
        imageStore(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), vec4(confidence));
    }
}
