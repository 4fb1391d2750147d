//! The command `evaluate`: every filter on every scene, in one table and on one page.

mod claims;
mod contenders;
mod markdown;
mod page;
mod references;
mod results;
mod scene;
mod settings;

pub use settings::EvaluateOptions;

use std::sync::Arc;

use crate::{files, progress};
use atrous_demo::{Error, Gpu, GpuOptions, Result, Scene, SceneOptions};
use claims::Claim;
use references::References;
use results::SceneResult;

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
    let bar = progress::bar(scene::steps(&settings) * scenes.len() as u64, "");
    let mut results = Vec::new();
    for (number, scene) in (1..).zip(&scenes) {
        bar.set_message(scene.name.clone());
        let folder = out.join(&scene.name);
        files::make(&folder)?;
        let content = references::content(scene, 0);
        let result = match SceneResult::read(&folder, &settings, content) {
            Some(kept) => kept,
            None => {
                let rows = scene::measure(&gpu, scene, &settings, &references, &folder, &bar)?;
                let result = SceneResult { settings: settings.clone(), scene: scene.name.clone(), content, rows };
                result.write(&folder)?;
                result
            }
        };
        results.push(result);
        bar.set_position(scene::steps(&settings) * number);
    }
    bar.finish();
    let claims: Vec<_> = results.iter().flat_map(claims::of_scene).collect();
    report(options, &results, &claims)?;
    let messages = gpu.validation_messages();
    messages.iter().for_each(|message| eprintln!("{message}"));
    if options.quick {
        check(&claims)?;
    }
    Ok(messages.len())
}

fn report(options: &EvaluateOptions, results: &[SceneResult], claims: &[Claim]) -> Result<()> {
    let text = markdown::text(results, claims)?;
    println!("\n{text}");
    let (out, sheet) = (&options.out, markdown::sheet(results, &options.out)?);
    let linked = |picture: &str| format!("{text}\n{}", markdown::picture_of_details(picture));
    files::write(&out.join("quality.md"), linked("quality.png").as_bytes())?;
    sheet.write_png(out.join("quality.png"))?;
    page::write(&out.join("quality.html"), results, claims, out)?;
    if let Some(file) = &options.markdown {
        markdown::renew(file, &linked("images/quality.png"))?;
        let images = file.with_file_name("images");
        files::make(&images)?;
        sheet.write_png(images.join("quality.png"))?;
    }
    println!("page, table and pictures: quality.html, quality.md and quality.png in {}", options.out.display());
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
