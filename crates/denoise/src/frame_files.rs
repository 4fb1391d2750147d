//! FRAMES: a folder, a pattern, or files, put into the order of their numbers.

use crate::error::{Result, ToolError};
use std::collections::BTreeMap;
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
}

/// Endings of names that mark a file of a guide, and the layer that it stands for. Open Image Denoise's examples are called so.
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
    ("ref", "ref"),
    ("reference", "ref"),
    ("gt", "ref"),
];
/// More missing frames than this are counted, not named.
const NAMED: usize = 8;
/// A hole this long is a typing error in a pattern, or two sequences; no list is made of it.
const LONGEST_HOLE: u64 = 1 << 20;

/// A name taken apart: what stands before and after the last run of digits.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Stem {
    before: String,
    after: String,
}

/// Finds the frames that the arguments name.
pub fn find(arguments: &[PathBuf]) -> Result<Vec<FrameFiles>> {
    let Some(first) = arguments.first() else { return Err(ToolError::Usage("no frames were given".into())) };
    let mut files = Vec::new();
    for argument in arguments {
        files.extend(expand(argument)?);
    }
    files.sort();
    files.dedup();
    if files.is_empty() {
        let hint = if first.is_dir() { "; their names must end in .exr" } else { "" };
        return Err(ToolError::NoFrames { path: first.clone(), hint: hint.into() });
    }
    order(first, files)
}

fn expand(argument: &Path) -> Result<Vec<PathBuf>> {
    if argument.is_dir() {
        return list(argument, |name| name.to_lowercase().ends_with(".exr"));
    }
    if argument.symlink_metadata().is_ok() {
        return usable(argument.to_owned()).map(|path| vec![path]);
    }
    let Some(pattern) = argument.file_name().and_then(|n| n.to_str()).filter(|n| n.contains(['*', '?', '#', '%'])) else {
        let source = std::io::Error::new(std::io::ErrorKind::NotFound, "no such file or folder");
        return Err(ToolError::Read { path: argument.to_owned(), source });
    };
    let folder = argument.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let pattern = Pattern::parse(pattern);
    list(folder, |name| pattern.fits(name))
}

fn list(folder: &Path, fits: impl Fn(&str) -> bool) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(ToolError::read(folder))? {
        let path = entry.map_err(ToolError::read(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        // Temporary files of a run that is writing here start with a dot.
        if !name.starts_with('.') && fits(&name) {
            found.push(usable(path)?);
        }
    }
    Ok(found)
}

/// A frame's file, unless it is none that can be read, or its name none that can be put into an order and be given to the result.
fn usable(path: PathBuf) -> Result<PathBuf> {
    atrous_files::check_regular(&path).map_err(ToolError::read(&path))?;
    match path.file_name().is_some_and(|name| name.to_str().is_none()) {
        true => Err(ToolError::Sequence { path, problem: "its name is not in UTF-8; rename it".into() }),
        false => Ok(path),
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Piece {
    Char(char),
    AnyChar,
    Digit,
    Any,
    Digits,
}

/// `*`, `?`, `####` and `%04d`.
struct Pattern(Vec<Piece>);

impl Pattern {
    fn parse(text: &str) -> Self {
        let mut pieces = Vec::new();
        let mut rest = text;
        while let Some(c) = rest.chars().next() {
            rest = &rest[c.len_utf8()..];
            pieces.push(match c {
                '*' => Piece::Any,
                '?' => Piece::AnyChar,
                '#' => Piece::Digit,
                '%' => match rest.split_once('d') {
                    Some((width, after)) if width.chars().all(|c| c.is_ascii_digit()) => {
                        rest = after;
                        Piece::Digits
                    }
                    _ => Piece::Char(c),
                },
                c => Piece::Char(c),
            });
        }
        Self(pieces)
    }

    /// Iterative, with one point to return to: linear in practice, and no pattern makes it blow up.
    fn fits(&self, name: &str) -> bool {
        let name: Vec<char> = name.chars().collect();
        let (mut p, mut n, mut star) = (0, 0, None);
        while n < name.len() {
            let advance = match self.0.get(p) {
                Some(Piece::Any) => {
                    star = Some((p, n, false));
                    p += 1;
                    continue;
                }
                Some(Piece::Digits) if name[n].is_ascii_digit() => {
                    star = Some((p, n + 1, true));
                    true
                }
                Some(Piece::Char(c)) => *c == name[n],
                Some(Piece::AnyChar) => true,
                Some(Piece::Digit) => name[n].is_ascii_digit(),
                Some(Piece::Digits) | None => false,
            };
            if advance {
                (p, n) = (p + 1, n + 1);
                continue;
            }
            match star {
                Some((back, at, digits)) if !digits || name[at].is_ascii_digit() => {
                    star = Some((back, at + 1, digits));
                    (p, n) = (back + 1, at + 1);
                }
                _ => return false,
            }
        }
        self.0[p..].iter().all(|piece| *piece == Piece::Any)
    }
}

/// Stem and number of a file name; a name without digits is number 0.
fn take_apart(path: &Path) -> (Stem, Option<u64>) {
    let name = path.file_stem().and_then(|n| n.to_str()).unwrap_or_default();
    let end = name.rfind(|c: char| c.is_ascii_digit()).map(|i| i + 1);
    let Some(end) = end else { return (Stem { before: name.into(), after: String::new() }, None) };
    let start =
        name[..end].rfind(|c: char| !c.is_ascii_digit()).map_or(0, |i| i + name[i..].chars().next().map_or(1, char::len_utf8));
    let number = name[start..end].parse().ok();
    (Stem { before: name[..start].into(), after: name[end..].into() }, number)
}

/// The layer that a file of a guide stands for.
fn guide_of(stem: &Stem) -> Option<&'static str> {
    let is_separator = |c: char| matches!(c, '_' | '-' | '.' | ' ');
    let word = |text: &str| text.trim_matches(is_separator).rsplit(is_separator).next().unwrap_or_default().to_lowercase();
    let words = [word(&stem.after), word(&stem.before)];
    GUIDES.iter().find(|g| words.iter().any(|w| w == g.0)).map(|g| g.1)
}

fn order(argument: &Path, files: Vec<PathBuf>) -> Result<Vec<FrameFiles>> {
    let mut colours: BTreeMap<Stem, Vec<(u64, PathBuf)>> = BTreeMap::new();
    let mut guides: BTreeMap<u64, Vec<(&'static str, PathBuf)>> = BTreeMap::new();
    let lone = files.len() == 1;
    for path in files {
        let (stem, number) = take_apart(&path);
        let number = number.unwrap_or(0);
        match guide_of(&stem).filter(|_| !lone) {
            Some(layer) => guides.entry(number).or_default().push((layer, path)),
            None => colours.entry(stem).or_default().push((number, path)),
        }
    }
    let problem = |problem: String| ToolError::Sequence { path: argument.to_owned(), problem };
    if colours.len() > 1 {
        let names: Vec<String> = colours.keys().take(4).map(|s| format!("{}*{}.exr", s.before, s.after)).collect();
        return Err(problem(format!("several sequences are there: {}; name one by a pattern", names.join(", "))));
    }
    let Some((_, mut colours)) = colours.into_iter().next() else {
        return Err(problem("only albedo, normal and other guides are there, and no colour".into()));
    };
    colours.sort();
    if let Some(twice) = colours.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(problem(format!("{} and {} have the same number", twice[0].1.display(), twice[1].1.display())));
    }
    check_holes(&colours)?;
    let mut frames = Vec::new();
    for (number, colour) in colours {
        frames.push(FrameFiles { number, colour, guides: guides.remove(&number).unwrap_or_default() });
    }
    Ok(frames)
}

fn check_holes(frames: &[(u64, PathBuf)]) -> Result<()> {
    let (mut names, mut count) = (Vec::new(), 0usize);
    for pair in frames.windows(2) {
        let hole = pair[1].0 - pair[0].0 - 1;
        count += hole.min(LONGEST_HOLE) as usize;
        for number in pair[0].0 + 1..pair[1].0 {
            if names.len() == NAMED {
                break;
            }
            names.push(named(&pair[0].1, number));
        }
    }
    match names.is_empty() {
        true => Ok(()),
        false => Err(ToolError::MissingFrames { names, count }),
    }
}

/// The path of another frame of the same sequence.
fn named(like: &Path, number: u64) -> String {
    let (stem, _) = take_apart(like);
    let width = like.file_stem().map_or(0, |s| s.len()).saturating_sub(stem.before.len() + stem.after.len());
    like.with_file_name(format!("{}{number:0width$}{}.exr", stem.before, stem.after)).display().to_string()
}
