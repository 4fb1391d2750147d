//! What an experiment found, as it is kept in a file.

use crate::Result;
use atrous_lab::pages::{Curves, Section};
use atrous_lab::pictures::{Column, TextTable};
use serde::{Deserialize, Serialize};

use crate::evaluate::claims::Claim;

/// Tables, curves and claims of an experiment.
#[derive(Default, Serialize, Deserialize)]
pub struct Findings {
    /// Heading: what was measured, and the figures of papers that it is a counterpart of.
    pub title: String,
    /// How.
    pub text: String,
    /// Figures.
    pub tables: Vec<Figures>,
    /// Lines over frames.
    pub curves: Vec<Lines>,
    /// What is claimed of them.
    pub claims: Vec<Claim>,
}

/// A table of numbers.
#[derive(Serialize, Deserialize)]
pub struct Figures {
    corner: String,
    columns: Vec<(String, usize)>,
    /// JSON has no NaN.
    rows: Vec<(String, Vec<Option<f64>>)>,
}

/// Lines of one plot, a value for each frame.
#[derive(Serialize, Deserialize)]
pub struct Lines {
    /// Heading.
    pub title: String,
    /// Frame of the first values.
    pub first_frame: u32,
    /// Name and values of each line.
    pub series: Vec<(String, Vec<f64>)>,
}

impl Findings {
    /// As Markdown.
    ///
    /// # Errors
    /// None in practice.
    pub fn markdown(&self) -> Result<String> {
        let mut text = format!("### {}\n\n{}\n", self.title, self.text);
        for table in &self.tables {
            text += &format!("\n{}", table.table()?);
        }
        Ok(text)
    }

    /// In a section of a page.
    ///
    /// # Errors
    /// None in practice.
    pub fn show(&self, section: &mut Section) -> Result<()> {
        section.text(self.text.as_str());
        for table in &self.tables {
            section.table(&table.table()?);
        }
        for lines in &self.curves {
            let curves = Curves::new(lines.title.as_str()).first_frame(lines.first_frame);
            section.curves(lines.series.iter().fold(curves, |curves, (name, values)| curves.series(name, values.as_slice())))?;
        }
        Ok(())
    }
}

impl Figures {
    /// A table without rows; columns have a name and digits behind the point.
    pub fn new<'a>(corner: &str, columns: impl IntoIterator<Item = (&'a str, usize)>) -> Self {
        let columns = columns.into_iter().map(|(name, decimals)| (name.to_owned(), decimals)).collect();
        Self { corner: corner.to_owned(), columns, rows: Vec::new() }
    }

    /// Adds a row; NaN: not measured.
    pub fn row(&mut self, name: &str, values: &[f64]) {
        self.rows.push((name.to_owned(), values.iter().map(|value| value.is_finite().then_some(*value)).collect()));
    }

    /// Whether anything in it was measured.
    pub fn has_values(&self) -> bool {
        self.rows.iter().flat_map(|(_, values)| values).any(Option::is_some)
    }

    /// To be shown.
    ///
    /// # Errors
    /// A row with another number of values than columns.
    pub fn table(&self) -> Result<TextTable> {
        let columns = self.columns.iter().map(|(name, decimals)| Column::new(name.as_str(), *decimals));
        let mut table = TextTable::new(self.corner.as_str(), columns);
        for (name, values) in &self.rows {
            table.row(name, &values.iter().map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<_>>())?;
        }
        Ok(table)
    }
}
