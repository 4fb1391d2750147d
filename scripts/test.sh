#!/usr/bin/env bash
# Passes the tests: formatting, lints, docs, and every test under the Vulkan validation layer. Installs what is missing.
# --bevy: those of crates/bevy and examples/host_bevy alone, a workspace of its own: Bevy takes as long to build as all else, and
# asks for a newer compiler, which is installed beside the one that is there.
# --solari: examples/solari alone, in the same workspace, on the software Vulkan of Debian's backports, which has ray queries: it is
# unpacked under target and not installed.
# --mesa25: the library's suite on that driver, whose bits have a table of their own.
# --blade: those of examples/host_blade alone, on a copy of blade-graphics that shows its Vulkan handles.
set -euo pipefail
cd "$(dirname "$0")/.."
bevy=false
blade=false
solari=false
mesa25=false
for option in "$@"; do
    case $option in
        --bevy) bevy=true ;;
        --blade) blade=true ;;
        --solari) solari=true ;;
        --mesa25) mesa25=true ;;
        *) echo "test.sh: unknown option $option: --bevy, --solari, --mesa25 and --blade are known" >&2; exit 1 ;;
    esac
done
scripts/setup.sh --test

for component in rustfmt clippy; do
    cargo "${component/rustfmt/fmt}" --version >/dev/null 2>&1 || rustup component add "$component"
done

# In a fresh clone there is nothing to build upon, and what cargo keeps for the next build takes time.
[ -d target/debug ] || export CARGO_INCREMENTAL=0

# A machine without a Vulkan device is an error here, not a skipped test: setup.sh has just installed one.
export ATROUS_REQUIRE_DEVICE=1
# Likewise SPIRV-Cross, where setup.sh installs packages.
if command -v apt-get >/dev/null; then export ATROUS_REQUIRE_TRANSLATORS=1; fi
# Likewise a browser, where setup.sh could install one.
if dpkg-query -W -f='${Status}' chromium 2>/dev/null | grep -q '^install ok installed$' && grep -q '^ID=debian$' /etc/os-release; then
    export ATROUS_REQUIRE_BROWSER=1
fi
# Images of a test have the sizes of those of the last one: memory that is kept costs no page faults, a tenth of the time of a suite.
export MALLOC_MMAP_THRESHOLD_=1073741824 MALLOC_TRIM_THRESHOLD_=4294967296
step() {
    local began=$SECONDS
    printf '\n== %s\n' "$*"
    "$@"
    echo "-- $((SECONDS - began)) s"
}

if $bevy || $solari; then
    host=(--manifest-path examples/host_bevy/Cargo.toml --target-dir target/bevy)
    version=$(sed -n 's/^rust-version = "\(.*\)"$/\1/p' examples/host_bevy/Cargo.toml)
    cargo "+$version" clippy --version >/dev/null 2>&1 || rustup toolchain install "$version" --profile minimal --component clippy
fi

# Unpacks Mesa 25 of Debian's backports, and prints its manifest.
unpack_mesa() {
    local to=$PWD/target/mesa25 file
    local pool=https://deb.debian.org/debian/pool/main
    mkdir -p "$to"
    while read -r sum path; do
        file=$to/${path##*/}
        [ -e "$file" ] || curl -fsS "$pool/$path" -o "$file"
        echo "$sum  $file" | sha256sum --check --quiet - >&2
        dpkg-deb -x "$file" "$to"
    done <<'END'
3899f1800424c60a05df5d6913076a526ca8fdbabec43672cd397563d1ca3263 m/mesa/mesa-vulkan-drivers_25.0.7-2~bpo12+1_amd64.deb
9cc2f341964286295124a32d3625edb76730500625e54a1e682761f883064d7b libd/libdrm/libdrm2_2.4.123-1~bpo12+1_amd64.deb
END
    local library=$to/usr/lib/x86_64-linux-gnu
    sed "s#\"library_path\": \".*\"#\"library_path\": \"$library/libvulkan_lvp.so\"#" "$to/usr/share/vulkan/icd.d/lvp_icd.json" > "$to/lvp_icd.json"
    echo "$to/lvp_icd.json"
}

if $solari; then
    mesa=$(unpack_mesa)
    step cargo "+$version" build "${host[@]}" --package solari --quiet
    VK_DRIVER_FILES=$mesa VK_ICD_FILENAMES=$mesa LD_LIBRARY_PATH=${mesa%/*}/usr/lib/x86_64-linux-gnu \
        step cargo "+$version" test "${host[@]}" --package solari --quiet
    echo
    echo "test.sh --solari: all passed, $SECONDS s"
    exit
fi

if $mesa25; then
    mesa=$(unpack_mesa)
    VK_DRIVER_FILES=$mesa VK_ICD_FILENAMES=$mesa LD_LIBRARY_PATH=${mesa%/*}/usr/lib/x86_64-linux-gnu \
        step cargo test --package atrous --features capture,hot-reload --quiet --test suite
    echo
    echo "test.sh --mesa25: all passed, $SECONDS s"
    exit
fi

if $bevy; then
    step cargo fmt "${host[@]:0:2}" --all --check
    step cargo "+$version" clippy "${host[@]}" --workspace --all-targets --features bevy_atrous/solari --quiet -- -D warnings
    step cargo "+$version" test "${host[@]}" --workspace --exclude solari --quiet
    echo
    echo "test.sh --bevy: all passed, $SECONDS s"
    exit
fi

# Copies blade-graphics out of cargo's registry, and adds what shows its handles.
show_handles_of_blade() {
    local version added=examples/host_blade/handles.rs copy=target/blade/blade-graphics from=target/blade/from
    version=$(sed -n 's/^blade-graphics = "=\(.*\)"$/\1/p' examples/host_blade/Cargo.toml)
    [ "$copy/Cargo.toml" -nt "$added" ] && return
    rm -rf "$copy" "$from"
    mkdir -p "$from/src"
    touch "$from/src/lib.rs"
    printf '[workspace]\n[package]\nname = "from"\n[dependencies]\nblade-graphics = "=%s"\n' "$version" > "$from/Cargo.toml"
    local manifest
    manifest=$(cargo metadata --format-version 1 --manifest-path "$from/Cargo.toml" |
        grep -o "\"[^\"]*/blade-graphics-$version/Cargo.toml\"" | head -n 1 | tr -d '"')
    cp -r "$(dirname "$manifest")" "$copy"
    chmod -R u+w "$copy"
    cat "$added" >> "$copy/src/vulkan/mod.rs"
}

if $blade; then
    show_handles_of_blade
    host=(--manifest-path examples/host_blade/Cargo.toml --target-dir target/blade)
    step cargo fmt "${host[@]:0:2}" --check
    step cargo clippy "${host[@]}" --all-targets --quiet -- -D warnings
    step cargo test "${host[@]}" --quiet
    echo
    echo "test.sh --blade: all passed, $SECONDS s"
    exit
fi

step cargo fmt --all --check
# The stages are modules of a macro, where `cargo fmt` does not find them.
step rustfmt --edition 2021 --check src/nodes/*/mod.rs
step cargo clippy --package atrous --quiet -- -D warnings
# Also proves that the checked-in SPIR-V was made from this GLSL, and that no C++ toolchain is needed with it.
step cargo clippy --package atrous-synthetic --example host_without_features --quiet -- -D warnings
step cargo clippy --package atrous --no-default-features --features capture --lib --quiet -- -D warnings
# The compiler of these builds is clippy's: a run of `cargo clippy` would build every dependency once more.
tests=(env RUSTC_WORKSPACE_WRAPPER="$(rustc --print sysroot)/bin/clippy-driver" CLIPPY_ARGS=-Dwarnings
    cargo test --workspace --features capture,window,hot-reload --quiet)
step "${tests[@]}" --no-run

# The same tests on a second driver, where Debian's chromium brings one, and the pages.
second_driver_and_pages() {
    local swiftshader=/usr/lib/chromium/vk_swiftshader_icd.json features
    if [ -e "$swiftshader" ]; then
        # How near many frames of visibility come to the truth is no matter of the driver.
        VK_ICD_FILENAMES=$swiftshader step "${tests[@]}" --test suite -- \
            parity::one_signal,parity::specular_fast,where_nothing_changed,bad_values_are_forgotten,graphs::wild,visibility::,contract:: \
            --skip each_of_four_lights --skip nearer_to_the_truth
    fi
    # Without a feature there is nothing to link to what it has.
    for features in --no-default-features --features=default; do
        RUSTDOCFLAGS="-D warnings" step cargo doc --package atrous "$features" --no-deps --quiet
    done
    RUSTDOC=$PWD/scripts/pages.sh RUSTDOCFLAGS="-D warnings" step "${tests[@]}" --doc
}

# The long tests of a suite leave a core idle, so both run side by side. What was printed stands below, in one piece.
printed=$(mktemp)
set -m
(second_driver_and_pages) >"$printed" 2>&1 &
set +m
beside=$!
trap 'kill -- "-$beside" 2>/dev/null || true; rm -f "$printed"' EXIT
step "${tests[@]}"
wait "$beside" || { cat "$printed"; exit 1; }
cat "$printed"
echo
echo "test.sh: all passed, $SECONDS s"
