//! Sequences of the preset that scales its history by the light.

use super::asvgf::{compared_sequence, graph_sequence, reshaded_sequence, sequence, sparse_and_confidence_sequence};
use crate::sampling::is_sampled;
use crate::support::{pixels, scene::Scene};
use atrous::config::{GradientSource, Preset, Sampling, Signals};
use atrous::executor::Session;
use atrous::graph::{Feedback, Graph};
use atrous::presets::{best_with, Best};
use atrous::Config;

fn config(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Best, levels: Some(2), ..Config::new(extent) }
}

pub fn forward_projected() {
    for signals in Signals::ALL {
        sequence(&Config { signals, ..config([67, 35]) }, [67, 35], |_, _, _| {});
    }
    sequence(&Config { surface_id: false, object_normal: true, stratum_size: 4, ..config([40, 23]) }, [37, 21], |_, _, _| {});
    sequence(&config([1, 1]), [1, 1], |_, _, _| {});
}

pub fn reshaded() {
    for (signals, stratum_size) in [(Signals::Together, 3), (Signals::Apart, 2), (Signals::Mixed, 3)] {
        reshaded_sequence(&Config { signals, stratum_size, ..config([67, 35]) });
    }
}

pub fn compared() {
    compared_sequence(&config([67, 35]));
}

pub fn sparse_and_confidence() {
    sparse_and_confidence_sequence(&config([40, 23]));
}

/// What no preset has: the ratio of light without the change test, and the change test without the ratio, over a history that is filtered.
pub fn without_parts() {
    for (signals, light_ratio) in [(Signals::Specular, true), (Signals::Together, true), (Signals::Specular, false)] {
        let config = Config { signals, ..config([67, 35]) };
        let whole = Best::new(&config);
        let parts = match light_ratio {
            true => Best { change_test: false, ..whole },
            false => Best { light_ratio, feedback: Feedback::Filtered, firefly_filter: false, sharp: false, ..whole },
        };
        let graph = config.graph_with(|g, guides, config| best_with(g, guides, config, parts));
        let graph = graph.and_then(Graph::finish).expect("valid");
        graph_sequence(graph, &config, [67, 35], |_, _, _| {});
    }
    for change_test in [true, false] {
        let config = Config { signals: Signals::Specular, gradient_source: GradientSource::ChangeTest, ..config([67, 35]) };
        let parts = Best { change_test, firefly_filter: false, ..Best::new(&config) };
        let graph = config.graph_with(|g, guides, config| best_with(g, guides, config, parts));
        graph_sequence(graph.and_then(Graph::finish).expect("valid"), &config, [67, 35], |_, _, _| {});
    }
}

/// Samples of gradients lie in holes, in both frames, or in one.
pub fn with_holes() {
    for (signals, preset) in [(Signals::Together, Preset::Best), (Signals::Specular, Preset::Asvgf)] {
        let config = Config { signals, preset, sampling: Sampling::OneOf2x2, ..config([67, 35]) };
        let name = if signals == Signals::Together { "noisy_radiance" } else { "noisy_specular" };
        let inputs = |s: &mut Session, i: u32, scene: &Scene| {
            let guides = scene.frame(i, i);
            let mut texels = if signals == Signals::Together { guides.noisy_radiance } else { guides.noisy_specular };
            for (x, y) in pixels([67, 35]).filter(|(x, y)| !is_sampled(2, i / 2, *x, *y)) {
                texels[(y * 61 + x) as usize] = [f32::NAN; 4];
            }
            s.upload(name, &texels).expect(name);
        };
        sequence(&config, [67, 35], inputs);
        sequence(&Config { gradient_source: GradientSource::Reshaded, ..config }, [67, 35], |s, i, scene| {
            inputs(s, i, scene);
            s.upload("reshaded_radiance", &scene.frame(i.saturating_sub(1), i.saturating_sub(1)).noisy_radiance).expect("reshaded");
        });
    }
}
