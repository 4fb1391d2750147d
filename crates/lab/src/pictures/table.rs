//! Numbers in aligned columns.

use crate::pictures::PictureError;
use comfy_table::{presets, Cell, CellAlignment, ContentArrangement, Table};

/// A column of numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Heading, with the unit if there is one.
    pub name: String,
    /// Digits after the point; more than 17 count as 17, which is all that an `f64` has.
    pub decimals: usize,
}

impl Column {
    /// A column with `decimals` digits after the point.
    pub fn new(name: impl Into<String>, decimals: usize) -> Self {
        Self { name: name.into(), decimals }
    }

    /// A value as the column shows it: with its decimals, and as a dash if it is NaN.
    pub fn show(&self, value: f64) -> String {
        match value.is_nan() {
            true => "-".into(),
            false => format!("{value:.0$}", self.decimals.min(17)),
        }
    }
}

/// A table with one named row of numbers for each denoiser, scene or pass. It displays as Markdown, aligned so that it
/// is as readable in a terminal.
#[derive(Debug, Clone)]
pub struct TextTable {
    corner: String,
    columns: Vec<Column>,
    rows: Vec<(String, Vec<f64>)>,
}

impl TextTable {
    /// A table without rows; `corner` is the heading above the names of the rows.
    pub fn new(corner: impl Into<String>, columns: impl IntoIterator<Item = Column>) -> Self {
        Self { corner: corner.into(), columns: columns.into_iter().collect(), rows: Vec::new() }
    }

    /// Adds a row at the bottom. A value that is NaN was not measured and is shown as a dash.
    ///
    /// # Errors
    /// [`PictureError::Row`] if there is not one value for each column.
    pub fn row(&mut self, name: impl Into<String>, values: &[f64]) -> Result<(), PictureError> {
        let (name, given, columns) = (name.into(), values.len(), self.columns.len());
        if given != columns {
            return Err(PictureError::Row { name, given, columns });
        }
        self.rows.push((name, values.to_vec()));
        Ok(())
    }

    /// Heading above the names of the rows.
    pub fn corner(&self) -> &str {
        &self.corner
    }

    /// Columns of values, from the left.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Name and values of each row, from the top.
    pub fn rows(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.rows.iter().map(|(name, values)| (name.as_str(), values.as_slice()))
    }
}

impl std::fmt::Display for TextTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let right = |text: String| Cell::new(text).set_alignment(CellAlignment::Right);
        let mut table = Table::new();
        // The width of a terminal must not change what is written to a file.
        table.load_style(presets::ASCII_MARKDOWN).set_content_arrangement(ContentArrangement::Disabled);
        let headings = self.columns.iter().map(|c| right(c.name.clone()));
        table.set_header(std::iter::once(Cell::new(&self.corner)).chain(headings));
        for (name, values) in &self.rows {
            let cells = values.iter().zip(&self.columns).map(|(v, c)| right(c.show(*v)));
            table.add_row(std::iter::once(Cell::new(name)).chain(cells));
        }
        writeln!(f, "{table}")
    }
}
