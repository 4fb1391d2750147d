// What the hosts of this folder share: the inputs of a frame in memory that the device copies from, and a check of every call.
#pragma once
#include <cstring>

#include "atrous.h"
#include "engine.hpp"
#include "synthetic.hpp"

inline void check(AtrousStatus status, const char* call) {
    if (status == ATROUS_STATUS_OK) return;
    std::fprintf(stderr, "%s: %s: %s\n", call, atrous_status_name(status), atrous_last_error());
    std::exit(1);
}

namespace scene {

constexpr VkDeviceSize bytes_each = synthetic::width * synthetic::height * 16;
constexpr VkDeviceSize result_bytes = synthetic::width * synthetic::height * 8;
// The last one is what the engine's path tracer makes.
const char* const names[] = {"depth", "normal", "motion", "albedo", "surface_id", "noisy_radiance"};
constexpr size_t count = 6, ids = 4;

inline VkFormat format(size_t input) { return input == ids ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32B32A32_SFLOAT; }

inline size_t index_of(const char* name) {
    size_t i = 0;
    while (i < count && std::strcmp(names[i], name) != 0) ++i;
    return i;
}

inline void write(const synthetic::Frame& frame, uint8_t* to) {
    const void* const texels[] = {frame.depth.data(),  frame.normal.data(),     frame.motion.data(),
                                  frame.albedo.data(), frame.surface_id.data(), frame.noisy_radiance.data()};
    for (size_t i = 0; i < count; ++i) std::memcpy(to + i * bytes_each, texels[i], i == ids ? bytes_each / 4 : bytes_each);
}

// The whole image, and the part of a buffer that has its texels.
inline VkBufferImageCopy copy(size_t input) {
    return {input * bytes_each, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {synthetic::width, synthetic::height, 1}};
}

inline AtrousFrameParams params(uint32_t index) {
    AtrousFrameParams params{};
    params.struct_size = sizeof params;
    CHECK(atrous_frame_params_default(&params, synthetic::width, synthetic::height));
    params.frame_slot = index % 2;
    synthetic::view_from_world(index, params.view_from_world);
    synthetic::clip_from_view(params.clip_from_view);
    return params;
}

inline uint64_t checksum(const uint8_t* result) { return synthetic::checksum(result, result_bytes); }

}  // namespace scene
