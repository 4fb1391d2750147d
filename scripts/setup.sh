#!/usr/bin/env bash
# Installs what is missing and nothing else: a C toolchain for shaderc's archive, the Vulkan loader, a Vulkan driver
# where no device answers; with --window what a window needs, and with --test that, the Khronos validation layer, the headers and tools for hosts in C++,
# SPIRV-Cross, a virtual X server, and a browser for the tests of reports. Then makes the archive that `shaderc` links.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { echo "setup: $*" >&2; exit 1; }

command -v cargo >/dev/null || fail "no Rust toolchain: install one from https://rustup.rs, then run this again"

missing=()
need() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$1"); }
install_missing() {
    [ ${#missing[@]} -eq 0 ] && return
    echo "setup: installing ${missing[*]}"
    local sudo=
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || fail "these packages are missing: ${missing[*]}. Install them as root, then run this again"
        sudo=sudo
    fi
    local log; log=$(mktemp)
    { $sudo apt-get update && $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } \
        >"$log" 2>&1 || { cat "$log" >&2; fail "apt-get could not install ${missing[*]}"; }
    missing=()
}

if command -v apt-get >/dev/null; then
    for package in gcc g++ binutils libshaderc-dev glslang-dev spirv-tools libvulkan1 vulkan-tools; do need "$package"; done
    for option in "$@"; do
        case $option in
            --window) ;;
            --test)
                for package in vulkan-validationlayers libvulkan-dev cmake pkg-config spirv-cross xvfb xdotool; do need "$package"; done
                # Ubuntu's package of that name only fetches a snap, which does not start in a container. There the tests of reports
                # take any Chromium or Chrome that works, and say that they are skipped without one.
                if grep -q '^ID=debian$' /etc/os-release; then need chromium; fi
                ;;
            *) fail "unknown option $option: only --window and --test are known" ;;
        esac
        for package in libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0; do need "$package"; done
    done
    install_missing
    if ! vulkaninfo --summary >/dev/null 2>&1; then
        need mesa-vulkan-drivers
        install_missing
    fi
else
    echo "setup: no apt-get here; expecting libshaderc, glslang and SPIRV-Tools (static), a Vulkan loader and driver to be installed" >&2
fi

# Debian's libshaderc links only together with glslang's and SPIRV-Tools' archives, and the crate names one library:
# so one archive is made of all of them. Without this, shaderc is built from source (6 to 9 minutes).
archive=target/shaderc/libshaderc_combined.a
if [ ! -s "$archive" ]; then
    lib_dir=$(dirname "$(gcc -print-file-name=libshaderc_combined.a)")
    if [ "$lib_dir" != . ]; then
        mkdir -p "$(dirname "$archive")"
        {
            echo "create $PWD/$archive.part"
            for name in shaderc_combined glslang MachineIndependent GenericCodeGen OSDependent OGLCompiler SPIRV SPIRV-Tools-opt SPIRV-Tools; do
                if [ -e "$lib_dir/lib$name.a" ]; then echo "addlib $lib_dir/lib$name.a"; fi
            done
            echo save
            echo end
        } | ar -M
        mv "$archive.part" "$archive"
    fi
fi
