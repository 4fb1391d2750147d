//! The packages that are published, as a registry would get them.

use atrous_harness::DeviceTest;
use std::process::Command;

pub const TESTS: &[DeviceTest] = &[("every_published_package_can_be_packaged", every_published_package_can_be_packaged)];

fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

/// Names of the packages of the workspace that do not say `publish = false`.
fn published() -> Vec<String> {
    let output = cargo().args(["metadata", "--format-version", "1", "--no-deps", "--offline"]).output().expect("cargo");
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("metadata");
    let packages = metadata["packages"].as_array().expect("packages").iter().filter(|package| package["publish"].is_null());
    packages.map(|package| package["name"].as_str().expect("a name").to_owned()).collect()
}

/// Without a build of each: what is packaged here is compiled by the other tests. A dependency without a version, or on a package that
/// is not published, is what this finds.
fn every_published_package_can_be_packaged() {
    let names = published();
    assert!(["atrous", "atrous-wgpu", "atrous-capi"].iter().all(|name| names.iter().any(|n| n == name)), "{names:?}");
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = cargo();
    command.args(["package", "--no-verify", "--allow-dirty", "--offline", "--target-dir"]).arg(folder.path());
    let output = command.args(names.iter().flat_map(|name| ["--package", name])).output().expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for name in names {
        let file = folder.path().join("package").join(format!("{name}-{}.crate", env!("CARGO_PKG_VERSION")));
        assert!(file.is_file(), "{} is missing", file.display());
    }
}
