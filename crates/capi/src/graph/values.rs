//! Values of a graph: what a node returned, and what a later one takes.

use atrous::graph::*;
use atrous::nodes::{AccumulatedSpecular, ChangeTest, SpecularHistory, Volume};

/// A type that a node of Rust takes.
pub(super) trait Kind: Sized {
    const NAME: &'static str;
    fn of(value: &Value) -> Option<Self>;
}

/// Makes [`Value`]: ports, of which an image of a stage becomes any, and other values. Behind `from` stand the kinds of values
/// that Rust converts.
macro_rules! values {
    (
        ports { $($port:ident $(from $($source:ident),+)?;)+ }
        others { $($other:ident $(from $source2:ident $how:expr)?;)+ }
    ) => {
        /// A value of a graph.
        #[derive(Clone, Debug)]
        pub(crate) enum Value {
            /// What a node returns that only writes.
            Nothing,
            $($port($port),)+
            $($other($other),)+
        }

        impl Value {
            /// The word for it in errors.
            pub(super) fn name(&self) -> &'static str {
                match self {
                    Self::Nothing => "nothing",
                    $(Self::$port(_) => stringify!($port),)+
                    $(Self::$other(_) => stringify!($other),)+
                }
            }

            /// The images of a port, and the same port for the image of one signal.
            pub(super) fn signals(&self) -> Vec<Self> {
                match self {
                    $(Self::$port(port) => port.images().iter().map(|image| Self::$port($port::of(*image))).collect(),)+
                    _ => Vec::new(),
                }
            }

            /// The image, where the value is one.
            pub(super) fn image(&self) -> Option<Image> {
                match self {
                    $(Self::$port(port) if port.signals() == 1 => Some(port.image()),)+
                    Self::Image(image) => Some(*image),
                    _ => None,
                }
            }

            /// Two values of one kind in one.
            pub(super) fn pair(graph: &mut Graph, first: &Self, second: &Self) -> Option<Self> {
                match (first, second) {
                    $((Self::$port(first), Self::$port(second)) => Some(Self::$port(graph.pair(first, second))),)+
                    _ => None,
                }
            }

            /// The history that an accumulation of these signals leaves.
            pub(super) fn history(&self, graph: &mut Graph, feedback: Feedback) -> Option<History> {
                match self {
                    $(Self::$port(port) => Some(graph.history(port, feedback)),)+
                    _ => None,
                }
            }

            /// Limits by the percentiles of this frame.
            pub(super) fn firefly_limits(&self, graph: &mut Graph, percentiles: &Percentiles) -> Option<FireflyLimits> {
                match self {
                    $(Self::$port(port) => Some(graph.firefly_limits_of_frame(port, percentiles)),)+
                    _ => None,
                }
            }

            /// The same signals for each rendered pixel.
            pub(super) fn upsample(&self, graph: &mut Graph, guides: &Guides) -> Option<Self> {
                match self {
                    $(Self::$port(port) => Some(Self::$port(graph.upsample(guides, port))),)+
                    _ => None,
                }
            }

            /// Makes an output of it; `false` where the value is none that has one image.
            pub(super) fn output(&self, graph: &mut Graph, name: &str) -> bool {
                match self {
                    $(Self::$port(port) => graph.output(name, port),)+
                    Self::Image(image) => graph.output(name, &Radiance::of(*image)),
                    Self::GradientSamples(samples) => graph.output_samples(name, samples),
                    _ => return false,
                }
                true
            }
        }

        $(
            impl Kind for $port {
                const NAME: &'static str = stringify!($port);
                fn of(value: &Value) -> Option<Self> {
                    match value {
                        Value::$port(port) => Some(*port),
                        Value::Image(image) => Some(Self::of(*image)),
                        $($(Value::$source(port) => Some((*port).into()),)+)?
                        _ => None,
                    }
                }
            }

            impl From<$port> for Value {
                fn from(port: $port) -> Self {
                    Self::$port(port)
                }
            }
        )+

        $(
            impl Kind for $other {
                const NAME: &'static str = stringify!($other);
                fn of(value: &Value) -> Option<Self> {
                    match value {
                        Value::$other(value) => Some(value.clone()),
                        $(Value::$source2(value) => Some($how(value)),)?
                        _ => None,
                    }
                }
            }

            impl From<$other> for Value {
                fn from(value: $other) -> Self {
                    Self::$other(value)
                }
            }
        )+
    };
}

values! {
    ports {
        Radiance from VolumeEstimate;
        Irradiance from Accumulated, Estimate;
        Accumulated;
        Estimate;
        VolumeRadiance;
        VolumeAccumulated;
        VolumeEstimate;
        VolumeMotion;
        Confidence;
        Steadiness;
        Percentiles;
        FireflyLimits;
        Difference;
        Display;
        VisibilitySamples;
        VisibilityAccumulated;
        Visibility;
    }
    others {
        Image;
        Guides;
        History from SpecularHistory |specular: &SpecularHistory| specular.history;
        Reflection;
        Gradient;
        LightRatio;
        GradientSamples;
        ChangeTest from Confidence |confidence: &Confidence| ChangeTest::from(*confidence);
        SpecularHistory;
        AccumulatedSpecular;
        Volume;
        StageOutputs;
    }
}

impl From<()> for Value {
    fn from((): ()) -> Self {
        Self::Nothing
    }
}

impl Value {
    /// The parts of a value, by name. Those of a stage are the bindings that it writes.
    pub(super) fn part(&self, name: &str) -> Option<Self> {
        let found = self.parts().into_iter().find(|(part, _)| *part == name).map(|(_, value)| value);
        match self {
            Self::StageOutputs(outputs) => outputs.image(name).map(Self::Image),
            _ => found,
        }
    }

    /// The names of its parts, for errors.
    pub(super) fn names_of_parts(&self) -> String {
        match self {
            Self::StageOutputs(_) => "the bindings that the stage writes".to_owned(),
            _ => match self.parts().iter().map(|(name, _)| *name).collect::<Vec<_>>() {
                none if none.is_empty() => "no part".to_owned(),
                names => names.join(", "),
            },
        }
    }

    fn parts(&self) -> Vec<(&'static str, Self)> {
        let named = |names: [&'static str; 2], images: &[Image]| -> Vec<_> {
            names.into_iter().zip(images.iter().map(|image| Self::Image(*image))).collect()
        };
        match self {
            Self::Guides(guides) => {
                let all = [("guide", guides.guide), ("surface_motion", guides.surface_motion)];
                let normal = guides.object_normal.map(|normal| ("object_normal", normal));
                all.into_iter().chain(normal).map(|(name, image)| (name, image.into())).collect()
            }
            Self::History(history) => [
                named(["colour", "second_colour"], history.colour()),
                named(["luminance_history", "second_luminance_history"], history.luminance_history()),
            ]
            .concat(),
            Self::SpecularHistory(specular) => vec![("history", specular.history.into())],
            Self::Reflection(reflection) => vec![("image", reflection.image.into())],
            Self::Gradient(gradient) => {
                let ratio = gradient.light_ratio().map(|ratio| ("light_ratio", ratio.into()));
                std::iter::once(("image", gradient.image().into())).chain(ratio).collect()
            }
            Self::LightRatio(ratio) => vec![("image", ratio.image.into())],
            Self::GradientSamples(samples) => vec![("image", samples.image().into())],
            Self::ChangeTest(test) => {
                let steadiness = test.steadiness.map(|steadiness| ("steadiness", steadiness.into()));
                std::iter::once(("confidence", test.confidence.into())).chain(steadiness).collect()
            }
            Self::AccumulatedSpecular(both) => {
                vec![("accumulated", both.accumulated.into()), ("reflection", both.reflection.into())]
            }
            Self::Volume(volume) => vec![("noisy", volume.noisy().into())],
            _ => ["first", "second"].into_iter().zip(self.signals()).collect(),
        }
    }
}
