// Twin: src/reference/blocks.rs. Needs `float percentile_range` in the shader's block `push`.
#ifndef PERCENTILE_RANGE_GLSL
#define PERCENTILE_RANGE_GLSL

// [PSVGF] IPR: by how much a luminance may leave the percentiles and still be usual.
float percentile_range(vec2 low_up) { return (low_up.y - low_up.x) * push.percentile_range; }

#endif
