//! Names of places in a page.

use std::collections::HashSet;

/// Gives each heading a name for links: letters, digits and dashes, and no name twice.
#[derive(Default)]
pub struct Anchors(HashSet<String>);

impl Anchors {
    pub fn name(&mut self, heading: &str) -> String {
        let words = heading.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty());
        let mut name = words.collect::<Vec<_>>().join("-").to_ascii_lowercase();
        if name.is_empty() {
            name.push_str("section");
        }
        let free = (1..).map(|n| if n == 1 { name.clone() } else { format!("{name}-{n}") }).find(|n| !self.0.contains(n));
        let free = free.unwrap_or(name);
        self.0.insert(free.clone());
        free
    }
}

#[cfg(test)]
mod tests {
    use super::Anchors;

    #[test]
    fn names_are_plain_and_never_given_twice() {
        let mut anchors = Anchors::default();
        let names = ["Cornell box, 64 frames", "a&b", "A <b>", "a b 2", "a-b", "…", ""].map(|h| anchors.name(h));
        assert_eq!(names, ["cornell-box-64-frames", "a-b", "a-b-2", "a-b-2-2", "a-b-3", "section", "section-2"]);
    }
}
