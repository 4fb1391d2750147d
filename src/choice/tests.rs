//! Every choice: its names and numbers are stable, and lead back to it.

use super::*;
use crate::config::*;
use crate::{DebugView, ResetReason, ToneCurve};

/// Numbers and names that hosts in C, files and command lines have: a change here breaks them. The numbers follow one another from
/// the first one on.
const STABLE: [(&str, u32, &str); 18] = [
    ("AdaptiveRule", 0, "change_test percentiles"),
    ("DepthEncoding", 0, "linear device ray_length"),
    ("GradientSource", 0, "forward_projected reshaded sparse confidence change_test"),
    ("Kernel", 0, "spline box"),
    ("MotionDepth", 0, "none difference absolute"),
    ("MotionDirection", 0, "previous_minus_current current_minus_previous"),
    ("MotionUnit", 0, "pixels uv ndc"),
    ("NormalEncoding", 0, "xyz xyz_unorm octahedral octahedral_unorm"),
    ("NormalSpace", 0, "world view"),
    ("PostProcess", 0, "none tone_map tone_map_taa"),
    ("Preset", 0, "svgf asvgf stabilize percentile eaw volume fast best"),
    ("RoughnessEncoding", 0, "linear alpha"),
    ("Sampling", 0, "full one_of_2x2 one_of_4x4"),
    ("Signals", 0, "together apart specular mixed"),
    ("ViewForward", 0, "negative_z positive_z"),
    (
        "DebugView",
        0,
        "history_length deviation mean_and_deviation gradient lambda alpha percentiles fireflies disocclusion motion normal depth surface_id bad_values hit_distance lobe_angle virtual_motion reflection_history visibility penumbra",
    ),
    ("ResetReason", 1, "created camera_cut resize scene_load origin_shift exposure_jump"),
    ("ToneCurve", 0, "aces reinhard linear"),
];

fn check<T: Choice>() -> &'static str {
    let (_, first, names) = STABLE.iter().find(|row| row.0 == T::KIND).expect(T::KIND);
    let names: Vec<&str> = names.split(' ').collect();
    assert_eq!(T::ALL.iter().map(|value| value.name()).collect::<Vec<_>>(), names, "{}", T::KIND);
    for ((value, name), number) in T::ALL.iter().zip(&names).zip(*first..) {
        assert_eq!((value.number(), value.to_string().as_str()), (number, *name), "{}", T::KIND);
        assert_eq!(name.parse(), Ok(*value));
        assert_eq!(T::try_from(number), Ok(*value));
    }
    for wrong in ["", "svfg", &names[0].to_uppercase(), &format!(" {}", names[0])] {
        let message = wrong.parse::<T>().expect_err("unknown").to_string();
        assert!(message.contains(&format!("`{wrong}`")) && message.contains(T::KIND), "{message}");
        assert!(names.iter().all(|name| message.contains(name)), "{message}");
    }
    let message = T::try_from(77).expect_err("unknown").to_string();
    let last = format!("{} ({})", *first as usize + names.len() - 1, names[names.len() - 1]);
    assert!(message.contains("`77`") && message.contains(T::KIND) && message.contains(&last), "{message}");
    T::KIND
}

#[test]
fn names_and_numbers_are_stable_and_lead_back() {
    let checked = [
        check::<AdaptiveRule>(),
        check::<DepthEncoding>(),
        check::<GradientSource>(),
        check::<crate::nodes::Kernel>(),
        check::<MotionDepth>(),
        check::<MotionDirection>(),
        check::<MotionUnit>(),
        check::<NormalEncoding>(),
        check::<NormalSpace>(),
        check::<PostProcess>(),
        check::<Preset>(),
        check::<RoughnessEncoding>(),
        check::<Sampling>(),
        check::<Signals>(),
        check::<ViewForward>(),
        check::<DebugView>(),
        check::<ResetReason>(),
        check::<ToneCurve>(),
    ];
    assert_eq!(checked, STABLE.map(|row| row.0));
}

#[test]
fn a_name_is_padded_like_any_text() {
    assert_eq!(format!("{:>6}", Preset::Svgf), "  svgf");
}

#[cfg(feature = "serde")]
#[test]
fn a_name_is_what_a_file_has() {
    assert_eq!(serde_json::to_string(&Sampling::OneOf2x2).expect("JSON"), "\"one_of_2x2\"");
    assert_eq!(serde_json::from_str::<Sampling>("\"one_of_2x2\"").expect("JSON"), Sampling::OneOf2x2);
    let message = serde_json::from_str::<Preset>("\"svfg\"").expect_err("unknown").to_string();
    assert!(message.contains("`svfg`") && message.contains("asvgf"), "{message}");
}
