//! A Bevy program without a window whose path tracer is denoised: guides of Bevy's prepass, noise of a compute shader.
//!
//! It checks that the guides are encoded as declared, and that the check would see mistakes; it prints the error of noisy and denoised
//! pictures against many paths a pixel, and writes them beside each other: `cargo run -- [--like-solari] FOLDER`.

mod path_tracer;
mod scene;

use atrous::config::{Conventions, MotionDirection, NormalEncoding};
use atrous::reference::Image;
use atrous_conventions::{check, OwnedGuides};
use bevy::pbr::DefaultOpaqueRendererMethod;
use bevy::prelude::*;
use bevy_atrous::{Capture, DenoisePlugin};
use host_bevy::{denoiser, difference, headless, print_replay, readback, shown, Pictures, Result};
use path_tracer::Traced;
use scene::{Captured, LikeSolari, Scene, Target, EXTENT};
use std::path::PathBuf;

const FRAMES: u32 = 24;
/// Paths a pixel of the reference.
const REFERENCE: u32 = 1024;

fn app(like_solari: bool, capture: Capture) -> App {
    let mut app = headless();
    app.insert_resource(LikeSolari(like_solari)).insert_resource(Captured(capture));
    if like_solari {
        app.insert_resource(DefaultOpaqueRendererMethod::deferred());
    }
    app.add_plugins((scene::ScenePlugin, DenoisePlugin, path_tracer::PathTracerPlugin));
    app.finish();
    app.cleanup();
    app
}

fn draw(app: &mut App, scene: Scene) {
    *app.world_mut().resource_mut::<Scene>() = scene;
    app.update();
}

fn guides(app: &mut App) -> Result<OwnedGuides> {
    let (world, denoiser) = denoiser(app)?;
    let bytes = readback::buffer(world, &world.resource::<Traced>().guides)?;
    let float = |bytes: &[u8]| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let texels: Vec<[f32; 4]> =
        bytes.chunks_exact(16).map(|t| [float(t), float(&t[4..]), float(&t[8..]), float(&t[12..])]).collect();
    let image = |offset: usize| Image::from_texels(EXTENT, texels[offset..].iter().step_by(3).copied().collect());
    Ok(OwnedGuides {
        params: denoiser.params,
        depth: image(0)?,
        normal: Some(image(1)?),
        motion: Some(image(2)?),
        surface_id: None,
    })
}

/// The share of pixels whose colours differ by a quantum of a G-buffer at most.
fn share_alike(a: &[[f32; 3]], b: &[[f32; 3]]) -> f64 {
    let alike = |(a, b): (&[f32; 3], &[f32; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.012);
    a.iter().zip(b).filter(|pair| alike(*pair)).count() as f64 / a.len() as f64
}

/// Holds Bevy's prepass against what the plugin declares, and what it might have declared by mistake.
fn check_conventions(previous: &OwnedGuides, current: &OwnedGuides) -> Result<()> {
    let declared = bevy_atrous::conventions();
    let report = check(&declared, &previous.borrow(), &current.borrow())?;
    println!("{report}");
    if report.complains() {
        return Err("the guides are not encoded as declared".into());
    }
    let mistakes = [
        Conventions { motion_direction: MotionDirection::PreviousMinusCurrent, ..declared },
        Conventions { motion_y_up: true, ..declared },
        Conventions { normal: NormalEncoding::Xyz, ..declared },
    ];
    for mistake in mistakes {
        let report = check(&mistake, &previous.borrow(), &current.borrow())?;
        let found: Vec<&str> = report.findings().iter().map(|(_, f)| f.mistake.as_str()).filter(|m| !m.is_empty()).collect();
        println!("declared by mistake, the check says: {}", found.join("; "));
    }
    // Bevy's y of clip space, which points up, and jitter of the opposite sign.
    let mistaken = |guides: &OwnedGuides, clip: f32, jitter: f32| {
        let mut guides = guides.clone();
        guides.params.clip_from_view[1][1] *= clip;
        guides.params.jitter = guides.params.jitter.map(|offset| jitter * offset);
        guides
    };
    for (clip, jitter) in [(-1.0, 1.0), (1.0, -1.0)] {
        let [previous, current] = [previous, current].map(|guides| mistaken(guides, clip, jitter));
        let report = check(&declared, &previous.borrow(), &current.borrow())?;
        if !report.geometry.mistake.is_empty() {
            println!("given by mistake, the check says: {}", report.geometry.mistake);
        }
    }
    Ok(())
}

fn main() -> Result<()> {
    let mut arguments = std::env::args_os().skip(1).peekable();
    let like_solari = arguments.next_if(|argument| argument == "--like-solari").is_some();
    let folder = arguments.next().map(PathBuf::from);
    let captured = tempfile::tempdir()?;
    let mut app = app(like_solari, Capture { folder: captured.path().to_owned(), frames: FRAMES });
    let mut known = Vec::new();
    for index in 0..FRAMES {
        draw(&mut app, Scene { index, time: index, ..default() });
        if index + 2 >= FRAMES {
            known.push(guides(&mut app)?);
        }
    }
    let (world, view) = denoiser(&mut app)?;
    let noisy = readback::radiance(world, &view.noisy)?;
    let albedo = readback::radiance(world, &view.albedo)?;
    let traced = readback::radiance(world, &world.resource::<Traced>().albedo)?;
    println!("albedo of the denoiser: {:.4} of the pixels as traced", share_alike(&albedo, &traced));
    let denoised = readback::radiance(world, view.denoised().ok_or("no output")?)?;
    let target = app.world().resource::<Target>().0.clone();
    let shown = shown(&app, &target)?;
    println!("Bevy shows the denoised picture, off by at most {} of 255", difference(&shown, &denoised));

    // The same frame once more, with many paths: what the denoiser makes of it does not matter.
    draw(&mut app, Scene { index: FRAMES, time: FRAMES - 1, paths: REFERENCE, ..default() });
    let (world, view) = denoiser(&mut app)?;
    let reference = readback::radiance(world, &view.noisy)?;

    for (jitter, time) in [Vec2::new(0.4, -0.3), Vec2::new(-0.3, 0.45)].into_iter().zip(FRAMES..) {
        draw(&mut app, Scene { index: time + 1, time, jitter, ..default() });
        known.push(guides(&mut app)?);
    }
    println!("without jitter");
    check_conventions(&known[0], &known[1])?;
    println!("with jitter");
    check_conventions(&known[2], &known[3])?;
    print_replay(captured.path(), &denoised)?;
    let pictures = Pictures { extent: EXTENT, noisy: &noisy, denoised: &denoised, reference: &reference, shown };
    pictures.report(
        "Bevy's prepass, one path a pixel",
        &format!("{REFERENCE} paths a pixel"),
        folder.map(|folder| (folder, "host_bevy")),
    )
}
