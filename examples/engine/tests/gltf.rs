//! glTF files: a whole one is seen, and a broken one is an error that names the file and the trouble.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use atrous_engine::testing::{render, tracer, Validated};
use atrous_engine::{Error, Scene, SceneOptions, TracerOptions};

fn file(name: &str, content: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, content).expect("a temporary file");
    path
}

fn load(path: &std::path::Path) -> Result<Scene, Error> {
    Scene::load(path.to_str().expect("UTF-8"), &SceneOptions::default())
}

/// The message of a file's error, which must name the file.
fn trouble(path: &std::path::Path) -> String {
    let error = load(path).map(|_| ()).expect_err("an error");
    let message = error.to_string();
    let name = path.file_name().and_then(|name| name.to_str()).expect("a name");
    assert!(matches!(error, Error::SceneFile { .. }) && message.contains(name), "{message}");
    message
}

/// One triangle: positions, then indices, in a buffer beside the file.
fn triangle(name: &str, indices: [u16; 3], buffer_bytes: usize, count: usize) -> PathBuf {
    let positions: [f32; 9] = [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0];
    let mut bytes: Vec<u8> = positions.iter().flat_map(|value| value.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
    bytes.truncate(buffer_bytes);
    file(&format!("{name}.bin"), &bytes);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "buffers":[{{"uri":"{name}.bin","byteLength":42}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{count},"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}},
        {{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}]}}"#
    );
    file(&format!("{name}.gltf"), json.as_bytes())
}

#[test]
fn a_triangle_is_seen_and_lit() {
    let Some(gpu) = Validated::new() else { return };
    let scene = load(&triangle("whole", [0, 1, 2], 42, 3)).expect("a scene");
    assert_eq!((scene.meshes.len(), scene.meshes[0].triangles.len(), scene.lamps.len()), (1, 1, 1));
    let mut tracer = tracer(&gpu, &Arc::new(scene), TracerOptions::default());
    render(&gpu, &mut tracer, 0);
    assert!(gpu.0.read_image_u32(&tracer.outputs().surface_id).expect("ids").contains(&1));
    let direct = gpu.0.read_image(&tracer.outputs().direct).expect("direct");
    assert!(direct.iter().any(|pixel| pixel[0] > 0.0));
}

#[test]
fn a_missing_file_is_an_error() {
    let message = trouble(&PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("nowhere.glb"));
    assert!(message.contains("cannot be read") && message.contains("Check the path"), "{message}");
}

#[test]
fn garbage_and_emptiness_are_errors() {
    for (name, content) in
        [("garbage.gltf", &b"\x00\xffnot json"[..]), ("garbage.glb", b"glTF\x02\x00\x00\x00junk"), ("empty.glb", b"")]
    {
        assert!(trouble(&file(name, content)).contains("whole glTF 2.0 file"));
    }
}

/// The triangle as one binary file.
fn binary_triangle(name: &str) -> Vec<u8> {
    let path = triangle(name, [0, 1, 2], 42, 3);
    let json = fs::read_to_string(&path).expect("the file");
    let mut chunk = json.replace(&format!(r#""uri":"{name}.bin","#), "").into_bytes();
    chunk.resize(chunk.len().next_multiple_of(4), b' ');
    let mut binary = fs::read(path.with_extension("bin")).expect("the buffer");
    binary.resize(44, 0);
    let mut whole = b"glTF\x02\x00\x00\x00".to_vec();
    whole.extend(((12 + 8 + chunk.len() + 8 + binary.len()) as u32).to_le_bytes());
    for (kind, data) in [(b"JSON", &chunk), (b"BIN\0", &binary)] {
        whole.extend((data.len() as u32).to_le_bytes());
        whole.extend(kind);
        whole.extend(data);
    }
    whole
}

#[test]
fn a_truncated_binary_file_is_an_error_at_any_length() {
    let whole = binary_triangle("cut");
    load(&file("cut_whole.glb", &whole)).expect("the whole file is a scene");
    for length in [0, 4, 11, 12, 19, 40, 300, whole.len() - 60, whole.len() - 1] {
        trouble(&file(&format!("cut_{length}.glb"), &whole[..length]));
    }
}

/// Digits are exchanged for digits, so that most files are still JSON and the numbers in them are wrong.
#[test]
fn damaged_numbers_never_panic() {
    let whole = binary_triangle("damaged");
    let digits: Vec<usize> = (20..whole.len()).filter(|at| whole[*at].is_ascii_digit()).collect();
    let mut errors = 0;
    for at in digits {
        for digit in *b"0179" {
            let mut damaged = whole.clone();
            damaged[at] = digit;
            errors += usize::from(load(&file("damaged.glb", &damaged)).is_err());
        }
    }
    assert!(errors > 20, "only {errors} damaged files were noticed");
}

#[test]
fn missing_and_short_buffers_are_errors() {
    let path = triangle("short", [0, 1, 2], 20, 3);
    trouble(&path);
    fs::remove_file(path.with_extension("bin")).expect("the buffer");
    assert!(trouble(&path).contains("cannot be read"));
}

#[test]
fn accessors_and_indices_out_of_range_are_errors() {
    assert!(trouble(&triangle("index", [0, 1, 7], 42, 3)).contains("index 7 is out of range"));
    assert!(trouble(&triangle("count", [0, 1, 2], 42, 4000)).contains("reads past the end"));
}

#[test]
fn a_picture_out_of_range_is_an_error() {
    let path = triangle("picture", [0, 1, 2], 42, 3);
    let json = fs::read_to_string(&path).expect("the file");
    let view = r#"{"buffer":0,"byteOffset":36,"byteLength":6}"#;
    let more = format!(r#"{view},{{"buffer":0,"byteOffset":40,"byteLength":900}}"#);
    let images = r#""images":[{"bufferView":2,"mimeType":"image/png"}],"accessors""#;
    let damaged = json.replace(view, &more).replace(r#""accessors""#, images);
    assert!(trouble(&file("picture.gltf", damaged.as_bytes())).contains("past the end"));
}

#[test]
fn a_scene_of_nothing_is_an_error() {
    let nothing = br#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]}"#;
    assert!(trouble(&file("nothing.gltf", nothing)).contains("no triangles"));
    let no_scene = br#"{"asset":{"version":"2.0"}}"#;
    assert!(trouble(&file("no_scene.gltf", no_scene)).contains("no scene"));
}
