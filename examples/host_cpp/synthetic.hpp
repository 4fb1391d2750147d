// The frames of crates/synthetic, in C++: the same operations in the same order give the same bits.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace synthetic {

constexpr uint32_t width = 76, height = 44, frames = 4;
constexpr float focal = 1.25f, wall_depth = 6.0f, speed = 0.0625f, aspect = float(width) / float(height);

using Texel = std::array<float, 4>;

struct Frame {
    std::vector<Texel> depth, normal, motion, albedo, noisy_radiance;
    std::vector<uint32_t> surface_id;
};

inline float random(uint32_t x, uint32_t y, uint32_t index) {
    uint32_t h = (x * 0x9e3779b9u) ^ (y * 0x85ebca6bu) ^ (index * 0xc2b2ae35u);
    for (int i = 0; i < 2; ++i) {
        h = (h ^ h >> 16) * 0x7feb352du;
        h = (h ^ h >> 15) * 0x846ca68bu;
    }
    return float(h >> 8) / 16777216.0f;
}

inline void add_texel(Frame& frame, uint32_t index, uint32_t x, uint32_t y) {
    const float camera = speed * float(index);
    const float dx = ((float(x) + 0.5f) / float(width) * 2.0f - 1.0f) * aspect / focal;
    const float dy = (1.0f - (float(y) + 0.5f) / float(height) * 2.0f) / focal;
    const float card = (3.2f + 0.6f * camera) / (0.8f - 0.6f * dx);
    const float card_x = camera + dx * card, card_y = dy * card;
    const float wall_x = camera + dx * wall_depth, wall_y = dy * wall_depth;
    const bool is_card =
        card > 0.0f && card < wall_depth && card_x > -0.9f && card_x < 0.7f && card_y > -0.8f && card_y < 0.6f;
    const float odd = float((int(std::floor(wall_x)) + int(std::floor(wall_y))) & 1);
    Texel normal{}, albedo{1.0f, 1.0f, 1.0f, 1.0f};
    float depth = 0.0f, light = 0.4f;
    uint32_t id = 0;
    if (is_card) {
        depth = card, normal = {0.6f, 0.0f, 0.8f, 0.0f}, albedo = {0.8f, 0.3f, 0.2f, 1.0f};
        light = 0.5f + 0.25f * card_y, id = 2;
    } else if (!(wall_y > 2.0f)) {
        depth = wall_depth, normal = {0.0f, 0.0f, 1.0f, 0.0f}, albedo = {0.2f + 0.6f * odd, 0.5f, 0.7f - 0.4f * odd, 1.0f};
        light = 0.75f + 0.125f * wall_x, id = 1;
    }
    const float motion = id == 0 ? 0.0f : speed * focal / (aspect * depth) * 0.5f;
    const float noise = id == 0 ? 1.0f : 2.0f * random(x, y, index);
    frame.depth.push_back({depth, 0.0f, 0.0f, 0.0f});
    frame.normal.push_back(normal);
    frame.motion.push_back({motion, 0.0f, 0.0f, 0.0f});
    frame.albedo.push_back(albedo);
    frame.noisy_radiance.push_back({albedo[0] * light * noise, albedo[1] * light * noise, albedo[2] * light * noise, 1.0f});
    frame.surface_id.push_back(id);
}

inline Frame frame(uint32_t index) {
    Frame frame;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) add_texel(frame, index, x, y);
    return frame;
}

// Column-major; the camera looks along -z.
inline void view_from_world(uint32_t index, float (&m)[16]) {
    const float values[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -speed * float(index), 0, 0, 1};
    std::memcpy(m, values, sizeof m);
}

inline void clip_from_view(float (&m)[16]) {
    const float values[16] = {focal / aspect, 0, 0, 0, 0, -focal, 0, 0, 0, 0, -1, -1, 0, 0, -0.125f, 0};
    std::memcpy(m, values, sizeof m);
}

// FNV-1a.
inline uint64_t checksum(const uint8_t* bytes, size_t count) {
    uint64_t hash = 0xcbf29ce484222325ull;
    for (size_t i = 0; i < count; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3ull;
    return hash;
}

}  // namespace synthetic
