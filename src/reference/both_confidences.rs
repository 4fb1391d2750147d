//! Confidence in the histories of diffuse and of specular light in one number. Read as it is, it is that of diffuse light, less a part in 4096
//! at most.

/// Bits of specular light: steps of 1/2048, the last of which is 1.
const SPECULAR_BITS: u32 = 0x7ff;

/// The largest number that stays below 1 with any of them.
const MOST_OF_DIFFUSE: u32 = 0x3f7f_f800;

/// No denormal, which a device may take for 0.
const LEAST_OF_DIFFUSE: f32 = 1.0 / 1_048_576.0;

pub(crate) fn both_confidences(diffuse: f32, specular: f32) -> f32 {
    let upper = (diffuse.max(LEAST_OF_DIFFUSE).to_bits() & !SPECULAR_BITS).min(MOST_OF_DIFFUSE);
    f32::from_bits(upper | ((specular * 2048.0 + 0.5) as u32).min(SPECULAR_BITS))
}

/// By how much diffuse light changed, of the confidence in its history: 0 and 1 are exact with anything beside them.
pub(crate) fn change_by(confidence: f32) -> f32 {
    match confidence {
        c if c >= f32::from_bits(MOST_OF_DIFFUSE) => 0.0,
        c if c < 2.0 * LEAST_OF_DIFFUSE => 1.0,
        c => 1.0 - c,
    }
}

pub(crate) fn specular_confidence(both: f32) -> f32 {
    match both.to_bits() & SPECULAR_BITS {
        SPECULAR_BITS => 1.0,
        steps => steps as f32 / 2048.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_confidence_is_next_to_what_it_was() {
        let all = || [0.0, 1e-7, 0.001, 0.25, 0.4999, 0.75, 0.9999, 1.0];
        for diffuse in all() {
            for specular in all() {
                let both = both_confidences(diffuse, specular);
                assert!(both.is_normal() && both < 1.0 && (both - diffuse).abs() <= 1.0 / 4096.0, "{diffuse} {specular}: {both}");
                assert!((specular_confidence(both) - specular).abs() <= 1.0 / 2048.0, "{diffuse} {specular}");
            }
            for specular in [0.0, 0.3, 1.0] {
                let exact = [0.0, 1.0].map(|diffuse| change_by(both_confidences(diffuse, specular)));
                assert_eq!(exact, [1.0, 0.0], "{specular}");
            }
            assert_eq!([0.0, 1.0].map(|specular| specular_confidence(both_confidences(diffuse, specular))), [0.0, 1.0]);
        }
    }
}
