// A branch that few pixels take: `RARELY(condition) statement`. The condition is a variable; no `break` and no `continue` inside.
// Software Vulkan masks a branch, so that every pixel pays for it, but ends a loop where no pixel is left: there it is a loop of one round.
#ifndef RARELY_GLSL
#define RARELY_GLSL

layout(constant_id = 31) const bool MASKED_BRANCHES = false;

#define RARELY(condition) \
    for (uint rare_round = 0u; rare_round < (MASKED_BRANCHES ? uint(condition) : 1u); ++rare_round) \
        if (MASKED_BRANCHES || (condition))

#endif
