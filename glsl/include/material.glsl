// Numbers of a host's class of materials. Twin: src/reference/material.rs.
// Needs the input material_class at the binding MATERIAL_CLASS.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL
#include "frame.glsl"
#include "viewport.glsl"

struct Material {
    float depth;            // factors: of tolerated differences of depth,
    float normal;           // of 1 - cosine of normals,
    float light;            // and of sigma_l
    float longest_history;  // frames
};

// Where the host has no classes.
const Material USUAL_MATERIAL = Material(1.0, 1.0, 1.0, 3e38);

uint class_at(ivec2 p) { return texelFetch(material_class, host_pixel(MATERIAL_CLASS, guide_pixel(p)), 0).x; }

bool is_class(uint number) { return number < uint(frame.materials.length()); }

// Of a pixel of light. What is beyond the table counts as class 0.
Material material_at(ivec2 p) {
    uint number = class_at(p);
    vec4 m = frame.materials[is_class(number) ? number : 0u];
    return Material(m.x, m.y, m.z, m.w);
}

#endif
