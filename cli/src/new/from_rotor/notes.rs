//! What differs from the rotor of the file, or has no counterpart: told in the case and on the terminal.

/// Such differences, each with the elements that it is about, in the order in which they were found.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Notes(Vec<(String, Vec<String>)>);

/// So many elements are named.
const NAMED: usize = 3;

impl Notes {
    /// A difference of the whole rotor.
    pub(super) fn add(&mut self, what: impl Into<String>) {
        self.0.push((what.into(), Vec::new()));
    }

    /// A difference of one element, of several that differ alike one line.
    pub(super) fn of(&mut self, tag: &str, what: impl Into<String>) {
        let what = what.into();
        match self.0.iter_mut().find(|own| own.0 == what && !own.1.is_empty()) {
            Some(own) => own.1.push(tag.to_owned()),
            None => self.0.push((what, vec![tag.to_owned()])),
        }
    }

    /// A line for each.
    pub(super) fn lines(&self) -> impl Iterator<Item = String> {
        self.0.iter().map(|(what, tags)| {
            let more = tags.len().saturating_sub(NAMED);
            let named: Vec<&str> = tags.iter().take(NAMED).map(String::as_str).collect();
            let plural = if more == 0 { String::new() } else { format!(" and {more} more") };
            match tags.is_empty() {
                true => what.clone(),
                false => format!("{}{plural}: {what}", named.join(", ")),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_differences_are_one_line() {
        let mut notes = Notes::default();
        for n in 0..5 {
            notes.of(&format!("Shaft {n}"), "no shear");
        }
        notes.add("all of it");
        notes.of("Disk 0", "thin");
        let lines: Vec<String> = notes.lines().collect();
        let wanted =
            ["Shaft 0, Shaft 1, Shaft 2 and 2 more: no shear", "all of it", "Disk 0: thin"];
        assert_eq!(lines, wanted);
    }
}
