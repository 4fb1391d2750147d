#!/usr/bin/env bash
# Runs the demo: installs what is missing, builds, renders and denoises `cornell` and `pillars`, and writes pictures and a table to out/.
# With --window it opens a window instead. Arguments are passed on: scripts/demo.sh --help
set -euo pipefail
cd "$(dirname "$0")/.."
features=() setup=()
for argument in "$@"; do
    if [ "$argument" = --window ]; then features=(--features window) setup=(--window); fi
done
scripts/setup.sh "${setup[@]}"
export MESA_SHADER_CACHE_DIR=$PWD/target/shader-cache

echo "demo: building (the first time takes some minutes)"
cargo build --release --quiet --package atrous-demo "${features[@]}"
exec target/release/atrous-demo "$@"
