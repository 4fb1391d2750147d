// Random numbers for one pixel: a PCG stream from the pixel's seed, or Owen-scrambled Sobol' points. Both depend on the seed and the sample
// index alone, so that equal seeds give equal light paths. With RANDOM_SOBOL defined always the latter, one pixel's samples after another.
// Else one sample a pixel, whose noise is white, or blue: then the pixels of a frame share one sequence along a Z-order curve, so that neighbours
// have numbers that complement each other and the errors of a neighbourhood cancel [Ahmed and Wonka 2020].
// [Jarzynski and Olano 2020] for the hash, [Burley 2020] for the scrambling and for padding pairs of dimensions.
#ifndef RANDOM_GLSL
#define RANDOM_GLSL
#include "scene.glsl"

uint pcg_hash(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Top 24 bits, so that 1.0 is never returned.
float unit_float(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

struct Rng {
    uint state;
    uint sample_index; // with its bits in reverse
};

vec2 white2(inout Rng rng) {
    rng.state = rng.state * 747796405u + 2891336453u;
    uint x = pcg_hash(rng.state);
    rng.state = rng.state * 747796405u + 2891336453u;
    return vec2(unit_float(x), unit_float(pcg_hash(rng.state)));
}

// Tells the reference's random numbers from the noisy picture's.
const uint REFERENCE_SEED = 0x5bd1e995u;

// Laine-Karras permutation on bit-reversed numbers: an Owen scramble, with Vegdahl's constants.
uint laine_karras(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The second Sobol' dimension before bit reversal: the Pascal matrix modulo 2, factor by factor.
uint pascal(uint x) {
    x ^= x >> 16u;
    x ^= (x & 0xff00ff00u) >> 8u;
    x ^= (x & 0xf0f0f0f0u) >> 4u;
    x ^= (x & 0xccccccccu) >> 2u;
    x ^= (x & 0xaaaaaaaau) >> 1u;
    return x;
}

// Each call is one pair of dimensions: the sample order is shuffled, then both coordinates are scrambled.
vec2 sobol2(inout Rng rng) {
    rng.state = pcg_hash(rng.state + 0x9e3779b9u);
    uint index = bitfieldReverse(laine_karras(rng.sample_index, rng.state));
    uint x = bitfieldReverse(laine_karras(index, pcg_hash(rng.state ^ 0x68bc21ebu)));
    uint y = bitfieldReverse(laine_karras(pascal(index), pcg_hash(rng.state ^ 0x02e5be93u)));
    return vec2(unit_float(x), unit_float(y));
}

#ifdef RANDOM_SOBOL

Rng rng_new(uint seed, uint sample_index) { return Rng(seed, bitfieldReverse(sample_index)); }
vec2 random2(inout Rng rng) { return sobol2(rng); }

#else

bool is_noise_blue() { return frame.sky_horizon.a != 0.0; }

// The number of a pixel along the Z-order curve.
uint morton(uvec2 pixel) {
    for (uint shift = 8u, mask = 0x00ff00ffu; shift > 0u; shift >>= 1u, mask ^= mask << shift) pixel = (pixel | pixel << shift) & mask;
    return pixel.x | pixel.y << 1u;
}

// Blue noise: bits 0 to 23: the number of the pixel, of 4096x4096; the others tell frames apart.
uint pixel_seed(uvec2 pixel, uint frame_index, uint user_seed) {
    if (is_noise_blue()) return (morton(pixel) & 0xffffffu) | (frame_index + pcg_hash(user_seed)) << 24u;
    return pcg_hash(pcg_hash(pixel.x + pcg_hash(pixel.y)) + pcg_hash(frame_index + pcg_hash(user_seed)));
}

// `salt` tells apart what the same pixel needs numbers for.
Rng rng_of_pixel(uint seed, uint salt) {
    if (is_noise_blue()) return Rng(pcg_hash(seed >> 24u) ^ salt, bitfieldReverse(seed & 0xffffffu));
    return Rng(seed ^ salt, 0u);
}

vec2 random2(inout Rng rng) { return is_noise_blue() ? sobol2(rng) : white2(rng); }

#endif
#endif
