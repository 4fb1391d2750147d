//! Pictures, strips, plots, tables and pages, in one program.

mod pictures;
mod plots_and_tables;
mod strips;
mod structure;
mod support;
