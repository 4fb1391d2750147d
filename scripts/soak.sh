#!/usr/bin/env bash
# Runs the attacks of tests/ for longer: ten times as many frames, graphs, schedules and lives of frames, and every value in every input.
# ATROUS_SOAK says how many times; arguments are filters of tests in place of all of these.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --test
export ATROUS_REQUIRE_DEVICE=1 ATROUS_SOAK=${ATROUS_SOAK:-10} ATROUS_GRAPH_SEEDS=${ATROUS_GRAPH_SEEDS:-0..60}
[ $# -gt 0 ] || set -- attack frame_life hazards schedules readback graphs
for filter in "$@"; do
    printf '\n== %s\n' "$filter"
    cargo test --package atrous --features capture,hot-reload --test suite --quiet -- --nocapture "$filter"
done
echo
echo "soak.sh: all passed"
