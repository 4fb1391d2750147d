//! Counterparts of figures of the papers that the scenes' own results hold.

use super::contenders::{ASVGF, BEST, EAW_ACCUMULATED, NOISY, ONE_SIGNAL, SVGF};
use super::experiments::{Figures, Findings, Lines};
use super::results::{mean_of, SceneResult};

/// Filters whose stages are shown.
const SHOWN: [&str; 4] = [SVGF, ASVGF, "percentile", BEST];
/// Scenes with a camera that flies.
const FLIGHTS: [&str; 3] = ["hall", "fog", "tiles"];

/// All of them.
pub fn of_scenes(results: &[SceneResult]) -> Vec<Findings> {
    let all = [quality(results), highlights(results), stages(results), flight(results), breakdown(results)];
    all.into_iter().filter(|found| found.tables.iter().any(Figures::has_values) || !found.curves.is_empty()).collect()
}

/// What the papers compare by SSIM and RMSE, as ratios.
fn quality(results: &[SceneResult]) -> Findings {
    let columns = [
        ("SSIM, EAW accumulated", 3),
        ("SVGF", 3),
        ("A-SVGF", 3),
        ("RMSE of A-SVGF to SVGF's", 3),
        ("MSE of EAW, % of the noisy picture's", 2),
    ];
    let mut table = Figures::new("scene", columns);
    for result in results {
        let mean = |name: &str| result.row(name).map(|row| row.mean());
        let ssim = |name: &str| mean(name).map_or(f64::NAN, |scores| scores.ssim);
        let rmse = |name: &str| mean(name).map_or(f64::NAN, |scores| scores.rmse);
        let squared = 100.0 * (rmse("EAW") / rmse(NOISY)).powi(2);
        table.row(&result.scene, &[ssim(EAW_ACCUMULATED), ssim(SVGF), ssim(ASVGF), rmse(ASVGF) / rmse(SVGF), squared]);
    }
    let curves = results.iter().map(|result| {
        let series = SHOWN
            .iter()
            .filter_map(|name| result.row(name))
            .map(|row| (row.name.clone(), row.frames.iter().map(|frame| frame.ssim).collect()));
        Lines {
            title: format!("SSIM, {}", result.scene),
            first_frame: result.settings.measured_frames().start,
            series: series.collect(),
        }
    });
    Findings {
        title: "SVGF against EAW, A-SVGF against SVGF: [SVGF] Table 1, [ASVGF] Fig. 3 and 4, [EAW] Fig. 12".into(),
        text: "Means of the measured frames; on the page also SSIM frame by frame, which is [ASVGF] Fig. 4.".into(),
        tables: vec![table],
        curves: curves.filter(|lines| !lines.series.is_empty()).collect(),
        claims: Vec::new(),
    }
}

/// Glossy surfaces under a camera that moves.
fn highlights(results: &[SceneResult]) -> Findings {
    let columns = [("RMSE", 4), ("SSIM", 3), ("FLIP", 3), ("RMSE to SVGF's", 3)];
    let mut table = Figures::new("glossy", columns);
    if let Some(result) = results.iter().find(|result| result.scene == "glossy") {
        let svgf = result.row(SVGF).map_or(f64::NAN, |row| row.mean().rmse);
        for row in [NOISY, SVGF, ASVGF, ONE_SIGNAL, BEST].iter().filter_map(|name| result.row(name)) {
            let mean = row.mean();
            table.row(&row.name, &[mean.rmse, mean.ssim, mean.flip, mean.rmse / svgf]);
        }
    }
    Findings {
        title: "Highlights and reflections under a moving camera: [ASVGF] Fig. 1, `glossy`".into(),
        text: "The paper has 0.39 of SVGF's RMSE on its GlossySponza. The pictures are among the details of the last frame.".into(),
        tables: vec![table],
        ..Findings::default()
    }
}

/// Names of the stages of some filters, in the order in which they run.
fn stage_names<'a>(results: &'a [SceneResult], filters: &[&str]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for result in results {
        for (stage, _) in filters.iter().filter_map(|filter| result.row(filter)).flat_map(|row| &row.stages) {
            if !names.contains(&stage.as_str()) {
                names.push(stage);
            }
        }
    }
    names
}

fn stages(results: &[SceneResult]) -> Findings {
    let filters: Vec<_> = SHOWN.into_iter().filter(|name| results.iter().any(|result| result.row(name).is_some())).collect();
    let mut table = Figures::new("stage, ms a frame", filters.iter().map(|name| (*name, 1)));
    for stage in stage_names(results, &filters) {
        let of = |filter: &&str| {
            let rows = results.iter().filter_map(|result| result.row(filter));
            mean_of(&rows.map(|row| row.stage(stage)).collect::<Vec<_>>()).unwrap_or(f64::NAN)
        };
        table.row(stage, &filters.iter().map(of).collect::<Vec<_>>());
    }
    Findings {
        title: "Cost by stage: [ASVGF] 5.3, [PSVGF] split of time".into(),
        text: "All levels and steps of a stage together, means over the scenes. The table of cost has the split of memory.".into(),
        tables: vec![table],
        ..Findings::default()
    }
}

fn flight(results: &[SceneResult]) -> Findings {
    let mut table = Figures::new("ms a frame", [("least", 1), ("median", 1), ("most", 1)]);
    let mut curves = Vec::new();
    for result in results.iter().filter(|result| FLIGHTS.contains(&result.scene.as_str())) {
        let mut series = Vec::new();
        for row in SHOWN.iter().filter_map(|name| result.row(name)) {
            let times = row.frame_times();
            let mut sorted = times.clone();
            sorted.sort_by(f64::total_cmp);
            if let (Some(least), Some(most)) = (sorted.first(), sorted.last()) {
                table.row(&format!("{}, {}", result.scene, row.name), &[*least, sorted[sorted.len() / 2], *most]);
                series.push((row.name.clone(), times));
            }
        }
        curves.push(Lines { title: format!("ms a frame, {}", result.scene), first_frame: 0, series });
    }
    Findings {
        title: "Cost over a flight: [SVGF] Fig. 8".into(),
        text: "Scenes whose camera moves, frame by frame. Other work on the machine shows as spikes.".into(),
        tables: vec![table],
        curves: curves.into_iter().filter(|lines: &Lines| !lines.series.is_empty()).collect(),
        claims: Vec::new(),
    }
}

/// Lines of the stages of A-SVGF over frames.
fn breakdown(results: &[SceneResult]) -> Findings {
    let flights = results.iter().filter(|result| FLIGHTS.contains(&result.scene.as_str()));
    let lines = flights.filter_map(|result| {
        let row = result.row(ASVGF).filter(|row| !row.stages.is_empty())?;
        Some(Lines { title: format!("ms of each stage, {}", result.scene), first_frame: 0, series: row.stages.clone() })
    });
    Findings {
        title: "A-SVGF stage by stage over time: [ASVGF] Fig. 7".into(),
        text: "On the page, as curves; their means are the column of A-SVGF in the table of stages.".into(),
        curves: lines.collect(),
        ..Findings::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::results::Row;
    use crate::measure::Scores;

    #[test]
    fn figures_are_made_of_what_was_measured() {
        let row = |name: &str, rmse: f64, stages: &[(&str, [f64; 3])]| Row {
            name: name.into(),
            frames: vec![Scores { rmse, ssim: 1.0 - rmse, ..Scores::default() }],
            energy: 1.0,
            stages: stages.iter().map(|(name, times)| ((*name).to_owned(), times.to_vec())).collect(),
            memory: None,
        };
        let rows = vec![
            row("noisy", 1.0, &[]),
            row("EAW", 0.1, &[("eaw", [1.0; 3])]),
            row(SVGF, 0.5, &[("atrous", [1.0, 2.0, 6.0]), ("variance", [1.0; 3])]),
            row(ASVGF, 0.25, &[("gradient", [2.0; 3]), ("atrous", [1.0; 3])]),
        ];
        let result = SceneResult { settings: Default::default(), scene: "hall".into(), content: 0, rows };
        let [quality, stages, flight, breakdown] = &of_scenes(&[result])[..] else { panic!("four of them") };
        let shown = |found: &Findings| found.markdown().expect("a table").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown(quality).contains("| hall | - | 0.500 | 0.750 | 0.500 | 1.00 |"), "{}", shown(quality));
        assert!(
            shown(stages).contains("| atrous | 3.0 | 1.0 | | variance | 1.0 | 0.0 | | gradient | 0.0 | 2.0 |"),
            "{}",
            shown(stages)
        );
        assert!(shown(flight).contains("| hall, SVGF | 2.0 | 3.0 | 7.0 |"), "{}", shown(flight));
        assert_eq!(breakdown.curves[0].series.len(), 2);
        assert!(of_scenes(&[]).is_empty());
    }
}
