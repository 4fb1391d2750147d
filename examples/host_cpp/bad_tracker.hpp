// Gives the functions of a tracker everything that they must refuse.
#pragma once
#include "atrous.h"
#include "bad_input.hpp"
#include "engine.hpp"

inline void refuse_dead_tracker(AtrousTracker* dead, const char* word, Refusals& refusals) {
    const AtrousState state{};
    AtrousState now{};
    AtrousFrame frame{sizeof frame};
    AtrousBarriers barriers{sizeof barriers};
    AtrousBinding binding{};
    uint32_t count = 1;
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_set_image(dead, 0, 0, nullptr, nullptr, 0));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_set_buffer(dead, 0, 0, nullptr, 0, 0));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_alias(dead, 0, 1));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_share(dead, 0, &state, &state));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_leave_out(dead, 0));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_set_state(dead, 0, 0, &state));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_state(dead, 0, 0, &now));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_set_queue_family(dead, 0));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_forget(dead));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_barriers(dead, &frame, 0, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_bindings(dead, &frame, 0, &binding, &count));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_access(dead, 0, 0, &state, 0, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_hand_back(dead, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_given_back(dead, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_releases(dead, &frame, 0, 0, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, word, atrous_tracker_destroy(dead));
}

inline void refuse_bad_states(AtrousTracker* tracker, Refusals& refusals) {
    const AtrousState state{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL, VK_QUEUE_FAMILY_IGNORED};
    AtrousBarriers barriers{sizeof barriers};
    const auto image = reinterpret_cast<VkImage>(uintptr_t(16));  // followed by nobody
    const auto view = reinterpret_cast<VkImageView>(uintptr_t(16));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "resource 999", atrous_tracker_set_image(tracker, 999, 0, image, view, VK_IMAGE_ASPECT_COLOR_BIT));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "copy 2", atrous_tracker_set_image(tracker, 0, 2, image, view, VK_IMAGE_ASPECT_COLOR_BIT));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "one of image and view", atrous_tracker_set_image(tracker, 0, 0, image, nullptr, 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "resource 4000000000", atrous_tracker_set_buffer(tracker, 4000000000u, 0, nullptr, 0, 0));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "resource 999", atrous_tracker_alias(tracker, 0, 999));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "before is NULL", atrous_tracker_share(tracker, 0, nullptr, &state));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "after is NULL", atrous_tracker_share(tracker, 0, &state, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "resource 999", atrous_tracker_share(tracker, 999, &state, &state));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "resource 999", atrous_tracker_leave_out(tracker, 999));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "state is NULL", atrous_tracker_set_state(tracker, 0, 0, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "copy 7", atrous_tracker_set_state(tracker, 0, 7, &state));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "state is NULL", atrous_tracker_state(tracker, 0, 0, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "next is NULL", atrous_tracker_access(tracker, 0, 0, nullptr, 0, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "discard is 7", atrous_tracker_access(tracker, 0, 0, &state, 7, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "barriers is NULL", atrous_tracker_access(tracker, 0, 0, &state, 0, nullptr));
    AtPageEnd<uint32_t> small(4);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 4", atrous_tracker_access(tracker, 0, 0, &state, 0, small.as<AtrousBarriers>()));
    AtrousState now{};
    EXPECT(ATROUS_STATUS_OK, "", atrous_tracker_state(tracker, 0, 0, &now));
    EXPECT_EQUAL(0, uint32_t(now.stage));  // what was refused has changed nothing
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "barriers is NULL", atrous_tracker_hand_back(tracker, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "barriers is NULL", atrous_tracker_given_back(tracker, nullptr));
}

inline void refuse_bad_tracker(const Engine& engine, Refusals& refusals) {
    AtrousDenoiser* denoiser = nullptr;
    AtrousTracker* tracker = nullptr;
    AtrousConfig config{sizeof config};
    EXPECT(ATROUS_STATUS_OK, "", atrous_config_default(&config, 8, 8));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "denoiser is NULL", atrous_tracker_create(nullptr, 0, &tracker));
    EXPECT(ATROUS_STATUS_OK, "", atrous_create(&info, &denoiser));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "tracker is NULL", atrous_tracker_create(denoiser, 0, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "legacy_barriers is 2", atrous_tracker_create(denoiser, 2, &tracker));
    EXPECT(ATROUS_STATUS_OK, "", atrous_tracker_create(denoiser, 0, &tracker));
    refuse_bad_states(tracker, refusals);

    AtrousFrameParams params{sizeof params};
    AtrousFrame frame{sizeof frame};
    AtrousBarriers barriers{sizeof barriers};
    EXPECT(ATROUS_STATUS_OK, "", atrous_frame_params_default(&params, 8, 8));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "atrous_begin_frame", atrous_tracker_barriers(tracker, &frame, 0, &barriers));
    EXPECT(ATROUS_STATUS_OK, "", atrous_begin_frame(denoiser, &params, &frame));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "frame is NULL", atrous_tracker_barriers(tracker, nullptr, 0, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "pass 999", atrous_tracker_barriers(tracker, &frame, 999, &barriers));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "barriers is NULL", atrous_tracker_barriers(tracker, &frame, 0, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "phase is 3", atrous_tracker_releases(tracker, &frame, 3, 0, &barriers));
    // Of an array that is too short nothing is written.
    AtPageEnd<AtrousBinding> one(AtrousBinding{});
    uint32_t count = 1;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "room for 1", atrous_tracker_bindings(tracker, &frame, 0, one.as(), &count));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "bindings or count is NULL", atrous_tracker_bindings(tracker, &frame, 0, nullptr, &count));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "bindings or count is NULL", atrous_tracker_bindings(tracker, &frame, 0, one.as(), nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "pass 999", atrous_tracker_bindings(tracker, &frame, 999, one.as(), &count));
    // Without images there is nothing to wait for, and nothing that could be recorded.
    AtrousBinding all[ATROUS_MAX_USES]{};
    count = ATROUS_MAX_USES;
    EXPECT(ATROUS_STATUS_OK, "", atrous_tracker_bindings(tracker, &frame, 0, all, &count));
    EXPECT_EQUAL(2, count);
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "frame_constants", atrous_record(denoiser, &frame, engine.cmd, 0, all, count));

    EXPECT(ATROUS_STATUS_OK, "", atrous_resize(denoiser, 16, 16));
    EXPECT(ATROUS_STATUS_OK, "", atrous_begin_frame(denoiser, &params, &frame));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "make one for the new images", atrous_tracker_barriers(tracker, &frame, 0, &barriers));
    EXPECT(ATROUS_STATUS_OK, "", atrous_destroy(denoiser));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live denoiser", atrous_tracker_barriers(tracker, &frame, 0, &barriers));
    EXPECT(ATROUS_STATUS_OK, "", atrous_tracker_destroy(tracker));
    refuse_dead_tracker(tracker, "no live tracker", refusals);
    refuse_dead_tracker(nullptr, "tracker is NULL", refusals);
}
