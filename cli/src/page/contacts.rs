//! How often, when and how long something touches, or is apart: journals beyond their clearance, teeth that part.

use serde::Serialize;

/// How often that was over the whole run, as a page has it.
#[derive(Debug, Serialize)]
pub(super) struct Contact {
    title: String,
    /// Times that it began.
    times: usize,
    /// When it first was (s).
    first_s: f64,
    /// The part of the rows in which it was.
    share: f64,
    /// The longest of them (s), and whether that lasts to the end of the run.
    longest_s: f64,
    lasts: bool,
}

/// The same while the rows pass.
#[derive(Debug, Default)]
pub(super) struct Contacts {
    times: usize,
    first: Option<f64>,
    rows: [usize; 2],
    /// Since when it is so.
    since: Option<f64>,
    longest: f64,
    lasts: bool,
}

impl Contacts {
    /// Takes a row: its time (s), and whether it is so.
    pub(super) fn add(&mut self, time: f64, is_so: bool) {
        self.rows = [self.rows[0] + usize::from(is_so), self.rows[1] + 1];
        if !is_so {
            self.since = None;
            self.lasts = false;
            return;
        }
        if self.since.is_none() {
            self.times += 1;
        }
        self.first = self.first.or(Some(time));
        let since = *self.since.get_or_insert(time);
        if time - since >= self.longest {
            (self.longest, self.lasts) = (time - since, true);
        }
    }

    /// Under a title; none where it never was so.
    pub(super) fn finish(self, title: &str) -> Option<Contact> {
        Some(Contact {
            title: title.to_owned(),
            times: self.times,
            first_s: self.first?,
            share: self.rows[0] as f64 / self.rows[1] as f64,
            longest_s: self.longest,
            lasts: self.lasts,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contacts_are_counted_with_their_times() {
        let of = |ratios: &[f64]| {
            let mut own = Contacts::default();
            ratios.iter().enumerate().for_each(|(k, ratio)| own.add(k as f64, *ratio > 1.0));
            own.finish("left")
        };
        let found = of(&[0.5, 1.2, 1.5, 1.1, 0.9, 1.0, 1.3, 0.2]).expect("contacts");
        assert_eq!((found.times, found.first_s, found.longest_s), (2, 1.0, 2.0));
        assert_eq!((found.share, found.lasts), (0.5, false));
        let found = of(&[1.2, 0.1, 1.2, 1.2]).expect("contacts");
        assert_eq!((found.times, found.longest_s, found.lasts), (2, 1.0, true));
        assert!(of(&[1.0, 0.3]).is_none());
    }
}
