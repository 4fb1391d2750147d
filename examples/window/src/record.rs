//! Pictures into files: what the window shows, at the picture's own size and without the panel.

use std::path::{Path, PathBuf};

use atrous::ToneCurve;
use atrous_lab::pictures::{srgb_8bit, Legend, Picture};

use super::content::Content;
use super::legend;
use super::panes::Panes;
use super::settings::Settings;
use crate::error::Result;
use atrous_engine::gpu::Gpu;

/// What there is to write.
pub struct Seen<'a> {
    /// The halves.
    pub panes: &'a Panes,
    /// How they are shown.
    pub settings: &'a Settings,
    /// Bit 0: left was tone-mapped, bit 1: right.
    pub display_referred: u32,
    /// What their colours stand for.
    pub legends: [Legend; 2],
}

/// The halves as they are, and together as the window has them.
pub struct Shot {
    extent: [u32; 2],
    /// Left and right, 8-bit sRGB.
    halves: [Vec<[u8; 3]>; 2],
    divider: f32,
    /// The range of the difference, where that is shown.
    difference: Option<f32>,
    contents: [Content; 2],
    legends: [Legend; 2],
}

impl Shot {
    /// Reads the panes back.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn take(gpu: &Gpu, seen: &Seen) -> Result<Self> {
        let Seen { panes, settings, display_referred, legends } = seen;
        let half = |side: usize| -> Result<Vec<[u8; 3]>> {
            let is_mapped = display_referred >> side & 1 != 0;
            let shown = |[r, g, b, _]: [f32; 4]| {
                let rgb = [r, g, b];
                let rgb = if is_mapped { rgb } else { tone_mapped(rgb.map(|c| c * settings.exposure), settings.tone_curve) };
                rgb.map(srgb_8bit)
            };
            Ok(gpu.read_image(&panes.images[side])?.into_iter().map(shown).collect())
        };
        let extent = [panes.extent().width, panes.extent().height];
        Ok(Self {
            extent,
            halves: [half(0)?, half(1)?],
            divider: settings.divider,
            difference: settings.difference.then_some(settings.difference_range),
            contents: [settings.left, settings.right],
            legends: legends.clone(),
        })
    }

    /// Both halves at the divider, or their difference.
    fn together(&self) -> Result<Picture> {
        let [width, height] = self.extent;
        let [left, right] = &self.halves;
        let pixels = match self.difference {
            Some(range) => left.iter().zip(right).map(|(l, r)| difference(*l, *r, range)).collect(),
            None => {
                let cut = self.divider * width as f32;
                let is_left = |i: usize| ((i as u32 % width) as f32 + 0.5) < cut;
                (0..left.len()).map(|i| if is_left(i) { left[i] } else { right[i] }).collect()
            }
        };
        Ok(Picture::from_pixels(width, height, pixels)?)
    }

    /// Both halves as the window has them, without a legend: frames of a sequence are of one size.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        Ok(self.together()?.write_png(path)?)
    }

    /// The same with legends below, under the next free number in a folder, with each half in a file of its own. Returns the first file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_all(&self, folder: &Path) -> Result<PathBuf> {
        make(folder)?;
        let number = (1..).find(|n| !folder.join(format!("picture_{n:04}.png")).exists()).unwrap_or(0);
        let both = folder.join(format!("picture_{number:04}.png"));
        let mut together = self.together()?;
        for legend in self.legends_together() {
            together = legend.under(&together)?;
        }
        together.write_png(&both)?;
        for (i, side) in ["left", "right"].into_iter().enumerate() {
            let name = format!("picture_{number:04}_{side}_{}.png", self.contents[i].to_string().replace('/', "_"));
            let half = Picture::from_pixels(self.extent[0], self.extent[1], self.halves[i].clone())?;
            legend::titled(&self.legends[i], &self.contents[i].title()).under(&half)?.write_png(folder.join(name))?;
        }
        Ok(both)
    }

    fn legends_together(&self) -> Vec<Legend> {
        let [left, right] = self.contents.map(Content::title);
        match self.difference {
            Some(range) => vec![legend::titled(&legend::of_difference(range), &format!("{right} minus {left}"))],
            None => vec![
                legend::titled(&self.legends[0], &format!("left: {left}")),
                legend::titled(&self.legends[1], &format!("right: {right}")),
            ],
        }
    }
}

/// As glsl/window/present.frag: right minus left in encoded values, grey where both are alike.
fn difference(left: [u8; 3], right: [u8; 3], range: f32) -> [u8; 3] {
    let of = |l: u8, r: u8| ((f32::from(r) - f32::from(l)) / (255.0 * range)).clamp(-1.0, 1.0);
    [0, 1, 2].map(|c| (127.5 + 127.5 * of(left[c], right[c])).round() as u8)
}

/// Makes a folder.
///
/// # Errors
/// One that cannot be made.
pub fn make(folder: &Path) -> Result<()> {
    let made = std::fs::create_dir_all(folder);
    Ok(made.map_err(|e| atrous_engine::Error::Folder { path: folder.to_owned(), problem: e.to_string() })?)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn shot(contents: [Content; 2]) -> Shot {
        let halves = [vec![[10; 3]; 8], vec![[200; 3]; 8]];
        let legends = [Legend::default(), Legend::default()];
        Shot { extent: [4, 2], halves, divider: 0.25, difference: None, contents, legends }
    }

    #[test]
    fn the_divider_cuts_where_it_stands_and_files_are_not_overwritten() {
        let folder = std::env::temp_dir().join(format!("atrous-shot-{}", std::process::id()));
        let shot = shot([Content::Noisy, Content::Reference]);
        let first = shot.write_all(&folder).expect("written");
        assert_ne!(first, shot.write_all(&folder).expect("written"));
        let picture = Picture::read_png(&first).expect("read");
        assert_eq!((0..4).map(|x| picture.pixel(x, 1).expect("inside")[0]).collect::<Vec<_>>(), [10, 200, 200, 200]);
        assert_eq!(std::fs::read_dir(&folder).expect("folder").count(), 6);
        let _ = std::fs::remove_dir_all(folder);
    }

    #[test]
    fn a_written_picture_has_its_legends_below_and_a_frame_of_a_sequence_has_none() {
        let folder = std::env::temp_dir().join(format!("atrous-legend-{}", std::process::id()));
        let view = Content::Debug(atrous::config::Preset::Svgf, atrous::DebugView::HistoryLength);
        let legends = [Legend::default(), legend::of_content(view, 0, &[])];
        let shot = Shot { legends, ..shot([Content::Noisy, view]) };
        let both = shot.write_all(&folder).expect("written");
        let side = |name: &str| Picture::read_png(folder.join(format!("picture_0001{name}.png"))).expect("read");
        assert!(side("").height() > 2 && side("_right_svgf_history_length").height() > 2);
        assert_eq!(side("_left_noisy").height(), 2);
        assert_eq!(side("").pixel(3, 1), Some([200; 3]), "no pixel is covered");
        shot.write(&both).expect("written");
        assert_eq!(side("").height(), 2);
        let _ = std::fs::remove_dir_all(folder);
    }

    #[test]
    fn a_difference_is_grey_where_nothing_differs() {
        assert_eq!(difference([90, 90, 90], [90, 77, 103], 0.2), [128, 95, 160]);
        assert_eq!(difference([255, 0, 100], [0, 255, 100], 0.1), [0, 255, 128]);
        let shot = Shot { difference: Some(1.0), ..shot([Content::Noisy, Content::Reference]) };
        assert_eq!(shot.together().expect("a picture").pixel(0, 0), Some([223; 3]));
        assert!(shot.legends_together()[0].title.contains("reference minus noisy"));
    }

    #[test]
    fn white_is_white_and_black_is_black() {
        assert_eq!([0.0, 1.0, 7.0].map(srgb_8bit), [0, 255, 255]);
        for curve in ToneCurve::ALL {
            assert_eq!(tone_mapped([0.0; 3], curve), [0.0; 3]);
            assert!(tone_mapped([1e6; 3], curve)[0] > 0.9);
        }
    }
}
