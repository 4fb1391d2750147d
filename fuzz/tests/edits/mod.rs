//! Edits of files that make sense, so that most of them nearly do.

#![allow(dead_code)] // Each program of tests edits files of its own kind.

use fastrand::Rng;
use serde_json::{json, Value};

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
fn edit(value: &mut Value, rng: &mut Rng) {
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
                (_, Some(inner)) => edit(inner, rng),
                _ => {}
            }
        }
        Value::Array(items) if !items.is_empty() && !here => {
            let at = rng.usize(..items.len());
            match rng.u8(..8) {
                0 => _ = items.remove(at),
                1 => items.push(items[at].clone()),
                _ => edit(&mut items[at], rng),
            }
        }
        other => *other = odd(rng),
    }
}

/// One of the descriptions, changed in a few places.
pub fn description(seeds: &[Value], rng: &mut Rng) -> Vec<u8> {
    let mut value = rng.choice(seeds).expect("a description").clone();
    (0..1 + rng.u8(..3)).for_each(|_| edit(&mut value, rng));
    let mut text = value.to_string().into_bytes();
    if rng.u8(..8) == 0 {
        let at = rng.usize(..text.len());
        text[at] = rng.u8(..);
    }
    text
}

/// An EXR file with other bytes in a few places.
pub fn bytes(seed: &[u8], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..1 + rng.u8(..4) {
        // Most of what decides is in the header.
        let end = if rng.bool() { 400.min(bytes.len()) } else { bytes.len() };
        let at = rng.usize(..end);
        match rng.u8(..6) {
            0 => bytes[at] = rng.u8(..),
            1 => bytes[at] ^= 1 << rng.u8(..8),
            2 => bytes[at] = rng.choice([0, 1, 0x7f, 0x80, 0xff]).unwrap_or(0),
            3 => {
                let value = rng.choice([0u32, 1, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff, 1 << 20]).unwrap_or(0).to_le_bytes();
                let end = (at + 4).min(bytes.len());
                bytes[at..end].copy_from_slice(&value[..end - at]);
            }
            4 => bytes.truncate(at.max(1)),
            _ => {
                let (from, count) = (rng.usize(..bytes.len()), rng.usize(..16));
                let copied: Vec<u8> = bytes[from..(from + count).min(bytes.len())].to_vec();
                let end = (at + copied.len()).min(bytes.len());
                bytes[at..end].copy_from_slice(&copied[..end - at]);
            }
        }
    }
    bytes
}

/// An EXR file with other numbers in its windows and channels.
pub fn windows(seed: &[u8], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    let keys: [&[u8]; 3] = [b"dataWindow\0box2i\0", b"displayWindow\0box2i\0", b"channels\0chlist\0"];
    for _ in 0..1 + rng.u8(..3) {
        let key = keys[rng.usize(..3)];
        let start = bytes.windows(key.len()).position(|w| w == key).map_or(0, |at| at + key.len() + 4);
        let at = start + 4 * rng.usize(..4);
        let value = rng.choice([0, 1, 7, 63, 255, 1023, 4095, 8191, 16383, 70_000, i32::MAX, -1, -100, i32::MIN]).unwrap_or(0);
        if let Some(place) = bytes.get_mut(at..at + 4) {
            place.copy_from_slice(&value.to_le_bytes());
        }
    }
    bytes
}
