//! The command `evaluate`: every filter on every scene, in one table and on one page.

mod claims;
mod contenders;
mod experiments;
mod figures;
mod markdown;
mod page;
mod references;
mod results;
mod scene;
mod settings;

pub use settings::EvaluateOptions;

use std::path::Path;
use std::sync::Arc;

use crate::{files, progress};
use crate::{Error, Result};
use atrous_engine::scene::Lamp;
use atrous_engine::{Gpu, GpuOptions, Scene, SceneOptions, TracerOptions};
use claims::Claim;
use experiments::Findings;
use references::References;
use results::SceneResult;
use scene::Lab;

/// Gives the number of validation messages.
///
/// # Errors
/// A scene, folder or device that cannot be used, and, with `--quick`, claims that do not hold, once everything is written.
pub fn run(options: &EvaluateOptions) -> Result<usize> {
    // Before hours are spent on what would find no place.
    options.markdown.as_deref().map(markdown::around).transpose()?;
    let load = |name: &String| Ok(Arc::new(Scene::load(name, &SceneOptions::default())?));
    let scenes = options.scenes().iter().map(load).collect::<Result<Vec<_>>>()?;
    let gpu = Gpu::new(&GpuOptions { device: options.device.clone(), validation: options.validate, ..GpuOptions::default() })?;
    println!("device {}", gpu.info());
    let settings = options.settings(&gpu.info().to_string())?;
    let out = &options.out;
    let references = out.join("references");
    files::make(&references)?;
    let references = References::new(references, &settings);
    let bar = progress::bar(0, "");
    let lab = Lab { gpu: &gpu, settings: &settings, references: &references, bar: &bar };
    let results = scenes.iter().map(|scene| of_scene(&lab, scene, out)).collect::<Result<Vec<_>>>()?;
    let experiments = options.experiments();
    let findings = experiments.iter().map(|experiment| experiment.findings(&lab, out)).collect::<Result<Vec<_>>>()?;
    bar.finish();
    let mut claims: Vec<_> = results.iter().flat_map(claims::of_scene).collect();
    claims.extend(findings.iter().flat_map(|found| found.claims.iter().cloned()));
    report(options, &results, &findings, &claims)?;
    let messages = gpu.validation_messages();
    messages.iter().for_each(|message| eprintln!("{message}"));
    if options.quick {
        check(&claims)?;
    }
    Ok(messages.len())
}

/// The results of a scene: those that are kept, or measured anew.
fn of_scene(lab: &Lab, scene: &Arc<Scene>, out: &Path) -> Result<SceneResult> {
    lab.bar.set_message(scene.name.clone());
    let folder = out.join(&scene.name);
    files::make(&folder)?;
    let (settings, content) = (lab.settings, references::content(scene, 0));
    if let Some(kept) = SceneResult::read(&folder, settings, content) {
        return Ok(kept);
    }
    let of_all = settings.wanted(contenders::all());
    let mut rows = scene::measure(lab, scene, TracerOptions::default(), &of_all, &folder)?;
    let of_sun = settings.wanted(contenders::of_sun());
    if scene.lamps.iter().any(|lamp| matches!(lamp, Lamp::Sun { .. })) && !of_sun.is_empty() {
        let options = TracerOptions { lamps_apart: true, ..TracerOptions::default() };
        // Noise is the same, but for that of the sun.
        rows.extend(scene::measure(lab, scene, options, &of_sun, &folder)?.into_iter().skip(1));
    }
    let result = SceneResult { settings: settings.clone(), scene: scene.name.clone(), content, rows };
    result.write(&folder)?;
    Ok(result)
}

fn report(options: &EvaluateOptions, results: &[SceneResult], findings: &[Findings], claims: &[Claim]) -> Result<()> {
    let text = markdown::text(results, findings, claims)?;
    println!("\n{text}");
    let out = &options.out;
    if results.is_empty() {
        files::write(&out.join("quality.md"), text.as_bytes())?;
    } else {
        write_with_details(options, results, &text)?;
    }
    page::write(&out.join("quality.html"), results, findings, claims, out)?;
    println!("page, table and pictures: quality.html, quality.md and quality.png in {}", options.out.display());
    Ok(())
}

fn write_with_details(options: &EvaluateOptions, results: &[SceneResult], text: &str) -> Result<()> {
    let (out, sheet) = (&options.out, markdown::sheet(results, &options.out)?);
    let linked = |picture: &str| format!("{text}\n{}", markdown::picture_of_details(picture));
    files::write(&out.join("quality.md"), linked("quality.png").as_bytes())?;
    sheet.write_png(out.join("quality.png"))?;
    if let Some(file) = &options.markdown {
        markdown::renew(file, &linked("images/quality.png"))?;
        let images = file.with_file_name("images");
        files::make(&images)?;
        sheet.write_png(images.join("quality.png"))?;
    }
    Ok(())
}

fn check(claims: &[Claim]) -> Result<()> {
    let failed: Vec<_> = claims.iter().filter(|claim| claim.ratio > claim.accepted).collect();
    for claim in &failed {
        eprintln!("{}: {} is {:.3}, and {} at most before", claim.scene, claim.text, claim.ratio, claim.accepted);
    }
    match failed.len() {
        0 => Ok(()),
        failed => Err(Error::Claims { failed, claims: claims.len() }),
    }
}
