//! Where light is lost: the share that is left when a part of a filter is switched off.

use std::path::Path;

use crate::Result;
use atrous::config::Preset;

use super::{on_scene, Figures, Findings};
use crate::evaluate::contenders::{Contender, ASVGF, BEST, NOISY};
use crate::evaluate::scene::Lab;

/// Scenes that lose most.
const SCENES: [&str; 3] = ["door", "fog", "hall"];
/// The filter of the paper, which loses what it cuts off.
const NO_SPREAD: (&str, f32) = ("firefly_spread", 0.0);
/// Limits that nothing reaches.
const NO_LIMIT: (&str, f32) = ("firefly_bias", 65504.0);
const ALIKE: [(&str, f32); 2] = [("sigma_l", 128.0), ("volume_sigma_l", 128.0)];

pub fn run(lab: &Lab, folder: &Path) -> Result<Findings> {
    let alike = |contender: Contender| ALIKE.into_iter().try_fold(contender, |c, (name, value)| c.with(name, value));
    let best = |name| Contender::new(name, Preset::Best);
    let contenders = [
        best(BEST),
        best("best, outliers are lost").with(NO_SPREAD.0, NO_SPREAD.1)?,
        best("best, no firefly filter").with(NO_LIMIT.0, NO_LIMIT.1)?,
        alike(best("best, every luminance alike"))?,
        alike(best("best, neither").with(NO_LIMIT.0, NO_LIMIT.1)?)?,
        Contender::new(ASVGF, Preset::Asvgf),
        alike(Contender::new("A-SVGF, every luminance alike", Preset::Asvgf))?,
    ];
    let mut columns = vec![Vec::new(); contenders.len() + 1];
    let mut errors = columns.clone();
    for name in SCENES {
        for (index, row) in on_scene(lab, name, &contenders, folder)?.iter().enumerate() {
            columns[index].push(row.energy);
            errors[index].push(row.mean().rmse);
        }
    }
    let headings = SCENES.map(|scene| [format!("{scene}: light"), format!("{scene}: RMSE")]).concat();
    let mut table = Figures::new("share of the reference's light", headings.iter().map(|heading| (heading.as_str(), 4)));
    for ((name, light), errors) in std::iter::once(NOISY).chain(contenders.iter().map(|c| c.name)).zip(columns).zip(errors) {
        table.row(name, &light.into_iter().zip(errors).flat_map(|(light, error)| [light, error]).collect::<Vec<_>>());
    }
    Ok(Findings {
        title: "Where light is lost".into(),
        text: "With `firefly_spread` 0 what outliers are cut by is lost, with `firefly_bias` 65504 none is cut, and with `sigma_l` 128 none is \
               refused by its neighbours."
            .into(),
        tables: vec![table],
        ..Findings::default()
    })
}
