//! Descriptions of sequences with odd values in odd places end in an error that says where, or in a set-up.

use crate::samples::{frame_path, sequence};
use atrous_denoise::memory::{Demands, Need};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{camera, frame, frame_files};
use fastrand::Rng;
use serde_json::{json, Value};
use std::path::Path;

/// A capture with nothing at its default, and the least that there is.
fn corpus() -> [Value; 2] {
    let capture = include_str!("../../../../src/capture/old_sequence.json");
    let unit = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    [serde_json::from_str(capture).expect("JSON"), json!({ "frames": [{ "view": unit, "proj": unit }] })]
}

fn odd(rng: &mut Rng) -> Value {
    let nested = (0..100).fold(json!(0), |inner, _| json!([inner]));
    let values = [
        json!(null),
        json!(true),
        json!(-1),
        json!(0),
        json!(u64::MAX),
        json!(1e308),
        json!(-1e-320),
        json!(0.5),
        json!(""),
        json!("asvgf"),
        json!("\u{1F600}"),
        json!("x".repeat(5000)),
        json!([]),
        json!({}),
        json!({ "i": 0 }),
        nested,
    ];
    rng.choice(values).unwrap_or_default()
}

/// Replaces, removes or repeats something below `value`.
fn mutate(value: &mut Value, rng: &mut Rng) {
    let here = rng.u8(..6) == 0;
    match value {
        Value::Object(fields) if !fields.is_empty() && !here => {
            let key = rng.choice(fields.keys().cloned()).unwrap_or_default();
            match (rng.u8(..8), fields.get_mut(&key)) {
                (0, _) => _ = fields.remove(&key),
                (1, Some(inner)) => {
                    let inner = inner.clone();
                    fields.insert(rng.choice(["index", "reset", "alpha", "preset", "é"]).unwrap_or("").to_owned(), inner);
                }
                (_, Some(inner)) => mutate(inner, rng),
                _ => {}
            }
        }
        Value::Array(items) if !items.is_empty() && !here => {
            let at = rng.usize(..items.len());
            match rng.u8(..8) {
                0 => _ = items.remove(at),
                1 => items.push(items[at].clone()),
                _ => mutate(&mut items[at], rng),
            }
        }
        other => *other = odd(rng),
    }
}

/// The whole way from a description to a frame.
fn used(folder: &Path) -> atrous_denoise::error::Result<()> {
    let files = frame_files::find(&[folder.to_owned()])?;
    let setup = Setup::new(&files, &Options::default())?;
    Need::new(&setup, &Demands { frames: 1, filtered: true, ..Demands::default() })?;
    frame::load(&files[0], &setup).map(|_| ())
}

/// `ATROUS_FUZZ=1000000` runs longer than the default.
#[test]
fn mutated_descriptions_are_errors_or_frames() {
    let count = std::env::var("ATROUS_FUZZ").ok().and_then(|v| v.parse().ok()).unwrap_or(400u64);
    let (input, corpus) = (sequence(1), corpus());
    let path = input.path().join("sequence.json");
    assert!(frame_path(input.path(), 0).exists());
    let (mut good, mut bad) = (0u64, 0u64);
    for round in 0..count {
        let mut rng = Rng::with_seed(round);
        let mut value = rng.choice(&corpus).expect("a seed").clone();
        (0..1 + rng.u8(..3)).for_each(|_| mutate(&mut value, &mut rng));
        let mut text = value.to_string().into_bytes();
        if rng.u8(..8) == 0 {
            let at = rng.usize(..text.len());
            text[at] = rng.u8(..);
        }
        // Some file systems flush a file that is written over.
        let _ = std::fs::remove_file(&path);
        std::fs::write(&path, &text).expect("a file");
        match std::panic::catch_unwind(|| used(input.path())) {
            Ok(Ok(())) => good += 1,
            Ok(Err(error)) => {
                assert!(!error.to_string().is_empty());
                bad += 1;
            }
            Err(_) => panic!("round {round} panicked"),
        }
        if let Ok(text) = String::from_utf8(text) {
            if let Err(error) = camera::parse(&path, &text) {
                assert!(error.to_string().contains("sequence.json"), "round {round}: no file name in: {error}");
            }
        }
    }
    assert!(good > 0 && bad > 0, "{good} good, {bad} bad");
}
