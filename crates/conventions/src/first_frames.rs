//! The check as the executor makes it, of the guides that it reads back itself.

use crate::{check, OwnedGuides, Verdict};
use atrous::capture::{InputFrame, InputImage};
use atrous::config::Conventions;
use atrous::executor::{GuideVerdict, Readback};
use atrous::reference::Image;
use atrous::Error;

/// Checks two consecutive frames: for `ExecutorOptions::check_guides`.
pub fn check_frames(conventions: &Conventions, previous: &InputFrame<'_>, current: &InputFrame<'_>) -> GuideVerdict {
    let report = || {
        let [previous, current] = [guides(previous)?, guides(current)?];
        let (Some(previous), Some(current)) = (previous, current) else { return Ok(None) };
        check(conventions, &previous.borrow(), &current.borrow()).map(Some)
    };
    match report() {
        Ok(Some(report)) if report.complains() => GuideVerdict::Mistaken(report.to_string()),
        Ok(Some(report)) if report.findings().iter().all(|(_, finding)| tells(finding.verdict)) => GuideVerdict::Sound,
        Ok(_) => GuideVerdict::Inconclusive,
        Err(error) => GuideVerdict::Mistaken(error.to_string()),
    }
}

fn tells(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Agrees | Verdict::Absent)
}

/// The guides of a frame; none without a depth.
fn guides(frame: &InputFrame<'_>) -> Result<Option<OwnedGuides>, Error> {
    let extent = frame.params.render_extent;
    let floats =
        |image: &InputImage<'_>| Readback { format: image.format, bytes: image.texels.len() as u64 }.to_floats(image.texels);
    let named = |name: &str| frame.images.iter().find(|image| image.name == name).map(floats);
    let image = |name: &str| named(name).map(|texels| Image::from_texels(extent, texels)).transpose();
    let Some(depth) = image("depth")? else { return Ok(None) };
    let ids = named("surface_id").map(|texels| texels.iter().map(|texel| texel[0] as u32).collect());
    Ok(Some(OwnedGuides {
        params: *frame.params,
        depth,
        normal: image("normal")?,
        motion: image("motion")?,
        surface_id: ids.map(|ids| Image::from_texels(extent, ids)).transpose()?,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use atrous::ash::vk::Format;
    use atrous::config::MotionDirection;
    use atrous::{FrameParams, Tuning};
    use atrous_synthetic as synthetic;

    /// The answer for two frames of the synthetic scene, as the executor reads them back.
    fn answer(conventions: &Conventions, indices: [u32; 2]) -> GuideVerdict {
        let tuning = Tuning::default();
        let frames = indices.map(synthetic::Frame::new);
        let bytes = frames.each_ref().map(|frame| [0, 1, 2].map(|image| synthetic::bytes(&frame.images[image])));
        let params = indices.map(|index| FrameParams {
            view_from_world: synthetic::view_from_world(index),
            clip_from_view: synthetic::clip_from_view(),
            ..FrameParams::new(synthetic::EXTENT)
        });
        let images = bytes.each_ref().map(|bytes| {
            [0, 1, 2].map(|i| InputImage { name: synthetic::NAMES[i], format: Format::R32G32B32A32_SFLOAT, texels: &bytes[i] })
        });
        let frame = |i: usize| InputFrame {
            index: i as u64,
            params: &params[i],
            tuning: &tuning,
            images: &images[i],
            instance_transforms: None,
        };
        check_frames(conventions, &frame(0), &frame(1))
    }

    #[test]
    fn mistakes_are_told_and_sound_guides_are_not_mistaken() {
        let declared = Conventions::default();
        assert!(!matches!(answer(&declared, [1, 2]), GuideVerdict::Mistaken(_)));
        assert_eq!(answer(&declared, [2, 2]), GuideVerdict::Inconclusive, "nothing moves");
        let wrong = Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..declared };
        let GuideVerdict::Mistaken(text) = answer(&wrong, [1, 2]) else { panic!("{:?}", answer(&wrong, [1, 2])) };
        assert!(text.contains("the motion has the opposite sign"), "{text}");
    }
}
