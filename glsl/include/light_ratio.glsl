// How far a history is true again once it is scaled by the ratio of light. Twin: src/reference/light_ratio.rs.
#ifndef LIGHT_RATIO_GLSL
#define LIGHT_RATIO_GLSL

// The relative spread of a ratio, among samples or between strata: what is below COHERENT is rounding, what is above INCOHERENT is no ratio.
const float COHERENT = 0.1;
const float INCOHERENT = 0.3;

// 1, true, to 0.
float coherence_of(float spread) { return clamp((INCOHERENT - spread) / (INCOHERENT - COHERENT), 0.0, 1.0); }

#endif
