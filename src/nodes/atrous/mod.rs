//! The edge-avoiding à-trous wavelet transform, guided by variance. \[SVGF\] 4.3, eq. 1 to 5.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{by_signals, pass, UNREAD};
use crate::choice::choices;
use crate::graph::{Estimate, Graph, Guides, History, Image, Pass, Port, Reflection, Value, VolumeEstimate, HDR};
use crate::shaders::{self, Shader};

mod kernel;
pub use kernel::Kernel;

choices! {
    /// How far a tap of another luminance counts.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum LuminanceWeight {
        /// `exp(−x)` by the deviation of 3×3 pixels, \[SVGF\] eq. 5: for deviations of samples.
        #[default]
        Published = 0 => "published",
        /// `exp(−x²/2)` by deviations of means, which taps share. A part of the weight that a tap loses
        /// stays on the centre, so that rare light keeps its mean. For [`super::Estimator::OfMean`].
        OfMeans = 1 => "of_means",
    }
}

/// Parameters of the node `atrous`.
#[derive(Clone, Copy, Debug)]
pub struct Atrous {
    /// Levels, 1 to 10; taps of level i are 2^i pixels apart, those of a box as [`Kernel::Box`] says. Default: 5.
    pub levels: u32,
    /// Default: [`Kernel::Spline`].
    pub kernel: Kernel,
    /// The weight by luminance. Default: [`LuminanceWeight::Published`].
    pub luminance_weight: LuminanceWeight,
    /// The history that the first level writes: one with [`crate::graph::Feedback::Filtered`]. Default: none.
    pub feedback: Option<History>,
    /// Reflections of the surfaces, if the last signal is specular light. It is filtered no wider than
    /// their lobes. With [`LuminanceWeight::OfMeans`], give it a node `variance` of its own, whose estimate then says where light is
    /// rare: taps are compared more strictly. Default: none.
    pub reflection: Option<Reflection>,
    /// Tolerated difference of luminance. Default: [`crate::Tuning::sigma_l`].
    pub sigma_l: Value,
    /// Sharpness of the weight exp(−σ (1 − cos)) by the angle between normals. Default: [`crate::Tuning::sigma_n`].
    pub sigma_n: Value,
    /// Tolerated departure from the local plane. Default: [`crate::Tuning::sigma_z`].
    pub sigma_z: Value,
}

impl Default for Atrous {
    fn default() -> Self {
        let (sigma_l, sigma_n, sigma_z) = Default::default();
        Self {
            levels: 5,
            kernel: Kernel::default(),
            luminance_weight: LuminanceWeight::default(),
            feedback: None,
            reflection: None,
            sigma_l,
            sigma_n,
            sigma_z,
        }
    }
}

/// Parameters of the node `atrous` for a volume.
#[derive(Clone, Copy, Debug)]
pub struct VolumeAtrous {
    /// Levels, 1 to 10. Default: 5.
    pub levels: u32,
    /// The history that the first level writes. Default: none.
    pub feedback: Option<History>,
    /// Whether the result stays in the [exposure of the filter](Graph::filter_exposure), for the node `modulate`. Default: false.
    pub keeps_exposure: bool,
}

impl Default for VolumeAtrous {
    fn default() -> Self {
        Self { levels: 5, feedback: None, keeps_exposure: false }
    }
}

/// Parameters that the levels of one filter share.
pub(super) struct Levels<'a> {
    pub node: &'a str,
    pub count: u32,
    pub feedback: Option<History>,
}

impl Graph {
    /// Filters one or two signals level by level, one pass each; they share the geometry weights.
    pub fn atrous(&mut self, guides: &Guides, estimate: &Estimate, atrous: Atrous) -> Estimate {
        let node = self.node("atrous", &self.label_of(estimate));
        let module = match (atrous.reflection, guides.material_class) {
            (Some(_), None) => by_signals(estimate, &shaders::ATROUS_SIGNALS_1_SPECULAR_1, &shaders::ATROUS_SIGNALS_2_SPECULAR_1),
            (None, None) => by_signals(estimate, &shaders::ATROUS_SIGNALS_1, &shaders::ATROUS_SIGNALS_2),
            (Some(_), Some(_)) => by_signals(
                estimate,
                &shaders::ATROUS_SIGNALS_1_SPECULAR_1_MATERIAL_1,
                &shaders::ATROUS_SIGNALS_2_SPECULAR_1_MATERIAL_1,
            ),
            (None, Some(_)) => by_signals(estimate, &shaders::ATROUS_SIGNALS_1_MATERIAL_1, &shaders::ATROUS_SIGNALS_2_MATERIAL_1),
        };
        let levels = Levels { node: &node, count: atrous.levels, feedback: atrous.feedback };
        let of_means = atrous.luminance_weight == LuminanceWeight::OfMeans;
        let of_specular = of_means && atrous.reflection.is_some_and(|reflection| !reflection.mixed);
        let marked = of_specular && estimate.images().last().is_some_and(|image| self.writer_has(*image, "MARKED"));
        self.levels(levels, estimate, |name, level| {
            level_pass(&node, name, module, level)
                .constant("KERNEL", atrous.kernel as u32)
                .constant("OURS", of_means.into())
                .constant("MARKED", marked.into())
                .value("sigma_l", atrous.sigma_l)
                .value("sigma_n", atrous.sigma_n)
                .value("sigma_z", atrous.sigma_z)
                .value("volume_sigma_z", UNREAD)
                .bind("guide", guides.guide)
                .bind_some("material_class", guides.material_class)
                .bind_some("reflection", atrous.reflection.map(|reflection| reflection.image))
        })
    }

    /// Filters the radiance of a volume: weights by the depth of the surface behind and by luminance \[PSVGF\].
    pub fn volume_atrous(&mut self, guides: &Guides, estimate: &VolumeEstimate, atrous: VolumeAtrous) -> VolumeEstimate {
        let node = self.node("atrous", &self.label_of(estimate));
        let levels = Levels { node: &node, count: atrous.levels, feedback: atrous.feedback };
        self.levels(levels, estimate, |name, level| {
            level_pass(&node, name, &shaders::ATROUS_SIGNALS_1, level)
                .constant("KERNEL", Kernel::Box as u32)
                .constant("VOLUME", 1)
                .constant("LAST", u32::from(level + 1 == atrous.levels && !atrous.keeps_exposure))
                .value("sigma_l", Value::Tunable("volume_sigma_l"))
                .value("sigma_n", UNREAD)
                .value("sigma_z", UNREAD)
                .bind("guide", guides.guide)
        })
    }

    /// The passes of a wavelet filter. The first level may write a history; the others alternate between two images.
    pub(super) fn levels<K>(&mut self, levels: Levels, input: &Port<K>, pass: impl Fn(String, u32) -> Pass) -> Port<K> {
        let Levels { node, count, feedback } = levels;
        if !(1..=10).contains(&count) {
            self.fail(node, "levels", format!("{count} levels were given; allowed is 1 to 10"));
            return *input;
        }
        if feedback.is_some_and(|history| history.colour().len() != input.signals()) {
            self.fail(
                node,
                "feedback",
                format!("the history is not of the {} signals that are filtered; make it of the same port", input.signals()),
            );
            return *input;
        }
        let feedback = feedback.map(|history| history.colour().to_vec());
        let mut images = LevelImages { input: *input, scratch: [None, None] };
        let mut from = *input;
        for level in 0..count {
            let to: Port<K> = match &feedback {
                Some(history) if level == 0 => Port::of_images(history).unwrap_or(*input),
                _ => images.scratch(self, level),
            };
            // "atrous_volume_2": the level stands behind the whole name.
            let described = pass(format!("{node}_{level}"), level);
            self.add(described.each("input", from.images()).each("output", to.images()));
            from = self.renewed(&to);
        }
        from
    }

    /// Histories of luminance with the content that they have now.
    pub(super) fn current_luminance_history(&self, history: &History) -> Vec<Image> {
        history.luminance_history().iter().map(|image| self.refreshed(*image)).collect()
    }
}

fn level_pass(node: &str, name: String, module: &'static Shader, level: u32) -> Pass {
    pass(node, module).named(name).level(level)
}

/// The two images of every signal that the levels write in turn.
struct LevelImages<K> {
    input: Port<K>,
    scratch: [Option<Port<K>>; 2],
}

impl<K> LevelImages<K> {
    fn scratch(&mut self, graph: &mut Graph, level: u32) -> Port<K> {
        let index = (level % 2) as usize;
        *self.scratch[index].get_or_insert_with(|| graph.image_each(&self.input, ["atrous_even", "atrous_odd"][index], HDR, 1))
    }
}
