//! Numbers and words in rows.

use crate::pages::PageError;
use crate::pictures::TextTable;
use maud::{html, Markup};

/// One cell: what is shown, and for a number its value, by which rows are sorted.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    text: String,
    value: Option<f64>,
}

impl Cell {
    /// A number as `text` shows it. NaN was not measured: it is never the best, and comes last in any order.
    pub fn number(value: f64, text: impl Into<String>) -> Self {
        Self { text: text.into(), value: Some(value) }
    }
}

/// A cell of words.
impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), value: None }
    }
}

/// The end of a column at which its best value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Best {
    /// Less is better, as for an error.
    Lowest,
    /// More is better, as for PSNR.
    Highest,
}

/// A table with one named row for each preset, scene or pass. A click on a heading sorts the rows.
#[derive(Debug, Clone)]
pub struct Table {
    corner: String,
    columns: Vec<(String, Option<Best>)>,
    rows: Vec<(String, Vec<Cell>)>,
}

impl Table {
    /// A table without rows; `corner` is the heading above the names of the rows.
    pub fn new<C: Into<String>>(corner: impl Into<String>, columns: impl IntoIterator<Item = C>) -> Self {
        let columns = columns.into_iter().map(|name| (name.into(), None)).collect();
        Self { corner: corner.into(), columns, rows: Vec::new() }
    }

    /// Adds a row at the bottom.
    ///
    /// # Errors
    /// [`PageError::Row`] if there is not one cell for each column.
    pub fn row<C: Into<Cell>>(&mut self, name: impl Into<String>, cells: impl IntoIterator<Item = C>) -> Result<(), PageError> {
        let cells: Vec<_> = cells.into_iter().map(Into::into).collect();
        let (name, given, columns) = (name.into(), cells.len(), self.columns.len());
        if given != columns {
            return Err(PageError::Row { name, given, columns });
        }
        self.rows.push((name, cells));
        Ok(())
    }

    /// Marks the best number of a column bold, and every other that reads the same.
    ///
    /// # Errors
    /// [`PageError::NoColumn`] if no column has that name.
    pub fn best(&mut self, column: &str, best: Best) -> Result<(), PageError> {
        let found = self.columns.iter_mut().find(|(name, _)| name == column);
        found.ok_or_else(|| PageError::NoColumn(column.into()))?.1 = Some(best);
        Ok(())
    }

    fn best_text(&self, column: usize) -> Option<&str> {
        let best = self.columns[column].1?;
        let numbers = self.rows.iter().filter_map(|(_, cells)| Some((cells[column].value?, cells[column].text.as_str())));
        let numbers = numbers.filter(|(value, _)| !value.is_nan());
        let found = match best {
            Best::Lowest => numbers.min_by(|a, b| a.0.total_cmp(&b.0)),
            Best::Highest => numbers.max_by(|a, b| a.0.total_cmp(&b.0)),
        };
        found.map(|(_, text)| text)
    }

    pub(crate) fn markup(&self) -> Markup {
        let best: Vec<_> = (0..self.columns.len()).map(|column| self.best_text(column)).collect();
        // A column of numbers is aligned at their last digit, with its heading.
        let numeric = |column: usize| self.rows.iter().any(|(_, cells)| cells[column].value.is_some());
        html! {
            div.scroll { table {
                thead { tr {
                    th scope="col" { button type="button" { (self.corner) } }
                    @for (i, (name, best)) in self.columns.iter().enumerate() {
                        th scope="col" .number[numeric(i)] data-from=[(*best == Some(Best::Highest)).then_some("highest")] {
                            button type="button" { (name) }
                        }
                    }
                } }
                tbody { @for (name, cells) in &self.rows { tr {
                    th scope="row" { (name) }
                    @for (i, cell) in cells.iter().enumerate() {
                        td .number[numeric(i)] data-value=[cell.value.map(script_number)] {
                            @if cell.value.is_some() && best[i] == Some(cell.text.as_str()) { strong { (cell.text) } }
                            @else { (cell.text) }
                        }
                    }
                } } }
            } }
        }
    }
}

/// A number as scripts read it, which write infinity out.
fn script_number(value: f64) -> String {
    value.to_string().replace("inf", "Infinity")
}

/// The same table in a page.
impl From<&TextTable> for Table {
    fn from(table: &TextTable) -> Self {
        let row = |(name, values): (&str, &[f64])| {
            let cells = values.iter().zip(table.columns()).map(|(v, column)| Cell::number(*v, column.show(*v)));
            (name.to_owned(), cells.collect())
        };
        let columns = table.columns().iter().map(|c| (c.name.clone(), None)).collect();
        Self { corner: table.corner().into(), columns, rows: table.rows().map(row).collect() }
    }
}
