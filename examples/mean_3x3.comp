#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D estimate;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D filtered;
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), extent = imageSize(filtered);
    if (any(greaterThanEqual(p, extent))) return;
    vec4 centre = texelFetch(estimate, p, 0);
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec3 tap = texelFetch(estimate, clamp(p + ivec2(x, y), ivec2(0), extent - 1), 0).rgb;
            if (abs(luminance(tap) - luminance(centre.rgb)) <= 2.0 * centre.a + 1e-3) sum += vec4(tap, 1.0);
        }
    imageStore(filtered, p, vec4(sum.rgb / sum.a, centre.a));
}
