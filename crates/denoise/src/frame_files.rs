//! FRAMES: a folder, a pattern, or files, put into the order of their numbers.

use crate::error::{Result, ToolError};
use crate::file_pattern::Pattern;
use crate::frame_names::{take_apart, Named, Stem};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// One frame on disk.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameFiles {
    /// Number in the name.
    pub number: u64,
    /// File with the colour.
    pub colour: PathBuf,
    /// Files of their own for guides: layer that their channels get (`albedo`, `normal`, ...) and path.
    pub guides: Vec<(&'static str, PathBuf)>,
    /// File with light of fewer pixels, where the colour has none: `--guides`.
    pub light: Option<PathBuf>,
}

impl FrameFiles {
    /// Frames of guides, with those of light of the same numbers.
    ///
    /// # Errors
    /// A frame without guides.
    pub fn with_guides(light: Vec<Self>, guides: Vec<Self>, folder: &Path) -> Result<Vec<Self>> {
        let mut guides: BTreeMap<u64, Self> = guides.into_iter().map(|frame| (frame.number, frame)).collect();
        let paired = |frame: Self| match guides.remove(&frame.number) {
            Some(of) => Ok(Self { light: Some(frame.colour), ..of }),
            None => {
                let problem = format!("has no frame {}, of which {} is the light", frame.number, frame.colour.display());
                Err(ToolError::Sequence { path: folder.to_owned(), problem })
            }
        };
        light.into_iter().map(paired).collect()
    }
}

/// The frames of a run.
#[derive(Debug)]
pub struct Found {
    /// In the order of their numbers.
    pub frames: Vec<FrameFiles>,
    /// Names, with a number in each, of files beside them that are not used.
    pub unused: Vec<String>,
}

/// More missing frames than this are counted, not named.
const NAMED: usize = 8;
/// A hole this long is a typing error in a pattern, or two sequences; no list is made of it.
const LONGEST_HOLE: u64 = 1 << 20;

/// A file, and which run of digits in its name is the number, where a pattern says so.
type Picked = (PathBuf, Option<usize>);

/// Finds the frames that the arguments name, numbered one by one.
pub fn find(arguments: &[PathBuf]) -> Result<Vec<FrameFiles>> {
    search(arguments, 1).map(|found| found.frames)
}

/// Finds the frames that the arguments name, with numbers that are `step` apart.
pub fn search(arguments: &[PathBuf], step: u64) -> Result<Found> {
    let Some(first) = arguments.first() else {
        return Err(ToolError::Usage("no frames were given".into()));
    };
    let mut files = Vec::new();
    for argument in arguments {
        files.extend(expand(argument)?);
    }
    files.sort();
    files.dedup_by(|a, b| a.0 == b.0);
    if files.is_empty() {
        let hint = if first.is_dir() { "; their names must end in .exr" } else { "" };
        return Err(ToolError::NoFrames { path: first.clone(), hint: hint.into() });
    }
    let beside = if first.is_dir() { Vec::new() } else { beside(&files)? };
    let sorted = Sorted::new(first, files, beside)?;
    check_holes(&sorted.colours, step)?;
    Ok(sorted.frames())
}

fn expand(argument: &Path) -> Result<Vec<Picked>> {
    if argument.is_dir() {
        return list(argument, |name| name.to_lowercase().ends_with(".exr"), |_| None);
    }
    if argument.symlink_metadata().is_ok() {
        return usable(argument.to_owned()).map(|path| vec![(path, None)]);
    }
    let is_pattern = |name: &&str| name.contains(['*', '?', '#', '%']);
    let Some(pattern) = argument.file_name().and_then(|n| n.to_str()).filter(is_pattern) else {
        let source = std::io::Error::new(std::io::ErrorKind::NotFound, "no such file or folder");
        return Err(ToolError::Read { path: argument.to_owned(), source });
    };
    let pattern = Pattern::parse(pattern);
    list(folder_of(argument), |name| pattern.fits(name), |name| pattern.number(name))
}

fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn list(folder: &Path, fits: impl Fn(&str) -> bool, number: impl Fn(&str) -> Option<usize>) -> Result<Vec<Picked>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(ToolError::read(folder))? {
        let path = entry.map_err(ToolError::read(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // Temporary files of a run that is writing here start with a dot.
        if !name.starts_with('.') && fits(&name) {
            found.push((usable(path)?, number(&name)));
        }
    }
    Ok(found)
}

/// A frame's file, unless it is none that can be read, or its name none that can be put into an order
/// and be given to the result.
fn usable(path: PathBuf) -> Result<PathBuf> {
    atrous_files::check_regular(&path).map_err(ToolError::read(&path))?;
    match path.file_name().is_some_and(|name| name.to_str().is_none()) {
        true => Err(ToolError::Sequence { path, problem: "its name is not in UTF-8; rename it".into() }),
        false => Ok(path),
    }
}

/// Files in the same folders that were not named: guides may be among them.
fn beside(files: &[Picked]) -> Result<Vec<Picked>> {
    let folders: BTreeSet<&Path> = files.iter().map(|(path, _)| folder_of(path)).collect();
    let named: BTreeSet<&std::ffi::OsStr> = files.iter().filter_map(|(path, _)| path.file_name()).collect();
    let mut others = Vec::new();
    for folder in folders {
        // One that may not be listed has no guides.
        let Ok(entries) = std::fs::read_dir(folder) else { continue };
        for path in entries.flatten().map(|entry| entry.path()) {
            let Some(name) = path.file_name().and_then(|n| n.to_str()) else { continue };
            let is_exr = name.to_lowercase().ends_with(".exr") && !name.starts_with('.');
            if is_exr && !named.contains(std::ffi::OsStr::new(name)) {
                others.push((path, None));
            }
        }
    }
    Ok(others)
}

/// Files by what they are.
struct Sorted {
    colours: Vec<Named>,
    guides: Vec<Named>,
    unused: BTreeSet<Stem>,
}

impl Sorted {
    fn new(argument: &Path, files: Vec<Picked>, beside: Vec<Picked>) -> Result<Self> {
        let lone = files.len() == 1;
        let marked = files.iter().all(|(_, marked)| marked.is_some());
        // Numbers of one sequence are found by all of its files.
        let (named, beside): (Vec<Named>, Vec<Named>) = (take_apart(files), take_apart(beside));
        let (mut guides, colours): (Vec<_>, Vec<_>) = named.into_iter().partition(|file| !lone && file.stem.guide().is_some());
        let mut stems: BTreeSet<Stem> = colours.iter().map(|file| file.stem.clone()).collect();
        let mut unused = BTreeSet::new();
        // A pattern that says where the number is has said enough.
        if stems.len() > 1 && !marked {
            let is_colour = |stem: &&Stem| stem.says_colour();
            if stems.iter().filter(is_colour).count() == 1 {
                (stems, unused) = stems.into_iter().partition(Stem::says_colour);
            } else {
                return Err(several(argument, &stems));
            }
        }
        let mut colours: Vec<Named> = colours.into_iter().filter(|file| stems.contains(&file.stem)).collect();
        colours.sort_by(|a, b| (a.number, &a.path).cmp(&(b.number, &b.path)));
        let problem = |problem: String| ToolError::Sequence { path: argument.to_owned(), problem };
        if colours.is_empty() {
            return Err(problem("only albedo, normal and other guides are there, and no colour".into()));
        }
        if let Some([a, b]) =
            colours.windows(2).find_map(|pair| <&[Named; 2]>::try_from(pair).ok().filter(|p| p[0].number == p[1].number))
        {
            return Err(problem(format!("{} and {} have the same number", a.path.display(), b.path.display())));
        }
        guides.extend(beside_of(&colours, &stems, beside));
        let guides = one_of_each(guides, &mut unused);
        Ok(Self { colours, guides, unused })
    }

    fn frames(self) -> Found {
        let mut guides: BTreeMap<u64, Vec<(&'static str, PathBuf)>> = BTreeMap::new();
        for file in self.guides {
            if let Some(layer) = file.stem.guide() {
                guides.entry(file.number).or_default().push((layer, file.path));
            }
        }
        let frame = |Named { number, path, .. }| FrameFiles {
            number,
            colour: path,
            guides: guides.remove(&number).unwrap_or_default(),
            light: None,
        };
        let unused = self.unused.iter().map(Stem::pattern).collect();
        Found { frames: self.colours.into_iter().map(frame).collect(), unused }
    }
}

/// Guides that lie beside the colour and belong to it: those of the same shot, or all of them where
/// the folder has no other colour.
fn beside_of(colours: &[Named], stems: &BTreeSet<Stem>, beside: Vec<Named>) -> Vec<Named> {
    if colours.iter().any(|file| file.stem.guide().is_some()) {
        return Vec::new();
    }
    let (guides, others): (Vec<_>, Vec<_>) = beside.into_iter().partition(|file| file.stem.guide().is_some());
    let numbers: BTreeSet<u64> = colours.iter().map(|file| file.number).collect();
    let shots: BTreeSet<_> = stems.iter().map(Stem::shot).collect();
    let is_alone = others.iter().all(|file| stems.contains(&file.stem));
    let belongs = |file: &Named| numbers.contains(&file.number) && (is_alone || shots.contains(&file.stem.shot()));
    guides.into_iter().filter(belongs).collect()
}

/// One file a frame and layer: of two normals that of shading.
fn one_of_each(guides: Vec<Named>, unused: &mut BTreeSet<Stem>) -> Vec<Named> {
    let mut best: BTreeMap<&'static str, Stem> = BTreeMap::new();
    for stem in guides.iter().map(|file| &file.stem) {
        let Some(layer) = stem.guide() else { continue };
        let rank = |stem: &Stem| (stem.is_geometric(), stem.before.len() + stem.after.len());
        let known = best.entry(layer).or_insert_with(|| stem.clone());
        if rank(stem) < rank(known) {
            *known = stem.clone();
        }
    }
    let mut kept = Vec::new();
    let mut seen = BTreeSet::new();
    for file in guides {
        let Some(layer) = file.stem.guide() else { continue };
        let is_best = best.get(layer) == Some(&file.stem);
        if is_best && seen.insert((layer, file.number)) {
            kept.push(file);
        } else {
            unused.insert(file.stem);
        }
    }
    kept
}

/// The error for more than one sequence: each with a pattern that names it alone.
fn several(argument: &Path, stems: &BTreeSet<Stem>) -> ToolError {
    const SHOWN: usize = 4;
    let folder = if argument.is_dir() { argument } else { folder_of(argument) };
    let pattern = |stem: &Stem| format!("\"{}\"", folder.join(stem.pattern()).display());
    let patterns: Vec<String> = stems.iter().take(SHOWN).map(pattern).collect();
    let more = stems.len().saturating_sub(SHOWN);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    ToolError::Sequence {
        path: argument.to_owned(),
        problem: format!("several sequences are there: {}{more}; name one of them by its pattern, in quotes", patterns.join(", ")),
    }
}

fn check_holes(frames: &[Named], step: u64) -> Result<()> {
    let (mut names, mut count) = (Vec::new(), 0usize);
    let gaps: BTreeSet<u64> = frames.windows(2).map(|pair| pair[1].number - pair[0].number).collect();
    for pair in frames.windows(2) {
        let (first, next) = (&pair[0], &pair[1]);
        let gap = next.number - first.number;
        if gap % step != 0 {
            let problem = format!("is {gap} after {}, and --step is {step}; give the step of the numbers", first.path.display());
            return Err(ToolError::Sequence { path: next.path.clone(), problem });
        }
        count += (gap / step - 1).min(LONGEST_HOLE) as usize;
        let missing = (first.number + step..next.number).step_by(step as usize);
        names.extend(missing.take(NAMED - names.len().min(NAMED)).map(|number| first.stem.named(&first.path, number)));
    }
    let regular = match (gaps.len(), gaps.first()) {
        (1, Some(gap)) => Some(*gap),
        _ => None,
    };
    match names.is_empty() {
        true => Ok(()),
        false => Err(ToolError::MissingFrames { names, count, regular }),
    }
}
