// A C++17 engine without a frame graph: it lends its images to an executor, one call a frame. Prints a checksum of every denoised
// frame, as main.cpp does. `one_call FOLDER` captures the inputs as well, and draws debug views; `one_call --wrong-motion` declares
// the motion with the opposite sign, which the executor finds by itself.
#include <cinttypes>

#include "atrous.hpp"
#include "lent.hpp"

static void print_message(void*, uint32_t level, const char* message) { std::fprintf(stderr, "atrous, level %u: %s\n", level, message); }

int main(int argc, char** argv) {
    const bool is_wrong = argc > 1 && std::strcmp(argv[1], "--wrong-motion") == 0;
    const char* const folder = argc > 1 && !is_wrong ? argv[1] : nullptr;
    Engine engine;
    CHECK(atrous_set_log(2, print_message, nullptr));
    AtrousConfig config = atrous::sized<AtrousConfig>();
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    atrous::set(config, atrous::Preset::Best);
    config.debug_view = folder != nullptr;
    if (is_wrong) atrous::set(config, atrous::MotionDirection::CurrentMinusPrevious);
    info.check_guides = 1;
    CHECK(atrous_check_requirements(&info, 1));
    atrous::Executor executor;
    CHECK(executor.create(info));
    uint8_t* result_mapped = nullptr;
    const Physical result = engine.create_mapped_buffer(scene::result_bytes, &result_mapped);
    LentInputs inputs(engine);
    if (folder) CHECK(executor.capture(folder, synthetic::frames));
    for (uint32_t index = 0; index <= synthetic::frames; ++index) {  // one more, since counters come frames later
        inputs.write(index);
        engine.begin();
        inputs.record(engine.cmd);
        const AtrousFrameParams params = scene::params(index);
        CHECK(executor.denoise(engine.cmd, params, inputs.lent));
        CHECK(executor.record_copy(engine.cmd, "denoised_radiance", result.buffer, scene::result_bytes));
        engine.submit_and_wait();
        if (index < synthetic::frames) std::printf("frame %u checksum %016" PRIx64 "\n", index, scene::checksum(result_mapped));
    }
    for (const atrous::View view : {atrous::View::Depth, atrous::View::Normal}) {
        if (!folder) break;
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
    engine.destroy(result);
}
