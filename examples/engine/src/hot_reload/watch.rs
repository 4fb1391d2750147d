//! Which shaders were saved: by the times and sizes of files, looked at now and then. That works on every file system, and for editors that
//! write a new file and rename it; some hundred files take well under a millisecond.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use atrous_glsl::{resolve, shaders};

use super::{compile, Owner, Recompiled, ShaderFolders};
use crate::error::{Error, Result};
use crate::gpu::Shader;
use crate::tracer::shaders::ALL;

type Stamps = BTreeMap<PathBuf, (SystemTime, u64)>;

/// A folder of shaders.
#[derive(Clone)]
struct Folder {
    owner: Owner,
    built: &'static [&'static Shader],
    shaders: PathBuf,
    /// Where includes are looked for, in this order.
    includes: Vec<PathBuf>,
    /// Names of files are shown without it.
    hidden: PathBuf,
}

/// Watches the files of GLSL.
pub struct ShaderWatch {
    folders: Vec<Folder>,
    /// As they were when shaders were compiled last.
    compiled: Stamps,
    /// As they were at the last look.
    seen: Stamps,
}

impl ShaderWatch {
    /// What is saved from now on counts.
    ///
    /// # Errors
    /// A folder that is not there.
    pub fn new(folders: &ShaderFolders) -> Result<Self> {
        let there = |path: &Path| path.canonicalize().map_err(|e| Error::Folder { path: path.to_owned(), problem: e.to_string() });
        let (denoiser, engine) = (there(&folders.denoiser)?, there(&folders.engine)?);
        let above = |path: &Path| path.parent().map(Path::to_owned).unwrap_or_default();
        let of_engine = |shaders: PathBuf, built| Folder {
            owner: Owner::Engine,
            built,
            includes: vec![engine.join("include"), denoiser.join("host")],
            hidden: above(&shaders),
            shaders,
        };
        let of_denoiser = Folder {
            owner: Owner::Denoiser,
            built: &[],
            shaders: denoiser.clone(),
            includes: vec![denoiser.join("include")],
            hidden: above(&denoiser),
        };
        let mut all = vec![of_denoiser, of_engine(engine.clone(), ALL)];
        for other in &folders.others {
            all.push(of_engine(there(&other.folder)?, other.built));
        }
        let mut watch = Self { folders: all, compiled: Stamps::new(), seen: Stamps::new() };
        watch.compiled = watch.look();
        watch.seen.clone_from(&watch.compiled);
        Ok(watch)
    }

    /// Looks, and gives the shaders that have to be compiled again: once the files rest from one look to the next, since a save may take
    /// several steps.
    pub fn poll(&mut self) -> Vec<Stale> {
        let now = self.look();
        let rests = now == self.seen;
        self.seen = now;
        if !rests || self.seen == self.compiled {
            return Vec::new();
        }
        let before = std::mem::replace(&mut self.compiled, self.seen.clone());
        let is_new = |path: &PathBuf| before.get(path) != self.seen.get(path);
        let mut stale = Vec::new();
        for folder in &self.folders {
            // Those of other stages belong to pipelines of the window, which are not replaced.
            let files = shaders(&folder.shaders).unwrap_or_default().into_iter();
            for file in files.filter(|file| file.extension().is_some_and(|e| e == "comp")) {
                if sources(&file, &folder.includes).iter().any(is_new) {
                    stale.push(Stale { folder: folder.clone(), file });
                }
            }
        }
        stale
    }

    fn look(&self) -> Stamps {
        let folders: BTreeSet<&PathBuf> = self.folders.iter().flat_map(|f| f.includes.iter().chain([&f.shaders])).collect();
        let entries = folders.into_iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten().flatten();
        let stamp = |path: PathBuf| {
            let data = std::fs::metadata(&path).ok().filter(|data| data.is_file())?;
            Some((path, (data.modified().ok()?, data.len())))
        };
        entries.filter_map(|entry| stamp(entry.path())).collect()
    }
}

/// A shader that has to be compiled again.
pub struct Stale {
    folder: Folder,
    file: PathBuf,
}

impl Stale {
    /// Takes its time.
    pub fn recompile(&self) -> Recompiled {
        let Folder { owner, built, includes, hidden, .. } = &self.folder;
        let shown = |text: &str| text.replace(&format!("{}{}", hidden.display(), std::path::MAIN_SEPARATOR), "");
        Recompiled {
            file: shown(&self.file.to_string_lossy()),
            shaders: compile(*owner, built, &self.file, includes).map_err(|problem| shown(&problem)),
        }
    }
}

/// The file, and every file that it includes, directly or not, whether it is there or not.
fn sources(file: &Path, includes: &[PathBuf]) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut left = vec![file.to_owned()];
    while let Some(path) = left.pop() {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let named = text.lines().filter_map(|line| line.trim_start().strip_prefix("#include")?.split('"').nth(1));
        left.extend(named.map(|name| resolve(name, includes)).filter(|path| !found.contains(path)));
        found.insert(path);
    }
    found
}
