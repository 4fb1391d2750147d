//! Counting of what a stage found.

/// Counts the texels that are true.
pub(crate) fn count(flags: impl Iterator<Item = bool>) -> u32 {
    flags.filter(|&found| found).count() as u32
}
