// Gives the library everything that it must refuse. `--random-input COUNT` gives it random structs instead, and `--check` asks it
// whether guides are as declared.
#include "bad_executor.hpp"
#include "bad_graph.hpp"
#include "bad_input.hpp"
#include "bad_tracker.hpp"
#include "conventions.hpp"
#include "engine.hpp"
#include "random_input.hpp"

int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], "--check") == 0) return check_conventions();
    Engine engine;
    if (argc > 2 && std::strcmp(argv[1], "--random-input") == 0) return RandomInput(engine, std::strtoull(argv[2], nullptr, 10)).run();
    Refusals refusals;
    refuse_bad_input(engine, refusals);
    refuse_bad_executor(engine, refusals);
    refuse_bad_tracker(engine, refusals);
    refuse_bad_graph(engine, refusals);
    std::printf("bad input: %d calls, %d wrong answers\n", refusals.count, refusals.wrong);
    return refusals.wrong == 0 ? 0 : 1;
}
