//! The program as a whole, on a device with ray queries, under the validation layer.

use std::process::Command;

/// The number behind a phrase.
fn number(text: &str, phrase: &str) -> f64 {
    let word = text.split_once(phrase).and_then(|(_, behind)| behind.split_whitespace().next());
    word.and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("no number behind {phrase}:\n{text}"))
}

#[test]
fn solari_is_denoised_and_its_capture_replayed() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_solari"));
    let output = command.env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation").output().expect("a process");
    let text = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat();
    assert!(output.status.success(), "{}\n{text}", output.status);
    // A layer that is older than a structure of wgpu says so once.
    let is_of_age = |line: &str| line.contains("VUID-VkDeviceCreateInfo-pNext-pNext");
    let messages: Vec<&str> = text.lines().filter(|line| line.contains("Validation Error") && !is_of_age(line)).collect();
    assert!(messages.is_empty(), "{messages:?}");
    assert!(number(&text, "at most") <= 1.0, "{text}");
    assert_eq!(number(&text, "by atrous-denoise:"), f64::from(160 * 90), "{text}");
    assert!(4.0 * number(&text, "RMSE denoised") < number(&text, "RMSE noisy"), "{text}");
}
