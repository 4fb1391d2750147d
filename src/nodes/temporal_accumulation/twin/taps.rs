//! Step 3 of the stage: the pixels around a position of the previous frame, each tested on its own.

use super::{History, Reason};
use glam::{IVec2, Vec2};

/// Smallest sum of bilinear weights that the 2×2 taps are trusted with.
const SMALLEST_WEIGHT_SUM: f32 = 0.01;

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
