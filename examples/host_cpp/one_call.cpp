// A C++17 engine without a frame graph: it lends its images to an executor, one call a frame. Prints a checksum of every denoised
// frame, as main.cpp does.
#include <cinttypes>

#include "atrous.h"
#include "engine.hpp"
#include "synthetic.hpp"

static void check(AtrousStatus status, const char* call) {
    if (status == ATROUS_STATUS_OK) return;
    std::fprintf(stderr, "%s: %s: %s\n", call, atrous_status_name(status), atrous_last_error());
    std::exit(1);
}

constexpr VkDeviceSize bytes_each = synthetic::width * synthetic::height * 16;
const char* const names[] = {ATROUS_INPUT_DEPTH,  ATROUS_INPUT_NORMAL,         ATROUS_INPUT_MOTION,
                             ATROUS_INPUT_ALBEDO, ATROUS_INPUT_NOISY_RADIANCE, ATROUS_INPUT_SURFACE_ID};

static Physical mapped_buffer(const Engine& engine, VkDeviceSize size, uint8_t** mapped) {
    const Physical buffer = engine.create_buffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                 VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    CHECK(vkMapMemory(engine.device, buffer.memory, 0, VK_WHOLE_SIZE, 0, reinterpret_cast<void**>(mapped)));
    return buffer;
}

static void to_transfer(VkCommandBuffer cmd, VkImage image) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.image = image, barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

int main() {
    Engine engine;
    AtrousConfig config{sizeof config};
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    AtrousExecutor* executor = nullptr;
    CHECK(atrous_executor_create(&info, &executor));
    uint8_t *mapped = nullptr, *result_mapped = nullptr;
    const Physical staging = mapped_buffer(engine, 6 * bytes_each, &mapped), result = mapped_buffer(engine, bytes_each, &result_mapped);
    std::vector<Physical> inputs;
    std::vector<AtrousLentImage> lent;
    for (const char* name : names) {
        const VkFormat format = name == names[5] ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32B32A32_SFLOAT;
        inputs.push_back(engine.create_image(format, synthetic::width, synthetic::height, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT));
        AtrousLentImage image{sizeof image, format, name, inputs.back().image, inputs.back().view, synthetic::width, synthetic::height};
        image.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, image.stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        image.access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        lent.push_back(image);
    }
    for (uint32_t index = 0; index <= synthetic::frames; ++index) {  // one more, since counters come frames later
        const synthetic::Frame frame = synthetic::frame(index);
        const void* const texels[] = {frame.depth.data(),  frame.normal.data(),         frame.motion.data(),
                                      frame.albedo.data(), frame.noisy_radiance.data(), frame.surface_id.data()};
        engine.begin();
        for (size_t i = 0; i < inputs.size(); ++i) {
            std::memcpy(mapped + i * bytes_each, texels[i], i == 5 ? bytes_each / 4 : bytes_each);
            to_transfer(engine.cmd, inputs[i].image);
            const VkBufferImageCopy region{i * bytes_each, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {synthetic::width, synthetic::height, 1}};
            vkCmdCopyBufferToImage(engine.cmd, staging.buffer, inputs[i].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        }
        AtrousFrameParams params{sizeof params};
        CHECK(atrous_frame_params_default(&params, synthetic::width, synthetic::height));
        params.frame_slot = index % 2;
        synthetic::view_from_world(index, params.view_from_world);
        synthetic::clip_from_view(params.clip_from_view);
        CHECK(atrous_executor_denoise(executor, engine.cmd, &params, lent.data(), uint32_t(lent.size())));
        CHECK(atrous_executor_record_copy(executor, engine.cmd, "denoised_radiance", result.buffer, bytes_each));
        engine.submit_and_wait();
        if (index < synthetic::frames)
            std::printf("frame %u checksum %016" PRIx64 "\n", index, synthetic::checksum(result_mapped, synthetic::width * synthetic::height * 8));
    }
    uint32_t counters[ATROUS_COUNTER_COUNT] = {};
    CHECK(atrous_executor_statistics(executor, counters, ATROUS_COUNTER_COUNT));
    std::printf("history kept by %u surfaces\n", counters[ATROUS_COUNTER_HISTORY_KEPT]);
    CHECK(atrous_executor_destroy(executor));
    for (const Physical& input : inputs) engine.destroy(input);
    engine.destroy(staging), engine.destroy(result);
}
