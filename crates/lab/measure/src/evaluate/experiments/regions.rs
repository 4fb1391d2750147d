//! Errors of a part of the picture.

use crate::Result;
use atrous_lab::scores::{flip_map, unbiased_rel_mse, unbiased_rmse, Rgb};

/// Errors of the pixels that count.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Root mean square.
    pub rmse: f64,
    /// Relative, squared.
    pub rel_mse: f64,
    /// Mean of what an eye sees.
    pub flip: f64,
}

/// Of the pixels that count, against two halves of a reference.
///
/// # Errors
/// A picture with values that are not finite.
pub fn errors(picture: &[[f32; 3]], halves: &[Vec<[f32; 3]>; 2], [width, height]: [u32; 2], counts: &[bool]) -> Result<Errors> {
    let mean: Vec<[f32; 3]> = halves[0].iter().zip(&halves[1]).map(|(a, b)| [0, 1, 2].map(|c| 0.5 * (a[c] + b[c]))).collect();
    let flip = flip_map(Rgb::new(width, height, picture)?, Rgb::new(width, height, &mean)?)?;
    let parts = halves.each_ref().map(|half| of(half, counts));
    let (halves, own) = ([row(&parts[0])?, row(&parts[1])?], of(picture, counts));
    let flip = of(&flip, counts);
    let flip = flip.iter().map(|error| f64::from(*error)).sum::<f64>() / flip.len() as f64;
    Ok(Errors { rmse: unbiased_rmse(row(&own)?, halves)?, rel_mse: unbiased_rel_mse(row(&own)?, halves)?, flip })
}

fn of<T: Copy>(values: &[T], counts: &[bool]) -> Vec<T> {
    values.iter().zip(counts).filter(|(_, counts)| **counts).map(|(value, _)| *value).collect()
}

fn row(pixels: &[[f32; 3]]) -> Result<Rgb<'_>> {
    Ok(Rgb::new(pixels.len() as u32, 1, pixels)?)
}
