// Everything that a host can get wrong at the boundary: a status and a message each time, never a crash.
#pragma once
#include <cstring>

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
};
#define EXPECT(wanted, word, call) refusals.expect(call, wanted, word, #call)

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
    config.struct_size = sizeof config + 4;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size", atrous_create(&good, &denoiser));
    config.struct_size = sizeof config, config.levels = 99;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "levels is 99", atrous_create(&good, &denoiser));
    config.levels = 5, config.width = 0;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "allocated_extent", atrous_create(&good, &denoiser));
    config.width = 8, config.preset = 1000;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "preset is 1000", atrous_create(&good, &denoiser));
    if (denoiser) ++refusals.wrong;
}

inline void refuse_bad_calls(AtrousDenoiser* denoiser, VkCommandBuffer cmd, Refusals& refusals) {
    AtrousResource resource{sizeof resource};
    AtrousPass pass{sizeof pass};
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "does not exist", atrous_resource(denoiser, 999, &resource));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "does not exist", atrous_pass(denoiser, 999, &pass));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "NULL", atrous_pass(denoiser, 0, nullptr));
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

    // Use after a resize.
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "allocated_extent", atrous_resize(denoiser, 0, 8));
    EXPECT(ATROUS_STATUS_OK, "", atrous_resize(denoiser, 16, 16));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "before atrous_resize", atrous_record(denoiser, &frame, cmd, 0, images, 2));
}

inline int refuse_bad_input(const Engine& engine) {
    Refusals refusals;
    refuse_bad_creation(engine, refusals);

    AtrousDenoiser* denoiser = nullptr;
    AtrousConfig config{sizeof config};
    atrous_config_default(&config, 8, 8);
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    EXPECT(ATROUS_STATUS_OK, "", atrous_create(&info, &denoiser));
    refuse_bad_calls(denoiser, engine.cmd, refusals);

    EXPECT(ATROUS_STATUS_OK, "", atrous_destroy(denoiser));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "destroyed", atrous_destroy(denoiser));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "destroyed", atrous_invalidate(denoiser));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "NULL", atrous_resize(nullptr, 8, 8));
    int not_a_denoiser = 0;
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live", atrous_counts(reinterpret_cast<AtrousDenoiser*>(&not_a_denoiser), nullptr, nullptr));
    std::printf("bad input: %d calls, %d wrong answers\n", refusals.count, refusals.wrong);
    return refusals.wrong == 0 ? 0 : 1;
}
