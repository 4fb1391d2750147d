// The push constants of every shader. Twin: PushConstants in src/shaders.rs; the build asserts equal offsets.
#ifndef PUSH_CONSTANTS_GLSL
#define PUSH_CONSTANTS_GLSL

layout(push_constant) uniform PushConstants {
    uint level;    // à-trous level; 0 where a shader has none
    uint present;  // bit i: binding i is bound, not absent
} push;

bool is_present(uint binding) { return (push.present >> binding & 1u) != 0u; }

#endif
