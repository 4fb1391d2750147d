// A C++17 engine without a frame graph: it lends its images to an executor, one call a frame. Prints a checksum of every denoised
// frame, as main.cpp does. `one_call FOLDER` captures the inputs as well, and draws debug views.
#include <cinttypes>

#include "atrous.hpp"
#include "scene.hpp"

static void to_transfer(VkCommandBuffer cmd, VkImage image) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.image = image, barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

static void print_message(void*, uint32_t level, const char* message) { std::fprintf(stderr, "atrous, level %u: %s\n", level, message); }

int main(int argc, char** argv) {
    Engine engine;
    CHECK(atrous_set_log(2, print_message, nullptr));
    AtrousConfig config = atrous::sized<AtrousConfig>();
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    atrous::set(config, atrous::Preset::Best);
    config.debug_view = argc > 1;
    CHECK(atrous_check_requirements(&info, 1));
    atrous::Executor executor;
    CHECK(executor.create(info));
    uint8_t *mapped = nullptr, *result_mapped = nullptr;
    const Physical staging = engine.create_mapped_buffer(scene::count * scene::bytes_each, &mapped);
    const Physical result = engine.create_mapped_buffer(scene::result_bytes, &result_mapped);
    std::vector<Physical> inputs;
    std::vector<AtrousLentImage> lent;
    for (size_t i = 0; i < scene::count; ++i) {
        const VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        inputs.push_back(engine.create_image(scene::format(i), synthetic::width, synthetic::height, usage));
        AtrousLentImage image{sizeof image, scene::format(i), scene::names[i], inputs[i].image, inputs[i].view, synthetic::width, synthetic::height};
        image.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, image.stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        image.access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        lent.push_back(image);
    }
    if (argc > 1) CHECK(executor.capture(argv[1], synthetic::frames));
    for (uint32_t index = 0; index <= synthetic::frames; ++index) {  // one more, since counters come frames later
        scene::write(synthetic::frame(index), mapped);
        engine.begin();
        for (size_t i = 0; i < scene::count; ++i) {
            to_transfer(engine.cmd, inputs[i].image);
            const VkBufferImageCopy region = scene::copy(i);
            vkCmdCopyBufferToImage(engine.cmd, staging.buffer, inputs[i].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        }
        const AtrousFrameParams params = scene::params(index);
        CHECK(executor.denoise(engine.cmd, params, lent));
        CHECK(executor.record_copy(engine.cmd, "denoised_radiance", result.buffer, scene::result_bytes));
        engine.submit_and_wait();
        if (index < synthetic::frames) std::printf("frame %u checksum %016" PRIx64 "\n", index, scene::checksum(result_mapped));
    }
    for (const atrous::View view : {atrous::View::Depth, atrous::View::Normal}) {
        if (argc == 1) break;
        engine.begin();
        CHECK(executor.record_debug_view(engine.cmd, view));
        CHECK(executor.record_copy(engine.cmd, "debug_view", result.buffer, scene::result_bytes));
        engine.submit_and_wait();
        std::printf("view %d %016" PRIx64 "\n", int(view), scene::checksum(result_mapped));
    }
    uint32_t written = 0;
    CHECK(executor.finish_capture(written));
    std::printf("%u frames captured\n", written);
    uint32_t counters[ATROUS_COUNTER_COUNT] = {};
    CHECK(executor.statistics(counters));
    std::printf("history kept by %u surfaces\n", counters[ATROUS_COUNTER_HISTORY_KEPT]);
    for (const Physical& input : inputs) engine.destroy(input);
    engine.destroy(staging), engine.destroy(result);
}
