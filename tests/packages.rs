//! The packages that are published, as a registry would get them.

use atrous_harness::DeviceTest;
use std::process::Command;

pub const TESTS: &[DeviceTest] = &[
    ("every_published_package_can_be_packaged", every_published_package_can_be_packaged),
    ("what_users_search_for_is_found_by_keywords", what_users_search_for_is_found_by_keywords),
    ("every_dependency_has_a_licence_that_is_allowed", every_dependency_has_a_licence_that_is_allowed),
];

fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

/// The packages of the workspace that do not say `publish = false`.
fn published() -> Vec<serde_json::Value> {
    let output = cargo().args(["metadata", "--format-version", "1", "--no-deps", "--offline"]).output().expect("cargo");
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("metadata");
    let packages = metadata["packages"].as_array().expect("packages").iter();
    packages.filter(|package| package["publish"].is_null()).cloned().collect()
}

fn name(package: &serde_json::Value) -> String {
    package["name"].as_str().expect("a name").to_owned()
}

/// Packages that a user asks a registry for; the others are parts of them.
const FOUND_BY_SEARCH: [&str; 5] = ["atrous", "atrous-capi", "atrous-conventions", "atrous-denoise", "atrous-wgpu"];

/// As crates.io takes them: at most five keywords of at most twenty letters, and at most five categories.
fn what_users_search_for_is_found_by_keywords() {
    let packages = published();
    for of in FOUND_BY_SEARCH {
        let package = packages.iter().find(|package| name(package) == of).unwrap_or_else(|| panic!("{of} is not published"));
        let words = |field: &str| -> Vec<String> { serde_json::from_value(package[field].clone()).expect(field) };
        let (keywords, categories) = (words("keywords"), words("categories"));
        assert!((3..=5).contains(&keywords.len()) && keywords.iter().all(|k| k.len() <= 20), "{of}: {keywords:?}");
        assert!(keywords.contains(&"denoiser".to_owned()), "{of}: {keywords:?}");
        assert!((1..=5).contains(&categories.len()), "{of}: {categories:?}");
    }
    assert_eq!(packages.iter().find(|package| name(package) == "atrous").expect("atrous")["readme"], "README.md");
}

/// Without a build of each: what is packaged here is compiled by the other tests. A dependency without a version, or on a package that
/// is not published, is what this finds.
fn every_published_package_can_be_packaged() {
    let names: Vec<String> = published().iter().map(name).collect();
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

/// Quoted words of a line.
fn quoted(line: &str) -> Vec<&str> {
    line.split('"').skip(1).step_by(2).collect()
}

/// Whether a licence expression of SPDX is met by the licences that `allowed` says are. `/` is what `OR` was once.
fn is_met(expression: &str, allowed: &dyn Fn(&str) -> bool) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let tokens: Vec<&str> = spaced.split_whitespace().collect();
    let mut at = 0;
    let met = any_of(&tokens, &mut at, allowed);
    assert_eq!(at, tokens.len(), "{expression} cannot be read");
    met
}

fn any_of(tokens: &[&str], at: &mut usize, allowed: &dyn Fn(&str) -> bool) -> bool {
    let mut met = all_of(tokens, at, allowed);
    while tokens.get(*at) == Some(&"OR") {
        *at += 1;
        met |= all_of(tokens, at, allowed);
    }
    met
}

fn all_of(tokens: &[&str], at: &mut usize, allowed: &dyn Fn(&str) -> bool) -> bool {
    let mut met = one(tokens, at, allowed);
    while tokens.get(*at) == Some(&"AND") {
        *at += 1;
        met &= one(tokens, at, allowed);
    }
    met
}

fn one(tokens: &[&str], at: &mut usize, allowed: &dyn Fn(&str) -> bool) -> bool {
    let token = tokens.get(*at).copied().unwrap_or_default();
    *at += 1;
    if token == "(" {
        let met = any_of(tokens, at, allowed);
        *at += 1;
        return met;
    }
    // An exception only gives more than the licence does.
    if tokens.get(*at) == Some(&"WITH") {
        *at += 2;
    }
    allowed(token)
}

/// What `cargo deny check licenses` asks, by the same file, of what is built here.
fn every_dependency_has_a_licence_that_is_allowed() {
    let rules = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/deny.toml")).expect("deny.toml");
    let general: Vec<_> = rules.lines().filter(|line| line.starts_with("allow = [")).flat_map(quoted).collect();
    let exceptions: Vec<_> =
        rules.lines().filter(|line| line.contains("{ crate =") && line.contains("allow =")).map(quoted).collect();
    assert!(general.contains(&"MIT") && !exceptions.is_empty(), "deny.toml is written otherwise: {general:?}");
    let host = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
    let mut command = cargo();
    command.args(["metadata", "--format-version", "1", "--offline", "--filter-platform", &host]);
    let output = command.args(["--features", "capture,window,hot-reload"]).output().expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("metadata");
    let mut refused = Vec::new();
    for package in metadata["packages"].as_array().expect("packages") {
        let name = package["name"].as_str().expect("a name");
        let allowed = |licence: &str| {
            general.contains(&licence) || exceptions.iter().any(|words| words[0] == name && words[1..].contains(&licence))
        };
        match package["license"].as_str() {
            Some(licence) if is_met(licence, &allowed) => {}
            licence => refused.push(format!("{name}: {licence:?}")),
        }
    }
    assert!(refused.is_empty(), "deny.toml does not allow these licences; see [licenses] there: {refused:?}");
    assert!(is_met("(MIT OR X) AND ISC", &|l| ["MIT", "ISC"].contains(&l)) && !is_met("MIT AND X", &|l| l == "MIT"));
}
