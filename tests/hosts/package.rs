//! The installed library: the C++ host is built from it by CMake and by pkg-config, outside the workspace.

use super::{checksums, of_executor, validated};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// What a command prints; fails where it does.
fn output_of(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error} (scripts/setup.sh --test installs it)"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{command:?}:\n{}{}", text(&output.stdout), text(&output.stderr));
    text(&output.stdout)
}

/// The folder that the library is installed in.
fn installed() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let prefix = root().join("target/package_installed");
        let _ = std::fs::remove_dir_all(&prefix);
        // Compiled as for the other tests of C, which takes half as long as an optimised library.
        let mut script = Command::new(root().join("scripts/install.sh"));
        script.env("PROFILE", "dev").env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").arg("--prefix").arg(&prefix);
        let sizes = output_of(&mut script);
        assert!(sizes.contains("libatrous.a: ") && sizes.contains(" KiB"), "{sizes}");
        prefix
    })
}

fn assert_bits_of_executor(program: &Path) {
    let output = validated(Command::new(program).env("LD_LIBRARY_PATH", installed().join("lib"))).output().expect("the host");
    assert_eq!(checksums(&program.display().to_string(), &output), of_executor());
}

pub fn cmake_finds_the_installed_library() {
    for (library, is_static) in [("shared", "OFF"), ("static", "ON")] {
        let build = root().join(format!("target/package_cmake_{library}"));
        let _ = std::fs::remove_dir_all(&build);
        let prefix = format!("-DCMAKE_PREFIX_PATH={}", installed().display());
        let mut configure = Command::new("cmake");
        configure.arg("-S").arg(root().join("examples/host_cpp")).arg("-B").arg(&build);
        output_of(configure.args([prefix, format!("-DATROUS_STATIC={is_static}")]));
        output_of(Command::new("cmake").arg("--build").arg(&build));
        assert_bits_of_executor(&build.join("host_cpp"));
    }
}

pub fn pkg_config_finds_the_installed_library() {
    let mut pkg_config = Command::new("pkg-config");
    pkg_config.env("PKG_CONFIG_PATH", installed().join("lib/pkgconfig"));
    let flags = output_of(pkg_config.args(["--cflags", "--libs", "atrous >= 0.1"]));
    let program = root().join("target/package_pkg_config");
    let mut compiler = Command::new("g++");
    compiler.args(["-std=c++17", "-O1", "-ffp-contract=off"]).arg(root().join("examples/host_cpp/main.cpp"));
    output_of(compiler.args(flags.split_whitespace()).args(["-lvulkan", "-o"]).arg(&program));
    assert_bits_of_executor(&program);
}

/// A symbol of Rust's runtime, such as `rust_eh_personality`, would collide with that of a Rust library by a different compiler.
pub fn the_installed_libraries_show_nothing_of_rust() {
    let lib = installed().join("lib");
    for (option, name) in [("-g", "libatrous.a"), ("-D", "libatrous.so")] {
        let symbols = output_of(Command::new("nm").args([option, "--defined-only"]).arg(lib.join(name)));
        let names: Vec<_> = symbols.lines().filter_map(|line| line.split_whitespace().nth(2)).collect();
        assert!(names.contains(&"atrous_record") && names.contains(&"atrous_version"), "{name}: {names:?}");
        let strange: Vec<_> = names.iter().filter(|symbol| !symbol.starts_with("atrous_")).collect();
        assert!(strange.is_empty(), "{name} shows {strange:?}");
    }
    let dynamic = output_of(Command::new("readelf").arg("-d").arg(lib.join("libatrous.so")));
    assert!(dynamic.contains("Library soname: [libatrous.so.0]"), "{dynamic}");
}
