/* A graph of a host's own: the nodes around a filter whose SPIR-V is given. */
#pragma once
#include "atrous.h"

#ifdef __cplusplus
extern "C"
#endif
AtrousStatus custom_graph(AtrousGraph* graph, const uint32_t* spirv, uint64_t word_count);
