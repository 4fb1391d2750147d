//! The times of the filters' passes: a plot that stacks them, frame by frame, and a table.

use std::collections::VecDeque;

use atrous::config::Preset;
use atrous::executor::PassTime;
use egui::{Color32, Pos2, Rect, RichText, Ui};

use super::shared::{FilterReport, Report};

/// Frames that a plot shows.
const PLOTTED: usize = 160;
/// Share of the frames that a plot shows whole. A hiccup would make all others flat.
const SHOWN_WHOLE: f64 = 0.95;
/// Height of a plot, points.
const HEIGHT: f32 = 60.0;

/// Of the passes, in their order; then the same darker and lighter.
const COLOURS: [[u8; 3]; 5] = [[86, 180, 233], [230, 159, 0], [0, 158, 115], [240, 228, 66], [204, 121, 167]];
/// Of a frame that is cut off.
const CUT: Color32 = Color32::from_rgb(255, 90, 60);

/// Times of each filter that was shown lately, by frame; oldest first.
#[derive(Default)]
pub struct Timings {
    filters: Vec<(Preset, VecDeque<Vec<PassTime>>)>,
    last_frame: u64,
}

impl Timings {
    /// Takes the times of a frame that is new.
    pub fn remember(&mut self, report: &Report) {
        if report.frames == self.last_frame {
            return;
        }
        self.last_frame = report.frames;
        self.filters.retain(|(preset, _)| report.filters.iter().any(|filter| filter.preset == *preset));
        for filter in &report.filters {
            let index = self.filters.iter().position(|(preset, _)| *preset == filter.preset).unwrap_or_else(|| {
                self.filters.push((filter.preset, VecDeque::new()));
                self.filters.len() - 1
            });
            let frames = &mut self.filters[index].1;
            frames.push_back(filter.times.clone());
            let surplus = frames.len().saturating_sub(PLOTTED);
            frames.drain(..surplus);
        }
    }

    /// A rolling plot of each filter, then its passes.
    pub fn show(&self, ui: &mut Ui, report: &Report) {
        for filter in &report.filters {
            let total: f64 = filter.times.iter().map(|t| t.milliseconds).sum();
            ui.label(format!("{}: {total:.2} ms", filter.preset.title()));
            if let Some((_, frames)) = self.filters.iter().find(|(preset, _)| *preset == filter.preset) {
                plot(ui, frames, &filter.times);
            }
            passes(ui, filter);
        }
    }
}

/// Where a plot ends: the time that a share of the frames stays within, and a little more.
fn ceiling(totals: &[f64], share: f64) -> f64 {
    let mut sorted: Vec<f64> = totals.iter().copied().filter(|total| total.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let rank = (share * sorted.len() as f64).ceil() as usize;
    let within = sorted.get(rank.max(1) - 1).copied().unwrap_or(0.0);
    (1.1 * within).max(1e-3)
}

/// Index among `order`, low and high end of each pass of a frame, one on top of the other. A pass that is not among them is left out.
fn stacked(frame: &[PassTime], order: &[PassTime]) -> Vec<(usize, f64, f64)> {
    let mut low = 0.0;
    let mut place = |(index, pass): (usize, &PassTime)| {
        let time = frame.iter().find(|time| time.name == pass.name)?;
        let bottom = low;
        low += time.milliseconds;
        Some((index, bottom, low))
    };
    order.iter().enumerate().filter_map(&mut place).collect()
}

fn plot(ui: &mut Ui, frames: &VecDeque<Vec<PassTime>>, order: &[PassTime]) {
    let (rect, response) = ui.allocate_exact_size(egui::vec2(ui.available_width(), HEIGHT), egui::Sense::hover());
    response.on_hover_text(
        "Frame by frame, pass upon pass in the colours below. A frame with a red end is longer than the plot is high",
    );
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 2.0, ui.visuals().extreme_bg_color);
    let totals: Vec<f64> = frames.iter().map(|frame| frame.iter().map(|t| t.milliseconds).sum()).collect();
    let ceiling = ceiling(&totals, SHOWN_WHOLE);
    let width = rect.width() / PLOTTED as f32;
    let y = |time: f64| rect.bottom() - rect.height() * (time / ceiling).min(1.0) as f32;
    let mut mesh = egui::Mesh::default();
    for (column, (frame, total)) in frames.iter().zip(&totals).enumerate() {
        let x = rect.left() + width * column as f32;
        for (index, low, high) in stacked(frame, order) {
            mesh.add_colored_rect(Rect::from_min_max(Pos2::new(x, y(high)), Pos2::new(x + width, y(low))), colour(index));
        }
        if *total > ceiling {
            mesh.add_colored_rect(Rect::from_min_size(Pos2::new(x, rect.top()), egui::vec2(width, 3.0)), CUT);
        }
    }
    painter.add(mesh);
    let (font, text) = (egui::FontId::proportional(10.0), format!("{ceiling:.1} ms"));
    painter.text(rect.right_top(), egui::Align2::RIGHT_TOP, text, font, ui.visuals().strong_text_color());
}

fn passes(ui: &mut Ui, filter: &FilterReport) {
    egui::CollapsingHeader::new(RichText::new("passes").small()).id_salt(("passes", filter.preset.title())).show(ui, |ui| {
        egui::Grid::new(("times", filter.preset.title())).num_columns(3).show(ui, |ui| {
            for (index, time) in filter.times.iter().enumerate() {
                let (rect, _) = ui.allocate_exact_size(egui::vec2(10.0, 10.0), egui::Sense::hover());
                ui.painter().rect_filled(rect, 1.0, colour(index));
                ui.label(time.name.replace('_', " "));
                ui.label(format!("{:.2} ms", time.milliseconds));
                ui.end_row();
            }
        });
    });
}

fn colour(index: usize) -> Color32 {
    let base = COLOURS[index % COLOURS.len()];
    let mixed = |with: u16, share: u16| base.map(|c| ((u16::from(c) * (100 - share) + with * share) / 100) as u8);
    let [r, g, b] = match index / COLOURS.len() % 3 {
        0 => base,
        1 => mixed(0, 45),
        _ => mixed(255, 50),
    };
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(times: &[(&str, f64)]) -> Vec<PassTime> {
        times.iter().map(|(name, milliseconds)| PassTime { name: (*name).to_owned(), milliseconds: *milliseconds }).collect()
    }

    #[test]
    fn a_hiccup_does_not_flatten_the_plot() {
        let mut totals = vec![10.0; 99];
        totals.push(1000.0);
        assert_eq!(ceiling(&totals, 0.95), 11.0);
        assert_eq!(ceiling(&totals, 1.0), 1100.0);
        let rising: Vec<f64> = (1..=100).map(f64::from).collect();
        assert!((ceiling(&rising, 0.95) - 1.1 * 95.0).abs() < 1e-9);
        assert!(ceiling(&[], 0.95) > 0.0 && ceiling(&[f64::NAN, 0.0], 0.95) > 0.0, "a plot has a height");
    }

    #[test]
    fn passes_lie_one_upon_the_other_in_their_order() {
        let order = times(&[("import", 0.0), ("variance", 0.0), ("modulate", 0.0)]);
        let frame = times(&[("modulate", 3.0), ("import", 1.0), ("gone", 9.0)]);
        assert_eq!(stacked(&frame, &order), [(0, 0.0, 1.0), (2, 1.0, 4.0)]);
    }

    #[test]
    fn times_are_of_filters_that_are_shown_and_of_so_many_frames() {
        let filter =
            |preset, milliseconds| FilterReport { preset, times: times(&[("import", milliseconds)]), ..FilterReport::default() };
        let mut timings = Timings::default();
        for frame in 1..=200 {
            timings.remember(&Report { frames: frame, filters: vec![filter(Preset::Svgf, frame as f64)], ..Report::default() });
        }
        timings.remember(&Report { frames: 200, filters: vec![filter(Preset::Svgf, -1.0)], ..Report::default() });
        let (preset, frames) = &timings.filters[0];
        assert_eq!((*preset, frames.len(), frames[PLOTTED - 1][0].milliseconds), (Preset::Svgf, PLOTTED, 200.0));
        timings.remember(&Report { frames: 201, filters: vec![filter(Preset::Eaw, 1.0)], ..Report::default() });
        assert_eq!(timings.filters.iter().map(|f| f.0).collect::<Vec<_>>(), [Preset::Eaw]);
    }
}
