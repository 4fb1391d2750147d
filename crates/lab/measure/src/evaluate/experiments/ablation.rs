//! The filter of choice without each of its parts, on every scene.

use std::path::Path;

use crate::measure::Scores;
use crate::Result;
use atrous::config::{Preset, Signals};
use atrous::graph::Feedback;
use atrous::nodes::{Estimator, Kernel, LuminanceWeight};
use atrous::presets::{best_with, Best};
use atrous::{Config, Declaration};
use atrous_engine::denoiser::GraphOfConfig;
use atrous_engine::scene::BUILT_IN;

use super::{on_scene, Figures, Findings};
use crate::evaluate::claims::Claim;
use crate::evaluate::contenders::{Contender, BEST};
use crate::evaluate::results::{mean_of, Row};
use crate::evaluate::scene::Lab;
use crate::evaluate::settings::Settings;

/// Frames of the animation, and those of them that are measured: fourteen filters on all scenes take long.
const FRAMES: u32 = 18;
const MEASURED: u32 = 4;
/// Most that a part may cost on any scene: RMSE with it to that without.
const BOUND: f64 = 1.02;

/// What is left out or replaced in the graph.
const PARTS: [(&str, GraphOfConfig); 8] = [
    ("no ratio of light", |config| with(config, |best| best.light_ratio = false)),
    ("no change test", |config| with(config, |best| best.change_test = false)),
    ("no firefly filter", |config| with(config, |best| best.firefly_filter = false)),
    ("history filtered", |config| with(config, |best| best.feedback = Feedback::Filtered)),
    ("history looked up by 2x2 pixels", |config| with(config, |best| best.sharp = false)),
    ("deviation of a sample", |config| with(config, |best| best.variance.estimator = Estimator::Fading)),
    ("published luminance weight", |config| with(config, |best| best.spatial.luminance_weight = LuminanceWeight::Published)),
    ("25 taps instead of 9", |config| with(config, |best| best.spatial.kernel = Kernel::Spline)),
];
/// Numbers that are those of A-SVGF.
const NUMBERS: [(&str, &[(&str, f32)]); 2] =
    [("sigma_n 128", &[("sigma_n", 128.0)]), ("tolerances 0.02, 0.9", &[("depth_tolerance", 0.02), ("normal_tolerance", 0.9)])];

fn with(config: &Config, change: fn(&mut Best)) -> std::result::Result<Declaration, atrous::Error> {
    let mut best = Best::new(config);
    change(&mut best);
    config.graph_with(|g, guides, config| best_with(g, guides, config, best))?.finish()
}

fn contenders() -> Result<Vec<Contender>> {
    let best = |name| Contender::new(name, Preset::Best);
    let mut all = vec![best(BEST)];
    let part = |(name, graph)| {
        let mut contender = best(name);
        contender.options.graph = Some(graph);
        contender
    };
    all.extend(PARTS.map(part));
    let (mut levels, mut signals) = (best("4 levels instead of 5"), best("reflections not apart"));
    levels.options.config.levels = Some(4);
    signals.options.config.signals = Signals::Together;
    all.extend([levels, signals]);
    for (name, numbers) in NUMBERS {
        all.push(numbers.iter().try_fold(best(name), |contender, (number, value)| contender.with(number, *value))?);
    }
    Ok(all)
}

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let [width, height] = lab.settings.size;
    let (size, frames) = ([width.div_ceil(2), height.div_ceil(2)], lab.settings.frames.min(FRAMES));
    let settings = Settings { size, frames, measured: lab.settings.measured.min(MEASURED), ..lab.settings.clone() };
    let lab = Lab { settings: &settings, ..*lab };
    let contenders = contenders()?;
    let scenes = BUILT_IN.map(|name| on_scene(&lab, name, &contenders, folder));
    let scenes = scenes.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(report(&scenes, &settings))
}

/// A row for each filter, from the rows of each scene: the noisy picture, `best`, the others.
fn report(scenes: &[Vec<Row>], settings: &Settings) -> Findings {
    let columns = [
        ("RMSE", 3),
        ("least", 3),
        ("most", 3),
        ("relMSE", 3),
        ("FLIP", 3),
        ("temporal RMSE", 3),
        ("SSIM, difference", 4),
        ("ms", 2),
        ("bytes a pixel", 1),
    ];
    let mut means = Figures::new("to best, mean of the scenes", columns);
    let mut of_scenes = Figures::new("RMSE to best's", BUILT_IN.map(|scene| (scene, 3)));
    let mut claims = Vec::new();
    for index in 1..scenes[0].len() {
        let name = &scenes[0][index].name;
        let pairs: Vec<_> = scenes.iter().map(|rows| (&rows[1], &rows[index])).collect();
        let ratios =
            |of: fn(&Scores) -> f64| pairs.iter().map(|(best, row)| of(&row.mean()) / of(&best.mean())).collect::<Vec<_>>();
        let mean = |values: &[f64]| mean_of(values).unwrap_or(f64::NAN);
        let rmse = ratios(|scores| scores.rmse);
        let ssim: Vec<_> = pairs.iter().map(|(best, row)| row.mean().ssim - best.mean().ssim).collect();
        let times: Vec<_> = pairs.iter().filter_map(|(best, row)| Some(row.milliseconds()? / best.milliseconds()?)).collect();
        let memory: Vec<_> = pairs.iter().filter_map(|(_, row)| row.memory).map(|m| m.history + m.transient).collect();
        let (least, most) = (rmse.iter().copied().fold(f64::INFINITY, f64::min), rmse.iter().copied().fold(0.0, f64::max));
        let others = [ratios(|scores| scores.rel_mse), ratios(|scores| scores.flip), ratios(|scores| scores.temporal_error)];
        let mut figures = vec![mean(&rmse), least, most];
        figures.extend(others.iter().map(|ratios| mean(ratios)));
        figures.extend([mean(&ssim), mean(&times), mean(&memory)]);
        means.row(name, &figures);
        of_scenes.row(name, &rmse);
        if name != BEST {
            let text = format!("RMSE of best to that with: {name}");
            let claim = |(scene, ratio): (&str, &f64)| Claim {
                text: text.clone(),
                scene: scene.to_owned(),
                ratio: ratio.recip(),
                bound: BOUND,
                accepted: BOUND,
            };
            claims.extend(BUILT_IN.into_iter().zip(&rmse).map(claim));
        }
    }
    Findings {
        title: "What each part of best is worth".into(),
        text: format!(
            "`best` with one part left out or as A-SVGF has it; {}x{}, the last {} of {} frames. Ratios to `best` itself: above 1 the part is a \
             gain. SSIM: what is added. `least` and `most`: the scenes where the part is worth least and most.",
            settings.size[0], settings.size[1], settings.measured, settings.frames
        ),
        tables: vec![means, of_scenes],
        claims,
        ..Findings::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_makes_another_filter() {
        let contenders = contenders().expect("numbers in range");
        let declared = |contender: &Contender| {
            let options = &contender.options;
            let config = Config {
                preset: Preset::Best,
                signals: options.config.signals,
                levels: options.config.levels,
                ..Config::new([64, 36])
            };
            let graph = options.graph.map_or_else(|| config.declare(), |graph| graph(&config)).expect("a graph");
            format!("{:?} {:?} {:?}", graph.passes(), graph.resources(), options.tuning)
        };
        let all: Vec<_> = contenders.iter().map(declared).collect();
        for (index, contender) in contenders.iter().enumerate() {
            assert!(!all[..index].contains(&all[index]), "{} is one of those before it", contender.name);
        }
    }

    #[test]
    fn what_a_part_is_worth_is_a_ratio_to_best() {
        let row = |name: &str, rmse: f64, ssim: f64| Row {
            name: name.into(),
            frames: vec![Scores { rmse, ssim, flip: 2.0 * rmse, rel_mse: rmse, temporal_error: rmse, ..Scores::default() }],
            energy: 1.0,
            stages: Vec::new(),
            memory: None,
        };
        let scene = |other: f64| vec![row("noisy", 9.0, 0.1), row(BEST, 2.0, 0.9), row("other", other, 0.8)];
        let mut scenes: Vec<_> = BUILT_IN.iter().map(|_| scene(3.0)).collect();
        scenes[3] = scene(1.6);
        let found = report(&scenes, &Settings::default());
        let failed: Vec<_> = found.claims.iter().filter(|claim| !claim.holds()).map(|claim| claim.scene.as_str()).collect();
        assert_eq!(failed, [BUILT_IN[3]], "it is better without on one scene");
        let table = found.tables[0].table().expect("a table").to_string();
        let line = table.lines().find(|line| line.contains("| other ")).expect("a row");
        let figures: Vec<_> = line.split('|').map(str::trim).collect();
        assert_eq!(&figures[2..6], ["1.453", "0.800", "1.500", "1.453"], "{table}");
        assert_eq!(figures[8], "-0.1000", "{table}");
    }
}
