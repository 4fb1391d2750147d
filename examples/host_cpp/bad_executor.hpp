// Gives the functions of an executor everything that they must refuse.
#pragma once
#include "atrous.h"
#include "bad_input.hpp"
#include "engine.hpp"
#include "lent.hpp"

// Phases in a wrong order, a slot that the GPU still works on, and buffers that are none.
inline void refuse_bad_phases(const Engine& engine, Refusals& refusals) {
    AtrousConfig config{sizeof config};
    EXPECT(ATROUS_STATUS_OK, "", atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    info.checks = 1;
    AtrousExecutor* executor = nullptr;
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_create(&info, &executor));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "no frame yet", atrous_executor_record(executor, engine.cmd, 0));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "phase is 3", atrous_executor_record(executor, engine.cmd, 3));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "command_buffer is NULL", atrous_executor_record(executor, nullptr, 0));
    const auto stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    const auto bind = [&](const char* name, uintptr_t buffer, uint64_t size) {
        return atrous_executor_bind_buffer(executor, name, reinterpret_cast<VkBuffer>(buffer), size, stage, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    };
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name is NULL", bind(nullptr, 16, 48));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "depth", bind("depth", 16, 48));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "at least 48 bytes", bind(ATROUS_INPUT_INSTANCE_TRANSFORMS, 16, 47));
    EXPECT(ATROUS_STATUS_OK, "", bind(ATROUS_INPUT_INSTANCE_TRANSFORMS, 16, 48));
    EXPECT(ATROUS_STATUS_OK, "", bind(ATROUS_INPUT_INSTANCE_TRANSFORMS, 0, 0));
    LentInputs inputs(engine);
    AtrousFrameParams params = scene::params(0);
    const auto begin = [&](uint32_t count) { return atrous_executor_begin_frame(executor, &params, inputs.lent.data(), count); };
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "params is NULL", atrous_executor_begin_frame(executor, nullptr, nullptr, 0));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "image_count is 4000000000", begin(4000000000u));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "has nothing bound", begin(0));
    inputs.lent[0].after_layout = VK_IMAGE_LAYOUT_GENERAL;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "depth has an after_layout", begin(scene::count));
    inputs.lent[0].after_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    params.complete_frames = 0;
    EXPECT(ATROUS_STATUS_OK, "", begin(scene::count));
    inputs.write(0);
    engine.begin();
    inputs.record(engine.cmd);
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_record(executor, engine.cmd, ATROUS_PHASE_BEFORE_LIGHTING));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "phase 0 of frame 0 was recorded", atrous_executor_record(executor, engine.cmd, ATROUS_PHASE_BEFORE_LIGHTING));
    EXPECT(ATROUS_STATUS_IN_FLIGHT, "frame slot 0 has frame 0, and 0 frames are complete", begin(scene::count));
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_record(executor, engine.cmd, ATROUS_PHASE_POST_PROCESS));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "begin a frame", atrous_executor_record(executor, engine.cmd, ATROUS_PHASE_AFTER_LIGHTING));
    engine.submit_and_wait();
    params.complete_frames = 1;
    EXPECT(ATROUS_STATUS_OK, "", begin(scene::count));
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_destroy(executor));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", begin(scene::count));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_record(executor, engine.cmd, 0));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", bind("depth", 0, 0));
}

inline void refuse_bad_executor(const Engine& engine, Refusals& refusals) {
    refuse_bad_phases(engine, refusals);
    AtrousConfig config{sizeof config};
    EXPECT(ATROUS_STATUS_OK, "", atrous_config_default(&config, 8, 8));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    AtrousExecutor* executor = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "executor is NULL", atrous_executor_create(&info, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "info is NULL", atrous_executor_create(nullptr, &executor));
    info.legacy_barriers = 7;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "legacy_barriers is 7", atrous_executor_create(&info, &executor));
    info.legacy_barriers = 0;
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_create(&info, &executor));
    AtrousFrameParams params{sizeof params};
    EXPECT(ATROUS_STATUS_OK, "", atrous_frame_params_default(&params, 8, 8));
    AtrousLentImage image{sizeof image};
    const auto denoise = [&](uint32_t count) { return atrous_executor_denoise(executor, engine.cmd, &params, &image, count); };
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name is NULL", denoise(1));
    image.name = "depth";
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "no image or no view", denoise(1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "image_count is 4000000000", denoise(4000000000u));
    EXPECT(ATROUS_STATUS_BAD_BINDINGS, "depth", denoise(0));
    image.struct_size = 8;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "struct_size is 8", denoise(1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "images[0] is NULL", atrous_executor_denoise(executor, engine.cmd, &params, nullptr, 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "command_buffer", atrous_executor_denoise(executor, nullptr, &params, nullptr, 0));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "params is NULL", atrous_executor_denoise(executor, engine.cmd, nullptr, nullptr, 0));
    const auto buffer = reinterpret_cast<VkBuffer>(uintptr_t(1));  // looked at by nothing, since no frame was denoised
    EXPECT(ATROUS_STATUS_STALE_FRAME, "no frame yet", atrous_executor_record_copy(executor, engine.cmd, "depth", buffer, 8));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name is NULL", atrous_executor_record_copy(executor, engine.cmd, nullptr, buffer, 8));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "buffer is NULL", atrous_executor_record_copy(executor, engine.cmd, "depth", nullptr, 8));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "counters is NULL", atrous_executor_statistics(executor, nullptr, 1));
    uint32_t counters[2] = {7, 7};
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_statistics(executor, counters, 1));
    EXPECT_EQUAL(0, counters[0]);
    EXPECT_EQUAL(7, counters[1]);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name is NULL", atrous_executor_set_tuning(executor, nullptr, 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "no_such", atrous_executor_set_tuning(executor, "no_such", 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "0", atrous_executor_resize(executor, 0, 8));
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_resize(executor, 16, 16));
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_forget_recorded(executor));
    EXPECT(ATROUS_STATUS_STALE_FRAME, "no frame yet", atrous_executor_record_debug_view(executor, engine.cmd, ATROUS_VIEW_DEPTH));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "view is 99", atrous_executor_record_debug_view(executor, engine.cmd, 99));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "command_buffer", atrous_executor_record_debug_view(executor, nullptr, ATROUS_VIEW_DEPTH));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "folder is NULL", atrous_executor_capture(executor, nullptr, 1));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "0 frames", atrous_executor_capture(executor, "target", 0));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "/dev/null", atrous_executor_capture(executor, "/dev/null/capture", 1));
    uint32_t written = 7;
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_finish_capture(executor, &written));
    EXPECT_EQUAL(0, written);
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_finish_capture(executor, nullptr));
    EXPECT(ATROUS_STATUS_OK, "", atrous_executor_destroy(executor));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_destroy(executor));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_resize(executor, 8, 8));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_forget_recorded(executor));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "executor is NULL", atrous_executor_statistics(nullptr, counters, 2));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_record_debug_view(executor, engine.cmd, ATROUS_VIEW_DEPTH));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_capture(executor, "target", 1));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live executor", atrous_executor_finish_capture(executor, &written));
}
