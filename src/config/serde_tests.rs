//! Files of settings: what is written is read again, what is left out has its default, what is wrong is named.

use super::*;
use crate::{DebugView, FrameParams, ResetReason, ToneCurve, Tuning};
use serde::{de::DeserializeOwned, Serialize};

fn round<T: Serialize + DeserializeOwned>(value: &T) -> (T, String) {
    let text = serde_json::to_string(value).expect("JSON");
    (serde_json::from_str(&text).expect(&text), text)
}

/// No field at its default.
fn config() -> Config {
    Config {
        allocated_extent: [64, 36],
        frames_in_flight: 3,
        preset: Preset::Eaw,
        signals: Signals::Apart,
        levels: Some(4),
        volume: true,
        visibility: 2,
        coloured_visibility: true,
        ambient_occlusion: true,
        firefly_filter: true,
        adaptive_rule: AdaptiveRule::Percentiles,
        stratum_size: 4,
        gradient_source: GradientSource::Sparse,
        forward_motion: true,
        eaw_weights: EawWeights { radiance: true, normal: false, position: true },
        sampling: Sampling::OneOf4x4,
        surface_id: false,
        object_normal: true,
        post_process: PostProcess::ToneMapTaa,
        float_output: true,
        debug_view: true,
        output_extent: Some([96, 72]),
        light_extent: Some([32, 18]),
        image_extent: Some([128, 72]),
        reactive_mask: true,
        material_class: true,
        conventions: Conventions {
            depth: DepthEncoding::Device,
            background_depth: 0.1,
            normal: NormalEncoding::Octahedral,
            normal_space: NormalSpace::View,
            motion_unit: MotionUnit::Ndc,
            motion_direction: MotionDirection::CurrentMinusPrevious,
            motion_y_up: true,
            motion_jittered: true,
            motion_depth: MotionDepth::Difference,
            view_forward: ViewForward::PositiveZ,
            roughness: RoughnessEncoding::Alpha,
            motion_scale: 0.02,
            roughness_channel: Channel::A,
            demodulated: true,
        },
    }
}

#[test]
fn everything_survives_a_file() {
    let (read, text) = round(&config());
    assert_eq!(read, config(), "{text}");
    for part in ["\"preset\":\"eaw\"", "\"sampling\":\"one_of_4x4\"", "[\"radiance\",\"position\"]", "\"motion_y\":\"up\""] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let (read, text) = round(&Config::new([8, 8]));
    assert_eq!(read, Config::new([8, 8]), "{text}");
    assert!(text.contains("\"background_depth\":\"inf\""), "{text}");
    let tuning = Tuning { sigma_l: 1.1, tone_curve: ToneCurve::Reinhard, ..Tuning::for_preset(Preset::Asvgf) };
    assert_eq!(round(&tuning).0, tuning);
    let params = FrameParams {
        frame_slot: 1,
        reset: Some(ResetReason::OriginShift),
        jitter: [0.1, -0.7],
        exposure_ratio: 1.1,
        reshaded: true,
        debug_view: Some(DebugView::BadValues),
        view_from_world: [[1e-30, 0.3, f32::MAX, 7.0]; 4],
        ..FrameParams::new([3, 2])
    };
    assert_eq!(round(&params).0, params);
}

#[test]
fn what_is_left_out_has_its_default() {
    let read: Config = serde_json::from_str("{ \"allocated_extent\": [8, 8] }").expect("a configuration");
    assert_eq!(read, Config::new([8, 8]));
    let read: Config = serde_json::from_str("{}").expect("a configuration");
    assert!(read.validate().expect_err("no extent").to_string().contains("allocated_extent"));
    assert_eq!(serde_json::from_str::<Tuning>("{ \"alpha\": 0.5 }").expect("tunables"), Tuning { alpha: 0.5, ..Tuning::default() });
    let all = serde_json::to_value(FrameParams::new([3, 2])).expect("JSON");
    let needed = |key: &String| ["render_extent", "view_from_world", "clip_from_view"].contains(&key.as_str());
    let needed: serde_json::Map<_, _> = all.as_object().cloned().into_iter().flatten().filter(|(key, _)| needed(key)).collect();
    let read: FrameParams = serde_json::from_value(needed.into()).expect("parameters");
    assert_eq!(read, FrameParams::new([3, 2]));
}

#[test]
fn what_is_wrong_is_named() {
    let refused = |conventions: &str| serde_json::from_str::<Conventions>(conventions).expect_err("refused").to_string();
    for (text, words) in [
        ("{ \"dept\": \"linear\" }", ["dept", "motion_unit"]),
        ("{ \"depth\": \"reversed\" }", ["`reversed`", "ray_length"]),
        ("{ \"background_depth\": -1 }", ["-1", "above 0"]),
        ("{ \"background_depth\": \"NaN\" }", ["NaN", "above 0"]),
        ("{ \"motion_y\": \"left\" }", ["left", "up, down"]),
    ] {
        let message = refused(text);
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
    let read: Conventions = serde_json::from_str("{ \"motion_y_up\": true, \"background_depth\": 1e4 }").expect("conventions");
    assert_eq!(read, Conventions { motion_y_up: true, background_depth: 1e4, ..Conventions::default() });
    let message = serde_json::from_str::<Config>("{ \"eaw_weights\": [\"colour\"] }").expect_err("refused").to_string();
    assert!(message.contains("`colour`") && message.contains("position"), "{message}");
    let message = serde_json::from_str::<Tuning>("{ \"alfa\": 1 }").expect_err("refused").to_string();
    assert!(message.contains("alfa") && message.contains("sigma_l"), "{message}");
}
