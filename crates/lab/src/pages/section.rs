//! A part of a page under a heading.

use crate::pages::{Comparison, Curves, PageError, Table};
use maud::{html, Markup};

/// A heading, and what stands under it in the order in which it was added.
#[derive(Debug, Clone)]
pub struct Section {
    pub(crate) heading: String,
    blocks: Vec<Block>,
}

#[derive(Debug, Clone)]
enum Block {
    Text(String),
    Table(Table),
    Comparison(Comparison),
    Curves(Curves),
}

impl Section {
    pub(crate) fn new(heading: String) -> Self {
        Self { heading, blocks: Vec::new() }
    }

    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds a table: a [`Table`], or a [`TextTable`](crate::pictures::TextTable) by reference.
    pub fn table(&mut self, table: impl Into<Table>) {
        self.blocks.push(Block::Table(table.into()));
    }

    /// Adds pictures to compare.
    ///
    /// # Errors
    /// [`PageError::TooFewPictures`] if there are fewer than two.
    pub fn comparison(&mut self, comparison: Comparison) -> Result<(), PageError> {
        comparison.check()?;
        self.blocks.push(Block::Comparison(comparison));
        Ok(())
    }

    /// Adds curves.
    ///
    /// # Errors
    /// [`PageError::NothingToPlot`] if no value of any series is finite.
    pub fn curves(&mut self, curves: Curves) -> Result<(), PageError> {
        curves.check()?;
        self.blocks.push(Block::Curves(curves));
        Ok(())
    }

    pub(crate) fn markup(&self, anchor: &str) -> Markup {
        html! {
            section id=(anchor) {
                h2 { (self.heading) " " a.anchor href=(format!("#{anchor}")) aria-label="Link to this section" { "#" } }
                @for block in &self.blocks {
                    @match block {
                        Block::Text(text) => p { (text) },
                        Block::Table(table) => (table.markup()),
                        Block::Comparison(comparison) => (comparison.markup()),
                        Block::Curves(curves) => (curves.markup()),
                    }
                }
            }
        }
    }
}
