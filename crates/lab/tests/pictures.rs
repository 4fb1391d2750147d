//! Pictures: conversion from radiance, false colour, crop, upscale, PNG files.

use atrous_lab::pictures::{from_srgb_8bit, srgb_8bit, Picture, PictureError, Region, NOT_FINITE};
use std::path::PathBuf;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn gradient(width: u32, height: u32) -> Picture {
    let pixel = |i: u32| [(i % width * 7) as u8, (i / width * 11) as u8, (i * 13) as u8];
    Picture::from_pixels(width, height, (0..width * height).map(pixel).collect()).unwrap()
}

#[test]
fn png_round_trip() {
    let folder = file("round_trip");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let (picture, path) = (gradient(37, 23), folder.join("picture.png"));
    picture.write_png(&path).unwrap();
    assert_eq!(Picture::read_png(&path).unwrap(), picture);
    assert_eq!(picture.to_png().unwrap(), std::fs::read(&path).unwrap());
    // A second write replaces the first, and leaves no temporary file.
    let other = gradient(5, 3);
    other.write_png(&path).unwrap();
    assert_eq!(Picture::read_png(&path).unwrap(), other);
    assert!(matches!(picture.write_new_png(&path), Err(PictureError::File { .. })));
    assert_eq!(Picture::read_png(&path).unwrap(), other);
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
fn file_errors_name_the_file() {
    let missing = file("no_such_folder/picture.png");
    let message = gradient(2, 2).write_png(&missing).unwrap_err().to_string();
    assert!(message.contains("no_such_folder/picture.png"), "{message}");
    assert!(!message.contains(".part"), "{message}");
    let message = Picture::read_png(&missing).unwrap_err().to_string();
    assert!(message.contains("no_such_folder/picture.png"), "{message}");
    let text = file("text.png");
    std::fs::write(&text, "this is no picture").unwrap();
    assert!(matches!(Picture::read_png(&text), Err(PictureError::Decode { .. })));
    assert!(matches!(gradient(2, 2).write_png(".."), Err(PictureError::File { .. })));
}

#[test]
fn radiance_is_tone_mapped() {
    let radiance = [[0.0, 1.0, 1e9], [-1.0, f32::MAX, 1e-4]];
    let picture = Picture::from_linear(2, 1, &radiance, 1.0).unwrap();
    // 1 -> 0.5 -> 188 on the sRGB curve; 1e-4 lies on its linear part.
    assert_eq!(picture.pixels(), [[0, 188, 255], [0, 255, 0]]);
    let bright = Picture::from_linear(2, 1, &radiance, 1e30).unwrap();
    assert_eq!(bright.pixels(), [[0, 255, 255], [0, 255, 255]]);
    for exposure in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(matches!(Picture::from_linear(2, 1, &radiance, exposure), Err(PictureError::Exposure(_))));
    }
}

#[test]
fn values_that_are_not_finite_are_magenta() {
    let bad = [[0.1, f32::NAN, 0.1], [f32::INFINITY, 0.0, 0.0], [0.0, 0.0, f32::NEG_INFINITY], [0.5; 3]];
    let picture = Picture::from_linear(2, 2, &bad, 1.0).unwrap();
    assert_eq!(picture.pixels()[..3], [NOT_FINITE; 3]);
    assert_ne!(picture.pixels()[3], NOT_FINITE);
}

#[test]
fn what_is_ready_for_a_display_is_encoded_alone() {
    let picture = Picture::from_display(3, 1, &[[0.0, 0.5, 1.0], [-1.0, 7.0, 0.002], [0.5, f32::NAN, 0.5]]).unwrap();
    assert_eq!(picture.pixels(), [[0, 188, 255], [0, 255, 7], NOT_FINITE]);
    assert!(matches!(Picture::from_display(2, 2, &[[0.0; 3]; 3]), Err(PictureError::Length { .. })));
}

#[test]
fn crop_upscale_and_paste() {
    let picture = gradient(10, 6);
    let region = Region { x: 3, y: 2, width: 4, height: 3 };
    let crop = picture.crop(region).unwrap();
    assert_eq!([crop.width(), crop.height()], [4, 3]);
    assert_eq!(crop.pixel(1, 2), picture.pixel(4, 4));
    let large = crop.upscale(3).unwrap();
    assert_eq!([large.width(), large.height()], [12, 9]);
    assert!((0..12).all(|x| (0..9).all(|y| large.pixel(x, y) == crop.pixel(x / 3, y / 3))));
    let mut target = Picture::filled(5, 5, [1; 3]).unwrap();
    target.paste(&crop, 3, 3);
    target.paste(&crop, 7, 9);
    assert_eq!(target.pixel(4, 4), crop.pixel(1, 1));
    assert_eq!(target.pixel(2, 4), Some([1; 3]));
    for (x, y, width, height) in [(7, 0, 4, 1), (0, 4, 1, 3), (0, 0, 0, 1), (u32::MAX, 0, 2, 1)] {
        let error = picture.crop(Region { x, y, width, height }).unwrap_err();
        assert!(matches!(error, PictureError::Region { .. }), "{error}");
    }
}

#[test]
fn empty_and_wrong_sizes_are_errors() {
    assert!(matches!(Picture::from_linear(0, 0, &[], 1.0), Err(PictureError::Empty { .. })));
    assert!(matches!(Picture::filled(3, 0, [0; 3]), Err(PictureError::Empty { .. })));
    assert!(matches!(Picture::filled(u32::MAX, 2, [0; 3]), Err(PictureError::TooLarge { .. })));
    assert!(matches!(Picture::from_linear(2, 2, &[[0.0; 3]; 3], 1.0), Err(PictureError::Length { needed: 4, .. })));
    assert!(matches!(gradient(2, 2).upscale(0), Err(PictureError::Zero(_))));
    assert!(matches!(gradient(2, 2).upscale(u32::MAX), Err(PictureError::TooLarge { .. })));
}

#[test]
fn encoding_goes_both_ways() {
    for code in 0..=255u8 {
        assert_eq!(srgb_8bit(from_srgb_8bit(code)), code);
    }
    assert_eq!([-1.0, 0.0, 1.0, 7.0].map(srgb_8bit), [0, 0, 255, 255]);
}
