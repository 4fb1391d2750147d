//! Saved shaders in the window: a thread that compiles them, and what the engine remembers of them.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use super::shared::Shared;
use crate::error::Result;
use atrous_engine::hot_reload::{Compiled, Recompiled, ShaderFolders, ShaderWatch, Stale};

/// A save is noticed after at most twice this time.
const LOOK_EVERY: Duration = Duration::from_millis(150);
/// An include may belong to many shaders: so many of them are named.
const NAMED: usize = 3;

/// Compiles what is saved, and hands it to the engine. Dropping it waits for the shader that is being compiled.
pub struct ReloadThread {
    quit: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl ReloadThread {
    /// Starts. Folders that are not there are said, and not watched.
    pub fn start(shared: &Arc<Shared>, folders: &ShaderFolders) -> Self {
        let quit = Arc::new(AtomicBool::new(false));
        let thread = match ShaderWatch::new(folders) {
            Ok(watch) => {
                let (shared, quit) = (shared.clone(), quit.clone());
                Some(std::thread::spawn(move || run(watch, &shared, &quit)))
            }
            Err(error) => {
                shared.notify(true, format!("shaders are not watched: {error}"));
                None
            }
        };
        Self { quit, thread }
    }
}

impl Drop for ReloadThread {
    fn drop(&mut self) {
        self.quit.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            // A panic was printed.
            let _ = thread.join();
        }
    }
}

fn run(mut watch: ShaderWatch, shared: &Shared, quit: &AtomicBool) {
    let goes_on = || !quit.load(Ordering::Relaxed);
    while goes_on() {
        // All of them at once, since an include may be what shaders have agreed on.
        let recompiled: Vec<_> = watch.poll().iter().take_while(|_| goes_on()).map(Stale::recompile).map(Arc::new).collect();
        if !recompiled.is_empty() {
            shared.want(|wanted| wanted.recompiled.extend(recompiled));
        }
        std::thread::park_timeout(LOOK_EVERY);
    }
}

/// The newest code of every shader that was saved, for what is made later.
#[derive(Default)]
pub struct LiveShaders {
    newest: BTreeMap<String, Compiled>,
}

impl LiveShaders {
    /// From now on.
    pub fn keep(&mut self, shader: Compiled) {
        self.newest.insert(shader.name().to_owned(), shader);
    }

    /// Gives something new, which was made of the shaders of the build, each of them.
    ///
    /// # Errors
    /// The first of `replace`.
    pub fn put_into(&self, mut replace: impl FnMut(&Compiled) -> Result<bool>) -> Result<()> {
        self.newest.values().try_for_each(|shader| replace(shader).map(drop))
    }
}

/// What is wrong with which file.
#[derive(Default)]
pub struct ShaderErrors {
    by_file: BTreeMap<String, String>,
}

impl ShaderErrors {
    /// Puts saved shaders in place by `put`, and says what came of it; whether there are any. One that is broken leaves the old one where it is.
    pub fn take(&mut self, shared: &Shared, recompiled: &[Arc<Recompiled>], mut put: impl FnMut(&Compiled) -> Result<()>) -> bool {
        if recompiled.is_empty() {
            return false;
        }
        let mut reloaded = Vec::new();
        for Recompiled { file, shaders } in recompiled.iter().map(Arc::as_ref) {
            let done = match shaders {
                Ok(shaders) => shaders.iter().try_for_each(&mut put).map_err(|e| format!("{file}: {e}")),
                Err(problem) => Err(problem.clone()),
            };
            match done {
                Ok(()) => {
                    self.by_file.remove(file);
                    reloaded.push(file.as_str());
                }
                Err(problem) => drop(self.by_file.insert(file.clone(), problem)),
            }
        }
        let text = (!reloaded.is_empty()).then(|| summary(&reloaded));
        {
            let mut report = shared.report();
            report.shader_errors = self.texts();
            report.reloaded.clone_from(&text);
        }
        let is_any = text.is_some();
        text.into_iter().for_each(|text| shared.notify(false, text));
        is_any
    }

    /// Each once: an include that is broken breaks many files.
    fn texts(&self) -> Vec<String> {
        let mut texts: Vec<String> = self.by_file.values().cloned().collect();
        texts.sort();
        texts.dedup();
        texts
    }
}

fn summary(files: &[&str]) -> String {
    match files.get(NAMED..) {
        Some(more @ [_, ..]) => format!("reloaded {} and {} more", files[..NAMED].join(", "), more.len()),
        _ => format!("reloaded {}", files.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn saved(file: &str, problem: Option<&str>) -> Arc<Recompiled> {
        let shaders = problem.map_or(Ok(Vec::new()), |problem| Err(problem.to_owned()));
        Arc::new(Recompiled { file: file.into(), shaders })
    }

    #[test]
    fn an_error_is_told_once_and_goes_when_its_files_are_mended() {
        let (shared, mut errors) = (Shared::default(), ShaderErrors::default());
        let mut take = |saved: &[Arc<Recompiled>]| {
            let is_any = errors.take(&shared, saved, |_| Ok(()));
            let report = shared.report();
            (is_any, report.shader_errors.clone(), report.reloaded.clone())
        };
        let (include, other) = ("glsl/include/guide.glsl:3: error", "glsl/taa.comp:9: error");
        let all = [saved("a.comp", Some(include)), saved("b.comp", Some(include)), saved("taa.comp", Some(other))];
        assert_eq!(take(&all), (false, vec![include.to_owned(), other.to_owned()], None));
        assert_eq!(take(&[saved("a.comp", None)]), (true, vec![include.into(), other.into()], Some("reloaded a.comp".into())));
        assert_eq!(take(&[saved("b.comp", None)]).1, [other]);
        let files = ["taa.comp", "c.comp", "d.comp", "e.comp", "f.comp"].map(|file| saved(file, None));
        let text = "reloaded taa.comp, c.comp, d.comp and 2 more";
        assert_eq!(take(&files), (true, Vec::new(), Some(text.into())));
        assert_eq!(take(&[]), (false, Vec::new(), Some(text.into())));
        let said: Vec<_> = shared.report().messages.iter().map(|m| m.text.clone()).collect();
        assert_eq!(said, ["reloaded a.comp", "reloaded b.comp", text]);
    }
}
