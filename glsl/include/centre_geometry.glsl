// What the geometry in the centre of a window is compared with: of surfaces, or, with VOLUME, of a volume before them.
// Twin: Geometry in src/reference/geometry_weights.rs. Needs the constant VOLUME; `float volume_sigma_z` in the shader's block `push`, and
// what geometry_weights.glsl needs there.
#ifndef CENTRE_GEOMETRY_GLSL
#define CENTRE_GEOMETRY_GLSL
#include "geometry_weights.glsl"
#include "volume.glsl"

struct Geometry {
    float depth;
    vec3 normal;    // of surfaces alone
    vec2 gradient;  // of surfaces alone: of depth, scene units per pixel
};

// Fog lies before the background as well.
bool is_filtered(uvec4 packed) { return VOLUME || unpack_depth(packed) != 0.0; }

Geometry geometry_of(uvec4 packed, uint gradient) {
    if (VOLUME) return Geometry(volume_depth(packed), vec3(0.0), vec2(0.0));
    return Geometry(unpack_depth(packed), unpack_normal(packed), unpackHalf2x16(gradient));
}

float depth_sharpness(Geometry centre, vec2 offset) {
    return VOLUME ? LOG2_E / push.volume_sigma_z : depth_sharpness(centre.depth, centre.gradient, offset);
}

// log2 of the weight of a tap. Of a volume by depth alone, and less strictly: [PSVGF], volumes.
float log2_weight(Geometry centre, uvec4 packed_q, float depth_sharpness) {
    if (VOLUME) return -relative_difference(centre.depth, volume_depth(packed_q)) * depth_sharpness;
    return log2_geometry_weight(centre.normal, unpack_direction(packed_q), centre.depth, unpack_depth(packed_q), depth_sharpness);
}

#endif
