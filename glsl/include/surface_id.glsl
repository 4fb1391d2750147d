// The host's id of a pixel. Needs the binding `surface_id` at SURFACE_ID_IMAGE where SURFACE_ID is 1. Without SURFACE_ID it is an optional
// one, and needs optional.glsl.
#ifndef SURFACE_ID_GLSL
#define SURFACE_ID_GLSL
#include "viewport.glsl"

uint id_at(ivec2 p) {
#ifndef SURFACE_ID
    return is_present(SURFACE_ID_IMAGE) ? texelFetch(surface_id, host_pixel(SURFACE_ID_IMAGE, p), 0).x : 1u;
#elif SURFACE_ID
    return texelFetch(surface_id, host_pixel(SURFACE_ID_IMAGE, p), 0).x;
#else
    return 1u;
#endif
}

#endif
