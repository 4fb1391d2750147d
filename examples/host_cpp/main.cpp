// A C++17 engine that records every pass itself, with a tracker for its barriers. Prints a checksum of every denoised frame.
#include <cinttypes>
#include <map>
#include <string>

#include "scene.hpp"

static const AtrousState copy_target{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_QUEUE_FAMILY_IGNORED};
static const AtrousState copy_source{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_QUEUE_FAMILY_IGNORED};

class Renderer {
public:
    explicit Renderer(const Engine& engine) : engine_(engine) {
        AtrousConfig config{sizeof config};
        CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
        AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
        info.pipeline_cache = engine.pipeline_cache;
        CHECK(atrous_create(&info, &denoiser_));
        CHECK(atrous_tracker_create(denoiser_, 0, &tracker_));
        uint32_t resources = 0;
        CHECK(atrous_counts(denoiser_, &resources, &passes_));
        for (uint32_t id = 0; id < resources; ++id) allocate(id);
        staging_ = engine.create_mapped_buffer(scene::bytes_each * (scene::count + 1), &mapped_);
    }

    ~Renderer() {
        check(atrous_tracker_destroy(tracker_), "atrous_tracker_destroy");
        check(atrous_destroy(denoiser_), "atrous_destroy");
        for (const Physical& physical : physical_) engine_.destroy(physical);
        engine_.destroy(staging_);
    }

    uint64_t render(uint32_t index) {
        const AtrousFrameParams params = scene::params(index);
        CHECK(atrous_begin_frame(denoiser_, &params, &frame_));
        scene::write(synthetic::frame(index), mapped_);
        engine_.begin();
        for (size_t input = 0; input < scene::count - 1; ++input) upload(input);
        record_phase(0);
        upload(scene::count - 1);  // the engine's path tracer stands here
        record_phase(1);
        const VkImage result = access("denoised_radiance", copy_source, 0);
        const VkBufferImageCopy region = scene::copy(scene::count);
        vkCmdCopyImageToBuffer(engine_.cmd, result, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging_.buffer, 1, &region);
        engine_.submit_and_wait();
        return scene::checksum(mapped_ + region.bufferOffset);
    }

private:
    // docs: begin
    void record_phase(uint32_t phase) {
        AtrousPass pass{sizeof pass};
        AtrousBarriers barriers{sizeof barriers};
        AtrousBinding bindings[ATROUS_MAX_USES];
        for (uint32_t index = 0; index < passes_; ++index) {
            CHECK(atrous_pass(denoiser_, index, &pass));
            if (pass.phase != phase) continue;
            CHECK(atrous_tracker_barriers(tracker_, &frame_, index, &barriers));
            vkCmdPipelineBarrier2(engine_.cmd, &barriers.dependency_info);
            uint32_t count = ATROUS_MAX_USES;
            CHECK(atrous_tracker_bindings(tracker_, &frame_, index, bindings, &count));
            CHECK(atrous_record(denoiser_, &frame_, engine_.cmd, index, bindings, count));
        }
    }

    // The image of an input or an output, behind the barrier before a use of the engine's own.
    VkImage access(const char* name, const AtrousState& next, uint32_t discard) {
        AtrousBarriers barriers{sizeof barriers};
        const auto [id, image] = images_.at(name);
        CHECK(atrous_tracker_access(tracker_, id, 0, &next, discard, &barriers));
        vkCmdPipelineBarrier2(engine_.cmd, &barriers.dependency_info);
        return image;
    }
    // docs: end

    void upload(size_t input) {
        const VkImage image = access(scene::names[input], copy_target, 1);
        const VkBufferImageCopy region = scene::copy(input);
        vkCmdCopyBufferToImage(engine_.cmd, staging_.buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    }

    // Optional inputs that the scene lacks get no image, and are absent.
    void allocate(uint32_t id) {
        AtrousResource resource{sizeof resource};
        CHECK(atrous_resource(denoiser_, id, &resource));
        const size_t input = scene::index_of(resource.name);
        const bool is_input = input < scene::count;
        const VkFormat format = is_input ? scene::format(input) : resource.format;
        const VkImageUsageFlags usage = resource.image_usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        for (uint32_t copy = 0; copy < resource.copies + is_input; ++copy) {
            if (resource.kind == 1) {
                physical_.push_back(engine_.create_buffer(resource.bytes, resource.buffer_usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
                CHECK(atrous_tracker_set_buffer(tracker_, id, copy, physical_.back().buffer, 0, VK_WHOLE_SIZE));
                continue;
            }
            const Physical made = engine_.create_image(format, resource.width, resource.height, usage);
            CHECK(atrous_tracker_set_image(tracker_, id, copy, made.image, made.view, VK_IMAGE_ASPECT_COLOR_BIT));
            images_[resource.name] = {id, made.image};
            physical_.push_back(made);
        }
    }

    const Engine& engine_;
    AtrousDenoiser* denoiser_ = nullptr;
    AtrousTracker* tracker_ = nullptr;
    AtrousFrame frame_{sizeof frame_};
    uint32_t passes_ = 0;
    std::map<std::string, std::pair<uint32_t, VkImage>> images_;
    std::vector<Physical> physical_;
    Physical staging_;
    uint8_t* mapped_ = nullptr;
};

int main() {
    Engine engine;
    Renderer renderer(engine);
    for (uint32_t index = 0; index < synthetic::frames; ++index)
        std::printf("frame %u checksum %016" PRIx64 "\n", index, renderer.render(index));
}
