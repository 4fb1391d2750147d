// A stage of a host: copies an image.
#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D from;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D to;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(to)))) return;
    imageStore(to, pixel, texelFetch(from, min(pixel, textureSize(from, 0) - 1), 0));
}
