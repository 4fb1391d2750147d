#version 450
// The split screen: two pictures side by side in one rectangle, tone-mapped, enlarged without smoothing, or the difference of both; and
// the magnifier.
// Source: tone curves as in glsl/tone_map.comp of the crate [Reinhard 2002, Narkowicz 2015].
// In:  left and right, radiance or display-referred. Out: linear Rec. 709, 1 is white; brighter only where the display can.
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "srgb.glsl"

layout(set = 0, binding = 0) uniform texture2D left;
layout(set = 0, binding = 1) uniform texture2D right;
layout(push_constant) uniform Presented {
    vec4 rect;         // of the picture in the window: corner and size, window pixels
    vec2 extent;       // of the picture, its own pixels
    vec2 lens;         // centre of the magnifier, window pixels; its x is negative where there is none
    float lens_side;   // window pixels
    float lens_zoom;   // window pixels for one of the picture
    float divider;     // 0..1 of the picture's width
    float exposure;
    uint display_referred;  // bit 0: left, bit 1: right
    uint tone_curve;
    float peak;        // of the display, over white; 1: no HDR
    float difference_range;  // 0: left and right side by side; else right minus left, in encoded values, that is black or white
} presented;
layout(location = 0) out vec4 colour;

const vec3 GROUND = vec3(0.012);

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec3 aces(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

// On a display that is brighter than white the shoulder begins later, and white stays white.
vec3 tone_mapped(vec3 radiance) {
    vec3 x = max(radiance * presented.exposure, 0.0);
    if (presented.peak > 1.0) return presented.tone_curve == 2u ? min(x, presented.peak) : x / (1.0 + luminance(x) / presented.peak);
    if (presented.tone_curve == 0u) x = aces(min(x, 1e4));
    else if (presented.tone_curve == 1u) x /= 1.0 + luminance(x);
    return clamp(x, 0.0, 1.0);
}

vec3 shown(vec3 value, uint side) {
    return (presented.display_referred >> side & 1u) != 0u ? value : tone_mapped(value);
}

// Grey where both are alike. Of encoded values, as the eye sees them and as pictures in files are subtracted.
vec3 difference(vec3 left_value, vec3 right_value) {
    vec3 change = srgb(min(right_value, 1.0)) - srgb(min(left_value, 1.0));
    return from_srgb(0.5 + 0.5 * clamp(change / presented.difference_range, -1.0, 1.0));
}

// At a place in the picture, its own pixels. The divider cuts between pixels of the window, not of the picture.
vec3 picture(vec2 position) {
    bool is_left = position.x < presented.divider * presented.extent.x;
    ivec2 p = clamp(ivec2(floor(position)), ivec2(0), ivec2(presented.extent) - 1);
    if (presented.difference_range > 0.0)
        return difference(shown(texelFetch(left, p, 0).rgb, 0u), shown(texelFetch(right, p, 0).rgb, 1u));
    return is_left ? shown(texelFetch(left, p, 0).rgb, 0u) : shown(texelFetch(right, p, 0).rgb, 1u);
}

void main() {
    vec2 p = gl_FragCoord.xy, scale = presented.extent / presented.rect.zw;
    vec2 position = (p - presented.rect.xy) * scale;
    bool inside = all(greaterThanEqual(position, vec2(0.0))) && all(lessThan(position, presented.extent));
    vec2 from_lens = abs(p - presented.lens);
    float reach = max(from_lens.x, from_lens.y);
    bool in_lens = presented.lens.x >= 0.0 && reach < 0.5 * presented.lens_side;
    vec2 offset = (p - presented.lens) / presented.lens_zoom;
    if (in_lens) position = floor((presented.lens - presented.rect.xy) * scale) + 0.5 + offset;
    // Once for the picture and the magnifier, since software devices run both sides of a branch.
    vec3 value = inside || in_lens ? picture(position) : GROUND;
    bool border = reach > 0.5 * presented.lens_side - 2.0;
    // A frame around the pixel whose numbers are shown.
    vec2 from_centre = abs(offset * presented.lens_zoom);
    float centre_reach = max(from_centre.x, from_centre.y);
    bool marked = centre_reach > 0.5 * presented.lens_zoom && centre_reach < 0.5 * presented.lens_zoom + 1.5;
    if (in_lens && (border || marked)) value = vec3(1.0);
    colour = vec4(value, 1.0);
}
