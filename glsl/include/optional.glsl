// Bindings that a shader can do without; its head lists them after `// optional:`. Needs `uint present` in the shader's block `push`.
// A binding that the graph leaves out is known when the pipeline is made, so that the code behind it vanishes.
#ifndef OPTIONAL_GLSL
#define OPTIONAL_GLSL

layout(constant_id = 0) const uint WIRED = 0xffffffffu;  // bit i: the graph gives binding i something

// Whether the graph has it, which every frame of it has: no branch is left.
bool is_wired(uint binding) { return (WIRED >> binding & 1u) != 0u; }

// Whether the graph has it, and the host bound it this frame.
bool is_present(uint binding) { return is_wired(binding) && (push.present >> binding & 1u) != 0u; }

#endif
