#!/usr/bin/env bash
# Checks the packages that are published, as their users will get them: with the minimum Rust version, from what cargo packages, as
# the public documentation builds them, from the first release on against the last release by the rules of semantic versions, and
# what they depend on: licences, duplicates, sources, and the advisories of RustSec.
# It also writes target/third-party-notices.html, which goes with every binary or C library that is handed on. Installs what is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
command -v python3 >/dev/null || { echo "release.sh: it needs python3, to read Cargo.toml" >&2; exit 1; }
step() { printf '\n== %s\n' "$*"; "$@"; }

version=$(sed -n '/^\[workspace.package\]/,/^$/s/^rust-version = "\(.*\)"$/\1/p' Cargo.toml)
for toolchain in "$version" nightly; do
    cargo "+$toolchain" --version >/dev/null 2>&1 || rustup toolchain install "$toolchain" --profile minimal
done
mapfile -t names < <(cargo metadata --format-version 1 --no-deps | python3 -c '
import json, sys
print(*[package["name"] for package in json.load(sys.stdin)["packages"] if package["publish"] is None], sep="\n")')
packages=("${names[@]/#/--package=}")

step cargo "+$version" check --quiet --target-dir target/release-check --lib "${packages[@]}" --features atrous/capture
# The tests of the laboratory, the demo and the window may ask for more.
step cargo "+$version" check --quiet --target-dir target/release-check --package atrous --tests --features capture,hot-reload
step cargo package --quiet --target-dir target/release-check "${packages[@]}"
# The plugin for Bevy is a workspace of its own, where the registry must have the others before it can be compiled.
bevy=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' crates/bevy/Cargo.toml)
cargo "+$bevy" --version >/dev/null 2>&1 || rustup toolchain install "$bevy" --profile minimal
step cargo "+$bevy" package --quiet --no-verify --exclude-lockfile --target-dir target/release-check --manifest-path crates/bevy/Cargo.toml

for name in "${names[@]}"; do
    # The internal compiler of GLSL is shown to nobody.
    [ "$name" != atrous-glsl ] || continue
    manifest=$(cargo pkgid --package "$name" | sed 's/^path+file:\/\///; s/#.*//')/Cargo.toml
    mapfile -t options < <(python3 -c '
import sys, tomllib
docs = tomllib.load(open(sys.argv[1], "rb"))["package"].get("metadata", {}).get("docs", {}).get("rs", {})
if docs.get("no-default-features"): print("--no-default-features")
if docs.get("features"): print("--features=" + ",".join(docs["features"]))' "$manifest")
    RUSTDOCFLAGS="--cfg docsrs -D warnings" step cargo +nightly doc --quiet --no-deps --target-dir target/release-check \
        --package "$name" "${options[@]}"
done

for name in "${names[@]}"; do
    if found=$(cargo info --quiet --registry crates-io "$name" 2>&1); then
        cargo semver-checks --version >/dev/null 2>&1 || cargo install cargo-semver-checks --locked
        step cargo semver-checks --package "$name"
    elif [[ $found == *"could not find"* ]]; then
        echo "$name is not released yet: there is nothing to compare its interface with"
    else
        echo "release.sh: the registry does not say whether $name is released: $found" >&2
        exit 1
    fi
done

cargo deny --version >/dev/null 2>&1 || cargo install cargo-deny --locked
step cargo deny --workspace check bans licenses sources

cargo about --version >/dev/null 2>&1 || cargo install cargo-about --locked --features cli
step cargo about generate --offline --locked --workspace --output-file target/third-party-notices.html scripts/notices.hbs --config scripts/notices.toml
# Last: it fetches what is known today; without a network a copy that was fetched before does, and is said to be one.
if ! step cargo deny --workspace check advisories; then
    [ -d "${CARGO_HOME:-$HOME/.cargo}/advisory-dbs" ] || { echo "release.sh: there is no copy of the advisories" >&2; exit 1; }
    echo "release.sh: the advisories of the copy that was fetched last:"
    step cargo deny --workspace --offline check advisories
fi
echo
echo "release.sh: all passed"
echo "cargo publish --workspace uploads the packages, those first that others depend on"
