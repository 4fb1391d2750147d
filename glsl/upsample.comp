#version 450
// Brings light that was filtered at fewer pixels to each pixel of the guides: joint bilateral, by planes and normals. An invocation has a
// pixel of light, and writes the rendered pixels that it stands for: their taps are the same.
// Source: [Kopf 2007], joint bilateral upsampling; the weights are ours.
// In:  depth, normal, surface_id and albedo of the host; guide of the pixels with light; filtered irradiance per signal, or with NUMBER one
//      visibility.
// Out: upsampled, the same for every pixel.
// variants: NUMBER=0 NUMBER=1
// optional: filtered_1, upsampled_1, normal, surface_id, albedo
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "luminance.glsl"
#include "optional.glsl"

layout(local_size_x = 32, local_size_y = 2) in;

const uint FILTERED_1 = 4u;
const uint UPSAMPLED_1 = 6u;
const uint DEPTH = 1u;
const uint NORMAL = 7u;
const uint SURFACE_ID_IMAGE = 8u;
const uint ALBEDO = 9u;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform texture2D filtered_0;
layout(set = 0, binding = FILTERED_1) uniform texture2D filtered_1;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
#if NUMBER
#define FORMAT r32f
#else
#define FORMAT rgba16f
#endif
layout(set = 0, binding = 5, FORMAT) uniform writeonly image2D upsampled_0;
layout(set = 0, binding = UPSAMPLED_1, FORMAT) uniform writeonly image2D upsampled_1;

#include "upsampling.glsl"

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!has_light(p)) return;
    Centre centres[CELL];
    gather(p, centres);
    [[unroll]] for (int k = 0; k < CELL; ++k) {
        ivec2 place;
        if (!is_in_cell(k, place)) continue;
        ivec2 to = p * ivec2(frame.light_ratio) + place;
        float total = centres[k].sum_0.a;
#if NUMBER
        imageStore(upsampled_0, to, vec4(centres[k].sum_0.rgb / total, 0.0));
#else
        imageStore(upsampled_0, to, vec4(storable(centres[k].sum_0.rgb / total), 0.0));
        if (is_present(FILTERED_1)) imageStore(upsampled_1, to, vec4(storable(centres[k].sum_1 / total), 0.0));
#endif
    }
}
