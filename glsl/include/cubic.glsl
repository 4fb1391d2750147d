// Twin: src/nodes/temporal_accumulation/twin/taps.rs.
#ifndef CUBIC_GLSL
#define CUBIC_GLSL

// Catmull and Rom's weights of four taps in a row, `t` from the second to the third.
vec4 cubic_weights(float t) {
    return vec4(t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t));
}

// The sum of weights of 2x2 taps of which none was refused.
const float WHOLE_WEIGHT = 0.999;

#endif
