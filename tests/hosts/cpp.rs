//! The C++ host: built by its own script, once plainly and once with AddressSanitizer.

use super::{checksums, of_executor, validated};
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::OnceLock;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn build(name: &str, flags: &[&str]) -> PathBuf {
    let program = root().join("target").join(name);
    let output = Command::new(root().join("examples/host_cpp/build.sh")).arg(&program).args(flags).output().expect("build.sh");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success(),
        "examples/host_cpp/build.sh (it needs g++ and libvulkan-dev: scripts/setup.sh --test):\n{text}"
    );
    program
}

fn plain() -> PathBuf {
    static PLAIN: OnceLock<PathBuf> = OnceLock::new();
    PLAIN.get_or_init(|| build("host_cpp", &[])).clone()
}

fn run(program: PathBuf, arguments: &[&str]) -> Output {
    // Leaks are the drivers', which live in shared libraries without symbols.
    validated(Command::new(program).args(arguments).env("ASAN_OPTIONS", "detect_leaks=0")).output().expect("the C++ host")
}

pub fn cpp_gives_the_bits_of_the_executor() {
    assert_eq!(checksums("host_cpp", &run(plain(), &[])), of_executor());
}

pub fn the_c_abi_refuses_bad_input_under_address_sanitizer() {
    let sanitized = build("host_cpp_asan", &["-fsanitize=address"]);
    let output = run(sanitized.clone(), &["--bad-input"]);
    assert!(checksums("host_cpp --bad-input", &output).is_empty());
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains(" 0 wrong answers"), "{text}");
    println!("{}", text.trim());
    assert_eq!(checksums("host_cpp_asan", &run(sanitized, &[])), of_executor());
}
