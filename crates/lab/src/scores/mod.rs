//! Image quality: how far a denoised frame is from its reference, and how much it flickers.
//!
//! Everything works on linear Rec. 709 radiance in plain `f32` slices, without Vulkan and without `unsafe`. Images are
//! borrowed as [`Rgb`], whose constructor refuses values that are not finite: so no metric here ever returns NaN.
//!
//! | function | measures | better | on |
//! | --- | --- | --- | --- |
//! | [`rmse`] | root mean square error | lower | linear radiance |
//! | [`rel_mse`] | mean square error relative to the reference | lower | linear radiance |
//! | [`psnr`] | peak signal-to-noise ratio, dB | higher | tone-mapped values |
//! | [`ssim`] | structural similarity | higher, 1 at most | tone-mapped values |
//! | [`flip`], [`flip_map`] | HDR-FLIP: what a viewer sees who flips between the images | lower, 1 at most | tone-mapped exposures |
//! | [`temporal_error`] | change along the motion that the reference does not have | lower | tone-mapped values |
//! | [`static_temporal_error`] | change between frames where nothing moves | lower | linear luminance |
//!
//! [`unbiased_rmse`], [`unbiased_rel_mse`], [`unbiased_ssim`] and [`unbiased_temporal_rmse`] take two references with independent
//! noise, and leave that noise out.
mod error;
mod flip;
mod image;
mod psnr;
mod rmse;
mod ssim;
mod temporal;
#[cfg(test)]
mod tests;
mod tone;
mod unbiased;

pub use error::QualityError;
pub use flip::{flip, flip_map};
pub use image::Rgb;
pub use psnr::psnr;
pub use rmse::{rel_mse, rmse};
pub use ssim::{ssim, unbiased_ssim};
pub use temporal::{static_temporal_error, temporal_error, TemporalGuides};
pub use tone::tone_map;
pub use unbiased::{unbiased_rel_mse, unbiased_rmse, unbiased_temporal_rmse};
