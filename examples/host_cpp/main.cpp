// A C++17 engine with a small frame graph of its own, and SVGF in it through the C ABI. Prints a checksum of every denoised frame;
// `--bad-input` gives the library everything that it must refuse, `--random-input COUNT` random structs, `--check` asks it whether the guides are as declared.
#include <cinttypes>
#include <cstring>
#include <deque>
#include <map>
#include <string>

#include "atrous.h"
#include "bad_input.hpp"
#include "conventions.hpp"
#include "engine.hpp"
#include "random_input.hpp"
#include "synthetic.hpp"

namespace {

const Scope transfer_write{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true};
const Scope transfer_read{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
const Scope host_read{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED, false};
const char* const float_inputs[] = {"depth", "normal", "motion", "albedo", "noisy_radiance"};
constexpr VkDeviceSize staging_each = synthetic::width * synthetic::height * 16;

void check(AtrousStatus status, const char* call) {
    if (status == ATROUS_STATUS_OK) return;
    std::fprintf(stderr, "%s: %s: %s\n", call, atrous_status_name(status), atrous_last_error());
    std::exit(1);
}

class Renderer {
public:
    explicit Renderer(const Engine& engine) : engine_(engine) {
        AtrousConfig config{sizeof config};
        CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
        AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
        info.pipeline_cache = engine.pipeline_cache;
        CHECK(atrous_create(&info, &denoiser_));
        CHECK(atrous_counts(denoiser_, &resource_count_, &pass_count_));
        for (uint32_t i = 0; i < resource_count_; ++i) allocate(i);
        staging_ = engine.create_buffer(staging_each * resource_count_, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        CHECK(vkMapMemory(engine.device, staging_.memory, 0, VK_WHOLE_SIZE, 0, reinterpret_cast<void**>(&mapped_)));
    }

    ~Renderer() {
        check(atrous_destroy(denoiser_), "atrous_destroy");
        for (const auto& copies : resources_)
            for (const Physical& physical : copies) engine_.destroy(physical);
        engine_.destroy(staging_);
    }

    uint64_t render(uint32_t index) {
        const synthetic::Frame input = synthetic::frame(index);
        AtrousFrameParams params{sizeof params};
        CHECK(atrous_frame_params_default(&params, synthetic::width, synthetic::height));
        params.frame_slot = index % 2;
        synthetic::view_from_world(index, params.view_from_world);
        synthetic::clip_from_view(params.clip_from_view);
        frame_.struct_size = sizeof frame_;
        CHECK(atrous_begin_frame(denoiser_, &params, &frame_));

        add_upload("depth", input.depth);
        add_upload("normal", input.normal);
        add_upload("motion", input.motion);
        add_upload("albedo", input.albedo);
        add_upload("surface_id", input.surface_id);
        add_phase(0);
        add_upload("noisy_radiance", input.noisy_radiance);  // the engine's path tracer stands here
        add_phase(1);
        add_readback("denoised_radiance");

        engine_.begin();
        graph_.execute(engine_.cmd);
        engine_.submit_and_wait();
        return synthetic::checksum(mapped_, synthetic::width * synthetic::height * 8);
    }

private:
    // The passes of a phase as passes of the engine's graph.
    void add_phase(uint32_t phase) {
        for (uint32_t index = 0; index < pass_count_; ++index) {
            AtrousPass pass{sizeof pass};
            CHECK(atrous_pass(denoiser_, index, &pass));
            if (pass.phase != phase) continue;
            std::vector<Handle> handles;
            for (uint32_t i = 0; i < pass.use_count; ++i) handles.push_back(handle(pass.uses[i]));
            graph_.add(
                pass.name,
                [&](FrameGraph::Builder& builder) {
                    for (uint32_t i = 0; i < pass.use_count; ++i) {
                        const AtrousUse& use = pass.uses[i];
                        const Scope scope{use.stage, use.access_mask, use.layout, use.writes != 0};
                        if (handles[i].physical) builder.use(handles[i], scope, use.reads != 0);
                    }
                },
                [this, index, pass, handles](VkCommandBuffer cmd) {
                    // docs: begin
                    std::vector<AtrousBinding> bindings(pass.use_count);
                    for (uint32_t i = 0; i < pass.use_count; ++i) {
                        const Physical* physical = handles[i].physical;
                        if (!physical) continue;  // an optional input
                        bindings[i].image = physical->image, bindings[i].view = physical->view;
                        bindings[i].layout = pass.uses[i].layout;
                        bindings[i].buffer = physical->buffer, bindings[i].range = VK_WHOLE_SIZE;
                    }
                    check(atrous_record(denoiser_, &frame_, cmd, index, bindings.data(), pass.use_count), pass.name);
                    // docs: end
                });
        }
    }

    Handle handle(const AtrousUse& use) {
        auto& copies = resources_[use.resource];
        if (copies.empty()) return {};
        return {&copies[copies.size() == 2 ? frame_.current_copy ^ use.previous : 0]};
    }

    template <typename T>
    void add_upload(const char* name, const std::vector<T>& texels) {
        const uint32_t id = ids_.at(name);
        const Handle image{&resources_[id][0]};
        const VkDeviceSize offset = id * staging_each;
        std::memcpy(mapped_ + offset, texels.data(), texels.size() * sizeof(T));
        graph_.add(
            name, [&](FrameGraph::Builder& builder) { builder.use(image, transfer_write, false); },
            [this, image, offset](VkCommandBuffer cmd) {
                const VkBufferImageCopy region = whole_image(offset);
                vkCmdCopyBufferToImage(cmd, staging_.buffer, image.physical->image, transfer_write.layout, 1, &region);
            });
    }

    void add_readback(const char* name) {
        const Handle image{&resources_[ids_.at(name)][0]}, staging{&staging_};
        graph_.add(
            "readback",
            [&](FrameGraph::Builder& builder) {
                builder.use(image, transfer_read, true);
                builder.use(staging, transfer_write, false);
            },
            [this, image](VkCommandBuffer cmd) {
                const VkBufferImageCopy region = whole_image(0);
                vkCmdCopyImageToBuffer(cmd, image.physical->image, transfer_read.layout, staging_.buffer, 1, &region);
            });
        graph_.add("to host", [&](FrameGraph::Builder& builder) { builder.use(staging, host_read, true); }, [](VkCommandBuffer) {});
    }

    static VkBufferImageCopy whole_image(VkDeviceSize offset) {
        VkBufferImageCopy region{};
        region.bufferOffset = offset, region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {synthetic::width, synthetic::height, 1};
        return region;
    }

    void allocate(uint32_t index) {
        AtrousResource resource{sizeof resource};
        CHECK(atrous_resource(denoiser_, index, &resource));
        ids_[resource.name] = index;
        bool is_float_input = false;
        for (const char* name : float_inputs) is_float_input |= std::strcmp(name, resource.name) == 0;
        const bool is_input = is_float_input || std::strcmp(resource.name, "surface_id") == 0;
        const VkFormat format = is_float_input ? VK_FORMAT_R32G32B32A32_SFLOAT : resource.format;
        const VkImageUsageFlags usage = resource.image_usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        resources_.emplace_back();
        for (uint32_t copy = 0; copy < (is_input ? 1 : resource.copies); ++copy)
            resources_.back().push_back(resource.kind == 0
                                            ? engine_.create_image(format, resource.width, resource.height, usage)
                                            : engine_.create_buffer(resource.bytes, resource.buffer_usage, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
    }

    const Engine& engine_;
    FrameGraph graph_;
    AtrousDenoiser* denoiser_ = nullptr;
    AtrousFrame frame_{};
    uint32_t resource_count_ = 0, pass_count_ = 0;
    std::map<std::string, uint32_t> ids_;
    std::deque<std::vector<Physical>> resources_;  // by resource, then copy
    Physical staging_;
    uint8_t* mapped_ = nullptr;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], "--check") == 0) return check_conventions();
    Engine engine;
    if (argc > 1 && std::strcmp(argv[1], "--bad-input") == 0) return refuse_bad_input(engine);
    if (argc > 2 && std::strcmp(argv[1], "--random-input") == 0) return RandomInput(engine, std::strtoull(argv[2], nullptr, 10)).run();
    Renderer renderer(engine);
    for (uint32_t index = 0; index < synthetic::frames; ++index)
        std::printf("frame %u checksum %016" PRIx64 "\n", index, renderer.render(index));
    return 0;
}
