// Ray queries over a binary BVH of world-space triangles (32-byte nodes, depth first). A shadow ray leaves at its first hit. Triangles: Möller and Trumbore with stored edges.
#ifndef BVH_GLSL
#define BVH_GLSL
#include "scene.glsl"

const uint BVH_END = 0xffffffffu;
// What a leaf holds: the first triangle, and above it the number of triangles (0: an inner node).
const uint COUNT_SHIFT = 25u;
const uint FIRST_MASK = (1u << COUNT_SHIFT) - 1u;

struct Hit {
    float distance;
    uint instance;  // NO_INSTANCE: nothing was hit
    uint triangle;  // within the instance
    vec2 barycentrics;
    uint mask;      // MASK_*
};

// Entry distance of the ray into a box, or a huge number when it misses. `limit` is the nearest hit so far.
float box_entry(vec3 lower, vec3 upper, vec3 origin_over_direction, vec3 inverse_direction, float limit) {
    vec3 t0 = lower * inverse_direction - origin_over_direction;
    vec3 t1 = upper * inverse_direction - origin_over_direction;
    vec3 near = min(t0, t1);
    vec3 far = max(t0, t1);
    float entry = max(max(near.x, near.y), max(near.z, 0.0));
    float leave = min(min(far.x, far.y), min(far.z, limit));
    // One part in a million more room: rounding must not lose triangles that lie in a face of their box.
    return entry <= leave * 1.000002 ? entry : 3.0e38;
}

// Distance along the ray, or a negative number for a miss. `mask`: MASK_*.
float triangle_distance(uint index, vec3 origin, vec3 direction, out vec2 barycentrics, out uint mask) {
    vec3 corner = fetch_floats(bvh_triangles, 3u * index).xyz;
    vec3 edge1 = fetch_floats(bvh_triangles, 3u * index + 1u).xyz;
    uvec4 last = texelFetch(bvh_triangles, int(3u * index + 2u));
    vec3 edge2 = uintBitsToFloat(last.xyz);
    mask = last.w;
    vec3 p = cross(direction, edge2);
    float determinant = dot(edge1, p);
    float inverse = 1.0 / (determinant == 0.0 ? 1.0e-30 : determinant);
    vec3 t = origin - corner;
    float u = dot(t, p) * inverse;
    vec3 q = cross(t, edge1);
    float v = dot(direction, q) * inverse;
    barycentrics = vec2(u, v);
    bool inside = determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    return inside ? dot(edge2, q) * inverse : -1.0;
}

// A spray of leaves: 3x3 of them in the unit square, turned to and fro, with gaps in between.
bool is_leaf(vec2 uv) {
    vec2 cell = floor(uv * 3.0), in_cell = uv * 3.0 - cell - 0.5;
    float angle = 0.7 * sin(12.0 * cell.x + 5.0 * cell.y + 1.0);
    vec2 turned = mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * in_cell;
    return abs(turned.x) < 0.30 * max(0.0, 1.0 - 4.6 * turned.y * turned.y);
}

// Whether a ray that meets a triangle with holes meets a leaf.
bool meets_leaf(uint index, vec2 barycentrics) {
    uint instance = texelFetch(bvh_triangles, int(3u * index)).w, triangle = texelFetch(bvh_triangles, int(3u * index + 1u)).w;
    uint base = 6u * (texelFetch(instances, int(7u * instance + 6u)).x + triangle);
    vec2 uv[3];
    for (uint i = 0u; i < 3u; i++) uv[i] = vec2(fetch_floats(attributes, base + i).w, fetch_floats(attributes, base + 3u + i).w);
    return is_leaf(uv[0] * (1.0 - barycentrics.x - barycentrics.y) + uv[1] * barycentrics.x + uv[2] * barycentrics.y);
}

vec3 safe_inverse(vec3 direction) {
    vec3 magnitude = max(abs(direction), vec3(1.0e-12));
    return vec3(direction.x < 0.0 ? -1.0 : 1.0, direction.y < 0.0 ? -1.0 : 1.0, direction.z < 0.0 ? -1.0 : 1.0) / magnitude;
}

// Walks the tree depth first, without a stack: every node says where to go on when the ray misses its box. A stack in a shader is an array
// with an index of its own in every lane, which software devices serve lane by lane.
// `any_hit` and `meets_glass` are literals at every call, so that the compiler makes a function for each.
Hit traverse(vec3 origin, vec3 direction, float limit, bool any_hit, bool meets_glass) {
    Hit hit = Hit(limit, NO_INSTANCE, 0u, vec2(0.0), 0u);
    vec3 inverse_direction = safe_inverse(direction);
    vec3 scaled_origin = origin * inverse_direction;
    uint best = 0xffffffffu;
    uint node = 0u;
    while (node != BVH_END) {
        uvec4 lower = texelFetch(bvh_nodes, int(2u * node));
        uvec4 upper = texelFetch(bvh_nodes, int(2u * node + 1u));
        float entry = box_entry(uintBitsToFloat(lower.xyz), uintBitsToFloat(upper.xyz), scaled_origin, inverse_direction, hit.distance);
        uint count = upper.w >> COUNT_SHIFT;
        bool enters = entry < 1.0e38;
        node = enters && count == 0u ? node + 1u : lower.w;
        if (!enters || count == 0u) continue;
        uint first = upper.w & FIRST_MASK;
        for (uint i = first; i < first + count; i++) {
            vec2 barycentrics;
            uint mask;
            float t = triangle_distance(i, origin, direction, barycentrics, mask);
            bool meets = t > 0.0 && t < hit.distance && (meets_glass || mask < MASK_PANE);
            // A loop, since software devices skip one that no lane enters, and not a branch.
            for (bool asks = meets && mask == MASK_LEAVES; asks; asks = false) meets = meets_leaf(i, barycentrics);
            if (meets) {
                hit.distance = t;
                hit.barycentrics = barycentrics;
                best = i;
            }
        }
        if (any_hit && best != 0xffffffffu) break;
    }
    if (best != 0xffffffffu) {
        hit.instance = texelFetch(bvh_triangles, int(3u * best)).w;
        hit.triangle = texelFetch(bvh_triangles, int(3u * best + 1u)).w;
        hit.mask = texelFetch(bvh_triangles, int(3u * best + 2u)).w;
    }
    return hit;
}

// Rays pass through glass, but for these.
Hit closest_hit_or_glass(vec3 origin, vec3 direction, float limit) { return traverse(origin, direction, limit, false, true); }

Hit closest_hit(vec3 origin, vec3 direction) { return traverse(origin, direction, 3.0e37, false, false); }

bool occluded(vec3 origin, vec3 direction, float distance) { return traverse(origin, direction, distance, true, false).instance != NO_INSTANCE; }

#endif
