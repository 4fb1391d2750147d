//! Places and labels of the ticks of an axis.

use std::ops::Range;

/// Values on an axis that have labels, and how those are written.
pub struct Ticks {
    pub values: Vec<f64>,
    step: f64,
}

impl Ticks {
    /// At most `most` ticks, at multiples of 1, 2 or 5 times a power of ten.
    pub fn new(range: &Range<f64>, most: usize) -> Self {
        let raw = (range.end - range.start) / most.max(1) as f64;
        let power = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0].map(|m| m * power).into_iter().find(|step| *step >= raw).unwrap_or(10.0 * power);
        let (first, last) = ((range.start / step).ceil() as i64, (range.end / step).floor() as i64);
        let values = (first..=last).map(|i| i as f64 * step).collect();
        Self { values, step }
    }

    /// The ticks of frames, which are whole numbers.
    pub fn whole(range: &Range<f64>, most: usize) -> Self {
        let mut ticks = Self::new(range, most);
        if ticks.step < 1.0 {
            ticks = Self { values: Vec::new(), step: 1.0 };
            ticks.values.extend((range.start.ceil() as i64..=range.end.floor() as i64).map(|i| i as f64));
        }
        ticks
    }

    /// A value as the label of its tick: as many digits as tell it from the next one.
    pub fn label(&self, value: f64) -> String {
        let largest = self.values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let decimals = (-self.step.log10() - 1e-9).ceil().max(0.0) as usize;
        if value != 0.0 && (decimals > 5 || largest >= 1e6) {
            let digits = (largest.log10().floor() - self.step.log10().floor()).clamp(0.0, 6.0) as usize;
            return format!("{value:.digits$e}");
        }
        format!("{value:.0$}", if value == 0.0 { 0 } else { decimals })
    }
}

#[cfg(test)]
mod tests {
    use super::Ticks;
    use std::ops::Range;

    fn labels(range: Range<f64>) -> Vec<String> {
        let ticks = Ticks::new(&range, 6);
        ticks.values.iter().map(|v| ticks.label(*v)).collect()
    }

    #[test]
    fn ticks_stand_at_round_numbers() {
        assert_eq!(labels(0.0..1.0), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(0.9312..0.9987), ["0.94", "0.96", "0.98"]);
        assert_eq!(labels(-3.0..17.0), ["0", "5", "10", "15"]);
        assert_eq!(labels(0.0..3.2e-7), ["0", "1e-7", "2e-7", "3e-7"]);
        assert_eq!(labels(0.0..2.5e30)[1..], ["5.0e29", "1.0e30", "1.5e30", "2.0e30", "2.5e30"]);
    }

    #[test]
    fn frames_are_whole() {
        assert_eq!(Ticks::whole(&(3.0..5.0), 10).values, [3.0, 4.0, 5.0]);
        assert_eq!(Ticks::whole(&(0.0..63.0), 8).values, [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(Ticks::whole(&(7.0..7.0), 12).values, [7.0], "one frame alone");
    }
}
