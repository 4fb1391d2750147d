//! What the papers claim, and what we do, against the figures.

use crate::measure::Scores;
use atrous_lab::pictures::{Column, PictureError, TextTable};
use serde::{Deserialize, Serialize};

use super::contenders::{ASVGF, BEST, EAW_ACCUMULATED, NOISY, SVGF};
use super::results::{Row, SceneResult};

/// Scenes with lamps that step or move, or shadows that wander.
const CHANGING: [&str; 3] = ["cornell", "pillars", "lamps"];
/// Those of them where the light of a lamp changes: until a filter has followed, the picture is that of another lamp.
const STEPPING: [&str; 2] = ["cornell", "lamps"];

/// A claim on one scene: a ratio that must not be above a bound.
#[derive(Clone, Serialize, Deserialize)]
pub struct Claim {
    /// The claim, with its source.
    pub text: String,
    /// Scene.
    pub scene: String,
    /// What was measured.
    pub ratio: f64,
    /// The largest ratio that it holds with.
    pub bound: f64,
    /// The largest ratio that `--quick` accepts, with room above what was measured there: for claims that do not hold everywhere.
    pub accepted: f64,
}

impl Claim {
    /// Whether it holds.
    pub fn holds(&self) -> bool {
        self.ratio <= self.bound
    }
}

/// All claims about a scene whose filters were measured.
pub fn of_scene(result: &SceneResult) -> Vec<Claim> {
    let mean = |name: &str, of: fn(&Scores) -> f64| result.row(name).map_or(f64::NAN, |row| of(&row.mean()));
    let (rmse, ssim) = (|name: &str| mean(name, |s| s.rmse), |name: &str| mean(name, |s| s.ssim));
    let claim = |text: &str, ratio: f64, [bound, accepted]: [f64; 2]| {
        let (text, scene) = (text.to_owned(), result.scene.clone());
        Claim { text, scene, ratio, bound, accepted }
    };
    let is_one_of = |scenes: &[&str]| scenes.contains(&result.scene.as_str());
    let mut claims = vec![match is_one_of(&CHANGING) {
        true => claim("RMSE of A-SVGF to that of SVGF where light changes [ASVGF 5]", rmse(ASVGF) / rmse(SVGF), [1.0; 2]),
        false => claim("SSIM of SVGF to that of A-SVGF where it does not [ASVGF 5]", ssim(SVGF) / ssim(ASVGF), [1.02; 2]),
    }];
    if !is_one_of(&STEPPING) {
        let eaw = ssim(EAW_ACCUMULATED) / ssim(SVGF);
        claims.push(claim("SSIM of EAW on accumulated light to that of SVGF [SVGF 5]", eaw, [1.0, 1.01]));
        let filtered = result.rows.iter().filter(|row| row.name != NOISY);
        let energy =
            |row: &Row| claim(&format!("distance of the energy of {} from 1", row.name), (row.energy - 1.0).abs(), [0.02, 0.06]);
        claims.extend(filtered.map(energy));
    }
    if let Some([by_rmse, by_ssim]) = lead(result) {
        claims.push(claim("RMSE of best to the lowest of the others", by_rmse, [1.02, 1.1]));
        claims.push(claim("the highest SSIM of the others to that of best", by_ssim, [1.02, 1.1]));
    }
    claims.retain(|claim| claim.ratio.is_finite());
    claims
}

/// What `best` is to the best of the other filters: by RMSE and by SSIM. Itself on other signals is none of them.
fn lead(result: &SceneResult) -> Option<[f64; 2]> {
    let best = result.row(BEST)?.mean();
    let is_other = |row: &&Row| row.name != NOISY && !row.name.starts_with(BEST);
    let others: Vec<_> = result.rows.iter().filter(is_other).map(Row::mean).collect();
    let least = others.iter().map(|s| s.rmse).reduce(f64::min)?;
    let most = others.iter().map(|s| s.ssim).reduce(f64::max)?;
    Some([best.rmse / least, most / best.ssim])
}

/// A row for each claim: over the scenes, where it is closest to failing, and how many scenes it fails on.
///
/// # Errors
/// None in practice.
pub fn table(claims: &[Claim]) -> Result<TextTable, PictureError> {
    let columns = [("bound", 2), ("worst ratio", 3), ("scenes", 0), ("fails on", 0)];
    let mut table = TextTable::new("claim", columns.map(|(name, decimals)| Column::new(name, decimals)));
    let mut texts: Vec<&str> = Vec::new();
    for claim in claims {
        if !texts.contains(&claim.text.as_str()) {
            texts.push(&claim.text);
        }
    }
    for text in texts {
        let all: Vec<_> = claims.iter().filter(|c| c.text == text).collect();
        let worst = all.iter().map(|c| c.ratio).fold(f64::NEG_INFINITY, f64::max);
        let failed = all.iter().filter(|c| !c.holds()).count();
        table.row(text, &[all[0].bound, worst, all.len() as f64, failed as f64])?;
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::contenders::BEST_AND_SUN;
    use crate::evaluate::settings::Settings;

    fn result(scene: &str, rows: &[(&str, f64, f64, f64)]) -> SceneResult {
        let row = |&(name, rmse, ssim, energy): &(&str, f64, f64, f64)| Row {
            name: name.into(),
            frames: vec![Scores { rmse, ssim, ..Scores::default() }],
            energy,
            stages: Vec::new(),
            memory: None,
        };
        SceneResult { settings: Settings::default(), scene: scene.into(), content: 0, rows: rows.iter().map(row).collect() }
    }

    fn failing(result: &SceneResult) -> Vec<String> {
        of_scene(result).into_iter().filter(|claim| !claim.holds()).map(|claim| claim.text).collect()
    }

    #[test]
    fn claims_fail_where_the_figures_say_so() {
        let good = [
            (NOISY, 1.0, 0.2, 1.0),
            (EAW_ACCUMULATED, 0.4, 0.8, 1.0),
            (SVGF, 0.3, 0.9, 0.99),
            (ASVGF, 0.29, 0.9, 1.01),
            (BEST, 0.2, 0.95, 1.0),
            (BEST_AND_SUN, 0.1, 0.99, 1.0),
        ];
        for scene in ["pillars", "hall", "cornell"] {
            assert_eq!(failing(&result(scene, &good)), [""; 0], "{scene}");
        }
        let bad = [
            (NOISY, 1.0, 0.2, 1.0),
            (EAW_ACCUMULATED, 0.4, 0.95, 1.0),
            (SVGF, 0.3, 0.9, 0.99),
            (ASVGF, 0.31, 0.85, 1.0),
            (BEST, 0.4, 0.9, 0.97),
        ];
        let claims = failing(&result("hall", &bad));
        for part in ["SSIM of SVGF to that of A-SVGF", "SSIM of EAW on", "energy of best", "RMSE of best", "SSIM of the others"] {
            assert!(claims.iter().any(|text| text.contains(part)), "{part}: {claims:?}");
        }
        assert_eq!(claims.len(), 5);
        // While a lamp steps energy is not compared, and A-SVGF has to be better than SVGF.
        let claims = failing(&result("cornell", &bad));
        assert!(
            claims.iter().any(|text| text.contains("RMSE of A-SVGF")) && !claims.iter().any(|text| text.contains("energy")),
            "{claims:?}"
        );
    }

    #[test]
    fn what_was_not_measured_is_not_claimed() {
        assert!(of_scene(&result("cornell", &[(NOISY, 1.0, 0.2, 1.0), (BEST, 0.1, 0.9, 1.0)])).is_empty());
        let table =
            table(&of_scene(&result("hall", &[(NOISY, 1.0, 0.2, 1.0), (BEST, 0.1, 0.9, 0.9)]))).expect("a table").to_string();
        assert!(table.contains("energy of best") && table.contains("0.100"), "{table}");
    }
}
