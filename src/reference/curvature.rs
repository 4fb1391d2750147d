//! How curved a mirror is, and by how much it pulls the image of what it shows near: Coddington's equations, a wave front that meets a curved
//! surface aslant.

use glam::{Mat2, Vec2, Vec3};

/// Share of the product of their lengths that the area between two steps has at least.
const SMALLEST_AREA: f32 = 0.01;
/// Eigenvalue that a matrix of [`Curvature::nearer`] has at least: a concave mirror shows no image at infinity.
const SMALLEST_NEARNESS: f32 = 0.1;

/// The curvature of a surface, in axes at right angles to the line of sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curvature {
    /// In the plane of incidence.
    pub along: Vec3,
    /// At right angles to it.
    pub across: Vec3,
    /// What a wave front becomes more curved by, 1 / scene unit.
    pub power: Mat2,
    /// Mean curvature of the surface, 1 / scene unit; positive where it is convex.
    pub mean: f32,
}

/// From a surface point to one beside it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// Scene units.
    pub way: Vec3,
    /// Of the normal.
    pub turn: Vec3,
}

impl Step {
    /// 1 / scene unit; positive where the surface is convex.
    pub(crate) fn curvature(&self) -> f32 {
        self.turn.dot(self.way) / self.way.length_squared().max(1e-20)
    }
}

impl Curvature {
    /// From two steps on a surface that is seen along `sight`.
    pub(crate) fn new(normal: Vec3, sight: Vec3, steps: [Option<Step>; 2]) -> Self {
        let aslant = normal.cross(sight);
        let across = match aslant.length_squared() < 1e-6 {
            true => sight.cross(if sight.x.abs() < 0.5 { Vec3::X } else { Vec3::Y }),
            false => aslant,
        };
        let across = across.normalize();
        let tangent = across.cross(normal);
        let steps = steps.map(|step| {
            let [way, turn] = step.map_or([Vec3::ZERO; 2], |step| [step.way, step.turn]);
            [way, turn].map(|v| Vec2::new(v.dot(tangent), v.dot(across)))
        });
        let surface = curvature_between(steps);
        // In the plane of incidence a surface is longer than it looks.
        let cosine = (-normal.dot(sight)).max(0.05);
        let mixed = surface.y_axis.x;
        let power = Mat2::from_cols(Vec2::new(surface.x_axis.x / cosine, mixed), Vec2::new(mixed, surface.y_axis.y * cosine)) * 2.0;
        Self { along: sight.cross(across), across, power, mean: 0.5 * (surface.x_axis.x + surface.y_axis.y) }
    }

    /// By how much nearer than in a flat mirror the image of what is `hit_distance` away is: of a flat one the identity.
    pub(crate) fn nearer(&self, hit_distance: f32) -> Mat2 {
        let added = self.power * hit_distance;
        let limited = added.to_cols_array().map(|x| x.clamp(-1e6, 1e6));
        bounded(Mat2::IDENTITY + Mat2::from_cols_array(&limited))
    }
}

/// A symmetric matrix, with eigenvalues of at least [`SMALLEST_NEARNESS`].
fn bounded(m: Mat2) -> Mat2 {
    let (xx, xy, yy) = (m.x_axis.x, m.x_axis.y, m.y_axis.y);
    let (middle, half_difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
    let radius = half_difference.hypot(xy);
    let [larger, smaller] = [middle + radius, middle - radius].map(|value| value.max(SMALLEST_NEARNESS));
    let aside = Mat2::from_cols(Vec2::new(half_difference, xy), Vec2::new(xy, -half_difference));
    Mat2::IDENTITY * (0.5 * (larger + smaller)) + aside * (0.5 * (larger - smaller) / radius.max(1e-20))
}

/// Of a surface, from two steps and what its normal turns by; symmetric. A step of no length is one at right angles to the other, along which
/// nothing turns. Steps that lie next to one line tell nothing of what is beside it.
fn curvature_between([[first, first_turn], [second, second_turn]]: [[Vec2; 2]; 2]) -> Mat2 {
    let first = if first == Vec2::ZERO { -second.perp() } else { first };
    let second = if second == Vec2::ZERO { first.perp() } else { second };
    let area = first.perp_dot(second);
    if area.abs().is_nan() || area.abs() <= SMALLEST_AREA * first.length() * second.length() {
        return Mat2::ZERO;
    }
    let turns = Mat2::from_cols(first_turn, second_turn) * Mat2::from_cols(first, second).inverse();
    (turns + turns.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps on a surface that is seen from above at 60 degrees, and that is curved by `curvatures` along x and y.
    fn aslant(curvatures: Vec2, steps: [Vec2; 2]) -> Curvature {
        let step = |to: Vec2| Step { way: to.extend(0.0), turn: (to * curvatures).extend(0.0) };
        Curvature::new(Vec3::Z, Vec3::new(0.75_f32.sqrt(), 0.0, -0.5), steps.map(|to| Some(step(to))))
    }

    #[test]
    fn power_is_coddingtons_whatever_way_the_steps_go() {
        let expected = Mat2::from_cols(Vec2::new(2.0 * 0.3 / 0.5, 0.0), Vec2::new(0.0, 2.0 * 0.7 * 0.5));
        for steps in [[Vec2::X, Vec2::Y], [Vec2::new(0.2, 0.1), Vec2::new(-0.1, 0.3)]] {
            let given = aslant(Vec2::new(0.3, 0.7), steps);
            assert!(given.power.abs_diff_eq(expected, 1e-5), "{steps:?}: {}", given.power);
            assert!((given.mean - 0.5).abs() < 1e-5);
        }
    }

    #[test]
    fn steps_on_one_line_tell_nothing_and_one_alone_tells_of_its_line() {
        assert_eq!(aslant(Vec2::ONE, [Vec2::X, Vec2::new(1.0, 1e-3)]).power, Mat2::ZERO);
        let step = Step { way: Vec3::new(0.0, 0.5, 0.0), turn: Vec3::new(0.0, 0.5, 0.0) };
        for steps in [[Some(step), None], [None, Some(step)]] {
            assert_eq!(Curvature::new(Vec3::Z, Vec3::NEG_Z, steps).mean, 0.5);
        }
        assert_eq!(Curvature::new(Vec3::Z, Vec3::NEG_Z, [None; 2]).power, Mat2::ZERO);
    }

    #[test]
    fn a_concave_mirror_shows_nothing_at_infinity() {
        let hollow = aslant(Vec2::new(-3.0, 0.5), [Vec2::new(1.0, 0.5), Vec2::Y]);
        let nearer = hollow.nearer(2.0);
        assert!((nearer.x_axis.x - SMALLEST_NEARNESS).abs() < 1e-4, "{nearer}");
        assert!((nearer.y_axis.y - 2.0).abs() < 1e-4, "{nearer}");
        assert!(hollow.nearer(f32::MAX).is_finite());
    }
}
