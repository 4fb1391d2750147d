//! Mistakes in a graph that types cannot see.

use super::*;
use crate::contract::{Lifetime, PassDecl, Phase, UseFrame};
use crate::nodes::*;

/// A graph with guides, accumulated irradiance and its history.
fn begun(feedback: Feedback) -> (Graph, Guides, Irradiance, History) {
    let mut g = Graph::new([64, 36]);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate::default());
    let history = g.history(&irradiance, feedback);
    (g, guides, irradiance, history)
}

fn accumulated(feedback: Feedback) -> (Graph, Guides, Accumulated, History) {
    let (mut g, guides, irradiance, history) = begun(feedback);
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    (g, guides, accumulated, history)
}

#[test]
fn a_graph_of_a_host_is_a_declaration() {
    let (mut g, guides, accumulated, history) = accumulated(Feedback::Accumulated);
    let variance = Variance { estimator: Estimator::Temporal, ..Variance::default() };
    let estimate = g.variance(&guides, &accumulated, &history, variance);
    let denoised = g.modulate(&guides, &estimate.into(), Modulate::default());
    g.output("mine", &denoised);
    let declaration = g.finish().expect("valid");
    let names: Vec<_> = declaration.passes().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["start_frame", "import", "demodulate", "temporal_accumulation", "variance", "modulate"]);
    let lifetime = |name: &str| declaration.resource(declaration.find(name).expect(name)).lifetime;
    assert_eq!((lifetime("mine"), lifetime("irradiance_history")), (Lifetime::Output, Lifetime::HistoryInPlace));
    assert_eq!((lifetime("guide"), lifetime("surface_motion")), (Lifetime::History, Lifetime::Transient));
    assert!(declaration.config().is_none() && declaration.memory().history > 0);
}

#[test]
fn specular_light_is_compared_strictly_where_its_variance_says_what_is_rare() {
    let strict = |apart: bool, estimator: Estimator| {
        let mut g = Graph::new([64, 36]);
        let guides = g.import(Import::default());
        let (diffuse, specular) = (g.radiance("noisy_diffuse"), g.radiance("noisy_specular"));
        let irradiance = [diffuse, specular].map(|noisy| g.demodulate(&guides, &noisy, Demodulate::default()));
        let history = g.specular_history(&irradiance[1], Feedback::Accumulated);
        let found = g.specular_accumulation(&guides, &irradiance[1], &history, SpecularAccumulation::default());
        let variance = Variance { estimator, ..Variance::default() };
        let estimate = if apart {
            g.variance(&guides, &found.accumulated, &history.history, variance)
        } else {
            let of_diffuse = g.history(&irradiance[0], Feedback::Accumulated);
            let accumulated = g.temporal_accumulation(&guides, &irradiance[0], &of_diffuse, Accumulation::default());
            let both = g.pair(&accumulated, &found.accumulated);
            g.variance(&guides, &both, &of_diffuse.beside(history.history), variance)
        };
        let atrous = Atrous { luminance_weight: LuminanceWeight::OfMeans, reflection: Some(found.reflection), ..Atrous::default() };
        let filtered = g.atrous(&guides, &estimate, atrous);
        let radiance = g.modulate(&guides, &filtered.into(), Modulate::default());
        g.output("mine", &radiance);
        let declaration = g.finish().expect("valid");
        let levels = declaration.passes().iter().filter(|pass| pass.name.starts_with("atrous"));
        let marked =
            |pass: &PassDecl| pass.pipeline().expect("a dispatch").constants.iter().any(|c| c.name == "MARKED" && c.bits == 1);
        levels.map(marked).collect::<Vec<_>>()
    };
    assert_eq!(strict(true, Estimator::OfMean), [true; 5]);
    assert_eq!(strict(true, Estimator::Switched), [false; 5]);
    assert_eq!(strict(false, Estimator::OfMean), [false; 5]);
}

#[test]
fn signals_name_their_resources_and_passes() {
    let mut g = Graph::new([64, 36]);
    let guides = g.import(Import::default());
    for name in ["noisy_radiance", "noisy_ao"] {
        let noisy = g.radiance(name);
        let irradiance = g.demodulate(&guides, &noisy, Demodulate::default());
        let history = g.history(&irradiance, Feedback::Accumulated);
        let accumulation = Accumulation { alpha: Value::Fixed(0.05), ..Accumulation::default() };
        let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, accumulation);
        let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
        let radiance = g.modulate(&guides, &estimate.into(), Modulate::default());
        g.output(&format!("{name}_accumulated"), &radiance);
    }
    let declaration = g.finish().expect("two signals do not collide");
    for name in ["luminance_history", "luminance_history_ao", "irradiance_history", "irradiance_history_ao"] {
        assert!(declaration.find(name).is_some(), "{name}");
    }
    assert!(declaration.passes().iter().any(|p| p.name == "temporal_accumulation_ao"));
}

#[test]
fn two_kernels_on_one_estimate_stand_in_scopes() {
    let (mut g, guides, accumulated, history) = accumulated(Feedback::Accumulated);
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    let narrow =
        g.scope("narrow", |g| g.atrous(&guides, &estimate, Atrous { kernel: Kernel::Box, levels: 2, ..Atrous::default() }));
    let wide = g.scope("wide", |g| g.atrous(&guides, &estimate, Atrous::default()));
    g.output("narrow", &narrow);
    g.output("wide", &wide);
    let declaration = g.finish().expect("valid");
    let names: Vec<_> = declaration.passes().iter().map(|p| p.name.as_str()).filter(|n| n.starts_with("atrous")).collect();
    assert_eq!(names[..3], ["atrous_narrow_0", "atrous_narrow_1", "atrous_wide_0"]);
}

#[test]
fn a_stage_twice_under_one_name_is_refused() {
    let (mut g, guides, accumulated, history) = accumulated(Feedback::Accumulated);
    g.variance(&guides, &accumulated, &history, Variance::default());
    g.variance(&guides, &accumulated, &history, Variance::default());
    assert_names(&refusal(g), &["node `variance`", "already", "Graph::scope"]);
}

#[test]
fn an_image_of_another_graph_is_refused() {
    let (_, _, foreign, _) = begun(Feedback::Accumulated);
    let (mut g, guides, ..) = begun(Feedback::Accumulated);
    g.modulate(&guides, &foreign, Modulate::default());
    assert_names(&refusal(g), &["node `modulate`", "port `filtered_0`", "another graph"]);
}

#[test]
fn content_that_was_overwritten_is_refused() {
    let (mut g, guides, irradiance, history) = begun(Feedback::Accumulated);
    g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    g.modulate(&guides, &irradiance, Modulate::default());
    assert_names(&refusal(g), &["node `modulate`", "port `filtered_0`", "overwritten by `temporal_accumulation`", "returned"]);
}

#[test]
fn a_history_that_nothing_writes_is_refused() {
    let (mut g, guides, accumulated, _) = accumulated(Feedback::Filtered);
    let denoised = g.modulate(&guides, &accumulated.into(), Modulate::default());
    g.output("denoised_radiance", &denoised);
    assert_names(&refusal(g), &["node `temporal_accumulation`", "port `irradiance_history`", "feedback"]);
    let (mut g, guides, accumulated, _) = self::accumulated(Feedback::Accumulated);
    let denoised = g.modulate(&guides, &accumulated.into(), Modulate::default());
    g.output("denoised_radiance", &denoised);
    assert_names(&refusal(g), &["node `temporal_accumulation`", "port `irradiance_history`", "`variance`"]);
    let (mut g, guides, ..) = begun(Feedback::Accumulated);
    let noisy = g.radiance("noisy_radiance");
    g.gradient(&guides, &noisy, Gradients::Reshaded { stratum_size: 3 });
    assert_names(&refusal(g), &["node `gradient`", "port `noisy_luminance`", "`Demodulate::gradient`"]);
}

#[test]
fn a_history_of_other_signals_is_refused() {
    let (mut g, guides, accumulated, history) = accumulated(Feedback::Accumulated);
    let direct = g.radiance("noisy_direct");
    let indirect = g.radiance("noisy_indirect");
    let pair = g.pair(&direct, &indirect);
    let both = g.scope("both", |g| g.demodulate(&guides, &pair, Demodulate::default()));
    g.scope("both", |g| g.eaw(&guides, &both, Eaw { feedback: Some(history), ..Eaw::default() }));
    let _ = accumulated;
    assert_names(&refusal(g), &["node `eaw_both`", "port `feedback`", "2 signals"]);
}

#[test]
fn detail_is_of_a_history_of_the_same_light() {
    let refused = |feedback, twice: bool| {
        let (mut g, guides, accumulated, history) = accumulated(feedback);
        let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
        let filtered: Irradiance = match feedback {
            Feedback::Filtered => g.atrous(&guides, &estimate, Atrous { feedback: Some(history), ..Atrous::default() }).into(),
            Feedback::Accumulated => estimate.into(),
        };
        let filtered = if twice { g.pair(&filtered, &filtered) } else { filtered };
        g.modulate(&guides, &filtered, Modulate { detail: Some(history), ..Modulate::default() });
        refusal(g)
    };
    assert_names(&refused(Feedback::Filtered, false), &["node `modulate`", "port `detail`", "filtered light"]);
    assert_names(&refused(Feedback::Accumulated, true), &["node `modulate`", "port `detail`", "signals"]);
}

#[test]
fn detail_of_fewer_pixels_is_refused() {
    let mut g = Graph::of(Setup { light_extent: Some([32, 18]), ..Setup::new([64, 36]) });
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate::default());
    let history = g.history(&irradiance, Feedback::Accumulated);
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    g.modulate(&guides, &estimate.into(), Modulate { detail: Some(history), ..Modulate::default() });
    assert_names(&refusal(g), &["node `modulate`", "port `detail`", "the pixels of the light"]);
}

#[test]
fn the_albedo_of_each_of_two_signals_takes_two() {
    let mut g = Graph::new([16, 16]);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    g.demodulate(&guides, &noisy, Demodulate { albedo: Albedo::Each, ..Demodulate::default() });
    assert_names(&refusal(g), &["node `demodulate`", "port `albedo`", "one was given", "pair it with specular light"]);
}

#[test]
fn a_read_of_what_nothing_writes_is_refused() {
    let (mut g, guides, ..) = begun(Feedback::Accumulated);
    let nothing = g.transient("nothing", ash::vk::Format::R16G16B16A16_SFLOAT, 1);
    g.modulate(&guides, &Irradiance::of(nothing), Modulate::default());
    assert_names(&refusal(g), &["node `modulate`", "port `nothing`", "nothing writes it"]);
}

#[test]
fn two_writers_of_one_image_are_refused() {
    let mut g = Graph::new([16, 16]);
    let guides = g.import(Import::default());
    let image = g.transient("shared", ash::vk::Format::R16G16B16A16_SFLOAT, 1);
    let noisy = g.radiance("noisy_radiance");
    for node in ["first", "second"] {
        let pass = Pass::new(node, &crate::shaders::DEMODULATE_LUMINANCE_0)
            .bind("guide", guides.guide)
            .bind("noisy_0", noisy.image())
            .bind("irradiance_0", image);
        g.add(pass);
    }
    assert_names(&refusal(g), &["node `second`", "port `shared`", "`first` writes it, too", "image of its own"]);
}

/// A pass that reads one image and writes another, whatever was written before.
fn copy(g: &mut Graph, node: &str, guides: &Guides, from: Image, to: Image) {
    let pass = Pass::new(node, &crate::shaders::DEMODULATE_LUMINANCE_0)
        .bind("guide", guides.guide)
        .bind("noisy_0", from)
        .bind("irradiance_0", to);
    g.add(pass);
}

#[test]
fn a_cycle_is_refused_and_a_wrong_order_named() {
    let begun = || {
        let mut g = Graph::new([16, 16]);
        let guides = g.import(Import::default());
        let [a, b] = ["a", "b"].map(|name| g.transient(name, ash::vk::Format::R16G16B16A16_SFLOAT, 1));
        (g, guides, a, b)
    };
    let (mut g, guides, a, b) = begun();
    copy(&mut g, "there", &guides, a, b);
    let b = g.refreshed(b);
    copy(&mut g, "back", &guides, b, a);
    assert_names(&refusal(g), &["node `there`", "port `a`", "a cycle", "`back`", "previous frame"]);

    let (mut g, guides, a, b) = begun();
    let noisy = g.radiance("noisy_radiance");
    copy(&mut g, "reader", &guides, a, b);
    copy(&mut g, "writer", &guides, noisy.image(), a);
    assert_names(&refusal(g), &["node `reader`", "port `a`", "`writer` writes it later", "add that node first"]);
}

#[test]
fn a_format_that_does_not_fit_is_refused() {
    let (mut g, guides, ..) = begun(Feedback::Accumulated);
    let packed = Irradiance::of(guides.guide);
    g.modulate(&guides, &packed, Modulate::default());
    assert_names(&refusal(g), &["node `modulate`", "port `filtered_0`", "cannot be `guide`", "class Float"]);
}

#[test]
fn numbers_out_of_range_are_refused() {
    let (mut g, guides, irradiance, _) = begun(Feedback::Accumulated);
    g.eaw(&guides, &irradiance, Eaw { levels: 0, ..Eaw::default() });
    assert_names(&refusal(g), &["node `eaw`", "port `levels`", "0 levels", "1 to 10"]);
    let (mut g, guides, ..) = begun(Feedback::Accumulated);
    g.forward_project(&guides, ForwardProject { stratum_size: 9, ..ForwardProject::default() });
    assert_names(&refusal(g), &["node `forward_project`", "port `stratum_size`", "9 pixels", "2 to 4"]);
    assert!(matches!(Graph::new([0, 4]).finish(), Err(Error::Extent { .. })));
    assert!(matches!(
        Graph::of(Setup { frames_in_flight: 9, ..Setup::new([4, 4]) }).finish(),
        Err(Error::Config { name: "frames_in_flight", .. })
    ));
}

#[test]
fn a_graph_has_the_extents_of_a_setup() {
    let setup = Setup { image_extent: Some([40, 30]), output_extent: None, ..Setup::new([16, 8]) };
    let mut g = Graph::of(setup);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate::default());
    let radiance = g.modulate(&guides, &irradiance, Modulate::default());
    g.output("denoised_radiance", &radiance);
    let declaration = g.finish().expect("valid");
    assert_eq!(declaration.setup(), &setup);
    for (name, extent) in [("depth", [40, 30]), ("denoised_radiance", [40, 30]), ("guide", [16, 8])] {
        let id = declaration.find(name).expect(name);
        assert_eq!(declaration.resource(id).extent(&setup), Some(extent), "{name}");
    }
}

#[test]
fn three_signals_in_one_pass_are_refused() {
    let mut g = Graph::new([16, 16]);
    let [a, b, c] = ["noisy_a", "noisy_b", "noisy_c"].map(|name| g.radiance(name));
    let pair = g.pair(&a, &b);
    g.pair(&pair, &c);
    assert_names(&refusal(g), &["node `pair`", "3 signals", "at most two"]);
}

#[test]
fn an_output_is_what_a_node_writes_for_this_frame() {
    let (mut g, _, _, history) = accumulated(Feedback::Accumulated);
    let colour = g.refreshed(history.colour()[0]);
    g.output("mine", &Irradiance::of(colour));
    assert_names(&refusal(g), &["port `mine`", "`irradiance_history` is HistoryInPlace"]);
    let (mut g, _, irradiance, _) = begun(Feedback::Filtered);
    g.output("guide", &irradiance);
    assert_names(&refusal(g), &["port `guide`", "this name already"]);
}

#[test]
fn passes_stand_in_the_order_of_phases() {
    let mut g = Graph::new([16, 16]);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate::default());
    let radiance = g.modulate(&guides, &irradiance, Modulate::default());
    let display = g.tone_map(&radiance);
    g.output("display", &display);
    let samples = g.forward_project(&guides, ForwardProject::default());
    g.output_samples("gradient_samples", &samples);
    let declaration = g.finish().expect("valid");
    let phases: Vec<_> = declaration.passes().iter().map(|p| p.phase).collect();
    assert!(phases.is_sorted());
    assert_eq!(phases.iter().filter(|p| **p == Phase::BeforeLighting).count(), 5);
    let candidates = declaration.find("gradient_candidates").expect("declared");
    let previous =
        declaration.passes().iter().flat_map(|p| &p.uses).any(|u| u.resource == candidates && u.frame == UseFrame::Previous);
    assert!(previous);
}

#[test]
fn a_transient_lies_in_an_output_that_is_written_later() {
    let config = Config { preset: crate::config::Preset::Svgf, post_process: PostProcess::ToneMap, ..Config::new([64, 36]) };
    let declared = |share| config.graph().expect("valid").share_outputs(share).finish().expect("valid");
    let (shared, apart) = (declared(true), declared(false));
    let life = |declaration: &Declaration, name: &str| {
        let (first, last) = declaration.life(declaration.find(name).expect(name)).expect("used");
        [first, last].map(|pass| declaration.passes()[pass].name.clone())
    };
    assert_eq!(life(&apart, "denoised_radiance"), ["modulate", "tone_map"]);
    assert_eq!(life(&shared, "denoised_radiance"), ["demodulate", "tone_map"]);
    // Another phase, before which the host may still show the picture of the previous frame.
    assert_eq!(life(&shared, "display"), life(&apart, "display"));
    assert!(shared.find("irradiance").is_none() && apart.find("irradiance").is_some());
    let output = |declaration: &Declaration| {
        declaration.resources()[declaration.find("denoised_radiance").expect("known").0 as usize].clone()
    };
    assert!(output(&shared).image_usage.contains(output(&apart).image_usage));
    assert_eq!(output(&shared).lifetime, Lifetime::Output);
    let bytes = |declaration: &Declaration| declaration.memory().transient;
    assert_eq!(bytes(&apart) - bytes(&shared), 64 * 36 * 8);
    for declaration in [&shared, &apart] {
        let uses = declaration.passes().iter().flat_map(|pass| &pass.uses);
        assert!(uses.map(|u| u.resource.0 as usize).collect::<BTreeSet<_>>().into_iter().eq(0..declaration.resources().len()));
    }
}
