//! Saved shaders in the window: a thread that compiles them, and what the engine remembers of them.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use super::shared::Shared;
use crate::error::Result;
use crate::hot_reload::{Compiled, Recompiled, ShaderFolders, ShaderWatch, Stale};

/// A save is noticed after at most twice this time.
const LOOK_EVERY: Duration = Duration::from_millis(150);

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
                shared.say(true, format!("shaders are not watched: {error}"));
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
        shared.report().shader_errors = self.texts();
        if !reloaded.is_empty() {
            shared.say(false, format!("reloaded {}", reloaded.join(", ")));
        }
        !reloaded.is_empty()
    }

    /// Each once: an include that is broken breaks many files.
    fn texts(&self) -> Vec<String> {
        let mut texts: Vec<String> = self.by_file.values().cloned().collect();
        texts.sort();
        texts.dedup();
        texts
    }
}
