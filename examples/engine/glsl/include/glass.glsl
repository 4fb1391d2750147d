// What is seen through glass and in it: the line of sight, followed without chance until it meets something else. Thin panes let it pass as it
// is; bodies refract it by their index [Snell]. Where glass mirrors, it does so once, at the first glass that is met.
#ifndef GLASS_GLSL
#define GLASS_GLSL
#include "bvh.glsl"
#include "surface.glsl"
#include "camera.glsl"

// Of the frame's constants: guides and signals of the glass itself; of what is seen through it, with its reflection as specular light; of what is seen
// through it alone; of its reflection alone.
const uint GLASS_ITSELF = 0u;
const uint GLASS_LAYERS = 1u;
const uint GLASS_THROUGH = 2u;
const uint GLASS_REFLECTION = 3u;

// Meetings with glass; a line of sight that has more ends black.
const uint GLASS_LIMIT = 6u;
const float GLASS_INDEX = 1.5;
// Added to the surface_id of what is seen through panes, through bodies, and in both.
const uint ID_THROUGH_PANE = 1000u;
const uint ID_THROUGH_BODY = 2000u;
const uint ID_REFLECTED = 4000u;

struct Sight {
    Hit hit;         // where it ends
    vec3 from;       // where its last part begins
    vec3 direction;  // of that part, unit length
    float distance;  // up to there, scene units
    float to_glass;  // up to the first glass
    vec3 weight;     // share of the light that arrives
    mat3 turn;       // from directions at its end to those as the eye sees them
    uint meetings;
    uint id;         // added to that of what it ends at
};

float dielectric_reflectance(float cosine, float ratio) {
    float sine2 = ratio * ratio * (1.0 - cosine * cosine);
    if (sine2 >= 1.0) return 1.0;
    float inside = sqrt(1.0 - sine2);
    float s = (ratio * cosine - inside) / (ratio * cosine + inside);
    float p = (ratio * inside - cosine) / (ratio * inside + cosine);
    return 0.5 * (s * s + p * p);
}

// The smallest turn that carries the unit vector a to b.
mat3 turn_of(vec3 a, vec3 b) {
    vec3 axis = cross(a, b);
    float k = 1.0 / max(1.0 + dot(a, b), 1.0e-4);
    return mat3(
        axis.x * axis.x * k + dot(a, b), axis.y * axis.x * k + axis.z, axis.z * axis.x * k - axis.y,
        axis.x * axis.y * k - axis.z, axis.y * axis.y * k + dot(a, b), axis.z * axis.y * k + axis.x,
        axis.x * axis.z * k + axis.y, axis.y * axis.z * k - axis.x, axis.z * axis.z * k + dot(a, b));
}

mat3 mirror_at(vec3 n) { return mat3(1.0) - 2.0 * outerProduct(n, n); }

// Unit normal on the side that the triangles' winding faces, and the colour of the glass.
void glass_at(Hit hit, out vec3 normal, out vec3 tint) {
    Instance instance = load_instance(hit.instance);
    TriangleAttributes t = load_triangle(instance.first_triangle + hit.triangle);
    vec3 n = interpolate(t.normal_v[0].xyz, t.normal_v[1].xyz, t.normal_v[2].xyz, hit.barycentrics);
    normal = normalize(transform_normal(instance.world_from_object, n));
    tint = load_material(instance.material).base_color;
}

// `mirrored`: by the first glass. `limit`: meetings at most, so that 0 sees the glass itself.
Sight follow(vec3 eye, vec3 direction, bool mirrored, uint limit) {
    Sight sight = Sight(Hit(0.0, NO_INSTANCE, 0u, vec2(0.0), 0u), eye, direction, 0.0, 0.0, vec3(1.0), mat3(1.0), 0u, 0u);
    for (uint i = 0u; i <= limit; i++) {
        sight.hit = closest_hit_or_glass(sight.from, sight.direction, 3.0e37);
        if (sight.hit.instance == NO_INSTANCE || sight.hit.mask < MASK_PANE || i == limit) break;
        vec3 normal, tint;
        glass_at(sight.hit, normal, tint);
        bool leaves = dot(normal, sight.direction) > 0.0;
        if (leaves) normal = -normal;
        float cosine = min(-dot(normal, sight.direction), 1.0);
        bool pane = sight.hit.mask == MASK_PANE;
        float ratio = leaves && !pane ? GLASS_INDEX : 1.0 / GLASS_INDEX;
        float reflectance = dielectric_reflectance(cosine, ratio);
        // Both faces of a pane, with all that goes to and fro between them.
        if (pane) reflectance = 2.0 * reflectance / (1.0 + reflectance);
        bool mirrors = (mirrored && sight.meetings == 0u) || reflectance >= 1.0;
        vec3 onwards = sight.direction;
        mat3 turn = mat3(1.0);
        if (mirrors) {
            onwards = reflect(sight.direction, normal);
            turn = mirror_at(normal);
        } else if (!pane) {
            onwards = normalize(refract(sight.direction, normal, ratio));
            turn = turn_of(onwards, sight.direction);
        }
        sight.weight *= mirrors ? vec3(reflectance) : tint * (1.0 - reflectance);
        if (sight.meetings == 0u) {
            sight.to_glass = sight.hit.distance;
            sight.id = mirrors ? ID_REFLECTED : 0u;
        }
        sight.id = max(sight.id, sight.id / ID_REFLECTED * ID_REFLECTED + (pane ? ID_THROUGH_PANE : ID_THROUGH_BODY));
        sight.turn = sight.turn * turn;
        sight.distance += sight.hit.distance;
        sight.from += sight.direction * sight.hit.distance + onwards * frame.jitter_epsilon_weight.z;
        sight.direction = onwards;
        sight.meetings++;
    }
    // Glass after glass.
    if (limit > 0u && sight.hit.mask >= MASK_PANE && sight.hit.instance != NO_INSTANCE) sight.weight = vec3(0.0);
    return sight;
}

// Where the glass, which stands still, showed a point from another eye: Newton's steps on the distance of the point from the last part of the line of
// sight. xy: pixel position, continuous, without jitter; z: linear depth of its image.
vec3 find_through_glass(CameraFrame camera, vec2 pixel_position, vec3 point, bool mirrored, uint meetings) {
    vec2 at = pixel_position;
    float depth = 0.0;
    vec2 middle = vec2(0.0), right = vec2(0.0);
    mat3 plane = mat3(1.0);
    const float STEP = 0.25;
    for (uint i = 0u; i < 10u; i++) {
        uint part = i % 3u;
        vec2 looked = at + (part == 1u ? vec2(STEP, 0.0) : part == 2u ? vec2(0.0, STEP) : vec2(0.0));
        vec3 ray = ray_direction(camera, looked);
        Sight sight = follow(camera.eye.xyz, normalize(ray), mirrored, meetings);
        if (sight.meetings != meetings) break;
        vec3 offset = point - sight.from;
        if (part == 0u) {
            float along = dot(offset, sight.direction);
            depth = (sight.distance + along) / length(ray);
            vec3 x = normalize(abs(sight.direction.y) < 0.9 ? cross(sight.direction, vec3(0.0, 1.0, 0.0)) : cross(sight.direction, vec3(1.0, 0.0, 0.0)));
            plane = mat3(x, cross(sight.direction, x), sight.direction);
        }
        // In the plane across the first line of sight, so that all three are compared alike.
        vec2 off = (offset * plane).xy - (sight.direction * plane).xy * (dot(offset, plane[2]) / max(dot(sight.direction, plane[2]), 0.1));
        if (part == 0u) middle = off;
        if (part == 1u) right = (off - middle) / STEP;
        if (part == 2u) {
            mat2 jacobian = mat2(right, (off - middle) / STEP);
            float area = determinant(jacobian);
            if (abs(area) < 1.0e-20) break;
            vec2 to = -(inverse(jacobian) * middle);
            // A step that leads far away leaves where it is linear.
            float size = length(to);
            at += to * min(1.0, 16.0 / max(size, 1.0e-6));
        }
    }
    return vec3(at, depth);
}

#endif
