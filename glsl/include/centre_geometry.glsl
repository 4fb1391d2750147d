// What the geometry in the centre of a window is compared with: of surfaces, or, with VOLUME, of a volume before them.
// Twin: Geometry in src/reference/geometry_weights.rs. Needs the constant VOLUME; `float volume_sigma_z` in the shader's block `push`, and
// what geometry_weights.glsl needs there.
#ifndef CENTRE_GEOMETRY_GLSL
#define CENTRE_GEOMETRY_GLSL
#include "geometry_weights.glsl"
#include "volume.glsl"

struct Geometry {
    EdgeCentre surface;
    float volume_depth;
};

// Fog lies before the background as well.
bool is_filtered(GuideBits packed) { return VOLUME || guide_depth(packed) != 0.0; }

// A surface takes from surfaces alone, a volume from every pixel.
bool takes_part(Geometry centre, GuideBits packed_q) { return VOLUME || is_alike(centre.surface, packed_q); }

Geometry geometry_of(GuideBits packed) {
    return Geometry(edge_centre(packed), VOLUME ? volume_depth(packed) : 0.0);
}

float depth_sharpness(Geometry centre, vec2 offset) {
    return VOLUME ? LOG2_E / push.volume_sigma_z : depth_sharpness(centre.surface, offset);
}

// log2 of the weight of a tap. Of a volume by depth alone, and less strictly: [PSVGF], volumes.
float log2_weight(Geometry centre, GuideBits packed_q, float depth_sharpness) {
    if (VOLUME) return -relative_difference(centre.volume_depth, volume_depth(packed_q)) * depth_sharpness;
    return log2_edge_weight(centre.surface, packed_q, depth_sharpness);
}

#endif
