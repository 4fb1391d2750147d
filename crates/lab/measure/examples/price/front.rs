//! The front: points than which no other is both cheaper and as good.

/// Whether each point, (price, error), is on the front. A point that is not finite is not.
pub fn of(points: &[(f64, f64)]) -> Vec<bool> {
    let beats =
        |(price, error): (f64, f64), than: (f64, f64)| price <= than.0 && error <= than.1 && (price < than.0 || error < than.1);
    let is_on =
        |point: &(f64, f64)| point.0.is_finite() && point.1.is_finite() && !points.iter().any(|other| beats(*other, *point));
    points.iter().map(is_on).collect()
}

#[cfg(test)]
mod tests {
    use super::of;

    #[test]
    fn a_point_is_on_the_front_unless_one_is_cheaper_and_as_good() {
        let points = [(1.0, 5.0), (2.0, 3.0), (2.0, 4.0), (3.0, 3.0), (4.0, 1.0), (0.5, f64::NAN)];
        assert_eq!(of(&points), [true, true, false, false, true, false]);
        assert_eq!(of(&[(1.0, 1.0), (1.0, 1.0)]), [true, true]);
    }
}
