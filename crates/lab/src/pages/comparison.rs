//! Pictures of one size, two at a time with a line between them that is dragged.

use crate::pages::{HeatMap, PageError};
use crate::pictures::Picture;
use base64::engine::general_purpose::STANDARD;
use base64::Engine;
use maud::{html, Markup};

/// Pictures of one size that are compared in place: one left and one right of a handle that is dragged over them, enlarged by
/// whole factors. Heat maps are pictures like others, with their colour bar below.
#[derive(Debug, Clone)]
pub struct Comparison {
    caption: String,
    extent: Option<[u32; 2]>,
    layers: Vec<Layer>,
    start: Option<[usize; 2]>,
}

#[derive(Debug, Clone)]
struct Layer {
    name: String,
    /// PNG as a `data:` address.
    address: String,
    /// Values of the first and last colour of a heat map.
    range: Option<[f32; 2]>,
}

impl Comparison {
    /// A comparison without pictures.
    pub fn new(caption: impl Into<String>) -> Self {
        Self { caption: caption.into(), extent: None, layers: Vec::new(), start: None }
    }

    /// Adds a picture. The first is shown at the left and the last at the right, until the reader or [`Self::start`] chooses.
    ///
    /// # Errors
    /// [`PageError::PictureSize`] if another has another size; [`PageError::SameName`]; [`PageError::Picture`] if it cannot be
    /// encoded.
    pub fn picture(&mut self, name: impl Into<String>, picture: &Picture) -> Result<(), PageError> {
        self.layer(name.into(), picture, None)
    }

    /// Adds a heat map, such as the error of a picture.
    ///
    /// # Errors
    /// Errors of [`Self::picture`].
    pub fn heat_map(&mut self, name: impl Into<String>, map: &HeatMap) -> Result<(), PageError> {
        self.layer(name.into(), &map.picture, Some(map.range))
    }

    /// Chooses the pictures that are shown when the page opens.
    ///
    /// # Errors
    /// [`PageError::NoPicture`] if there is none of that name yet.
    pub fn start(&mut self, left: &str, right: &str) -> Result<(), PageError> {
        let find = |name: &str| self.layers.iter().position(|l| l.name == name).ok_or_else(|| PageError::NoPicture(name.into()));
        self.start = Some([find(left)?, find(right)?]);
        Ok(())
    }

    fn layer(&mut self, name: String, picture: &Picture, range: Option<[f32; 2]>) -> Result<(), PageError> {
        let given = [picture.width(), picture.height()];
        let expected = self.extent.unwrap_or(given);
        if given != expected {
            return Err(PageError::PictureSize { name, given, expected });
        }
        if self.layers.iter().any(|l| l.name == name) {
            return Err(PageError::SameName(name));
        }
        // Encoded at once: what waits for the page to be written is small.
        let address = format!("data:image/png;base64,{}", STANDARD.encode(picture.to_png()?));
        self.extent = Some(expected);
        self.layers.push(Layer { name, address, range });
        Ok(())
    }

    pub(crate) fn check(&self) -> Result<(), PageError> {
        match self.layers.len() {
            given @ (0 | 1) => Err(PageError::TooFewPictures { caption: self.caption.clone(), given }),
            _ => Ok(()),
        }
    }

    /// Left and right when the page opens.
    fn shown(&self) -> [usize; 2] {
        let last = self.layers.iter().rposition(|l| l.range.is_none()).filter(|&i| i > 0).unwrap_or(self.layers.len() - 1);
        self.start.unwrap_or([0, last])
    }

    pub(crate) fn markup(&self) -> Markup {
        let [width, height] = self.extent.unwrap_or_default();
        let [left, right] = self.shown();
        html! {
            figure.comparison {
                figcaption { (self.caption) }
                div.controls {
                    label { "Left " (self.choice("choose-left", left)) }
                    label { "Right " (self.choice("choose-right", right)) }
                    label { "Zoom " select.zoom autocomplete="off" {
                        option value="0" { "Fit" }
                        @for zoom in 1..=4 { option value=(zoom) { (zoom) "×" } }
                    } }
                }
                div.frame {
                    div.viewport {
                        div.stage data-width=(width) style=(format!("--width:{width};--height:{height}")) {
                            @for (i, layer) in self.layers.iter().enumerate() {
                                // Laid one over the other; the style shows those that are chosen. A choice waits for its picture:
                                // an empty stage in between would hide the very difference that the reader looks for.
                                img .layer .left[i == left] .right[i == right] src=(layer.address) alt=(layer.name)
                                    width=(width) height=(height) decoding="sync" draggable="false";
                            }
                            input.split type="range" min="0" max="100" step="1" value="50" autocomplete="off"
                                aria-label=(format!("{}: where the left picture ends, percent", self.caption));
                            div.handle {}
                        }
                    }
                    span.tag.of-left { (self.layers[left].name) }
                    span.tag.of-right { (self.layers[right].name) }
                }
                @for (i, layer) in self.layers.iter().enumerate() {
                    @if let Some([low, high]) = layer.range {
                        div.colour-bar data-layer=(i) hidden[i != left && i != right] {
                            span.of { (layer.name) } span.scale { (low) span.magma {} (high) }
                        }
                    }
                }
            }
        }
    }

    fn choice(&self, class: &str, chosen: usize) -> Markup {
        let options = |heat: bool| {
            html! { @for (i, layer) in self.layers.iter().enumerate().filter(|(_, l)| l.range.is_some() == heat) {
                option value=(i) selected[i == chosen] { (layer.name) }
            } }
        };
        let heat = self.layers.iter().any(|l| l.range.is_some());
        html! {
            // A reload must not keep a choice that the picture does not show.
            select class=(class) autocomplete="off" {
                (options(false))
                @if heat { optgroup label="Heat maps" { (options(true)) } }
            }
        }
    }
}
