// A host that knows nothing but the first header: every image in VK_IMAGE_LAYOUT_GENERAL, and one barrier of all memory between passes.
#include <cinttypes>
#include <string>

#include "scene.hpp"

struct Resource {
    std::string name;
    std::vector<Physical> copies;
};

// Everything before it is complete and visible to everything behind it; images get their layout once.
static void barrier(VkCommandBuffer cmd, const std::vector<VkImageMemoryBarrier2>& images) {
    const VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                                  VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1, info.pMemoryBarriers = &memory;
    info.imageMemoryBarrierCount = uint32_t(images.size()), info.pImageMemoryBarriers = images.data();
    vkCmdPipelineBarrier2(cmd, &info);
}

static std::vector<VkImageMemoryBarrier2> to_general(const std::vector<Resource>& resources) {
    std::vector<VkImageMemoryBarrier2> barriers;
    for (const Resource& resource : resources)
        for (const Physical& copy : resource.copies) {
            VkImageMemoryBarrier2 one{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
            one.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, one.dstAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
            one.newLayout = VK_IMAGE_LAYOUT_GENERAL, one.image = copy.image;
            one.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
            if (copy.image) barriers.push_back(one);
        }
    return barriers;
}

static std::vector<Resource> allocate(const Engine& engine, AtrousDenoiser* denoiser, uint32_t count) {
    std::vector<Resource> resources;
    for (uint32_t id = 0; id < count; ++id) {
        AtrousResource declared{sizeof declared};
        CHECK(atrous_resource(denoiser, id, &declared));
        const size_t input = scene::index_of(declared.name);
        const bool is_input = input < scene::count;
        const VkImageUsageFlags usage = declared.image_usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        const VkFormat format = is_input ? scene::format(input) : declared.format;
        Resource resource{declared.name, {}};
        for (uint32_t copy = 0; copy < declared.copies + is_input; ++copy)
            resource.copies.push_back(declared.kind == 0
                                          ? engine.create_image(format, declared.width, declared.height, usage)
                                          : engine.create_buffer(declared.bytes, declared.buffer_usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
        resources.push_back(resource);
    }
    return resources;
}

static void record(AtrousDenoiser* denoiser, const AtrousFrame& frame, VkCommandBuffer cmd, uint32_t index, const std::vector<Resource>& resources) {
    AtrousPass pass{sizeof pass};
    CHECK(atrous_pass(denoiser, index, &pass));
    AtrousBinding bindings[ATROUS_MAX_USES]{};
    for (uint32_t i = 0; i < pass.use_count; ++i) {
        const std::vector<Physical>& copies = resources[pass.uses[i].resource].copies;
        if (copies.empty()) continue;  // an optional input
        const Physical& physical = copies[copies.size() == 2 ? frame.current_copy ^ pass.uses[i].previous : 0];
        bindings[i].image = physical.image, bindings[i].view = physical.view, bindings[i].layout = VK_IMAGE_LAYOUT_GENERAL;
        bindings[i].buffer = physical.buffer, bindings[i].range = VK_WHOLE_SIZE;
    }
    CHECK(atrous_record(denoiser, &frame, cmd, index, bindings, pass.use_count));
}

int main() {
    Engine engine;
    AtrousConfig config{sizeof config};
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    AtrousDenoiser* denoiser = nullptr;
    CHECK(atrous_create(&info, &denoiser));
    uint32_t count = 0, passes = 0;
    CHECK(atrous_counts(denoiser, &count, &passes));
    const std::vector<Resource> resources = allocate(engine, denoiser, count);
    uint8_t* mapped = nullptr;
    const Physical staging = engine.create_mapped_buffer(scene::bytes_each * (scene::count + 1), &mapped);
    const VkBufferImageCopy to_result = scene::copy(scene::count);
    for (uint32_t index = 0; index < synthetic::frames; ++index) {
        const AtrousFrameParams params = scene::params(index);
        AtrousFrame frame{sizeof frame};
        CHECK(atrous_begin_frame(denoiser, &params, &frame));
        scene::write(synthetic::frame(index), mapped);
        engine.begin();
        barrier(engine.cmd, index == 0 ? to_general(resources) : std::vector<VkImageMemoryBarrier2>());
        for (const Resource& resource : resources) {
            const size_t input = scene::index_of(resource.name.c_str());
            if (input == scene::count) continue;
            const VkBufferImageCopy region = scene::copy(input);
            vkCmdCopyBufferToImage(engine.cmd, staging.buffer, resource.copies[0].image, VK_IMAGE_LAYOUT_GENERAL, 1, &region);
        }
        for (uint32_t pass = 0; pass < passes; ++pass) {
            barrier(engine.cmd, {});
            record(denoiser, frame, engine.cmd, pass, resources);
        }
        barrier(engine.cmd, {});
        for (const Resource& resource : resources)
            if (resource.name == "denoised_radiance")
                vkCmdCopyImageToBuffer(engine.cmd, resource.copies[0].image, VK_IMAGE_LAYOUT_GENERAL, staging.buffer, 1, &to_result);
        engine.submit_and_wait();
        std::printf("frame %u checksum %016" PRIx64 "\n", index, scene::checksum(mapped + to_result.bufferOffset));
    }
    CHECK(atrous_destroy(denoiser));
    for (const Resource& resource : resources)
        for (const Physical& copy : resource.copies) engine.destroy(copy);
    engine.destroy(staging);
}
