//! Every way of storing pixels gives the same pixels.

use crate::samples::{bounds, noise, Sample, Type};
use atrous_denoise::exr_read::{read, Samples};
use exr::compression::Compression;
use std::path::Path;

const LOSSLESS: [Compression; 5] =
    [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::ZIP16, Compression::PIZ];

fn value(x: i32, y: i32) -> f32 {
    // Multiples of 1/256 below 4 are exact in half precision.
    (noise(x, y, 1) * 1024.0).floor() / 256.0
}

fn sample(compression: Compression, tile: Option<usize>) -> Sample {
    let sample = Sample::new(37, 29).channel("a.half", Type::Half, value).channel("b.float", Type::Float, value).channel(
        "c.uint",
        Type::Uint,
        |x, y| (x + 100 * y) as f32,
    );
    Sample { compression, tile, ..sample }
}

fn floats(path: &Path, name: &str) -> Vec<f32> {
    match read(path, |c| c.name == name).expect("readable").samples.remove(name) {
        Some(Samples::Float(values)) => values,
        other => panic!("{name}: {other:?}"),
    }
}

fn expected(width: i32, height: i32, of: impl Fn(i32, i32) -> f32) -> Vec<f32> {
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| of(x, y)).collect()
}

#[test]
fn lossless_compressions_scan_lines_and_tiles() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    for compression in LOSSLESS {
        for tile in [None, Some(16), Some(64)] {
            sample(compression, tile).write(&path);
            assert_eq!(floats(&path, "a.half"), expected(37, 29, value), "{compression:?} {tile:?}");
            assert_eq!(floats(&path, "b.float"), expected(37, 29, value), "{compression:?} {tile:?}");
            let ids = read(&path, |c| c.name == "c.uint").expect("readable").samples.remove("c.uint");
            let ids_expected = expected(37, 29, |x, y| (x + 100 * y) as f32).into_iter().map(|v| v as u32).collect();
            assert_eq!(ids, Some(Samples::Uint(ids_expected)), "{compression:?} {tile:?}");
        }
    }
}

#[test]
fn lossy_compressions_are_close() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    for compression in [Compression::PXR24, Compression::B44, Compression::B44A] {
        let smooth = |x: i32, y: i32| 1.0 + 0.01 * (x + y) as f32;
        Sample { compression, ..Sample::new(32, 24).channel("Y", Type::Half, smooth) }.write(&path);
        let worst = floats(&path, "Y").iter().zip(expected(32, 24, smooth)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 0.05, "{compression:?}: {worst}");
    }
}

#[test]
fn large_files_are_decoded_on_all_cores() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    let uneven = |x: i32, y: i32| noise(x, y, 3);
    let sample = Sample { compression: Compression::RLE, ..Sample::new(700, 600).channel("Y", Type::Float, uneven) };
    sample.write(&path);
    assert!(path.metadata().expect("a file").len() > 1 << 20);
    assert_eq!(floats(&path, "Y"), expected(700, 600, uneven));
}

#[test]
fn the_picture_is_the_display_window_with_its_overscan() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    // Smaller than the picture, larger than it, and half outside; windows that do not begin at 0.
    for (display, data) in [
        (bounds(0, 0, 20, 10), bounds(3, 2, 5, 4)),
        (bounds(0, 0, 20, 10), bounds(-4, -3, 40, 30)),
        (bounds(10, -5, 20, 10), bounds(5, 0, 20, 10)),
        (bounds(0, 0, 20, 10), bounds(100, 100, 5, 5)),
    ] {
        for tile in [None, Some(8)] {
            let at = |x: i32, y: i32| (x + 50 + 200 * (y + 10)) as f32;
            Sample { display, data, tile, ..Sample::new(1, 1).channel("Y", Type::Float, at) }.write(&path);
            let inside = |x: i32, y: i32| {
                let end = (data.position.0 + data.size.0 as i32, data.position.1 + data.size.1 as i32);
                (data.position.0..end.0).contains(&x) && (data.position.1..end.1).contains(&y)
            };
            // A part that lies beside the picture is not in it.
            let reach = |window: exr::meta::attribute::IntegerBounds| {
                (window.position, window.position + exr::prelude::Vec2(window.size.0 as i32, window.size.1 as i32))
            };
            let ((from, to), (start, stop)) = (reach(display), reach(data));
            let meets = start.0 < to.0 && start.1 < to.1 && stop.0 > from.0 && stop.1 > from.1;
            let [from, to] = match meets {
                true => [[from.0.min(start.0), from.1.min(start.1)], [to.0.max(stop.0), to.1.max(stop.1)]],
                false => [[from.0, from.1], [to.0, to.1]],
            };
            let wanted = expected(to[0] - from[0], to[1] - from[1], |x, y| {
                let (x, y) = (x + from[0], y + from[1]);
                if inside(x, y) {
                    at(x, y)
                } else {
                    0.0
                }
            });
            assert_eq!(floats(&path, "Y"), wanted, "{display:?} {data:?}");
        }
    }
}

#[test]
fn parts_are_layers() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    let colour = Sample::new(8, 6).flat("R G B", Type::Half, 0.25);
    let depth = Sample::new(8, 6).flat("Z", Type::Float, 7.0);
    Sample::write_parts([("beauty", &colour), ("depth", &depth)], &path);
    let header = atrous_denoise::exr_read::read_header(&path).expect("readable");
    let names: Vec<_> = header.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["beauty.B", "beauty.G", "beauty.R", "depth.Z"]);
    assert_eq!(floats(&path, "depth.Z"), vec![7.0; 48]);
    assert_eq!(floats(&path, "beauty.G"), vec![0.25; 48]);
}
