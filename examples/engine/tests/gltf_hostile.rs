//! glTF files that want to do harm: each is an error that names the file and what is wrong with it, soon and in little memory.

use std::fs;
use std::path::{Path, PathBuf};

use atrous_engine::{Error, Scene, SceneOptions};

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("hostile_{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn load(path: &Path) -> Result<Scene, Error> {
    Scene::load(path.to_str().expect("UTF-8"), &SceneOptions::default())
}

fn trouble(path: &Path) -> String {
    let error = load(path).map(|_| ()).expect_err("an error");
    let message = error.to_string();
    let name = path.file_name().and_then(|name| name.to_str()).expect("a name");
    assert!(matches!(error, Error::SceneFile { .. }) && message.contains(name), "{message}");
    message
}

/// `count` corners on a line of text, as a buffer in the file itself.
fn data(count: usize) -> String {
    let bytes: Vec<u8> = (0..3 * count).flat_map(|i| (i as f32).to_le_bytes()).collect();
    let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let of = |group: &[u8]| {
        let bits = group.iter().fold(0u32, |bits, byte| bits << 8 | u32::from(*byte));
        [18, 12, 6, 0].map(|shift| char::from(digits[(bits >> shift & 63) as usize]))
    };
    format!("data:application/octet-stream;base64,{}", bytes.chunks_exact(3).flat_map(of).collect::<String>())
}

/// A scene whose nodes are `nodes`, with a mesh 0 of `count` corners in the buffer `uri`, read with `view` besides.
fn scene(nodes: &str, uri: &str, count: usize, view: &str) -> String {
    let bytes = 12 * count;
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "buffers":[{{"uri":"{uri}","byteLength":{bytes}}}],"bufferViews":[{{"buffer":0,"byteLength":{bytes}{view}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{count},"type":"VEC3","min":[0,0,0],"max":[9,9,9]}}]}}"#
    )
}

fn write(folder: &Path, content: &str) -> PathBuf {
    let path = folder.join("scene.gltf");
    fs::write(&path, content).expect("a file");
    path
}

const MESH: &str = r#"{"mesh":0}"#;

#[test]
fn a_stride_below_the_element_is_an_error() {
    let folder = folder("stride");
    for stride in 0..=16 {
        let view = format!(r#","byteStride":{stride}"#);
        // The last element of three ends within the view, whatever the stride is.
        let path = write(&folder, &scene(MESH, &data(6), 6, &view).replace(r#""count":6"#, r#""count":3"#));
        match load(&path) {
            Ok(scene) => assert!(stride >= 12 && scene.meshes[0].triangles.len() == 1, "{stride}"),
            Err(_) => {
                let message = trouble(&path);
                assert!(stride < 12 && message.contains("byteStride"), "{stride}: {message}");
            }
        }
    }
}

#[test]
fn nodes_that_are_no_tree_are_an_error() {
    let folder = folder("nodes");
    // Each node twice the child of the one before: 2^40 visits.
    let doubled: Vec<String> = (1..40).map(|i| format!(r#"{{"mesh":0,"children":[{i},{i}]}}"#)).chain([MESH.into()]).collect();
    let two_parents = r#"{"children":[1,2]},{"children":[3]},{"children":[3]},{"mesh":0}"#;
    let circle = r#"{"children":[1]},{"children":[0]}"#;
    let itself = r#"{"mesh":0,"children":[0]}"#;
    for nodes in [&doubled.join(","), two_parents, circle, itself] {
        let message = trouble(&write(&folder, &scene(nodes, &data(3), 3, "")));
        assert!(message.contains("no tree"), "{message}");
    }
    let roots = scene(MESH, &data(3), 3, "").replace(r#""nodes":[0]"#, r#""nodes":[0,0]"#);
    assert!(trouble(&write(&folder, &roots)).contains("node 0 twice"));
    let absent = scene(r#"{"children":[7]}"#, &data(3), 3, "");
    assert!(trouble(&write(&folder, &absent)).contains("child 7"));
    let deep: Vec<String> = (1..1000).map(|i| format!(r#"{{"children":[{i}]}}"#)).chain([MESH.into()]).collect();
    assert!(trouble(&write(&folder, &scene(&deep.join(","), &data(3), 3, ""))).contains("128 levels"));
}

#[test]
fn much_out_of_little_is_an_error() {
    let folder = folder("much");
    let corners = 30_000;
    let whole = scene(MESH, &data(corners), corners, "");
    let primitive = r#"{"attributes":{"POSITION":0}}"#;
    let primitives = vec![primitive; 2000].join(",");
    let message = trouble(&write(&folder, &whole.replace(primitive, &primitives)));
    assert!(message.contains("its meshes have 60000000 corners"), "{message}");
    let children: Vec<String> = (1..2000).map(|i| i.to_string()).collect();
    let nodes = format!(r#"{{"children":[{}]}},{}"#, children.join(","), vec![MESH; 1999].join(","));
    let message = trouble(&write(&folder, &scene(&nodes, &data(corners), corners, "")));
    assert!(message.contains("its nodes have 59970000 corners"), "{message}");
    // Few of them are one mesh of ours, and many instances.
    let few = scene(r#"{"children":[1,2]},{"mesh":0},{"mesh":0}"#, &data(3), 3, "");
    let few = load(&write(&folder, &few)).expect("a scene");
    assert_eq!((few.meshes.len(), few.instances.len()), (1, 2));
}

#[test]
fn files_elsewhere_are_not_read() {
    let folder = folder("uris");
    let (inner, bytes) = (folder.join("inner"), vec![0; 36]);
    fs::create_dir_all(inner.join("below")).expect("a folder");
    for path in ["outside.bin", "inner/beside.bin", "inner/below/a b.bin"] {
        fs::write(folder.join(path), &bytes).expect("a file");
    }
    for uri in ["beside.bin", "./below/a%20b.bin"] {
        load(&write(&inner, &scene(MESH, uri, 3, ""))).expect("a scene");
    }
    let absolute = folder.join("outside.bin").display().to_string();
    let file = format!("file://{absolute}");
    for uri in ["../outside.bin", "below/../../outside.bin", "%2e%2e/outside.bin", &absolute, &file, "http://host/a.bin", "", "%ff"]
    {
        let message = trouble(&write(&inner, &scene(MESH, uri, 3, "")));
        assert!(message.contains("refers to") && message.contains("relative names"), "{uri}: {message}");
        let image = format!(r#""images":[{{"uri":"{uri}"}}],"accessors""#);
        let message = trouble(&write(&inner, &scene(MESH, "beside.bin", 3, "").replace(r#""accessors""#, &image)));
        assert!(message.contains("refers to") && message.contains("relative names"), "{uri}: {message}");
    }
}

#[cfg(unix)]
#[test]
fn pipes_devices_and_links_are_not_read() {
    use std::os::unix::fs::symlink;
    let folder = folder("devices");
    fs::create_dir_all(folder.join("inner")).expect("a folder");
    fs::write(folder.join("outside.bin"), vec![0; 36]).expect("a file");
    let inner = folder.join("inner");
    for (name, target, word) in [("zero", "/dev/zero", "a device"), ("out", "../outside.bin", "out of the folder")] {
        symlink(target, inner.join(name)).expect("a link");
        let message = trouble(&write(&inner, &scene(MESH, name, 3, "")));
        assert!(message.contains(name) && message.contains(word), "{message}");
    }
    let endless = inner.join("endless.glb");
    symlink("/dev/zero", &endless).expect("a link");
    assert!(trouble(&endless).contains("a device"));
    let long = fs::File::create(inner.join("long.bin")).expect("a file");
    long.set_len(1 << 40).expect("a sparse file");
    assert!(trouble(&write(&inner, &scene(MESH, "long.bin", 3, ""))).contains("are allowed"));
}
