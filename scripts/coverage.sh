#!/usr/bin/env bash
# Prints which share of the branches of contract, graph, executor and C ABI the tests take, and fails below 90 % of any. Needs a nightly
# toolchain and cargo-llvm-cov, and installs what is missing of them; it builds everything anew.
# `coverage.sh report` prints the figures of the last run again, by file.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --test
rustup toolchain list | grep -q '^nightly' || rustup toolchain install nightly --profile minimal
rustup component list --toolchain nightly --installed | grep -q '^llvm-tools' || rustup component add --toolchain nightly llvm-tools
cargo llvm-cov --version >/dev/null 2>&1 || cargo install cargo-llvm-cov --locked

# A folder of its own: what is instrumented is no use to other builds. The C++ host links the library that is built there.
export RUSTUP_TOOLCHAIN=nightly CARGO_TARGET_DIR=$PWD/target/coverage ATROUS_REQUIRE_DEVICE=1
environment=$(cargo llvm-cov show-env --sh --branch 2>/dev/null)
eval "$environment"
report() {
    library=$CARGO_TARGET_DIR/debug/libatrous_capi.so
    if grep -q __llvm_covmap "$library" 2>/dev/null; then export LLVM_COV_FLAGS="--object=$library"; fi
    cargo llvm-cov report --branch --lcov --package atrous --package atrous-capi
}

if [ "${1:-}" != report ]; then
    # Programs of other sources that lie about would count as code that never ran.
    cargo llvm-cov clean --workspace
    cargo test --quiet --package atrous --features capture,hot-reload --lib
    # The groups that are about these parts; the others run the same passes for their pictures.
    for group in allocation attack::a_ bad_input binding capture contract counters debug_views declarations faults frame_life graphs hazards \
        history_loss host_header hosts hot_reload input_sets one_call pipelines readback resize schedules sync_validation; do
        cargo test --quiet --package atrous --features capture,hot-reload --test suite -- "$group"
    done
    cargo test --quiet --package atrous-capi --package atrous-fuzz
fi
# Of each file its name, its branches and those that were taken.
report | awk -F: -v root="$PWD/" -v files="${1:-}" '
    function part(name) {
        if (index(name, root) != 1 || name ~ /tests?\.rs$|\/tests\//) return ""
        name = substr(name, length(root) + 1)
        if (name ~ /^crates\/capi\/src\//) return "C ABI"
        if (name ~ /^src\/(contract|graph|executor)\//) { split(name, folders, "/"); return folders[2] }
        return ""
    }
    # Where the tests of a file begin, which are no code of the product.
    function tests_of(name,   line, number) {
        while ((getline line < name) > 0) { number++; if (line == "mod tests {") break }
        close(name)
        return line == "mod tests {" ? number : 1e9
    }
    /^SF:/ { name = $2; found = hit = 0; end = part(name) == "" ? 0 : tests_of(name) }
    /^BRDA:/ { split($2, branch, ","); if (branch[1] < end) { found++; if (branch[4] + 0 > 0) hit++ } }
    /^end_of_record/ && found > 0 {
        all[part(name)] += found; taken[part(name)] += hit
        if (files == "report" && found > hit)
            printf "%-48s %4d branches, %3d not taken\n", substr(name, length(root) + 1), found, found - hit
    }
    END {
        for (name in all) {
            share = 100 * taken[name] / all[name]
            printf "%-10s %5.1f %% of %d branches\n", name, share, all[name]
            if (share < 90) status = 1
        }
        exit status
    }'
