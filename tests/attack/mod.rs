//! Attacks: what a host may do wrong or to excess, in every preset. Pictures stay finite, and bad input is forgotten within a few
//! frames. `ATROUS_SOAK` makes them last longer (scripts/soak.sh).

mod brightness;
mod chaos;
mod endurance;
mod extremes;
mod values;

use super::support::{session, soak};
use atrous::config::{GradientSource, Preset, Sampling, Signals};
use atrous::executor::Session;
use atrous::{Config, FrameParams, ImageFormat, Lifetime, ResourceDecl, Shape, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("bad_values_are_forgotten_within_a_few_frames", values::bad_values_are_forgotten_within_a_few_frames),
    ("a_hundred_bad_frames_are_forgotten_within_a_few", values::a_hundred_bad_frames_are_forgotten_within_a_few),
    ("samples_that_are_not_finite_take_no_light", values::samples_that_are_not_finite_take_no_light),
    ("any_configuration_survives_chaos", chaos::any_configuration_survives_chaos),
    ("any_unit_of_light_is_filtered_alike", brightness::any_unit_of_light_is_filtered_alike),
    ("the_filter_holds_light_of_any_unit", brightness::the_filter_holds_light_of_any_unit),
    ("whatever_goes_out_holds_light_of_any_unit", brightness::whatever_goes_out_holds_light_of_any_unit),
    ("any_exposure_ratio_gives_a_picture", extremes::any_exposure_ratio_gives_a_picture),
    ("any_extent_gives_a_picture", extremes::any_extent_gives_a_picture),
    ("a_picture_of_sky_alone_passes_untouched", extremes::a_picture_of_sky_alone_passes_untouched),
    ("every_tunable_may_be_at_either_end", extremes::every_tunable_may_be_at_either_end),
    ("four_threads_on_one_device_give_the_same_bits", endurance::four_threads_on_one_device_give_the_same_bits),
    ("presets_exchanged_at_run_time_give_their_own_bits", endurance::presets_exchanged_at_run_time_give_their_own_bits),
    ("presets_exchanged_at_run_time_leave_nothing_behind", endurance::presets_exchanged_at_run_time_leave_nothing_behind),
    ("a_refused_call_leaves_nothing_behind", endurance::a_refused_call_leaves_nothing_behind),
    ("a_thousand_frames_take_no_more_than_a_few", endurance::a_thousand_frames_take_no_more_than_a_few),
];

/// Light of every pixel.
const LIGHT: f32 = 0.5;

/// Every preset with each number of signals that it takes, and with each source of gradients; two with all that there is beside surfaces.
/// [`chaos`] draws from all options.
fn configs(extent: [u32; 2]) -> Vec<Config> {
    let of = |preset| Signals::ALL.map(|signals| Config { preset, signals, ..Config::new(extent) });
    let has_one = |config: &Config| matches!(config.preset, Preset::Stabilize | Preset::Volume);
    let all = Preset::ALL.into_iter().flat_map(of).filter(|config| config.signals == Signals::Together || !has_one(config));
    let sources = [GradientSource::Reshaded, GradientSource::Sparse, GradientSource::Confidence, GradientSource::ChangeTest];
    let sourced = [Preset::Asvgf, Preset::Stabilize, Preset::Best]
        .into_iter()
        .flat_map(|preset| sources.map(|gradient_source| Config { preset, gradient_source, ..Config::new(extent) }));
    let beside = |preset, sampling| Config { preset, sampling, visibility: 1, volume: true, ..Config::new(extent) };
    all.chain(sourced).chain([beside(Preset::Svgf, Sampling::OneOf2x2), beside(Preset::Best, Sampling::Full)]).collect()
}

/// Every preset as it is by default, two with specular light; all of [`configs`] in a long run.
fn presets(extent: [u32; 2]) -> Vec<Config> {
    let plain = |config: &Config| Config { preset: config.preset, ..Config::new(extent) };
    let is_usual = |config: &Config| match config.preset {
        Preset::Svgf | Preset::Best => {
            *config == plain(config) || *config == Config { signals: Signals::Specular, ..plain(config) }
        }
        _ => *config == plain(config),
    };
    configs(extent).into_iter().filter(|config| soak::is_on() || is_usual(config)).collect()
}

/// The value of an input of a lit wall that stands still.
fn plain(name: &str) -> [f32; 4] {
    match name {
        "depth" | "scattering_depth" => [5.0; 4],
        "normal" | "object_normal" => [0.0, 0.0, 1.0, 0.0],
        "motion" | "forward_motion" | "emission" | "sparse_gradient" | "unshadowed_direct" => [0.0; 4],
        "confidence" => [1.0; 4],
        "noisy_direct" | "noisy_indirect" | "noisy_diffuse" | "noisy_specular" => [LIGHT / 2.0; 4],
        _ => [LIGHT; 4],
    }
}

/// A session that filters a lit wall, so that whatever else is in the picture was put there.
struct Wall {
    session: Session,
    extent: [u32; 2],
    /// Inputs of floats by name, with their number of texels.
    inputs: Vec<(String, usize)>,
    outputs: Vec<String>,
    frames: u32,
}

impl Wall {
    fn new(config: &Config) -> Self {
        let extent = config.allocated_extent;
        let mut session = session(config);
        let declaration = session.executor().denoiser().declaration();
        let (resources, setup) = (declaration.resources().to_vec(), *declaration.setup());
        let of = |want: fn(&&ResourceDecl) -> bool| resources.iter().filter(want).collect::<Vec<_>>();
        let is_float = |r: &&ResourceDecl| {
            matches!(r.shape, Shape::Image { format: ImageFormat::Any(atrous::Component::Float, _), .. })
                && matches!(r.lifetime, Lifetime::Input { .. })
        };
        let texels = |r: &ResourceDecl| r.extent(&setup).map_or(0, |[w, h]| w as usize * h as usize);
        let inputs: Vec<_> = of(is_float).into_iter().map(|r| (r.name.clone(), texels(r))).collect();
        let is_output = |r: &&ResourceDecl| r.lifetime == Lifetime::Output && r.name.starts_with("denoised");
        let outputs = of(is_output).into_iter().map(|r| r.name.clone()).collect();
        if resources.iter().any(|r| r.name == "surface_id") {
            session.upload_ids("surface_id", &vec![1; extent[0] as usize * extent[1] as usize]).expect("ids");
        }
        let mut this = Self { session, extent, inputs, outputs, frames: 0 };
        for (name, count) in this.inputs.clone() {
            this.session.upload(&name, &vec![plain(&name); count]).expect(&name);
        }
        this
    }

    /// Runs a frame, and gives the outputs, in which every value is finite.
    fn frame(&mut self, change: impl FnOnce(&mut FrameParams), tuning: &Tuning, what: &str) -> Vec<[f32; 4]> {
        let mut params = FrameParams { reshaded: true, frame_slot: self.frames % 2, ..FrameParams::new(self.extent) };
        self.frames += 1;
        change(&mut params);
        self.session.run(&params, tuning).expect(what);
        let mut all = Vec::new();
        for name in self.outputs.clone() {
            let texels = self.session.download(&name).expect(&name);
            if let Some(bad) = texels.iter().position(|t| !t.iter().all(|v| v.is_finite())) {
                panic!("{what}: texel {bad} of {name} is {:?}", texels[bad]);
            }
            // It has no colour.
            if name != "denoised_visibility" {
                all.extend(texels);
            }
        }
        all
    }
}
