//! Negative light: filters of renderers with negative lobes leave it beside bright pixels. The denoiser
//! takes it as 0, which would make the picture brighter: so it is taken from the pixels beside first.

use crate::frame_images::Texels;
use crate::raster::Raster;

/// Pixels to each side from which it is taken, at first and where that is not enough.
const REACH: [usize; 2] = [1, 3];

/// Evens negative values out with the positive ones around. Returns the number of pixels that were.
pub fn even_out(texels: &mut Texels, width: usize) -> usize {
    let mut count = 0;
    for i in 0..texels.len() {
        if texels[i][..3].iter().any(|v| *v < 0.0) {
            count += 1;
            for component in 0..3 {
                REACH.iter().for_each(|reach| take(texels, width, i, component, *reach));
                texels[i][component] = texels[i][component].max(0.0);
            }
        }
    }
    count
}

/// Takes what a pixel lacks from those around, from each in proportion to what it has.
fn take(texels: &mut Texels, width: usize, i: usize, component: usize, reach: usize) {
    let lacks = -texels[i][component];
    if lacks <= 0.0 || width == 0 {
        return;
    }
    let raster = Raster::of_rows(width, texels.len());
    let around = || raster.around(i, reach);
    let has: f32 = around().map(|j| texels[j][component]).filter(|v| *v > 0.0).sum();
    if has > 0.0 && has.is_finite() {
        let kept = (1.0 - lacks / has).max(0.0);
        around().filter(|j| texels[*j][component] > 0.0).collect::<Vec<_>>().into_iter().for_each(|j| texels[j][component] *= kept);
        texels[i][component] = -(lacks - has).max(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_stays_and_nothing_is_negative() {
        let mut texels: Texels = (0..49).map(|i| [((i * 7) % 5) as f32, 1.0, 0.0, -1.0]).collect();
        (texels[24][0], texels[25][0], texels[10][1]) = (-3.0, -1.0, -0.5);
        let sum = |texels: &Texels, c: usize| texels.iter().map(|t| t[c]).sum::<f32>();
        let before = [0, 1, 2, 3].map(|c| sum(&texels, c));
        assert_eq!(even_out(&mut texels, 7), 3);
        for (c, before) in before.into_iter().enumerate() {
            assert!((sum(&texels, c) - before).abs() < 1e-4, "{c}");
        }
        assert!(texels.iter().all(|t| t[..3].iter().all(|v| *v >= 0.0)));
    }

    #[test]
    fn more_than_there_is_around_cannot_be_taken() {
        let mut texels: Texels = vec![[1.0; 4]; 9];
        texels[4] = [-100.0, f32::NAN, 1.0, 1.0];
        assert_eq!(even_out(&mut texels, 3), 1);
        assert!(texels.iter().all(|t| t[0] == 0.0));
        assert!(texels[4][1].is_nan() || texels[4][1] == 0.0);
    }
}
