//! Channels of known renderers are found; missing ones are reported.

use crate::samples::{self, Sample, Type};
use atrous::config::{DepthEncoding, MotionDepth, RoughnessEncoding, Sampling, Signals};
use atrous_denoise::error::ToolError;
use atrous_denoise::first_look;
use atrous_denoise::frame;
use atrous_denoise::frame_files;
use atrous_denoise::layouts::Layout;
use atrous_denoise::loader::Loader;
use atrous_denoise::roles::Role;
use atrous_denoise::sampling::Pattern;
use atrous_denoise::setup::{Options, Setup};
use std::path::Path;

fn setup_of(sample: &Sample, options: &Options) -> (tempfile::TempDir, Result<Setup, ToolError>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    sample.write(&folder.path().join("f_0001.exr"));
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("a frame");
    let setup = Setup::new(&frames, options);
    (folder, setup)
}

fn good(sample: &Sample) -> (tempfile::TempDir, Setup, frame::FrameInputs) {
    let (folder, setup) = setup_of(sample, &Options::default());
    let setup = setup.expect("a layout");
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("a frame");
    let inputs = frame::load(&frames[0], &setup).expect("a frame");
    (folder, setup, inputs)
}

fn names(setup: &Setup, role: Role) -> String {
    setup.mapping.roles.get(&role).map(|n| n.join(" ")).unwrap_or_default()
}

#[test]
fn every_role_has_a_row() {
    for role in Role::all() {
        assert_eq!(Role::by_name(role.name()), Some(role));
    }
}

#[test]
fn own_data_sets() {
    let (_folder, setup, inputs) = good(&samples::frame(1));
    assert_eq!(setup.mapping.layout, Layout::Atrous);
    assert_eq!(setup.config.signals, Signals::Apart);
    assert!(setup.config.surface_id);
    assert_eq!(setup.config.conventions.motion_depth, MotionDepth::Absolute);
    assert_eq!(inputs.images["motion"][0], [0.0, 0.0, 2.0, 0.0]);
    assert_eq!(inputs.surface_id.map(|ids| ids[5]), Some(1));
    assert!(!setup.report.iter().any(|l| l.contains("no ")), "{:?}", setup.report);
}

#[test]
fn a_share_of_the_pixels_keeps_its_samples_and_all_guides() {
    let options = Options { keep_samples: Some(Pattern::Checkerboard), ..Options::default() };
    let (folder, setup) = setup_of(&samples::frame(1), &options);
    let setup = setup.expect("a layout");
    assert_eq!(setup.config.sampling, Sampling::OneOf2x2);
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("a frame");
    let inputs = frame::load(&frames[0], &setup).expect("a frame");
    for name in ["noisy_direct", "noisy_indirect"] {
        let kept: Vec<bool> = inputs.images[name][..samples::WIDTH].iter().map(|t| t[0].is_finite()).collect();
        assert!(kept.windows(2).all(|pair| pair[0] != pair[1]), "{name}: {kept:?}");
    }
    assert!(inputs.images["albedo"].iter().chain(&inputs.images["depth"]).flatten().all(|v| v.is_finite()));
}

#[test]
fn an_albedo_that_is_not_finite_is_left_to_the_filter() {
    let mut sample = samples::frame(1);
    let green = sample.channels.iter_mut().find(|channel| channel.0 == "albedo.G").expect("an albedo");
    green.2 = Box::new(|x, y| if (x, y) == (4, 0) { f32::NAN } else { 0.5 });
    let (folder, setup) = setup_of(&sample, &Options::default());
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("a frame");
    let inputs = frame::load(&frames[0], &setup.expect("a layout")).expect("a frame");
    let albedo = &inputs.images["albedo"];
    assert!(albedo[4].iter().all(|v| v.is_nan()), "{:?}", albedo[4]);
    assert!(albedo[..4].iter().chain(&albedo[5..]).flatten().all(|v| v.is_finite()));
}

#[test]
fn blender() {
    let half = Type::Half;
    let sample = Sample::new(8, 6)
        .flat("ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B", half, 1.0)
        .flat("ViewLayer.Combined.A", half, 0.5)
        .channel("ViewLayer.Depth.Z", Type::Float, |x, _| if x == 0 { 1e10 } else { 3.0 })
        .flat("ViewLayer.Normal.X ViewLayer.Normal.Y", Type::Float, 0.0)
        .flat("ViewLayer.Normal.Z", Type::Float, 1.0)
        .flat("ViewLayer.Vector.X ViewLayer.Vector.Y", Type::Float, 2.0)
        .flat("ViewLayer.Vector.Z ViewLayer.Vector.W", Type::Float, 9.0)
        .flat("ViewLayer.DiffCol.R ViewLayer.DiffCol.G ViewLayer.DiffCol.B", half, 0.5)
        .flat("ViewLayer.DiffDir.R ViewLayer.DiffDir.G ViewLayer.DiffDir.B", half, 0.5)
        .flat("ViewLayer.DiffInd.R ViewLayer.DiffInd.G ViewLayer.DiffInd.B", half, 0.25)
        .flat("ViewLayer.Emit.R ViewLayer.Emit.G ViewLayer.Emit.B", half, 0.125)
        .flat("ViewLayer.Env.R ViewLayer.Env.G ViewLayer.Env.B", half, 0.125)
        .flat("ViewLayer.IndexOB.X", Type::Float, 0.0)
        .flat("ViewLayer_2.Combined.R ViewLayer_2.Combined.G ViewLayer_2.Combined.B", half, 7.0);
    let (_folder, setup, inputs) = good(&sample);
    assert_eq!(setup.mapping.layout, Layout::Blender);
    assert_eq!(names(&setup, Role::Noisy), "ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B");
    assert_eq!(names(&setup, Role::Motion), "ViewLayer.Vector.X ViewLayer.Vector.Y");
    assert_eq!(names(&setup, Role::Alpha), "ViewLayer.Combined.A");
    assert_eq!(names(&setup, Role::Albedo), "ViewLayer.DiffCol.R ViewLayer.DiffCol.G ViewLayer.DiffCol.B");
    assert!(setup.config.conventions.motion_y_up);
    // Combined 1 = emission 0.25 + direct 0.5·0.5 + the rest.
    assert_eq!(setup.config.signals, Signals::Apart);
    assert_eq!(inputs.images["emission"][1][0], 0.25);
    assert_eq!(inputs.images["noisy_direct"][1][0], 0.25);
    assert_eq!(inputs.images["noisy_indirect"][1][0], 0.5);
    // Objects without a pass index have 0, as the sky has.
    let ids = inputs.surface_id.expect("ids");
    assert_eq!((ids[0], ids[1]), (0, 1));
}

/// The glossy passes are specular light: what is left of the picture is diffuse.
#[test]
fn blender_with_glossy_passes() {
    let half = Type::Half;
    let sample = Sample::new(8, 6)
        .flat("ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B", half, 1.0)
        .flat("ViewLayer.Depth.Z", Type::Float, 3.0)
        .flat("ViewLayer.DiffCol.R ViewLayer.DiffCol.G ViewLayer.DiffCol.B", half, 0.5)
        .flat("ViewLayer.DiffDir.R ViewLayer.DiffDir.G ViewLayer.DiffDir.B", half, 0.5)
        .channel("ViewLayer.Denoising Albedo.R", half, |_, _| 0.625)
        .channel("ViewLayer.Denoising Albedo.G", half, |_, _| 0.625)
        .channel("ViewLayer.Denoising Albedo.B", half, |_, _| 0.625)
        .flat("ViewLayer.GlossDir.R ViewLayer.GlossDir.G ViewLayer.GlossDir.B", half, 0.75)
        .flat("ViewLayer.GlossInd.R ViewLayer.GlossInd.G ViewLayer.GlossInd.B", half, 0.25)
        .flat("ViewLayer.GlossCol.R ViewLayer.GlossCol.G ViewLayer.GlossCol.B", half, 0.25)
        .flat("ViewLayer.Emit.R ViewLayer.Emit.G ViewLayer.Emit.B", half, 0.125);
    let (_folder, setup, inputs) = good(&sample);
    assert_eq!(setup.config.signals, Signals::Specular);
    let image = |name: &str| inputs.images[name][1][0];
    // Combined 1 = emission 0.125 + specular (0.75 + 0.25)·0.25 + the rest.
    assert_eq!((image("noisy_specular"), image("noisy_diffuse"), image("specular_albedo")), (0.25, 0.625, 0.25));
    assert_eq!((inputs.noisy[1][0], image("albedo")), (1.0, 0.5));
}

/// Blender's albedo for denoisers has the lamps and the sky in it that a pixel shows in part.
#[test]
fn blender_with_lamps_in_its_albedo() {
    let half = Type::Half;
    let light = Sample::new(8, 6)
        .flat("ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B", half, 1.0)
        .flat("ViewLayer.Depth.Z", Type::Float, 3.0)
        .flat("ViewLayer.DiffCol.R ViewLayer.DiffCol.G ViewLayer.DiffCol.B", half, 0.125);
    let with_emission = |sample: Sample| {
        let given = [("Denoising Albedo", 1.0), ("Emit", 0.25), ("Env", 0.25)];
        let channels =
            given.into_iter().flat_map(|(name, value)| ["R", "G", "B"].map(|c| (format!("ViewLayer.{name}.{c}"), value)));
        channels.fold(sample, |sample, (name, value)| sample.channel(&name, half, move |_, _| value))
    };
    // Base 0.125, and as much that glass passes on.
    let glossy = "ViewLayer.GlossCol.R ViewLayer.GlossCol.G ViewLayer.GlossCol.B";
    let glossy_light = "ViewLayer.GlossDir.R ViewLayer.GlossDir.G ViewLayer.GlossDir.B \
                        ViewLayer.GlossInd.R ViewLayer.GlossInd.G ViewLayer.GlossInd.B";
    let (_folder, _, inputs) = good(&with_emission(light).flat(glossy, half, 0.25).flat(glossy_light, half, 0.5));
    assert_eq!(inputs.images["albedo"][1][..3], [0.25; 3]);
    // One light, with the coat.
    let whole = Sample::new(8, 6).flat("ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B", half, 1.0).flat(
        "ViewLayer.Depth.Z",
        Type::Float,
        3.0,
    );
    let (_folder, _, inputs) = good(&with_emission(whole));
    assert_eq!(inputs.images["albedo"][1][..3], [0.5; 3]);
}

/// Behind a transparent film the sky is not in the picture, but in the albedo for denoisers it is.
#[test]
fn blender_with_a_transparent_film() {
    let half = Type::Half;
    let passes = [("Combined", 0.25), ("DiffCol", 0.25), ("Denoising Albedo", 0.75), ("Env", 0.5)];
    let passes = passes.iter().flat_map(|(name, value)| ["R", "G", "B"].map(|c| (format!("ViewLayer.{name}.{c}"), *value)));
    let sample = passes.fold(Sample::new(8, 6), |sample, (name, value)| sample.channel(&name, half, move |_, _| value));
    let (folder, mut setup, _) = good(&sample.flat("ViewLayer.Depth.Z", Type::Float, 3.0));
    let files = frame_files::find(&[folder.path().to_owned()]).expect("files");
    first_look::take(&files, &mut setup).expect("a look");
    let images = atrous_denoise::loader::Loader::new(&setup).load(&files[0]).expect("a frame").images;
    assert!(!images.contains_key("emission") && images["noisy_radiance"][1][0] == 0.25, "{:?}", setup.report);
    assert_eq!(images["albedo"][1][..3], [0.25; 3]);
}

/// Columns 0 to 2 are glass, 3 is glass and wall, 4 to 7 are wall. `albedo`: as for denoisers, where it is written. `rim`: length of normals there.
fn glass_before_a_wall(albedo: Option<f32>, rim: f32) -> Vec<f32> {
    let half = Type::Half;
    let by_column = |sample: Sample, names: &str, columns: [f32; 8]| {
        let channels = ["R", "G", "B"].map(|c| format!("ViewLayer.{names}.{c}"));
        channels.iter().fold(sample, |sample, name| sample.channel(name, half, move |x, _| columns[x as usize]))
    };
    let sample = Sample::new(8, 6)
        .flat("ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B", half, 1.0)
        .flat("ViewLayer.Depth.Z", Type::Float, 3.0)
        .flat("ViewLayer.GlossDir.R ViewLayer.GlossDir.G ViewLayer.GlossDir.B", half, 0.5)
        .flat("ViewLayer.GlossInd.R ViewLayer.GlossInd.G ViewLayer.GlossInd.B", half, 0.0)
        .flat("ViewLayer.Normal.X ViewLayer.Normal.Y", half, 0.0)
        .channel("ViewLayer.Normal.Z", half, move |x, _| if x == 3 { rim } else { 1.0 })
        .channel("ViewLayer.IndexOB.X", Type::Float, |x, _| if x < 4 { 1.0 } else { 2.0 });
    let sample = by_column(sample, "GlossCol", [0.5, 0.5, 0.5, 0.25, 0.0, 0.0, 0.0, 0.0]);
    let sample = by_column(sample, "DiffCol", [0.0, 0.0, 0.0, 0.25, 0.5, 0.5, 0.5, 0.5]);
    let written = match albedo {
        Some(a) => by_column(sample, "Denoising Albedo", [a, a, a, a, 0.5, 0.5, 0.5, 0.5]),
        None => sample,
    };
    let (folder, mut setup, _) = good(&written);
    let files = frame_files::find(&[folder.path().to_owned()]).expect("files");
    first_look::take(&files, &mut setup).expect("a look");
    let frame = atrous_denoise::loader::Loader::new(&setup).load(&files[0]).expect("a frame");
    frame.images["albedo"][..8].iter().map(|texel| texel[0]).collect()
}

/// What glass passes on has no part in its diffuse colour, of which its rim has a share.
#[test]
fn glass_is_divided_by_what_is_behind_it_or_by_nothing() {
    assert_eq!(glass_before_a_wall(None, 0.75), [0.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 0.5]);
    // Half of the glass reflects. At its rim 0.25 is of the wall, and ¾ of the other 0.125 behind it.
    assert_eq!(glass_before_a_wall(Some(0.375), 0.75), [0.1875, 0.1875, 0.1875, 0.34375, 0.5, 0.5, 0.5, 0.5]);
}

/// A surface of the middle of a pixel is one: a print that is black in part.
#[test]
fn a_print_has_no_rim() {
    assert_eq!(glass_before_a_wall(None, 1.0), [0.0, 0.0, 0.0, 0.25, 0.5, 0.5, 0.5, 0.5]);
}

/// A pixel beside a lamp, which it covers more or less from frame to frame. `last`: more of the camera of the last frame.
fn beside_a_lamp(options: &Options, last: &str) -> Vec<f32> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let identity = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
    let camera = |i: usize| {
        let more = if i == 5 { last } else { "" };
        format!(r#"{{"i": {i}, "view": {identity}, "proj": {identity}{more}}}"#)
    };
    let cameras: Vec<String> = (0..6).map(camera).collect();
    std::fs::write(folder.path().join("sequence.json"), format!(r#"{{"frames": [{}]}}"#, cameras.join(", "))).expect("cameras");
    for i in 0..6 {
        // Rows have samples of their own. Row 6 is looked at.
        let covered = move |y: i32| [0.0, 1.0, 0.5, 0.25, 0.75, 0.0][(i + 4 * y as usize) % 6];
        let light = move |x: i32, y: i32| 0.5 + 4.0 * if x < 8 { 1.0 } else { f32::from(x == 8) * covered(y) };
        let mut sample = Sample::new(16, 12)
            .channel("ViewLayer.Depth.Z", Type::Float, |x, _| if x < 8 { 3.0 } else { 1e10 })
            .channel("ViewLayer.IndexOB.X", Type::Float, |x, _| if x < 8 { 1.0 } else { 0.0 })
            .flat("ViewLayer.Vector.X ViewLayer.Vector.Y", Type::Float, 0.0);
        for channel in ["Combined.R", "Combined.G", "Combined.B", "Emit.R", "Emit.G", "Emit.B"] {
            sample = sample.channel(&format!("ViewLayer.{channel}"), Type::Float, light);
        }
        sample.write(&folder.path().join(format!("f_{i:04}.exr")));
    }
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = Setup::new(&frames, options).expect("a layout");
    let mut loader = Loader::new(&setup);
    frames.iter().map(|files| loader.load(files).expect("a frame").images["emission"][16 * 6 + 8][0]).collect()
}

#[test]
fn the_outline_of_a_lamp_is_averaged_over_frames() {
    let given = [0.5, 4.5, 2.5, 1.5, 3.5, 0.5];
    let averaged = beside_a_lamp(&Options::default(), "");
    assert_eq!(averaged[..2], given[..2]);
    assert!(averaged[5] > 1.5 && averaged[5] < 3.0, "{averaged:?}");
    let enlarged = Options { output_size: Some([32, 24]), ..Options::default() };
    assert_eq!(beside_a_lamp(&enlarged, ""), given, "the stage that makes the larger picture does it itself");
    for cut in [r#", "reset": true"#, r#", "exposure_ratio": 2"#, r#", "jitter": [0.25, 0]"#] {
        assert_eq!(beside_a_lamp(&Options::default(), cut)[5], given[5], "{cut}");
    }
}

/// What fog scatters is filtered as a volume, and is no part of the surfaces.
#[test]
fn blender_with_volume_passes() {
    let sample = Sample::new(8, 6)
        .flat("ViewLayer.Combined.R ViewLayer.Combined.G ViewLayer.Combined.B", Type::Half, 1.0)
        .flat("ViewLayer.Depth.Z", Type::Float, 3.0)
        .flat("ViewLayer.VolumeDir.R ViewLayer.VolumeDir.G ViewLayer.VolumeDir.B", Type::Half, 0.25)
        .flat("ViewLayer.VolumeInd.R ViewLayer.VolumeInd.G ViewLayer.VolumeInd.B", Type::Half, 0.125);
    let (_folder, _, inputs) = good(&sample);
    let image = |name: &str| inputs.images[name][1][0];
    assert_eq!((image("noisy_volume"), image("noisy_radiance"), inputs.noisy[1][0]), (0.375, 0.625, 1.0));
}

/// The split that data sets of this project have; their roughness is GGX's α.
#[test]
fn own_data_sets_with_specular_light() {
    let sample = samples::frame(1)
        .flat("diffuse.R diffuse.G diffuse.B", Type::Half, 0.25)
        .flat("specular.R specular.G specular.B", Type::Half, 0.5)
        .flat("specular_albedo.R specular_albedo.G specular_albedo.B", Type::Half, 0.75)
        .flat("roughness.Y", Type::Half, 0.25)
        .flat("hitdist.D", Type::Float, 3.5)
        .flat("hit_id.I", Type::Uint, 7.0);
    let (_folder, setup, inputs) = good(&sample);
    assert_eq!((setup.config.signals, setup.config.conventions.roughness), (Signals::Specular, RoughnessEncoding::Alpha));
    let expected = [
        ("noisy_diffuse", 0.25),
        ("noisy_specular", 0.5),
        ("specular_albedo", 0.75),
        ("roughness", 0.25),
        ("specular_hit_distance", 3.5),
    ];
    for (name, value) in expected {
        assert_eq!(inputs.images[name][3][0], value, "{name}");
    }
    assert_eq!(inputs.hit_id.map(|ids| ids[3]), Some(7));
}

#[test]
fn mitsuba() {
    let sample = Sample::new(8, 6)
        .flat("my_render.R my_render.G my_render.B my_render.A", Type::Float, 1.0)
        .flat("albedo.R albedo.G albedo.B", Type::Float, 0.5)
        .flat("dd.y.T", Type::Float, 3.0)
        .flat("nn.X nn.Y nn.Z", Type::Float, 0.5)
        .flat("pos.X pos.Y pos.Z", Type::Float, 1.5)
        .flat("shape_index.I", Type::Float, 4.0);
    let (_folder, setup, _) = good(&sample);
    assert_eq!(setup.mapping.layout, Layout::Mitsuba);
    assert_eq!(names(&setup, Role::Noisy), "my_render.R my_render.G my_render.B");
    assert_eq!(names(&setup, Role::Depth), "dd.y.T");
    assert_eq!(names(&setup, Role::Normal), "nn.X nn.Y nn.Z");
    assert_eq!(names(&setup, Role::Position), "pos.X pos.Y pos.Z");
    assert_eq!(names(&setup, Role::Id), "shape_index.I");
    // No camera: the distance along the ray cannot be turned into a depth.
    assert_eq!(setup.config.conventions.depth, DepthEncoding::Linear);
    assert!(setup.report.iter().any(|l| l.contains("no camera")), "{:?}", setup.report);
}

#[test]
fn pbrt() {
    let sample = Sample::new(8, 6)
        .flat("R G B Albedo.R Albedo.G Albedo.B", Type::Half, 0.5)
        .flat("P.X P.Y", Type::Float, 1.0)
        .flat("P.Z", Type::Float, 4.0)
        .flat("N.X N.Y N.Z Ns.X Ns.Y Ns.Z", Type::Half, 0.5)
        .flat("u v dzdx dzdy", Type::Half, 0.0);
    let (_folder, setup, inputs) = good(&sample);
    assert_eq!(setup.mapping.layout, Layout::Pbrt);
    assert_eq!(names(&setup, Role::Normal), "Ns.X Ns.Y Ns.Z");
    assert_eq!(names(&setup, Role::Noisy), "R G B");
    // Camera space by default, so that z is the depth.
    assert_eq!(inputs.images["depth"][3][0], 4.0);
}

#[test]
fn plain_colour_names_everything_that_is_lost() {
    let (_folder, setup, inputs) = good(&Sample::new(8, 6).flat("R G B", Type::Half, 0.5));
    assert_eq!(setup.mapping.layout, Layout::Plain);
    for lost in ["albedo", "normal", "depth", "motion", "id", "emission", "direct"] {
        assert!(setup.report.iter().any(|l| l.contains(&format!("no {lost}"))), "{lost}: {:?}", setup.report);
    }
    assert_eq!(inputs.images["motion"][0], [0.0; 4]);
}

#[test]
fn colour_albedo_and_normal_in_files_of_their_own() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for number in 7..10 {
        let path = |what: &str| folder.path().join(format!("shot_{number:03}{what}.exr"));
        Sample::new(8, 6).flat("R G B", Type::Half, 0.5).write(&path("_hdr"));
        Sample::new(8, 6).flat("R G B", Type::Half, 0.25).write(&path("_alb"));
        Sample::new(8, 6).flat("X Y Z", Type::Half, 1.0).write(&path("_nrm"));
    }
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    assert_eq!(frames.iter().map(|f| f.number).collect::<Vec<_>>(), [7, 8, 9]);
    let setup = Setup::new(&frames, &Options::default()).expect("a layout");
    assert_eq!(names(&setup, Role::Albedo), "albedo.R albedo.G albedo.B");
    assert_eq!(names(&setup, Role::Normal), "normal.X normal.Y normal.Z");
    let inputs = frame::load(&frames[1], &setup).expect("a frame");
    assert_eq!((inputs.images["albedo"][0][2], inputs.noisy[0][1]), (0.25, 0.5));
}

#[test]
fn options_name_channels_and_their_errors_list_what_there_is() {
    let sample = Sample::new(8, 6).flat("x.a.R x.a.G x.a.B far", Type::Half, 0.5).flat("count", Type::Uint, 1.0);
    let named = |list: &[(Role, &str)]| Options {
        channels: list.iter().map(|(role, name)| (*role, (*name).to_owned())).collect(),
        ..Options::default()
    };
    let (_f, unnamed) = setup_of(&sample, &Options::default());
    assert!(matches!(unnamed, Err(ToolError::NoColour { .. })), "{unnamed:?}");
    let (_f, setup) = setup_of(&sample, &named(&[(Role::Noisy, "x.a"), (Role::Depth, "far"), (Role::Id, "count")]));
    let setup = setup.expect("named channels");
    assert_eq!((names(&setup, Role::Noisy), names(&setup, Role::Depth)), ("x.a.R x.a.G x.a.B".into(), "far".into()));
    let (_f, swapped) = setup_of(&sample, &named(&[(Role::Noisy, "x.a.B, x.a.G, x.a.R")]));
    assert_eq!(names(&swapped.expect("named channels"), Role::Noisy), "x.a.B x.a.G x.a.R");
    let (_f, wrong) = setup_of(&sample, &named(&[(Role::Noisy, "x.b")]));
    assert!(wrong.expect_err("no such layer").to_string().contains("x.a.R"));
    let (_f, wrong) = setup_of(&sample, &named(&[(Role::Noisy, "x.a"), (Role::Depth, "count")]));
    let message = wrong.expect_err("integers are no depth").to_string();
    assert!(message.contains("f_0001.exr") && message.contains("`count`") && message.contains("unsigned"), "{message}");
}

#[test]
fn a_camera_stands_in_for_motion() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |number: u32| {
        let sample = Sample::new(32, 18).flat("R G B", Type::Half, 0.5).flat("pos.X pos.Y", Type::Float, 0.0);
        sample
            .flat("pos.Z", Type::Float, -2.0)
            .flat("albedo.R albedo.G albedo.B", Type::Half, 0.5)
            .write(&samples::frame_path(folder.path(), number));
    };
    (0..2).for_each(write);
    std::fs::write(folder.path().join("sequence.json"), cameras(&[0.0, 0.25])).expect("a file");
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = Setup::new(&frames, &Options::default()).expect("a layout");
    assert!(setup.report.iter().any(|l| l.contains("computed from depth and camera")), "{:?}", setup.report);
    let load = |i: usize| frame::load(&frames[i], &setup).expect("a frame");
    let (first, second) = (load(0), load(1));
    assert_eq!(second.images["depth"][9][0], 2.0);
    assert!(!second.images.contains_key("motion"));
    // The camera moved 0.25 to the right at depth 2 with a focal length of 1: by 0.125 of half the width, so the surface was 2
    // pixels further right.
    let motion = atrous_denoise::motion::of_frame(&second, &first.params, &setup.config.conventions);
    let [x, y] = motion.motion_px[100];
    assert!((x - 2.0).abs() < 1e-3 && y.abs() < 1e-3, "{x} {y}");
    assert!((motion.previous_depth[100] - 2.0).abs() < 1e-4);
}

/// `sequence.json` with a camera that looks along −z from each x.
pub fn cameras(positions: &[f32]) -> String {
    let frame = |(i, x): (usize, &f32)| {
        format!(
            r#"{{"i": {i}, "view": [[1,0,0,{}],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "proj": [[1,0,0,0],[0,-1,0,0],[0,0,-1,-0.1],[0,0,-1,0]]}}"#,
            -x
        )
    };
    format!(r#"{{"frames": [{}]}}"#, positions.iter().enumerate().map(frame).collect::<Vec<_>>().join(","))
}

#[test]
fn conventions_of_the_sequence_are_taken() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    samples::frame(0).write(&samples::frame_path(folder.path(), 0));
    let json = |key: &str| cameras(&[0.0]).replacen('{', &format!(r#"{{"conventions": {{"{key}": "uv"}}, "#), 1);
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let path = folder.path().join("sequence.json");
    std::fs::write(&path, json("motion_unit")).expect("a file");
    let setup = Setup::new(&frames, &Options::default()).expect("conventions");
    assert_eq!(setup.config.conventions.motion_unit, atrous::config::MotionUnit::Uv);
    std::fs::write(&path, json("motion_units")).expect("a file");
    let message = Setup::new(&frames, &Options::default()).expect_err("no such key").to_string();
    assert!(message.contains("sequence.json") && message.contains("motion_unit="), "{message}");
    std::fs::write(&path, "{").expect("a file");
    assert!(matches!(Setup::new(&frames, &Options::default()), Err(ToolError::Json { path: p, .. }) if p == Path::new(&path)));
}

#[test]
fn references_may_be_there_for_some_frames_only() {
    let folder = tempfile::tempdir().expect("a folder");
    for i in 0..3 {
        Sample::new(4, 2).flat("R G B", Type::Float, 0.5).write(&folder.path().join(format!("a_{i}.exr")));
    }
    Sample::new(4, 2).flat("R G B", Type::Float, 0.25).write(&folder.path().join("a_1_ref.exr"));
    let files = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = Setup::new(&files, &Options::default()).expect("a set-up");
    let references: Vec<_> = files.iter().map(|f| frame::load(f, &setup).expect("a frame").reference.map(|r| r[0])).collect();
    assert_eq!(references, [None, Some([0.25; 3]), None]);
}
