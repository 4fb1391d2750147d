//! The folder of the results: nothing is overwritten unasked, and runs that write to it at once do not hurt each other.

use crate::samples::{denoise, frame_path, limited, program, sequence, Sample, Type};
use atrous_denoise::error::ToolError;
use atrous_denoise::exr_read::{read, read_header, Samples};
use std::collections::BTreeMap;
use std::path::Path;

/// Small and quick, with every kind of file.
const QUICK: [&str; 6] = ["--preset", "eaw", "--png", "--score", "--strip", "--report"];
/// And for the program itself.
const ALONE: [&str; 3] = ["--quiet", "--device", "reference"];

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Every file by name, with what is in it.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("a folder").flatten().filter(|e| e.path().is_file());
    entries.map(|e| (e.file_name().to_string_lossy().into_owned(), std::fs::read(e.path()).expect("a file"))).collect()
}

#[test]
fn eight_runs_at_once_leave_whole_files() {
    let (input, alone) = (sequence(3), folder());
    assert!(program(input.path(), alone.path(), &[&QUICK[..], &ALONE].concat()).status().expect("a run").success());
    let expected = files(alone.path());
    for force in [true, false] {
        let shared = folder();
        let options = [&QUICK[..], &ALONE, if force { &["--force"] } else { &[] }].concat();
        let start = |_| program(input.path(), shared.path(), &options).spawn().expect("a run");
        let runs: Vec<_> = (0..8).map(start).collect();
        for run in runs {
            let output = run.wait_with_output().expect("a run");
            let message = String::from_utf8_lossy(&output.stderr);
            // Without --force whoever comes second is told so.
            assert!(output.status.success() || (!force && message.contains("exists already")), "{message}");
        }
        if force {
            assert!(files(shared.path()) == expected);
        }
        for (name, bytes) in files(shared.path()) {
            assert!(expected.get(&name) == Some(&bytes), "{name} is another, force {force}");
        }
    }
}

#[cfg(unix)]
#[test]
fn planted_links_are_not_followed() {
    let (input, output, elsewhere) = (sequence(1), folder(), folder());
    let victim = elsewhere.path().join("victim");
    std::fs::write(&victim, "kept").expect("a file");
    let names = ["frame_0000.exr", "frame_0000.png", "strip.png", "report.html", "scores.json", "scores.png"];
    for name in names {
        for planted in [name.to_owned(), format!(".{name}.part")] {
            std::os::unix::fs::symlink(&victim, output.path().join(planted)).expect("a link");
        }
    }
    std::os::unix::fs::symlink(&victim, output.path().join(".denoise.part")).expect("a link");
    denoise(input.path(), output.path(), &[&QUICK[..], &["--force"]].concat()).expect("a run");
    assert_eq!(std::fs::read_to_string(&victim).expect("a file"), "kept");
    for name in names {
        assert!(output.path().join(name).symlink_metadata().expect("a file").is_file(), "{name}");
    }
}

#[test]
fn pictures_and_scores_are_not_overwritten_unasked() {
    let input = sequence(2);
    for (name, option) in [
        ("frame_0001.png", "--png"),
        ("strip.png", "--strip"),
        ("report.html", "--report"),
        ("scores.json", "--score"),
        ("scores.png", "--score"),
        ("views/frame_0001_deviation.png", "--views"),
    ] {
        let output = folder();
        let path = output.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, "kept").expect("a file");
        let error = denoise(input.path(), output.path(), &[option]).expect_err("exists");
        assert!(matches!(&error, ToolError::Exists { path } if path.ends_with(name)), "{error}");
        assert_eq!(std::fs::read_to_string(&path).expect("a file"), "kept");
        assert!(!frame_path(output.path(), 0).exists(), "{option}: refused before a frame is filtered");
        denoise(input.path(), output.path(), &[option, "--force"]).expect("overwritten");
        assert_ne!(std::fs::read(&path).expect("a file"), b"kept");
    }
}

#[test]
fn strips_and_reports_are_of_a_frame_that_there_is() {
    for (option, file) in [("--strip", "strip.png"), ("--report", "report.html")] {
        let (input, output) = (sequence(2), folder());
        let message = denoise(input.path(), output.path(), &[option, "999"]).expect_err("no such frame").to_string();
        assert!(message.contains(&format!("{option} 999")) && message.contains("0 to 1"), "{message}");
        // Finished ones are shown, too.
        denoise(input.path(), output.path(), &[]).expect("a run");
        denoise(input.path(), output.path(), &["--resume", option, "0"]).expect("a picture");
        assert!(output.path().join(file).is_file());
    }
}

/// A limit for the size of a file stands in for a full disk.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_without_room_keeps_what_is_finished() {
    let (input, output) = (sequence(3), folder());
    let even = |sample: Sample| sample.flat("R G B", Type::Float, 0.5);
    even(Sample::new(64, 64)).write(&frame_path(input.path(), 0));
    for number in 1..3 {
        let uneven = move |x, y| crate::samples::noise(x, y, number);
        Sample::new(64, 64)
            .channel("R", Type::Float, uneven)
            .flat("G B", Type::Float, 0.5)
            .write(&frame_path(input.path(), number));
    }
    let more = ["--float", "--preset", "eaw", "--set", "eaw_sigma_radiance=0.0001"];
    let program = program(input.path(), output.path(), &[&more[..], &ALONE].concat());
    let run = limited(&program, "trap '' XFSZ; ulimit -f 16").output().expect("a run");
    let message = String::from_utf8_lossy(&run.stderr);
    assert!(!run.status.success() && message.contains("frame_0001.exr") && message.contains("--resume"), "{message}");
    assert_eq!(files(output.path()).into_keys().collect::<Vec<_>>(), ["frame_0000.exr"]);
    denoise(input.path(), output.path(), &[&more[..], &["--resume"]].concat()).expect("resumed");
    assert_eq!(files(output.path()).len(), 3);
}

#[test]
fn results_have_the_size_that_is_asked_for() {
    let (input, output) = (sequence(3), folder());
    let sized = |size: &'static str| ["--preset", "eaw", "--png", "--output-size", size];
    denoise(input.path(), output.path(), &sized("60x45")).expect("a run");
    let header = read_header(&frame_path(output.path(), 1)).expect("a result");
    assert_eq!((header.extent, header.has_gaps), ([60, 45], false));
    let png = std::fs::read(output.path().join("frame_0001.png")).expect("a preview");
    assert_eq!(png[16..24], [0, 0, 0, 60, 0, 0, 0, 45], "width and height of a PNG");
    let before = files(output.path());
    denoise(input.path(), output.path(), &[&sized("60x45")[..], &["--resume"]].concat()).expect("nothing to do");
    assert!(files(output.path()) == before);
    let error = denoise(input.path(), output.path(), &[&sized("66x45")[..], &["--resume"]].concat()).expect_err("another size");
    assert!(error.to_string().contains("output_extent"), "{error}");
    let error = denoise(input.path(), folder().path(), &sized("200x45")).expect_err("too large").to_string();
    assert!(error.contains("[200, 45]") && error.contains("1 to 3"), "{error}");
}

/// Visibility and ambient occlusion, each with one value everywhere, which the filter leaves as it is.
#[test]
fn results_beside_the_picture_have_layers_of_their_own() {
    for (visibility, layers) in [("visibility.Z", &["Z"][..]), ("visibility.R visibility.G visibility.B", &["R", "G", "B"])] {
        let (input, output) = (folder(), folder());
        for number in 0..2 {
            let sample = crate::samples::frame(number).flat("ambient.Z", Type::Float, 0.75).flat(visibility, Type::Float, 0.25);
            let sample = sample.flat("ambient_distance.Z occluder_distance.Z", Type::Float, 1.0);
            sample.write(&frame_path(input.path(), number));
        }
        denoise(input.path(), output.path(), &["--preset", "eaw", "--float"]).expect("a run");
        let planes = read(&frame_path(output.path(), 1), |_| true).expect("a frame").samples;
        let is = |name: &str, value: f32| match planes.get(name) {
            Some(Samples::Float(texels)) => texels.iter().all(|v| (v - value).abs() < 1e-2),
            _ => panic!("{name} is not among {:?}", planes.keys()),
        };
        assert!(is("denoised_ambient.Z", 0.75));
        assert!(layers.iter().all(|layer| is(&format!("denoised_visibility.{layer}"), 0.25)));
        assert!(!planes.keys().any(|name| name.starts_with("denoised_radiance")));
        // What is larger than they are does not have them.
        let larger = folder();
        denoise(input.path(), larger.path(), &["--preset", "eaw", "--output-size", "60x36"]).expect("a run");
        let header = read_header(&frame_path(larger.path(), 1)).expect("a frame");
        assert!(!header.channels.iter().any(|channel| channel.name.starts_with("denoised_")));
    }
}
