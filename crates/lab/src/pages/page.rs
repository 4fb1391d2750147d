//! The file as a whole.

use crate::pages::anchor::Anchors;
use crate::pages::heat_map::css_gradient;
use crate::pages::{PageError, Section};
use atrous_files::{publish, Existing};
use maud::{html, PreEscaped, DOCTYPE};
use std::io::Write;
use std::path::Path;

const STYLE: &str = include_str!("page.css");
const SCRIPTS: [&str; 3] = [include_str!("comparison.js"), include_str!("curves.js"), include_str!("table.js")];
/// What a browser may load: nothing but what the file holds.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// A report: a title, an introduction, a table of contents and sections.
#[derive(Debug, Clone)]
pub struct Page {
    title: String,
    introduction: Vec<String>,
    sections: Vec<Section>,
}

impl Page {
    /// A page without sections.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), introduction: Vec::new(), sections: Vec::new() }
    }

    /// Adds a paragraph below the title.
    pub fn introduction(&mut self, text: impl Into<String>) {
        self.introduction.push(text.into());
    }

    /// Adds a section at the bottom, to be filled.
    pub fn section(&mut self, heading: impl Into<String>) -> &mut Section {
        self.sections.push(Section::new(heading.into()));
        let last = self.sections.len() - 1;
        &mut self.sections[last]
    }

    /// The page as HTML.
    pub fn html(&self) -> String {
        let mut anchors = Anchors::default();
        let sections: Vec<_> = self.sections.iter().map(|s| (anchors.name(&s.heading), s)).collect();
        html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(POLICY);
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) ".magma{background:" (PreEscaped(css_gradient())) "}" }
                }
                body {
                    header {
                        h1 { (self.title) }
                        @for text in &self.introduction { p { (text) } }
                    }
                    // One section alone needs no way to it.
                    @if sections.len() > 1 {
                        nav aria-label="Contents" { ul { @for (anchor, section) in &sections {
                            li { a href=(format!("#{anchor}")) { (section.heading) } }
                        } } }
                    }
                    main { @for (anchor, section) in &sections { (section.markup(anchor)) } }
                    @for script in SCRIPTS { script { (PreEscaped(script)) } }
                }
            }
        }
        .into_string()
    }

    /// Writes the page, in the place of an older file.
    ///
    /// A reader never sees half a file, and a failure leaves an older file as it was.
    ///
    /// # Errors
    /// [`PageError::File`], which names the file.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), PageError> {
        self.publish(path.as_ref(), Existing::Replaced)
    }

    /// Writes the page as [`Self::write`] does, unless there is a file of that name.
    ///
    /// # Errors
    /// Errors of [`Self::write`], with [`std::io::ErrorKind::AlreadyExists`].
    pub fn write_new(&self, path: impl AsRef<Path>) -> Result<(), PageError> {
        self.publish(path.as_ref(), Existing::Kept)
    }

    fn publish(&self, path: &Path, existing: Existing) -> Result<(), PageError> {
        let html = self.html();
        publish(path, existing, |file| file.write_all(html.as_bytes()))
            .map_err(|source| PageError::File { path: path.into(), source })
    }
}
