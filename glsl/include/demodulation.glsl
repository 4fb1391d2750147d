// Irradiance is radiance divided by albedo; the floor keeps the round trip exact where the albedo is black. [SVGF] 3.
#ifndef DEMODULATION_GLSL
#define DEMODULATION_GLSL

const float ALBEDO_EPSILON = 0.01;

#endif
