//! Forms that files have for fields of [`super::Conventions`] that are neither choices nor plain numbers.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Deserialize)]
#[serde(untagged)]
enum Form {
    Flag(bool),
    Number(f64),
    Text(String),
}

impl std::fmt::Display for Form {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "`{text}`"),
        }
    }
}

/// A number above 0, or `"inf"`: JSON has no infinity.
pub(super) mod distance {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(distance: &f32, serializer: S) -> Result<S::Ok, S::Error> {
        // As a double it survives readers that go through doubles with all its bits.
        if distance.is_finite() {
            f64::from(*distance).serialize(serializer)
        } else {
            distance.to_string().serialize(serializer)
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f32, D::Error> {
        let form = Form::deserialize(deserializer)?;
        let distance = match &form {
            Form::Number(number) => Some(*number as f32),
            Form::Text(text) => text.parse().ok(),
            Form::Flag(_) => None,
        };
        let positive = distance.filter(|d| *d > 0.0);
        positive.ok_or_else(|| D::Error::custom(format!("background_depth is {form}; give a number above 0, or \"inf\"")))
    }
}

/// `"up"` or `"down"`; `true` and `false` are read as well.
pub(super) mod up {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(is_up: &bool, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(if *is_up { "up" } else { "down" })
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<bool, D::Error> {
        match Form::deserialize(deserializer)? {
            Form::Flag(is_up) => Ok(is_up),
            Form::Text(text) if text == "up" => Ok(true),
            Form::Text(text) if text == "down" => Ok(false),
            other => Err(D::Error::custom(format!("motion_y is {other}; there are: up, down"))),
        }
    }
}
