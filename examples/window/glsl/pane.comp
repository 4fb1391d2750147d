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

vec4 enlarged(texture2D image, ivec2 p, ivec2 extent) { return texelFetch(image, p * textureSize(image, 0) / extent, 0); }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 extent = imageSize(pane);
    if (any(greaterThanEqual(p, extent))) return;
    vec4 first = enlarged(a, p, extent);
    vec3 sum = weights.x * first.rgb;
    if (weights.y != 0.0) sum += weights.y * enlarged(b, p, extent).rgb;
    if (weights.z != 0.0) sum += weights.z * enlarged(c, p, extent).rgb;
    if (weights.w != 0.0) sum += weights.w * enlarged(d, p, extent).rgb;
    imageStore(pane, p, vec4(min(sum, 65504.0), first.a));
}
