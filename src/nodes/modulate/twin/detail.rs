//! Detail that noise does not explain, taken from light as it was before the filter.

use crate::reference::bindings::Bindings;
use crate::reference::luminance_history::detail_of;
use crate::reference::{render_rect::RenderRect, Image};
use crate::Error;
use glam::{IVec2, Vec4};

/// Pixels from one window of 5×5 to the next, whose detail `luminance_history*` tells.
const WINDOWS: i32 = 4;

/// The filtered light of every signal with its detail.
pub(super) fn restored(b: &Bindings, filtered: &[&Image<[f32; 4]>]) -> Result<Vec<Image<[f32; 4]>>, Error> {
    let (accumulated, histories) = (b.colours("irradiance_history")?, b.uints("luminance_history")?);
    let rect = RenderRect::new(b.frame.render_extent);
    let restore = |i: usize| {
        let (filtered, accumulated, history) = (filtered[i], accumulated[i], histories[i]);
        Image::compute(filtered.extent(), b.frame.render_extent, |p| {
            let share = detail_around(rect, p, |q| detail_of(history.at(q)));
            Vec4::from(filtered.at(p)).lerp(accumulated.at(p).into(), share).to_array()
        })
    };
    Ok((0..filtered.len().min(accumulated.len()).min(histories.len())).map(restore).collect())
}

/// The mean of five windows, since one is too few to tell noise from it; 0 where that of the pixel itself is not told.
fn detail_around(rect: RenderRect, p: IVec2, detail: impl Fn(IVec2) -> Option<f32>) -> f32 {
    let Some(own) = detail(p) else { return 0.0 };
    let corners = [(-1, -1), (1, -1), (-1, 1), (1, 1)].map(|(x, y)| rect.clamp(p + WINDOWS * IVec2::new(x, y)));
    let sum = own + corners.iter().map(|q| detail(*q).unwrap_or(-1.0)).sum::<f32>();
    (0.2 * sum).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURE: [u32; 2] = [21, 21];

    fn assert_detail(p: IVec2, detail: impl Fn(IVec2) -> Option<f32>, expected: f32) {
        let share = detail_around(RenderRect::new(PICTURE), p, detail);
        assert!((share - expected).abs() < 1e-6, "{share} for {expected}");
    }

    const MIDDLE: IVec2 = IVec2::splat(10);

    #[test]
    fn detail_is_the_mean_of_windows_around() {
        assert_detail(MIDDLE, |_| Some(0.5), 0.5);
        // Chance in one window is none.
        assert_detail(MIDDLE, |q| Some(if q == MIDDLE { 0.7 } else { -0.2 }), 0.0);
        assert_detail(MIDDLE, |q| Some(if q.x < 7 { 0.75 } else { 0.0 }), 0.3);
        // Windows in which nothing is told count as noise.
        assert_detail(MIDDLE, |q| (q.x > 6).then_some(0.8), 0.08);
    }

    #[test]
    fn a_pixel_without_detail_of_its_own_stays_filtered() {
        assert_detail(MIDDLE, |q| (q != MIDDLE).then_some(1.0), 0.0);
    }

    #[test]
    fn at_the_border_the_nearest_windows_count() {
        assert_detail(IVec2::splat(2), |q| Some(if q.x == 0 { 0.75 } else { 0.0 }), 0.3);
    }
}
