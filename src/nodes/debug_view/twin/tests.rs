//! Numbers behind the colours, what is missing, bars.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_moments, Reason};

const EXTENT: [u32; 2] = [16, 14];

/// A plane whose left half is background.
fn view(view: DebugView, moments: &Moments, statistics: &Statistics) -> Image<[f32; 4]> {
    let guides = guides(EXTENT, |x, _| if x < 8 { surface(0.0) } else { surface(3.0) });
    let moments = Image::new(EXTENT, pack_moments(moments));
    let inputs = DebugViewInputs {
        guide: &guides.guide,
        surface_motion: &guides.surface_motion,
        statistics,
        moments: &[&moments],
        irradiance_history: &[],
        history_confidence: None,
        gradient: None,
        stratum_size: 3,
        block_percentiles: &[],
        noisy: &[],
        reflection: None,
        albedo: None,
    };
    debug_view(&frame(EXTENT), &Tuning { alpha: 0.2, ..Tuning::default() }, &inputs, view)
}

#[test]
fn alpha_holds_the_number_and_the_background_is_black() {
    let moments = Moments { mean: 1.0, deviation: 0.5, history_length: 4.0, reason: Reason::Depth as u16 };
    for (shown, number) in [
        (DebugView::HistoryLength, 4.0),
        (DebugView::Moments, 1.0),
        (DebugView::Alpha, 0.25),
        (DebugView::Disocclusion, 3.0),
        (DebugView::Depth, 3.0),
    ] {
        let image = view(shown, &moments, &Statistics::default());
        assert_eq!(image.get(12, 3).map(|t| t[3]), Some(number), "{shown:?}");
        assert_eq!(image.get(2, 3), Some(&[0.0; 4]), "{shown:?}");
    }
}

#[test]
fn what_the_preset_lacks_is_a_chequer() {
    for shown in [DebugView::Variance, DebugView::Lambda, DebugView::Gradient, DebugView::Fireflies] {
        let image = view(shown, &Moments::default(), &Statistics::default());
        let at = |x, y| image.get(x, y).map(|t| t[0]).expect("inside");
        assert!(at(0, 0) < at(8, 0) && at(0, 0) == at(8, 8) && at(8, 0) < 0.1, "{shown:?}");
    }
}

#[test]
fn bars_grow_with_the_number_of_bad_values() {
    let lit = |count: u32| {
        let image = view(DebugView::BadValues, &Moments::default(), &counted(&[(Counter::Depth, count)]));
        assert_eq!(image.get(0, 0).map(|t| t[3]), Some(count as f32));
        (0..EXTENT[0] as i32).filter(|&x| image.get(x, 0).is_some_and(|t| t[0] > 0.1)).count()
    };
    assert_eq!([lit(0), lit(EXTENT[0] * EXTENT[1])], [0, 16]);
    assert!(lit(1) > 0 && lit(20) > lit(1));
}
