//! Pictures that move while neither motion nor cameras say how: a history would smear them.

use crate::frame::FrameInputs;
use crate::frame_images::Texels;
use crate::roles::Role;
use crate::setup::Setup;
use crate::smooth::smooth;
use crate::unfiltered::ALBEDO;

/// Side of a tile, pixels.
const TILE: usize = 16;
/// Tiles along each side that are looked at.
const TILES: usize = 16;
/// Pixels to each side where a tile may be found in the frame before.
const REACH: usize = 16;
/// A smaller mean difference is none.
const LEAST: f32 = 0.01;
/// Pixels by which a tile is shifted against itself: one with a texture differs then.
const ASIDE: usize = 2;
/// The part of the difference at its own place that a tile has where it is found.
const FOUND: f32 = 0.5;
/// The share of tiles with a texture that have to be found elsewhere.
const MOVED: f32 = 0.5;

/// Has every frame filtered by itself where the picture moves and nobody knows how. `pair`: two frames of the sequence.
pub fn check(pair: [&FrameInputs; 2], setup: &mut Setup) {
    let [width, height] = pair[1].params.render_extent.map(|side| side as usize);
    let roles = [(ALBEDO, Role::Albedo), ("normal", Role::Normal)];
    let given = roles.into_iter().filter(|(_, role)| setup.mapping.has(*role));
    let images = given.map(|(name, _)| pair.map(|frame| frame.images.get(name).map(Vec::as_slice)));
    let mut guides: Vec<_> = images.filter_map(|[before, now]| Some([before?, now?])).collect();
    let pictures = pair.map(|frame| if guides.is_empty() { blurred(&frame.noisy, width) } else { Texels::new() });
    if guides.is_empty() {
        guides.push(pictures.each_ref().map(Vec::as_slice));
    }
    let places = |side: usize| (0..(side + 1).saturating_sub(TILE)).step_by(TILE.max(side / TILES));
    let tiles = places(height).flat_map(|y| places(width).map(move |x| [x, y]));
    let moved: Vec<bool> = tiles.filter_map(|tile| has_moved(&guides, [width, height], tile)).collect();
    let share = moved.iter().filter(|moved| **moved).count() as f32 / moved.len().max(1) as f32;
    if share > MOVED {
        setup.stills = true;
        setup.note(format!(
            "  note: {:.0} % of the picture moves, and neither motion nor a camera says how: every frame is filtered by itself",
            100.0 * share
        ));
    }
}

/// The picture between 0 and 1, with less noise.
fn blurred(picture: &[[f32; 3]], width: usize) -> Texels {
    let compressed = picture.iter().map(|colour| colour.map(|v| v.max(0.0) / (1.0 + v.max(0.0))));
    smooth(&compressed.map(|[r, g, b]| [r, g, b, 0.0]).collect(), width)
}

/// Whether a tile is found elsewhere in the frame before; `None` where it has no texture.
fn has_moved(guides: &[[&[[f32; 4]]; 2]], [width, height]: [usize; 2], [left, top]: [usize; 2]) -> Option<bool> {
    // The mean difference of the tile from one in the frame before or, of `itself`, in its own.
    let difference = |itself: bool, [x0, y0]: [usize; 2]| {
        let of_pixel = |[before, now]: &[&[[f32; 4]]; 2], x: usize, y: usize| {
            let other = if itself { now } else { before };
            let (a, b) = (other[(y0 + y) * width + x0 + x], now[(top + y) * width + left + x]);
            (0..3).map(|c| (a[c] - b[c]).abs()).sum::<f32>()
        };
        let pixels = (0..TILE).flat_map(|y| (0..TILE).map(move |x| (x, y)));
        pixels.map(|(x, y)| guides.iter().map(|guide| of_pixel(guide, x, y)).sum::<f32>()).sum::<f32>() / (TILE * TILE) as f32
    };
    // Towards the middle, away from the border.
    let beside = |at: usize, side: usize| if at < side / 2 { at + ASIDE } else { at - ASIDE };
    let aside = [[beside(left, width), top], [left, beside(top, height)]];
    let is_inside = |[x, y]: &[usize; 2]| x + TILE <= width && y + TILE <= height;
    let has_texture = aside.into_iter().filter(is_inside).any(|at| difference(true, at) > LEAST);
    let own = difference(false, [left, top]);
    let around = |at: usize, side: usize| at.saturating_sub(REACH)..=(at + REACH).min(side - TILE);
    let places = around(top, height).flat_map(|y| around(left, width).map(move |x| [x, y]));
    let is_found = || places.map(|at| difference(false, at)).fold(own, f32::min) < FOUND * own;
    // Most pictures stand still or have a camera: no search there.
    has_texture.then(|| own > LEAST && is_found())
}
