#version 450
// One half of the split screen: a weighted sum of four images of the engine, each enlarged to its size by the nearest pixel.
// In:  a, b, c, d and their weights. Out: pane. rgb: the sum (radiance, or display-referred where the images are); a: that of a.
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, rgba16f) uniform writeonly image2D pane;
layout(set = 0, binding = 1) uniform texture2D a;
layout(set = 0, binding = 2) uniform texture2D b;
layout(set = 0, binding = 3) uniform texture2D c;
layout(set = 0, binding = 4) uniform texture2D d;
layout(push_constant) uniform Weights { vec4 weights; };

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 extent = imageSize(pane);
    if (any(greaterThanEqual(p, extent))) return;
    vec4 first = texelFetch(a, p * textureSize(a, 0) / extent, 0);
    vec3 sum = weights.x * first.rgb;
    if (weights.y != 0.0) sum += weights.y * texelFetch(b, p * textureSize(b, 0) / extent, 0).rgb;
    if (weights.z != 0.0) sum += weights.z * texelFetch(c, p * textureSize(c, 0) / extent, 0).rgb;
    if (weights.w != 0.0) sum += weights.w * texelFetch(d, p * textureSize(d, 0) / extent, 0).rgb;
    imageStore(pane, p, vec4(min(sum, 65504.0), first.a));
}
