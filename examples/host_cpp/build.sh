#!/usr/bin/env bash
# Builds the C++ host with g++ alone: build.sh [OUTPUT [FLAG...]], for example build.sh target/host_cpp -fsanitize=address
# SOURCE=one_call.cpp builds the host with the executor instead of main.cpp, and CRATE_TYPE=cdylib links the shared library; default is the static one.
set -euo pipefail
output=$(realpath -m "${1:-target/host_cpp}")
shift || true
cd "$(dirname "$0")/../.."
kind=${CRATE_TYPE:-staticlib}

# From the checked-in SPIR-V, so that no compiler of shaders is needed. Both kinds at once, so that one compilation serves either.
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
cargo rustc --quiet -p atrous-capi --lib --no-default-features --crate-type staticlib,cdylib --target-dir "$target"
built=$target/debug
case $kind in
    staticlib) library=("$built/libatrous_capi.a") ;;
    cdylib)
        # The loader looks for the name that stands in the library.
        ln -sf libatrous_capi.so "$built/libatrous.so.0"
        library=("$built/libatrous_capi.so" "-Wl,-rpath,$built")
        ;;
    *) echo "build.sh: CRATE_TYPE is $kind; it is staticlib or cdylib" >&2; exit 2 ;;
esac
mkdir -p "$(dirname "$output")"
# Without -ffp-contract=off some targets fuse multiplications and additions, and the input would differ in its last bits.
g++ -std=c++17 -O1 -g -Wall -Wextra -Wno-missing-field-initializers -ffp-contract=off "$@" -I crates/capi/include \
    "examples/host_cpp/${SOURCE:-main.cpp}" "${library[@]}" -lvulkan -lpthread -ldl -lm -o "$output"
echo "$output"
