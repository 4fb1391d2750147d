// Gives the functions of a graph everything that they must refuse.
#pragma once
#include "bad_input.hpp"

// A module without an entry point, of the length that is asked for.
inline std::vector<uint32_t> empty_module(size_t words) {
    std::vector<uint32_t> module{0x07230203u, 0x00010300u, 0, 8, 0};
    module.resize(words);
    return module;
}

inline void refuse_bad_nodes(AtrousGraph* graph, Refusals& refusals) {
    AtrousPort port = 7;
    const auto node = [&](const char* name, std::vector<AtrousArgument> arguments) {
        return atrous_graph_node(graph, name, nullptr, arguments.data(), uint32_t(arguments.size()), &port);
    };
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "node is NULL", atrous_graph_node(graph, nullptr, nullptr, nullptr, 0, &port));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "arguments is NULL", atrous_graph_node(graph, "temporal_upscale", nullptr, nullptr, 2, &port));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "4000000000 arguments", atrous_graph_node(graph, "temporal_upscale", nullptr, nullptr, 4000000000u, &port));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "node no_such does not exist; there are: radiance", node("no_such", {}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "guides is missing; give Guides", node(ATROUS_NODE_TEMPORAL_UPSCALE, {}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name of argument 0 is NULL", node(ATROUS_NODE_TEMPORAL_UPSCALE, {ATROUS_PORT(nullptr, 0)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "port 4000000000 is none of this graph", node(ATROUS_NODE_TEMPORAL_UPSCALE, {ATROUS_PORT("guides", 4000000000u)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "has the kind 99; allowed: 0 (a port)", node(ATROUS_NODE_TEMPORAL_UPSCALE, {{"guides", 99, 0, 0, nullptr}}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "there is no argument levels; the arguments are: surface_id, object_normal, albedo",
           node(ATROUS_NODE_IMPORT, {ATROUS_NUMBER("levels", 1)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "surface_id is 2", node(ATROUS_NODE_IMPORT, {ATROUS_NUMBER("surface_id", 2)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "surface_id is 0.5; give a whole", node(ATROUS_NODE_IMPORT, {ATROUS_NUMBER("surface_id", 0.5)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "surface_id is NaN", node(ATROUS_NODE_IMPORT, {ATROUS_NUMBER("surface_id", NAN)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "surface_id is a text; give a number", node(ATROUS_NODE_IMPORT, {ATROUS_TEXT("surface_id", "yes")}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "surface_id is given twice",
           node(ATROUS_NODE_IMPORT, {ATROUS_NUMBER("surface_id", 1), ATROUS_NUMBER("surface_id", 1)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name is NULL", node(ATROUS_NODE_RADIANCE, {ATROUS_TEXT("name", nullptr)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "constant from 0", node(ATROUS_NODE_IMPORT, {ATROUS_CONSTANT("surface_id", -1)}));
    EXPECT_EQUAL(7, port);  // what is refused writes nothing

    AtrousPort guides = 0, noisy = 0, irradiance = 0, part = 0;
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_node(graph, ATROUS_NODE_IMPORT, nullptr, nullptr, 0, &guides));
    EXPECT(ATROUS_STATUS_OK, "", node(ATROUS_NODE_RADIANCE, {ATROUS_TEXT("name", "noisy_radiance")}));
    noisy = port;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "guides is Radiance; give Guides",
           node(ATROUS_NODE_DEMODULATE, {ATROUS_PORT("guides", noisy), ATROUS_PORT("noisy", guides)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "albedo: `blue` is no Albedo; there are: none, diffuse, specular",
           node(ATROUS_NODE_DEMODULATE, {ATROUS_PORT("guides", guides), ATROUS_PORT("noisy", noisy), ATROUS_TEXT("albedo", "blue")}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "albedo is a number; give a text: none, diffuse, specular",
           node(ATROUS_NODE_DEMODULATE, {ATROUS_PORT("guides", guides), ATROUS_PORT("noisy", noisy), ATROUS_NUMBER("albedo", 1)}));
    // A port of 0 leaves an argument out.
    EXPECT(ATROUS_STATUS_OK, "",
           node(ATROUS_NODE_DEMODULATE, {ATROUS_PORT("guides", guides), ATROUS_PORT("noisy", noisy), ATROUS_PORT("gradient", 0)}));
    irradiance = port;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "give two ports of one kind",
           node(ATROUS_NODE_PAIR, {ATROUS_PORT("first", noisy), ATROUS_PORT("second", irradiance)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "of is Guides; give a port", node(ATROUS_NODE_HISTORY, {ATROUS_PORT("of", guides)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "accumulated is Radiance; give VisibilityAccumulated", node(ATROUS_NODE_VISIBILITY_FILTER, {ATROUS_PORT("guides", guides), ATROUS_PORT("accumulated", noisy)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "source is forward_projected with no samples",
           node(ATROUS_NODE_GRADIENT, {ATROUS_PORT("guides", guides), ATROUS_PORT("noisy", noisy)}));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "part is NULL", atrous_graph_part(graph, guides, nullptr, &part));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "result is NULL", atrous_graph_part(graph, guides, "guide", nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "Guides has no part depth; it has guide, surface_motion", atrous_graph_part(graph, guides, "depth", &part));
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_part(graph, guides, "guide", &part));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "name is NULL", atrous_graph_output(graph, nullptr, irradiance));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "is Guides, which is no image", atrous_graph_output(graph, "out", guides));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "on is 2", atrous_graph_share_outputs(graph, 2));

    AtrousStageInfo info{sizeof info};
    info.name = "mine";
    const std::vector<uint32_t> module = empty_module(5);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "info is NULL", atrous_graph_stage(graph, nullptr, nullptr, 0, &part));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "info->spirv is NULL", atrous_graph_stage(graph, &info, nullptr, 0, &part));
    info.spirv = module.data();
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "word_count is 0", atrous_graph_stage(graph, &info, nullptr, 0, &part));
    info.word_count = ~uint64_t(0);
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "word_count is 18446744073709551615", atrous_graph_stage(graph, &info, nullptr, 0, &part));
    info.word_count = module.size();
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "mine", atrous_graph_stage(graph, &info, nullptr, 0, &part));
    info.phase = 3;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "phase is 3", atrous_graph_stage(graph, &info, nullptr, 0, &part));
    info.phase = 1, info.name = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "info->name is NULL", atrous_graph_stage(graph, &info, nullptr, 0, &part));
}

inline void refuse_bad_graph(const Engine& engine, Refusals& refusals) {
    AtrousConfig config{sizeof config};
    EXPECT(ATROUS_STATUS_OK, "", atrous_config_default(&config, 8, 8));
    AtrousGraph* graph = nullptr;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "config is NULL", atrous_graph_create(nullptr, &graph));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "graph is NULL", atrous_graph_create(&config, nullptr));
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_create(&config, &graph));
    refuse_bad_nodes(graph, refusals);
    AtrousCreateInfo info{sizeof info, engine.instance, engine.physical_device, engine.device, vkGetInstanceProcAddr, &config};
    AtrousDenoiser* denoiser = nullptr;
    info.graph = graph;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "both a config and a graph", atrous_create(&info, &denoiser));
    info.config = nullptr, info.graph = reinterpret_cast<AtrousGraph*>(uintptr_t(1));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live graph", atrous_create(&info, &denoiser));
    // The same node twice is told by the whole, unless it has a scope of its own.
    AtrousPort guides = 0;
    const AtrousArgument none[] = {ATROUS_PORT("gradient", 0)};
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_node(graph, ATROUS_NODE_IMPORT, "apart", nullptr, 0, &guides));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "scope is empty", atrous_graph_node(graph, ATROUS_NODE_IMPORT, "", none, 1, nullptr));
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_node(graph, ATROUS_NODE_IMPORT, nullptr, none, 1, nullptr));
    info.graph = graph;
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "in the graph already", atrous_create(&info, &denoiser));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "in the graph already", atrous_check_requirements(&info, 1));
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_destroy(graph));
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_create(&config, &graph));
    info.graph = graph;
    const AtrousArgument long_name[] = {ATROUS_TEXT("name", "a_name_of_more_than_sixty_three_characters_which_no_struct_has_room_for")};
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_node(graph, ATROUS_NODE_RADIANCE, nullptr, long_name, 1, nullptr));
    EXPECT(ATROUS_STATUS_INVALID_ARGUMENT, "at most 63 fit", atrous_create(&info, &denoiser));
    EXPECT(ATROUS_STATUS_OK, "", atrous_graph_destroy(graph));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live graph", atrous_graph_destroy(graph));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live graph", atrous_graph_node(graph, ATROUS_NODE_TEMPORAL_UPSCALE, nullptr, nullptr, 0, &guides));
    EXPECT(ATROUS_STATUS_INVALID_HANDLE, "no live graph", atrous_create(&info, &denoiser));
}
