//! glTF files of any strides, graphs, counts and URIs.

use crate::sequence::replace;
use crate::{Choices, Outcome};
use atrous_engine::{Scene, SceneOptions};
use std::path::Path;

const NAME: &str = "random.gltf";

/// Writes the buffer that scenes are made of.
pub fn prepare(folder: &Path) {
    // Small numbers, as floats and as indices.
    let bytes: Vec<u8> = (0..36).flat_map(|i: u16| [0, 0, 128 * (i as u8 % 2), 63 * (i as u8 % 3 / 2)]).collect();
    std::fs::write(folder.join("beside.bin"), bytes).expect("a file");
}

/// Makes a file of the bytes, in a folder that was prepared, and loads it.
pub fn attack(folder: &Path, bytes: &[u8]) -> Outcome {
    let path = folder.join(NAME);
    let text = scene(&mut Choices::new(bytes));
    replace(&path, text.as_bytes());
    match Scene::load(path.to_str().expect("UTF-8"), &SceneOptions::default()) {
        Ok(scene) => {
            assert!(!scene.instances.is_empty(), "a scene of nothing: {text}");
            Outcome::Used
        }
        Err(error) => {
            assert!(error.to_string().contains(NAME), "no file name in: {error}\n{text}");
            Outcome::Refused
        }
    }
}

fn list(count: usize, mut item: impl FnMut(usize) -> String) -> String {
    (0..count).map(&mut item).collect::<Vec<_>>().join(",")
}

/// Mostly an index that there is.
fn index(choices: &mut Choices<'_>, count: usize) -> usize {
    match choices.below(100) {
        0 => count,
        1 => usize::MAX / 2,
        _ => choices.below(count),
    }
}

/// Mostly `usual`.
fn number(choices: &mut Choices<'_>, usual: u64) -> u64 {
    match choices.below(80) {
        0 => 0,
        1 => u64::from(choices.odd()) << 32 | u64::from(choices.odd()),
        2 => 1 << choices.below(40),
        3 => usual.saturating_sub(1),
        4 => usual + 1,
        _ => usual,
    }
}

fn nodes(choices: &mut Choices<'_>, count: usize) -> String {
    let tree = choices.below(10) > 0;
    list(count, |node| {
        let mut fields = vec![format!(r#""mesh":{}"#, index(choices, 2))];
        if tree && node + 1 < count && choices.below(3) > 0 {
            fields.push(format!(r#""children":[{}]"#, node + 1));
        } else if !tree {
            let children = 1 + choices.below(3);
            fields.push(format!(r#""children":[{}]"#, list(children, |_| index(choices, count).to_string())));
        }
        if choices.one_in(30) {
            fields.push(format!(r#""scale":[{},1,1]"#, choices.one_of(&["0", "1e38", "-1", "1e-40"])));
        }
        format!("{{{}}}", fields.join(","))
    })
}

fn uri(choices: &mut Choices<'_>) -> &'static str {
    let odd =
        ["../beside.bin", "/dev/zero", "file:///dev/zero", "%2e%2e/beside.bin", "", "%ff", "data:;base64,AAAA", "data:,", "."];
    if choices.one_in(8) {
        choices.one_of(&odd)
    } else {
        "beside.bin"
    }
}

fn views(choices: &mut Choices<'_>) -> String {
    list(3, |_| {
        let stride = if choices.one_in(2) { format!(r#","byteStride":{}"#, number(choices, 12)) } else { String::new() };
        let offset = if choices.one_in(6) { number(choices, 4) } else { 0 };
        let (buffer, length) = (index(choices, 1), number(choices, 120));
        format!(r#"{{"buffer":{buffer},"byteOffset":{offset},"byteLength":{length}{stride}}}"#)
    })
}

fn accessors(choices: &mut Choices<'_>) -> String {
    let kinds = [(5126, "VEC3"), (5126, "VEC3"), (5123, "SCALAR"), (5126, "VEC2")];
    list(4, |i| {
        let (kind, dimensions) = if choices.one_in(40) { choices.one_of(&kinds) } else { kinds[i] };
        let offset = if choices.one_in(6) { number(choices, 4) } else { 0 };
        let (view, count) = (index(choices, 3), number(choices, 3));
        let range = r#""min":[0,0,0],"max":[1,1,1]"#;
        format!(
            r#"{{"bufferView":{view},"byteOffset":{offset},"componentType":{kind},"count":{count},"type":"{dimensions}",{range}}}"#
        )
    })
}

fn meshes(choices: &mut Choices<'_>) -> String {
    list(2, |_| {
        let mut attributes = format!(r#""POSITION":{}"#, if choices.one_in(40) { index(choices, 4) } else { 0 });
        if choices.one_in(2) {
            attributes += r#","NORMAL":1"#;
        }
        if choices.one_in(2) {
            attributes += r#","TEXCOORD_0":3"#;
        }
        let at = if choices.one_in(40) { 1 } else { 2 };
        let indices = if choices.one_in(2) { format!(r#","indices":{at}"#) } else { String::new() };
        let mode = if choices.one_in(4) { choices.below(8) } else { 4 };
        format!(r#"{{"primitives":[{{"attributes":{{{attributes}}},"mode":{mode}{indices}}}]}}"#)
    })
}

fn scene(choices: &mut Choices<'_>) -> String {
    let count = 1 + choices.below(12);
    let (views, accessors, meshes) = (views(choices), accessors(choices), meshes(choices));
    let images = if choices.one_in(6) { format!(r#""images":[{{"uri":"{}"}}],"#, uri(choices)) } else { String::new() };
    let roots = 1 + usize::from(choices.one_in(20));
    let roots = list(roots, |_| if choices.one_in(10) { index(choices, count) } else { 0 }.to_string());
    let (nodes, uri, length) = (nodes(choices, count), uri(choices), number(choices, 144));
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{roots}]}}],"nodes":[{nodes}],"meshes":[{meshes}],{images}
        "buffers":[{{"uri":"{uri}","byteLength":{length}}}],"bufferViews":[{views}],"accessors":[{accessors}]}}"#
    )
}
