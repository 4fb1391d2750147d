//! What lies over the picture: the divider, the magnifier's numbers, the help.

use atrous::reference::Reason;
use atrous::DebugView;
use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, Ui};

use super::captions;
use super::input::HELP;
use super::layout::{Place, GRAB};
use super::settings::Settings;
use super::shared::{Probe, Report};

/// Side of the magnifier, points.
pub const LENS_SIDE: f32 = 180.0;
/// The panel's usual width, points.
pub const PANEL_WIDTH: f32 = 320.0;

/// What the mouse did over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Over {
    /// The picture's place, window pixels.
    pub place: Place,
    /// It was dragged by so many points: the camera turns.
    pub turned: [f32; 2],
    /// The mouse is over it, window pixels.
    pub pointer: Option<[f32; 2]>,
    /// The divider is held.
    pub holds_divider: bool,
    /// The panel's width, points; 0 where it is hidden.
    pub panel_width: f32,
}

/// The picture's part of the window.
pub fn picture(ui: &mut Ui, settings: &mut Settings, report: &Report, extent: [u32; 2]) -> Over {
    let scale = ui.ctx().pixels_per_point();
    let window = ui.ctx().content_rect().size() * scale;
    let panel = if settings.panel { PANEL_WIDTH * scale } else { 0.0 };
    let place = Place::beside(window.into(), panel).fit(extent.map(|side| side as f32), settings.scaling);
    let rect =
        Rect::from_min_size(Pos2::new(place.x / scale, place.y / scale), egui::vec2(place.width / scale, place.height / scale));
    // The panel's edge is grabbed from both sides.
    let edge = if settings.panel { ui.style().interaction.resize_grab_radius_side } else { 0.0 };
    let free = ui.max_rect().with_max_x(ui.max_rect().right() - edge);
    let looked = ui.interact(rect.intersect(free), ui.id().with("picture"), egui::Sense::click_and_drag());
    let x = rect.left() + settings.divider * rect.width();
    let handle = Rect::from_min_max(Pos2::new(x - GRAB, rect.top()), Pos2::new(x + GRAB, rect.bottom()));
    let grip = if settings.difference { egui::Sense::empty() } else { egui::Sense::drag() };
    let divider = ui.interact(handle, ui.id().with("divider"), grip);
    if let Some(pointer) = divider.interact_pointer_pos().filter(|_| divider.dragged() || divider.drag_stopped()) {
        settings.divider = place.divider(pointer.x * scale);
    }
    let is_hot = !settings.difference && (divider.hovered() || divider.dragged());
    if is_hot {
        ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeHorizontal);
    }
    let painter = ui.painter_at(rect.expand(2.0));
    if !settings.difference {
        line(&painter, x, rect, is_hot);
    }
    captions::draw(&painter, settings, report, rect.intersect(ui.max_rect()), x);
    let turned = if looked.dragged() { looked.drag_delta() } else { egui::Vec2::ZERO };
    let pointer = looked.hover_pos().or(divider.hover_pos()).map(|p| [p.x * scale, p.y * scale]);
    if let Some(pointer) = pointer.filter(|_| settings.magnifier) {
        numbers(ui, report, [pointer[0] / scale, pointer[1] / scale]);
    }
    let holds_divider = divider.is_pointer_button_down_on();
    Over { place, turned: [turned.x, turned.y], pointer, holds_divider, panel_width: 0.0 }
}

fn line(painter: &egui::Painter, x: f32, rect: Rect, is_hot: bool) {
    let (width, colour) = if is_hot { (3.0, Color32::WHITE) } else { (1.5, Color32::from_white_alpha(160)) };
    painter.vline(x, rect.y_range(), Stroke::new(width, colour));
}

/// The numbers of the pixel under the magnifier, beside it.
fn numbers(ui: &Ui, report: &Report, [x, y]: [f32; 2]) {
    let Some(probe) = &report.probe else { return };
    let painter = ui.ctx().layer_painter(egui::LayerId::new(egui::Order::Tooltip, egui::Id::new("numbers")));
    let galley = painter.layout_no_wrap(text(probe), FontId::monospace(12.0), Color32::WHITE);
    let screen = ui.ctx().content_rect();
    let mut corner = Pos2::new(x + 0.5 * LENS_SIDE + 8.0, y - 0.5 * LENS_SIDE);
    if corner.x + galley.size().x > screen.right() {
        corner.x = x - 0.5 * LENS_SIDE - 8.0 - galley.size().x;
    }
    corner.y = corner.y.clamp(screen.top() + 4.0, (screen.bottom() - galley.size().y - 4.0).max(screen.top() + 4.0));
    painter.rect_filled(Rect::from_min_size(corner, galley.size()).expand(4.0), 3.0, Color32::from_black_alpha(210));
    painter.galley(corner, galley, Color32::WHITE);
}

fn text(probe: &Probe) -> String {
    let number = |view: DebugView| probe.numbers[view as usize];
    let mut lines = vec![format!("pixel {}, {}", probe.pixel[0], probe.pixel[1])];
    let colour = |c: [f32; 3]| format!("{:.3} {:.3} {:.3}", c[0], c[1], c[2]);
    lines.push(format!("left   {}", colour(probe.colours[0])));
    lines.push(format!("right  {}", colour(probe.colours[1])));
    if let Some(preset) = probe.preset {
        lines.push(format!("-- {}", preset.title()));
    }
    for (view, label, unit) in [
        (DebugView::HistoryLength, "history", " frames"),
        (DebugView::Deviation, "deviation", ""),
        (DebugView::Alpha, "alpha", ""),
        (DebugView::Lambda, "lambda", ""),
        (DebugView::Motion, "motion", " px"),
        (DebugView::Depth, "depth", ""),
        (DebugView::SurfaceId, "id", ""),
    ] {
        if let Some(value) = number(view) {
            lines.push(format!("{label:9} {value:.4}{unit}"));
        }
    }
    if let Some(reason) = number(DebugView::Disocclusion) {
        lines.push(format!("history   {}", why(reason)));
    }
    lines.join("\n")
}

/// A number of [`Reason`] in words.
pub fn why(reason: f32) -> &'static str {
    match reason as u16 {
        r if r == Reason::None as u16 => "is kept",
        r if r == Reason::OffScreen as u16 => "dropped: was off screen",
        r if r == Reason::Id as u16 => "dropped: another object was there",
        r if r == Reason::Depth as u16 => "dropped: another depth was there",
        r if r == Reason::Normal as u16 => "dropped: another normal was there",
        _ => "dropped: all of it was reset",
    }
}

/// Every key.
pub fn help(ctx: &egui::Context, open: &mut bool) {
    egui::Window::new("Help").open(open).collapsible(false).resizable(false).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(
        ctx,
        |ui| {
            egui::Grid::new("help").num_columns(2).striped(true).spacing([16.0, 6.0]).show(ui, |ui| {
                for (key, what) in HELP {
                    ui.strong(*key);
                    ui.label(*what);
                    ui.end_row();
                }
            });
            ui.add_space(6.0);
            ui.label("Everything in the panel explains itself under the mouse. F1 closes this.");
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_magnifier_says_what_is_there_and_nothing_else() {
        let mut probe = Probe { pixel: [3, 4], ..Probe::default() };
        assert!(!text(&probe).contains("alpha"));
        probe.numbers[DebugView::Alpha as usize] = Some(0.25);
        probe.numbers[DebugView::Disocclusion as usize] = Some(f32::from(Reason::Depth as u16));
        let shown = text(&probe);
        assert!(shown.contains("0.2500") && shown.contains("another depth") && shown.contains("pixel 3, 4"), "{shown}");
    }
}
