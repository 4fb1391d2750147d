//! Switches of the edge-stopping functions of EAW.

use crate::error::Error;
use std::fmt;
use std::str::FromStr;

/// The edge-stopping functions of [`crate::config::Preset::Eaw`]. As text their names with commas between them, or `none`; with the
/// feature `serde` a list of names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EawWeights {
    /// Weight by radiance. Default: true.
    pub radiance: bool,
    /// Weight by normal. Default: true.
    pub normal: bool,
    /// Weight by position. Default: true.
    pub position: bool,
}

impl EawWeights {
    /// Names of the functions, in the order of the fields and of the bits.
    pub const NAMES: [&'static str; 3] = ["radiance", "normal", "position"];

    /// The first `count` of radiance, normal and position, as in Figure 4 and Table 2 of the paper; 0 is the plain wavelet.
    pub const fn first(count: u32) -> Self {
        Self { radiance: count >= 1, normal: count >= 2, position: count >= 3 }
    }

    /// Radiance in bit 0, normal in bit 1, position in bit 2, as the C ABI has them.
    pub const fn bits(self) -> u32 {
        self.radiance as u32 | (self.normal as u32) << 1 | (self.position as u32) << 2
    }

    /// The weights of [`Self::bits`]; `None` if any other bit is set.
    pub const fn from_bits(bits: u32) -> Option<Self> {
        match bits {
            0..=7 => Some(Self { radiance: bits & 1 != 0, normal: bits & 2 != 0, position: bits & 4 != 0 }),
            _ => None,
        }
    }

    /// Names of the functions that are on.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        (0..).zip(Self::NAMES).filter(move |(bit, _)| self.bits() >> bit & 1 != 0).map(|(_, name)| name)
    }

    fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<Self, Error> {
        let mut weights = Self::first(0);
        for name in names {
            match name.trim() {
                // `rt` is what the paper calls it.
                "radiance" | "rt" => weights.radiance = true,
                "normal" => weights.normal = true,
                "position" => weights.position = true,
                other => {
                    let allowed = format!("{} (rt for radiance), and none", Self::NAMES.join(", "));
                    return Err(Error::Choice { kind: "EawWeights", given: other.to_owned(), allowed });
                }
            }
        }
        Ok(weights)
    }
}

impl Default for EawWeights {
    fn default() -> Self {
        Self::first(3)
    }
}

impl fmt::Display for EawWeights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = self.names().collect();
        f.pad(&if names.is_empty() { "none".to_owned() } else { names.join(",") })
    }
}

impl FromStr for EawWeights {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::from_names(text.split(',').filter(|_| text != "none"))
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for EawWeights {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.names())
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for EawWeights {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let names = Vec::<String>::deserialize(deserializer)?;
        Self::from_names(names.iter().map(String::as_str)).map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_survives_its_text_and_its_bits() {
        for bits in 0..8 {
            let weights = EawWeights::from_bits(bits).expect("three bits");
            assert_eq!((weights.bits(), weights.to_string().parse()), (bits, Ok(weights)));
        }
        assert_eq!(EawWeights::first(0).to_string(), "none");
        assert_eq!("rt,position".parse(), EawWeights::from_bits(5).ok_or(Error::NotBound(String::new())));
        assert_eq!(EawWeights::from_bits(8), None);
        let message = "rt,colour".parse::<EawWeights>().expect_err("unknown").to_string();
        assert!(message.contains("`colour`") && message.contains("radiance, normal, position"), "{message}");
    }
}
