// How curved a mirror is, and by how much it pulls the image of what it shows near. Twin: src/reference/curvature.rs.
// Source: Coddington's equations, of a wave front that meets a curved surface aslant.
#ifndef CURVATURE_GLSL
#define CURVATURE_GLSL

// From a surface point to one beside it.
struct Step {
    vec3 way;   // scene units
    vec3 turn;  // of the normal
};

// 1 / scene unit; positive: convex.
float curvature_of(Step to) { return dot(to.turn, to.way) / max(dot(to.way, to.way), 1e-20); }

// How the surface of a mirror is curved, in axes at right angles to the line of sight.
struct Curvature {
    vec3 along;   // in the plane of incidence
    vec3 across;  // at right angles to it
    vec3 power;   // xx, xy, yy, 1 / scene unit: what a wave front becomes more curved by
    float mean;   // of the surface, 1 / scene unit; positive: convex
};

// Symmetric 2x2 matrices: xx, xy, yy.
const vec3 UNIT_MATRIX = vec3(1.0, 0.0, 1.0);

vec2 solved(vec3 m, vec2 v) { return vec2(m.z * v.x - m.y * v.y, m.x * v.y - m.y * v.x) / (m.x * m.z - m.y * m.y); }

// With eigenvalues of at least `least`.
vec3 bounded(vec3 m, float least) {
    float middle = 0.5 * (m.x + m.z), half_difference = 0.5 * (m.x - m.z), radius = length(vec2(half_difference, m.y));
    float larger = max(middle + radius, least), smaller = max(middle - radius, least);
    float scale = 0.5 * (larger - smaller) / max(radius, 1e-20);
    return 0.5 * (larger + smaller) * UNIT_MATRIX + scale * vec3(half_difference, m.y, -half_difference);
}

// Of the surface, from two steps and what the normal turns by: xx, xy, yy in the axes of both. A step of no length is one at right angles to
// the other, along which nothing turns.
vec3 curvature_between(vec2 first, vec2 first_turn, vec2 second, vec2 second_turn) {
    if (first == vec2(0.0)) first = vec2(second.y, -second.x);
    if (second == vec2(0.0)) second = vec2(-first.y, first.x);
    float area = first.x * second.y - first.y * second.x;
    // Steps that lie next to one line tell nothing of what is beside it.
    float inverse = abs(area) > 0.01 * (length(first) * length(second)) ? 1.0 / area : 0.0;
    float xx = first_turn.x * second.y - second_turn.x * first.y, yy = second_turn.y * first.x - first_turn.y * second.x;
    float mixed = second_turn.x * first.x - first_turn.x * second.x + first_turn.y * second.y - second_turn.y * first.y;
    return vec3(xx, 0.5 * mixed, yy) * inverse;
}

// From two steps on a surface that is seen along `sight`.
Curvature curvature_by(vec3 normal, vec3 sight, Step x, Step y) {
    vec3 across = cross(normal, sight);
    if (dot(across, across) < 1e-6) across = cross(sight, abs(sight.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    across = normalize(across);
    vec3 tangent = cross(across, normal);
    vec3 curvature = curvature_between(vec2(dot(x.way, tangent), dot(x.way, across)), vec2(dot(x.turn, tangent), dot(x.turn, across)),
        vec2(dot(y.way, tangent), dot(y.way, across)), vec2(dot(y.turn, tangent), dot(y.turn, across)));
    // In the plane of incidence a surface is longer than it looks.
    float cosine = max(-dot(normal, sight), 0.05);
    vec3 power = 2.0 * curvature * vec3(1.0 / cosine, 1.0, cosine);
    return Curvature(cross(sight, across), across, power, 0.5 * (curvature.x + curvature.z));
}

#endif
