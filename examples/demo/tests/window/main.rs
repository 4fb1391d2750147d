//! The window for real: in a virtual X server, on the device that there is, under validation. Keys and the mouse come from outside of the
//! program, what it did is read from its log, from the pictures that it writes, and from the screen. Every step waits for a line, never for a time.

mod drop;
mod screen;
mod session;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use atrous_lab::pictures::Picture;
use session::{panel_width_of, Demo, Display};

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Pixels that differ by more than the eye could miss.
fn different(a: &Picture, b: &Picture) -> usize {
    let far = |(a, b): (&[u8; 3], &[u8; 3])| a.iter().zip(b).any(|(x, y)| x.abs_diff(*y) > 8);
    a.pixels().iter().zip(b.pixels()).filter(|pair| far(*pair)).count()
}

fn brightness(picture: &Picture) -> f64 {
    picture.pixels().iter().flatten().map(|c| f64::from(*c)).sum::<f64>() / (3 * picture.pixels().len()) as f64
}

/// Presses F2, and reads left and right half of what was written.
fn shoot(demo: &mut Demo, left: &str, right: &str) -> [Picture; 2] {
    let [_, left, right] = shoot_all(demo, left, right);
    [left, right]
}

/// The same, with the picture of both before them.
fn shoot_all(demo: &mut Demo, left: &str, right: &str) -> [Picture; 3] {
    demo.key("F2");
    let line = demo.wait("a picture", |line| line.starts_with("message picture "));
    let both = line.trim_start_matches("message picture ").trim_end_matches(".png").to_owned();
    let read = |part: String| {
        let path = PathBuf::from(format!("{both}{part}.png"));
        Picture::read_png(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    };
    [read(String::new()), read(format!("_left_{left}")), read(format!("_right_{right}"))]
}

#[test]
fn a_session_with_keys_mouse_and_another_size() {
    let Some(display) = Display::open() else { return };
    let out = folder("window-session");
    let mut demo = Demo::start(&display, &out);

    demo.wait("frames", |line| line.starts_with("frame") && line.contains("left=noisy right=asvgf"));
    demo.focus();
    filters_and_pictures(&mut demo);
    time(&mut demo);
    divider(&mut demo, &display);
    comparisons(&mut demo, &display);
    room(&mut demo);
    sizes(&mut demo);
    magnifier(&mut demo);
    camera_and_files(&mut demo, &out);
    demo.key("ctrl+q");
    demo.assert_closed();
}

fn filters_and_pictures(demo: &mut Demo) {
    for (key, name) in [("3", "asvgf"), ("2", "svgf"), ("4", "percentile"), ("5", "fast"), ("6", "eaw"), ("7", "best")] {
        demo.key(key);
        demo.wait(name, |line| line.starts_with("frame") && line.contains(&format!("right={name} ")));
        let [noisy, filtered] = shoot(demo, "noisy", name);
        assert!(brightness(&noisy) > 10.0 && brightness(&filtered) > 10.0, "black");
        assert!(different(&noisy, &filtered) > 500, "{name} leaves the noise as it is");
    }
    demo.key("shift+3");
    demo.wait("A-SVGF left", |line| line.starts_with("frame") && line.contains("left=asvgf right=best"));
    demo.key("x");
    demo.wait("halves changed", |line| line.starts_with("frame") && line.contains("left=best right=asvgf"));
    demo.key("8");
    demo.wait("a reference", |line| line.contains("right=reference") && line.starts_with("frame"));
}

fn time(demo: &mut Demo) {
    demo.key("space");
    demo.wait("a pause", |line| line.starts_with("state") && line.contains("paused=true"));
    // The frame that was being made may still come.
    demo.key("n");
    demo.key("F1");
    demo.wait("the help", |line| line.starts_with("state") && line.contains("help=true"));
    demo.key("F1");
    demo.wait("no help", |line| line.starts_with("state") && line.contains("help=false"));
    demo.key("2");
    demo.wait("a frame while paused", |line| line.starts_with("frame") && line.contains("right=svgf"));
    demo.key("r");
    demo.key("space");
    demo.wait("no pause", |line| line.starts_with("state") && line.contains("paused=false"));
    demo.wait("frames", |line| line.starts_with("frame"));
}

fn divider(demo: &mut Demo, display: &Display) {
    demo.key("shift+1");
    demo.wait("noisy left", |line| line.starts_with("frame") && line.contains("left=noisy right=svgf"));
    let [x, y, width, height] = demo.picture();
    let at = |share: f32| [x + share * width, y + 0.5 * height];
    demo.drag_divider(at(0.5), at(0.25));
    demo.wait("the divider", |line| line.starts_with("state") && line.contains("divider=0.25") && line.ends_with("held=false"));
    // The screen follows the log: the window draws a frame after it was made.
    let mut rough = || {
        demo.wait("a frame", |line| line.starts_with("frame"));
        let screen = display.screen();
        let part = |from: f32, to: f32| screen.roughness([x + from * width, y + 0.4 * height], [x + to * width, y + 0.8 * height]);
        (part(0.02, 0.23), part(0.3, 0.51))
    };
    let (mut left, mut right) = rough();
    for _ in 0..100 {
        if left > 2.0 * right {
            break;
        }
        (left, right) = rough();
    }
    assert!(left > 2.0 * right, "on the screen the noisy half is as smooth as the other one: {left} and {right}");
}

/// Errors, legends, and the difference of the halves.
fn comparisons(demo: &mut Demo, display: &Display) {
    demo.key("9");
    demo.wait("an error", |line| line.starts_with("measured svgf rmse=0.") && !line.contains("flip=0.00000"));
    let [noisy, error] = shoot(demo, "noisy", "svgf_error");
    assert_eq!(noisy.height(), 36, "a picture needs no legend");
    assert!(error.height() > 36 && brightness(&error) > 1.0, "no colour bar below the error");
    demo.key("9");
    demo.wait("the filter again", |line| line.starts_with("frame") && line.contains("right=svgf "));
    // So that screen and file are of the same frame.
    demo.key("space");
    demo.wait("a pause", |line| line.starts_with("state") && line.contains("paused=true"));
    demo.key("c");
    demo.wait("a difference", |line| line.starts_with("state") && line.contains("difference=true"));
    let [difference, left, right] = shoot_all(demo, "noisy", "svgf");
    assert!(difference.height() > 36, "no colour bar below the difference");
    for (i, (left, right)) in left.pixels().iter().zip(right.pixels()).enumerate() {
        // Grey where nothing differs, black and white from a tenth of white on.
        let of = |l: u8, r: u8| 127.5 + 127.5 * ((f32::from(r) - f32::from(l)) / 25.5).clamp(-1.0, 1.0);
        let far = (0..3).any(|c| (f32::from(difference.pixels()[i][c]) - of(left[c], right[c])).abs() > 0.51);
        assert!(!far, "pixel {i}: {:?} of {left:?} and {right:?}", difference.pixels()[i]);
    }
    assert_on_screen(demo, display, &difference);
    demo.key("c");
    demo.wait("the halves", |line| line.starts_with("state") && line.contains("difference=false"));
    demo.key("space");
    demo.wait("no pause", |line| line.starts_with("state") && line.contains("paused=false"));
}

/// What was written is what is on the screen, between caption and legend; bits that were rounded away are ten times as large in a difference.
fn assert_on_screen(demo: &mut Demo, display: &Display, written: &Picture) {
    let [x, y, width, height] = demo.picture();
    // The screen has the mouse on it.
    demo.point([x + width + 50.0, y]);
    let shown = || {
        std::thread::sleep(Duration::from_millis(50));
        let screen = display.screen();
        let at = |x0: u32, y0: u32| screen.pixel([x + (x0 as f32 + 0.5) * width / 64.0, y + (y0 as f32 + 0.5) * height / 36.0]);
        let middle = (12..24).flat_map(|y0| (0..64).map(move |x0| (x0, y0)));
        let pixels = middle.clone().map(|(x0, y0)| at(x0, y0)).collect();
        let wanted = middle.map(|(x0, y0)| written.pixel(x0, y0).expect("inside")).collect();
        let [shown, wanted] = [pixels, wanted].map(|pixels| Picture::from_pixels(64, 12, pixels).expect("a picture"));
        different(&shown, &wanted)
    };
    // The window draws after it has said so.
    let last = (0..200).map(|_| shown()).find(|count| *count == 0);
    assert_eq!(last, Some(0), "{} of 768 pixels on the screen are others", shown());
}

/// What the picture makes of the window.
fn room(demo: &mut Demo) {
    let whole = demo.picture();
    assert_eq!(whole[2] % 64.0, 0.0, "a whole multiple");
    demo.key("z");
    demo.wait("a picture that fits", |line| line.starts_with("picture"));
    let fit = demo.picture();
    assert!(fit[2] > whole[2], "{whole:?}, then {fit:?}");
    let width = demo.panel_width();
    let edge = 900.0 - width;
    // The press has to be seen before the mouse moves on: the second frame is drawn after it came.
    let two_frames = |demo: &mut Demo| {
        demo.wait("a frame", |line| line.starts_with("frame"));
        demo.wait("a frame", |line| line.starts_with("frame"));
    };
    demo.drag([edge, 400.0], [edge - 120.0, 400.0], two_frames, |demo| {
        demo.wait("a wider panel", |line| panel_width_of(line).is_some_and(|now| now > width + 100.0));
    });
    demo.wait("a frame", |line| line.starts_with("frame"));
    assert_eq!(demo.picture(), fit, "the panel moves the picture");
    demo.key("z");
    demo.wait("a whole multiple again", |line| line.starts_with("picture"));
    assert_eq!(demo.picture(), whole);
}

fn sizes(demo: &mut Demo) {
    for [width, height] in [[700, 420], [90, 60], [1, 1], [880, 480]] {
        demo.resize([width, height]);
        demo.wait("another size", |line| line.starts_with("picture") && line.ends_with(&format!("window {width} {height}")));
    }
    demo.hide_and_show();
    demo.wait("a frame", |line| line.starts_with("frame"));
    demo.key("p");
    demo.wait("no panel", |line| line.starts_with("state") && line.contains("panel=false"));
}

fn magnifier(demo: &mut Demo) {
    demo.key("m");
    demo.wait("the magnifier", |line| line.starts_with("state") && line.contains("magnifier=true"));
    let [x, y, width, height] = demo.picture();
    demo.point([x + 0.75 * width, y + 0.75 * height]);
    demo.wait("numbers", |line| {
        line.starts_with("probe 48 27 history=") && !line.contains("history=-") && !line.contains("reason=-")
    });
    demo.key("m");
}

fn camera_and_files(demo: &mut Demo, out: &Path) {
    demo.key("F5");
    demo.wait("what is missing", |line| line.starts_with("error there is no") && line.contains("F4"));
    demo.key("ctrl+o");
    demo.wait("what is missing", |line| line.starts_with("error there is no") && line.contains("Ctrl S"));
    demo.key("F4");
    demo.hold("w", |demo| {
        demo.wait("a free camera", |line| line.starts_with("state") && line.contains("camera=free"));
        demo.wait("a frame", |line| line.starts_with("frame"));
        demo.wait("a frame", |line| line.starts_with("frame"));
    });
    demo.key("F4");
    demo.wait("a camera path", |line| line.starts_with("message a camera path of"));
    demo.key("F5");
    demo.key("F3");
    demo.wait("a recording", |line| line.starts_with("state") && line.contains("recording=true"));
    demo.key("F3");
    demo.wait("a sequence", |line| line.starts_with("message") && line.contains("frames are in"));
    assert!(out.join("sequence/00000.png").is_file());
    demo.key("ctrl+s");
    demo.wait("settings", |line| line.starts_with("message settings are in"));
    let path = out.join("settings.json");
    let saved = std::fs::read_to_string(&path).expect("settings");
    assert!(saved.contains("\"right\": \"svgf\"") && saved.contains("\"animate_camera\": false"), "{saved}");
    let changed = saved.replace("\"right\": \"svgf\"", "\"right\": \"svgf/disocclusion\"").replace("cornell", "pillars");
    std::fs::write(&path, changed).expect("settings");
    demo.key("ctrl+o");
    demo.wait("a debug view of another scene", |line| line.contains("right=svgf/disocclusion") && line.contains("scene=pillars"));
    std::fs::write(&path, "{\"divider\": 7}").expect("settings");
    demo.key("ctrl+o");
    demo.wait("what is wrong", |line| line.starts_with("error") && line.contains("divider"));
}

#[test]
fn without_a_display_it_names_the_other_way() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_atrous-demo"));
    command.arg("--window").env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    let output = command.output().expect("the demo starts");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && !message.contains("panicked"), "{message}");
    assert!(message.contains("leave --window out") && message.contains("DISPLAY"), "{message}");
}
