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

use crate::progress;
use atrous_demo::{Error, Gpu, GpuOptions, Result, Scene, SceneOptions};
use references::References;
use results::SceneResult;

/// Gives the number of validation messages.
///
/// # Errors
/// A scene, folder or device that cannot be used, and, with `--quick`, claims that do not hold, once everything is written.
pub fn run(options: &EvaluateOptions) -> Result<usize> {
    let gpu = Gpu::new(&GpuOptions { device: options.device.clone(), validation: options.validate, ..GpuOptions::default() })?;
    println!("device {}", gpu.info());
    let settings = options.settings(&gpu.info().to_string())?;
    let (out, scenes) = (&options.out, options.scenes());
    let references = out.join("references");
    scene::make(&references)?;
    let references = References::new(references, &settings);
    let bar = progress::bar(scene::steps(&settings) * scenes.len() as u64, "");
    let mut results = Vec::new();
    for (number, name) in (1..).zip(&scenes) {
        let loaded = Arc::new(Scene::load(name, &SceneOptions::default())?);
        bar.set_message(loaded.name.clone());
        let folder = out.join(&loaded.name);
        scene::make(&folder)?;
        let result = match SceneResult::read(&folder, &settings) {
            Some(kept) => kept,
            None => {
                let result = scene::measure(&gpu, &loaded, &settings, &references, &folder, &bar)?;
                result.write(&folder)?;
                result
            }
        };
        results.push(result);
        bar.set_position(scene::steps(&settings) * number);
    }
    bar.finish();
    report(options, &results)?;
    let messages = gpu.validation_messages();
    messages.iter().for_each(|message| eprintln!("{message}"));
    if options.quick {
        check(&results)?;
    }
    Ok(messages.len())
}

fn report(options: &EvaluateOptions, results: &[SceneResult]) -> Result<()> {
    let claims: Vec<_> = results.iter().flat_map(claims::of_scene).collect();
    let text = markdown::text(results, &claims)?;
    println!("\n{text}");
    results::write(&options.out.join("quality.md"), &text)?;
    markdown::write_sheet(&options.out.join("quality.png"), results, &options.out)?;
    page::write(&options.out.join("quality.html"), results, &claims, &options.out)?;
    if let Some(file) = &options.markdown {
        markdown::renew(file, &text)?;
    }
    println!("page, table and pictures: quality.html, quality.md and quality.png in {}", options.out.display());
    Ok(())
}

fn check(results: &[SceneResult]) -> Result<()> {
    let claims: Vec<_> = results.iter().flat_map(claims::of_scene).collect();
    let failed: Vec<_> = claims.iter().filter(|claim| !claim.holds()).collect();
    for claim in &failed {
        eprintln!("{}: {} is {:.3}, at most {} is claimed", claim.scene, claim.text, claim.ratio, claim.bound);
    }
    match failed.len() {
        0 => Ok(()),
        failed => Err(Error::Claims { failed, claims: claims.len() }),
    }
}
