#!/usr/bin/env bash
# Prints which share of the branches of contract, graph, executor and C ABI the tests take, and fails below 90 % of any. Needs a nightly
# toolchain and cargo-llvm-cov, and installs what is missing of them; it builds everything anew and takes a quarter of an hour.
# `coverage.sh report` prints the figures of the last run again, by file.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --test
rustup toolchain list | grep -q '^nightly' || rustup toolchain install nightly --profile minimal
rustup component list --toolchain nightly --installed | grep -q '^llvm-tools' || rustup component add --toolchain nightly llvm-tools
cargo llvm-cov --version >/dev/null 2>&1 || cargo install cargo-llvm-cov --locked

# A folder of its own: what is instrumented is no use to other builds. The C++ host links the library from where its script puts it.
export RUSTUP_TOOLCHAIN=nightly CARGO_TARGET_DIR=$PWD/target/coverage ATROUS_REQUIRE_DEVICE=1
environment=$(cargo llvm-cov show-env --sh --branch 2>/dev/null)
eval "$environment"
report() {
    LLVM_COV_FLAGS="--object=target/capi/debug/libatrous_capi.so" cargo llvm-cov report --branch "$@"
}

if [ "${1:-}" != report ]; then
    find target/coverage -name '*.profraw' -delete 2>/dev/null || true
    cargo test --quiet --package atrous --features capture,hot-reload --lib --test suite --no-fail-fast
    cargo test --quiet --package atrous-capi --package atrous-attack
fi
# Columns of the table: the file first, and last its branches, those that were missed, and the share.
report 2>/dev/null | awk -v files="${1:-}" '
    function part(name) {
        if (name ~ /tests?\.rs$|\/tests\// || name ~ /_tests\.rs$/) return ""
        if (name ~ /^(.*\/)?crates\/capi\/src\//) return "C ABI"
        if (name ~ /(^|\/)src\/contract\// && name !~ /crates|examples/) return "contract"
        if (name ~ /(^|\/)src\/graph\// && name !~ /crates|examples/) return "graph"
        if (name ~ /(^|\/)src\/executor\// && name !~ /crates|examples/) return "executor"
        return ""
    }
    part($1) != "" && $(NF - 2) ~ /^[0-9]+$/ {
        all[part($1)] += $(NF - 2); missed[part($1)] += $(NF - 1)
        if (files == "report" && $(NF - 1) > 0) printf "%-48s %4d branches, %3d not taken\n", $1, $(NF - 2), $(NF - 1)
    }
    END {
        status = 0
        for (name in all) {
            share = 100 * (1 - missed[name] / all[name])
            printf "%-10s %5.1f %% of %d branches\n", name, share, all[name]
            if (share < 90) status = 1
        }
        exit status
    }'
