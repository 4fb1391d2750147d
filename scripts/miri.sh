#!/usr/bin/env bash
# Runs under Miri what has no Vulkan in it: undefined behaviour, reads of what was never written, leaks. Installs a nightly toolchain
# with Miri where it is missing. Arguments are a package and filters of its tests in place of all of these.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
rustup toolchain list | grep -q '^nightly' || rustup toolchain install nightly --profile minimal
for component in miri rust-src; do
    rustup component list --toolchain nightly --installed | grep -q "^$component" || rustup component add --toolchain nightly "$component"
done

# Tests write into temporary folders. Floats are rounded as the hardware does: the tests compare bits of twins with themselves.
export MIRIFLAGS="-Zmiri-disable-isolation -Zmiri-deterministic-floats ${MIRIFLAGS:-}"
step() {
    printf '\n== %s\n' "$*"
    cargo +nightly miri test --quiet "$@"
}
if [ $# -gt 0 ]; then
    package=$1
    shift
    step --package "$package" --lib -- "$@"
    exit
fi
step --package atrous-texel --package atrous-files --lib
