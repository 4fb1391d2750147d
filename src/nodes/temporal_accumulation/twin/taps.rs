//! Step 3 of the stage: the pixels around a position of the previous frame, each tested on its own.

use super::{History, Reason};
use glam::{IVec2, Vec2};

/// Smallest sum of bilinear weights that the 2×2 taps are trusted with.
pub(crate) const SMALLEST_WEIGHT_SUM: f32 = 0.01;

/// The pixel nearest to a position; pixel centres are whole numbers.
pub(super) fn nearest(s: Vec2) -> IVec2 {
    (s + 0.5).floor().as_ivec2()
}

/// The 2×2 taps that nothing refuses, else the 3×3 ones.
pub(super) fn find(s: Vec2, refusal: impl Fn(IVec2) -> Reason) -> Option<History> {
    let corner = s.floor();
    let f = s - corner;
    let bilinear = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| {
        let weight = (if x == 0 { 1.0 - f.x } else { f.x }) * (if y == 0 { 1.0 - f.y } else { f.y });
        (corner.as_ivec2() + IVec2::new(x, y), weight)
    });
    let around = std::array::from_fn::<_, 9, _>(|i| (nearest(s) + IVec2::new(i as i32 % 3 - 1, i as i32 / 3 - 1), 1.0));
    valid(&bilinear, &refusal).or_else(|| valid(&around, &refusal))
}

/// `found` with 4×4 taps of Catmull and Rom's cubic, unless one of them is refused or the position lies on a pixel.
pub(super) fn sharpened(s: Vec2, found: History, refusal: impl Fn(IVec2) -> Reason) -> History {
    let History::Taps(taps) = found else { return found };
    match cubic_taps(s).filter(|cubic| cubic.iter().all(|(q, _)| refusal(*q) == Reason::None)) {
        Some(cubic) => History::Sharp(taps, cubic),
        None => found,
    }
}

/// 4×4 taps around a position with the weights of Catmull and Rom's cubic; `None` where it lies on a pixel.
pub(crate) fn cubic_taps(s: Vec2) -> Option<[(IVec2, f32); 16]> {
    let corner = s.floor();
    let f = s - corner;
    let (x_weights, y_weights) = (cubic_weights(f.x), cubic_weights(f.y));
    (f != Vec2::ZERO).then(|| {
        std::array::from_fn(|i| {
            (corner.as_ivec2() + IVec2::new(i as i32 % 4, i as i32 / 4) - 1, x_weights[i % 4] * y_weights[i / 4])
        })
    })
}

/// Weights of four taps in a row, `t` from the second to the third.
fn cubic_weights(t: f32) -> [f32; 4] {
    [t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)]
}

/// The valid ones of some taps, weights normalised; `None` where they weigh too little.
fn valid(candidates: &[(IVec2, f32)], refusal: impl Fn(IVec2) -> Reason) -> Option<History> {
    let mut taps = [(IVec2::ZERO, 0.0); 9];
    let mut sum = 0.0;
    for (tap, &(q, weight)) in taps.iter_mut().zip(candidates) {
        if refusal(q) == Reason::None {
            *tap = (q, weight);
            sum += weight;
        }
    }
    taps.iter_mut().for_each(|tap| tap.1 /= sum);
    (sum >= SMALLEST_WEIGHT_SUM).then_some(History::Taps(taps))
}
