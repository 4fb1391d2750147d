// Ambient occlusion: one ray into the hemisphere, drawn by the cosine.
#ifndef AMBIENT_GLSL
#define AMBIENT_GLSL
#include "pixel_sample.glsl"
#include "bsdf.glsl"
#include "bvh.glsl"
#include "random.glsl"

// Tells its random numbers from those of the path in the same pixel.
const uint AMBIENT_SEED = 0x1b56c4e9u;

layout(push_constant) uniform Push {
    float reach;  // scene units; what is farther away occludes nothing
} push;

// How far away is what the ray meets, scene units; 0: nothing.
float ambient_hit(Surface s, inout Rng rng) {
    vec2 u = random2(rng);
    float r = sqrt(u.x);
    float phi = 2.0 * PI * u.y;
    vec3 direction = basis(s.normal) * vec3(r * cos(phi), r * sin(phi), sqrt(max(1.0 - u.x, 0.0)));
    Hit hit = closest_hit(ray_origin(s), direction);
    return hit.instance != NO_INSTANCE && hit.distance < push.reach ? hit.distance : 0.0;
}

#endif
