//! Legends under pictures: what colours stand for.

use crate::pictures::text::Font;
use crate::pictures::{Picture, PictureError};

const BACKGROUND: [u8; 3] = [24, 25, 29];
const TEXT: [u8; 3] = [255, 255, 255];
/// Pixels around texts and bars.
const GAP: u32 = 4;
const BAR_HEIGHT: u32 = 8;
/// Characters that a line should have room for, before the smallest font is taken.
const CHARACTERS: usize = 40;
const TALLEST: u32 = 13;

/// What the colours of a picture stand for: a title, bars of colours with numbers, and colours with names.
///
/// ```
/// # use atrous_lab::pictures::{ColourBar, Legend, Picture, PictureError};
/// # fn main() -> Result<(), PictureError> {
/// let grey: Vec<[u8; 3]> = (0..=255).map(|c| [c; 3]).collect();
/// let legend = Legend {
///     title: "depth".into(),
///     bars: vec![ColourBar { name: "metres".into(), colours: grey, marks: vec![(0.0, "0".into()), (1.0, "9".into())] }],
///     ..Legend::default()
/// };
/// assert!(legend.under(&Picture::filled(320, 180, [0; 3])?)?.height() > 180);
/// # Ok(()) }
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Legend {
    /// First line; may be empty.
    pub title: String,
    /// Colours of numbers.
    pub bars: Vec<ColourBar>,
    /// Colours of names.
    pub swatches: Vec<([u8; 3], String)>,
}

/// A range of numbers as colours.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourBar {
    /// The number and its unit; may be empty.
    pub name: String,
    /// 8-bit sRGB from the low end to the high one, evenly spaced.
    pub colours: Vec<[u8; 3]>,
    /// Numbers with their place, 0 to 1.
    pub marks: Vec<(f32, String)>,
}

impl Legend {
    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.title.is_empty() && self.bars.is_empty() && self.swatches.is_empty()
    }

    /// A picture with the legend below it, in a strip of its own: no pixel of the picture is covered. The picture itself where
    /// the legend is empty.
    ///
    /// # Errors
    /// [`PictureError::TooLarge`].
    pub fn under(&self, picture: &Picture) -> Result<Picture, PictureError> {
        if self.is_empty() {
            return Ok(picture.clone());
        }
        let room = picture.width().saturating_sub(2 * GAP);
        let font = Font::fitting(CHARACTERS, room, TALLEST, 1);
        let lines = self.lines(font, room);
        let height = lines.iter().map(|line| line.height(font) + GAP).sum::<u32>() + GAP;
        let mut whole = Picture::filled(picture.width(), picture.height().saturating_add(height), BACKGROUND)?;
        whole.paste(picture, 0, 0);
        let mut y = picture.height() + GAP;
        for line in &lines {
            line.draw(&mut whole, font, y, room);
            y += line.height(font) + GAP;
        }
        Ok(whole)
    }

    fn lines(&self, font: Font, room: u32) -> Vec<Line<'_>> {
        let text = |text: &str| wrapped(font, text, room).into_iter().map(Line::Text);
        let mut lines: Vec<_> = text(&self.title).collect();
        for bar in &self.bars {
            lines.extend(text(&bar.name));
            lines.push(Line::Bar(bar));
        }
        let mut row: Vec<(u32, [u8; 3], &str)> = Vec::new();
        let mut x = 0;
        for (colour, name) in &self.swatches {
            let width = font.height() + GAP + font.width_of(name);
            if x + width > room && !row.is_empty() {
                lines.push(Line::Swatches(std::mem::take(&mut row)));
                x = 0;
            }
            row.push((x, *colour, name));
            x += width + 2 * GAP;
        }
        if !row.is_empty() {
            lines.push(Line::Swatches(row));
        }
        lines
    }
}

/// The words of a text in lines that fit.
fn wrapped(font: Font, text: &str, room: u32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if font.width_of(line) + font.width_of(" ") + font.width_of(word) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

enum Line<'a> {
    Text(String),
    Bar(&'a ColourBar),
    /// Each at its place.
    Swatches(Vec<(u32, [u8; 3], &'a str)>),
}

impl Line<'_> {
    fn height(&self, font: Font) -> u32 {
        match self {
            Self::Text(_) | Self::Swatches(_) => font.height(),
            Self::Bar(_) => BAR_HEIGHT + font.height(),
        }
    }

    fn draw(&self, picture: &mut Picture, font: Font, y: u32, room: u32) {
        match self {
            Self::Text(text) => font.draw(picture, &font.shortened(text, room), [GAP as i32, y as i32], TEXT),
            Self::Bar(bar) => bar.draw(picture, font, y, room),
            Self::Swatches(row) => {
                for (x, colour, name) in row {
                    fill(picture, [GAP + x, y], [font.height(), font.height()], |_| *colour);
                    font.draw(picture, name, [(GAP + x + font.height() + GAP) as i32, y as i32], TEXT);
                }
            }
        }
    }
}

impl ColourBar {
    /// The colour at a place, 0 to 1; black for a bar without colours.
    pub fn colour(&self, place: f32) -> [u8; 3] {
        let last = self.colours.len().saturating_sub(1);
        let index = (place.clamp(0.0, 1.0) * last as f32).round() as usize;
        self.colours.get(index).copied().unwrap_or_default()
    }

    fn draw(&self, picture: &mut Picture, font: Font, y: u32, room: u32) {
        let end = room.saturating_sub(1).max(1);
        fill(picture, [GAP, y], [room, BAR_HEIGHT], |x| self.colour(x as f32 / end as f32));
        let mut free = 0;
        for (place, text) in &self.marks {
            let (width, at) = (font.width_of(text), (place.clamp(0.0, 1.0) * end as f32) as u32);
            let left = at.saturating_sub(width / 2).min(room.saturating_sub(width));
            // Numbers that would run into each other are left out.
            if left >= free {
                font.draw(picture, text, [(GAP + left) as i32, (y + BAR_HEIGHT) as i32], TEXT);
                free = left + width + font.width_of(" ");
            }
        }
    }
}

/// A rectangle whose columns have colours.
fn fill(picture: &mut Picture, [x, y]: [u32; 2], [width, height]: [u32; 2], colour: impl Fn(u32) -> [u8; 3]) {
    for (dx, dy) in (0..width).flat_map(|dx| (0..height).map(move |dy| (dx, dy))) {
        picture.set((x + dx).into(), (y + dy).into(), colour(dx));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(marks: &[(f32, &str)]) -> ColourBar {
        let marks = marks.iter().map(|(place, text)| (*place, (*text).to_owned())).collect();
        ColourBar { name: "frames".into(), colours: vec![[200, 0, 0], [0, 200, 0], [0, 0, 200]], marks }
    }

    fn white(picture: &Picture, rows: std::ops::Range<u32>) -> usize {
        rows.flat_map(|y| (0..picture.width()).map(move |x| (x, y))).filter(|(x, y)| picture.pixel(*x, *y) == Some(TEXT)).count()
    }

    #[test]
    fn the_picture_is_whole_and_the_bar_runs_from_end_to_end() {
        let picture = Picture::filled(200, 50, [9, 8, 7]).unwrap();
        let legend = Legend { bars: vec![bar(&[(0.0, "0"), (1.0, "32")])], ..Legend::default() };
        let whole = legend.under(&picture).unwrap();
        assert_eq!(whole.crop(crate::pictures::Region { x: 0, y: 0, width: 200, height: 50 }).unwrap(), picture);
        let row = (50..whole.height()).find(|y| whole.pixel(GAP, *y) == Some([200, 0, 0])).expect("a bar");
        let colours = [GAP, 100, 199 - GAP].map(|x| whole.pixel(x, row));
        assert_eq!(colours, [Some([200, 0, 0]), Some([0, 200, 0]), Some([0, 0, 200])]);
        assert!(white(&whole, 50..row) > 0 && white(&whole, row + BAR_HEIGHT..whole.height()) > 0, "name and numbers");
        assert_eq!(Legend::default().under(&picture).unwrap(), picture);
    }

    #[test]
    fn what_does_not_fit_goes_on_below_and_numbers_do_not_overlap() {
        let picture = Picture::filled(64, 4, [0; 3]).unwrap();
        let names = ["history", "off screen", "another id"].map(|name| ([1, 2, 3], name.to_owned()));
        let legend = |count: usize| Legend { title: "a b".into(), swatches: names[..count].to_vec(), ..Legend::default() };
        let height = |legend: &Legend| legend.under(&picture).unwrap().height();
        assert!(height(&legend(3)) > height(&legend(1)) && height(&legend(1)) > height(&legend(0)));
        let long = Legend { title: "one two three four five six".into(), ..Legend::default() };
        assert!(height(&long) > height(&legend(0)), "a long title has several lines");
        let drawn = |marks: &[(f32, &str)]| {
            let whole = Legend { bars: vec![bar(marks)], ..Legend::default() }.under(&picture).unwrap();
            white(&whole, 4..whole.height())
        };
        assert_eq!(drawn(&[(0.0, "111"), (0.3, "111")]), drawn(&[(0.0, "111")]));
        assert!(drawn(&[(0.0, "111"), (1.0, "111")]) > drawn(&[(0.0, "111")]));
    }
}
