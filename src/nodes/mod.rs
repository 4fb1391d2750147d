//! The stages as nodes of a [`Graph`]: the shader of each, its images, and their uses.
//!
//! A node is a method of [`Graph`] in the file of its stage, with its parameters in a struct that has defaults. It adds passes and
//! allocates nothing. Beside it, in `twin.rs`, stands the stage on the CPU. `stages!` lists them all.

#[cfg(test)]
mod adaptive_history_tests;

use crate::contract::{Input, TexelGrid};
use crate::graph::{Graph, Guides, Image, Pass, Port, Rendered, Value};
use crate::reference::CpuStage;
use crate::shaders::Shader;

/// Makes the module of each stage, publishes the parameters of its node, and lists its twin.
macro_rules! stages {
    ($($name:ident),+ $(,)?) => {
        $(
            // Public in the documentation alone: the page of a module is the specification of its stage.
            #[cfg(doc)]
            pub mod $name;
            #[cfg(not(doc))]
            pub(crate) mod $name;
            #[doc(inline)]
            #[allow(unused_imports, unreachable_pub)] // Some stages have no parameters.
            pub use $name::*;
        )+

        /// The names of all stages: a shader, a node and a twin each.
        pub const STAGES: &[&str] = &[$(stringify!($name)),+];

        fn on_cpu(stage: &str) -> Option<CpuStage> {
            match stage {
                $(stringify!($name) => Some(CpuStage { twin: $name::twin::twin, rules: $name::twin::RULES }),)+
                _ => None,
            }
        }
    };
}

stages! {
    atrous,
    block_difference,
    block_percentiles,
    change_test,
    clear_claims,
    debug_view,
    demodulate,
    eaw,
    fill_holes,
    filter_exposure,
    firefly,
    firefly_limits,
    forward_project,
    gradient,
    gradient_atrous,
    history_confidence,
    import,
    modulate,
    percentile_rule,
    reactive_mask,
    sample_albedo,
    shadowed_light,
    specular_accumulation,
    temporal_accumulation,
    temporal_upscale,
    tone_map,
    upsample,
    variance,
    visibility_accumulation,
    visibility_filter,
    visibility_samples,
    volume_motion,
    volume_points,
}

/// A pass of a stage of ours, with its twin.
fn pass(node: &str, shader: &'static Shader) -> Pass {
    Pass { cpu: on_cpu(&shader.stage), ..Pass::new(node, shader) }
}

/// Of a push constant that the variant of a shader does not read: so the tunable of its name is none of the graph.
const UNREAD: Value = Value::Fixed(0.0);

/// The module of a shader for one or two signals.
fn by_signals<K>(port: &Port<K>, one: &'static Shader, two: &'static Shader) -> &'static Shader {
    if port.signals() == 1 {
        one
    } else {
        two
    }
}

/// The host's images that have the guide of rendered pixels, where light has fewer; else none.
struct RenderedInputs {
    depth: Option<Image>,
    normal: Option<Image>,
    surface_id: Option<Image>,
    /// That by which light is divided.
    albedo: Option<Image>,
}

impl Graph {
    fn rendered_inputs(&mut self, guides: &Guides) -> RenderedInputs {
        let Rendered::Host { surface_id, albedo } = guides.rendered else {
            return RenderedInputs { depth: None, normal: None, surface_id: None, albedo: None };
        };
        RenderedInputs {
            depth: Some(self.input(Input::DEPTH)),
            normal: Some(self.input(Input::NORMAL)),
            surface_id: surface_id.then(|| self.input(Input::SURFACE_ID)),
            albedo: if albedo { self.dividing_albedo() } else { None },
        }
    }

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
    fn image_each<K, L>(&mut self, of: &Port<K>, base: &str, format: crate::ImageFormat, texels: impl Into<TexelGrid>) -> Port<L> {
        let texels = texels.into();
        let images: Vec<Image> = of
            .images()
            .iter()
            .map(|image| {
                let label = self.label(*image).to_owned();
                self.named_image(base, &label, format, texels, crate::Lifetime::Transient)
            })
            .collect();
        Port::of_images(&images).unwrap_or_else(|| of.cast())
    }
}
