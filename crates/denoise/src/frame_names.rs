//! Names of frames, taken apart: where the number is, which sequence a file belongs to, and which
//! guide it is.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Endings of names that mark a file of a guide, and the layer that it stands for: those of Open
/// Image Denoise's examples and of LuxCore's outputs among them.
const GUIDES: &[(&str, &str)] = &[
    ("albedo", "albedo"),
    ("alb", "albedo"),
    ("normal", "normal"),
    ("normals", "normal"),
    ("nrm", "normal"),
    ("depth", "depth"),
    ("motion", "motion"),
    ("mv", "motion"),
    ("flow", "motion"),
    ("position", "position"),
    ("alpha", "alpha"),
    ("roughness", "roughness"),
    ("ref", "ref"),
    ("reference", "ref"),
    ("gt", "ref"),
];
/// Words that mark the file with the colour among others.
const COLOURS: &[&str] = &["hdr", "beauty", "rgb", "rgba", "color", "colour", "noisy", "combined"];
/// Words that say more about a guide.
const QUALIFIERS: &[&str] = &["shading", "avg", "geometry", "geo", "first", "world", "denoising"];
/// Words before a number that make it a version.
const VERSIONS: &[&str] = &["v", "ver", "version", "rev", "take"];

/// A file of a sequence.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Number of the frame; 0 where the name has none.
    pub number: u64,
    /// Everything before the number, and behind it without the ending.
    pub stem: Stem,
    /// The file.
    pub path: PathBuf,
}

/// What the names of a sequence have in common.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Stem {
    /// Before the number.
    pub before: String,
    /// Behind it.
    pub after: String,
    /// `.exr`, as it is written.
    pub ending: String,
    /// Whether there is a number.
    pub is_numbered: bool,
}

/// The runs of digits in a name.
pub fn digits(name: &str) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (i, _) in name.char_indices().filter(|(_, c)| c.is_ascii_digit()) {
        match runs.last_mut().filter(|run| run.end == i) {
            Some(run) => run.end = i + 1,
            None => runs.push(i..i + 1),
        }
    }
    runs
}

fn file_stem(path: &Path) -> &str {
    path.file_stem().and_then(|n| n.to_str()).unwrap_or_default()
}

/// The words of a text, in lower case.
fn words(text: &str) -> impl DoubleEndedIterator<Item = String> + '_ {
    let is_separator = |c: char| matches!(c, '_' | '-' | '.' | ' ');
    text.split(is_separator).filter(|word| !word.is_empty()).map(str::to_lowercase)
}

/// Whether a number behind this text is that of a version.
fn is_version(before: &str) -> bool {
    let letters = before.chars().rev().take_while(|c| c.is_alphabetic()).count();
    let word: String = before.chars().skip(before.chars().count() - letters).collect();
    VERSIONS.contains(&word.to_lowercase().as_str())
}

/// The likeliest number of a frame among the runs of a name, by what stands around it.
fn likeliest(name: &str, runs: &[Range<usize>]) -> Option<usize> {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    let doubts = |run: &Range<usize>| {
        let (before, after) = (&name[..run.start], &name[run.end..]);
        [is_version(before), is_letter(after.chars().next()), is_letter(before.chars().last())]
    };
    (0..runs.len()).rev().min_by_key(|i| doubts(&runs[*i]))
}

/// The run that numbers the frames of names that differ in digits alone: the one that makes the
/// fewest sequences of them. Versions count as such only where nothing else does.
fn numbering(names: &[&str]) -> Option<usize> {
    let first = names.first()?;
    let runs: Vec<_> = names.iter().map(|name| digits(name)).collect();
    let varies = |i: &usize| names.iter().zip(&runs).any(|(n, r)| n[r[*i].clone()] != first[runs[0][*i].clone()]);
    let sequences = |i: usize| {
        let rest = |(name, runs): (&&str, &Vec<Range<usize>>)| (name[..runs[i].start].to_owned(), name[runs[i].end..].to_owned());
        names.iter().zip(&runs).map(rest).collect::<std::collections::BTreeSet<_>>().len()
    };
    let varying = (0..runs[0].len()).rev().filter(varies);
    varying.min_by_key(|i| (sequences(*i), is_version(&first[..runs[0][*i].start]))).or_else(|| likeliest(first, &runs[0]))
}

/// A name without its digits: names of one shape can be of one sequence.
fn shape(name: &str) -> Vec<&str> {
    name.split(|c: char| c.is_ascii_digit()).filter(|text| !text.is_empty()).collect()
}

/// Takes the names of files apart. `marked`: which run of digits is the number, where a pattern says so.
pub fn take_apart(files: Vec<(PathBuf, Option<usize>)>) -> Vec<Named> {
    let mut shapes: BTreeMap<(Vec<&str>, usize), Vec<&str>> = BTreeMap::new();
    for (path, _) in files.iter().filter(|(_, marked)| marked.is_none()) {
        let name = file_stem(path);
        shapes.entry((shape(name), digits(name).len())).or_default().push(name);
    }
    let numberings: BTreeMap<_, _> = shapes.iter().map(|(shape, names)| (shape.clone(), numbering(names))).collect();
    let named = |(path, marked): &(PathBuf, Option<usize>)| {
        let name = file_stem(path);
        let runs = digits(name);
        let run = marked.or_else(|| numberings.get(&(shape(name), runs.len())).copied().flatten());
        let run = run.and_then(|i| runs.get(i));
        let (before, after) = run.map_or((name, ""), |run| (&name[..run.start], &name[run.end..]));
        let ending = path.extension().map(|e| format!(".{}", e.to_string_lossy())).unwrap_or_default();
        let stem = Stem { before: before.into(), after: after.into(), ending, is_numbered: run.is_some() };
        let number = run.and_then(|run| name[run.clone()].parse().ok()).unwrap_or_default();
        Named { number, stem, path: path.clone() }
    };
    files.iter().map(named).collect()
}

impl Stem {
    /// The layer that a file of a guide stands for.
    pub fn guide(&self) -> Option<&'static str> {
        let last = [words(&self.after).next_back(), words(&self.before).next_back()];
        GUIDES.iter().find(|g| last.iter().flatten().any(|w| w == g.0)).map(|g| g.1)
    }

    /// Whether it names the colour among other files.
    pub fn says_colour(&self) -> bool {
        words(&self.after).chain(words(&self.before)).any(|w| COLOURS.contains(&w.as_str()))
    }

    /// Whether the guide is one of the true surface, where there are two: shading is what the light sees.
    pub fn is_geometric(&self) -> bool {
        words(&self.after).chain(words(&self.before)).any(|w| w == "geometry" || w == "geo")
    }

    /// The words that colour and guides of one sequence have in common.
    pub fn shot(&self) -> [Vec<String>; 2] {
        let is_of_all = |word: &String| {
            let is = |list: &[&str]| list.contains(&word.as_str());
            !is(COLOURS) && !is(QUALIFIERS) && !GUIDES.iter().any(|g| g.0 == word)
        };
        [&self.before, &self.after].map(|text| words(text).filter(is_of_all).collect())
    }

    /// The pattern of all files of this stem, and of no other in the same folder but for names with
    /// characters of patterns in them.
    pub fn pattern(&self) -> String {
        let plain = |text: &str| text.replace(['*', '?', '#', '%'], "?");
        let number = if self.is_numbered { "%d" } else { "" };
        format!("{}{number}{}{}", plain(&self.before), plain(&self.after), self.ending)
    }

    /// The name of another frame, with as many digits as the one of `like`.
    pub fn named(&self, like: &Path, number: u64) -> String {
        let width = file_stem(like).len().saturating_sub(self.before.len() + self.after.len());
        like.with_file_name(format!("{}{number:0width$}{}{}", self.before, self.after, self.ending)).display().to_string()
    }
}
