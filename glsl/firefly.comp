#version 450
// Scales outliers down to the brightest luminance that is usual around them, before they reach the history, and spreads what that takes
// over the block.
// Source: [PSVGF], firefly filter. Deviation: what is cut off is not lost, but for what would show as a bright block.
// In:  guide, firefly_limits. In place: irradiance, still noisy, own block only. With DIFFERENCE also what firefly_limits.comp reads, with its
//      firefly_limits, and what block_difference.comp reads, with its block_difference of the irradiance that is left: a block is read once
//      for all three.
// Constants: VOLUME: of every pixel, whatever the guide says.
// variants: DIFFERENCE=0 DIFFERENCE=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool VOLUME = false;
layout(constant_id = 2) const bool SPECULAR = false;

layout(push_constant) uniform Push {
    float firefly_spread;
#if DIFFERENCE
    float percentile_range;
    float firefly_bias;
    float depth_tolerance;
#endif
} push;

#include "frame.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "blocks.glsl"

layout(local_size_x = ROW_PIXELS) in;

#if DIFFERENCE
layout(set = 0, binding = 1, rgba16ui) uniform restrict readonly uimage2D guide;
#define guide_at(p) imageLoad(guide, p)
#else
layout(set = 0, binding = 1) uniform utexture2D guide;
#define guide_at(p) texelFetch(guide, p, 0)
#endif
#if DIFFERENCE
layout(set = 0, binding = 2, r32ui) uniform writeonly uimage2D firefly_limits;
#else
layout(set = 0, binding = 2) uniform utexture2D firefly_limits;
#endif
layout(set = 0, binding = 3, rgba16f) uniform image2D irradiance;
#if DIFFERENCE
layout(set = 0, binding = 4) uniform utexture2D previous_guide;
layout(set = 0, binding = 5) uniform utexture2D surface_motion;
// Vulkan guarantees four storage images alone.
layout(set = 0, binding = 7) uniform texture2D history;
layout(set = 0, binding = 8) uniform utexture2D previous_luminance_history;
layout(set = 0, binding = 9, rgba32ui) uniform writeonly uimage2D block_difference;
layout(set = 0, binding = 10) uniform utexture2D block_percentiles;
layout(set = 0, binding = 11) uniform utexture2D previous_firefly_limits;
#define RETURNING 1
#define irradiance_at(p) imageLoad(irradiance, p)
#define history_at(p) texelFetch(history, p, 0)
#include "firefly_limits.glsl"
#include "block_difference.glsl"

// Of the cells of the blocks in a row, packed.
shared uint cell_limits[CELLS];
#endif

// Lamps that are mirrored are brighter than all around, and move otherwise than the mirror.
const float HIGHLIGHT = 32.0;
// Of a cluster, in shares of what one outlier spreads at most: more would show.
const float CLUSTER_SPREAD = 0.4;

// Irradiance that is cut off, and the pixels that share it, of the columns of the blocks in a row.
shared vec4 columns[ROW_PIXELS];

// A hole has no sample yet.
bool takes_part(ivec2 p, vec4 value) {
    return is_inside(p) && value.a >= 0.0 && (VOLUME || guide_depth(GuideBits(guide_at(p))) != 0.0);
}

// The share of a luminance that is kept. The pixels of a cluster add up: the further they are above the limit, the less of each is left.
float kept_share(float l, FireflyLimit limit) {
    float most = SPECULAR ? HIGHLIGHT * limit.limit : limit.limit;
    if (most == 0.0 || l <= most) return 1.0;
    float share = most / l;
    return limit.is_cluster ? share * share : share;
}

FireflyLimit limit_at(ivec2 p) {
    ivec2 cell = nearest_inside(p) / CELL_SIZE;
#if DIFFERENCE
    cell -= 2 * first_block();
    return unpack_firefly_limits(cell_limits[cell.x + int(ROW_CELLS) * cell.y]);
#else
    return unpack_firefly_limits(texelFetch(firefly_limits, cell, 0).x);
#endif
}

vec4 column_of(ivec2 top) {
    vec4 sum = vec4(0.0);
    FireflyLimit limit;
    for (int y = 0; y < BLOCK_SIZE; ++y) {
        ivec2 p = top + ivec2(0, y);
        if (y % CELL_SIZE == 0) limit = limit_at(p);
        vec4 value = imageLoad(irradiance, nearest_inside(p));
        if (!takes_part(p, value)) continue;
        float l = luminance(value.rgb), share = 1.0 - kept_share(l, limit);
        sum += vec4(value.rgb * (share > 0.0 ? min(share, push.firefly_spread * limit.limit / l) : 0.0), 1.0);
    }
    return sum;
}

void cut_outliers() {
    ivec2 top = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    uint i = gl_LocalInvocationIndex;
    columns[i] = column_of(top);
    barrier();
    uint first = i - i % uint(BLOCK_SIZE);
    vec4 sum = columns[first];
    for (uint x = 1u; x < uint(BLOCK_SIZE); ++x) sum += columns[first + x];
    // In most blocks nothing is cut off.
    if (sum.rgb == vec3(0.0) && push.firefly_spread > 0.0) return;
    vec3 spread = sum.rgb / max(sum.a, 1.0);
    FireflyLimit limit = limit_at(top);
    if (limit.is_cluster) spread *= min(1.0, CLUSTER_SPREAD * push.firefly_spread * limit.limit / max(luminance(sum.rgb), 1e-6));
    for (int y = 0; y < BLOCK_SIZE; ++y) {
        ivec2 p = top + ivec2(0, y);
        if (y % CELL_SIZE == 0) limit = limit_at(p);
        vec4 value = imageLoad(irradiance, nearest_inside(p));
        if (!takes_part(p, value)) continue;
        imageStore(irradiance, p, vec4(storable(value.rgb * kept_share(luminance(value.rgb), limit) + spread), value.a));
    }
}

#if DIFFERENCE
void find_limits() {
    ivec2 cell;
    FireflyLimit limit;
    if (limit_of_cell(cell, limit)) {
        uint packed = pack_firefly_limit(limit);
        imageStore(firefly_limits, cell, uvec4(packed));
        cell_limits[gl_LocalInvocationIndex] = packed;
    }
    barrier();
}
#endif

void main() {
#if DIFFERENCE
    find_limits();
#endif
    cut_outliers();
#if DIFFERENCE
    // Of the pixels that this invocation has written itself.
    write_block_difference();
#endif
}
