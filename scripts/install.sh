#!/usr/bin/env bash
# Installs the library for C and C++: install.sh --prefix DIR. Header, shared and static library, and files for CMake and pkg-config.
set -euo pipefail

fail() { echo "install: $*" >&2; exit 2; }
[ $# -eq 2 ] && [ "$1" = --prefix ] && [ -n "$2" ] || fail "usage: scripts/install.sh --prefix DIR"
mkdir -p "$2"
prefix=$(realpath "$2")
cd "$(dirname "$0")/.."
for tool in cargo ld objcopy strip; do
    command -v "$tool" >/dev/null || fail "$tool is missing; scripts/setup.sh installs binutils, and https://rustup.rs has cargo"
done
[ "$(uname -s)" = Linux ] || fail "this makes packages for Linux; elsewhere build with: cargo rustc -p atrous-capi --release --crate-type cdylib"

# PROFILE=dev compiles faster and runs slower: for tests of the package itself.
profile=${PROFILE:-release}
target=$(realpath -m "${CARGO_TARGET_DIR:-target}")
cargo rustc --quiet -p atrous-capi --lib --no-default-features --profile "$profile" --crate-type staticlib,cdylib --target-dir "$target"
built=$target/$([ "$profile" = dev ] && echo debug || echo "$profile")
version=$(sed -n 's/^version = "\(.*\)"/\1/p' crates/capi/Cargo.toml)
major=${version%%.*}

mkdir -p "$prefix/include" "$prefix/lib/pkgconfig" "$prefix/lib/cmake/atrous"
cp crates/capi/include/atrous.h crates/capi/include/atrous.hpp "$prefix/include/"
strip --strip-unneeded -o "$prefix/lib/libatrous.so.$version" "$built/libatrous_capi.so"
ln -sf "libatrous.so.$version" "$prefix/lib/libatrous.so.$major"
ln -sf "libatrous.so.$major" "$prefix/lib/libatrous.so"

# One object that shows `atrous_*` and nothing of Rust, so that it links beside Rust libraries of other compilers.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
grep -o '\batrous_[a-z_]*(' crates/capi/include/atrous.h | tr -d '(' | sort -u >"$work/names"
sed 's/^/--undefined=/' "$work/names" >"$work/roots"
ld -r --gc-sections --force-group-allocation @"$work/roots" -o "$work/all.o" "$built/libatrous_capi.a"
# Without the bitcode of the standard library either: the merged one is none, and `ar` would fail on it.
objcopy --keep-global-symbols="$work/names" --strip-debug --remove-section=.llvmbc --remove-section=.llvmcmd "$work/all.o" "$work/atrous.o"
rm -f "$prefix/lib/libatrous.a"
ar rcs "$prefix/lib/libatrous.a" "$work/atrous.o"

fill() { sed "s/@VERSION@/$version/; s/@MAJOR@/$major/" "crates/capi/package/$1.in" >"$2/$1"; }
fill atrous.pc "$prefix/lib/pkgconfig"
fill atrousConfig.cmake "$prefix/lib/cmake/atrous"
fill atrousConfigVersion.cmake "$prefix/lib/cmake/atrous"
for file in "libatrous.so.$version" libatrous.a; do
    echo "$prefix/lib/$file: $(($(stat -c %s "$prefix/lib/$file") / 1024)) KiB"
done
