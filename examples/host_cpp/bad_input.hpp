// Everything that a host can get wrong at the boundary: a status and a message each time, never a crash.
#pragma once
#include <sys/mman.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "atrous.h"
#include "engine.hpp"

// Counts what was refused with the right status and the right word in its message.
struct Refusals {
    int count = 0, wrong = 0;

    void expect(AtrousStatus given, AtrousStatus wanted, const char* word, const char* what) {
        ++count;
        const bool right = given == wanted && (wanted == ATROUS_STATUS_OK || std::strstr(atrous_last_error(), word));
        if (right) return;
        ++wrong;
        std::fprintf(stderr, "%s: got %s (%s), expected %s with `%s`\n", what, atrous_status_name(given), atrous_last_error(),
                     atrous_status_name(wanted), word);
    }

    void expect_equal(uint32_t given, uint32_t wanted, const char* what) {
        ++count;
        if (given == wanted) return;
        ++wrong;
        std::fprintf(stderr, "%s is %u, expected %u\n", what, given, wanted);
    }
};
#define EXPECT_EQUAL(wanted, given) refusals.expect_equal(given, wanted, #given)
#define EXPECT(wanted, word, call) refusals.expect(call, wanted, word, #call)

// An object with a page behind it that must not be touched: AddressSanitizer does not see what the library itself reads.
template <typename T>
class AtPageEnd {
public:
    explicit AtPageEnd(const T& value) {
        pages_ = static_cast<uint8_t*>(mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        mprotect(pages_ + page, page, PROT_NONE);
        std::memcpy(pages_ + page - sizeof value, &value, sizeof value);
    }
    AtPageEnd(const AtPageEnd&) = delete;
    ~AtPageEnd() { munmap(pages_, 2 * page); }

    // As a pointer to a struct of which there may be less.
    template <typename S = T>
    S* as() {
        return reinterpret_cast<S*>(pages_ + page - sizeof(T));
    }

private:
    static constexpr size_t page = 65536;
    uint8_t* pages_;
};

inline void refuse_bad_creation(const Engine& engine, Refusals& refusals) {
    AtrousDenoiser* denoiser = nullptr;
    AtrousConfig config{sizeof config};
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_config_default(nullptr, 8, 8));
    EXPECT(ATROUS_STATUS_OK, "", atrous_config_default(&config, 8, 8));
    AtrousCreateInfo good{sizeof good, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_create(nullptr, &denoiser));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_create(&good, nullptr));
    AtrousCreateInfo info = good;
    info.struct_size = 4;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_create(&info, &denoiser));
    info = good, info.device = VK_NULL_HANDLE;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "device", atrous_create(&info, &denoiser));
    info = good, info.instance = VK_NULL_HANDLE;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "instance", atrous_create(&info, &denoiser));
    info = good, info.get_instance_proc_addr = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "get_instance_proc_addr", atrous_create(&info, &denoiser));
    info = good, info.config = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "config", atrous_create(&info, &denoiser));
    AtrousPipelines* pipelines = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "pipelines is NULL", atrous_pipelines_create(nullptr));
    EXPECT(ATROUS_STATUS_OK, "", atrous_pipelines_create(&pipelines));
    EXPECT(ATROUS_STATUS_OK, "", atrous_pipelines_clear(pipelines));
    EXPECT(ATROUS_STATUS_OK, "", atrous_pipelines_destroy(pipelines));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live store of pipelines", atrous_pipelines_clear(pipelines));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live store of pipelines", atrous_pipelines_destroy(pipelines));
    info = good, info.pipelines = pipelines;
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live store of pipelines", atrous_create(&info, &denoiser));
    config.struct_size = offsetof(AtrousConfig, output_extent) - 4;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size", atrous_create(&good, &denoiser));
    struct { AtrousConfig known; uint32_t unknown; } newer{config, 1};
    newer.known.struct_size = sizeof newer;
    good.config = &newer.known;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "is not 0, and atrous", atrous_create(&good, &denoiser));
    good.config = &config;
    config.struct_size = sizeof config, config.levels = 99;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "levels is 99", atrous_create(&good, &denoiser));
    config.levels = 5, config.width = 0;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "allocated_extent", atrous_create(&good, &denoiser));
    config.width = 8, config.preset = 1000;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "preset is 1000", atrous_create(&good, &denoiser));
    config.preset = 4, config.sampling = 3;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "sampling is 3", atrous_create(&good, &denoiser));
    config.preset = 7, config.sampling = 0;
    EXPECT(ATROUS_STATUS_OK, "", atrous_check_requirements(&good, 1));
    info = good, info.device = VK_NULL_HANDLE;
    EXPECT(ATROUS_STATUS_OK, "", atrous_check_requirements(&info, 1));
    Engine plain(VK_API_VERSION_1_1);
    info = good, info.instance = plain.instance, info.physical_device = plain.physical_device, info.device = plain.device;
    EXPECT(ATROUS_STATUS_OK, "", atrous_check_requirements(&info, 0));
    EXPECT(ATROUS_STATUS_UNSUPPORTED_DEVICE, "synchronization2 on this device", atrous_check_requirements(&info, 1));
    info.legacy_barriers = 1;
    EXPECT(ATROUS_STATUS_OK, "", atrous_check_requirements(&info, 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "executor is 2", atrous_check_requirements(&good, 2));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "info is NULL", atrous_check_requirements(nullptr, 0));
    info = good, info.physical_device = VK_NULL_HANDLE;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "physical_device is NULL", atrous_check_requirements(&info, 0));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "level is 6", atrous_set_log(6, nullptr, nullptr));
    EXPECT(ATROUS_STATUS_OK, "", atrous_set_log(2, nullptr, nullptr));
    // Of a struct that is too small no more is read than its size.
    AtPageEnd<uint32_t> small(4);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_create(small.as<AtrousCreateInfo>(), &denoiser));
    info = good, info.config = small.as<AtrousConfig>();
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_create(&info, &denoiser));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_config_default(small.as<AtrousConfig>(), 8, 8));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_frame_params_default(small.as<AtrousFrameParams>(), 8, 8));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_frame_params_default(nullptr, 8, 8));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_tuning_field(0, small.as<AtrousTuningField>()));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_tuning_field(0, nullptr));
    AtrousTuningField field{sizeof field};
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "does not exist", atrous_tuning_field(4000000000u, &field));
    AtPageEnd<AtrousConfig> whole(AtrousConfig{sizeof config});
    EXPECT(ATROUS_STATUS_OK, "", atrous_config_default(whole.as(), 8, 8));
    if (denoiser) ++refusals.wrong;
}

// Images, buffers and nothing in the order of a pass's uses; they are refused before anything follows the handles.
inline std::vector<AtrousBinding> bindings_of(AtrousDenoiser* denoiser, const AtrousPass& pass) {
    std::vector<AtrousBinding> bindings(pass.use_count);
    for (uint32_t i = 0; i < pass.use_count; ++i) {
        AtrousResource resource{sizeof resource};
        atrous_resource(denoiser, pass.uses[i].resource, &resource);
        if (resource.kind == 0) bindings[i].view = (VkImageView)(uintptr_t)0x10, bindings[i].layout = pass.uses[i].layout;
        if (resource.kind == 1) bindings[i].buffer = (VkBuffer)(uintptr_t)0x10, bindings[i].range = VK_WHOLE_SIZE;
    }
    return bindings;
}

// The bindings of every pass in the opposite order, and one too few or too many of them.
inline void refuse_wrong_orders(AtrousDenoiser* denoiser, const AtrousFrame& frame, VkCommandBuffer cmd, Refusals& refusals) {
    uint32_t resources = 0, passes = 0;
    EXPECT(ATROUS_STATUS_OK, "", atrous_counts(denoiser, &resources, &passes));
    for (uint32_t index = 1; index < passes; ++index) {
        AtrousPass pass{sizeof pass};
        EXPECT(ATROUS_STATUS_OK, "", atrous_pass(denoiser, index, &pass));
        const std::vector<AtrousBinding> bindings = bindings_of(denoiser, pass);
        std::vector<AtrousBinding> reversed(bindings.rbegin(), bindings.rend());
        EXPECT(ATROUS_STATUS_BAD_BINDINGS, "resource `", atrous_record(denoiser, &frame, cmd, index, reversed.data(), pass.use_count));
        EXPECT(ATROUS_STATUS_BAD_BINDINGS, pass.name, atrous_record(denoiser, &frame, cmd, index, bindings.data(), pass.use_count - 1));
        // A count that is too large is refused before the binding behind the last one is read.
        AtPageEnd<AtrousBinding> last(bindings.back());
        EXPECT(ATROUS_STATUS_BAD_BINDINGS, pass.name, atrous_record(denoiser, &frame, cmd, index, last.as(), pass.use_count + 1));
    }
}

// Right bindings of the last pass, one of which has a mistake that no descriptor shows.
inline void refuse_what_is_checked(AtrousDenoiser* denoiser, const AtrousFrame& frame, VkCommandBuffer cmd, Refusals& refusals) {
    uint32_t passes = 0, at = 0;
    EXPECT(ATROUS_STATUS_OK, "", atrous_counts(denoiser, nullptr, &passes));
    const uint32_t last = passes - 1;
    AtrousPass pass{sizeof pass};
    EXPECT(ATROUS_STATUS_OK, "", atrous_pass(denoiser, last, &pass));
    std::vector<AtrousBinding> bindings = bindings_of(denoiser, pass);
    while (!bindings[at].view) ++at;
    AtrousResource resource{sizeof resource};
    EXPECT(ATROUS_STATUS_OK, "", atrous_resource(denoiser, pass.uses[at].resource, &resource));
    EXPECT(ATROUS_STATUS_OK, "", atrous_set_checks(denoiser, 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "on is 2", atrous_set_checks(denoiser, 2));
    bindings[at].layout = VK_IMAGE_LAYOUT_UNDEFINED;
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "layout UNDEFINED", atrous_record(denoiser, &frame, cmd, last, bindings.data(), pass.use_count));
    bindings[at].layout = VK_IMAGE_LAYOUT_GENERAL;
    const auto describe = [&](VkImageView view, uint32_t width) {
        return atrous_describe_image(denoiser, view, resource.format, width, 8, VK_IMAGE_USAGE_SAMPLED_BIT);
    };
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "view is VK_NULL_HANDLE", describe(VK_NULL_HANDLE, 8));
    EXPECT(ATROUS_STATUS_OK, "", describe(bindings[at].view, 7));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "7x8 pixels", atrous_record(denoiser, &frame, cmd, last, bindings.data(), pass.use_count));
}

inline void refuse_bad_params(AtrousDenoiser* denoiser, Refusals& refusals) {
    AtrousFrame frame{sizeof frame};
    AtrousFrameParams good{sizeof good};
    EXPECT(ATROUS_STATUS_OK, "", atrous_frame_params_default(&good, 8, 8));
    AtPageEnd<uint32_t> small(4);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_begin_frame(denoiser, small.as<AtrousFrameParams>(), &frame));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_begin_frame(denoiser, &good, small.as<AtrousFrame>()));
    AtrousFrameParams params = good;
    params.view_from_world[5] = NAN;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "view_from_world", atrous_begin_frame(denoiser, &params, &frame));
    params = good;
    for (float& v : params.clip_from_view) v = 0.0f;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "clip_from_view", atrous_begin_frame(denoiser, &params, &frame));
    params = good, params.jitter[0] = 7.0f;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "jitter", atrous_begin_frame(denoiser, &params, &frame));
    params = good, params.exposure_ratio = 0.0f;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "exposure_ratio", atrous_begin_frame(denoiser, &params, &frame));
    params = good, params.render_height = 0;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "render_extent", atrous_begin_frame(denoiser, &params, &frame));
}

inline void refuse_bad_guides(Refusals& refusals) {
    AtrousConfig config{sizeof config};
    AtrousFrameParams params{sizeof params};
    atrous_config_default(&config, 8, 8), atrous_frame_params_default(&params, 8, 8);
    const std::vector<float> texels(8 * 8 * 4, 1.0f);
    AtrousConventionReport report{sizeof report};
    const AtrousGuides good{sizeof good, 8, 8, &params, texels.data(), nullptr, nullptr, nullptr};
    EXPECT(ATROUS_STATUS_OK, "", atrous_check_conventions(&config, &good, &good, &report));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "config is NULL", atrous_check_conventions(nullptr, &good, &good, &report));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "previous is NULL", atrous_check_conventions(&config, nullptr, &good, &report));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "report is NULL", atrous_check_conventions(&config, &good, &good, nullptr));
    AtrousGuides bad = good;
    bad.depth = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "current->depth is NULL", atrous_check_conventions(&config, &good, &bad, &report));
    bad = good, bad.params = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "current->params is NULL", atrous_check_conventions(&config, &good, &bad, &report));
    bad = good, bad.width = 4;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "render_extent", atrous_check_conventions(&config, &good, &bad, &report));
    bad = good, bad.height = 4000000000u;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "width and height", atrous_check_conventions(&config, &good, &bad, &report));
    report.struct_size = 16;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 16", atrous_check_conventions(&config, &good, &good, &report));
}

inline void refuse_bad_calls(AtrousDenoiser* denoiser, VkCommandBuffer cmd, Refusals& refusals) {
    AtrousResource resource{sizeof resource};
    AtrousPass pass{sizeof pass};
    AtrousMemory memory{12};
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 12", atrous_memory(denoiser, &memory));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_memory(denoiser, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_resource(denoiser, 0, nullptr));
    EXPECT(ATROUS_STATUS_OK, "", atrous_counts(denoiser, nullptr, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "does not exist", atrous_resource(denoiser, 999, &resource));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "does not exist", atrous_pass(denoiser, 999, &pass));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_pass(denoiser, 0, nullptr));
    uint32_t input = 0;
    while (atrous_resource(denoiser, input, &resource) == ATROUS_STATUS_OK && resource.lifetime != 0) ++input;
    AtrousPlacement placements[2]{{999, 0, 8, 8, 0}, {input, 0, 8, 8, 0}};
    uint64_t bytes = 0;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "resource 999", atrous_place_transients(denoiser, placements, 1, &bytes));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "not a transient", atrous_place_transients(denoiser, placements + 1, 1, &bytes));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "count is 4000000000", atrous_place_transients(denoiser, placements, 4000000000u, &bytes));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "placements or size is NULL", atrous_place_transients(denoiser, nullptr, 1, &bytes));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "placements or size is NULL", atrous_place_transients(denoiser, placements, 1, nullptr));
    pass.struct_size = 8;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 8", atrous_pass(denoiser, 0, &pass));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_set_tuning(denoiser, nullptr, 1.0f));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "alfa", atrous_set_tuning(denoiser, "alfa", 1.0f));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "0 to 1", atrous_set_tuning(denoiser, "alpha", 7.0f));

    AtrousFrame frame{sizeof frame};
    AtrousFrameParams params{sizeof params};
    EXPECT(ATROUS_STATUS_OK, "", atrous_frame_params_default(&params, 8, 8));
    AtrousBinding none[ATROUS_MAX_USES]{};
    EXPECT(ATROUS_STATUS_STALE_FRAME, "atrous_begin_frame", atrous_record(denoiser, &frame, cmd, 0, none, 2));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_begin_frame(denoiser, nullptr, &frame));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_begin_frame(denoiser, &params, nullptr));
    params.render_width = 9;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "render_extent", atrous_begin_frame(denoiser, &params, &frame));
    params.render_width = 8, params.frame_slot = 5;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "frame_slot is 5", atrous_begin_frame(denoiser, &params, &frame));
    params.frame_slot = 0, params.reset = 50;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "reset is 50", atrous_begin_frame(denoiser, &params, &frame));
    params.reset = 0;
    EXPECT(ATROUS_STATUS_OK, "", atrous_begin_frame(denoiser, &params, &frame));

    // Handles in a wrong order: where the pass has a buffer, an image is given. They are refused before anything follows them.
    const VkImageView view = (VkImageView)(uintptr_t)0x10;
    const VkBuffer buffer = (VkBuffer)(uintptr_t)0x10;
    AtrousBinding images[ATROUS_MAX_USES]{}, both[ATROUS_MAX_USES]{};
    for (AtrousBinding& binding : images) binding.view = view, binding.layout = VK_IMAGE_LAYOUT_GENERAL;
    for (AtrousBinding& binding : both) binding.view = view, binding.buffer = buffer;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "frame is NULL", atrous_record(denoiser, nullptr, cmd, 0, images, 2));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "command_buffer is NULL", atrous_record(denoiser, &frame, VK_NULL_HANDLE, 0, images, 2));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "bindings is NULL", atrous_record(denoiser, &frame, cmd, 0, nullptr, 2));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "does not exist", atrous_record(denoiser, &frame, cmd, 999, images, 2));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "start_frame", atrous_record(denoiser, &frame, cmd, 0, images, 1));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "needs 2", atrous_record(denoiser, &frame, cmd, 0, images, 4000000000u));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "frame_constants", atrous_record(denoiser, &frame, cmd, 0, images, 2));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "frame_constants", atrous_record(denoiser, &frame, cmd, 0, none, 2));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "both", atrous_record(denoiser, &frame, cmd, 0, both, 2));

    refuse_wrong_orders(denoiser, frame, cmd, refusals);
    refuse_what_is_checked(denoiser, frame, cmd, refusals);
    AtPageEnd<uint32_t> small(4);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_record(denoiser, small.as<AtrousFrame>(), cmd, 0, none, 2));
    AtrousFrame again{sizeof again};
    EXPECT(ATROUS_STATUS_OK, "", atrous_begin_frame(denoiser, &params, &again));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "begun last", atrous_record(denoiser, &frame, cmd, 0, images, 2));
    again.frame_slot = 4000000000u;
    EXPECT(ATROUS_STATUS_STALE_FRAME, "slot 4000000000", atrous_record(denoiser, &again, cmd, 0, images, 2));

    // Use after a resize.
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "allocated_extent", atrous_resize(denoiser, 0, 8));
    EXPECT(ATROUS_STATUS_OK, "", atrous_resize(denoiser, 16, 16));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "before atrous_resize", atrous_record(denoiser, &frame, cmd, 0, images, 2));
    EXPECT(ATROUS_STATUS_OK, "", atrous_resource(denoiser, 2, &resource));
    EXPECT_EQUAL(16u, resource.width);
    EXPECT(ATROUS_STATUS_OK, "", atrous_begin_frame(denoiser, &params, &again));
    EXPECT_EQUAL(3u, again.reset);  // resize
}

// Every function on a handle that is none.
inline void refuse_dead_handle(AtrousDenoiser* dead, const char* word, VkCommandBuffer cmd, Refusals& refusals) {
    AtrousResource resource{sizeof resource};
    AtrousPass pass{sizeof pass};
    AtrousMemory memory{sizeof memory};
    AtrousFrame frame{sizeof frame};
    AtrousFrameParams params{sizeof params};
    atrous_frame_params_default(&params, 8, 8);
    AtrousBinding bindings[2]{};
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_counts(dead, nullptr, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_resource(dead, 0, &resource));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_pass(dead, 0, &pass));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_memory(dead, &memory));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_set_tuning(dead, "alpha", 0.5f));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_invalidate(dead));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_set_checks(dead, 1));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_describe_image(dead, (VkImageView)(uintptr_t)0x10, VK_FORMAT_UNDEFINED, 1, 1, 0));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_begin_frame(dead, &params, &frame));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_record(dead, &frame, cmd, 0, bindings, 2));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_resize(dead, 8, 8));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_destroy(dead));
}

inline void refuse_bad_input(const Engine& engine, Refusals& refusals) {
    refuse_bad_creation(engine, refusals);
    refuse_bad_guides(refusals);

    AtrousDenoiser* denoiser = nullptr;
    AtrousConfig config{sizeof config};
    atrous_config_default(&config, 8, 8);
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    EXPECT(ATROUS_STATUS_OK, "", atrous_create(&info, &denoiser));
    refuse_bad_params(denoiser, refusals);
    refuse_bad_calls(denoiser, engine.cmd, refusals);

    EXPECT(ATROUS_STATUS_OK, "", atrous_destroy(denoiser));
    refuse_dead_handle(denoiser, "destroyed", engine.cmd, refusals);
    refuse_dead_handle(nullptr, "NULL", engine.cmd, refusals);
    int not_a_denoiser = 0;
    refuse_dead_handle(reinterpret_cast<AtrousDenoiser*>(&not_a_denoiser), "no live", engine.cmd, refusals);
}
