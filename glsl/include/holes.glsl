// Pixels whose irradiance is not that of a sample of their own. Twin: src/reference/holes.rs.
#ifndef HOLES_GLSL
#define HOLES_GLSL

// Alpha of the irradiance where it was filled in from neighbours, or where there was nothing to fill it from.
const float HOLE = -1.0;
const float EMPTY_HOLE = -2.0;

// Frames that the light of a pixel is worth: what was filled in is that of neighbours.
float sample_worth(float alpha) { return alpha >= 0.0 ? 1.0 : alpha == EMPTY_HOLE ? 0.0 : 0.5; }

#endif
