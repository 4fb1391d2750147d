// Whether the light around a pixel is rare: the last bit that a half keeps of its deviation. Twin: src/reference/rare_light.rs.
#ifndef RARE_LIGHT_GLSL
#define RARE_LIGHT_GLSL

// Pixels of a window that have its light, so many of which are few.
const float FEW_LIT = 3.0;

// A mark on more would round to infinity.
const float LARGEST_MARKED = 65000.0;

bool is_rare(float deviation) { return (floatBitsToUint(deviation) & 0x2000u) != 0u; }

// The nearest half with that last bit.
float marked(float deviation, bool rare) {
    uint last = rare ? 0x2000u : 0u;
    return uintBitsToFloat((floatBitsToUint(min(deviation, LARGEST_MARKED)) + 0x2000u - last & 0xffffc000u) | last);
}

#endif
