//! Sequences of the preset that scales its history by the light.

use super::asvgf::{reshaded_sequence, sequence, sparse_and_confidence_sequence};
use atrous::config::{Preset, Signals};
use atrous::Config;

fn config(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Best, levels: Some(2), ..Config::new(extent) }
}

pub fn forward_projected() {
    for signals in Signals::ALL {
        sequence(&Config { signals, ..config([61, 35]) }, [61, 35], |_, _, _| {});
    }
    sequence(&Config { surface_id: false, object_normal: true, stratum_size: 4, ..config([40, 23]) }, [37, 21], |_, _, _| {});
    sequence(&config([1, 1]), [1, 1], |_, _, _| {});
}

pub fn reshaded() {
    for (signals, stratum_size) in [(Signals::Together, 3), (Signals::Apart, 2)] {
        reshaded_sequence(&Config { signals, stratum_size, ..config([61, 35]) });
    }
}

pub fn sparse_and_confidence() {
    sparse_and_confidence_sequence(&config([40, 23]));
}
