/* A graph of a host's own in C99, with a compute shader of the host in the place of the spatial filter: examples/custom_graph.rs says the
 * same in Rust. examples/host_cpp/custom_graph.cpp runs it. */
#include "custom_graph.h"

#define LENGTH(array) ((uint32_t)(sizeof(array) / sizeof *(array)))
/* The first call that fails is the result. */
#define TRY(call)                                           \
    do {                                                    \
        const AtrousStatus status = call;                   \
        if (status != ATROUS_STATUS_OK) return status;      \
    } while (0)
#define NODE(node, arguments, result) TRY(atrous_graph_node(graph, node, 0, arguments, LENGTH(arguments), result))

AtrousStatus custom_graph(AtrousGraph* graph, const uint32_t* spirv, uint64_t word_count) {
    AtrousPort guides, noisy, irradiance, history, accumulated, estimate, stage, filtered, denoised;
    TRY(atrous_graph_node(graph, ATROUS_NODE_IMPORT, 0, 0, 0, &guides));
    const AtrousArgument name[] = {ATROUS_TEXT("name", ATROUS_INPUT_NOISY_RADIANCE)};
    NODE(ATROUS_NODE_RADIANCE, name, &noisy);
    const AtrousArgument divided[] = {ATROUS_PORT("guides", guides), ATROUS_PORT("noisy", noisy)};
    NODE(ATROUS_NODE_DEMODULATE, divided, &irradiance);
    const AtrousArgument past[] = {ATROUS_PORT("of", irradiance), ATROUS_TEXT("feedback", "accumulated")};
    NODE(ATROUS_NODE_HISTORY, past, &history);
    const AtrousArgument blended[] = {ATROUS_PORT("guides", guides), ATROUS_PORT("irradiance", irradiance), ATROUS_PORT("history", history)};
    NODE(ATROUS_NODE_TEMPORAL_ACCUMULATION, blended, &accumulated);
    const AtrousArgument moments[] = {ATROUS_PORT("guides", guides), ATROUS_PORT("accumulated", accumulated), ATROUS_PORT("history", history)};
    NODE(ATROUS_NODE_VARIANCE, moments, &estimate);

    AtrousStageInfo info = {sizeof info, ATROUS_PHASE_AFTER_LIGHTING, 0, 1, "mean_3x3", 0, 0};
    info.spirv = spirv, info.word_count = word_count;
    const AtrousArgument read[] = {ATROUS_PORT("estimate", estimate)};
    TRY(atrous_graph_stage(graph, &info, read, LENGTH(read), &stage));
    TRY(atrous_graph_part(graph, stage, "filtered", &filtered));

    const AtrousArgument multiplied[] = {ATROUS_PORT("guides", guides), ATROUS_PORT("filtered", filtered)};
    NODE(ATROUS_NODE_MODULATE, multiplied, &denoised);
    return atrous_graph_output(graph, "denoised_radiance", denoised);
}
