//! Lines for the terminal. Names of files and channels come from others, and may hold codes that move
//! the cursor or rename the window: they are shown, and not obeyed.

use std::fmt::Write;

/// A text without control characters but for line ends.
pub fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c.is_control() && c != '\n' {
            // Writing to a string cannot fail.
            true => _ = write!(plain, "\\u{{{:x}}}", u32::from(c)),
            false => plain.push(c),
        }
    }
    plain
}

/// Prints a line on stderr.
pub fn tell(line: &str) {
    eprintln!("{}", plain(line));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_are_shown() {
        assert_eq!(plain("a\u{1b}[31mb\n\u{9b}2Jc\u{7}é"), "a\\u{1b}[31mb\n\\u{9b}2Jc\\u{7}é");
    }
}
