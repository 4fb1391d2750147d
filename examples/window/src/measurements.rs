//! What the engine measures, as tables and bars of the panel.

use egui::{Color32, RichText, Ui};

use super::shared::Report;

/// Of bars.
const BAR: Color32 = Color32::from_rgb(86, 180, 233);

/// Pixels by history length.
pub fn histogram(ui: &mut Ui, report: &Report) {
    let Some(bars) = &report.histogram else {
        ui.label("The filters that run have no history.");
        return;
    };
    let (rect, response) = ui.allocate_exact_size(egui::vec2(ui.available_width(), 50.0), egui::Sense::hover());
    response.on_hover_text("Pixels by frames accumulated: 0 to 31, the last bar 32 and more");
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
    let highest = bars.iter().copied().max().unwrap_or(1).max(1) as f32;
    let width = rect.width() / bars.len() as f32;
    for (i, bar) in bars.iter().enumerate() {
        let height = rect.height() * *bar as f32 / highest;
        let low = egui::pos2(rect.left() + width * i as f32, rect.bottom() - height);
        painter.rect_filled(egui::Rect::from_min_size(low, egui::vec2(width - 1.0, height)), 0.0, BAR);
    }
}

/// Bytes of each filter that runs.
pub fn memory(ui: &mut Ui, report: &Report) {
    egui::Grid::new("memory").num_columns(4).show(ui, |ui| {
        for head in ["KiB", "history", "transient", "outputs"] {
            ui.label(RichText::new(head).strong());
        }
        ui.end_row();
        for filter in &report.filters {
            ui.label(filter.preset.title());
            for bytes in [filter.memory.history, filter.memory.transient, filter.memory.output] {
                ui.label(format!("{}", bytes / 1024));
            }
            ui.end_row();
        }
    });
}
