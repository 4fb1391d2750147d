//! What the engine measures, as plots and tables of the panel.

use std::collections::VecDeque;

use egui::{Color32, RichText, Ui};

use super::shared::{FilterReport, Report};

/// Frames that the plot shows.
const PLOTTED: usize = 160;

/// Of the filters, in plots.
const COLOURS: [Color32; 5] = [
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(204, 121, 167),
];

/// Milliseconds of all passes of each filter, by frame; oldest first.
#[derive(Default)]
pub struct Timings {
    times: VecDeque<Vec<(&'static str, f64)>>,
    last_frame: u64,
}

impl Timings {
    /// Takes the times of a frame that is new.
    pub fn remember(&mut self, report: &Report) {
        if report.frames == self.last_frame {
            return;
        }
        self.last_frame = report.frames;
        let total = |f: &FilterReport| (f.preset.title(), f.times.iter().map(|t| t.milliseconds).sum());
        self.times.push_back(report.filters.iter().map(total).collect());
        while self.times.len() > PLOTTED {
            self.times.pop_front();
        }
    }

    /// A rolling plot of each filter's time, then its passes.
    pub fn show(&self, ui: &mut Ui, report: &Report) {
        let highest = self.times.iter().flatten().map(|t| t.1).fold(1e-3, f64::max);
        let (rect, _) = ui.allocate_exact_size(egui::vec2(ui.available_width(), 60.0), egui::Sense::hover());
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
        for (i, filter) in report.filters.iter().enumerate() {
            let title = filter.preset.title();
            let at = |(x, frame): (usize, &Vec<(&str, f64)>)| {
                let value = frame.iter().find(|t| t.0 == title)?.1;
                let x = rect.left() + rect.width() * x as f32 / PLOTTED as f32;
                Some(egui::pos2(x, rect.bottom() - rect.height() * (0.9 * value / highest) as f32))
            };
            let points: Vec<_> = self.times.iter().enumerate().filter_map(at).collect();
            painter.add(egui::Shape::line(points, egui::Stroke::new(1.5, COLOURS[i % COLOURS.len()])));
        }
        let text = format!("{highest:.1} ms");
        painter.text(rect.right_top(), egui::Align2::RIGHT_TOP, text, egui::FontId::proportional(10.0), ui.visuals().text_color());
        for (i, filter) in report.filters.iter().enumerate() {
            passes(ui, filter, COLOURS[i % COLOURS.len()]);
        }
    }
}

fn passes(ui: &mut Ui, filter: &FilterReport, colour: Color32) {
    let total: f64 = filter.times.iter().map(|t| t.milliseconds).sum();
    egui::CollapsingHeader::new(RichText::new(format!("{}: {total:.2} ms", filter.preset.title())).color(colour))
        .id_salt(("passes", filter.preset.title()))
        .show(ui, |ui| {
            egui::Grid::new(("times", filter.preset.title())).num_columns(2).show(ui, |ui| {
                for time in &filter.times {
                    ui.label(time.name.replace('_', " "));
                    ui.label(format!("{:.2} ms", time.milliseconds));
                    ui.end_row();
                }
            });
        });
}

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
        painter.rect_filled(egui::Rect::from_min_size(low, egui::vec2(width - 1.0, height)), 0.0, COLOURS[0]);
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
