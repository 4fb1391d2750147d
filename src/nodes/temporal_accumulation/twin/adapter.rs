//! The stage on the bindings of a pass.

use super::*;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::luminance_history::{luminance_histories, split_luminance_history};
use crate::reference::rules::{pixels, rounded, rule, TESTED, TESTED_COUNTS};
use crate::Error;

/// A deviation near 0 is the root of a difference that rounding decides.
const ACCUMULATED_MOMENTS: Tolerance = Tolerance { absolute: 2e-3, ..TESTED };

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    rule("statistics", Unit::Buffer, Reading::Counts, TESTED_COUNTS),
    pixels("irradiance_0", TESTED),
    pixels("irradiance_1", TESTED),
    rounded("irradiance_0"),
    rounded("irradiance_1"),
    rule("new_luminance_0", Unit::Pixel, Reading::Halves, ACCUMULATED_MOMENTS),
    rule("new_luminance_1", Unit::Pixel, Reading::Halves, ACCUMULATED_MOMENTS),
];

/// Surfaces, or with the constant `VOLUME` a volume.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (irradiance, history) = (b.colours("irradiance")?, b.colours("history")?);
    let luminance_history = luminance_histories(b, "previous_luminance_history")?;
    let signals: Vec<_> = history
        .into_iter()
        .zip(&luminance_history)
        .map(|(irradiance, luminance_history)| SignalHistory { irradiance, luminance_history })
        .collect();
    let guide = b.packed("previous_guide")?;
    let outputs = match b.is_on("VOLUME")? {
        true => volume(b, guide, &irradiance, &signals)?,
        false => surfaces(b, &irradiance, PreviousFrame { guide, signals: &signals })?,
    };
    b.count(&outputs.statistics)?;
    let split = |(irradiance, luminance_history)| split_luminance_history(irradiance, luminance_history);
    let (irradiance, new_luminance): (Vec<_>, Vec<_>) =
        outputs.irradiance.iter().zip(&outputs.luminance_history).map(split).unzip();
    b.write_signals("irradiance", irradiance)?;
    b.write_signals("new_luminance", new_luminance)
}

fn surfaces(b: &Bindings, irradiance: &[&Image<[f32; 4]>], previous: PreviousFrame) -> Result<TemporalAccumulationOutputs, Error> {
    let normals = b.optional_uint("object_normal")?.zip(b.optional_uint("previous_object_normal")?);
    let ratio = b.optional_colour("light_ratio")?;
    let light_ratio = ratio.map(|image| b.stratum_size().map(|stratum_size| StrataRatio { image, stratum_size })).transpose()?;
    let inputs = TemporalAccumulationInputs {
        guide: b.packed("guide")?,
        surface_motion: b.packed("surface_motion")?,
        irradiance,
        object_normals: normals.map(|(current, previous)| ObjectNormals { current, previous }),
        material_class: b.optional_uint("material_class")?,
        history_confidence: b.optional_scalar("history_confidence")?,
        repair: b.is_on("REPAIR")?,
        sharp: b.is_on("SHARP")?,
        light_ratio,
        previous: Some(previous),
    };
    Ok(temporal_accumulation(b.frame, b.tuning, &inputs))
}

fn volume(
    b: &Bindings,
    previous_guide: &Image<[u16; 4]>,
    radiance: &[&Image<[f32; 4]>],
    signals: &[SignalHistory],
) -> Result<TemporalAccumulationOutputs, Error> {
    let mut outputs =
        TemporalAccumulationOutputs { irradiance: Vec::new(), luminance_history: Vec::new(), statistics: Statistics::default() };
    for (radiance, signal) in radiance.iter().zip(signals.chunks(1)) {
        let inputs = VolumeAccumulationInputs {
            guide: b.packed("guide")?,
            volume_motion: b.uint("volume_motion")?,
            radiance,
            previous: Some(PreviousFrame { guide: previous_guide, signals: signal }),
        };
        let (radiance, luminance_history) = volume_accumulation(b.frame, b.tuning, &inputs);
        outputs.irradiance.push(radiance);
        outputs.luminance_history.push(luminance_history);
    }
    Ok(outputs)
}
