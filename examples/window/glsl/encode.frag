#version 450
// Encodes what was drawn into the window for formats that do not do it themselves: the curve of sRGB, or HDR10.
// Source: sRGB [IEC 61966-2-1]; PQ [SMPTE ST 2084, eq. 5.2]; BT.709 to BT.2020 [ITU-R BT.2087, M2]; white [ITU-R BT.2408].
// In:  canvas, linear Rec. 709, 1 is white. Out: encoded 0..1.
#extension GL_GOOGLE_include_directive : require

#include "srgb.glsl"

layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInput canvas;
layout(push_constant) uniform Encoded {
    float white_nits;  // of white, cd/m2; 0: sRGB, no HDR
    float peak;        // of the display, over white
} encoded;
layout(location = 0) out vec4 colour;

// By rows, so the vector stands before it.
const mat3 BT2020_FROM_BT709 = mat3(
    0.627404, 0.329283, 0.043313,
    0.069097, 0.919540, 0.011362,
    0.016391, 0.088013, 0.895595);

// x: 1 is 10000 cd/m2.
vec3 pq(vec3 x) {
    vec3 p = pow(x, vec3(0.1593017578125));
    return pow((0.8359375 + 18.8515625 * p) / (1.0 + 18.6875 * p), vec3(78.84375));
}

void main() {
    vec3 x = subpassLoad(canvas).rgb;
    // The primaries come first: a colour that is outside of BT.709 is not outside of BT.2020.
    if (encoded.white_nits > 0.0) x = pq(clamp(x * BT2020_FROM_BT709, 0.0, encoded.peak) * (encoded.white_nits / 10000.0));
    else x = srgb(clamp(x, 0.0, 1.0));
    colour = vec4(x, 1.0);
}
