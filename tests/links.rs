//! Links of the pages: each leads to a file that exists, and to a heading that it has.

use atrous_harness::DeviceTest;
use std::path::{Path, PathBuf};

pub const TESTS: &[DeviceTest] = &[
    ("every_link_of_a_page_leads_somewhere", every_link_of_a_page_leads_somewhere),
    ("a_stranger_finds_answers_in_two_clicks", a_stranger_finds_answers_in_two_clicks),
];

/// A question as the index asks it, and what the place that it links to must say.
const QUESTIONS: [(&str, &str); 7] = [
    ("Which preset fits my engine?", "**Start with `best`**"),
    ("What does it need, take and cost?", "| preset, signals | passes | bytes per pixel | time |"),
    ("Who places barriers?", "**You place the barriers**"),
    ("How do I give jitter?", "set `FrameParams::jitter` in pixels"),
    ("Why does my picture ghost", "## Ghosting behind moving objects"),
    ("How do I add a stage?", "`src/nodes/"),
    ("What is my setting called?", "| NRD | atrous |"),
];

/// One click from README.md to the index, one from the row of the question.
fn a_stranger_finds_answers_in_two_clicks() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let index = root.join("docs/README.md");
    let read = |path: &Path| std::fs::read_to_string(path).expect("a page");
    assert!(read(&root.join("README.md")).contains("](docs/README.md)"), "README.md has no link to the index");
    let rows = read(&index);
    for (question, answer) in QUESTIONS {
        let row = rows.lines().find(|row| row.starts_with('|') && row.contains(question));
        let row = row.unwrap_or_else(|| panic!("docs/README.md does not ask: {question}"));
        let (_, link) = row.split_once("](").unwrap_or_else(|| panic!("no link in: {row}"));
        let (target, _) = link.split_once(')').expect("the link ends");
        let (file, heading) = target.split_once('#').unwrap_or((target, ""));
        let page = read(&index.with_file_name(file));
        let begin = page.lines().position(|line| heading.is_empty() || line.starts_with('#') && anchor(line) == heading);
        let from: Vec<&str> = page.lines().skip(begin.unwrap_or_else(|| panic!("{file} has no `{heading}`"))).collect();
        let until = from.iter().skip(1).position(|line| line.starts_with("## ") && !heading.is_empty());
        let section = from[..until.map_or(from.len(), |line| line + 1)].join("\n");
        assert!(section.contains(answer), "{question} leads to {target}, which does not say: {answer}");
    }
}

fn every_link_of_a_page_leads_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pages = vec![root.join("README.md"), root.join("CHANGELOG.md")];
    for folder in ["docs", "src"] {
        find_pages(&root.join(folder), &mut pages);
    }
    assert!(pages.len() > 30, "{pages:?}");
    let broken: Vec<String> = pages.iter().flat_map(|page| broken_links(page)).collect();
    assert!(broken.is_empty(), "links that lead nowhere:\n{}", broken.join("\n"));
}

fn find_pages(folder: &Path, pages: &mut Vec<PathBuf>) {
    for entry in folder.read_dir().expect("a folder").flatten().map(|entry| entry.path()) {
        if entry.is_dir() {
            find_pages(&entry, pages);
        } else if entry.extension().is_some_and(|extension| extension == "md") {
            pages.push(entry);
        }
    }
}

fn broken_links(page: &Path) -> Vec<String> {
    let text = prose(&std::fs::read_to_string(page).expect("a page"));
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    let inside = targets.filter(|target| !target.contains("://"));
    inside.filter(|target| !exists(page, target)).map(|target| format!("{}: {target}", page.display())).collect()
}

fn exists(page: &Path, target: &str) -> bool {
    let (file, heading) = target.split_once('#').map_or((target, None), |(file, heading)| (file, Some(heading)));
    let path = match file {
        "" => page.to_owned(),
        file => page.parent().expect("a folder").join(file),
    };
    path.exists() && heading.is_none_or(|heading| anchors(&path).iter().any(|anchor| anchor == heading))
}

/// The headings of a page, as addresses.
fn anchors(page: &Path) -> Vec<String> {
    let text = prose(&std::fs::read_to_string(page).expect("a page"));
    text.lines().filter(|line| line.starts_with('#')).map(anchor).collect()
}

/// The address of a heading.
fn anchor(line: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    let heading = line.trim_start_matches('#').trim().to_lowercase();
    heading.chars().filter(kept).collect::<String>().replace(' ', "-")
}

/// A page without its code.
fn prose(page: &str) -> String {
    page.split("```").step_by(2).collect()
}
