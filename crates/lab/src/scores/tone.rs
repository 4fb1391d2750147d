//! The tone curve of the metrics that are about what a viewer sees.

/// Maps linear radiance to [0, 1]: `(x / (1 + x))^(1 / 2.2)`, negative values to 0.
///
/// NaN maps to 0 and infinity to NaN; the images that the metrics take contain neither.
pub fn tone_map(x: f32) -> f32 {
    let x = x.max(0.0);
    (x / (1.0 + x)).powf(1.0 / 2.2)
}

/// [`tone_map`] of each channel.
pub(super) fn tone_map_rgb(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(tone_map)
}
