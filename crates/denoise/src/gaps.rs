//! Depth and ids in fog, where the ray of some pixels is scattered before it meets a surface.
//!
//! Such a pixel has the depth of the background, and which pixels they are changes from frame to frame. What surfaces are behind the fog, pixels
//! around it tell. Where none has a surface, nothing but fog and the background are seen: as far away as they are, their light is noise that has to be
//! filtered, and the filter leaves out what is no surface.

use crate::frame_images::Texels;
use crate::raster::Raster;

/// Pixels to each side in which a surface is looked for.
const REACH: usize = 2;
/// The depth of fog without a surface behind it, over the largest depth of a surface.
const BEYOND: f32 = 2.0;
/// Its id. 0 is that of the background.
const FOG: u32 = 1;

/// The depth that fog without a surface behind it has in a sequence, by the depths of its first frame. `background`: the depth from which on
/// nothing is a surface. `None` without a surface.
pub fn beyond(depths: &Texels, background: f32) -> Option<f32> {
    let surfaces = depths.iter().map(|texel| texel[0]).filter(|z| is_surface(*z, background));
    surfaces.reduce(f32::max).map(|largest| (BEYOND * largest).min(background.next_down()))
}

/// Gives each pixel without a surface the depth and the id of the nearest pixel with one, and `beyond` with an id of its own where there is none.
pub fn fill(depths: &mut Texels, ids: Option<&mut Vec<u32>>, raster: Raster, background: f32, beyond: f32) {
    let given: Vec<f32> = depths.iter().map(|texel| texel[0]).collect();
    let nearest = |pixel: usize| {
        let [x, y] = raster.place(pixel);
        let distance = |i: &usize| {
            let [dx, dy] = raster.place(*i);
            dx.abs_diff(x).pow(2) + dy.abs_diff(y).pow(2)
        };
        raster.around(pixel, REACH).filter(|i| is_surface(given[*i], background)).min_by_key(distance)
    };
    let gaps: Vec<(usize, Option<usize>)> =
        (0..given.len()).filter(|i| !is_surface(given[*i], background)).map(|i| (i, nearest(i))).collect();
    for (gap, surface) in &gaps {
        depths[*gap] = [surface.map_or(beyond, |surface| given[surface]); 4];
    }
    if let Some(ids) = ids {
        let given = ids.clone();
        gaps.iter().for_each(|(gap, surface)| ids[*gap] = surface.map_or(FOG, |surface| given[surface]));
    }
}

/// Whether a depth is one of a surface. `background`: the depth from which on none is.
pub fn is_surface(depth: f32, background: f32) -> bool {
    depth.is_finite() && depth > 0.0 && depth < background
}

#[cfg(test)]
mod tests {
    use super::*;

    const BACKGROUND: f32 = 1e9;

    /// A row of depths, filled; 0 and what is beyond the background are gaps.
    fn filled(row: &[f32], ids: &[u32]) -> (Vec<f32>, Vec<u32>) {
        let mut depths: Texels = row.iter().map(|z| [*z; 4]).collect();
        let mut ids = ids.to_vec();
        let beyond = beyond(&depths, BACKGROUND).expect("a surface");
        fill(&mut depths, Some(&mut ids), Raster::new([row.len() as u32, 1]), BACKGROUND, beyond);
        (depths.into_iter().map(|texel| texel[0]).collect(), ids)
    }

    #[test]
    fn a_gap_has_the_nearest_surface() {
        let (depths, ids) = filled(&[3.0, 1e10, 0.0, 1e10, 5.0, f32::NAN], &[1, 0, 0, 0, 2, 0]);
        assert_eq!(depths, [3.0, 3.0, 3.0, 5.0, 5.0, 5.0]);
        assert_eq!(ids, [1, 1, 1, 2, 2, 2]);
    }

    #[test]
    fn fog_without_a_surface_near_it_lies_beyond_all_surfaces() {
        let (depths, ids) = filled(&[3.0, 4.0, 1e10, 1e10, 1e10], &[1, 2, 0, 0, 0]);
        assert_eq!((depths[4], ids[4]), (8.0, 1));
        assert_eq!(depths[..4], [3.0, 4.0, 4.0, 4.0]);
        assert_eq!(beyond(&vec![[8e8; 4]], BACKGROUND).map(|z| z < BACKGROUND), Some(true));
        assert_eq!(beyond(&vec![[1e10; 4]], BACKGROUND), None);
    }
}
