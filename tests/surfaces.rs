//! Surfaces that ask for something of their own: strands without normals, and things that the camera carries.

use super::support::rig::{whole, Rig};
use super::support::{assert_valid, frame, gpu, pixels, rmse, scene::Scene, session, svgf, svgf_tuning, upload};
use ash::vk;
use atrous::config::{Channel, Conventions, DepthEncoding, MotionUnit, Signals};
use atrous::executor::{ExecutorOptions, HostImage, Session};
use atrous::reference::InstanceTransform;
use atrous::{Config, Counter, FrameParams, Tuning, UseFrame};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("an_engine_like_blade_gives_the_same_picture", an_engine_like_blade_gives_the_same_picture),
    ("where_there_is_no_normal_depth_and_id_decide", where_there_is_no_normal_depth_and_id_decide),
    ("what_the_camera_carries_keeps_its_history", what_the_camera_carries_keeps_its_history),
];

const EXTENT: [u32; 2] = [48, 36];

/// Blade's encodings: everything in `GENERAL`, rays' lengths, motion in pixels times 0.02, light divided by the albedo, and one image
/// with the reflectance at normal incidence and the roughness.
fn an_engine_like_blade_gives_the_same_picture() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let plain = Config { signals: Signals::Specular, ..Config::new(EXTENT) };
    let conventions = Conventions {
        depth: DepthEncoding::RayLength,
        motion_unit: MotionUnit::Pixels,
        motion_scale: 50.0,
        roughness_channel: Channel::A,
        demodulated: true,
        ..Conventions::default()
    };
    let options = ExecutorOptions { stay_in_general: true, extra_image_usage: usage(), ..Default::default() };
    let mut engine = Rig::with_options(gpu(), &Config { conventions, ..plain }, 1, options);
    let mut expected = session(&plain);
    let texels = (EXTENT[0] * EXTENT[1]) as usize;
    let (staging, result) = (engine.staging(9 * texels * 16), engine.staging(texels * 8));
    let general = (vk::PipelineStageFlags2::ALL_COMMANDS, vk::AccessFlags2::MEMORY_WRITE | vk::AccessFlags2::MEMORY_READ);
    let wide = vk::Format::R32G32B32A32_SFLOAT;
    let images = engine.layers(wide, EXTENT, vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST, 8);
    let ids = engine.image("ids", vk::Format::R32_UINT, EXTENT, vk::ImageAspectFlags::COLOR, usage());
    let lent = |image: HostImage| HostImage { layout: vk::ImageLayout::GENERAL, stage: general.0, access: general.1, ..image };
    let names = ["depth", "normal", "motion", "albedo", "noisy_diffuse", "noisy_specular", "specular_hit_distance", "specular_f0"];
    for (name, image) in names.iter().zip(&images).chain([(&"roughness", &images[7]), (&"surface_id", &ids)]) {
        engine.executor.bind_image(name, lent(*image)).expect(name);
    }
    for name in ["specular_albedo", "emission", "specular_hit_id", "specular_motion"] {
        engine.executor.unbind(name).expect(name);
    }
    for i in 0..4 {
        let (mut guides, params) = (scene.frame(i, i), scene.params(i));
        guides.albedo.fill([0.5, 0.25, 0.5, 1.0]);
        upload(&mut expected, &guides);
        expected.upload("specular_f0", &guides.specular_albedo).expect("specular_f0");
        for name in ["specular_albedo", "emission"] {
            expected.unbind(name).expect(name);
        }
        expected.run(&params, &Tuning::default()).expect("a frame");
        let clip = params.clip_from_view;
        let of_blade = |name: &str, k: usize, (x, y): (u32, u32)| match name {
            "depth" => {
                let ndc = |p: u32, side: usize| (p as f32 + 0.5 + params.jitter[side]) / EXTENT[side] as f32 * 2.0 - 1.0;
                let ray = [ndc(x, 0) / clip[0][0], ndc(y, 1) / clip[1][1], 1.0];
                [guides.depth[k][0] * ray.map(|c| c * c).iter().sum::<f32>().sqrt(); 4]
            }
            "normal" => guides.normal[k],
            "motion" => [guides.motion[k][0] * EXTENT[0] as f32 * 0.02, guides.motion[k][1] * EXTENT[1] as f32 * 0.02, 0.0, 0.0],
            "albedo" => guides.albedo[k],
            "noisy_diffuse" if guides.depth[k][0] == 0.0 => guides.noisy_diffuse[k],
            "noisy_diffuse" => std::array::from_fn(|c| guides.noisy_diffuse[k][c] / guides.albedo[k][c]),
            "noisy_specular" => guides.noisy_specular[k],
            "specular_hit_distance" => guides.specular_hit_distance[k],
            _ => [0, 1, 2, 3].map(|c| if c == 3 { guides.roughness[k][0] } else { guides.specular_albedo[k][c] }),
        };
        let mut bytes: Vec<u8> = Vec::new();
        for name in names {
            for (k, pixel) in pixels(EXTENT).enumerate() {
                bytes.extend_from_slice(bytemuck::cast_slice(&of_blade(name, k, pixel)));
            }
        }
        bytes.extend_from_slice(bytemuck::cast_slice(&guides.surface_id));
        // SAFETY: the buffer is mapped and this large.
        unsafe { staging.1.copy_from_nonoverlapping(bytes.as_ptr(), bytes.len()) };
        let frame = engine.executor.begin_frame(&params, &Tuning::default()).expect("a frame");
        engine.submit(|rig, cmd| {
            let all = images.iter().chain([&ids]).enumerate();
            for (n, image) in all {
                let barrier = |[old, new]: [vk::ImageLayout; 2]| {
                    vk::ImageMemoryBarrier2::default()
                        .image(image.image)
                        .subresource_range(vk::ImageSubresourceRange { base_array_layer: image.subresource.layer, ..whole() })
                        .src_stage_mask(general.0)
                        .src_access_mask(general.1)
                        .dst_stage_mask(general.0)
                        .dst_access_mask(general.1)
                        .old_layout(old)
                        .new_layout(new)
                };
                let copied = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
                let [before, after] =
                    [[vk::ImageLayout::UNDEFINED, copied], [copied, vk::ImageLayout::GENERAL]].map(|layouts| [barrier(layouts)]);
                let layers = vk::ImageSubresourceLayers::default()
                    .aspect_mask(vk::ImageAspectFlags::COLOR)
                    .base_array_layer(image.subresource.layer)
                    .layer_count(1);
                let extent = vk::Extent3D { width: EXTENT[0], height: EXTENT[1], depth: 1 };
                let region = vk::BufferImageCopy::default().buffer_offset((n * texels * 16) as u64).image_subresource(layers);
                let (device, info) = (rig.gpu.device(), vk::DependencyInfo::default());
                // SAFETY: the command buffer is recording; image and buffer are live, and the image is in this layout behind the barrier.
                unsafe {
                    device.cmd_pipeline_barrier2(cmd, &info.image_memory_barriers(&before));
                    device.cmd_copy_buffer_to_image(cmd, staging.0, image.image, copied, &[region.image_extent(extent)]);
                    device.cmd_pipeline_barrier2(cmd, &info.image_memory_barriers(&after));
                }
            }
            rig.record(cmd, &frame);
            // SAFETY: the command buffer is recording, and the buffer has room.
            unsafe { rig.executor.record_copy(cmd, &frame, "denoised_radiance", UseFrame::Current, result.0) }.expect("a copy");
        });
        // SAFETY: the buffer is mapped and this large, and the copy is complete.
        let halves = unsafe { std::slice::from_raw_parts(result.1, texels * 8) };
        let readback = engine.executor.readback("denoised_radiance", &frame, UseFrame::Current).expect("an output");
        let error = rmse(&readback.to_floats(halves), &expected.download("denoised_radiance").expect("output"));
        assert!(error < 5e-3, "frame {i}: {error}");
    }
    assert_valid();
}

fn usage() -> vk::ImageUsageFlags {
    vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC
}

fn counted(s: &mut Session, counter: Counter) -> u32 {
    s.download("statistics").expect("counters")[counter as usize][0] as u32
}

/// Blades of grass: normals of any direction, another one in every frame, or none.
fn where_there_is_no_normal_depth_and_id_decide() {
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let [mut random, mut none] = [0, 1].map(|_| session(&svgf(EXTENT)));
    let mut errors = [0.0; 2];
    for i in 0..6 {
        let guides = scene.frame(i, i);
        for ((s, error), has_normals) in [&mut random, &mut none].into_iter().zip(&mut errors).zip([true, false]) {
            let mut guides = guides.clone();
            for (k, normal) in guides.normal.iter_mut().enumerate() {
                let angle = (k as f32 * 2.4 + i as f32 * 1.7) % 6.3;
                *normal = if has_normals { [angle.sin(), 0.3, angle.cos(), 0.0] } else { [0.0; 4] };
            }
            let (_, denoised) = frame(s, &guides, &scene.params(i), &svgf_tuning());
            *error = rmse(&denoised, &guides.clean);
        }
        assert_eq!(counted(&mut none, Counter::LostNormal), 0, "frame {i}");
        assert_eq!(counted(&mut none, Counter::Normal), 0, "frame {i}: none is no bad one");
    }
    let [random, none] = errors;
    assert!(none < 0.6 * random, "error without normals {none}, with random ones {random}");
    assert_valid();
}

const WEAPON: u32 = 3;

/// Places of a thing that the camera carries: the inverse of the previous view, times the view of this frame, which only moves here.
fn carried(now: &FrameParams, before: &FrameParams) -> InstanceTransform {
    let moved: [f32; 3] = std::array::from_fn(|i| now.view_from_world[3][i] - before.view_from_world[3][i]);
    std::array::from_fn(|i| std::array::from_fn(|j| if j == 3 { moved[i] } else { f32::from(u8::from(i == j)) }))
}

/// A weapon before a scene that slides, by the matrices and a transform of its own.
fn what_the_camera_carries_keeps_its_history() {
    let scene = Scene { speed: 0.25, ..Scene::new(EXTENT) };
    let is_weapon = |x: u32, y: u32| (18..34).contains(&x) && y >= 16;
    let identity: InstanceTransform = std::array::from_fn(|i| std::array::from_fn(|j| f32::from(u8::from(i == j))));
    for has_transform in [true, false] {
        let mut s = session(&Config { reactive_mask: true, ..svgf(EXTENT) });
        for i in 0..5 {
            let mut guides = scene.frame(i, i);
            for (k, _) in pixels(EXTENT).enumerate().filter(|(_, (x, y))| is_weapon(*x, *y)) {
                guides.depth[k] = [0.5; 4];
                guides.normal[k] = [0.0, 0.0, 1.0, 0.0];
                guides.surface_id[k] = WEAPON;
            }
            let (now, before) = (scene.params(i), scene.params(i.saturating_sub(1)));
            let of_weapon = if has_transform { carried(&now, &before) } else { identity };
            let transforms = [identity, identity, identity, of_weapon];
            s.upload_buffer("instance_transforms", bytemuck::cast_slice(&transforms)).expect("instance_transforms");
            upload(&mut s, &guides);
            s.unbind("motion").expect("optional");
            s.run(&now, &svgf_tuning()).expect("a frame");
            // The share that is new: 1 of as many frames as there are.
            let mask = s.download("reactive_mask").expect("output");
            let new = pixels(EXTENT).zip(&mask).filter(|((x, y), _)| is_weapon(*x, *y)).map(|(_, texel)| texel[0]);
            let new: Vec<f32> = new.collect();
            let mean = new.iter().sum::<f32>() / new.len() as f32;
            let expected = 1.0 / (i + 1) as f32;
            let is_kept = new.iter().all(|share| (share - expected).abs() < 1e-3);
            assert!(i == 0 || is_kept == has_transform, "transform: {has_transform}, frame {i}: {mean} instead of {expected}");
            assert!(i == 0 || has_transform || mean > expected + 0.1, "frame {i}: {mean}");
        }
    }
    assert_valid();
}
