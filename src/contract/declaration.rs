//! The declaration of a denoiser: its resources and its passes in order.

use super::{Access, FrameContext, Lifetime, Parameter, ResourceDecl, ResourceId, Setup, Shape, Tuning, TuningField, Work};
use crate::config::Config;
use crate::error::Error;
use ash::vk;

/// The place of a pass in your frame.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum Phase {
    /// After your G-buffer and before light transport.
    BeforeLighting = 0,
    /// After light transport.
    AfterLighting = 1,
    /// Where you do tone mapping and anti-aliasing.
    PostProcess = 2,
}

impl Phase {
    /// Every phase, in order.
    pub const ALL: [Self; 3] = [Self::BeforeLighting, Self::AfterLighting, Self::PostProcess];
}

/// The copy of a history that a use refers to. Every other resource is always `Current`.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum UseFrame {
    /// The copy of this frame.
    Current = 0,
    /// The copy of the previous frame.
    Previous = 1,
}

/// The use of one resource by a pass. The uses of a pass are in the order of its binding numbers.
/// Give your bindings in the same order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// The resource.
    pub resource: ResourceId,
    /// The copy of it.
    pub frame: UseFrame,
    /// The access to it.
    pub access: Access,
}

/// The smallest unit that you schedule: one dispatch, or the upload that starts a frame. It is free
/// of hazards inside; every barrier belongs between passes.
#[derive(Clone, Debug)]
pub struct PassDecl {
    /// Unique in a denoiser: for labels and profiles.
    pub name: String,
    /// Place in the frame.
    pub phase: Phase,
    /// Resources that the pass touches.
    pub uses: Vec<Use>,
    pub(crate) work: Work,
}

/// Resources and passes: plain data, made without a device.
#[derive(Clone, Debug)]
pub struct Declaration {
    pub(crate) setup: Setup,
    /// The configuration that a preset was declared from; `None` for a graph of a host.
    pub(crate) config: Option<Config>,
    pub(crate) resources: Vec<ResourceDecl>,
    pub(crate) passes: Vec<PassDecl>,
}

impl Declaration {
    /// Every resource; [`ResourceId`] is an index into it.
    pub fn resources(&self) -> &[ResourceDecl] {
        &self.resources
    }

    /// Every pass, in the order in which they must run.
    pub fn passes(&self) -> &[PassDecl] {
        &self.passes
    }

    /// The indices of the passes of a phase, in order.
    pub fn passes_of(&self, phase: Phase) -> impl Iterator<Item = usize> + '_ {
        (0..self.passes.len()).filter(move |&pass| self.passes[pass].phase == phase)
    }

    /// The extent that images are allocated with.
    pub fn allocated_extent(&self) -> [u32; 2] {
        self.setup.allocated_extent
    }

    /// The same graph for images of a different extent. It equals the declaration that you would
    /// get by building the graph for that extent with the same number of levels, which
    /// [`crate::Config::levels`] chooses by the extent. Shapes hold divisors of the extent, and no
    /// pass depends on it.
    ///
    /// # Errors
    /// [`Error::Extent`], as [`Config::declare`] and [`crate::graph::Graph::finish`] give it.
    pub fn with_extent(&self, allocated_extent: [u32; 2]) -> Result<Self, Error> {
        let light_extent = self.setup.light_for(allocated_extent);
        let setup = Setup { allocated_extent, light_extent, ..self.setup };
        setup.validate()?;
        let config = self.config.map(|config| Config { allocated_extent, light_extent, ..config });
        Ok(Self { setup, config, ..self.clone() })
    }

    /// The settings that are fixed for every frame.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The configuration of a preset; `None` for a graph that you composed.
    pub fn config(&self) -> Option<&Config> {
        self.config.as_ref()
    }

    /// The tunables that some pass reads, in the order of [`Tuning::FIELDS`]. Any other changes
    /// nothing. Those that only the debug view reads are left out.
    pub fn tunables(&self) -> impl Iterator<Item = &'static TuningField> + '_ {
        let filters = self.passes.iter().filter(|pass| !pass.draws_view()).filter_map(PassDecl::dispatch);
        let read: Vec<_> = filters.flat_map(|dispatch| dispatch.parameters.iter().copied()).collect();
        let is_read = move |(index, _): &(usize, &TuningField)| read.contains(&Parameter::Tuning(*index));
        Tuning::FIELDS.iter().enumerate().filter(is_read).map(|(_, field)| field)
    }

    /// Whether the host's path tracer has to shade the pixels again that `forward_project` picks.
    pub(crate) fn reshades(&self) -> bool {
        self.passes.iter().any(|pass| pass.stage() == Some("forward_project"))
    }

    /// Whether pixels without a gradient take the confidence of a change test.
    pub(crate) fn has_other_confidence(&self) -> bool {
        let is_tested = |pass: &PassDecl| ["other_confidence", "block_difference_0"].iter().any(|name| pass.use_of(name).is_some());
        self.passes.iter().any(|pass| pass.stage() == Some("history_confidence") && is_tested(pass))
    }

    /// A resource by name.
    ///
    /// # Errors
    /// [`Error::UnknownResource`] lists the names that exist.
    pub(crate) fn named(&self, name: &str) -> Result<ResourceId, Error> {
        self.find(name).ok_or_else(|| Error::UnknownResource {
            given: name.to_owned(),
            known: self.resources.iter().map(|r| r.name.as_str()).collect::<Vec<_>>().join(", "),
        })
    }

    /// An image by name, with its allocated extent, for as many texels of a format that are given row by row.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for a buffer, [`Error::Format`],
    /// [`Error::Size`] for a wrong number of texels.
    pub(crate) fn image_for(&self, name: &str, given: vk::Format, count: usize) -> Result<(ResourceId, [u32; 2]), Error> {
        let id = self.named(name)?;
        let resource = self.resource(id);
        let Shape::Image { format, .. } = resource.shape else {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an image" });
        };
        if !format.accepts(given) {
            return Err(Error::Format { resource: name.to_owned(), given, allowed: format.to_string() });
        }
        let extent = resource.extent(self.setup()).unwrap_or([1, 1]);
        let needed = extent[0] as usize * extent[1] as usize;
        if count != needed {
            let needed = format!("{needed} texels ({}x{})", extent[0], extent[1]);
            return Err(Error::Size { resource: name.to_owned(), given: format!("{count} texels"), needed });
        }
        Ok((id, extent))
    }

    /// The declaration of a resource.
    pub fn resource(&self, id: ResourceId) -> &ResourceDecl {
        &self.resources[id.0 as usize]
    }

    /// A resource by name.
    pub fn find(&self, name: &str) -> Option<ResourceId> {
        self.resources.iter().position(|r| r.name == name).map(|i| ResourceId(i as u32))
    }

    /// First and last pass that use any copy of a resource.
    pub fn life(&self, id: ResourceId) -> Option<(usize, usize)> {
        life(&self.passes, id)
    }

    /// Every transient with its first and last pass.
    pub(crate) fn transients(&self) -> impl Iterator<Item = (ResourceId, usize, usize)> + '_ {
        (0..self.resources.len() as u32).map(ResourceId).filter_map(|id| {
            let (first, last) = self.life(id)?;
            (self.resource(id).lifetime == Lifetime::Transient).then_some((id, first, last))
        })
    }

    /// The physical copy that a use refers to in a frame: 0 or 1.
    pub fn copy(&self, u: &Use, frame: &FrameContext) -> usize {
        match self.resource(u.resource).lifetime {
            Lifetime::History => frame.history_copy(u.frame),
            _ => 0,
        }
    }
}

/// First and last of the passes that use any copy of a resource.
pub(crate) fn life(passes: &[PassDecl], id: ResourceId) -> Option<(usize, usize)> {
    let touches = |pass: &PassDecl| pass.uses.iter().any(|u| u.resource == id);
    Some((passes.iter().position(touches)?, passes.iter().rposition(touches)?))
}

#[cfg(test)]
mod tests {
    use crate::config::{Config, PostProcess, Preset};

    #[test]
    fn a_preset_names_the_tunables_that_it_reads() {
        let read = |config: Config| -> Vec<&str> { config.declare().expect("valid").tunables().map(|field| field.name).collect() };
        let of = |preset| read(Config { preset, debug_view: true, ..Config::new([16, 16]) });
        assert_eq!(
            of(Preset::Eaw),
            ["eaw_sigma_radiance", "eaw_sigma_normal", "eaw_sigma_position"],
            "a view's alpha is none of its own"
        );
        for (preset, has, lacks) in [
            (Preset::Svgf, "sigma_l", "gradient_scale"),
            (Preset::Asvgf, "gradient_scale", "percentile_range"),
            (Preset::Asvgf, "sigma_z", "volume_sigma_z"),
            (Preset::Volume, "volume_sigma_z", "sigma_z"),
            (Preset::Volume, "volume_alpha", "normal_tolerance"),
            (Preset::Percentile, "percentile_range", "gradient_scale"),
            (Preset::Fast, "change_threshold", "eaw_sigma_radiance"),
            (Preset::Best, "change_threshold", "eaw_sigma_radiance"),
        ] {
            let names = of(preset);
            assert!(names.contains(&has) && !names.contains(&lacks), "{preset:?}: {names:?}");
        }
        let svgf = Config { preset: Preset::Svgf, ..Config::new([16, 16]) };
        assert!(!read(svgf).contains(&"taa_alpha"));
        assert!(read(Config { post_process: PostProcess::ToneMapTaa, ..svgf }).contains(&"taa_alpha"));
    }
}
