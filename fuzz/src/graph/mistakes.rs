//! One mistake more in a graph that is accepted: it has to be refused, and named.

use super::stages::{COPY, MIX};
use ash::vk::Format;
use atrous::graph::{Feedback, Graph, Guides, Image, Irradiance, Radiance, Stage};
use atrous::nodes::*;
use atrous::Error;

/// A mistake.
pub struct Mistake {
    /// Makes it, with nodes and images of its own.
    plant: fn(&mut Graph, &Guides, &Radiance),
    /// What the error says.
    words: &'static str,
}

/// One of each kind.
pub const MISTAKES: [Mistake; 12] = [
    Mistake { plant: unwritten, words: "nothing writes it" },
    Mistake { plant: too_early, words: "writes it later in the frame" },
    Mistake { plant: cycle, words: "a cycle" },
    Mistake { plant: two_writers, words: "writes it, too" },
    Mistake { plant: stale, words: "was overwritten by" },
    Mistake { plant: unwritten_history, words: "nothing writes this history" },
    Mistake { plant: overwritten_history, words: "overwrites this history" },
    Mistake { plant: previous_of_an_output, words: "only a history does" },
    Mistake { plant: format, words: "cannot be" },
    Mistake { plant: foreign, words: "belongs to another graph" },
    Mistake { plant: twice, words: "in the graph already" },
    Mistake { plant: read_and_written, words: "in the same pass" },
];

impl Mistake {
    /// Makes the mistake.
    pub fn make(&self, g: &mut Graph, guides: &Guides, noisy: &Radiance) {
        (self.plant)(g, guides, noisy);
    }

    /// The error is that of the mistake, and tells where it is.
    pub fn assert_is_named(&self, error: Option<Error>) {
        let Some(Error::Graph { node, port, problem }) = &error else { panic!("not refused for \"{}\": {error:?}", self.words) };
        assert!(problem.contains(self.words), "\"{}\" was planted: {error:?}", self.words);
        assert!(node.contains("planted") || port.contains("planted"), "\"{}\" is elsewhere: {error:?}", self.words);
    }
}

fn image(g: &mut Graph, name: &str) -> Image {
    g.transient(name, Format::R16G16B16A16_SFLOAT, 1)
}

/// Runs a stage under a name of its own.
fn run(g: &mut Graph, name: &str, stage: &Stage, from: Image, to: Option<Image>) -> Image {
    g.scope(name, |g| {
        let call = g.stage(stage).bind("from", from);
        to.into_iter().fold(call, |call, to| call.bind("to", to)).add().written("to")
    })
}

fn unwritten(g: &mut Graph, _: &Guides, _: &Radiance) {
    let nothing = image(g, "nothing");
    run(g, "reader", &COPY, nothing, None);
}

fn too_early(g: &mut Graph, _: &Guides, noisy: &Radiance) {
    let late = image(g, "late");
    run(g, "reader", &COPY, late, None);
    run(g, "writer", &COPY, noisy.image(), Some(late));
}

fn cycle(g: &mut Graph, _: &Guides, _: &Radiance) {
    let a = image(g, "a");
    let b = run(g, "there", &COPY, a, None);
    run(g, "back", &COPY, b, Some(a));
}

fn two_writers(g: &mut Graph, _: &Guides, noisy: &Radiance) {
    let shared = run(g, "first", &COPY, noisy.image(), None);
    run(g, "second", &COPY, noisy.image(), Some(shared));
}

fn stale(g: &mut Graph, _: &Guides, noisy: &Radiance) {
    let before = run(g, "writer", &COPY, noisy.image(), None);
    run(g, "changer", &MIX, noisy.image(), Some(before));
    run(g, "reader", &COPY, before, None);
}

fn unwritten_history(g: &mut Graph, _: &Guides, _: &Radiance) {
    let kept = image(g, "kept");
    g.stage(&COPY).previous("from", kept).add();
}

fn overwritten_history(g: &mut Graph, guides: &Guides, noisy: &Radiance) {
    let irradiance = g.demodulate(guides, noisy, Demodulate::default());
    let history = g.history(&irradiance, Feedback::Filtered);
    g.eaw(guides, &irradiance, Eaw { levels: 2, feedback: Some(history), ..Eaw::default() });
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, Accumulation::default());
    g.variance(guides, &accumulated, &history, Variance::default());
}

fn previous_of_an_output(g: &mut Graph, _: &Guides, noisy: &Radiance) {
    let shown = run(g, "writer", &COPY, noisy.image(), None);
    g.output("shown", &Irradiance::of(shown));
    g.stage(&COPY).previous("from", shown).add();
}

fn format(g: &mut Graph, guides: &Guides, _: &Radiance) {
    g.modulate(guides, &Irradiance::of(guides.guide), Modulate::default());
}

fn foreign(g: &mut Graph, guides: &Guides, _: &Radiance) {
    let foreign = Graph::new([4, 4]).radiance("noisy_radiance");
    g.demodulate(guides, &foreign, Demodulate::default());
}

fn twice(g: &mut Graph, _: &Guides, noisy: &Radiance) {
    run(g, "node", &COPY, noisy.image(), None);
    run(g, "node", &COPY, noisy.image(), None);
}

fn read_and_written(g: &mut Graph, _: &Guides, noisy: &Radiance) {
    let image = run(g, "writer", &COPY, noisy.image(), None);
    run(g, "both", &MIX, image, Some(image));
}
