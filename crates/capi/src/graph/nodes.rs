//! The nodes of a graph as C calls them: by name, with arguments by name. One table has them all; a test compares it with the
//! methods of [`Graph`].

use super::arguments::Arguments;
use super::values::Value;
use crate::status::Failure;
use atrous::config::GradientSource;
use atrous::graph::*;
use atrous::nodes::*;

/// A node, with the names of its arguments. Those behind the first `needed` have defaults.
pub struct NodeInfo {
    /// The method of [`Graph`].
    pub name: &'static str,
    /// Arguments without a default.
    pub needed: &'static [&'static str],
    /// Arguments with a default.
    pub optional: &'static [&'static str],
}

/// An argument of a method of `Graph`.
macro_rules! argument {
    ($arguments:ident port $name:ident) => {
        &$arguments.port(stringify!($name))?
    };
    ($arguments:ident maybe $name:ident) => {
        $arguments.optional(stringify!($name), None)?.as_ref()
    };
    ($arguments:ident choice $name:ident) => {
        $arguments.choice(stringify!($name), Default::default())?
    };
    ($arguments:ident count $name:ident) => {
        $arguments.count(stringify!($name))?
    };
}

/// Makes the table, and the call of each method. A row: the method, arguments with their kinds, and the struct of its parameters
/// with their kinds. Irregular ones have a function of their own below.
macro_rules! nodes {
    (
        regular { $(
            $method:ident($($kind:ident $argument:ident),*) $([$($kind2:ident $argument2:ident),+])?
                $($parameters:ident { $($kind3:ident $field:ident),+ })?;
        )+ }
        irregular { $($name:ident($($needed:ident),*) [$($optional:ident),*];)+ }
    ) => {
        /// All nodes.
        pub const NODES: &[NodeInfo] = &[
            $(NodeInfo {
                name: stringify!($name),
                needed: &[$(stringify!($needed)),*],
                optional: &[$(stringify!($optional)),*],
            },)+
            $(NodeInfo {
                name: stringify!($method),
                needed: &[$(stringify!($argument)),*],
                optional: &[$($(stringify!($argument2),)+)? $($(stringify!($field)),+)?],
            },)+
        ];

        /// Adds a node.
        pub(super) fn add(graph: &mut Graph, node: &str, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
            match node {
                $(stringify!($method) => Ok(graph.$method(
                    $(argument!(arguments $kind $argument),)*
                    $($(argument!(arguments $kind2 $argument2),)+)?
                    $({
                        let default = $parameters::default();
                        $parameters { $($field: arguments.$kind3(stringify!($field), default.$field)?),+ }
                    })?
                ).into()),)+
                $(stringify!($name) => $name(graph, arguments),)+
                _ => {
                    let all: Vec<_> = NODES.iter().map(|node| node.name).collect();
                    Err(Failure::argument(format!("node {node} does not exist; there are: {}", all.join(", "))))
                }
            }
        }
    };
}

nodes! {
    regular {
        import() Import { flag surface_id, flag object_normal, flag albedo, flag material_class };
        forward_project(port guides) ForwardProject { number stratum_size, flag forward_motion, flag surface_id };
        demodulate(port guides, port noisy) Demodulate { choice albedo, choice sampling, optional gradient, optional samples };
        fill_holes(port guides, port irradiance) [choice sampling];
        block_percentiles(port guides, port irradiance);
        volume_percentiles(port guides, port radiance);
        firefly_limits(port guides, port irradiance, port percentiles);
        firefly(port guides, port irradiance, port limits);
        volume_firefly(port guides, port radiance, port limits);
        block_difference(port guides, port irradiance, port history);
        change_test(port difference);
        change_and_steadiness(port difference);
        gradient_atrous(port guides, port gradient);
        history_confidence(port gradient) [maybe tested];
        host_confidence();
        percentile_rule(port guides, port percentiles, port history);
        temporal_accumulation(port guides, port irradiance, port history) Accumulation {
            optional confidence, flag repair, flag sharp, optional light_ratio, value alpha, value alpha_moments,
            value max_history_length, value depth_tolerance, value normal_tolerance
        };
        specular_history(port irradiance) [choice feedback];
        specular_accumulation(port guides, port irradiance, port history) SpecularAccumulation {
            optional confidence, value alpha, value alpha_moments, flag sharp, flag mixed, optional light_ratio
        };
        variance(port guides, port accumulated, port history) Variance { choice estimator, value spatial_variance_frames };
        atrous(port guides, port estimate) Atrous {
            number levels, choice kernel, choice luminance_weight, optional feedback, optional reflection,
            value sigma_l, value sigma_n, value sigma_z
        };
        eaw(port guides, port irradiance) Eaw { number levels, weights weights, choice sampling, optional feedback };
        modulate(port guides, port filtered) Modulate {
            flag albedo, flag mixed, flag specular, flag emission, flag float_output, optional detail
        };
        tone_map(port denoised);
        temporal_upscale(port guides, port radiance) TemporalUpscale { flag tone_mapped };
        volume();
        volume_motion(port guides, port volume);
        volume_points(port volume);
        volume_accumulation(port guides, port radiance, port history, port motion);
        volume_variance(port guides, port accumulated, port history);
        volume_atrous(port guides, port estimate) VolumeAtrous { number levels, optional feedback, flag keeps_exposure };
        visibility_samples(port guides) Lights { number count, flag coloured, flag ambient };
        visibility_accumulation(port guides, port samples);
        visibility_filter(port guides, port accumulated, count levels);
        shadowed_light(port radiance, port visibility);
    }
    irregular {
        radiance(name) [];
        transient(name, format) [divisor];
        pair(first, second) [];
        history(of) [feedback];
        filter_exposure(noisy) [specular, volume];
        gradient(guides, noisy) [source, samples, stratum_size];
        gradient_and_ratio(guides, noisy) [source, samples, stratum_size];
        firefly_limits_of_frame(port, percentiles) [];
        upsample(guides, filtered) [];
        debug_view(guides, noisy) [albedo, history, deviation, confidence, gradient, reflection, visibility, percentiles, limits];
    }
}

fn radiance(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    Ok(graph.radiance(&arguments.text("name")?).into())
}

fn transient(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (name, format) = (arguments.text("name")?, arguments.count("format")?);
    let format = ash::vk::Format::from_raw(format as i32);
    Ok(graph.transient(&name, format, arguments.number("divisor", 1)?).into())
}

fn pair(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (first, second) = (arguments.any("first")?, arguments.any("second")?);
    Value::pair(graph, &first, &second).ok_or_else(|| {
        let kinds = [first.name(), second.name()];
        Failure::argument(format!("pair: first is {}, and second is {}; give two ports of one kind", kinds[0], kinds[1]))
    })
}

fn history(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (of, feedback) = (arguments.any("of")?, arguments.choice("feedback", Feedback::default())?);
    of.history(graph, feedback).map(Value::History).ok_or_else(|| not_a_port("history", "of", &of))
}

fn not_a_port(node: &str, name: &str, given: &Value) -> Failure {
    Failure::argument(format!("{node}: {name} is {}; give a port of one or two signals", given.name()))
}

fn filter_exposure(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let noisy: Radiance = arguments.port("noisy")?;
    let more = [arguments.optional("specular", None)?, arguments.optional("volume", None)?];
    let all: Vec<_> = std::iter::once(noisy).chain(more.into_iter().flatten()).collect();
    graph.filter_exposure(&all);
    Ok(Value::Nothing)
}

/// The source of gradients: the samples, or your image with the side of its strata.
fn gradients(arguments: &mut Arguments<'_>) -> Result<Gradients, Failure> {
    let samples: Option<GradientSamples> = arguments.optional("samples", None)?;
    let source = arguments.choice("source", GradientSource::ForwardProjected)?;
    let stratum_size = arguments.number("stratum_size", 3)?;
    match (source, samples) {
        (GradientSource::ForwardProjected, Some(samples)) => Ok(Gradients::ForwardProjected(samples)),
        (GradientSource::Reshaded, None) => Ok(Gradients::Reshaded { stratum_size }),
        (GradientSource::Sparse, None) => Ok(Gradients::Sparse { stratum_size }),
        (source, samples) => {
            let given = samples.map_or("no samples", |_| "samples");
            Err(Failure::argument(format!(
                "gradient: source is {source} with {given}; give the samples of forward_project, or one of the sources reshaded and sparse"
            )))
        }
    }
}

fn gradient(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (guides, noisy) = (arguments.port("guides")?, arguments.port("noisy")?);
    Ok(graph.gradient(&guides, &noisy, gradients(arguments)?).into())
}

fn gradient_and_ratio(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (guides, noisy) = (arguments.port("guides")?, arguments.port("noisy")?);
    Ok(graph.gradient_and_ratio(&guides, &noisy, gradients(arguments)?).into())
}

fn firefly_limits_of_frame(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (port, percentiles) = (arguments.any("port")?, arguments.port("percentiles")?);
    let limits = port.firefly_limits(graph, &percentiles);
    limits.map(Value::FireflyLimits).ok_or_else(|| not_a_port("firefly_limits_of_frame", "port", &port))
}

fn upsample(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (guides, filtered) = (arguments.port("guides")?, arguments.any("filtered")?);
    filtered.upsample(graph, &guides).ok_or_else(|| not_a_port("upsample", "filtered", &filtered))
}

fn debug_view(graph: &mut Graph, arguments: &mut Arguments<'_>) -> Result<Value, Failure> {
    let (guides, noisy) = (arguments.port("guides")?, arguments.port("noisy")?);
    let Intermediates { albedo, deviation, .. } = Intermediates::new(&noisy);
    let usual = match (arguments.optional("percentiles", None)?, arguments.optional("limits", None)?) {
        (Some(percentiles), Some(limits)) => Some(Usual { percentiles, limits }),
        (None, None) => None,
        _ => return Err(Failure::argument("debug_view: one of percentiles and limits is missing; give both or none")),
    };
    let intermediates = Intermediates {
        noisy,
        albedo: arguments.flag("albedo", albedo)?,
        history: arguments.optional("history", None)?,
        deviation: arguments.flag("deviation", deviation)?,
        confidence: arguments.optional("confidence", None)?,
        gradient: arguments.optional("gradient", None)?,
        reflection: arguments.optional("reflection", None)?,
        visibility: arguments.optional("visibility", None)?,
        usual,
    };
    Ok(graph.debug_view(&guides, &intermediates).into())
}
