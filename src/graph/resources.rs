//! Images and buffers of a graph: names, formats, lifetimes, and who reads the previous copy.

use super::{Feedback, GradientSamples, Graph, History, Image, Port, Radiance, ResourceState};
use crate::contract::{component_of, Component, ImageFormat, Input, Lifetime, ResourceDecl, ResourceId, Shape, TexelGrid};
use ash::vk;

/// Linear HDR colour with a fourth value.
pub(crate) const HDR: ImageFormat = ImageFormat::Exactly(vk::Format::R16G16B16A16_SFLOAT);
/// The same in 32 bits a component.
pub(crate) const WIDE_HDR: ImageFormat = ImageFormat::Exactly(vk::Format::R32G32B32A32_SFLOAT);
/// 64 packed bits. Four times 16 and not twice 32, since that one needs no device feature as a storage image.
pub(crate) const PACKED_64: ImageFormat = ImageFormat::Exactly(vk::Format::R16G16B16A16_UINT);
/// Four times 32 packed bits.
pub(crate) const PACKED_128: ImageFormat = ImageFormat::Exactly(vk::Format::R32G32B32A32_UINT);
/// 32 packed bits.
pub(crate) const PACKED_32: ImageFormat = ImageFormat::Exactly(vk::Format::R32_UINT);
/// Colour of a name that a host chose.
pub(super) const HOST_COLOUR: ImageFormat = ImageFormat::Any(Component::Float, vk::Format::R16G16B16A16_SFLOAT);
/// A number from 0 to 1, which you may use elsewhere.
pub(crate) const CONFIDENCE: ImageFormat = ImageFormat::Exactly(vk::Format::R32_SFLOAT);

impl Graph {
    /// Your linear HDR radiance. The name after `noisy_` is the label of the signal: for example,
    /// `noisy_direct` gives `luminance_history_direct`; `noisy_radiance`, and a name without that prefix,
    /// none.
    pub fn radiance(&mut self, name: &str) -> Radiance {
        let image = self.host_colour(name);
        let label = name.strip_prefix("noisy_").filter(|label| *label != "radiance").unwrap_or_default();
        self.states[image.id.0 as usize].label = label.to_owned();
        Port::of(image)
    }

    /// Two signals that are filtered in the same passes with shared geometry weights, as \[SVGF\] does with direct and indirect
    /// light.
    pub fn pair<K>(&mut self, first: &Port<K>, second: &Port<K>) -> Port<K> {
        let images: Vec<_> = first.images().iter().chain(second.images()).copied().collect();
        Port::of_images(&images).filter(|_| images.len() <= 2).unwrap_or_else(|| {
            self.fail(
                "pair",
                "second",
                format!("{} signals were given; at most two are filtered in the same passes", images.len()),
            );
            *first
        })
    }

    /// An image with one texel for every `divisor` × `divisor` pixels, for your own use between
    /// stages of yours: see `StageCall`, which needs the feature `host-stages`.
    pub fn transient(&mut self, name: &str, format: vk::Format, divisor: u32) -> Image {
        let name = self.scoped(name, "");
        if component_of(format).is_none() {
            self.fail("transient", &name, format!("its format is {format:?}; give {}", crate::contract::texel::ACCEPTED));
        }
        if divisor == 0 {
            self.fail("transient", &name, "its divisor is 0; give 1 for a texel a pixel, or the side of a stratum".to_owned());
        }
        self.image(name, ImageFormat::Exactly(format), divisor.max(1), Lifetime::Transient)
    }

    /// Makes the history that an accumulation of these signals leaves for the next frame. Make it before the nodes that read the
    /// previous one.
    pub fn history<K>(&mut self, of: &Port<K>, feedback: Feedback) -> History {
        let (mut colour, mut luminance_history, mut new_luminance) = (of.images().to_vec(), Vec::new(), Vec::new());
        for image in &mut colour {
            let label = self.label(*image).to_owned();
            let writer = match feedback {
                Feedback::Filtered => "give it to the `feedback` of a filter, or make it with `Feedback::Accumulated`",
                Feedback::Accumulated => "give it to the node `variance`",
            };
            *image = self.history_in_place("irradiance_history", &label, HDR, 1, writer);
            luminance_history.push(self.history_in_place(
                "luminance_history",
                &label,
                PACKED_32,
                1,
                "give it to the node `variance`",
            ));
            new_luminance.push(self.named_image("new_luminance", &label, PACKED_32, 1, Lifetime::Transient));
        }
        let both = |images: &[Image]| [images[0], images[images.len() - 1]];
        History {
            colour: both(&colour),
            luminance_history: both(&luminance_history),
            new_luminance: both(&new_luminance),
            feedback,
            count: of.signals(),
        }
    }

    /// A history with one copy. `writer` names the node that writes it.
    pub(crate) fn history_in_place(
        &mut self,
        base: &str,
        label: &str,
        format: ImageFormat,
        texels: impl Into<TexelGrid>,
        writer: &'static str,
    ) -> Image {
        let image = self.named_image(base, label, format, texels, Lifetime::HistoryInPlace);
        self.states[image.id.0 as usize].writer = Some(writer);
        image
    }

    /// An image of a signal.
    pub(crate) fn named_image(
        &mut self,
        base: &str,
        label: &str,
        format: ImageFormat,
        texels: impl Into<TexelGrid>,
        lifetime: Lifetime,
    ) -> Image {
        let name = self.scoped(base, label);
        let image = self.image(name, format, texels, lifetime);
        self.states[image.id.0 as usize].label = label.to_owned();
        image
    }

    /// An input image of the table; the same twice is the same input.
    pub(crate) fn input(&mut self, input: Input) -> Image {
        self.input_per(input, 1)
    }

    /// [`Self::input`] with a texel for every `divisor` × `divisor` pixels.
    pub(crate) fn input_per(&mut self, input: Input, divisor: u32) -> Image {
        match input.kind.format() {
            Some(format) if divisor == 1 && !input.is_of_light() => {
                self.input_image(input.name, format, TexelGrid::Rendered(1), input.optional)
            }
            Some(format) => self.input_image(input.name, format, divisor, input.optional),
            None => self.instance_transforms(),
        }
    }

    /// An input that a node before asked for.
    pub(crate) fn given(&self, input: Input) -> Option<Image> {
        let index = self.resources.iter().position(|r| r.name == input.name)?;
        Some(self.current(ResourceId(index as u32)))
    }

    /// A colour image of a name that the host chose.
    pub(crate) fn host_colour(&mut self, name: &str) -> Image {
        self.input_image(name, HOST_COLOUR, 1, false)
    }

    pub(super) fn input_image(&mut self, name: &str, format: ImageFormat, texels: impl Into<TexelGrid>, optional: bool) -> Image {
        match self.resources.iter().position(|r| r.name == name) {
            Some(index) => self.current(ResourceId(index as u32)),
            None => self.image(name.to_owned(), format, texels, Lifetime::Input { optional }),
        }
    }

    fn instance_transforms(&mut self) -> Image {
        const BYTES_EACH: u64 = 48;
        let Input { name, optional, .. } = Input::INSTANCE_TRANSFORMS;
        let found = self.resources.iter().position(|r| r.name == name).map(|index| ResourceId(index as u32));
        let id = found.unwrap_or_else(|| self.buffer(name, BYTES_EACH, Lifetime::Input { optional }));
        self.current(id)
    }

    pub(crate) fn buffer(&mut self, name: &str, size: u64, lifetime: Lifetime) -> ResourceId {
        self.resource(name.to_owned(), Shape::Buffer { size }, lifetime)
    }

    fn image(&mut self, name: String, format: ImageFormat, texels: impl Into<TexelGrid>, lifetime: Lifetime) -> Image {
        self.claim_name(&name, &name);
        let texels = match texels.into() {
            TexelGrid::Light(side) if !self.has_light_extent() => TexelGrid::Rendered(side),
            texels => texels,
        };
        let id = self.resource(name, Shape::Image { format, texels }, lifetime);
        self.current(id)
    }

    fn resource(&mut self, name: String, shape: Shape, lifetime: Lifetime) -> ResourceId {
        let (image_usage, buffer_usage) = (vk::ImageUsageFlags::empty(), vk::BufferUsageFlags::empty());
        self.resources.push(ResourceDecl { name, shape, lifetime, image_usage, buffer_usage });
        self.states.push(ResourceState::default());
        ResourceId(self.resources.len() as u32 - 1)
    }

    fn claim_name(&mut self, node: &str, name: &str) {
        if self.resources.iter().any(|r| r.name == name) {
            self.fail(node, name, "a resource has this name already; put the second node into a `Graph::scope`".to_owned());
        }
    }

    /// A resource with the content that it has now.
    pub(crate) fn current(&self, id: ResourceId) -> Image {
        Image { graph: self.key, id, version: self.states[id.0 as usize].version }
    }

    /// The image with the content that it has now.
    pub(crate) fn refreshed(&self, image: Image) -> Image {
        if image.graph == self.key {
            self.current(image.id)
        } else {
            image
        }
    }

    /// The format of an image of this graph.
    pub(crate) fn format_of(&self, image: Image) -> Option<ImageFormat> {
        let own = Some(image).filter(|image| image.graph == self.key);
        match self.resources.get(own?.id.0 as usize)?.shape {
            Shape::Image { format, .. } => Some(format),
            Shape::Buffer { .. } => None,
        }
    }

    /// The texels of an image of this graph.
    pub(crate) fn texels_of(&self, image: Image) -> Option<TexelGrid> {
        let own = Some(image).filter(|image| image.graph == self.key);
        match self.resources.get(own?.id.0 as usize)?.shape {
            Shape::Image { texels, .. } => Some(texels),
            Shape::Buffer { .. } => None,
        }
    }

    /// The label of an image's signal.
    pub(crate) fn label(&self, image: Image) -> &str {
        let own = Some(image).filter(|image| image.graph == self.key);
        own.and_then(|image| self.states.get(image.id.0 as usize)).map_or("", |state| &state.label)
    }

    /// A name with the label of a signal and the open scopes behind it.
    pub(crate) fn scoped(&self, base: &str, label: &str) -> String {
        let parts = std::iter::once(label).filter(|l| !l.is_empty()).chain(self.scopes.iter().map(String::as_str));
        parts.fold(base.to_owned(), |name, part| format!("{name}_{part}"))
    }

    /// Makes the samples to re-shade an output of this name.
    pub fn output_samples(&mut self, name: &str, samples: &GradientSamples) {
        self.output_image(name, samples.image);
    }

    pub(super) fn output_image(&mut self, name: &str, image: Image) {
        if image.graph != self.key {
            return self.fail("output", name, "the image belongs to another graph".to_owned());
        }
        let index = image.id.0 as usize;
        let taken = self.resources.iter().enumerate().any(|(i, r)| i != index && r.name == name);
        let resource = &mut self.resources[index];
        match resource.lifetime {
            _ if taken => self.fail("output", name, "a resource has this name already; give the output another".to_owned()),
            Lifetime::Transient | Lifetime::Output => {
                (resource.name, resource.lifetime) = (name.to_owned(), Lifetime::Output);
            }
            lifetime => {
                let given = resource.name.clone();
                self.fail(
                    "output",
                    name,
                    format!("`{given}` is {lifetime:?}; only what a node writes for this frame alone can be an output"),
                );
            }
        }
    }
}
