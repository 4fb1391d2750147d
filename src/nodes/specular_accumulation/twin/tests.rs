use super::*;
use crate::nodes::temporal_accumulation::twin::{temporal_accumulation, PreviousFrame, TemporalAccumulationInputs};
use crate::reference::both_confidences::both_confidences;
use crate::reference::guide::pack_guide;
use crate::reference::nearest_history::SignalHistory;
use crate::reference::reflection::{mirror_share, unpack_image_share, unpack_reflection};
use crate::reference::reprojection::InstanceTransform;
use crate::reference::surface_motion::pack_surface_motion;
use crate::reference::test_scene::*;
use crate::reference::virtual_motion::VirtualMotion;
use crate::Config;
use glam::{Vec3, Vec4};

const EXTENT: [u32; 2] = [32, 16];
/// Pixels from one side of the image to the other side of a square one: the focal length of the test's camera.
const FOCAL: f32 = 8.0;
const WALL: f32 = 4.0;
/// Of the camera from frame to frame, to the right, scene units.
const STEP: f32 = 2.0;

/// A wall that faces a camera that slides, with a history whose value is the column.
struct Wall {
    frame: FrameConstants,
    guides: Guides,
    noisy: Image<[f32; 4]>,
    roughness: Option<Image<[f32; 4]>>,
    history: Image<[f32; 4]>,
    luminance_history: Image<LuminanceHistory>,
    reflection: Image<u32>,
    ids: Option<[Image<u32>; 2]>,
    motion: Option<Image<[f32; 4]>>,
    transforms: Vec<InstanceTransform>,
    is_filtered: bool,
    is_sharp: bool,
    /// Of base and coat: the light is mixed.
    reflectances: Option<[Image<[f32; 4]>; 2]>,
}

impl Wall {
    fn new(step: f32, hit_distance: f32, roughness: f32) -> Self {
        let cameras = [0.0, step].map(|x| camera(EXTENT, Vec3::new(x, 0.0, 0.0)));
        let mut guides = guides(EXTENT, |_, _| surface(WALL));
        let motion = pack_surface_motion([step * FOCAL / WALL, 0.0], Some((0.0, [0.0, 0.0, 1.0])));
        guides.surface_motion = Image::new(EXTENT, motion);
        // So noisy that no light disagrees.
        let luminance_history = LuminanceHistory { mean: 4.0, deviation: 1000.0, history_length: 1000.0, reason: 0, outside: None };
        Self {
            frame: frame_with(&Config::new(EXTENT), &cameras[0], &cameras[1]),
            guides,
            noisy: Image::new(EXTENT, [0.0, 0.0, 0.0, hit_distance]),
            roughness: Some(Image::new(EXTENT, [roughness; 4])),
            history: paint(EXTENT, |x, _| [x as f32; 4]),
            luminance_history: Image::new(EXTENT, luminance_history),
            reflection: Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance, roughness }, None)),
            ids: None,
            motion: None,
            transforms: Vec::new(),
            is_filtered: false,
            is_sharp: false,
            reflectances: None,
        }
    }

    fn inputs(&self) -> SpecularAccumulationInputs<'_> {
        SpecularAccumulationInputs {
            guide: &self.guides.guide,
            surface_motion: &self.guides.surface_motion,
            noisy: &self.noisy,
            is_filtered: self.is_filtered,
            is_sharp: self.is_sharp,
            is_mixed: self.reflectances.is_some(),
            material_class: None,
            reflectances: self.reflectances.as_ref().map(|images| images.each_ref()),
            roughness: self.roughness.as_ref(),
            history_confidence: None,
            is_beside_diffuse: false,
            light_ratio: None,
            instances: Instances {
                hit_id: self.ids.as_ref().map(|[hit, _]| hit),
                surface_id: self.ids.as_ref().map(|[_, mirror]| mirror),
                transforms: Some(&self.transforms),
                motion: self.motion.as_ref(),
            },
            previous: PreviousSpecular {
                guide: &self.guides.guide,
                history: &self.history,
                luminance_history: &self.luminance_history,
                reflection: &self.reflection,
            },
        }
    }

    fn run(&self) -> SpecularAccumulationOutputs {
        specular_accumulation(&self.frame, &tuning(), &self.inputs())
    }

    /// Columns from a pixel in the middle to that of the history which it took over.
    fn shift(&self) -> f32 {
        self.run().accumulated.at(IVec2::new(15, 8))[0] - 15.0
    }
}

/// History alone, for as long as it is worth.
fn tuning() -> Tuning {
    Tuning { alpha: 0.0, alpha_moments: 0.0, max_history_length: 1024.0, ..svgf_tuning() }
}

#[test]
fn mixed_light_moves_with_the_part_that_reflects_more() {
    let [surface, image] = [WALL, WALL + 4.0].map(|depth| STEP * FOCAL / depth);
    for (name, base, coat, expected) in [("metal", 0.0, 1.0, image), ("plastic", 1.0, 0.04, surface)] {
        let reflectances = Some([base, coat].map(|reflectance| Image::new(EXTENT, [reflectance; 4])));
        let shift = Wall { reflectances, ..Wall::new(STEP, 4.0, 0.0) }.shift();
        assert!((shift - expected).abs() < 0.05, "{name}: {shift} for {expected}");
    }
}

#[test]
fn mixed_light_that_changed_is_kept_by_the_part_that_is_no_image() {
    // The history of what a surface shows by itself is scaled and true again, that of images is not.
    let confidence = Image::new(EXTENT, both_confidences(1.0, 0.0));
    let ratio = Image::new(EXTENT, [4.0, 1.0, 0.25, 1.0]);
    let after = |base: f32, coat: f32, roughness: f32| {
        let reflectances = Some([base, coat].map(|reflectance| Image::new(EXTENT, [reflectance; 4])));
        let history = Image::new(EXTENT, [1.0; 4]);
        let wall = Wall { reflectances, history, ..Wall::new(0.0, 4.0, roughness) };
        let light_ratio = Some(StrataRatio { image: &ratio, stratum_size: 3 });
        let inputs = SpecularAccumulationInputs {
            history_confidence: Some(&confidence),
            is_beside_diffuse: true,
            light_ratio,
            ..wall.inputs()
        };
        let outputs = specular_accumulation(&wall.frame, &tuning(), &inputs);
        let at = IVec2::new(15, 8);
        (outputs.accumulated.at(at).map(|value| (value * 100.0).round()), outputs.luminance_history.at(at).history_length)
    };
    assert_eq!(after(1.0, 0.0, 1.0), ([400.0, 100.0, 25.0, 0.0], 1001.0), "plaster");
    assert_eq!(after(0.0, 1.0, 0.0), ([0.0, 0.0, 0.0, 0.0], 1.0), "a mirror");
    // A lobe that explains half of the light is as wide as both together may be blurred.
    let wall = Wall::new(0.0, 4.0, 0.0);
    let lobe = SeenReflection { hit_distance: 4.0, roughness: 0.0 };
    let image = 0.5 * mirror_share(mixed_roughness(&wall.frame, WALL, lobe, 0.5));
    assert!(image > 0.2, "{image}");
    let (light, frames) = after(1.0, 1.0, 0.0);
    assert!((frames * image - 1.0).abs() < 0.01, "{frames} frames");
    for (value, ratio) in light.iter().zip([4.0_f32, 1.0, 0.25]) {
        let expected = 100.0 * (1.0 - image) * ratio.powf(1.0 - image);
        assert!((value - expected).abs() <= 1.0, "{value} for {expected}");
    }
}

#[test]
fn what_is_seen_in_a_mirror_moves_as_its_image_behind_the_mirror() {
    let image = STEP * FOCAL / (WALL + 4.0);
    assert!((Wall::new(STEP, 4.0, 0.0).shift() - image).abs() < 0.05, "{} for {image}", Wall::new(STEP, 4.0, 0.0).shift());
    // The sky stands still on the screen of a camera that slides.
    assert!(Wall::new(STEP, FARTHEST, 0.0).shift().abs() < 0.05);
}

#[test]
fn a_sharp_history_of_a_mirror_is_looked_up_by_the_cubic() {
    // Its image moves by a fifth of a pixel.
    let step = 0.2 * (WALL + 4.0) / FOCAL;
    let columns = |is_sharp, roughness| {
        let history = paint(EXTENT, |x, _| [if x == 16 { 1.0 } else { 0.0 }; 4]);
        let light = Wall { history, is_sharp, ..Wall::new(step, 4.0, roughness) }.run().accumulated;
        [14, 15, 16, 17].map(|x| light.at(IVec2::new(x, 8))[0])
    };
    // The outer weights of the cubic are negative, so that the sum stays.
    for (is_sharp, expected) in [(false, [0.0, 0.2, 0.8, 0.0]), (true, [-0.016, 0.168, 0.912, -0.064])] {
        let given = columns(is_sharp, 0.0);
        assert!(given.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01), "{given:?} for {expected:?}");
    }
    assert_eq!(columns(true, 1.0), columns(false, 1.0), "a wide lobe is not worth it");
}

#[test]
fn a_lamp_before_what_is_seen_leaves_nothing_in_its_past() {
    // The image moves by a fifth of a pixel, towards a lamp of which the past beside has nothing.
    let step = 0.2 * (WALL + 4.0) / FOCAL;
    let light = |roughness, lamp| {
        let seen = |x: i32| pack_reflection(&SeenReflection { hit_distance: if x < 16 { 4.0 } else { lamp }, roughness }, None);
        let history = paint(EXTENT, |x, _| [if x < 16 { 1.0 } else { 101.0 }; 4]);
        let outputs = Wall { history, reflection: paint(EXTENT, |x, _| seen(x)), ..Wall::new(step, 4.0, roughness) }.run();
        let frames = outputs.luminance_history.at(IVec2::new(15, 8)).history_length;
        (outputs.accumulated.at(IVec2::new(15, 8))[0], frames)
    };
    let ((alike, most), (beside, frames)) = (light(0.1, 4.0), light(0.1, 1.0));
    assert!((alike - 21.0).abs() < 0.5 && beside < 1.5, "{alike}, {beside}");
    assert!(frames > 0.5 * most, "its own past is worth what it was: {frames} of {most} frames");
    let (rough, _) = light(1.0, 1.0);
    assert!((rough - 1.0).abs() > 5.0, "each sample of a wide lobe meets something else: {rough}");
}

/// Deviation of a past between a wall and a lamp, neither of which is noisy. `now`: the noise of samples, by diagonals.
fn deviation_beside_a_lamp(hit_distance: f32, roughness: Option<f32>, now: impl Fn(i32) -> f32) -> f32 {
    let lamp = |x: i32| if x < 16 { 1.0 } else { 101.0 };
    let luminance_history = |mean| LuminanceHistory { mean, deviation: 0.0, history_length: 100.0, reason: 0, outside: None };
    // What counts moves by a fifth of a pixel.
    let depth = if hit_distance > 0.0 && roughness == Some(0.1) { WALL + hit_distance } else { WALL };
    let wall = Wall {
        history: paint(EXTENT, |x, _| [lamp(x); 4]),
        luminance_history: paint(EXTENT, |x, _| luminance_history(lamp(x))),
        noisy: paint(EXTENT, |x, y| {
            let light = now(x + y) * if x == 15 { 21.0 } else { lamp(x) };
            [light, light, light, hit_distance]
        }),
        roughness: roughness.map(|roughness| Image::new(EXTENT, [roughness; 4])),
        ..Wall::new(0.2 * depth / FOCAL, hit_distance, roughness.unwrap_or(0.0))
    };
    wall.run().luminance_history.at(IVec2::new(15, 8)).deviation
}

#[test]
fn what_lies_between_the_pixels_of_a_past_is_no_noise_in_a_mirror() {
    let [mirror, rough] = [0.1, 1.0].map(|roughness| deviation_beside_a_lamp(4.0, Some(roughness), |_| 1.0));
    assert!(mirror < 8.0 && (35.0..45.0).contains(&rough), "{mirror} in a mirror, {rough} in a wide lobe");
    // Where nobody knows what is seen, samples of now tell how much noise there is.
    let sure = deviation_beside_a_lamp(0.0, None, |_| 1.0);
    let noisy = deviation_beside_a_lamp(0.0, None, |i| if i % 2 == 0 { 0.2 } else { 1.8 });
    assert!(sure < 10.0 && noisy > 15.0, "{sure} without noise, {noisy} with it");
}

const FARTHEST: f32 = crate::reference::FARTHEST_HIT;

#[test]
fn rough_surfaces_move_as_the_surface() {
    let expected = STEP * FOCAL / WALL;
    for (hit_distance, roughness) in [(4.0, 1.0), (0.0, 1.0)] {
        let shift = Wall::new(STEP, hit_distance, roughness).shift();
        assert!((shift - expected).abs() < 0.05, "{hit_distance} {roughness}: {shift}");
    }
}

#[test]
fn a_rough_surface_without_hit_distance_is_as_diffuse_light() {
    let mut wall = Wall::new(0.7, 0.0, 1.0);
    wall.noisy = noise(EXTENT, 3);
    let tuning = svgf_tuning();
    let ours = specular_accumulation(&wall.frame, &tuning, &wall.inputs());
    let signal = SignalHistory { irradiance: &wall.history, luminance_history: &wall.luminance_history };
    let diffuse = temporal_accumulation(
        &wall.frame,
        &tuning,
        &TemporalAccumulationInputs {
            guide: &wall.guides.guide,
            surface_motion: &wall.guides.surface_motion,
            irradiance: &[&wall.noisy],
            object_normals: None,
            material_class: None,
            history_confidence: None,
            repair: false,
            sharp: false,
            light_ratio: None,
            previous: Some(PreviousFrame { guide: &wall.guides.guide, signals: &[signal] }),
        },
    );
    for p in [IVec2::new(3, 3), IVec2::new(12, 9), IVec2::new(20, 15)] {
        let (a, b) = (ours.accumulated.at(p), diffuse.irradiance[0].at(p));
        assert!((a[0] - b[0]).abs() < 0.02, "{p}: {a:?} {b:?}");
        assert_eq!(
            ours.luminance_history.at(p).history_length,
            diffuse.luminance_history[0].at(p).history_length,
            "{p}: history length"
        );
    }
}

#[test]
fn another_thing_in_the_mirror_or_another_finish_drops_the_past() {
    let length = |wall: &Wall| wall.run().luminance_history.at(IVec2::new(10, 8)).history_length;
    let same = Wall::new(0.0, 4.0, 0.0);
    assert!(length(&same) > 900.0, "{}", length(&same));
    for before in [SeenReflection { hit_distance: 0.5, roughness: 0.0 }, SeenReflection { hit_distance: 4.0, roughness: 0.8 }] {
        let mut other = Wall::new(0.0, 4.0, 0.0);
        other.reflection = Image::new(EXTENT, pack_reflection(&before, None));
        other.guides.surface_motion = Image::new(EXTENT, pack_surface_motion([100.0, 0.0], Some((0.0, [0.0, 0.0, 1.0]))));
        assert!(length(&other) < 10.0, "{before:?}: {}", length(&other));
    }
}

/// What surfaces, distances and finish do not tell: a lamp in the mirror that was switched on.
#[test]
fn light_that_is_not_that_of_the_past_drops_it() {
    let length = |deviation, noisy: &dyn Fn(i32, i32) -> f32| {
        let mut wall = Wall::new(0.0, 4.0, 0.0);
        let luminance_history = LuminanceHistory { mean: 0.25, deviation, history_length: 1000.0, reason: 0, outside: None };
        (wall.history, wall.luminance_history) = (Image::new(EXTENT, [0.25; 4]), Image::new(EXTENT, luminance_history));
        // One channel tells it.
        wall.noisy = paint(EXTENT, |x, y| [0.25, 0.25, noisy(x, y), 4.0]);
        wall.run().luminance_history.at(IVec2::new(15, 8)).history_length
    };
    let chequer = |x: i32, y: i32| 2.0 * ((x + y) % 2) as f32;
    assert!(length(0.0, &|_, _| 0.25) > 900.0, "the same light");
    assert!(length(0.0, &|_, _| 1.0) < 1.5, "other light without noise");
    assert!(length(0.0, &|x, y| 4.0 * chequer(x, y)) < 1.5, "other light with noise");
    assert!(length(0.0, &|x, y| 0.25 * chequer(x, y)) > 900.0, "noise about the same light");
    // Twenty-five samples that a light which one in twenty hits has missed.
    assert!(length(0.0, &|_, _| 0.0) < 1.5, "no noise is known");
    assert!(length(1.2, &|_, _| 0.0) > 900.0, "rare light");
}

/// Frames of the past that counts, of a wall whose hit distance and finish nobody knows: `before` and `now` are its light.
fn of_unknown_light(step: f32, deviation: f32, before: impl Fn(i32) -> f32, now: impl Fn(i32) -> f32) -> (f32, Option<f32>) {
    let mut wall = Wall { roughness: None, ..Wall::new(step, 0.0, 0.0) };
    let luminance_history = |mean| LuminanceHistory { mean, deviation, history_length: 100.0, reason: 0, outside: None };
    wall.history = paint(EXTENT, |x, _| [before(x); 4]);
    wall.luminance_history = paint(EXTENT, |x, _| luminance_history(before(x)));
    wall.noisy = paint(EXTENT, |x, y| {
        let light = now(x) * (0.975 + 0.05 * ((x + y) % 2) as f32);
        [light, light, light, 0.0]
    });
    let (p, outputs) = (IVec2::new(12, 8), wall.run());
    let frames = outputs.luminance_history.at(p).history_length;
    (frames, unpack_image_share(outputs.reflection.at(p)))
}

#[test]
fn the_light_tells_whether_a_thing_at_unknown_distance_moves_as_the_surface_or_as_an_image() {
    // Stripes with a period that the motion of four pixels does not hide.
    let stripes = |x: i32| if x.rem_euclid(7) < 3 { 1.0 } else { 4.0 };
    // What lies at infinity stands still on the screen of a camera that slides.
    let (frames, share) = of_unknown_light(STEP, 0.05, stripes, stripes);
    assert!(share > Some(0.95) && frames > 50.0, "as an image: {share:?}, {frames} frames");
    let (frames, share) = of_unknown_light(STEP, 0.05, stripes, |x| stripes(x + 4));
    assert!(share < Some(0.05) && frames > 50.0, "as the surface: {share:?}, {frames} frames");
    assert!(of_unknown_light(STEP, 0.05, stripes, |_| 16.0).0 < 2.0, "as neither");
}

#[test]
fn a_roughness_of_minus_one_is_none() {
    let of = |roughness: Option<f32>| {
        let mut wall = Wall { roughness: roughness.map(|r| Image::new(EXTENT, [r; 4])), ..Wall::new(STEP, 0.0, 0.0) };
        wall.history = paint(EXTENT, |x, _| [if x.rem_euclid(7) < 3 { 1.0 } else { 4.0 }; 4]);
        wall.noisy = wall.history.map(|&[r, g, b, _]| [r, g, b, 0.0]);
        let outputs = wall.run();
        (outputs.accumulated.texels().to_vec(), outputs.reflection.texels().to_vec())
    };
    assert_eq!(of(Some(-1.0)), of(None));
    assert_ne!(of(Some(1.0)), of(None), "what is known to be rough is no mirror");
}

/// Light that is the same everywhere tells nothing.
#[test]
fn what_former_frames_told_is_kept_for_some_frames() {
    for (before, expected) in [(None, 0.076), (Some(0.95), 0.867), (Some(0.0), 0.013)] {
        let seen = SeenReflection { hit_distance: 0.0, roughness: 1.0 };
        let mut wall = Wall { roughness: None, ..Wall::new(STEP, 0.0, 0.0) };
        wall.history = Image::new(EXTENT, [1.0; 4]);
        wall.noisy = Image::new(EXTENT, [1.0, 1.0, 1.0, 0.0]);
        wall.reflection = Image::new(EXTENT, pack_reflection(&seen, before));
        let given = unpack_image_share(wall.run().reflection.at(IVec2::new(12, 8))).expect("a past");
        assert!((given - expected).abs() < 0.01, "{before:?}: {given} for {expected}");
    }
}

/// Two pasts of eight frames differ by noise, and one of them is a little nearer to the noise of now.
#[test]
fn the_noise_of_pasts_does_not_tell_what_is_seen() {
    let images = |frames| {
        let mut wall = Wall { roughness: None, ..Wall::new(STEP, 0.0, 0.0) };
        wall.history = noise(EXTENT, 7).map(|texel| texel.map(|x| 0.5 + (x - 0.5) / 8.0_f32.sqrt()));
        wall.noisy = noise(EXTENT, 8).map(|&[r, g, b, _]| [r, g, b, 0.0]);
        let luminance_history = LuminanceHistory { mean: 0.5, deviation: 0.3, history_length: frames, reason: 0, outside: None };
        wall.luminance_history = Image::new(EXTENT, luminance_history);
        let reflection = wall.run().reflection;
        let pixels = (4..20).flat_map(|x| (4..12).map(move |y| IVec2::new(x, y)));
        pixels.filter(|p| unpack_image_share(reflection.at(*p)) > Some(0.5)).count()
    };
    // A past of a thousand frames would not be noisy.
    let [noisy, sure] = [8.0, 1000.0].map(images);
    assert!(noisy < 10 && sure > 4 * noisy, "{noisy} of 128, {sure} where nothing is taken for noise");
}

#[test]
fn a_highlight_that_left_drops_its_past() {
    let before = |x: i32| if (10..15).contains(&x) { 16.0 } else { 1.0 };
    // It shone here in some of the frames, so that the past itself is no longer sure.
    assert!(of_unknown_light(0.0, 16.0, before, |_| 0.8).0 < 2.0);
    assert!(of_unknown_light(0.0, 16.0, before, before).0 > 90.0);
    assert!(of_unknown_light(0.0, 16.0, |_| 1.0, |_| 1.0).0 > 90.0);
    // One sample in a hundred brings light that all of these missed.
    assert!(of_unknown_light(0.0, 10.0, |_| 1.0, |_| 0.1).0 > 90.0, "rare light");
}

#[test]
fn a_lobe_takes_the_distance_of_its_surroundings_and_a_mirror_its_own() {
    let of = |roughness| {
        let mut wall = Wall::new(0.0, 4.0, roughness);
        wall.noisy = paint(EXTENT, |x, y| [0.0, 0.0, 0.0, if (x + y) % 2 == 0 { 2.0 } else { 8.0 }]);
        wall.frame = reset(wall.frame);
        unpack_reflection(wall.run().reflection.at(IVec2::new(10, 8))).hit_distance
    };
    assert!((of(0.0) - 2.0).abs() < 0.01, "{}", of(0.0));
    assert!(of(0.9) > 3.0, "{}", of(0.9));
}

/// Weight of the new sample in a past that is worth more frames than `alpha` lets count.
fn weight_of_sample(mut wall: Wall) -> f32 {
    wall.history = Image::new(EXTENT, [1.0; 4]);
    let tuning = Tuning { alpha: 0.2, alpha_moments: 0.2, ..tuning() };
    1.0 - specular_accumulation(&wall.frame, &tuning, &wall.inputs()).accumulated.at(IVec2::new(15, 8))[0]
}

#[test]
fn where_a_past_is_sure_the_new_sample_weighs_less() {
    let rough_but_still = 0.2 * (1.0 - 0.6 * mirror_share(0.5));
    for (step, hit_distance, roughness, expected) in [
        (0.0, 4.0, 0.0, 0.08),
        (STEP, 4.0, 0.0, 0.08),
        (0.0, 4.0, 0.5, rough_but_still),
        (STEP, 4.0, 0.5, 0.2),
        (0.0, 4.0, 1.0, 0.2),
        (0.0, 0.0, 0.0, 0.2),
    ] {
        let given = weight_of_sample(Wall::new(step, hit_distance, roughness));
        assert!((given - expected).abs() < 2e-3, "step {step}, {hit_distance}, {roughness}: {given} for {expected}");
    }
}

#[test]
fn what_stands_still_before_an_eye_that_turns_is_half_as_sure() {
    // The wall goes along with the camera, which looks at the world from another side then.
    let (step, share) = (0.005, mirror_share(0.5));
    let mut wall = Wall::new(step, WALL, 0.5);
    wall.guides.surface_motion = Image::new(EXTENT, pack_surface_motion([0.0; 2], Some((0.0, [0.0, 0.0, 1.0]))));
    let moved = step * FOCAL * (1.0 / (WALL + share * WALL) - (1.0 - share) / WALL);
    let expected = 0.2 * (1.0 - 0.6 * share * 0.5 * (1.0 - moved / 0.01));
    let given = weight_of_sample(wall);
    assert!((given - expected).abs() < 2e-3, "{given} for {expected}");
}

#[test]
fn what_stands_still_is_half_as_sure_where_history_is_filtered() {
    let wall = |is_filtered| Wall { is_filtered, ..Wall::new(0.0, WALL, 0.5) };
    let given = [true, false].map(|is_filtered| 0.2 - weight_of_sample(wall(is_filtered)));
    assert!((given[0] - 0.5 * given[1]).abs() < 2e-3 && given[1] > 0.05, "{given:?}");
}

/// A lobe of a convex surface is as narrow on the screen as the image of what it shows, and so is what may be off in its past.
#[test]
fn the_lobe_of_a_curved_surface_tolerates_less() {
    let (hit_distance, roughness) = (50.0, 0.8);
    let mut wall = Wall::new(STEP, hit_distance, roughness);
    let bent = |x: i32| Surface { normal: Vec3::new(0.2 * (x - 15) as f32, 0.0, 1.0).normalize().into(), ..surface(WALL) };
    wall.guides.guide = paint(EXTENT, |x, _| pack_guide(&bent(x)));
    // Another finish: the past at the image's place is worth less than a frame.
    let past = SeenReflection { hit_distance, roughness: 0.4 };
    wall.reflection = Image::new(EXTENT, pack_reflection(&past, None));
    let tuning = Tuning { normal_tolerance: -1.0, ..tuning() };
    let outputs = specular_accumulation(&wall.frame, &tuning, &wall.inputs());
    let length = outputs.luminance_history.at(IVec2::new(15, 8)).history_length;

    // Along rows, which is how the camera slides; the mean curvature is half of it.
    let curvature = 0.6 / 1.36_f32.sqrt() / (3.0 * WALL / FOCAL);
    let image = hit_distance / (1.0 + curvature * hit_distance);
    let radius = roughness * roughness * image * FOCAL / (WALL + image);
    let seen_at = hit_distance / (1.0 + 2.0 * curvature * hit_distance) * mirror_share(roughness);
    let error = STEP * FOCAL / WALL - STEP * FOCAL / (WALL + seen_at);
    let expected = 1.0 + 0.5 * (1.0 + radius) / error;
    assert!((length - expected).abs() < 0.25, "{length} for {expected}");
}

#[test]
fn the_background_passes_and_a_reset_drops_the_past() {
    let mut wall = Wall::new(0.0, 4.0, 0.2);
    wall.noisy = noise(EXTENT, 5);
    let p = IVec2::new(4, 4);
    let fresh = specular_accumulation(&reset(wall.frame), &tuning(), &wall.inputs());
    assert!((fresh.accumulated.at(p)[0] - wall.noisy.at(p)[0]).abs() < 1e-3);
    assert_eq!(fresh.luminance_history.at(p).reason, Reason::Reset as u16);
    wall.guides.guide = Image::new(EXTENT, pack_guide(&Surface::default()));
    let sky = wall.run();
    assert!((sky.accumulated.at(p)[0] - wall.noisy.at(p)[0]).abs() < 1e-3);
    assert_eq!(unpack_reflection(sky.reflection.at(p)).hit_distance, 0.0);
}

/// A transform that turns about the y axis of a point on the wall, then moves.
fn moved(turn: f32, by: Vec3) -> InstanceTransform {
    let (sin, cos) = turn.sin_cos();
    // About (0, 0, -WALL).
    [[cos, 0.0, sin, by.x + sin * WALL], [0.0, 1.0, 0.0, by.y], [-sin, 0.0, cos, by.z + (cos - 1.0) * WALL]]
}

/// A wall whose instance is 1, and in which instance 2 is seen.
fn wall_before(mirror: InstanceTransform, thing: InstanceTransform) -> Wall {
    let still = moved(0.0, Vec3::ZERO);
    Wall { ids: Some([2, 1].map(|id| Image::new(EXTENT, id))), transforms: vec![still, mirror, thing], ..Wall::new(0.0, 4.0, 0.0) }
}

#[test]
fn what_moves_in_a_mirror_is_where_the_plane_mirrored_it() {
    let still = moved(0.0, Vec3::ZERO);
    let thing = moved(0.0, Vec3::new(1.05, 0.0, 0.4));
    let mirror = moved(0.005, Vec3::new(0.1, 0.0, -0.2));
    for [mirror, thing] in [[still, thing], [mirror, still], [mirror, thing], [mirror, mirror]] {
        let mut wall = wall_before(mirror, thing);
        wall.noisy = paint(EXTENT, |x, _| [x as f32, x as f32, x as f32, 4.0]);
        let motion = VirtualMotion::new(&wall.frame, &wall.guides.guide);
        let c = motion.mirror(IVec2::new(15, 8), [0.0; 2]);
        let normal = c.surface.unit_normal();
        let at = |rows: &InstanceTransform, v: Vec3| Vec3::from(rows.map(|row| Vec4::from(row).dot(v.extend(1.0))));
        let (place, seen) = (at(&mirror, c.position), at(&thing, c.position + 4.0 * c.sight.reflect(normal)));
        let normal = at(&mirror, c.position + normal) - place;
        let image = seen - 2.0 * normal * normal.dot(seen - place);
        // The past knows the distance that was there.
        let sight = at(&mirror, c.position + c.sight) - place;
        let past = SeenReflection { hit_distance: sight.dot(image - place), roughness: 0.0 };
        wall.reflection = Image::new(EXTENT, pack_reflection(&past, None));
        let expected = 16.0 - FOCAL * image.x / image.z - 15.5;
        assert!((wall.shift() - expected).abs() < 0.012, "{mirror:?}, {thing:?}: {} for {expected}", wall.shift());
        assert_eq!(wall.run().statistics, Statistics::default());
    }
}

/// Another thing may be seen there now, unless its instance tells that it is the same.
#[test]
fn the_distance_of_a_followed_thing_may_change() {
    let still = moved(0.0, Vec3::ZERO);
    let share = |wall: Wall| {
        let reflection = Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance: 6.0, roughness: 0.0 }, None));
        unpack_image_share(Wall { reflection, ..wall }.run().reflection.at(IVec2::new(15, 8))).expect("a past")
    };
    // Neither past is of what is seen.
    assert!((share(Wall::new(0.0, 4.0, 0.0)) - 0.5).abs() < 0.01);
    assert!(share(wall_before(still, still)) > 0.99);
}

/// Frames that the past of a mirror counts which stands still, by what was seen in it before and what is seen now, by pixel.
fn still_mirror(roughness: f32, before: f32, now: impl Fn(i32, i32) -> f32) -> f32 {
    let mut wall = Wall::new(0.0, 4.0, roughness);
    wall.reflection = Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance: before, roughness }, None));
    wall.noisy = paint(EXTENT, |x, y| [0.0, 0.0, 0.0, now(x, y)]);
    wall.run().luminance_history.at(IVec2::new(15, 8)).history_length
}

#[test]
fn another_thing_in_a_mirror_that_stands_still_drops_the_past() {
    for (before, now, kept) in
        [(4.0, 4.0, true), (1.0, 4.0, false), (1.0, 0.0, false), (0.0, 1.0, false), (0.0, 0.0, true), (0.0, FARTHEST, true)]
    {
        let frames = still_mirror(0.1, before, |_, _| now);
        assert_eq!((frames > 900.0, frames < 3.0), (kept, !kept), "{before}, then {now}: {frames}");
    }
    // At an edge, either may be seen: as long as both are seen around, a part of the past counts.
    let at_edge = still_mirror(0.1, 1.0, |x, _| if x > 15 { 1.0 } else { 4.0 });
    let beyond = still_mirror(0.1, 1.0, |_, _| 4.0);
    assert!(at_edge - 1.0 > 3.0 * (beyond - 1.0), "{at_edge} {beyond}");
    // Each sample of a wide lobe meets something else.
    assert!(still_mirror(1.0, 1.0, |_, _| 4.0) > 900.0);
}

#[test]
fn the_other_side_of_an_outline_is_chance_within_the_noise_of_the_past() {
    // To the right a lamp of luminance 8 is seen, to the left a dark wall behind it. The past of the pixel between them was at the lamp.
    let frames = |deviation, light| {
        let mut wall = Wall::new(0.0, 4.0, 0.1);
        wall.reflection = Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance: 1.0, roughness: 0.1 }, None));
        wall.history = Image::new(EXTENT, [4.0; 4]);
        wall.luminance_history =
            Image::new(EXTENT, LuminanceHistory { mean: 4.0, deviation, history_length: 1000.0, reason: 0, outside: None });
        wall.noisy = paint(EXTENT, |x, y| match x {
            16.. => [8.0, 8.0, 8.0, 1.0],
            15 if y == 8 => [light, light, light, 4.0],
            _ => [0.0, 0.0, 0.0, 4.0],
        });
        wall.run().luminance_history.at(IVec2::new(15, 8)).history_length
    };
    assert!(frames(4.0, 0.0) > 900.0, "now the wall, half of the time the lamp");
    assert!(frames(0.5, 0.0) < 3.0, "far beyond the noise");
    assert!(frames(4.0, 3.9) < 3.0, "next to the same light: a short history costs nothing");
}

#[test]
fn a_mirror_without_a_sample_takes_the_distance_beside_it_and_one_that_shows_nothing_does_not() {
    // Of a pixel with a thing to its right, as it is alone, and with all to its left.
    let distances = |own| {
        [15, 0].map(|left| {
            let mut wall = Wall::new(0.0, 4.0, 0.05);
            wall.frame = reset(wall.frame);
            wall.noisy =
                paint(EXTENT, |x, y| [0.0, 0.0, 0.0, if (left..=15).contains(&x) && (left < 15 || y == 8) { own } else { 2.0 }]);
            unpack_reflection(wall.run().reflection.at(IVec2::new(15, 8))).hit_distance
        })
    };
    assert_eq!(distances(-1.0), [2.0, 2.0]);
    assert_eq!(distances(0.0), [2.0, 0.0], "alone it is a bad distance");
    assert_eq!(distances(1.0), [1.0, 1.0]);
}

/// Its pixels draw different things.
#[test]
fn in_a_wide_lobe_no_thing_is_followed() {
    let moving = wall_before(moved(0.0, Vec3::ZERO), moved(0.0, Vec3::new(1.05, 0.0, 0.4)));
    let given = [0.0, 0.6].map(|roughness| {
        let Wall { ids, transforms, .. } = &moving;
        let (ids, transforms) = (ids.clone(), transforms.clone());
        let wall = Wall { ids, transforms, ..Wall::new(0.0, 4.0, roughness) };
        wall.run().accumulated == Wall::new(0.0, 4.0, roughness).run().accumulated
    });
    assert_eq!(given, [false, true]);
}

#[test]
fn a_thing_without_a_usable_transform_is_at_rest_and_counted() {
    let pixels = EXTENT[0] * EXTENT[1];
    let far = Vec3::new(1e16, 0.0, 0.0);
    for (hit_id, thing, counted) in [(3, moved(0.0, Vec3::X), pixels), (0, moved(0.0, Vec3::X), 0), (2, [[f32::NAN; 4]; 3], pixels)]
        .into_iter()
        .chain([(u32::MAX, moved(0.0, Vec3::X), pixels), (2, moved(0.0, far), pixels)])
    {
        let mut wall = wall_before(moved(0.0, Vec3::ZERO), thing);
        wall.ids = Some([hit_id, 1].map(|id| Image::new(EXTENT, id)));
        let (given, rest) = (wall.run(), Wall::new(0.0, 4.0, 0.0).run());
        assert_eq!(given.statistics[Counter::HitId], counted, "{hit_id}");
        assert_eq!((&given.accumulated, &given.reflection), (&rest.accumulated, &rest.reflection), "{hit_id}");
    }
    // One that a transform carries behind the mirror is not seen in it.
    let behind = wall_before(moved(0.0, Vec3::ZERO), moved(0.0, Vec3::new(3.0, 0.0, -9.0)));
    assert_eq!(behind.run().accumulated, Wall::new(0.0, 4.0, 0.0).run().accumulated);
}

#[test]
fn the_motion_of_the_host_counts_before_ids_and_ids_where_it_is_not_finite() {
    let (still, mirror) = (moved(0.0, Vec3::ZERO), moved(0.005, Vec3::new(0.1, 0.0, -0.2)));
    let (way, pixels) = (Vec3::new(1.05, 0.0, 0.4), EXTENT[0] * EXTENT[1]);
    let shift = |wall: Wall| {
        let noisy = paint(EXTENT, |x, _| [x as f32, x as f32, x as f32, 4.0]);
        Wall { noisy, ..wall }.shift()
    };
    for mirror in [still, mirror] {
        let by_id = || wall_before(mirror, moved(0.0, way));
        let with = |motion: [f32; 4], wall: Wall| Wall { motion: Some(Image::new(EXTENT, motion)), ..wall };
        let motion = way.extend(0.0).into();
        let expected = shift(by_id());
        let elsewhere = shift(wall_before(mirror, moved(0.0, -way)));
        assert!((expected - elsewhere).abs() > 0.1, "{expected} {elsewhere}");
        assert!((shift(with(motion, wall_before(mirror, moved(0.0, -way)))) - expected).abs() < 1e-3);
        // An id that has no transform is not asked for.
        let unknown = Wall { ids: Some([9, 1].map(|id| Image::new(EXTENT, id))), ..by_id() };
        let given = with(motion, unknown).run();
        assert_eq!(given.statistics, Statistics::default());
        for bad in [f32::NAN, f32::INFINITY] {
            let given = with([0.0, bad, 0.0, 0.0], by_id()).run();
            assert_eq!(given.accumulated, by_id().run().accumulated);
            assert_eq!(given.statistics[Counter::SpecularMotion], pixels);
        }
    }
    // Without ids and transforms.
    let alone = Wall { motion: Some(Image::new(EXTENT, way.extend(0.0).into())), ..Wall::new(0.0, 4.0, 0.0) };
    assert!((shift(alone) - shift(wall_before(still, moved(0.0, way)))).abs() < 1e-3);
}
