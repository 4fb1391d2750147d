//! What stands on the picture: what each half shows, with its numbers, and what its colours stand for.

use atrous_lab::pictures::{ColourBar, Legend};
use egui::{Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Vec2};
use std::sync::Arc;

use super::legend;
use super::settings::Settings;
use super::shared::Report;

/// Of a legend, points.
const LEGEND_WIDTH: f32 = 220.0;
const BAR_HEIGHT: f32 = 10.0;
const GAP: f32 = 4.0;
/// From the picture's border, points.
const MARGIN: f32 = 8.0;
/// A picture with less room has no legend over it, points.
const LEAST_ROOM: Vec2 = Vec2::new(160.0, 120.0);
const GROUND: u8 = 230;

/// Writes them into the picture's place; `divider`: where it is.
pub fn draw(painter: &Painter, settings: &Settings, report: &Report, rect: Rect, divider: f32) {
    let top = rect.top() + MARGIN;
    if settings.difference {
        let title = format!("{} minus {}", settings.right.title(), settings.left.title());
        caption(painter, Pos2::new(rect.center().x, top), Align2::CENTER_TOP, &title, "");
        return draw_legend(painter, &legend::of_difference(settings.difference_range), rect, Align2::LEFT_BOTTOM);
    }
    for (content, x, above, below) in [
        (settings.left, divider - MARGIN, Align2::RIGHT_TOP, Align2::LEFT_BOTTOM),
        (settings.right, divider + MARGIN, Align2::LEFT_TOP, Align2::RIGHT_BOTTOM),
    ] {
        let legend = legend::of_content(content, report.reference_samples, &report.errors);
        caption(painter, Pos2::new(x, top), above, &content.title(), &legend.title);
        draw_legend(painter, &legend, rect, below);
    }
}

/// A title, and smaller what is said of it.
fn caption(painter: &Painter, at: Pos2, align: Align2, title: &str, more: &str) {
    let galley = painter.layout_no_wrap(title.to_owned(), FontId::proportional(13.0), Color32::WHITE);
    let width = galley.size().x.max(LEGEND_WIDTH);
    let below = (!more.is_empty()).then(|| painter.layout(more.to_owned(), FontId::proportional(11.0), Color32::WHITE, width));
    let sizes = [galley.size(), below.as_ref().map_or(Vec2::ZERO, |below| below.size())];
    let size = Vec2::new(sizes[0].x.max(sizes[1].x), sizes[0].y + sizes[1].y);
    let place = align.anchor_size(at, size);
    painter.rect_filled(place.expand(3.0), 2.0, Color32::from_black_alpha(GROUND));
    let line = |top: f32, galley: Arc<Galley>| {
        let x = align.x().align_size_within_range(galley.size().x, place.x_range()).min;
        painter.galley(Pos2::new(x, top), galley, Color32::WHITE);
    };
    line(place.top(), galley);
    if let Some(below) = below {
        line(place.top() + sizes[0].y, below);
    }
}

/// Bars and swatches in a corner of the picture.
fn draw_legend(painter: &Painter, legend: &Legend, rect: Rect, corner: Align2) {
    let has_colours = !legend.bars.is_empty() || !legend.swatches.is_empty();
    if !has_colours || rect.width() < LEAST_ROOM.x || rect.height() < LEAST_ROOM.y {
        return;
    }
    let small = |text: &str| painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.0), Color32::WHITE);
    let line = small("0").size().y;
    let bars = legend.bars.len() as f32 * (2.0 * line + BAR_HEIGHT + GAP);
    let size = Vec2::new(LEGEND_WIDTH.min(0.45 * rect.width()), bars + legend.swatches.len() as f32 * line);
    let place = corner.align_size_within_rect(size, rect.shrink(MARGIN + 3.0));
    painter.rect_filled(place.expand(3.0), 2.0, Color32::from_black_alpha(GROUND));
    let mut top = place.top();
    for bar in &legend.bars {
        painter.galley(Pos2::new(place.left(), top), small(&bar.name), Color32::WHITE);
        top += line;
        draw_bar(painter, bar, Rect::from_min_size(Pos2::new(place.left(), top), Vec2::new(size.x, BAR_HEIGHT)), &small);
        top += BAR_HEIGHT + line + GAP;
    }
    for ([r, g, b], name) in &legend.swatches {
        let swatch = Rect::from_min_size(Pos2::new(place.left(), top), Vec2::splat(line)).shrink(2.0);
        painter.rect_filled(swatch, 1.0, Color32::from_rgb(*r, *g, *b));
        painter.galley(Pos2::new(swatch.right() + GAP, top), small(name), Color32::WHITE);
        top += line;
    }
}

fn draw_bar(painter: &Painter, bar: &ColourBar, rect: Rect, small: &impl Fn(&str) -> Arc<Galley>) {
    let mut mesh = egui::Mesh::default();
    let width = rect.width() / bar.colours.len().max(1) as f32;
    for (i, [r, g, b]) in bar.colours.iter().enumerate() {
        let corner = Pos2::new(rect.left() + width * i as f32, rect.top());
        mesh.add_colored_rect(Rect::from_min_size(corner, Vec2::new(width, rect.height())), Color32::from_rgb(*r, *g, *b));
    }
    painter.add(mesh);
    for (place, text) in &bar.marks {
        let galley = small(text);
        let room = rect.width() - galley.size().x;
        let x = (place * rect.width() - 0.5 * galley.size().x).clamp(0.0, room.max(0.0));
        painter.galley(Pos2::new(rect.left() + x, rect.bottom()), galley, Color32::WHITE);
    }
}
