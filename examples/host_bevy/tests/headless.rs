//! The program as a whole, on whatever Vulkan device there is, under the validation layer with synchronisation validation.

use std::process::Command;

fn output(arguments: &[&str]) -> String {
    let enables = "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT:VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    let mut command = Command::new(env!("CARGO_BIN_EXE_host_bevy"));
    command
        .args(arguments)
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env("VK_LAYER_ENABLES", enables)
        .env("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "1");
    let output = command.output().expect("a process");
    let text = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat();
    assert!(output.status.success(), "{}\n{text}", output.status);
    text
}

/// The number behind a phrase.
fn number(text: &str, phrase: &str) -> f64 {
    let word = text.split_once(phrase).and_then(|(_, behind)| behind.split_whitespace().next());
    word.and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("no number behind {phrase}:\n{text}"))
}

/// What the check says of declarations that are wrong, of a matrix, and of jitter.
const MISTAKES: [&str; 5] = [
    "the motion has the opposite sign",
    "y of the motion points down",
    "the normals are encoded as xyz_unorm",
    "y of clip_from_view points up",
    "the jitter has the opposite sign",
];

fn shows_what_is_denoised(arguments: &[&str]) {
    let text = output(arguments);
    assert!(!text.contains("Validation"), "{text}");
    for guide in ["depth and matrices", "motion", "normals"] {
        // Without and with jitter.
        assert_eq!(text.matches(&format!("{guide}: as declared")).count(), 2, "{guide}:\n{text}");
    }
    for mistake in MISTAKES {
        assert!(text.contains(mistake), "{mistake}:\n{text}");
    }
    assert!(number(&text, "at most") <= 1.0, "{text}");
    assert_eq!(number(&text, "by atrous-denoise:"), f64::from(320 * 180), "{text}");
    // All but pixels of edges, where a mesh is no sphere.
    assert!(number(&text, "albedo of the denoiser:") > 0.98, "{text}");
    assert!(6.0 * number(&text, "RMSE denoised") < number(&text, "RMSE noisy"), "{text}");
}

#[test]
fn bevy_shows_what_is_denoised_by_the_guides_of_its_prepass() {
    shows_what_is_denoised(&[]);
}

/// Albedo and normals of the deferred G-buffer, light in the main texture of the camera.
#[test]
fn what_solari_leaves_is_denoised() {
    shows_what_is_denoised(&["--like-solari"]);
}
