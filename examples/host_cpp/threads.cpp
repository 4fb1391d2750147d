// Four threads record the passes of a frame into command buffers of their own, which are submitted in the order of the passes. Prints
// a checksum of every denoised frame, as main.cpp does.
#include <cinttypes>
#include <map>
#include <string>
#include <thread>

#include "atrous.hpp"
#include "scene.hpp"

constexpr uint32_t threads = 4;
static const AtrousState copy_target{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_QUEUE_FAMILY_IGNORED};
static const AtrousState copy_source{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_QUEUE_FAMILY_IGNORED};

// A command pool of a thread, and one command buffer for each pass.
struct Recorder {
    VkCommandPool pool{};
    std::vector<VkCommandBuffer> commands;

    Recorder(const Engine& engine, uint32_t count) : commands(count) {
        VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        info.queueFamilyIndex = engine.family, info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        CHECK(vkCreateCommandPool(engine.device, &info, nullptr, &pool));
        VkCommandBufferAllocateInfo all{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        all.commandPool = pool, all.commandBufferCount = count;
        CHECK(vkAllocateCommandBuffers(engine.device, &all, commands.data()));
    }
};

// The bindings of a pass, and its barriers, which are recorded in front of it.
struct Ready {
    std::vector<VkImageMemoryBarrier2> images;
    std::vector<VkBufferMemoryBarrier2> buffers;
    std::vector<VkMemoryBarrier2> memory;
    std::vector<AtrousBinding> bindings;
};

// The tracker goes through the passes in their order, before any is recorded: its lists live until the next call.
static Ready ready(atrous::Tracker& tracker, const AtrousFrame& frame, uint32_t pass) {
    AtrousBarriers barriers = atrous::sized<AtrousBarriers>();
    CHECK(tracker.barriers(frame, pass, barriers));
    const VkDependencyInfo& info = barriers.dependency_info;
    Ready all;
    if (info.imageMemoryBarrierCount) all.images.assign(info.pImageMemoryBarriers, info.pImageMemoryBarriers + info.imageMemoryBarrierCount);
    if (info.bufferMemoryBarrierCount) all.buffers.assign(info.pBufferMemoryBarriers, info.pBufferMemoryBarriers + info.bufferMemoryBarrierCount);
    if (info.memoryBarrierCount) all.memory.assign(info.pMemoryBarriers, info.pMemoryBarriers + info.memoryBarrierCount);
    all.bindings.resize(ATROUS_MAX_USES);
    uint32_t count = 0;
    CHECK(tracker.bindings(frame, pass, all.bindings, count));
    all.bindings.resize(count);
    return all;
}

static void record(const atrous::Denoiser& denoiser, const AtrousFrame& frame, VkCommandBuffer cmd, uint32_t pass, const Ready& ready) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    CHECK(vkBeginCommandBuffer(cmd, &begin));
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = uint32_t(ready.images.size()), info.pImageMemoryBarriers = ready.images.data();
    info.bufferMemoryBarrierCount = uint32_t(ready.buffers.size()), info.pBufferMemoryBarriers = ready.buffers.data();
    info.memoryBarrierCount = uint32_t(ready.memory.size()), info.pMemoryBarriers = ready.memory.data();
    vkCmdPipelineBarrier2(cmd, &info);
    CHECK(denoiser.record(frame, cmd, pass, ready.bindings));
    CHECK(vkEndCommandBuffer(cmd));
}

int main() {
    Engine engine;
    AtrousConfig config = atrous::sized<AtrousConfig>();
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    atrous::Pipelines pipelines;
    atrous::Denoiser preview, denoiser;
    atrous::Tracker tracker;
    CHECK(pipelines.create());
    info.pipelines = pipelines.get();
    CHECK(preview.create(info));
    CHECK(denoiser.create(info));  // makes no pipeline of its own
    CHECK(denoiser.set_checks(true));
    CHECK(tracker.create(denoiser));
    uint32_t resources = 0, passes = 0;
    CHECK(denoiser.counts(resources, passes));
    std::vector<Physical> physical;
    std::map<std::string, std::pair<uint32_t, VkImage>> images;
    for (uint32_t id = 0; id < resources; ++id) {
        AtrousResource resource = atrous::sized<AtrousResource>();
        CHECK(denoiser.resource(id, resource));
        const size_t input = scene::index_of(resource.name);
        const VkFormat format = input < scene::count ? scene::format(input) : resource.format;
        const VkImageUsageFlags usage = resource.image_usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        for (uint32_t copy = 0; copy < resource.copies + (input < scene::count); ++copy) {
            const bool is_image = resource.kind == 0;
            physical.push_back(is_image ? engine.create_image(format, resource.width, resource.height, usage)
                                        : engine.create_buffer(resource.bytes, resource.buffer_usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
            const Physical& made = physical.back();
            images[resource.name] = {id, made.image};
            if (is_image) {
                CHECK(tracker.set_image(id, copy, made.image, made.view));
                CHECK(denoiser.describe_image(made.view, format, resource.width, resource.height, usage));
            } else {
                CHECK(tracker.set_buffer(id, copy, made.buffer));
            }
        }
    }
    uint8_t* mapped = nullptr;
    const Physical staging = engine.create_mapped_buffer(scene::bytes_each * (scene::count + 1), &mapped);
    std::vector<Recorder> recorders;
    for (uint32_t i = 0; i < threads; ++i) recorders.emplace_back(engine, passes);
    const auto access = [&](const char* name, const AtrousState& next, bool discard) {
        AtrousBarriers barriers = atrous::sized<AtrousBarriers>();
        CHECK(tracker.access(images.at(name).first, 0, next, discard, barriers));
        vkCmdPipelineBarrier2(engine.cmd, &barriers.dependency_info);
        return images.at(name).second;
    };
    for (uint32_t index = 0; index < synthetic::frames; ++index) {
        AtrousFrame frame = atrous::sized<AtrousFrame>();
        CHECK(denoiser.begin_frame(scene::params(index), frame));
        scene::write(synthetic::frame(index), mapped);
        engine.begin();
        for (size_t i = 0; i < scene::count; ++i) {
            const VkBufferImageCopy region = scene::copy(i);
            vkCmdCopyBufferToImage(engine.cmd, staging.buffer, access(scene::names[i], copy_target, true), copy_target.layout, 1, &region);
        }
        engine.submit_and_wait();
        std::vector<Ready> all;
        for (uint32_t pass = 0; pass < passes; ++pass) all.push_back(ready(tracker, frame, pass));
        std::vector<std::thread> running;
        for (uint32_t first = 0; first < threads; ++first)
            running.emplace_back([&, first] {
                for (uint32_t pass = first; pass < passes; pass += threads)
                    record(denoiser, frame, recorders[first].commands[pass], pass, all[pass]);
            });
        for (std::thread& thread : running) thread.join();
        std::vector<VkCommandBuffer> commands;
        for (uint32_t pass = 0; pass < passes; ++pass) commands.push_back(recorders[pass % threads].commands[pass]);
        engine.submit(commands);
        engine.begin();
        const VkBufferImageCopy region = scene::copy(scene::count);
        vkCmdCopyImageToBuffer(engine.cmd, access("denoised_radiance", copy_source, false), copy_source.layout, staging.buffer, 1, &region);
        engine.submit_and_wait();
        std::printf("frame %u checksum %016" PRIx64 "\n", index, scene::checksum(mapped + region.bufferOffset));
    }
    for (const Recorder& recorder : recorders) vkDestroyCommandPool(engine.device, recorder.pool, nullptr);
    for (const Physical& each : physical) engine.destroy(each);
    engine.destroy(staging);
}
