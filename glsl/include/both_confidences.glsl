// Confidence in the histories of diffuse and of specular light in one number. Read as it is, it is that of diffuse light, less a part in 4096 at
// most. Twin: src/reference/both_confidences.rs.
#ifndef BOTH_CONFIDENCES_GLSL
#define BOTH_CONFIDENCES_GLSL

// Bits of specular light: steps of 1/2048, the last of which is 1.
const uint SPECULAR_BITS = 0x7ffu;
// The largest number that stays below 1 with any of them.
const uint MOST_OF_DIFFUSE = 0x3f7ff800u;
// No denormal, which a device may take for 0.
const float LEAST_OF_DIFFUSE = 1.0 / 1048576.0;

float both_confidences(float diffuse, float specular) {
    uint upper = min(floatBitsToUint(max(diffuse, LEAST_OF_DIFFUSE)) & ~SPECULAR_BITS, MOST_OF_DIFFUSE);
    return uintBitsToFloat(upper | min(uint(specular * 2048.0 + 0.5), SPECULAR_BITS));
}

// By how much diffuse light changed, of the confidence in its history: 0 and 1 are exact with anything beside them.
float change_by(float confidence) {
    if (confidence >= uintBitsToFloat(MOST_OF_DIFFUSE)) return 0.0;
    return confidence < 2.0 * LEAST_OF_DIFFUSE ? 1.0 : 1.0 - confidence;
}

float specular_confidence(float both) {
    uint steps = floatBitsToUint(both) & SPECULAR_BITS;
    return steps == SPECULAR_BITS ? 1.0 : float(steps) / 2048.0;
}

#endif
