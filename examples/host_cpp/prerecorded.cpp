// A C++17 engine that records its command buffers once, and submits them again in every frame, with two frames in flight. Those of the
// denoiser are recorded anew, phase by phase, and run between them in one submission. Prints checksums, as main.cpp does.
#include <chrono>
#include <cinttypes>

#include "atrous.hpp"
#include "lent.hpp"

constexpr uint32_t slots = 2;
constexpr size_t path_traced = 5;  // the last input

// The command buffers of a frame slot, in the order in which they run.
struct Slot {
    VkCommandBuffer gbuffer, before_lighting, path_tracer, after_lighting, present;
    VkFence done;
    Physical result;
    uint8_t* result_mapped;
};

static VkCommandBuffer allocate(const Engine& engine) {
    VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = engine.pool, info.commandBufferCount = 1;
    VkCommandBuffer cmd{};
    CHECK(vkAllocateCommandBuffers(engine.device, &info, &cmd));
    return cmd;
}

template <typename Record>
static VkCommandBuffer recorded(VkCommandBuffer cmd, Record record) {
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    CHECK(vkBeginCommandBuffer(cmd, &begin));
    record(cmd);
    CHECK(vkEndCommandBuffer(cmd));
    return cmd;
}

static VkImageMemoryBarrier to_copy_source(VkImage image, VkImageLayout from) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT, barrier.oldLayout = from;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    return barrier;
}

// All that the engine itself records, once.
static Slot record_once(const Engine& engine, const LentInputs& inputs, VkImage denoised, uint32_t slot) {
    Slot made{};
    made.result = engine.create_mapped_buffer(scene::result_bytes, &made.result_mapped);
    made.gbuffer = recorded(allocate(engine), [&](VkCommandBuffer cmd) { inputs.record(cmd, 0, path_traced, slot); });
    made.path_tracer = recorded(allocate(engine), [&](VkCommandBuffer cmd) { inputs.record(cmd, path_traced, scene::count, slot); });
    made.present = recorded(allocate(engine), [&](VkCommandBuffer cmd) {
        VkBufferImageCopy region = scene::copy(0);
        vkCmdCopyImageToBuffer(cmd, denoised, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, made.result.buffer, 1, &region);
        const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    });
    made.before_lighting = allocate(engine), made.after_lighting = allocate(engine);
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    CHECK(vkCreateFence(engine.device, &fence, nullptr, &made.done));
    return made;
}

static void finish(const Engine& engine, const Slot& slot, uint32_t index) {
    CHECK(vkWaitForFences(engine.device, 1, &slot.done, VK_TRUE, UINT64_MAX));
    CHECK(vkResetFences(engine.device, 1, &slot.done));
    std::printf("frame %u checksum %016" PRIx64 "\n", index, scene::checksum(slot.result_mapped));
}

int main() {
    Engine engine;
    AtrousConfig config = atrous::sized<AtrousConfig>();
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    atrous::Executor executor;
    CHECK(executor.create(info));
    LentInputs inputs(engine, slots);
    const VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
    const Physical denoised = engine.create_image(format, synthetic::width, synthetic::height, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    AtrousLentImage output{sizeof output, format, "denoised_radiance", denoised.image, denoised.view, synthetic::width, synthetic::height};
    output.layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, output.stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    output.access = VK_ACCESS_2_TRANSFER_READ_BIT;
    inputs.lent.push_back(output);
    engine.begin();
    std::vector<VkImageMemoryBarrier> first{to_copy_source(denoised.image, VK_IMAGE_LAYOUT_UNDEFINED)};
    vkCmdPipelineBarrier(engine.cmd, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, first.data());
    engine.submit_and_wait();
    std::vector<Slot> all;
    for (uint32_t slot = 0; slot < slots; ++slot) all.push_back(record_once(engine, inputs, denoised.image, slot));

    std::chrono::duration<double, std::micro> recording{};
    for (uint32_t index = 0; index < synthetic::frames; ++index) {
        const Slot& slot = all[index % slots];
        if (index >= slots) finish(engine, slot, index - slots);
        inputs.write(index, index % slots);
        AtrousFrameParams params = scene::params(index);
        params.complete_frames = index >= slots ? index - slots + 1 : 0;
        const auto start = std::chrono::steady_clock::now();
        CHECK(executor.begin_frame(params, inputs.lent));
        recorded(slot.before_lighting, [&](VkCommandBuffer cmd) { CHECK(executor.record(cmd, atrous::Phase::BeforeLighting)); });
        recorded(slot.after_lighting, [&](VkCommandBuffer cmd) {
            CHECK(executor.record(cmd, atrous::Phase::AfterLighting));
            CHECK(executor.record(cmd, atrous::Phase::PostProcess));
        });
        recording += std::chrono::steady_clock::now() - start;
        const VkCommandBuffer commands[] = {slot.gbuffer, slot.before_lighting, slot.path_tracer, slot.after_lighting, slot.present};
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 5, submit.pCommandBuffers = commands;
        CHECK(vkQueueSubmit(engine.queue, 1, &submit, slot.done));
    }
    for (uint32_t index = synthetic::frames - slots; index < synthetic::frames; ++index) finish(engine, all[index % slots], index);
    std::printf("the engine recorded once, and the denoiser in %.0f us a frame\n", recording.count() / synthetic::frames);

    for (const Slot& slot : all) vkDestroyFence(engine.device, slot.done, nullptr), engine.destroy(slot.result);
    engine.destroy(denoised);
}
