#ifndef LIGHT_RADIUS_GLSL
#define LIGHT_RADIUS_GLSL

// Angular radius of each light whose visibility is filtered. Needs light_radius in the push constants, with MANY also _1 to _3.
float radius_of(const int light) {
#if MANY
    if (light == 1) return push.light_radius_1;
    if (light == 2) return push.light_radius_2;
    if (light == 3) return push.light_radius_3;
#endif
    return push.light_radius;
}

#endif
