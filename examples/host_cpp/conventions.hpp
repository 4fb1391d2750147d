// Asks the library whether the guides are what the configuration says: once as they are, once with the motion declared the wrong way round.
#pragma once
#include <cstdio>
#include <cstring>

#include "atrous.h"
#include "synthetic.hpp"

inline int check_conventions() {
    synthetic::Frame inputs[2];
    AtrousFrameParams params[2]{};
    AtrousGuides guides[2]{};
    for (uint32_t i = 0; i < 2; ++i) {
        inputs[i] = synthetic::frame(i);
        params[i].struct_size = sizeof params[i];
        if (atrous_frame_params_default(&params[i], synthetic::width, synthetic::height) != ATROUS_STATUS_OK) return 1;
        synthetic::view_from_world(i, params[i].view_from_world);
        synthetic::clip_from_view(params[i].clip_from_view);
        guides[i] = {sizeof guides[i], synthetic::width, synthetic::height, &params[i],
                     inputs[i].depth[0].data(), inputs[i].normal[0].data(), inputs[i].motion[0].data(), inputs[i].surface_id.data()};
    }
    bool as_expected = true;
    for (const uint32_t direction : {0u, 1u}) {
        AtrousConfig config{sizeof config};
        AtrousConventionReport report{sizeof report};
        as_expected &= atrous_config_default(&config, synthetic::width, synthetic::height) == ATROUS_STATUS_OK;
        config.motion_direction = direction;
        as_expected &= atrous_check_conventions(&config, &guides[0], &guides[1], &report) == ATROUS_STATUS_OK;
        as_expected &= report.geometry == 0 && report.motion == direction && report.normals == 0;
        as_expected &= (std::strstr(report.text, "motion_direction: previous_minus_current") != nullptr) == (direction == 1);
        std::printf("motion_direction %u\n%s", direction, report.text);
    }
    return as_expected ? 0 : 1;
}
