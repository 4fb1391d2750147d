//! Textures of the panel that were changed and not yet drawn: glyphs, most of all.

use egui::TexturesDelta;

/// Changes, oldest first. What the panel says is said once, and a frame may not be drawn: then it waits for the next one.
#[derive(Default)]
pub struct PendingTextures {
    changes: TexturesDelta,
}

impl PendingTextures {
    /// What a turn of the panel changed.
    pub fn add(&mut self, changes: TexturesDelta) {
        self.changes.append(changes);
    }

    /// Everything that a frame has to upload and to free.
    pub fn changes(&self) -> &TexturesDelta {
        &self.changes
    }

    /// A frame was drawn with them.
    pub fn done(&mut self) {
        self.changes.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turn of a panel with this text.
    fn turn(context: &egui::Context, text: &str) -> TexturesDelta {
        let draw = |ctx: &egui::Context| drop(egui::CentralPanel::default().show(ctx, |ui| ui.label(text)));
        context.run(egui::RawInput::default(), draw).textures_delta
    }

    #[test]
    fn what_was_not_drawn_waits_in_its_order() {
        let (context, mut pending) = (egui::Context::default(), PendingTextures::default());
        pending.add(turn(&context, "a"));
        let whole = pending.changes().set.len();
        assert!(whole > 0 && pending.changes().set[0].1.is_whole(), "the glyphs come once as a whole");
        // Minimised: turns without a frame.
        pending.add(turn(&context, "äöü"));
        pending.add(TexturesDelta { free: vec![egui::TextureId::User(7)], ..TexturesDelta::default() });
        let changes = pending.changes();
        assert!(changes.set.len() > whole && changes.set[0].1.is_whole(), "the whole comes before its parts");
        assert_eq!(changes.free, [egui::TextureId::User(7)]);
        pending.done();
        assert!(pending.changes().is_empty());
    }
}
