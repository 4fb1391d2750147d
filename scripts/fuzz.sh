#!/usr/bin/env bash
# Runs the fuzzers of fuzz/ on the corpus that is checked in: fuzz.sh [SECONDS [TARGET...]], by default 60 seconds each. Needs a nightly
# toolchain and cargo-fuzz, and installs what is missing of them. The tests replay the corpus without either: fuzz/tests.
# What a fuzzer finds is under fuzz/artifacts; mended, it belongs into fuzz/corpus. What it learned is kept under target/fuzz.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
rustup toolchain list | grep -q '^nightly' || rustup toolchain install nightly --profile minimal
cargo fuzz --version >/dev/null 2>&1 || cargo install cargo-fuzz --locked

seconds=${1:-60}
shift || true
[ $# -gt 0 ] || set -- exr sequence gltf graph structs
for target in "$@"; do
    printf '\n== %s\n' "$target"
    mkdir -p "target/fuzz/$target"
    # Leaks are the process's own tables, which live to its end.
    cargo +nightly fuzz run --features libfuzzer "$target" "target/fuzz/$target" "fuzz/corpus/$target" -- \
        -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=20 -detect_leaks=0 -print_final_stats=1
done
echo
echo "fuzz.sh: nothing found"
