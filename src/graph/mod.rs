//! A denoiser composed from nodes. The presets are built in this way, and so are graphs of your
//! own.
//!
//! A [`Graph`] collects nodes. A node is a method of the graph: it takes ports, adds its resources
//! and passes, and returns ports. A wrong wire does not compile, since ports are typed by the
//! content of their images. Every other mistake is an [`Error::Graph`] of [`Graph::finish`] with
//! node, port and remedy. The result is a [`Declaration`], plain data, which [`crate::Denoiser`]
//! records on a GPU and [`crate::reference::Engine`] runs on the CPU.
//!
//! ```
//! use atrous::graph::{Feedback, Graph};
//! use atrous::nodes::{Accumulation, Atrous, Import, Modulate, Variance};
//!
//! let mut g = Graph::new([1920, 1080]);
//! let guides = g.import(Import::default());
//! let noisy = g.radiance("noisy_radiance");
//! let irradiance = g.demodulate(&guides, &noisy, Default::default());
//! let history = g.history(&irradiance, Feedback::Filtered);
//! let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
//! let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
//! let filtered = g.atrous(&guides, &estimate, Atrous { feedback: Some(history), ..Default::default() });
//! let denoised = g.modulate(&guides, &filtered.into(), Modulate::default());
//! g.output("denoised_radiance", &denoised);
//! let declaration = g.finish()?;
//! # Ok::<(), atrous::Error>(())
//! ```
//!
//! Names of resources and passes are those of the node, followed by the label of the signal: for
//! example, `noisy_direct` gives `luminance_history_direct`. Put a node that appears twice for the same
//! signal into a [`Graph::scope`], whose name follows the label.

mod check;
mod matching;
mod pass;
mod passes;
mod port;
mod resources;
mod sharing;
#[cfg(feature = "host-stages")]
mod stage;
#[cfg(test)]
mod tests;
mod viewport;

pub use pass::Value;
pub use port::*;
#[cfg(feature = "host-stages")]
pub use stage::{Stage, StageCall, StageOutputs};

pub(crate) use pass::Pass;
pub(crate) use port::{KeptLuminance, Rendered};
pub(crate) use resources::{CONFIDENCE, HDR, PACKED_128, PACKED_32, PACKED_64, WIDE_HDR};

use crate::choice::choices;
use crate::config::Config;
use crate::contract::{Declaration, PassDecl, ResourceDecl, ResourceId, Setup};
use crate::error::Error;
use crate::frame_constants::Flags;
use crate::shaders::CONVENTIONS;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU32, Ordering};

choices! {
    /// Source of the history of an accumulation.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Feedback {
        /// The accumulated picture itself. Keeps more detail.
        #[default]
        Accumulated = 0 => "accumulated",
        /// The output of the first level of a filter, as in \[SVGF\] 4.1:
        /// [`crate::nodes::Atrous::feedback`]. Removes more noise.
        Filtered = 1 => "filtered",
    }
}

/// Nodes that were composed so far.
#[derive(Clone, Debug)]
pub struct Graph {
    /// Distinguishes the images of this graph from those of other graphs.
    key: u32,
    setup: Setup,
    config: Option<Config>,
    resources: Vec<ResourceDecl>,
    passes: Vec<PassDecl>,
    /// Facts beyond the declaration, by resource.
    states: Vec<ResourceState>,
    /// The node of each pass, by pass.
    owners: Vec<String>,
    nodes: BTreeSet<String>,
    scopes: Vec<String>,
    errors: Vec<Error>,
    constants: ResourceId,
    statistics: ResourceId,
    share_outputs: bool,
}

/// Facts about a resource that its declaration does not have.
#[derive(Clone, Debug, Default)]
struct ResourceState {
    /// Passes that have written it.
    version: u32,
    /// Label behind the names of resources and passes of its signal; empty for the only one.
    label: String,
    /// The node that a graph needs so that a history is written.
    writer: Option<&'static str>,
}

impl Graph {
    /// An empty graph for images of an extent, with two frames in flight and default conventions.
    pub fn new(allocated_extent: [u32; 2]) -> Self {
        Self::of(Setup::new(allocated_extent))
    }

    /// An empty graph with extents, conventions and frames in flight of your own: for example light of half the extent, or a picture
    /// that is a part of your images. [`Config::setup`] has those of a configuration.
    pub fn of(setup: Setup) -> Self {
        static KEYS: AtomicU32 = AtomicU32::new(0);
        let mut graph = Self {
            key: KEYS.fetch_add(1, Ordering::Relaxed),
            setup,
            config: None,
            resources: Vec::new(),
            passes: Vec::new(),
            states: Vec::new(),
            owners: Vec::new(),
            nodes: BTreeSet::new(),
            scopes: Vec::new(),
            errors: Vec::new(),
            constants: ResourceId(0),
            statistics: ResourceId(0),
            share_outputs: true,
        };
        graph.start_frame();
        graph
    }

    /// The graph of a preset: extents, conventions and frames in flight of a configuration.
    pub(crate) fn of_config(config: &Config) -> Self {
        Self { config: Some(*config), ..Self::of(config.setup()) }
    }

    /// Whether light has fewer pixels than the guides.
    pub(crate) fn has_light_extent(&self) -> bool {
        self.setup.light_ratio() != [1; 2]
    }

    /// Whether the output has a size of its own.
    pub(crate) fn has_output_extent(&self) -> bool {
        self.setup.output_extent.is_some()
    }

    /// Whether light comes divided by the albedo.
    pub(crate) fn gets_irradiance(&self) -> bool {
        self.setup.conventions.demodulated
    }

    /// Sets whether transients may lie in the images of outputs, before an output itself is written
    /// and in the same phase. It saves 8 bytes per pixel in most graphs. Turn it off if you still
    /// read the output of the previous frame while that phase runs, or want to see every transient.
    /// Default: true.
    pub fn share_outputs(self, share_outputs: bool) -> Self {
        Self { share_outputs, ..self }
    }

    /// Gives the nodes of `body` names of their own: `_name` follows the names of their resources
    /// and passes. Use it for a node that appears twice in a graph. Your inputs keep their names,
    /// so that both nodes read the same ones.
    pub fn scope<T>(&mut self, name: &str, body: impl FnOnce(&mut Self) -> T) -> T {
        self.scopes.push(name.to_owned());
        let result = body(self);
        self.scopes.pop();
        result
    }

    /// Makes an image an output of this name, which you allocate and read.
    pub fn output<K>(&mut self, name: &str, port: &Port<K>) {
        self.output_image(name, port.image());
        if port.signals() > 1 {
            self.fail("output", name, "two signals were given; give one name to each: `Port::of(port.images()[1])`".to_owned());
        }
    }

    /// The graph as plain data.
    ///
    /// # Errors
    /// [`Error::Extent`] and [`Error::Config`] for extents and frames in flight that are out of
    /// range; [`Error::Graph`] names node, port and remedy: for example an image of a different
    /// graph, stale content, a read of unwritten content, a cycle, two writers, an unwritten
    /// history, a wrong format, or a name that is taken.
    pub fn finish(mut self) -> Result<Declaration, Error> {
        self.setup.validate()?;
        if self.errors.is_empty() {
            self.check();
        }
        // Of an image with other views every texel is kept.
        if self.errors.is_empty() && self.share_outputs && self.setup.image_extent.is_none() {
            self.put_transients_into_outputs();
        }
        self.mark_parts_of_images();
        let Self { setup, config, resources, mut passes, errors, .. } = self;
        let conventions = Flags::of(&setup.conventions, false);
        passes.iter_mut().for_each(|pass| pass.set_constant(CONVENTIONS, conventions));
        errors.into_iter().next().map_or(Ok(Declaration { setup, config, resources, passes }), Err)
    }

    /// Notes an error of a node. [`Self::finish`] returns the first one, since later ones may
    /// follow from it.
    pub(crate) fn fail(&mut self, node: &str, port: &str, problem: String) {
        self.errors.push(Error::Graph { node: node.to_owned(), port: port.to_owned(), problem });
    }
}
