//! The stages as nodes of a [`Graph`]: which shader, which images, how each is touched.
//!
//! A node is a method of [`Graph`] in the file of its stage, with its parameters in a struct that has defaults. It adds passes and
//! allocates nothing.

mod adaptive_alpha;
mod atrous;
mod block_difference;
mod block_percentiles;
mod change_test;
mod debug_view;
mod demodulate;
mod eaw;
mod firefly;
mod forward_project;
mod gradient;
mod gradient_atrous;
mod import;
mod modulate;
mod percentile_rule;
mod taa;
mod temporal_accumulation;
mod tone_map;
mod variance;
mod volume_motion;
mod volume_points;

pub use atrous::{Atrous, Kernel, VolumeAtrous};
pub use block_percentiles::BLOCK_SIZE;
pub use debug_view::Known;
pub use demodulate::Demodulate;
pub use eaw::Eaw;
pub use forward_project::ForwardProject;
pub use gradient::Gradients;
pub use import::Import;
pub use modulate::Modulate;
pub use temporal_accumulation::Accumulation;
pub use variance::{Estimator, Variance};
pub use volume_points::Volume;

use crate::graph::{Graph, Image, Port};
use crate::shaders::Shader;

/// The module of a shader for one or two signals.
fn by_signals<K>(port: &Port<K>, one: &'static Shader, two: &'static Shader) -> &'static Shader {
    if port.signals() == 1 {
        one
    } else {
        two
    }
}

impl Graph {
    /// The label behind the name of a node: that of its only signal. Two signals that are filtered together have none.
    fn label_of<K>(&self, port: &Port<K>) -> String {
        match port.images() {
            [only] => self.label(*only).to_owned(),
            _ => String::new(),
        }
    }

    /// The images of a port with the content that they have now, after passes that wrote them.
    fn renewed<K>(&self, port: &Port<K>) -> Port<K> {
        let images: Vec<Image> = port.images().iter().map(|image| self.refreshed(*image)).collect();
        Port::of_images(&images).unwrap_or(*port)
    }

    /// An image for every signal of a port.
    fn image_each<K, L>(&mut self, of: &Port<K>, base: &str, format: crate::ImageFormat, divisor: u32) -> Port<L> {
        let images: Vec<Image> = of
            .images()
            .iter()
            .map(|image| {
                let label = self.label(*image).to_owned();
                self.named_image(base, &label, format, divisor, crate::Lifetime::Transient)
            })
            .collect();
        Port::of_images(&images).unwrap_or_else(|| of.cast())
    }
}
