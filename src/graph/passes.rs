//! Passes of a graph: the names of its nodes, the uses of each pass, and whether the content of an
//! image is still the same.

use super::matching::{self, Automatic};
use super::pass::{Pass, Wire};
use super::{Graph, Image};
use crate::contract::{Access, Lifetime, PassDecl, Phase, ResourceId, Shape, Use, UseFrame, Work};

impl Graph {
    /// The name of an instance of a node, which is in the graph once.
    pub(crate) fn node(&mut self, base: &str, label: &str) -> String {
        let name = self.scoped(base, label);
        if !self.nodes.insert(name.clone()) {
            let problem = "it is in the graph already for the same signal; put the second one into a `Graph::scope`, or give its signal a name of its own";
            self.fail(&name, "name", problem.to_owned());
        }
        name
    }

    /// The first pass of every graph. By `vkCmdUpdateBuffer`, so that no host-visible memory and no copy per slot is needed.
    pub(super) fn start_frame(&mut self) {
        use crate::contract::STATISTICS_BYTES;
        let constants = self.buffer("frame_constants", size_of::<crate::FrameConstants>() as u64, Lifetime::Transient);
        let statistics = self.buffer("statistics", STATISTICS_BYTES, Lifetime::Output);
        let uses = [constants, statistics].map(|resource| Use { resource, frame: UseFrame::Current, access: Access::Clear });
        self.push_pass(
            "start_frame",
            PassDecl { name: "start_frame".to_owned(), phase: Phase::BeforeLighting, uses: uses.to_vec(), work: Work::StartFrame },
        );
        (self.constants, self.statistics) = (constants, statistics);
    }

    /// Adds a dispatch: matches its images with the bindings of the shader.
    pub(crate) fn add(&mut self, pass: Pass) {
        for (binding, wire) in &pass.wires {
            if let Some(problem) = self.refusal(wire) {
                return self.fail(&pass.node, binding, problem);
            }
            let resource = &mut self.resources[wire.image.id.0 as usize];
            if wire.frame == UseFrame::Previous && resource.lifetime == Lifetime::Transient {
                resource.lifetime = Lifetime::History;
            }
        }
        let of_name = self.passes.iter().filter_map(|p| p.shader()).find(|shader| shader.name == pass.shader.name);
        if of_name.is_some_and(|other| *other != *pass.shader) {
            // Pipelines, and code that is replaced, are found by this name.
            let problem = format!("another shader is called `{}` as well; give one of them another name", pass.shader.name);
            return self.fail(&pass.node, "shader", problem);
        }
        let automatic = Automatic { frame: self.current(self.constants), statistics: self.current(self.statistics) };
        match matching::declare(&pass, &automatic, &self.resources) {
            Ok(declared) => {
                if let Some((binding, problem)) = pass.wires.iter().find_map(|(binding, wire)| self.stale(binding, wire, &declared))
                {
                    return self.fail(&pass.node, &binding, problem);
                }
                self.push_pass(&pass.node, declared);
            }
            Err(matching::Mismatch { port, problem }) => self.fail(&pass.node, &port, problem),
        }
    }

    /// The pass that wrote what an image holds now.
    pub(crate) fn writer_of(&self, image: Image) -> Option<&PassDecl> {
        self.last_writer(image.id).map(|pass| &self.passes[pass])
    }

    /// Whether a constant of the pass that wrote an image is 1: it says how the image is to be read.
    pub(crate) fn writer_has(&self, image: Image, constant: &str) -> bool {
        let pipeline = self.writer_of(image).and_then(PassDecl::pipeline);
        pipeline.is_some_and(|pipeline| pipeline.constants.iter().any(|c| c.name == constant && c.bits == 1))
    }

    fn last_writer(&self, id: ResourceId) -> Option<usize> {
        self.passes.iter().rposition(|pass| pass.uses.iter().any(|u| u.resource == id && u.access.writes()))
    }

    /// The reason why an image cannot be wired, whatever the shader does with it.
    fn refusal(&self, wire: &Wire) -> Option<String> {
        match wire.image {
            Image::NONE => {
                Some("there is no such image; the stage that was asked for it writes no binding of that name".to_owned())
            }
            image => {
                (image.graph != self.key).then(|| "the image belongs to another graph; build both parts in one graph".to_owned())
            }
        }
    }

    /// The binding whose image has other content than when the value was made, and the reason.
    fn stale(&self, binding: &str, wire: &Wire, pass: &PassDecl) -> Option<(String, String)> {
        let reads = pass.use_of(binding).is_some_and(|u| u.access.reads());
        let id = wire.image.id;
        if wire.frame == UseFrame::Previous || !reads || wire.image.version == self.states[id.0 as usize].version {
            return None;
        }
        let writer = self.last_writer(id).map_or("a later node", |pass| &self.owners[pass]);
        let name = &self.resources[id.0 as usize].name;
        Some((binding.to_owned(), format!("`{name}` was overwritten by `{writer}`; take what that node returned")))
    }

    fn push_pass(&mut self, node: &str, pass: PassDecl) {
        for u in &pass.uses {
            let resource = &mut self.resources[u.resource.0 as usize];
            match resource.shape {
                Shape::Image { .. } => resource.image_usage |= u.access.image_usage(),
                Shape::Buffer { .. } => resource.buffer_usage |= u.access.buffer_usage(),
            }
            if u.access.writes() {
                self.states[u.resource.0 as usize].version += 1;
            }
        }
        self.passes.push(pass);
        self.owners.push(node.to_owned());
    }
}
