#!/usr/bin/env bash
# Builds the C++ host with g++ alone: build.sh [OUTPUT [FLAG...]], for example build.sh target/host_cpp -fsanitize=address
set -euo pipefail
output=$(realpath -m "${1:-target/host_cpp}")
shift || true
cd "$(dirname "$0")/../.."

# A static library without the executor: no allocator, and no C++ toolchain is needed for it.
cargo rustc --quiet --lib --no-default-features --features capi --crate-type staticlib --target-dir target/capi
mkdir -p "$(dirname "$output")"
# Without -ffp-contract=off some targets fuse multiplications and additions, and the input would differ in its last bits.
g++ -std=c++17 -O1 -g -Wall -Wextra -Wno-missing-field-initializers -ffp-contract=off "$@" -I include \
    examples/host_cpp/main.cpp target/capi/debug/libatrous.a -lvulkan -lpthread -ldl -lm -o "$output"
echo "$output"
