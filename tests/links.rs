//! Links of the pages: each leads to a file that exists, and to a heading that it has.

use atrous_harness::DeviceTest;
use std::path::{Path, PathBuf};

pub const TESTS: &[DeviceTest] = &[("every_link_of_a_page_leads_somewhere", every_link_of_a_page_leads_somewhere)];

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
    let headings = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    headings.map(|heading| heading.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")).collect()
}

/// A page without its code.
fn prose(page: &str) -> String {
    page.split("```").step_by(2).collect()
}
