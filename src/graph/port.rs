//! Ports of nodes: images of a graph, typed by their content.

use super::Feedback;
use crate::contract::ResourceId;
use std::marker::PhantomData;

/// An image of a graph with the content that one node left in it.
///
/// A node that works in place leaves new content in the same image. The value from before is stale
/// then, and a graph that still reads it is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Image {
    pub(super) graph: u32,
    pub(super) id: ResourceId,
    /// Passes that had written the image when this value was made.
    pub(super) version: u32,
}

impl Image {
    /// An image of no graph.
    pub(crate) const NONE: Self = Self { graph: u32::MAX, id: ResourceId(u32::MAX), version: 0 };
}

/// What visibility is of.
#[derive(Clone, Copy, Debug)]
pub struct Lights {
    /// Number of lights, 1 to 4. Default: 1.
    pub count: u32,
    /// Whether their visibility has red, green and blue. Default: false.
    pub coloured: bool,
    /// Whether it is no light's, but that of all directions: ambient occlusion. Default: false.
    pub ambient: bool,
}

impl Default for Lights {
    fn default() -> Self {
        Self::ONE
    }
}

impl Lights {
    const ONE: Self = Self { count: 1, coloured: false, ambient: false };
}

/// Images of a port at most.
const MOST_IMAGES: usize = 4;

/// One image of one kind, or two: one for each signal that is filtered in the same passes. Of [`Visibility`] up to four, one for each
/// light.
///
/// A port of a different kind does not compile here. [`Port::of`] makes a port from an image that a
/// stage of yours wrote.
#[derive(Debug)]
pub struct Port<K> {
    images: [Image; MOST_IMAGES],
    count: usize,
    /// Whether a negative alpha marks pixels without a sample of their own.
    holes: bool,
    /// Of visibility: the lights whose words a texel has.
    lights: Lights,
    kind: PhantomData<K>,
}

// Not derived: a derive would ask the same of the kind, which has no values.
impl<K> Clone for Port<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K> Copy for Port<K> {}

impl<K> Port<K> {
    /// A port of one image. You vouch for its content; its format is checked by its reader.
    pub fn of(image: Image) -> Self {
        Self { images: [image; MOST_IMAGES], count: 1, holes: false, lights: Lights::ONE, kind: PhantomData }
    }

    pub(crate) fn of_images(images: &[Image]) -> Option<Self> {
        let last = images.last()?;
        let all = std::array::from_fn(|i| *images.get(i).unwrap_or(last));
        (images.len() <= MOST_IMAGES).then_some(Self {
            images: all,
            count: images.len(),
            holes: false,
            lights: Lights::ONE,
            kind: PhantomData,
        })
    }

    /// The images, one for each signal.
    pub fn images(&self) -> &[Image] {
        &self.images[..self.count]
    }

    /// The image of the first signal, or of the only one.
    pub fn image(&self) -> Image {
        self.images[0]
    }

    /// Number of images: of signals 1 or 2, of lights up to 4.
    pub fn signals(&self) -> usize {
        self.count
    }

    /// The images of this port under a different kind, for code that two kinds share.
    pub(crate) fn cast<L>(self) -> Port<L> {
        Port { images: self.images, count: self.count, holes: false, lights: self.lights, kind: PhantomData }
    }

    pub(crate) fn has_filled_holes(&self) -> bool {
        self.holes
    }
}

/// Kinds of a [`Port`]: the content of its images.
pub mod kind {
    /// Linear HDR radiance in rgb.
    #[derive(Debug)]
    pub enum Radiance {}
    /// Radiance divided by the albedo, in rgb; half floats.
    #[derive(Debug)]
    pub enum Irradiance {}
    /// Irradiance in rgb, blended with its past; in alpha the history length in frames, or the negative [`crate::reference::Reason`]
    /// of its loss. Half floats.
    #[derive(Debug)]
    pub enum Accumulated {}
    /// Irradiance in rgb with the standard deviation of its luminance in alpha; half floats.
    #[derive(Debug)]
    pub enum Estimate {}
    /// Radiance of a volume, which no albedo divides, in rgb; half floats.
    #[derive(Debug)]
    pub enum VolumeRadiance {}
    /// Radiance of a volume in rgb, blended with its past; alpha as of [`Accumulated`].
    #[derive(Debug)]
    pub enum VolumeAccumulated {}
    /// Radiance of a volume in rgb with the standard deviation of its luminance in alpha; half floats.
    #[derive(Debug)]
    pub enum VolumeEstimate {}
    /// Motion of a volume in pixels, two packed half floats.
    #[derive(Debug)]
    pub enum VolumeMotion {}
    /// Share of the history that is still true: 1, keep it, to 0, drop it.
    #[derive(Debug)]
    pub enum Confidence {}
    /// Certainty that light did not change, for every 8×8 pixels: 1, no difference from the
    /// history, to 0.
    #[derive(Debug)]
    pub enum Steadiness {}
    /// Percentiles of luminance for every 8×8 pixels, packed half floats.
    #[derive(Debug)]
    pub enum Percentiles {}
    /// The brightest luminance that is no outlier, for every 8×8 pixels, packed half floats.
    #[derive(Debug)]
    pub enum FireflyLimits {}
    /// Departure of a frame from its history, for every 8×8 pixels, packed.
    #[derive(Debug)]
    pub enum Difference {}
    /// Display-referred linear colour in rgb, 0 to 1.
    #[derive(Debug)]
    pub enum Display {}
    /// Visibility of lights with the distances of their occluders, packed half floats; in colour a second image has green and blue.
    #[derive(Debug)]
    pub enum VisibilitySamples {}
    /// Visibility of lights, blended with its past; packed; in colour a second image has green and blue.
    #[derive(Debug)]
    pub enum VisibilityAccumulated {}
    /// Visible share of each light: 0, none, to 1, all of it.
    #[derive(Debug)]
    pub enum Visibility {}
}

/// Linear HDR radiance.
pub type Radiance = Port<kind::Radiance>;
/// Radiance divided by the albedo.
pub type Irradiance = Port<kind::Irradiance>;
/// Irradiance with its history length.
pub type Accumulated = Port<kind::Accumulated>;
/// Irradiance with the standard deviation of its luminance.
pub type Estimate = Port<kind::Estimate>;
/// Radiance of a volume.
pub type VolumeRadiance = Port<kind::VolumeRadiance>;
/// Radiance of a volume with its history length.
pub type VolumeAccumulated = Port<kind::VolumeAccumulated>;
/// Radiance of a volume with the standard deviation of its luminance.
pub type VolumeEstimate = Port<kind::VolumeEstimate>;
/// Motion of a volume.
pub type VolumeMotion = Port<kind::VolumeMotion>;
/// Share of the history that is still true.
pub type Confidence = Port<kind::Confidence>;
/// Certainty that light did not change.
pub type Steadiness = Port<kind::Steadiness>;
/// Percentiles of luminance of blocks.
pub type Percentiles = Port<kind::Percentiles>;
/// The brightest luminance of blocks that is no outlier.
pub type FireflyLimits = Port<kind::FireflyLimits>;
/// Departure of blocks from their history.
pub type Difference = Port<kind::Difference>;
/// Display-referred linear colour.
pub type Display = Port<kind::Display>;
/// Visibility of lights as you gave it.
pub type VisibilitySamples = Port<kind::VisibilitySamples>;
/// Visibility of lights, blended with its past.
pub type VisibilityAccumulated = Port<kind::VisibilityAccumulated>;
/// Visible share of each light.
pub type Visibility = Port<kind::Visibility>;

impl<K> Port<K> {
    /// A port of words for these lights.
    pub(crate) fn with_lights(self, lights: Lights) -> Self {
        Self { lights, ..self }
    }

    pub(crate) fn lights(&self) -> Lights {
        self.lights
    }
}

impl Irradiance {
    /// Declares that a negative alpha marks pixels without a sample of their own, whose irradiance
    /// was filled in. The node `fill_holes` does this itself; call it for images that a stage of
    /// yours wrote. An accumulation keeps the history of such pixels, and counts the filled-in
    /// light for half a frame.
    pub(crate) fn with_filled_holes(mut self) -> Self {
        self.holes = true;
        self
    }
}

impl Accumulated {
    /// Remembers whether pixels were filled in, for the estimate of their variance.
    pub(crate) fn with_holes_of(mut self, irradiance: &Irradiance) -> Self {
        self.holes = irradiance.holes;
        self
    }
}

impl From<Accumulated> for Irradiance {
    fn from(accumulated: Accumulated) -> Self {
        accumulated.cast()
    }
}

impl From<Estimate> for Irradiance {
    fn from(estimate: Estimate) -> Self {
        estimate.cast()
    }
}

impl From<VolumeEstimate> for Radiance {
    fn from(estimate: VolumeEstimate) -> Self {
        estimate.cast()
    }
}

/// Packed guides of a frame, as the node `import` writes them. `docs/specification/packed_images.md` has the bits.
#[derive(Clone, Copy, Debug)]
pub struct Guides {
    /// Depth and how it changes from a pixel to the next, normal and id of every pixel; four times 16 bits.
    pub guide: Image,
    /// Motion of the surface to the previous frame, change of its depth, and its normal there; four times 16 bits.
    pub surface_motion: Image,
    /// Object-space normal, if you have one; packed, 32 bits.
    pub object_normal: Option<Image>,
    /// Your class of materials, if you have one.
    pub material_class: Option<Image>,
    pub(crate) rendered: Rendered,
}

/// Where the guides of rendered pixels are, of which [`Guides`] has those of the pixels with light.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rendered {
    /// In the same images: every pixel has light.
    Stored,
    /// In the images of the host, with or without its `surface_id`, and with the albedo by which light is divided: no image has
    /// those of all pixels.
    Host { surface_id: bool, albedo: bool },
}

/// The history that the next frame accumulates onto: colour and moments of luminance of every signal.
#[derive(Clone, Copy, Debug)]
pub struct History {
    pub(crate) colour: [Image; 2],
    pub(crate) luminance_history: [Image; 2],
    /// Mean and deviation of this frame, until the node `variance` puts them into the history.
    pub(crate) new_luminance: [Image; 2],
    pub(crate) feedback: Feedback,
    pub(crate) count: usize,
}

impl History {
    /// Colour of every signal. rgb: irradiance; alpha: the standard deviation of its luminance.
    pub fn colour(&self) -> &[Image] {
        &self.colour[..self.count]
    }

    /// Mean and deviation of luminance, history length and the reason of a loss, of every signal; four times 16 bits. The node
    /// `variance` writes them.
    pub fn luminance_history(&self) -> &[Image] {
        &self.luminance_history[..self.count]
    }

    /// The histories of two signals as one.
    pub(crate) fn beside(self, second: Self) -> Self {
        Self {
            colour: [self.colour[0], second.colour[0]],
            luminance_history: [self.luminance_history[0], second.luminance_history[0]],
            new_luminance: [self.new_luminance[0], second.new_luminance[0]],
            feedback: self.feedback,
            count: 2,
        }
    }

    pub(crate) fn new_luminance(&self) -> &[Image] {
        &self.new_luminance[..self.count]
    }
}

/// Reflection in each surface: its filtered hit distance, and the roughness that blurs it; two
/// packed half floats, which the next frame reads as well.
#[derive(Clone, Copy, Debug)]
pub struct Reflection {
    /// Hit distance in scene units (0: unknown; 65504: beyond the scene), and perceptual roughness.
    pub image: Image,
    /// Whether the signal has diffuse light as well.
    pub(crate) mixed: bool,
}

/// Temporal gradients, one texel per stratum, with the guide that steers their reconstruction.
/// \[ASVGF\] 3.3, 3.4.
#[derive(Clone, Copy, Debug)]
pub struct Gradient {
    pub(crate) image: Image,
    pub(crate) guide: Image,
    pub(crate) stratum_size: u32,
    pub(crate) kept: Option<KeptLuminance>,
    /// Light of the samples in both frames, while they are being filtered.
    pub(crate) light: Option<[Image; 2]>,
    pub(crate) light_ratio: Option<LightRatio>,
}

/// Ratio of the light of this frame to that of the previous one, one texel per stratum. rgb: the
/// ratio of each component, 0 to 64, as far as it is known; alpha: 1 where all samples agree on it,
/// down to 0, and -1 in the background.
#[derive(Clone, Copy, Debug)]
pub struct LightRatio {
    /// The image.
    pub image: Image,
    pub(crate) stratum_size: u32,
}

/// Luminance that one frame keeps, so that the next one can measure its change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeptLuminance {
    /// The history: luminance of the radiance, and of the albedo.
    pub image: Image,
    /// The history of red and blue, for the ratio of light.
    pub red_blue: Option<Image>,
    /// The radiance that is compared.
    pub of: Radiance,
    /// Side of the square of pixels that a texel stands for: 1, or that of a stratum.
    pub side: u32,
    /// The pixel of each stratum whose light is kept; none where that of every pixel is.
    pub candidates: Option<Image>,
}

impl Gradient {
    /// The gradients. x: change of luminance δ; y: larger luminance Δ; z, w: mean and deviation of luminance.
    pub fn image(&self) -> Image {
        self.image
    }

    /// The ratio of light, after [`Graph::gradient_atrous`](super::Graph::gradient_atrous) of gradients that were made by
    /// [`Graph::gradient_and_ratio`](super::Graph::gradient_and_ratio).
    pub fn light_ratio(&self) -> Option<LightRatio> {
        self.light_ratio
    }

    /// For a history that no ratio of light scales.
    pub(crate) fn without_ratio(self) -> Self {
        Self { light_ratio: None, ..self }
    }
}

/// Re-shaded pixels, at most one per stratum. \[ASVGF\] 3.1.
#[derive(Clone, Copy, Debug)]
pub struct GradientSamples {
    pub(crate) image: Image,
    /// The pixel of every stratum that the next frame carries forward.
    pub(crate) candidates: Image,
    pub(crate) stratum_size: u32,
}

impl GradientSamples {
    /// The image for `glsl/host/gradient_sample.glsl`.
    pub fn image(&self) -> Image {
        self.image
    }
}
