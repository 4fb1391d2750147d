//! What the tracker tells of states, owners and layouts, one by one.

use super::*;
use crate::config::Config;
use crate::contract::{FrameParams, FrameState, Tuning};
use vk::{AccessFlags2 as A, ImageLayout as L, PipelineStageFlags2 as S};

const GRAPHICS: u32 = 0;
const COMPUTE: u32 = 1;

fn declaration() -> Declaration {
    Config::new([64, 36]).declare().expect("valid")
}

fn frame(declaration: &Declaration) -> FrameContext {
    FrameState::default()
        .begin(declaration.setup(), &FrameParams::new(declaration.allocated_extent()), &Tuning::default())
        .expect("valid")
}

fn barriers_of(barriers: &[Barrier], id: ResourceId) -> Vec<Barrier> {
    let is_of = |b: &&Barrier| match b.target {
        BarrierTarget::Memory => false,
        BarrierTarget::Image { resource, .. } | BarrierTarget::Buffer { resource, .. } => resource == id,
    };
    barriers.iter().filter(is_of).copied().collect()
}

/// Barriers of a resource in a whole frame, in order.
fn of_a_frame(tracker: &mut Tracker, declaration: &Declaration, id: ResourceId) -> Vec<Barrier> {
    let frame = frame(declaration);
    (0..declaration.passes().len()).flat_map(|pass| barriers_of(tracker.barriers(pass, &frame), id)).collect()
}

/// A depth image of the host, behind its G-buffer pass.
fn depth(declaration: &Declaration) -> ResourceId {
    declaration.find("depth").expect("an input")
}

const DRAWN: ResourceState =
    ResourceState::new(S::LATE_FRAGMENT_TESTS, A::DEPTH_STENCIL_ATTACHMENT_WRITE, L::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);

#[test]
fn what_is_left_out_has_no_barrier() {
    let declaration = declaration();
    let mut tracker = Tracker::new(&declaration);
    assert_eq!(of_a_frame(&mut tracker, &declaration, depth(&declaration)), []);
    assert_eq!(tracker.state(depth(&declaration), 0), None);
}

#[test]
fn a_shared_input_comes_from_one_state_and_goes_to_another() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    let lit = ResourceState::new(S::FRAGMENT_SHADER, A::SHADER_SAMPLED_READ, L::SHADER_READ_ONLY_OPTIMAL);
    tracker.share(id, DRAWN, lit);
    for _ in 0..2 {
        let read = of_a_frame(&mut tracker, &declaration, id);
        assert_eq!(read.first().map(|b| (b.from, b.to, b.discard)), Some((DRAWN, Access::Sampled.into(), false)));
        assert_eq!(
            barriers_of(tracker.hand_back(), id).iter().map(|b| (b.from.layout, b.to)).collect::<Vec<_>>(),
            [(L::SHADER_READ_ONLY_OPTIMAL, lit)]
        );
        assert_eq!((tracker.state(id, 0), tracker.hand_back()), (Some(DRAWN), &[][..]), "it is the host's again");
    }
}

#[test]
fn a_depth_image_that_may_be_sampled_stays_where_it_is() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    for layout in [L::DEPTH_STENCIL_READ_ONLY_OPTIMAL, L::READ_ONLY_OPTIMAL, L::SHADER_READ_ONLY_OPTIMAL] {
        let before = ResourceState { layout, ..DRAWN };
        tracker.share(id, before, before);
        let barriers = of_a_frame(&mut tracker, &declaration, id);
        assert!(!barriers.is_empty() && barriers.iter().all(|b| b.from.layout == layout && b.to.layout == layout), "{barriers:?}");
        assert_eq!(tracker.state(id, 0).map(|state| state.layout), Some(layout));
    }
    tracker.share(id, ResourceState { layout: L::GENERAL, ..DRAWN }, DRAWN);
    assert_eq!(of_a_frame(&mut tracker, &declaration, id)[0].to.layout, L::SHADER_READ_ONLY_OPTIMAL);
}

#[test]
fn ownership_is_released_by_one_family_and_acquired_by_the_other() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    let drawn = DRAWN.owned_by(GRAPHICS);
    tracker.share(id, drawn, drawn);
    tracker.set_queue_family(COMPUTE);
    let releases = tracker.releases(Phase::BeforeLighting, &frame(&declaration), COMPUTE);
    assert_eq!(releases.len(), 1, "nothing else has an owner: {releases:?}");
    let acquired = of_a_frame(&mut tracker, &declaration, id);
    let transfers: Vec<_> = acquired.iter().filter(|b| b.queue_families().is_some()).collect();
    let (given, taken) = (releases[0], *transfers[0]);
    assert_eq!(transfers.len(), 1);
    assert_eq!((given.queue_families(), taken.queue_families()), (Some([GRAPHICS, COMPUTE]), Some([GRAPHICS, COMPUTE])));
    assert_eq!((given.old_layout(), given.to.layout), (taken.old_layout(), taken.to.layout), "both halves name the same layouts");
    assert_eq!((given.from.stage, given.to.stage, given.to.access), (DRAWN.stage, S::NONE, A::NONE));
    assert_eq!((taken.from.stage, taken.from.access, taken.to.access), (S::COMPUTE_SHADER, A::NONE, A::SHADER_SAMPLED_READ));

    let back = barriers_of(tracker.hand_back(), id);
    let again = barriers_of(tracker.given_back(), id);
    assert_eq!((back.len(), again.len()), (1, 1));
    assert_eq!((back[0].queue_families(), back[0].to.stage), (Some([COMPUTE, GRAPHICS]), S::NONE));
    assert_eq!((again[0].queue_families(), again[0].to.stage), (Some([COMPUTE, GRAPHICS]), DRAWN.stage));
    assert_eq!((back[0].old_layout(), back[0].to.layout), (again[0].old_layout(), again[0].to.layout));
}

#[test]
fn ownership_does_not_change_within_a_family_or_without_content() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    tracker.share(id, DRAWN.owned_by(COMPUTE), DRAWN.owned_by(COMPUTE));
    tracker.set_queue_family(COMPUTE);
    assert!(of_a_frame(&mut tracker, &declaration, id).iter().all(|b| b.queue_families().is_none()));
    let output = declaration.find("denoised_radiance").expect("an output");
    tracker.set_state(output, 0, DRAWN.owned_by(GRAPHICS));
    let written = of_a_frame(&mut tracker, &declaration, output);
    assert!(written[0].discard && written[0].queue_families().is_none(), "{written:?}");
}

#[test]
fn a_use_of_the_host_comes_between() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    let uploaded = tracker.access(id, 0, Access::Clear.into(), true).to_vec();
    assert_eq!(uploaded.iter().map(|b| (b.old_layout(), b.to)).collect::<Vec<_>>(), [(L::UNDEFINED, Access::Clear.into())]);
    assert_eq!(of_a_frame(&mut tracker, &declaration, id)[0].from, Access::Clear.into());
    let unknown = ResourceId(u32::MAX);
    assert_eq!(tracker.access(unknown, 0, Access::Clear.into(), true), []);
    assert_eq!(tracker.access(id, 2, Access::Clear.into(), true), []);
    assert_eq!(tracker.barriers(usize::MAX, &frame(&declaration)), []);
}

#[test]
fn every_kind_of_read_waits_for_the_write_and_only_once() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), declaration.find("instance_transforms").expect("a buffer"));
    tracker.access(id, 0, Access::Clear.into(), true);
    let read = ResourceState::of(Access::StorageRead);
    let scopes = |barriers: &[Barrier]| barriers.iter().map(|b| (b.from.stage, b.to.stage, b.to.access)).collect::<Vec<_>>();
    let (compute, all) = (S::COMPUTE_SHADER, S::COMPUTE_SHADER | S::ALL_TRANSFER);
    assert_eq!(
        scopes(tracker.access(id, 0, read, false)),
        [(ResourceState::of(Access::Clear).stage, compute, A::SHADER_STORAGE_READ)]
    );
    assert_eq!(scopes(tracker.access(id, 0, read, false)), []);
    let copied = scopes(tracker.access(id, 0, ResourceState::COPY_SOURCE, false));
    assert_eq!(copied, [(compute, all, A::SHADER_STORAGE_READ | A::TRANSFER_READ)]);
    assert_eq!(scopes(tracker.access(id, 0, read, false)), []);
    // Everything may read what the host made visible to everything, or wrote itself.
    for before in [(S::ALL_COMMANDS, A::MEMORY_READ), (S::COMPUTE_SHADER, A::SHADER_READ), (S::HOST, A::HOST_WRITE)] {
        tracker.set_state(id, 0, ResourceState::new(before.0, before.1, L::UNDEFINED));
        assert_eq!(scopes(tracker.access(id, 0, read, false)), [], "{before:?}");
    }
}

#[test]
fn a_write_waits_for_every_read_before_it() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), declaration.find("frame_constants").expect("a buffer"));
    let read = |stage| ResourceState::new(stage, A::SHADER_STORAGE_READ, L::UNDEFINED);
    assert_eq!(tracker.access(id, 0, read(S::FRAGMENT_SHADER), false), []);
    assert_eq!(tracker.access(id, 0, read(S::VERTEX_SHADER), false), []);
    let written = tracker.access(id, 0, Access::Clear.into(), true);
    assert_eq!(written.iter().map(|b| b.from.stage).collect::<Vec<_>>(), [S::FRAGMENT_SHADER | S::VERTEX_SHADER]);
}

#[test]
fn an_engine_with_one_layout_has_barriers_of_memory_alone() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    tracker.stay_in_general = true;
    let general = ResourceState::new(S::ALL_COMMANDS, A::MEMORY_WRITE, L::GENERAL);
    let buffers = |b: &&Barrier| !matches!(b.target, BarrierTarget::Buffer { .. });
    for index in 0..3 {
        tracker.share(id, general, general);
        let frame = FrameContext { index, ..frame(&declaration) };
        for pass in 0..declaration.passes().len() {
            let barriers = tracker.barriers(pass, &frame).to_vec();
            assert!(barriers.iter().filter(buffers).all(|b| b.to.layout == L::GENERAL), "{barriers:?}");
            assert_eq!(barriers_of(&barriers, id), [], "those of the host's image");
            // Those of the device itself come from no layout once, and where they share memory.
            let moved = barriers.iter().filter(buffers).filter(|b| b.target != BarrierTarget::Memory);
            assert!(moved.clone().all(|b| b.old_layout() == L::UNDEFINED), "{barriers:?}");
        }
        let back = tracker.hand_back();
        assert!(!back.is_empty() && back.iter().all(|b| b.target == BarrierTarget::Memory), "{back:?}");
    }
}

#[test]
fn bindings_stand_in_the_order_of_the_uses() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    let frame = frame(&declaration);
    let import = declaration.passes().iter().position(|p| p.uses.iter().any(|u| u.resource == id)).expect("a pass");
    let buffer = PhysicalResource::buffer(vk::Buffer::null());
    let image = PhysicalResource::color(vk::Image::null(), vk::ImageView::null());
    let is_image = |id| matches!(declaration.resource(id).shape, Shape::Image { .. });
    let physical = |id, _| Some(if is_image(id) { image } else { buffer });
    let mut bindings = Vec::new();
    for depth_layout in [None, Some(L::DEPTH_STENCIL_READ_ONLY_OPTIMAL)] {
        if let Some(layout) = depth_layout {
            tracker.share(id, ResourceState { layout, ..DRAWN }, DRAWN);
        }
        tracker.barriers(import, &frame);
        tracker.bindings(import, &frame, physical, &mut bindings);
        let uses = &declaration.passes()[import].uses;
        assert_eq!(bindings.len(), uses.len());
        for (u, binding) in uses.iter().zip(&bindings) {
            let is_left_out = matches!(declaration.resource(u.resource).lifetime, Lifetime::Input { .. });
            let expected = match (u.resource == id, depth_layout, is_image(u.resource)) {
                (true, Some(layout), _) => Binding::Image { view: vk::ImageView::null(), layout },
                _ if is_left_out => Binding::Absent,
                (.., false) => Binding::Buffer { buffer: vk::Buffer::null(), offset: 0, range: vk::WHOLE_SIZE },
                (.., true) => Binding::Image { view: vk::ImageView::null(), layout: u.access.image().layout },
            };
            assert_eq!(*binding, expected, "{}", declaration.resource(u.resource).name);
        }
    }
}

#[test]
fn legacy_scopes_are_those_of_the_accesses() {
    for access in Access::ALL {
        assert_eq!(ResourceState::of(access).legacy_scope(), access.legacy_scope(), "{access:?}");
    }
    let legacy = |stage, access| ResourceState::new(stage, access, L::UNDEFINED).legacy_scope();
    use vk::{AccessFlags as OldA, PipelineStageFlags as OldS};
    assert_eq!(
        legacy(S::LATE_FRAGMENT_TESTS, A::DEPTH_STENCIL_ATTACHMENT_WRITE),
        (OldS::LATE_FRAGMENT_TESTS, OldA::DEPTH_STENCIL_ATTACHMENT_WRITE)
    );
    assert_eq!(legacy(S::COPY | S::FRAGMENT_SHADER, A::TRANSFER_READ).0, OldS::TRANSFER | OldS::FRAGMENT_SHADER);
    assert_eq!(legacy(S::RAY_TRACING_SHADER_KHR, A::SHADER_STORAGE_WRITE), (OldS::ALL_COMMANDS, OldA::SHADER_WRITE));
    assert_eq!(legacy(S::NONE, A::NONE), (OldS::empty(), OldA::empty()));
}

#[test]
fn writes_are_told_from_reads() {
    let writes = |access| ResourceState::new(S::ALL_COMMANDS, access, L::GENERAL).writes();
    for access in [A::COLOR_ATTACHMENT_WRITE, A::MEMORY_WRITE, A::ACCELERATION_STRUCTURE_WRITE_KHR, A::VIDEO_DECODE_WRITE_KHR] {
        assert!(writes(access | A::SHADER_READ), "{access:?}");
    }
    for access in [A::NONE, A::HOST_WRITE, A::MEMORY_READ, A::SHADER_SAMPLED_READ | A::UNIFORM_READ] {
        assert!(!writes(access), "{access:?}");
    }
}

#[test]
fn arguments_name_what_the_host_has() {
    let declaration = declaration();
    let (mut tracker, id) = (Tracker::new(&declaration), depth(&declaration));
    tracker.share(id, DRAWN, DRAWN);
    let frame = frame(&declaration);
    let (mut new, mut old) = (Barriers2::default(), LegacyBarriers::default());
    let aspects = vk::ImageAspectFlags::DEPTH;
    let subresource = Subresource { layer: 3, level: 1 };
    let image = PhysicalResource::Image { image: vk::Image::null(), view: vk::ImageView::null(), aspects, subresource };
    let physical = |resource, _| (resource == id).then_some(image);
    let import = declaration.passes().iter().position(|p| p.uses.iter().any(|u| u.resource == id)).expect("a pass");
    let barriers = tracker.barriers(import, &frame);
    assert!(barriers.len() > 1);
    new.set(barriers, physical);
    old.set(barriers, physical);
    assert_eq!((new.images.len(), new.buffers.len(), new.memory.len()), (1, 0, 0));
    for range in [new.images[0].subresource_range, old.images[0].subresource_range] {
        assert_eq!((range.aspect_mask, range.base_array_layer, range.base_mip_level), (aspects, 3, 1));
        assert_eq!((range.layer_count, range.level_count), (1, 1));
    }
    assert_eq!(
        (old.images.len(), old.src_stage, old.dst_stage),
        (1, vk::PipelineStageFlags::LATE_FRAGMENT_TESTS, vk::PipelineStageFlags::COMPUTE_SHADER)
    );
    assert!(old.memory.is_empty() && old.buffers.is_empty());
    assert_eq!(new.dependency_info().image_memory_barrier_count, 1);
    old.set(&[], physical);
    assert!(old.is_empty() && old.src_stage == vk::PipelineStageFlags::TOP_OF_PIPE);
}
