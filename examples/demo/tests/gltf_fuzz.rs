//! glTF files of random strides, graphs, counts and URIs: each is a scene, or an error that names the file.

use std::fs;
use std::path::{Path, PathBuf};

use atrous_demo::{Scene, SceneOptions};
use fastrand::Rng;

fn list(count: usize, mut item: impl FnMut(usize) -> String) -> String {
    (0..count).map(&mut item).collect::<Vec<_>>().join(",")
}

/// Mostly an index that there is.
fn index(rng: &mut Rng, count: usize) -> usize {
    match rng.u8(..100) {
        0 => count,
        1 => usize::MAX / 2,
        _ => rng.usize(..count.max(1)),
    }
}

/// Mostly `usual`.
fn number(rng: &mut Rng, usual: u64) -> u64 {
    match rng.u8(..80) {
        0 => 0,
        1 => rng.u64(..),
        2 => 1 << rng.u32(..40),
        3 => usual.saturating_sub(1),
        4 => usual + 1,
        _ => usual,
    }
}

fn nodes(rng: &mut Rng, count: usize) -> String {
    let tree = rng.u8(..10) > 0;
    list(count, |node| {
        let mut fields = vec![format!(r#""mesh":{}"#, index(rng, 2))];
        if tree && node + 1 < count && rng.u8(..3) > 0 {
            fields.push(format!(r#""children":[{}]"#, node + 1));
        } else if !tree {
            let children = 1 + rng.usize(..3);
            fields.push(format!(r#""children":[{}]"#, list(children, |_| index(rng, count).to_string())));
        }
        if rng.u8(..30) == 0 {
            fields.push(format!(r#""scale":[{},1,1]"#, rng.choice(["0", "1e38", "-1", "1e-40"]).unwrap_or("1")));
        }
        format!("{{{}}}", fields.join(","))
    })
}

fn uri(rng: &mut Rng) -> &'static str {
    let odd =
        ["../beside.bin", "/dev/zero", "file:///dev/zero", "%2e%2e/beside.bin", "", "%ff", "data:;base64,AAAA", "data:,", "."];
    if rng.u8(..8) == 0 {
        rng.choice(odd).unwrap_or("")
    } else {
        "beside.bin"
    }
}

fn scene(rng: &mut Rng) -> String {
    let count = 1 + rng.usize(..12);
    let kinds = [(5126, "VEC3"), (5126, "VEC3"), (5123, "SCALAR"), (5126, "VEC2")];
    let views = list(3, |_| {
        let stride = if rng.u8(..2) == 0 { format!(r#","byteStride":{}"#, number(rng, 12)) } else { String::new() };
        let offset = if rng.u8(..6) == 0 { number(rng, 4) } else { 0 };
        format!(r#"{{"buffer":{},"byteOffset":{offset},"byteLength":{}{stride}}}"#, index(rng, 1), number(rng, 120))
    });
    let accessors = list(4, |i| {
        let (kind, dimensions) = if rng.u8(..40) == 0 { kinds[rng.usize(..4)] } else { kinds[i] };
        let offset = if rng.u8(..6) == 0 { number(rng, 4) } else { 0 };
        format!(
            r#"{{"bufferView":{},"byteOffset":{offset},"componentType":{kind},"count":{},"type":"{dimensions}","min":[0,0,0],"max":[1,1,1]}}"#,
            index(rng, 3),
            number(rng, 3)
        )
    });
    let meshes = list(2, |_| {
        let mut attributes = format!(r#""POSITION":{}"#, if rng.u8(..40) == 0 { index(rng, 4) } else { 0 });
        if rng.bool() {
            attributes += r#","NORMAL":1"#;
        }
        if rng.bool() {
            attributes += r#","TEXCOORD_0":3"#;
        }
        let indices = if rng.bool() { format!(r#","indices":{}"#, if rng.u8(..40) == 0 { 1 } else { 2 }) } else { String::new() };
        let mode = if rng.u8(..4) == 0 { rng.u8(..8) } else { 4 };
        format!(r#"{{"primitives":[{{"attributes":{{{attributes}}},"mode":{mode}{indices}}}]}}"#)
    });
    let images = if rng.u8(..6) == 0 { format!(r#""images":[{{"uri":"{}"}}],"#, uri(rng)) } else { String::new() };
    let roots = list(1 + usize::from(rng.u8(..20) == 0), |_| if rng.u8(..10) == 0 { index(rng, count) } else { 0 }.to_string());
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{roots}]}}],"nodes":[{}],"meshes":[{meshes}],{images}
        "buffers":[{{"uri":"{}","byteLength":{}}}],"bufferViews":[{views}],"accessors":[{accessors}]}}"#,
        nodes(rng, count),
        uri(rng),
        number(rng, 144)
    )
}

fn load(path: &Path) -> Result<usize, String> {
    let scene = Scene::load(path.to_str().expect("UTF-8"), &SceneOptions::default()).map_err(|error| error.to_string())?;
    Ok(scene.instances.len())
}

/// `ATROUS_FUZZ=1000000` runs longer than the default.
#[test]
fn random_files_are_scenes_or_errors() {
    let count = std::env::var("ATROUS_FUZZ").ok().and_then(|v| v.parse().ok()).unwrap_or(4000u64);
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("gltf_fuzz");
    fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("random.gltf");
    // Small numbers, as floats and as indices.
    let bytes: Vec<u8> = (0..36).flat_map(|i: u16| [0, 0, 128 * (i as u8 % 2), 63 * (i as u8 % 3 / 2)]).collect();
    fs::write(folder.join("beside.bin"), bytes).expect("a file");
    let (mut good, mut bad) = (0u64, 0u64);
    for round in 0..count {
        let text = scene(&mut Rng::with_seed(round));
        // Some file systems flush a file that is written over.
        let _ = fs::remove_file(&path);
        fs::write(&path, &text).expect("a file");
        match std::panic::catch_unwind(|| load(&path)) {
            Ok(Ok(instances)) => {
                assert!(instances > 0, "round {round}");
                good += 1;
            }
            Ok(Err(message)) => {
                assert!(message.contains("random.gltf"), "round {round}: no file name in: {message}");
                bad += 1;
            }
            Err(_) => panic!("round {round} panicked: {text}"),
        }
    }
    assert!(good > count / 20 && bad > count / 20, "{good} good, {bad} bad");
}
