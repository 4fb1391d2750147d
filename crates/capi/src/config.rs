//! The configuration as a struct of C: every field of `atrous::Config` and its conventions as a number, from their one table.
//! The struct has the groups of the table with the conventions first, and only grows.
//! `tests/header.rs` gives it to cbindgen, which does not see through macros.

use crate::convert::{choice, eaw_weights, flag};
use crate::status::Failure;
use atrous::config::*;
use atrous::Config;

macro_rules! c_type {
    (distance) => {
        f32
    };
    (factor) => {
        f32
    };
    (extent_or_none) => {
        [u32; 2]
    };
    ($kind:ident) => {
        u32
    };
}

/// The value of a field, by its kind in the table.
macro_rules! from_c {
    (choice $name:expr, $given:expr) => {
        choice($name, $given)?
    };
    (flag $name:expr, $given:expr) => {
        flag($name, $given)?
    };
    (weights $name:expr, $given:expr) => {
        eaw_weights($given)?
    };
    (number_or_none $name:expr, $given:expr) => {
        ($given > 0).then_some($given)
    };
    (extent_or_none $name:expr, $given:expr) => {
        ($given != [0; 2]).then_some($given)
    };
    ($kind:ident $name:expr, $given:expr) => {
        $given
    };
}

macro_rules! to_c {
    (choice $value:expr) => {
        u32::from($value)
    };
    (flag $value:expr) => {
        u32::from($value)
    };
    (weights $value:expr) => {
        $value.bits()
    };
    (number_or_none $value:expr) => {
        $value.unwrap_or(0)
    };
    (extent_or_none $value:expr) => {
        $value.unwrap_or([0; 2])
    };
    ($kind:ident $value:expr) => {
        $value
    };
}

macro_rules! c_struct {
    (
        config { $($(#[$doc:meta])+ $(@[$attribute:meta])* $name:ident: $of:ident $kind:ident $type:ty = $default:expr;)+ }
        conventions { $($(#[$doc2:meta])+ $(@[$attribute2:meta])* $name2:ident: $of2:ident $kind2:ident $type2:ty = $default2:expr;)+ }
        later_conventions { $($(#[$doc3:meta])+ $(@[$attribute3:meta])* $name3:ident: $of3:ident $kind3:ident $type3:ty = $default3:expr;)+ }
        later_config { $($(#[$doc4:meta])+ $(@[$attribute4:meta])* $name4:ident: $of4:ident $kind4:ident $type4:ty = $default4:expr;)+ }
    ) => {
        /// Your choices; [`crate::atrous_config_default`] fills them in. The header documents the numbers.
        #[derive(Clone, Copy, Debug)]
        #[repr(C)]
        pub struct AtrousConfig {
            /// sizeof(AtrousConfig).
            pub struct_size: u32,
            /// Width of your images, pixels.
            pub width: u32,
            /// Height of your images, pixels.
            pub height: u32,
            $(#[doc = concat!("`", stringify!($name2), "` of [`Conventions`].")] pub $name2: c_type!($kind2),)+
            $(#[doc = concat!("`", stringify!($name), "` of [`Config`].")] pub $name: c_type!($kind),)+
            $(#[doc = concat!("`", stringify!($name3), "` of [`Conventions`].")] pub $name3: c_type!($kind3),)+
            $(#[doc = concat!("`", stringify!($name4), "` of [`Config`].")] pub $name4: c_type!($kind4),)+
        }

        impl AtrousConfig {
            /// Names of the fields behind the extent, in their order, for the header.
            #[doc(hidden)]
            pub const FIELDS: &'static [&'static str] = &[
                $(stringify!($name2),)+ $(stringify!($name),)+ $(stringify!($name3),)+ $(stringify!($name4),)+
            ];

            pub(super) fn to_config(self) -> Result<Config, Failure> {
                let config = Config {
                    allocated_extent: [self.width, self.height],
                    $($name: from_c!($kind stringify!($name), self.$name),)+
                    $($name4: from_c!($kind4 stringify!($name4), self.$name4),)+
                    conventions: Conventions {
                        $($name2: from_c!($kind2 stringify!($name2), self.$name2),)+
                        $($name3: from_c!($kind3 stringify!($name3), self.$name3),)+
                    },
                };
                config.validate()?;
                Ok(config)
            }

            pub(super) fn default_for(extent: [u32; 2]) -> Self {
                let config = Config::new(extent);
                Self {
                    struct_size: size_of::<Self>() as u32,
                    width: extent[0],
                    height: extent[1],
                    $($name: to_c!($kind config.$name),)+
                    $($name4: to_c!($kind4 config.$name4),)+
                    $($name2: to_c!($kind2 config.conventions.$name2),)+
                    $($name3: to_c!($kind3 config.conventions.$name3),)+
                }
            }
        }
    };
}

atrous::config_fields!(c_struct);
