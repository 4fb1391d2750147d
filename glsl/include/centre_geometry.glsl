// What the geometry in the centre of a window is compared with, of surfaces, or, with VOLUME, of a volume before them.
// Twin: Geometry in src/reference/geometry_weights.rs.
#ifndef CENTRE_GEOMETRY_GLSL
#define CENTRE_GEOMETRY_GLSL
#include "geometry_weights.glsl"
#include "volume.glsl"

#ifdef VOLUME
struct Geometry {
    float depth;
};

// Fog lies before the background as well.
bool is_filtered(uvec4 packed) { return true; }

Geometry geometry_of(uvec4 packed) { return Geometry(volume_depth(packed)); }

// log2 of the weight. [PSVGF], volumes: by depth alone, and less strictly.
float log2_weight(Geometry centre, uvec4 packed_q, vec2 offset) {
    return -LOG2_E * relative_difference(centre.depth, volume_depth(packed_q)) / frame.volume_sigma_z;
}

float sigma_l() { return frame.volume_sigma_l; }
#else
struct Geometry {
    float depth;
    vec3 normal;
    vec2 gradient;
};

bool is_filtered(uvec4 packed) { return unpack_depth(packed) != 0.0; }

Geometry geometry_of(uvec4 packed, uint gradient) {
    return Geometry(unpack_depth(packed), unpack_normal(packed), unpackHalf2x16(gradient));
}

float log2_weight(Geometry centre, uvec4 packed_q, vec2 offset) {
    return log2_geometry_weight(centre.normal, unpack_normal(packed_q), centre.depth, unpack_depth(packed_q), centre.gradient, offset);
}

float sigma_l() { return frame.sigma_l; }
#endif

#endif
