//! Choices: enums whose values have a name and a number, both stable and each written once. Everything else that has to know them
//! (`FromStr`, the C ABI, serde, command lines, menus) reads them here.

use crate::error::Error;
use std::fmt::{Debug, Display};
use std::hash::Hash;
use std::str::FromStr;

/// An enum to choose from, for code that takes any of them: for example menus, command lines and
/// files.
///
/// Each is [`Display`]ed as its name, parsed from it, and made from its number; an
/// [`Error::Choice`] names the given value and lists the choices. With the feature `serde` it is
/// written and read as its name.
pub trait Choice:
    Copy + Debug + Display + Eq + Hash + Send + Sync + FromStr<Err = Error> + TryFrom<u32, Error = Error> + 'static
{
    /// Name of the type, for messages.
    const KIND: &'static str;
    /// Every value, in the order of the numbers.
    const ALL: &'static [Self];

    /// Name of the value in files and on command lines, in snake_case; it never changes.
    fn name(self) -> &'static str;

    /// Number of the value in the C ABI and in shaders; it never changes.
    fn number(self) -> u32;
}

fn listed<T: Choice>(text: impl Fn(T) -> String) -> String {
    T::ALL.iter().map(|value| text(*value)).collect::<Vec<_>>().join(", ")
}

pub(crate) fn unknown_name<T: Choice>(given: &str) -> Error {
    Error::Choice { kind: T::KIND, given: given.to_owned(), allowed: listed(|value: T| value.name().to_owned()) }
}

pub(crate) fn unknown_number<T: Choice>(given: u32) -> Error {
    Error::Choice {
        kind: T::KIND,
        given: given.to_string(),
        allowed: listed(|value: T| format!("{} ({})", value.number(), value.name())),
    }
}

/// Declares enums with `Variant = number => "name",`, and implements [`Choice`] for them. The name and `ALL` are inherent as well,
/// so that nobody has to import the trait.
macro_rules! choices {
    ($(
        $(#[$meta:meta])*
        pub enum $type:ident { $($(#[$value_meta:meta])* $value:ident = $number:literal => $name:literal,)+ }
    )+) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u32)]
        pub enum $type { $($(#[$value_meta])* $value = $number,)+ }

        impl $type {
            /// Every value, in the order of the numbers.
            pub const ALL: [Self; [$($number),+].len()] = [$(Self::$value),+];

            /// Name of the value in files and on command lines, in snake_case; it never changes.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$value => $name),+ }
            }
        }

        impl $crate::choice::Choice for $type {
            const KIND: &'static str = stringify!($type);
            const ALL: &'static [Self] = &Self::ALL;

            fn name(self) -> &'static str {
                self.name()
            }

            fn number(self) -> u32 {
                self as u32
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::Error;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                match name { $($name => Ok(Self::$value),)+ other => Err($crate::choice::unknown_name::<Self>(other)) }
            }
        }

        impl TryFrom<u32> for $type {
            type Error = $crate::Error;

            fn try_from(number: u32) -> Result<Self, Self::Error> {
                match number { $($number => Ok(Self::$value),)+ other => Err($crate::choice::unknown_number::<Self>(other)) }
            }
        }

        impl From<$type> for u32 {
            fn from(value: $type) -> Self {
                value as Self
            }
        }

        #[cfg(feature = "serde")]
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let name = std::borrow::Cow::<str>::deserialize(deserializer)?;
                name.parse().map_err(serde::de::Error::custom)
            }
        }
    )+};
}

pub(crate) use choices;

#[cfg(test)]
mod tests;
