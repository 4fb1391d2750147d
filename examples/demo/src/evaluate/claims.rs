//! What the papers claim, and what we do, against the figures.

use atrous_picture::{Column, PictureError, TextTable};

use super::contenders::{ASVGF, BEST, EAW_ACCUMULATED, NOISY, SVGF};
use super::results::SceneResult;

/// Scenes whose light changes over time: lamps that step or move, shadows that wander.
const CHANGING: [&str; 4] = ["cornell", "pillars", "lamps", "mirror"];

/// A claim on one scene: a ratio that must not be above a bound.
pub struct Claim {
    /// The claim, with its source.
    pub text: String,
    /// Scene.
    pub scene: String,
    /// What was measured.
    pub ratio: f64,
    /// The largest ratio that it holds with.
    pub bound: f64,
}

impl Claim {
    /// Whether it holds.
    pub fn holds(&self) -> bool {
        self.ratio <= self.bound
    }
}

/// All claims about a scene whose filters were measured.
pub fn of_scene(result: &SceneResult) -> Vec<Claim> {
    let rmse = |name: &str| result.row(name).map_or(f64::NAN, |row| row.mean().rmse);
    let claim = |text: String, ratio: f64, bound: f64| Claim { text, scene: result.scene.clone(), ratio, bound };
    let mut claims =
        vec![claim("RMSE of SVGF to that of EAW on accumulated light [SVGF 5]".into(), rmse(SVGF) / rmse(EAW_ACCUMULATED), 1.0)];
    let changing = CHANGING.contains(&result.scene.as_str());
    claims.push(match changing {
        true => claim("RMSE of A-SVGF to that of SVGF, light changes [ASVGF 5]".into(), rmse(ASVGF) / rmse(SVGF), 1.0),
        false => claim("RMSE of A-SVGF to that of SVGF, light does not change [ASVGF 5]".into(), rmse(ASVGF) / rmse(SVGF), 1.05),
    });
    for row in result.rows.iter().filter(|row| row.name != NOISY) {
        claims.push(claim(format!("distance of the energy of {} from 1", row.name), (row.energy - 1.0).abs(), 0.02));
    }
    claims.extend(lead(result).into_iter().flatten().map(|(text, ratio)| claim(text, ratio, 1.02)));
    claims.retain(|claim| claim.ratio.is_finite());
    claims
}

/// What `best` is to the best of the others.
fn lead(result: &SceneResult) -> Option<[(String, f64); 2]> {
    let best = result.row(BEST)?.mean();
    let others: Vec<_> =
        result.rows.iter().filter(|row| row.name != NOISY && row.name != BEST).map(super::results::Row::mean).collect();
    if others.is_empty() {
        return None;
    }
    let least = others.iter().map(|s| s.rmse).fold(f64::INFINITY, f64::min);
    let most = others.iter().map(|s| s.ssim).fold(0.0, f64::max);
    Some([
        ("RMSE of best to the lowest of the others".into(), best.rmse / least),
        ("the highest SSIM of the others to that of best".into(), most / best.ssim),
    ])
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
