// The engine's input images, filled by copies, and how they are lent to an executor.
#pragma once
#include "scene.hpp"

class LentInputs {
public:
    // With memory to copy from for each slot.
    explicit LentInputs(const Engine& engine, uint32_t slots = 1) : engine_(engine), staging_(slots), mapped_(slots) {
        for (uint32_t slot = 0; slot < slots; ++slot)
            staging_[slot] = engine.create_mapped_buffer(scene::count * scene::bytes_each, &mapped_[slot]);
        for (size_t i = 0; i < scene::count; ++i) {
            const VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
            inputs_.push_back(engine.create_image(scene::format(i), synthetic::width, synthetic::height, usage));
            AtrousLentImage image{sizeof image, scene::format(i), scene::names[i], inputs_[i].image, inputs_[i].view, synthetic::width, synthetic::height};
            image.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, image.stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
            image.access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
            lent.push_back(image);
        }
    }
    LentInputs(const LentInputs&) = delete;
    ~LentInputs() {
        for (const Physical& input : inputs_) engine_.destroy(input);
        for (const Physical& buffer : staging_) engine_.destroy(buffer);
    }

    // What the copies of a slot take from now on.
    void write(uint32_t index, uint32_t slot = 0) { scene::write(synthetic::frame(index), mapped_[slot]); }

    // Records the copies of some inputs, which leave each image in the state in which it is lent.
    void record(VkCommandBuffer cmd, size_t first = 0, size_t end = scene::count, uint32_t slot = 0) const {
        for (size_t i = first; i < end; ++i) {
            VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
            barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
            barrier.image = inputs_[i].image, barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
            constexpr VkPipelineStageFlags transfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
            vkCmdPipelineBarrier(cmd, transfer, transfer, 0, 0, nullptr, 0, nullptr, 1, &barrier);
            const VkBufferImageCopy region = scene::copy(i);
            vkCmdCopyBufferToImage(cmd, staging_[slot].buffer, inputs_[i].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        }
    }

    std::vector<AtrousLentImage> lent;

private:
    const Engine& engine_;
    std::vector<Physical> staging_, inputs_;
    std::vector<uint8_t*> mapped_;
};
