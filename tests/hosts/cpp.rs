//! The C++ host: built by its own script, once plainly on the static library, and once with AddressSanitizer on the shared one.

use super::{checksums, of_executor, validated};
use crate::support::{examples, session, soak};
use atrous::{Choice, Config, DebugView, FrameParams, Tuning, UseFrame};
use atrous_synthetic as synthetic;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::OnceLock;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn build(name: &str, source: &str, crate_type: &str, flags: &[&str]) -> PathBuf {
    let program = root().join("target").join(name);
    let mut script = Command::new(root().join("examples/host_cpp/build.sh"));
    // The library is built once more for it: that takes half as long if it is not optimised.
    script.env("SOURCE", source).env("CRATE_TYPE", crate_type).env("CARGO_PROFILE_DEV_OPT_LEVEL", "0");
    let output = script.arg(&program).args(flags).output().expect("build.sh");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success(),
        "examples/host_cpp/build.sh (it needs g++ and libvulkan-dev: scripts/setup.sh --test):\n{text}"
    );
    program
}

fn run(program: PathBuf, arguments: &[&str]) -> Output {
    // Leaks are the drivers', which live in shared libraries without symbols.
    validated(Command::new(program).args(arguments).env("ASAN_OPTIONS", "detect_leaks=0")).output().expect("the C++ host")
}

pub fn cpp_gives_the_bits_of_the_executor() {
    assert_eq!(checksums("host_cpp", &run(build("host_cpp", "main.cpp", "staticlib", &[]), &[])), of_executor());
}

/// The host knows no struct and no function but those of the first header, and runs with the library of today.
pub fn a_host_of_the_first_header_gives_the_bits_of_the_executor() {
    let folders = ["crates/capi/tests/first", "examples/host_cpp"].map(|folder| format!("-I{}", root().join(folder).display()));
    let old = build("host_cpp_first", "../../crates/capi/tests/first/host.cpp", "cdylib", &[&folders[0], &folders[1]]);
    assert_eq!(checksums("host_cpp_first", &run(old, &[])), of_executor());
}

/// One call a frame, under AddressSanitizer and UndefinedBehaviorSanitizer.
fn one_call() -> PathBuf {
    static ONE_CALL: OnceLock<PathBuf> = OnceLock::new();
    let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    ONE_CALL.get_or_init(|| build("host_cpp_one_call", "one_call.cpp", "cdylib", &flags)).clone()
}

pub fn cpp_with_an_executor_gives_the_bits_of_the_executor() {
    let output = run(one_call(), &[]);
    assert_eq!(checksums("host_cpp_one_call", &output), of_executor());
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let kept = text.split("history kept by ").nth(1).and_then(|rest| rest.split(' ').next()).and_then(|n| n.parse::<u32>().ok());
    assert!(kept.is_some_and(|kept| kept > 1000), "most surfaces keep their history: {text}");
}

pub fn cpp_captures_inputs_and_draws_views() {
    let folder = root().join("target/host_cpp_capture");
    let _ = std::fs::remove_dir_all(&folder);
    let output = run(one_call(), &[&folder.display().to_string()]);
    assert_eq!(checksums("host_cpp_one_call", &output), of_executor(), "a view changes no picture");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("4 frames captured"), "{text}");
    for file in ["sequence.json", "frame_0000.exr", "frame_0003.exr"] {
        assert!(folder.join(file).is_file(), "{file} in {}", folder.display());
    }
    for view in [DebugView::Depth, DebugView::Normal] {
        // In C 0 is none.
        let line = format!("view {} {}", view.number() + 1, of_view(view));
        assert!(text.lines().any(|l| l == line), "no \"{line}\" in {text}");
    }
}

/// The executor itself compares the guides of the first frames with the conventions.
pub fn cpp_is_told_of_wrong_guides_by_the_executor() {
    let told = |arguments: &[&str]| {
        let output = run(one_call(), arguments);
        assert!(output.status.success());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let text = told(&["--wrong-motion"]);
    assert_eq!(text.matches("are not as declared").count(), 1, "once: {text}");
    assert!(text.contains("MISTAKE: the motion has the opposite sign"), "{text}");
    assert!(!told(&[]).contains("are not as declared"));
}

/// The checksum of a view of the frame behind the last one that is compared.
fn of_view(view: DebugView) -> String {
    let mut s = session(&Config { debug_view: true, ..Config::new(synthetic::EXTENT) });
    super::executor_frames(&mut s);
    super::upload(&mut s, synthetic::FRAMES);
    s.run(&FrameParams { debug_view: Some(view), ..super::params(synthetic::FRAMES) }, &Tuning::default()).expect("frame");
    let image = s.download_bytes("debug_view", UseFrame::Current).expect("debug_view");
    synthetic::report(0, &image).rsplit(' ').next().unwrap_or_default().to_owned()
}

/// A graph of the host's own with a compute shader of its own, built by C99 and by C++17, under the same.
pub fn graphs_of_c_and_cpp_give_the_bits_of_that_of_rust() {
    let spirv = examples::compile(examples::MEAN_3X3);
    let (words, object) = (root().join("target/mean_3x3.spv"), root().join("target/host_c_custom_graph.o"));
    std::fs::write(&words, spirv.iter().flat_map(|word| word.to_ne_bytes()).collect::<Vec<_>>()).expect("a file");
    let sanitizers = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    compile_c99("custom_graph.c", &object, &["-c"]);
    let flags = [sanitizers[0], sanitizers[1], &object.display().to_string()];
    let program = build("host_cpp_custom_graph", "custom_graph.cpp", "cdylib", &flags);
    let words = words.display().to_string();
    for arguments in [&[words.as_str()][..], &[words.as_str(), "c"]] {
        let output = run(program.clone(), arguments);
        assert_eq!(checksums("host_cpp_custom_graph", &output), super::of_example("custom_graph"), "{arguments:?}");
    }
}

/// Compiles a program of examples/host_c, with all warnings and sanitizers.
fn compile_c99(source: &str, output: &std::path::Path, more: &[&str]) {
    let mut compiler = Command::new("gcc");
    compiler.args(["-std=c99", "-O1", "-g", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]);
    compiler.args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-I"]).arg(root().join("crates/capi/include"));
    compiler.arg(root().join("examples/host_c").join(source)).args(more).arg("-o").arg(output);
    let built = compiler.output().expect("gcc");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
}

/// The record path with a tracker, under the same.
pub fn cpp_gives_the_bits_of_the_executor_under_sanitizers() {
    let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let output = run(build("host_cpp_sanitized", "main.cpp", "cdylib", &flags), &[]);
    assert_eq!(checksums("host_cpp_sanitized", &output), of_executor());
}

/// The host submits the command buffers that it recorded once, and the denoiser's between them, phase by phase.
pub fn prerecorded_command_buffers_give_the_bits_of_the_executor() {
    let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let output = run(build("host_cpp_prerecorded", "prerecorded.cpp", "cdylib", &flags), &[]);
    assert_eq!(checksums("host_cpp_prerecorded", &output), of_executor());
    println!("{}", String::from_utf8_lossy(&output.stdout).lines().last().unwrap_or_default());
}

/// Four threads record the passes of a frame side by side.
pub fn four_threads_give_the_bits_of_the_executor() {
    let output = run(build("host_cpp_threads", "threads.cpp", "cdylib", &["-fsanitize=address"]), &[]);
    assert_eq!(checksums("host_cpp_threads", &output), of_executor());
}

/// The header is one of C99, without a warning. The program itself compares its picture with the light that it gave.
pub fn a_c99_program_denoises_in_one_call() {
    let _library = one_call();
    let (program, library) = (root().join("target/host_c"), root().join("target/debug"));
    let more = [library.join("libatrous_capi.so").display().to_string(), format!("-Wl,-rpath,{}", library.display())];
    compile_c99("main.c", &program, &[&more[0], &more[1], "-lvulkan", "-lm"]);
    let output = run(program, &[]);
    assert!(checksums("host_c", &output).is_empty());
    assert!(String::from_utf8_lossy(&output.stdout).contains("differs from the light by at most"));
}

/// All that a host can get wrong, with AddressSanitizer.
fn hostile() -> PathBuf {
    static HOSTILE: OnceLock<PathBuf> = OnceLock::new();
    HOSTILE.get_or_init(|| build("host_cpp_hostile", "hostile.cpp", "cdylib", &["-fsanitize=address"])).clone()
}

pub fn cpp_is_told_of_wrong_conventions() {
    let output = run(hostile(), &["--check"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && text.contains("motion: MISTAKE: the motion has the opposite sign"), "{text}");
}

pub fn the_c_abi_refuses_bad_input_under_address_sanitizer() {
    for arguments in [&[][..], &["--random-input", &soak::times(8000).to_string()]] {
        let output = run(hostile(), arguments);
        assert!(checksums("host_cpp_hostile", &output).is_empty());
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(text.contains(" 0 wrong answers"), "{text}");
        println!("{}", text.trim());
    }
}
