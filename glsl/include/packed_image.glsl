// An image of four packed 16-bit numbers whose neighbours are read: `PACKED_IMAGE(binding, name);`, then `packed_at(name, pixel)`; or of 32
// packed bits: `PACKED_IMAGE_32`.
// With one signal a storage image: software Vulkan takes two thirds of the time for those, GPUs the same. With two a sampled one, since
// Vulkan guarantees four storage images alone, unless PACKED_IN_STORAGE says that all others are sampled.
#ifndef PACKED_IMAGE_GLSL
#define PACKED_IMAGE_GLSL

#if SIGNALS == 1 || defined(PACKED_IN_STORAGE)
#define PACKED_IMAGE(number, name) layout(set = 0, binding = number, rgba16ui) uniform restrict readonly uimage2D name
#define PACKED_IMAGE_32(number, name) layout(set = 0, binding = number, r32ui) uniform restrict readonly uimage2D name
#define packed_at(name, pixel) imageLoad(name, pixel)
#else
#define PACKED_IMAGE(number, name) layout(set = 0, binding = number) uniform utexture2D name
#define PACKED_IMAGE_32(number, name) PACKED_IMAGE(number, name)
#define packed_at(name, pixel) texelFetch(name, pixel, 0)
#endif

#endif
