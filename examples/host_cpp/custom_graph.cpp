// Runs a graph of the engine's own, with a compute shader of the engine in it: `custom_graph SHADER.spv` builds it by atrous.hpp, and
// `custom_graph SHADER.spv c` by examples/host_c/custom_graph.c. Prints a checksum of every denoised frame.
#include "../host_c/custom_graph.h"

#include <cinttypes>

#include "atrous.hpp"
#include "lent.hpp"

static std::vector<uint32_t> read_words(const char* path) {
    std::FILE* file = std::fopen(path, "rb");
    if (!file) std::perror(path), std::exit(1);
    std::vector<uint32_t> words;
    for (uint32_t word; std::fread(&word, sizeof word, 1, file) == 1;) words.push_back(word);
    std::fclose(file);
    return words;
}

static void build(atrous::Graph& graph, const std::vector<uint32_t>& spirv) {
    AtrousPort guides, noisy, irradiance, history, accumulated, estimate, stage, filtered, denoised;
    CHECK(graph.node(ATROUS_NODE_IMPORT, {}, guides));
    CHECK(graph.node(ATROUS_NODE_RADIANCE, {ATROUS_TEXT("name", ATROUS_INPUT_NOISY_RADIANCE)}, noisy));
    CHECK(graph.node(ATROUS_NODE_DEMODULATE, {ATROUS_PORT("guides", guides), ATROUS_PORT("noisy", noisy)}, irradiance));
    CHECK(graph.node(ATROUS_NODE_HISTORY, {ATROUS_PORT("of", irradiance)}, history));
    CHECK(graph.node(ATROUS_NODE_TEMPORAL_ACCUMULATION,
                     {ATROUS_PORT("guides", guides), ATROUS_PORT("irradiance", irradiance), ATROUS_PORT("history", history)}, accumulated));
    CHECK(graph.node(ATROUS_NODE_VARIANCE,
                     {ATROUS_PORT("guides", guides), ATROUS_PORT("accumulated", accumulated), ATROUS_PORT("history", history)}, estimate));
    CHECK(graph.stage("mean_3x3", spirv, {ATROUS_PORT("estimate", estimate)}, stage));
    CHECK(graph.part(stage, "filtered", filtered));
    CHECK(graph.node(ATROUS_NODE_MODULATE, {ATROUS_PORT("guides", guides), ATROUS_PORT("filtered", filtered)}, denoised));
    CHECK(graph.output("denoised_radiance", denoised));
}

int main(int argc, char** argv) {
    if (argc < 2) return std::fprintf(stderr, "custom_graph SHADER.spv [c]\n"), 1;
    const std::vector<uint32_t> spirv = read_words(argv[1]);
    Engine engine;
    AtrousConfig config = atrous::sized<AtrousConfig>();
    CHECK(atrous_config_default(&config, synthetic::width, synthetic::height));
    atrous::set(config, atrous::Preset::Svgf);  // whose accumulation and variance these are
    atrous::Graph graph;
    CHECK(graph.create(config));
    if (argc > 2)
        CHECK(custom_graph(graph.get(), spirv.data(), spirv.size()));
    else
        build(graph, spirv);
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr};
    info.graph = graph.get();
    CHECK(atrous_check_requirements(&info, 1));
    atrous::Executor executor;
    CHECK(executor.create(info));
    uint8_t* result_mapped = nullptr;
    const Physical result = engine.create_mapped_buffer(scene::result_bytes, &result_mapped);
    LentInputs inputs(engine);
    for (uint32_t index = 0; index < synthetic::frames; ++index) {
        inputs.write(index);
        engine.begin();
        inputs.record(engine.cmd);
        CHECK(executor.denoise(engine.cmd, scene::params(index), inputs.lent));
        CHECK(executor.record_copy(engine.cmd, "denoised_radiance", result.buffer, scene::result_bytes));
        engine.submit_and_wait();
        std::printf("frame %u checksum %016" PRIx64 "\n", index, scene::checksum(result_mapped));
    }
    engine.destroy(result);
}
