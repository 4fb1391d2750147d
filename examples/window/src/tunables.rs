//! The numbers of a filter in the panel: those that it reads, with their ranges, and the others dimmed.

use atrous::config::Preset;
use atrous::{Tuning, TuningField};
use egui::Ui;

use super::settings::Settings;
use super::shared::Report;

/// A number of a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    field: &'static TuningField,
    value: f32,
    /// Of the filter, not of all.
    default: f32,
    /// Whether a pass of the filter reads it.
    is_read: bool,
}

/// Every number but those that the window has for all filters. `read`: names of those that passes read.
fn rows(settings: &Settings, preset: Preset, read: &[&str]) -> Vec<Row> {
    let (tuning, defaults) = (settings.tuning(preset), Tuning::for_preset(preset));
    let row = |field: &'static TuningField| Row {
        field,
        value: tuning.get(field.name).unwrap_or(field.default),
        default: defaults.get(field.name).unwrap_or(field.default),
        is_read: read.contains(&field.name),
    };
    Tuning::FIELDS.iter().filter(|field| field.name != "exposure").map(row).collect()
}

/// Draws them all, those that the filter reads before the others.
pub fn show(ui: &mut Ui, settings: &mut Settings, report: &Report, preset: Preset) {
    // Until the filter has run, nothing is known of it.
    let Some(filter) = report.filters.iter().find(|filter| filter.preset == preset) else { return };
    let (read, others): (Vec<_>, Vec<_>) = rows(settings, preset, &filter.tunables).into_iter().partition(|row| row.is_read);
    for row in read {
        ui.horizontal(|ui| number(ui, settings, preset, row));
    }
    if ui.button("Defaults").on_hover_text(format!("All numbers as {} has them", preset.title())).clicked() {
        settings.tuning.remove(preset.name());
    }
    ui.weak(format!("{} does not read:", preset.title()));
    for mut row in others {
        ui.add_enabled(false, slider(row.field, &mut row.value)).on_disabled_hover_text(explain(&row));
    }
}

fn number(ui: &mut Ui, settings: &mut Settings, preset: Preset, mut row: Row) {
    let response = ui.add(slider(row.field, &mut row.value)).on_hover_text(explain(&row));
    if response.changed() {
        settings.set_tuning(preset, row.field.name, row.value.clamp(row.field.min, row.field.max));
    }
    let back = || format!("Back to {}, the default of {}", row.default, preset.title());
    if row.value != row.default && ui.small_button("⟲").on_hover_text(back()).clicked() {
        settings.set_tuning(preset, row.field.name, row.default);
    }
}

fn slider<'a>(field: &TuningField, value: &'a mut f32) -> egui::Slider<'a> {
    let wide = field.max - field.min > 16.0 && field.min >= 0.0;
    egui::Slider::new(value, field.min..=field.max).logarithmic(wide).smallest_positive(1e-3).text(field.name.replace('_', " "))
}

fn explain(row: &Row) -> String {
    let TuningField { doc, unit, min, max, .. } = row.field;
    format!("{}\nUnit: {unit}. {min} to {max}, default {}", doc.trim(), row.default)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(settings: &Settings, preset: Preset, name: &str) -> Row {
        rows(settings, preset, &["alpha"]).into_iter().find(|row| row.field.name == name).expect("a number")
    }

    #[test]
    fn the_default_is_that_of_the_filter() {
        let mut settings = Settings::default();
        for (preset, default) in [(Preset::Svgf, 0.2), (Preset::Asvgf, 0.1)] {
            settings.set_tuning(preset, "alpha", 0.7);
            let changed = row(&settings, preset, "alpha");
            assert_eq!((changed.value, changed.default), (0.7, default));
            assert!(explain(&changed).ends_with(&format!("default {default}")), "{}", explain(&changed));
            settings.set_tuning(preset, "alpha", changed.default);
            assert_eq!(row(&settings, preset, "alpha").value, default);
        }
        assert!(settings.tuning.is_empty(), "nothing is left of it");
    }

    #[test]
    fn what_the_filter_does_not_read_is_known() {
        let settings = Settings::default();
        assert!(row(&settings, Preset::Svgf, "alpha").is_read && !row(&settings, Preset::Svgf, "gradient_scale").is_read);
        assert!(rows(&settings, Preset::Svgf, &[]).iter().all(|row| row.field.name != "exposure"), "the window has one for all");
    }
}
