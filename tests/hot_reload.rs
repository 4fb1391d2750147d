//! Shaders that are replaced while a session runs.

use super::support::{assert_valid, frame, luminance_history, scene::Scene, session};
use atrous::executor::Session;
use atrous::{Config, Error, FrameConstants, Tuning};
use atrous_glsl as glsl;
use atrous_harness::DeviceTest;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

pub const TESTS: &[DeviceTest] = &[
    ("another_shader_changes_the_output_and_keeps_the_history", another_shader_changes_the_output_and_keeps_the_history),
    ("a_shader_that_does_not_fit_is_refused_and_the_old_one_stays", a_shader_that_does_not_fit_is_refused_and_the_old_one_stays),
    ("every_shader_may_take_its_own_place", every_shader_may_take_its_own_place),
    ("what_does_not_compile_is_named_by_file_and_line", what_does_not_compile_is_named_by_file_and_line),
];

const EXTENT: [u32; 2] = [66, 36];

/// A copy of the crate's GLSL.
struct Sources(TempDir);

impl Sources {
    fn new() -> Self {
        let (from, to) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl"), TempDir::new().expect("a folder"));
        for folder in ["", "include"] {
            fs::create_dir_all(to.path().join(folder)).expect("a folder");
            for entry in fs::read_dir(from.join(folder)).expect("glsl").flatten().filter(|e| e.path().is_file()) {
                fs::copy(entry.path(), to.path().join(folder).join(entry.file_name())).expect("a copy");
            }
        }
        Self(to)
    }

    fn edit(&self, file: &str, old: &str, new: &str) {
        let path = self.0.path().join(file);
        let text = fs::read_to_string(&path).expect(file);
        assert!(text.contains(old), "{file} has no `{old}`");
        fs::write(path, text.replacen(old, new, 1)).expect(file);
    }

    /// Every variant with its name.
    fn compile(&self, file: &str) -> Result<Vec<(String, Vec<u32>)>, String> {
        let compiler = glsl::Compiler::new().expect("shaderc");
        let source = glsl::Glsl::read(&self.0.path().join(file), &[self.0.path().join("include")])?;
        let compile = |v: glsl::Variant| Ok((v.name.clone(), source.compile(&compiler, &v, glsl::Detail::CodeAndNames)?));
        source.variants().into_iter().map(compile).collect()
    }
}

fn replace(session: &mut Session, (name, spirv): &(String, Vec<u32>)) -> Result<bool, Error> {
    // SAFETY: shaderc made it for Vulkan 1.1.
    unsafe { session.replace_shader(name, spirv) }
}

fn another_shader_changes_the_output_and_keeps_the_history() {
    let sources = Sources::new();
    sources.edit("modulate.comp", "outgoing(radiance", "outgoing(0.5 * radiance");
    let shaders = sources.compile("modulate.comp").expect("GLSL");
    let config = Config::new(EXTENT);
    let (mut changed, mut same) = (session(&config), session(&config));
    let scene = Scene::new(EXTENT);
    for i in 0..4 {
        if i == 2 {
            let used: Vec<_> = shaders.iter().map(|shader| replace(&mut changed, shader).expect("it fits")).collect();
            assert_eq!(used.iter().filter(|used| **used).count(), 1, "one variant of {} runs", shaders.len());
        }
        let (guides, params) = (scene.frame(i, i), scene.params(i));
        let (context, halved) = frame(&mut changed, &guides, &params, &Tuning::default());
        let (_, whole) = frame(&mut same, &guides, &params, &Tuning::default());
        assert_eq!(context.reset.is_some(), i == 0, "history is dropped in frame {i}");
        let factor = if i < 2 { 1.0 } else { 0.5 };
        // Both are rounded to half floats.
        let differs = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).any(|c| (a[c] - factor * b[c]).abs() > 1e-3 * b[c].abs() + 1e-6);
        assert!(whole.iter().any(|t| t[0] > 0.1));
        assert!(!halved.iter().zip(&whole).any(differs), "frame {i} is not {factor} times what it was");
    }
    assert_eq!(luminance_history(&mut changed, "luminance_history"), luminance_history(&mut same, "luminance_history"));
    assert_valid();
}

fn a_shader_that_does_not_fit_is_refused_and_the_old_one_stays() {
    let byte = std::mem::offset_of!(FrameConstants, render_extent);
    let moved = format!("set 0 binding 0 byte {byte} is `render_extent: vec2<i32>`, and was `render_extent: vec2<u32>`");
    let edits = [
        (
            "modulate.comp",
            "binding = DENOISED_RADIANCE, OUTGOING_FORMAT",
            "binding = 5, rgba32f",
            "set 0 binding 5 is `StorageImage2D<Rgba32f> WriteOnly`",
        ),
        ("modulate.comp", "EMISSION = 4u", "EMISSION = 10u", "set 0 binding 10 is new"),
        ("modulate.comp", "local_size_y = 4", "local_size_y = 2", "LocalSize is `32 x 2 x 1`"),
        ("modulate.comp", "uint present;", "uint other; uint present;", "push constants byte 0 is `other: u32`"),
        ("include/optional.glsl", "constant_id = 0", "constant_id = 5", "specialization constant 5 is new"),
        ("include/frame.glsl", "uvec2 render_extent", "ivec2 render_extent", &moved),
        (
            "modulate.comp",
            "void main() {",
            "void main() { double d = double(gl_GlobalInvocationID.x); if (d < -1.0) return;",
            "Float64",
        ),
        ("modulate.comp", "variants: FLOAT=0", "variants: FLOAT=2", "none of this name"),
    ];
    let config = Config::new(EXTENT);
    let (mut refused, mut same) = (session(&config), session(&config));
    let scene = Scene::new(EXTENT);
    for (file, old, new, problem) in edits {
        let sources = Sources::new();
        sources.edit(file, old, new);
        let shaders = sources.compile("modulate.comp").expect("GLSL");
        let errors: Vec<_> = shaders.iter().filter_map(|shader| replace(&mut refused, shader).err()).collect();
        assert!(!errors.is_empty(), "{new}: all of {} shaders are taken", shaders.len());
        let text = errors[0].to_string();
        assert!(matches!(errors[0], Error::ShaderInterface { .. }) && text.contains(problem), "{text}");
        assert!(text.contains("`modulate"), "{text}");
    }
    for i in 0..2 {
        let (guides, params) = (scene.frame(i, i), scene.params(i));
        let (_, a) = frame(&mut refused, &guides, &params, &Tuning::default());
        let (_, b) = frame(&mut same, &guides, &params, &Tuning::default());
        assert_eq!(a, b);
    }
}

fn every_shader_may_take_its_own_place() {
    let sources = Sources::new();
    let mut count = 0;
    for file in glsl::shaders(sources.0.path()).expect("shaders") {
        let name = file.file_name().and_then(|n| n.to_str()).expect("a name");
        for (name, spirv) in sources.compile(name).expect("GLSL") {
            atrous::hot_reload::check(&name, &spirv).expect("its own place");
            count += 1;
        }
    }
    assert!(count > 30, "{count}");
}

fn what_does_not_compile_is_named_by_file_and_line() {
    let line_of = |text: &str, what: &str| 1 + text.lines().position(|l| l.contains(what)).expect("a line");
    for (file, old) in [("modulate.comp", "vec3 radiance ="), ("include/guide.glsl", "return")] {
        let sources = Sources::new();
        sources.edit(file, old, &format!("no_such_thing(); {old}"));
        let path = sources.0.path().join(file);
        let line = line_of(&fs::read_to_string(&path).expect(file), "no_such_thing");
        let error = sources.compile("modulate.comp").expect_err("it is broken");
        assert!(error.contains(&format!("{}:{line}: error: 'no_such_thing'", path.display())), "{error}");
    }
}
