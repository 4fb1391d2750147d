#!/usr/bin/env bash
# Runs under Miri some of what has no Vulkan in it: undefined behaviour, reads of what was never written, leaks. Installs a nightly toolchain
# with Miri where it is missing. Arguments are a package and filters of its tests in place of all of these.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
rustup toolchain list | grep -q '^nightly' || rustup toolchain install nightly --profile minimal
for component in miri rust-src; do
    rustup component list --toolchain nightly --installed | grep -q "^$component" || rustup component add --toolchain nightly "$component"
done

# The first lets tests read the environment. Without the second, Miri rounds `powf` and the like at random.
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
# Files are renamed, and pipes made, by calls that Miri lacks.
step --package atrous-files --lib -- files_are_read
# What declares every preset, or filters more than a few pixels, takes minutes a test.
step --package atrous-capi --no-default-features --lib -- --skip names_and_uses_fit
step --package atrous --no-default-features --features host-stages --lib -- \
    choice:: contract::access contract::alias contract::format contract::history_watch contract::texel contract::tuning reference::binary16 \
    graph::tests::matching graph::tests::whole::a_cycle
# The twins that look at few pixels at once.
step --package atrous --no-default-features --features host-stages --lib -- \
    nodes::history_confidence nodes::block_percentiles nodes::demodulate nodes::fill_holes nodes::modulate nodes::sample_albedo \
    nodes::shadowed_light nodes::tone_map nodes::visibility_samples nodes::volume_points
echo
echo "miri.sh: all passed"
