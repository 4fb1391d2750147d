//! Width and height in one word.

use atrous::Config;

/// Width and height in pixels, such as `320x180`: a parser for clap.
///
/// # Errors
/// Text of a different form, and sides that no [`Config`] takes.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let parsed = parsed.filter(|sides: &[u32; 2]| sides.iter().all(|side| (1..=Config::MAX_SIDE).contains(side)));
    let largest = Config::MAX_SIDE;
    parsed.ok_or_else(|| format!("\"{text}\" is no size: give width and height like 320x180, each from 1 to {largest}"))
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn a_size_has_two_sides_that_an_image_may_have() {
        assert_eq!(size("320x180"), Ok([320, 180]));
        for wrong in ["320", "320x", "0x180", "320x99999", "320x-1", "320x180x2", "a few"] {
            let error = size(wrong).expect_err(wrong);
            assert!(error.contains(wrong) && error.contains("320x180") && error.contains("16384"), "{error}");
        }
    }
}
