//! A denoiser composed from nodes: what a host builds, what the presets are built with.
//!
//! A [`Graph`] collects nodes. A node is a method of the graph: it takes ports, adds its resources and passes, and returns ports. A
//! wrong wire does not compile, since ports are typed by what is in their images; what types cannot tell is an [`Error::Graph`] of
//! [`Graph::finish`] with the node, the port and what to do. The result is a [`Declaration`], plain data, which [`crate::Denoiser`]
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
//! Names of resources and passes are those of the node with the label of the signal behind it: `noisy_direct` gives
//! `moments_direct`. A node that stands twice in a graph for the same signal needs a [`Graph::scope`], whose name goes behind that.

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

pub use pass::Value;
pub use port::*;
#[cfg(feature = "host-stages")]
pub use stage::{Stage, StageCall, StageOutputs};

pub(crate) use pass::Pass;
pub(crate) use port::KeptLuminance;
pub(crate) use resources::{CONFIDENCE, HDR, HOST_COLOUR, HOST_ID, HOST_SCALAR, PACKED_32, PACKED_64};

use crate::config::{Config, Conventions};
use crate::contract::{Declaration, PassDecl, ResourceDecl, ResourceId, Setup};
use crate::error::Error;
use crate::frame_constants::Flags;
use crate::shaders::CONVENTIONS;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU32, Ordering};

/// Source of the history of an accumulation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Feedback {
    /// The accumulated picture itself. Keeps more detail.
    #[default]
    Accumulated,
    /// The output of the first level of a filter, as \[SVGF\] 4.1 has it: [`crate::nodes::Atrous::feedback`]. Takes more noise.
    Filtered,
}

/// Nodes that were composed so far.
#[derive(Debug)]
pub struct Graph {
    /// Tells the images of one graph from those of another.
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
    /// What a graph has to do so that a history is written.
    writer: Option<&'static str>,
}

impl Graph {
    /// An empty graph for images of an extent, with two frames in flight and default conventions.
    pub fn new(allocated_extent: [u32; 2]) -> Self {
        static KEYS: AtomicU32 = AtomicU32::new(0);
        let mut graph = Self {
            key: KEYS.fetch_add(1, Ordering::Relaxed),
            setup: Setup::new(allocated_extent),
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
        Self { setup: config.setup(), config: Some(*config), ..Self::new(config.allocated_extent) }
    }

    /// Sets the encodings of the host's guides. Default: [`Conventions::default`].
    pub fn conventions(self, conventions: Conventions) -> Self {
        Self { setup: Setup { conventions, ..self.setup }, ..self }
    }

    /// Frames that the host records before it waits for the oldest, 1 to 8. Default: 2.
    pub fn frames_in_flight(self, frames_in_flight: u32) -> Self {
        Self { setup: Setup { frames_in_flight, ..self.setup }, ..self }
    }

    /// Sets whether transients may lie in the images of outputs, before an output itself is written and in the same phase: 8 bytes a
    /// pixel for most graphs. Not for a host that still reads the output of the frame before while that phase runs, or that wants
    /// to see every transient. Default: true.
    pub fn share_outputs(self, share_outputs: bool) -> Self {
        Self { share_outputs, ..self }
    }

    /// Nodes of `body` under names of their own: `_name` stands behind the names of their resources and passes. For a node that
    /// stands twice in a graph. Inputs of the host keep their names, so that both read the same ones.
    pub fn scope<T>(&mut self, name: &str, body: impl FnOnce(&mut Self) -> T) -> T {
        self.scopes.push(name.to_owned());
        let result = body(self);
        self.scopes.pop();
        result
    }

    /// Gives the host an image: it becomes an output of this name, which the host allocates and reads.
    pub fn output<K>(&mut self, name: &str, port: &Port<K>) {
        self.output_image(name, port.image());
        if port.signals() > 1 {
            self.fail("output", name, "two signals were given; give one name to each: `Port::of(port.images()[1])`".to_owned());
        }
    }

    /// The graph as plain data.
    ///
    /// # Errors
    /// [`Error::Extent`] and [`Error::Config`] for extents and frames in flight that are out of range; [`Error::Graph`] names node,
    /// port and remedy: an image of another graph, stale content, a read of what nothing writes, a cycle, two writers, a history
    /// that nothing writes, a format that does not fit, a name that is taken.
    pub fn finish(mut self) -> Result<Declaration, Error> {
        self.setup.validate()?;
        if self.errors.is_empty() {
            self.check();
        }
        if self.errors.is_empty() && self.share_outputs {
            self.put_transients_into_outputs();
        }
        let Self { setup, config, resources, mut passes, errors, .. } = self;
        let conventions = Flags::of(&setup.conventions, false);
        passes.iter_mut().for_each(|pass| pass.set_constant(CONVENTIONS, conventions));
        errors.into_iter().next().map_or(Ok(Declaration { setup, config, resources, passes }), Err)
    }

    /// Notes an error of a node. The first one is the one that [`Self::finish`] returns, since later ones may follow from it.
    pub(crate) fn fail(&mut self, node: &str, port: &str, problem: String) {
        self.errors.push(Error::Graph { node: node.to_owned(), port: port.to_owned(), problem });
    }
}
