//! Saved shaders, from the file to the pipeline.

use std::path::{Path, PathBuf};

use atrous::config::Preset;
use atrous::reference::unpack_luminance_history;
use atrous_engine::hot_reload::{Compiled, OtherShaders, Owner, Recompiled, ShaderFolders, ShaderWatch, Stale};
use atrous_engine::testing::{built_in, tracer, Validated};
use atrous_engine::{DenoiserOptions, FrameDenoiser, PathTracer, SceneOptions, TracerOptions};

/// A copy of the GLSL, and its watch.
struct Sources {
    folder: PathBuf,
    watch: ShaderWatch,
}

impl Drop for Sources {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

impl Sources {
    fn new(name: &str) -> Self {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("shaders-{name}-{}", std::process::id()));
        let built = ShaderFolders::of_the_build();
        let folders = ShaderFolders {
            denoiser: folder.join("glsl"),
            engine: folder.join("demo/glsl"),
            others: vec![OtherShaders { folder: folder.join("program/glsl"), built: atrous_engine::tracer::shaders::ALL }],
        };
        std::fs::create_dir_all(&folders.others[0].folder).expect("a folder");
        std::fs::copy(built.engine.join("lamp.comp"), folders.others[0].folder.join("lamp.comp")).expect("a copy");
        for (from, to) in [(&built.denoiser, &folders.denoiser), (&built.engine, &folders.engine)] {
            for part in ["", "include", "host"] {
                copy(&from.join(part), &to.join(part));
            }
        }
        Self { watch: ShaderWatch::new(&folders).expect("the folders are there"), folder }
    }

    /// Saves as an editor does that writes a new file and renames it.
    fn edit(&self, file: &str, old: &str, new: &str) {
        let path = self.folder.join(file);
        let text = std::fs::read_to_string(&path).expect(file);
        assert!(text.contains(old), "{file} has no `{old}`");
        let written = path.with_extension("new");
        std::fs::write(&written, text.replacen(old, new, 1)).expect(file);
        std::fs::rename(&written, &path).expect(file);
    }

    fn line_of(&self, file: &str, what: &str) -> usize {
        let text = std::fs::read_to_string(self.folder.join(file)).expect(file);
        1 + text.lines().position(|line| line.contains(what)).expect(what)
    }

    /// What the watch gives for all that was saved; the first look sees it, the second that it rests.
    fn saved(&mut self) -> Vec<Recompiled> {
        assert!(self.watch.poll().is_empty(), "a save may go on");
        let recompiled = self.watch.poll().iter().map(Stale::recompile).collect();
        assert!(self.watch.poll().is_empty(), "once for each save");
        recompiled
    }

    fn saved_one(&mut self) -> Recompiled {
        let mut all = self.saved();
        let files: Vec<_> = all.iter().map(|r| &r.file).collect();
        assert_eq!(all.len(), 1, "{files:?}");
        all.remove(0)
    }
}

fn copy(from: &Path, to: &Path) {
    let Ok(entries) = std::fs::read_dir(from) else { return };
    std::fs::create_dir_all(to).expect("a folder");
    for path in entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()) {
        std::fs::copy(&path, to.join(path.file_name().expect("a name"))).expect("a copy");
    }
}

fn shaders(recompiled: Recompiled) -> Vec<Compiled> {
    recompiled.shaders.unwrap_or_else(|problem| panic!("{}: {problem}", recompiled.file))
}

#[test]
fn what_is_saved_is_compiled_and_what_is_wrong_has_file_and_line() {
    let mut sources = Sources::new("saved");
    assert!(sources.watch.poll().is_empty() && sources.watch.poll().is_empty(), "nothing was saved");

    sources.edit("glsl/modulate.comp", "outgoing(radiance", "outgoing(0.5 * radiance");
    let changed = sources.saved_one();
    assert_eq!(changed.file, "glsl/modulate.comp");
    let names: Vec<_> = shaders(changed).iter().map(|s| (s.name().to_owned(), s.owner())).collect();
    let expected = ["modulate_float_0", "modulate_float_1", "modulate_float_0_upsampled_1", "modulate_float_1_upsampled_1"];
    assert_eq!(names, expected.map(|name| (name.to_owned(), Owner::Denoiser)));

    sources.edit("glsl/modulate.comp", "outgoing(0.5", "outgoing(no_such_thing");
    let line = sources.line_of("glsl/modulate.comp", "no_such_thing");
    let problem = sources.saved_one().shaders.expect_err("it is broken");
    assert!(problem.starts_with(&format!("glsl/modulate.comp:{line}: error: 'no_such_thing'")), "{problem}");

    sources.edit("glsl/modulate.comp", "outgoing(no_such_thing", "outgoing(2.0");
    assert_eq!(shaders(sources.saved_one()).len(), 4);

    sources.edit("glsl/eaw.comp", "void main", "\nvoid main");
    let variants: Vec<_> = shaders(sources.saved_one()).iter().map(|s| s.name().to_owned()).collect();
    assert_eq!(variants, ["eaw_signals_1", "eaw_signals_2"]);
}

#[test]
fn an_include_is_compiled_with_all_that_include_it() {
    let mut sources = Sources::new("include");
    sources.edit("demo/glsl/include/medium.glsl", "#ifndef", "no_such_thing;\n#ifndef");
    let line = sources.line_of("demo/glsl/include/medium.glsl", "no_such_thing");
    let broken = sources.saved();
    let files: Vec<_> = broken.iter().map(|r| r.file.as_str()).collect();
    assert!(files.contains(&"glsl/volume.comp") && files.contains(&"glsl/volume_reference.comp"), "{files:?}");
    for recompiled in broken {
        let problem = recompiled.shaders.expect_err("it is broken");
        assert!(problem.starts_with(&format!("glsl/include/medium.glsl:{line}: error:")), "{}: {problem}", recompiled.file);
    }
    sources.edit("demo/glsl/include/medium.glsl", "no_such_thing;\n", "");
    assert!(sources.saved().into_iter().all(|r| !shaders(r).is_empty()));

    sources.edit("glsl/host/gradient_sample.glsl", "#ifndef", "\n#ifndef");
    assert!(sources.saved().iter().any(|r| r.file == "glsl/path_trace_reshaded.comp"), "the engine includes it");
    sources.edit("program/glsl/lamp.comp", "void main", "\nvoid main");
    let of_program = sources.saved_one();
    assert_eq!(of_program.file, "glsl/lamp.comp", "a program around the engine has shaders of its own");
    assert_eq!(shaders(of_program).len(), 1);
}

#[test]
fn what_the_program_was_not_built_for_is_refused() {
    let mut sources = Sources::new("refused");
    for (file, old, new, difference) in [
        (
            "glsl/modulate.comp",
            "binding = DENOISED_RADIANCE, OUTGOING_FORMAT",
            "binding = DENOISED_RADIANCE, rgba32f",
            "set 0 binding 5 is `StorageImage2D<Rgba32f>",
        ),
        ("demo/glsl/lamp.comp", "local_size_x = 8", "local_size_x = 4", "LocalSize is `4 x 8 x 1`"),
        ("glsl/eaw.comp", "SIGNALS=2", "SIGNALS=3", "`eaw_signals_3`: the program has none"),
    ] {
        sources.edit(file, old, new);
        let problem = sources.saved_one().shaders.expect_err("it does not fit");
        assert!(problem.contains(difference) && problem.contains("build it again"), "{problem}");
        sources.edit(file, new, old);
        shaders(sources.saved_one());
    }
}

#[test]
fn every_shader_may_be_saved_as_it_is() {
    let mut sources = Sources::new("unchanged");
    for (folder, include) in [("glsl", "frame.glsl"), ("demo/glsl", "scene.glsl")] {
        sources.edit(&format!("{folder}/include/{include}"), "#ifndef", "\n#ifndef");
    }
    let recompiled = sources.saved();
    assert!(recompiled.len() > 20, "{}", recompiled.len());
    assert!(recompiled.into_iter().map(shaders).all(|shaders| !shaders.is_empty()));
}

/// The pipelines of the tracer, of the denoiser and of the tracer for the denoiser.
#[test]
fn pipelines_are_replaced_between_frames_and_the_history_goes_on() {
    let Some(gpu) = Validated::new() else { return };
    let mut sources = Sources::new("pipelines");
    let mut tracer = tracer(&gpu, &built_in("cornell", SceneOptions::default()), TracerOptions::default());
    let mut denoiser = FrameDenoiser::new(&gpu.0, &tracer, &DenoiserOptions::new(Preset::Asvgf)).expect("a denoiser");
    let frame = |tracer: &mut PathTracer, denoiser: &mut FrameDenoiser, index: u32| {
        tracer.begin_frame(index).expect("a frame");
        denoiser.render(tracer).expect("a frame");
        let mean = |texels: &[[f32; 4]]| texels.iter().map(|t| t[1]).sum::<f32>() / texels.len() as f32;
        let history = denoiser.read_bytes("luminance_history").expect("luminance_history");
        let words = history.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
        let longest = words.map(|word| unpack_luminance_history(word).history_length).fold(0.0, f32::max);
        (mean(&denoiser.read("denoised_radiance").expect("an image")), longest)
    };
    frame(&mut tracer, &mut denoiser, 0);
    let (before, _) = frame(&mut tracer, &mut denoiser, 1);

    sources.edit("glsl/modulate.comp", "outgoing(radiance", "outgoing(4.0 * radiance");
    let taken = shaders(sources.saved_one()).iter().filter(|s| denoiser.replace_shader(s).expect("it fits")).count();
    assert_eq!(taken, 1);
    let (brighter, longest) = frame(&mut tracer, &mut denoiser, 2);
    assert!(brighter > 1.5 * before, "{before} {brighter}");
    assert!(longest >= 3.0, "history is {longest} frames long");

    let scattered = |tracer: &PathTracer| gpu.0.read_image(&tracer.outputs().scattered).expect("an image");
    assert!(scattered(&tracer).iter().any(|t| t[0] > 0.1));
    let lit = "lighting.direct * seen, lighting.indirect * seen, lighting.specular * seen";
    sources.edit("demo/glsl/include/path.glsl", lit, "vec3(0.0), vec3(0.0), vec3(0.0)");
    let dark: Vec<_> = sources.saved().into_iter().flat_map(shaders).collect();
    let mut of_denoiser = 0;
    for shader in &dark {
        let (of_tracer, again) =
            (tracer.replace_shader(shader).expect("it fits"), denoiser.replace_shader(shader).expect("it fits"));
        assert_eq!((of_tracer, again), (shader.name() == "path_trace", shader.name() == "path_trace_reshaded"));
        of_denoiser += usize::from(again);
    }
    assert_eq!((dark.len(), of_denoiser), (5, 1));
    frame(&mut tracer, &mut denoiser, 3);
    assert!(scattered(&tracer).iter().all(|t| t[0] == 0.0), "it still scatters light");
}
