#!/usr/bin/env bash
# Stands in for rustdoc under `cargo test --doc`: makes the pages of each library instead of running its examples. The libraries that
# the tests linked serve them as well, whereas `cargo doc` would check every dependency anew.
set -euo pipefail
arguments=()
while [ $# -gt 0 ]; do
    case $1 in
        --test) ;;
        --test-run-directory | --test-args) shift ;;
        *) arguments+=("$1") ;;
    esac
    shift
done
exec rustdoc "${arguments[@]}" --out-dir target/doc
