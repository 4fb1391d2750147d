// A stage of a host that works in place: the mean of an image and of what is there.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D from;
layout(set = 0, binding = 1, rgba16f) uniform image2D to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(to)))) return;
    vec4 mean = 0.5 * (texelFetch(from, min(pixel, textureSize(from, 0) - 1), 0) + imageLoad(to, pixel));
    imageStore(to, pixel, mean);
}
