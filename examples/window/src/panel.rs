//! The panel: every choice with its explanation, and what the engine says.

use atrous::{DebugView, ToneCurve};
use egui::{Color32, RichText, Ui};

use super::content::Content;
use super::input::Action;
use super::layout::Scaling;
use super::measurements::{histogram, memory};
use super::settings::{Settings, DIFFERENCE_RANGES, SPEEDS};
use super::shared::Report;
use super::surface_format::Encoding;
use super::timings::Timings;
use super::tunables;
use atrous_engine::denoiser::FILTERS;
use atrous_engine::scene::BUILT_IN;

/// What the panel remembers.
#[derive(Default)]
pub struct Panel {
    timings: Timings,
}

impl Panel {
    /// Draws it; returns what was clicked. `encoding`: how colours get to the display.
    pub fn show(&mut self, ui: &mut Ui, settings: &mut Settings, report: &Report, encoding: Encoding) -> Vec<Action> {
        self.timings.remember(report);
        let mut actions = Vec::new();
        egui::ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.heading("atrous");
                if ui.button("Help F1").on_hover_text("Every key and what the mouse does").clicked() {
                    actions.push(Action::Help);
                }
            });
            summary(ui, report);
            saved_shaders(ui, report);
            section(ui, "Scene", true, |ui| scene(ui, settings, report, &mut actions));
            section(ui, "Split screen", true, |ui| split(ui, settings, report, &mut actions));
            section(ui, "Time", true, |ui| time(ui, settings, &mut actions));
            section(ui, "Picture", false, |ui| picture(ui, settings, encoding));
            for preset in FILTERS {
                if [settings.left, settings.right].iter().any(|c| c.preset() == Some(preset)) {
                    section(ui, &format!("{}: numbers", preset.title()), false, |ui| {
                        tunables::show(ui, settings, report, preset);
                    });
                }
            }
            section(ui, "Timings", true, |ui| self.timings.show(ui, report));
            section(ui, "History lengths", true, |ui| histogram(ui, report));
            section(ui, "Memory", false, |ui| memory(ui, report));
            section(ui, "Files", false, |ui| files(ui, report, &mut actions));
            messages(ui, report);
        });
        actions
    }
}

fn section(ui: &mut Ui, title: &str, open: bool, body: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(RichText::new(title).strong()).default_open(open).show(ui, body);
}

fn summary(ui: &mut Ui, report: &Report) {
    let rate = if report.milliseconds > 0.0 { 1e3 / report.milliseconds } else { 0.0 };
    ui.label(format!("frame {}, {:.0} ms ({rate:.1} a second)", report.frames, report.milliseconds))
        .on_hover_text("Path tracing, filters and everything else that makes a frame");
    if report.recording {
        ui.colored_label(Color32::LIGHT_RED, "writing every frame (F3 ends it)");
    }
    if let Some(path) = report.path {
        ui.colored_label(Color32::LIGHT_RED, path);
    }
}

/// On top, since a shader that was just saved is what is worked on.
fn saved_shaders(ui: &mut Ui, report: &Report) {
    if let Some(reloaded) = &report.reloaded {
        ui.label(RichText::new(reloaded).small());
    }
    for error in &report.shader_errors {
        ui.label(RichText::new(error).color(Color32::LIGHT_RED).small())
            .on_hover_text("The shader as it was before goes on. Save it again when it is mended");
    }
}

fn scene(ui: &mut Ui, settings: &mut Settings, report: &Report, actions: &mut Vec<Action>) {
    egui::ComboBox::from_id_salt("scene")
        .selected_text(&report.scene)
        .show_ui(ui, |ui| {
            for name in BUILT_IN {
                ui.selectable_value(&mut settings.scene, name.to_owned(), name);
            }
        })
        .response
        .on_hover_text("Drop a glTF file (.gltf, .glb) onto the window to see it");
    ui.checkbox(&mut settings.animate_light, "lights change")
        .on_hover_text("Lights flicker, go out and come on, as the scene has it");
    ui.checkbox(&mut settings.animate_objects, "objects move");
    ui.checkbox(&mut settings.animate_camera, "camera follows its path")
        .on_hover_text("Off as soon as the camera is steered (W A S D, drag the picture)");
    if ui.button("Camera back to its path  H").clicked() {
        actions.push(Action::Home);
    }
}

fn split(ui: &mut Ui, settings: &mut Settings, report: &Report, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        content(ui, "left", &mut settings.left, report);
        if ui.button("X").on_hover_text("Change the halves (X)").clicked() {
            actions.push(Action::Swap);
        }
        content(ui, "right", &mut settings.right, report);
    });
    ui.add_enabled(!settings.difference, egui::Slider::new(&mut settings.divider, 0.0..=1.0).text("divider"))
        .on_hover_text("Or drag the line in the picture");
    ui.checkbox(&mut settings.difference, "difference of the halves  C")
        .on_hover_text("Right minus left as they are shown, of encoded values: grey where both are alike");
    let range = egui::Slider::new(&mut settings.difference_range, DIFFERENCE_RANGES[0]..=DIFFERENCE_RANGES[1]);
    ui.add_enabled(settings.difference, range.logarithmic(true).text("range"))
        .on_hover_text("The difference that is black or white; 1 is that of black and white themselves");
    ui.checkbox(&mut settings.magnifier, "magnifier  M")
        .on_hover_text("Enlarges what is under the mouse, with the numbers of the pixel and why its history was dropped");
    if [settings.left, settings.right].into_iter().any(Content::needs_reference) {
        ui.label(format!("reference: {} paths a pixel", report.reference_samples)).on_hover_text(
            "Grows while camera, objects and lights rest, whether time runs or not; begins anew when one of them changes",
        );
    }
}

fn content(ui: &mut Ui, side: &str, shown: &mut Content, report: &Report) {
    egui::ComboBox::from_id_salt(side)
        .selected_text(shown.title())
        .width(120.0)
        .height(500.0)
        .show_ui(ui, |ui| {
            ui.selectable_value(shown, Content::Noisy, "noisy").on_hover_text("One path a pixel: what the filters are given");
            ui.selectable_value(shown, Content::Reference, "reference")
                .on_hover_text("All paths since something last moved: what the filters should come to");
            for preset in FILTERS {
                ui.selectable_value(shown, Content::Filtered(preset), preset.title()).on_hover_text(about(preset));
            }
            for filter in &report.filters {
                ui.separator();
                let error = Content::Error(filter.preset);
                ui.selectable_value(shown, error, error.title())
                    .on_hover_text("FLIP against the reference, with RMSE: of the last frame that was measured  9");
                for view in &filter.views {
                    let value = Content::Debug(filter.preset, *view);
                    ui.selectable_value(shown, value, value.title()).on_hover_text(explained(*view));
                }
            }
        })
        .response
        .on_hover_text(format!("What the {side} half shows. Views of a filter are in the list while it runs"));
}

fn about(preset: atrous::config::Preset) -> &'static str {
    use atrous::config::Preset;
    match preset {
        Preset::Svgf => "Spatiotemporal variance-guided filtering (Schied et al. 2017)",
        Preset::Asvgf => "Adaptive by temporal gradients: follows changing light at once (Schied et al. 2018)",
        Preset::Percentile => "Adaptive by statistics of blocks: needs nothing more of the renderer than SVGF (Alber)",
        Preset::Best => {
            "A-SVGF whose history follows the light, unfiltered and sharp; by a test of blocks where no gradient is known"
        }
        Preset::Fast => "SVGF with 4 levels of 9 taps, adaptive by a test of blocks: the cheapest that follows changing light",
        _ => "Edge-avoiding à-trous wavelets: one frame, no history (Dammertz et al. 2010)",
    }
}

fn explained(view: DebugView) -> &'static str {
    match view {
        DebugView::HistoryLength => "Frames accumulated: dark blue 0, yellow 32 and more",
        DebugView::Deviation => "Standard deviation of luminance that guides the filter",
        DebugView::MeanAndDeviation => "Mean (red) and standard deviation (green) of luminance over the history",
        DebugView::Gradient => "Change of the same samples from frame to frame: red brighter, blue darker",
        DebugView::Lambda => "How far light changed: 0 keeps the history, 1 drops it",
        DebugView::Alpha => "Weight of the new sample",
        DebugView::Percentiles => "Low (red) and high (green) percentile of luminance in blocks of 8x8 pixels",
        DebugView::Fireflies => "Share of the light that the firefly filter took away",
        DebugView::Disocclusion => {
            "Why there is no history. Orange: off screen; light blue: other object; green: depth; yellow: normal; red: reset"
        }
        DebugView::Motion => "Where the surface was: red to the right, green downwards",
        DebugView::Normal => "Normals in world space",
        DebugView::Depth => "Linear depth",
        DebugView::SurfaceId => "A colour for every object",
        DebugView::HitDistance => "How far away is what is seen in a surface: dark blue touches it, yellow is the sky",
        DebugView::LobeAngle => "Width of what a surface blurs together: dark blue a mirror, yellow 45 degrees",
        DebugView::VirtualMotion => "Where what is seen in a surface was: red to the right, green downwards",
        DebugView::ReflectionHistory => {
            "Past of specular light: orange where the surface was, blue where the image behind it was, red none"
        }
        DebugView::Visibility => "Visibility of the sun over its history, before the filter",
        DebugView::Penumbra => "Radius of the penumbra: dark blue 0, yellow 16 pixels and more; black: nothing is in the way",
        DebugView::BadValues => {
            "Inputs that were not finite: a bar each for depth, normal, motion, radiance, albedo, emission, forward motion"
        }
        _ => "A view that this window has no words for",
    }
}

fn time(ui: &mut Ui, settings: &mut Settings, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let label = if settings.paused { "Go on  Space" } else { "Pause  Space" };
        if ui.button(label).clicked() {
            actions.push(Action::Pause);
        }
        if ui.button("Step  N").on_hover_text("One frame, then time stands still").clicked() {
            actions.push(Action::Step);
        }
        if ui.button("Reset  R").on_hover_text("Drops all history, as after a camera cut").clicked() {
            actions.push(Action::Reset);
        }
    });
    ui.add(egui::Slider::new(&mut settings.speed, SPEEDS[0]..=SPEEDS[1]).logarithmic(true).text("speed"))
        .on_hover_text("1: thirty frames for a second of the animation; less: slow motion");
}

fn picture(ui: &mut Ui, settings: &mut Settings, encoding: Encoding) {
    ui.add(egui::Slider::new(&mut settings.exposure, 0.01..=100.0).logarithmic(true).text("exposure"))
        .on_hover_text("Scale of the radiance before the tone curve");
    egui::ComboBox::from_id_salt("curve")
        .selected_text(settings.tone_curve.name())
        .show_ui(ui, |ui| {
            for curve in ToneCurve::ALL {
                ui.selectable_value(&mut settings.tone_curve, curve, curve.name());
            }
        })
        .response
        .on_hover_text("Curve of the tone map");
    ui.checkbox(&mut settings.taa, "temporal anti-aliasing")
        .on_hover_text("Jitters the paths within their pixels and resolves them (Karis 2014)");
    egui::ComboBox::from_id_salt("scaling")
        .selected_text(format!("{} scaling", settings.scaling.name()))
        .show_ui(ui, |ui| {
            for scaling in Scaling::ALL {
                ui.selectable_value(&mut settings.scaling, scaling, scaling.name());
            }
        })
        .response
        .on_hover_text("integer: every pixel as large as every other; fit: as large as the window has room for  Z");
    ui.checkbox(&mut settings.vsync, "V-sync").on_hover_text("Waits for the display; off: as fast as possible, may tear");
    ui.checkbox(&mut settings.hdr, "HDR").on_hover_text("Brighter than white, where display and driver offer it");
    let refused = if settings.hdr && encoding.peak() <= 1.0 { ": display or driver offer nothing else" } else { "" };
    ui.label(RichText::new(format!("{}{refused}", encoding.title())).weak()).on_hover_text("What the window is drawn in");
}

fn files(ui: &mut Ui, report: &Report, actions: &mut Vec<Action>) {
    for (label, action, hint) in [
        ("Picture as PNG  F2", Action::Screenshot, "Both halves at the divider, and each by itself"),
        (
            if report.recording { "End the sequence  F3" } else { "Every frame as PNG  F3" },
            Action::Record,
            "A folder of numbered PNG files",
        ),
        ("Record the camera's way  F4", Action::RecordPath, "F4 again writes it"),
        ("Fly the recorded way  F5", Action::ReplayPath, "The same views in the same frames"),
        ("Save settings  Ctrl S", Action::SaveSettings, "Everything in this panel"),
        ("Load settings  Ctrl O", Action::LoadSettings, "From the file of --settings"),
    ] {
        if ui.button(label).on_hover_text(hint).clicked() {
            actions.push(action);
        }
    }
}

fn messages(ui: &mut Ui, report: &Report) {
    for message in report.messages.iter().rev().take(6) {
        let colour = if message.is_error { Color32::LIGHT_RED } else { ui.visuals().weak_text_color() };
        ui.label(RichText::new(&message.text).color(colour).small());
    }
}
