// A pixel without a sample takes the mean of the samples around it that show the same surface.
// Source: ours; weights by distance of [Shepard 1968], edges of [SVGF] eq. 3 and 4. Twin: src/reference/holes.rs.
#ifndef HOLE_FILLING_GLSL
#define HOLE_FILLING_GLSL
#include "geometry_weights.glsl"
#include "holes.glsl"
#include "luminance.glsl"

struct Filling {
    vec4 edges;  // rgb, weight
    vec4 plain;  // the same of all samples of surfaces, or of the background
};

Filling no_filling() { return Filling(vec4(0.0), vec4(0.0)); }

bool is_of_same_kind(EdgeCentre centre, GuideBits packed_tap) { return (guide_depth(packed_tap) == 0.0) == (centre.depth == 0.0); }

// A sample `way` pixels from the hole.
void add_sample(inout Filling sum, vec3 irradiance, GuideBits packed, vec2 way, EdgeCentre centre) {
    float weight = 1.0 / dot(way, way);
    sum.plain += weight * vec4(irradiance, 1.0);
    float by_edges = is_alike(centre, packed) ? exp2(log2_edge_weight(centre, packed, depth_sharpness(centre, way))) : 0.0;
    if (centre.depth != 0.0) weight *= by_edges;
    sum.edges += weight * vec4(irradiance, 1.0);
}

vec4 filled_hole(Filling sum) {
    vec4 mean = sum.edges.a >= 1e-6 ? sum.edges : sum.plain;
    return mean.a > 0.0 ? vec4(storable(mean.rgb / mean.a), HOLE) : vec4(vec3(0.0), EMPTY_HOLE);
}

#endif
