//! The ways in which a texel of motion or of a normal can be read.

use atrous::config::{Conventions, MotionDirection, MotionUnit, NormalEncoding, NormalSpace};

/// One way to read motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MotionReading {
    pub unit: MotionUnit,
    pub direction: MotionDirection,
    pub y_up: bool,
    pub jittered: bool,
}

impl MotionReading {
    pub fn declared(c: &Conventions) -> Self {
        Self { unit: c.motion_unit, direction: c.motion_direction, y_up: c.motion_y_up, jittered: c.motion_jittered }
    }

    /// The reading with the opposite sign.
    pub fn negated(self) -> Self {
        use MotionDirection as D;
        let direction = match self.direction {
            D::PreviousMinusCurrent => D::CurrentMinusPrevious,
            D::CurrentMinusPrevious => D::PreviousMinusCurrent,
        };
        Self { direction, ..self }
    }

    pub fn apply(self, c: &Conventions) -> Conventions {
        Conventions {
            motion_unit: self.unit,
            motion_direction: self.direction,
            motion_y_up: self.y_up,
            motion_jittered: self.jittered,
            ..*c
        }
    }

    /// Every reading, this one first, and those before others that differ less from it.
    pub fn all(self) -> Vec<Self> {
        let mut all = Vec::new();
        for unit in MotionUnit::ALL {
            for direction in MotionDirection::ALL {
                for (y_up, jittered) in [(false, false), (false, true), (true, false), (true, true)] {
                    all.push(Self { unit, direction, y_up, jittered });
                }
            }
        }
        all.sort_by_key(|other| self.differences(*other));
        all
    }

    /// Number of ways in which `other` differs.
    pub fn differences(self, other: Self) -> usize {
        self.changes(other).0.len()
    }

    /// Ways in which `other` differs, and the changes that lead there.
    pub fn changes(self, other: Self) -> (Vec<String>, Vec<String>) {
        let (mut mistakes, mut remedies) = (Vec::new(), Vec::new());
        let mut change = |mistake: &str, remedy: String| {
            mistakes.push(mistake.to_owned());
            remedies.push(remedy);
        };
        if self.direction != other.direction {
            change("the motion has the opposite sign", format!("motion_direction: {}", other.direction));
        }
        if self.unit != other.unit {
            let mistake = match other.unit {
                MotionUnit::Pixels => "the motion is in pixels",
                MotionUnit::Uv => "the motion is in fractions of the image",
                MotionUnit::Ndc => "the motion is in normalised device coordinates",
            };
            change(mistake, format!("motion_unit: {}", other.unit));
        }
        if self.y_up != other.y_up {
            let mistake = if other.y_up { "y of the motion points up" } else { "y of the motion points down" };
            change(mistake, format!("motion_y_up: {}", other.y_up));
        }
        if self.jittered != other.jittered {
            let mistake = if other.jittered { "the motion includes the change of jitter" } else { "the motion is without jitter" };
            change(mistake, format!("motion_jittered: {}", other.jittered));
        }
        (mistakes, remedies)
    }
}

/// One way to read normals: an encoding and a space of the conventions, and components that are negated after decoding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NormalReading {
    pub encoding: NormalEncoding,
    pub space: NormalSpace,
    pub signs: [f32; 3],
}

impl NormalReading {
    pub fn declared(c: &Conventions) -> Self {
        Self { encoding: c.normal, space: c.normal_space, signs: [1.0; 3] }
    }

    pub fn apply(self, c: &Conventions) -> Conventions {
        Conventions { normal: self.encoding, normal_space: self.space, ..*c }
    }

    /// Every reading, this one first, and those before others that differ less from it.
    pub fn all(self) -> Vec<Self> {
        let mut all = Vec::new();
        for encoding in NormalEncoding::ALL {
            for space in NormalSpace::ALL {
                for negated in 0..8_u32 {
                    let signs = std::array::from_fn(|i| if negated >> i & 1 == 1 { -1.0 } else { 1.0 });
                    all.push(Self { encoding, space, signs });
                }
            }
        }
        all.sort_by_key(|other| self.differences(*other));
        all
    }

    /// Number of ways in which `other` differs. All components negated are one mistake, as one component is.
    pub fn differences(self, other: Self) -> usize {
        let negated = self.signs.iter().zip(other.signs).filter(|(a, b)| **a != *b).count();
        let negated = if negated == 3 { 1 } else { negated };
        usize::from(self.encoding != other.encoding) + usize::from(self.space != other.space) + negated
    }

    /// Ways in which `other` differs, and the changes that lead there.
    pub fn changes(self, other: Self) -> (Vec<String>, Vec<String>) {
        let (mut mistakes, mut remedies) = (Vec::new(), Vec::new());
        if self.encoding != other.encoding {
            mistakes.push(format!("the normals are encoded as {}", other.encoding));
            remedies.push(format!("normal: {}", other.encoding));
        }
        if self.space != other.space {
            mistakes.push(format!("the normals are in {} space", other.space));
            remedies.push(format!("normal_space: {}", other.space));
        }
        let negated: Vec<&str> = ["x", "y", "z"].into_iter().zip(other.signs).filter(|n| n.1 < 0.0).map(|n| n.0).collect();
        match negated.len() {
            0 => {}
            3 => {
                mistakes.push("the normals point into the surface".to_owned());
                remedies.push("no field says this: negate the normals where they are written".to_owned());
            }
            _ => {
                let names = negated.join(" and ");
                mistakes.push(format!("{names} of the normals has the opposite sign"));
                remedies.push(format!("no field says this: negate {names} where the normals are written"));
            }
        }
        (mistakes, remedies)
    }
}
