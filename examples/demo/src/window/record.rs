//! Pictures into files: what the window shows, at the picture's own size and without the panel.

use std::path::{Path, PathBuf};

use atrous::ToneCurve;
use atrous_picture::Picture;

use super::content::Content;
use super::panes::Panes;
use super::settings::Settings;
use crate::error::{Error, Result};
use crate::gpu::Gpu;

/// The halves as they are, and as the divider has them.
pub struct Shot {
    extent: [u32; 2],
    /// Left and right, 8-bit sRGB.
    halves: [Vec<[u8; 3]>; 2],
    divider: f32,
    contents: [Content; 2],
}

impl Shot {
    /// Reads the panes back. Bit 0 of `display_referred`: left was tone-mapped, bit 1: right.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn take(gpu: &Gpu, panes: &Panes, settings: &Settings, display_referred: u32) -> Result<Self> {
        let half = |side: usize| -> Result<Vec<[u8; 3]>> {
            let is_mapped = display_referred >> side & 1 != 0;
            let shown = |[r, g, b, _]: [f32; 4]| {
                let rgb = [r, g, b];
                let rgb = if is_mapped { rgb } else { tone_mapped(rgb.map(|c| c * settings.exposure), settings.tone_curve) };
                rgb.map(srgb)
            };
            Ok(gpu.read_image(&panes.images[side])?.into_iter().map(shown).collect())
        };
        let extent = [panes.extent().width, panes.extent().height];
        Ok(Self { extent, halves: [half(0)?, half(1)?], divider: settings.divider, contents: [settings.left, settings.right] })
    }

    /// Both halves at the divider.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let [width, height] = self.extent;
        let cut = self.divider * width as f32;
        let is_left = |i: usize| ((i as u32 % width) as f32 + 0.5) < cut;
        let pixels = (0..self.halves[0].len()).map(|i| self.halves[usize::from(!is_left(i))][i]).collect();
        Ok(Picture::from_pixels(width, height, pixels)?.write_png(path)?)
    }

    /// The same under the next free number in a folder, with each half in a file of its own. Returns the first file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_all(&self, folder: &Path) -> Result<PathBuf> {
        make(folder)?;
        let number = (1..).find(|n| !folder.join(format!("picture_{n:04}.png")).exists()).unwrap_or(0);
        let both = folder.join(format!("picture_{number:04}.png"));
        self.write(&both)?;
        for (side, (half, content)) in ["left", "right"].into_iter().zip(self.halves.iter().zip(self.contents)) {
            let name = format!("picture_{number:04}_{side}_{}.png", content.to_string().replace('/', "_"));
            Picture::from_pixels(self.extent[0], self.extent[1], half.clone())?.write_png(folder.join(name))?;
        }
        Ok(both)
    }
}

/// Makes a folder.
///
/// # Errors
/// One that cannot be made.
pub fn make(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(|e| Error::Folder { path: folder.to_owned(), problem: e.to_string() })
}

/// As glsl/window/present.frag for a display that ends at white.
fn tone_mapped(x: [f32; 3], curve: ToneCurve) -> [f32; 3] {
    let x = x.map(|c| c.max(0.0));
    let luminance = 0.2126 * x[0] + 0.7152 * x[1] + 0.0722 * x[2];
    match curve {
        ToneCurve::Aces => x.map(|c| c.min(1e4)).map(|c| c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14)),
        ToneCurve::Reinhard => x.map(|c| c / (1.0 + luminance)),
        _ => x,
    }
}

fn srgb(x: f32) -> u8 {
    let x = x.clamp(0.0, 1.0);
    let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_divider_cuts_where_it_stands_and_files_are_not_overwritten() {
        let folder = std::env::temp_dir().join(format!("atrous-shot-{}", std::process::id()));
        let halves = [vec![[10; 3]; 8], vec![[200; 3]; 8]];
        let shot = Shot { extent: [4, 2], halves, divider: 0.25, contents: [Content::Noisy, Content::Reference] };
        let first = shot.write_all(&folder).expect("written");
        assert_ne!(first, shot.write_all(&folder).expect("written"));
        let picture = Picture::read_png(&first).expect("read");
        assert_eq!((0..4).map(|x| picture.pixel(x, 1).expect("inside")[0]).collect::<Vec<_>>(), [10, 200, 200, 200]);
        assert_eq!(std::fs::read_dir(&folder).expect("folder").count(), 6);
        let _ = std::fs::remove_dir_all(folder);
    }

    #[test]
    fn white_is_white_and_black_is_black() {
        assert_eq!([0.0, 1.0, 7.0].map(srgb), [0, 255, 255]);
        for curve in ToneCurve::ALL {
            assert_eq!(tone_mapped([0.0; 3], curve), [0.0; 3]);
            assert!(tone_mapped([1e6; 3], curve)[0] > 0.9);
        }
    }
}
