//! Names of a case for what a file calls by tags.

use std::collections::BTreeSet;

/// Names that are taken.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// A name for a tag: letters, digits and `_`, different from all others also where capitals do not count.
    pub(super) fn of(&mut self, tag: &str, usual: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        let letters: String = tag.chars().take(60).map(plain).collect();
        let words: Vec<&str> = letters.split('_').filter(|own| !own.is_empty()).collect();
        let base = words.join("_");
        let base = if base.is_empty() || base == "ground" { usual.to_owned() } else { base };
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        let name = std::iter::once(base.clone()).chain(numbered).find(|own| !self.0.contains(own));
        let name = name.expect("numbers do not end");
        self.0.insert(name.clone());
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_differ() {
        let mut names = Names::default();
        let tags = ["Bearing 0", "bearing-0", "Lager #1 (vörn)", "", "ground", "??"];
        let found = tags.map(|tag| names.of(tag, "joint"));
        assert_eq!(
            found,
            ["bearing_0", "bearing_0_2", "lager_1_v_rn", "joint", "joint_2", "joint_3"]
        );
    }
}
