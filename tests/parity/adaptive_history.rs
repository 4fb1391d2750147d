//! `adaptive_history`, both rules.

use super::compare::{texels, Tolerance, HALF};
use super::{each, Captured};
use atrous::config::AdaptiveRule;
use atrous::reference::{change_test, percentile_rule, HistoryGuides, PercentileRuleInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let twin = match c.config.adaptive_rule {
        AdaptiveRule::Percentiles => published(c),
        AdaptiveRule::ChangeTest => {
            let differences: Vec<_> = c.suffixes().iter().map(|s| c.block_packed(&format!("block_difference{s}"))).collect();
            change_test(&c.frame.constants, c.tuning, c.config.allocated_extent, &each(&differences))
        }
        other => panic!("{other} has no twin"),
    };
    // Slopes are steep: a step of a half float in a percentile or a deviation moves the result by more than one.
    let tolerance = Tolerance { absolute: 5e-3, outliers: 2e-3, ..HALF };
    texels("history_confidence", c, &c.written_floats("history_confidence"), &twin, tolerance, |v| [v]);
}

fn published(c: &Captured) -> atrous::reference::Image<f32> {
    let percentiles: Vec<_> = c.suffixes().iter().map(|s| c.block_uints(&format!("block_percentiles{s}"))).collect();
    let history = c.signals("irradiance_history", UseFrame::Previous);
    let signals: Vec<_> = percentiles.iter().zip(&history).collect();
    let guides = HistoryGuides {
        guide: &c.packed("guide", UseFrame::Current),
        surface_motion: &c.packed("surface_motion", UseFrame::Current),
        depth_gradient: &c.uints("depth_gradient", UseFrame::Current),
        previous_guide: &c.packed("guide", UseFrame::Previous),
    };
    percentile_rule(&c.frame.constants, c.tuning, &PercentileRuleInputs { guides, signals: &signals })
}
