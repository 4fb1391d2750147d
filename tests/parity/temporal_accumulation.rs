//! `temporal_accumulation`.

use super::compare::{halves, texels, Tolerance, HALF};
use super::{each, Captured};
use atrous::config::Preset;
use atrous::reference::{
    temporal_accumulation, unpack_moments, ObjectNormals, PreviousFrame, SignalHistory, TemporalAccumulationInputs,
};
use atrous::UseFrame;

/// A tap's test may fall the other way where a value lies on its threshold.
const TESTED: Tolerance = Tolerance { outliers: 2e-3, ..HALF };

pub fn check(c: &Captured) {
    let (guide, previous_guide) = (c.packed("guide", UseFrame::Current), c.packed("guide", UseFrame::Previous));
    let surface_motion = c.packed("surface_motion", UseFrame::Current);
    let depth_gradient = c.uints("depth_gradient", UseFrame::Current);
    let irradiance = c.signals(c.accumulated(), UseFrame::Current);
    let history = c.signals("irradiance_history", UseFrame::Previous);
    let moments = c.packed_signals("moments", UseFrame::Previous);
    let signals: Vec<_> = history.iter().zip(&moments).map(|(irradiance, moments)| SignalHistory { irradiance, moments }).collect();
    let packed = |frame| c.config.object_normal.then(|| c.uints("object_normal_guide", frame));
    let (object_normal, previous_object_normal) = (packed(UseFrame::Current), packed(UseFrame::Previous));
    let object_normals =
        object_normal.as_ref().zip(previous_object_normal.as_ref()).map(|(current, previous)| ObjectNormals { current, previous });
    let history_confidence = c.has("history_confidence").then(|| c.floats("history_confidence"));
    let inputs = TemporalAccumulationInputs {
        guide: &guide,
        surface_motion: &surface_motion,
        depth_gradient: &depth_gradient,
        irradiance: &each(&irradiance),
        object_normals,
        history_confidence: history_confidence.as_ref(),
        repair: c.config.preset == Preset::Percentile,
        previous: Some(PreviousFrame { guide: &previous_guide, signals: &signals }),
    };
    let twin = temporal_accumulation(&c.frame.constants, c.tuning, &inputs);
    for (i, suffix) in c.suffixes().iter().enumerate() {
        let name = format!("{}{suffix}", c.accumulated());
        halves(&name, c, &c.written_halves(&name), &twin.irradiance[i], TESTED);
        let name = format!("moments{suffix}");
        // A deviation near 0 is the root of a difference that rounding decides.
        let tolerance = Tolerance { absolute: 2e-3, ..TESTED };
        texels(&name, c, &c.written_packed(&name), &twin.moments[i], tolerance, |t| {
            let m = unpack_moments(t);
            [m.mean, m.deviation, m.history_length, f32::from(m.reason)]
        });
    }
}
