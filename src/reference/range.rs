//! The least and the greatest of some values.

/// Of no value at first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    pub least: f32,
    pub most: f32,
}

impl Default for Range {
    fn default() -> Self {
        Self { least: f32::MAX, most: f32::MIN }
    }
}

impl FromIterator<f32> for Range {
    fn from_iter<I: IntoIterator<Item = f32>>(values: I) -> Self {
        values.into_iter().fold(Self::default(), |range, value| range.with(Self { least: value, most: value }))
    }
}

impl Range {
    /// With all that is between both.
    pub(crate) fn with(self, other: Self) -> Self {
        Self { least: self.least.min(other.least), most: self.most.max(other.most) }
    }

    /// How far a value lies outside.
    pub(crate) fn outside(self, value: f32) -> f32 {
        (value - self.most).max(self.least - value).max(0.0)
    }
}
