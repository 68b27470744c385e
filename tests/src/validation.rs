//! The page docs/validation.md: numbers that tests hold against closed forms, other programs and papers.
//!
//! A section of the page belongs to one test, which computes its numbers, holds them against the others', and then against the
//! page. With WHIRL_RENEW_GOLDEN=1 the test writes its section anew. So nothing on the page is older than the code, and nothing is
//! written by hand but the text above the sections.

use std::env;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::sync::Mutex;

/// Share of the tolerance by which a number on the page may differ from the one that is computed: processors round differently.
const ON_PAGE: f64 = 0.05;
/// Digits that are shown.
const DIGITS: usize = 7;

const HEAD: &str = "| What | Theirs | whirl | Difference | Tolerance |\n|---|--:|--:|--:|--:|\n";

/// Tests of one program run side by side.
static PAGE: Mutex<()> = Mutex::new(());

/// What one test compares with one source.
pub struct Section {
    title: String,
    about: String,
    rows: Vec<Row>,
}

struct Row {
    what: String,
    theirs: f64,
    ours: f64,
    tolerance: f64,
}

impl Row {
    /// By which share of theirs ours differ; of 0 by how much.
    fn apart(&self) -> f64 {
        if self.theirs == 0.0 { self.ours } else { self.ours / self.theirs - 1.0 }
    }

    fn line(&self) -> String {
        let Row { what, theirs, ours, tolerance } = self;
        let [theirs, ours] = [theirs, ours].map(|own| shown(*own));
        format!("| {what} | {theirs} | {ours} | {:.1e} | {tolerance:e} |\n", self.apart())
    }
}

impl Section {
    /// A section. `source`: closed form, program or paper; `command`: what computes it again.
    pub fn new(title: &str, source: &str, command: &str) -> Section {
        Section {
            title: title.to_owned(),
            about: format!("{source}. `{command}`"),
            rows: Vec::new(),
        }
    }

    /// Holds a number against another one. `tolerance`: share of `theirs`; where that is 0, of 1.
    ///
    /// # Panics
    /// They differ by more, or ours is no number.
    pub fn compare(&mut self, what: &str, theirs: f64, ours: f64, tolerance: f64) {
        let row = Row { what: what.to_owned(), theirs, ours, tolerance };
        let apart = row.apart();
        assert!(
            apart.abs() <= tolerance,
            "{}, {what}: {ours}, not {theirs} ({apart:e})",
            self.title
        );
        self.rows.push(row);
    }

    /// How many numbers were compared.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Holds the section against the page, or writes it there.
    ///
    /// # Panics
    /// The page says something else.
    pub fn finish(self) {
        let _alone = PAGE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/validation.md");
        let page = fs::read_to_string(&path).expect("docs/validation.md");
        let head = format!("## {}\n", self.title);
        let start = page.find(&format!("\n{head}")).map(|place| place + 1);
        let end = |start: usize| {
            page[start + head.len()..]
                .find("\n## ")
                .map_or(page.len(), |next| start + head.len() + next + 1)
        };
        let known = start.map(|start| (start, end(start)));
        if env::var_os("WHIRL_RENEW_GOLDEN").is_some() {
            let (start, end) = known.unwrap_or((page.len(), page.len()));
            let blank = if start == page.len() { "\n" } else { "" };
            let after = if end == page.len() { "" } else { "\n" };
            let page = format!("{}{blank}{}{after}{}", &page[..start], self.text(), &page[end..]);
            fs::write(&path, page).expect("the page can be written");
            return;
        }
        let (start, end) =
            known.unwrap_or_else(|| panic!("docs/validation.md has no section `{}`", self.title));
        self.holds(&page[start..end]);
    }

    fn text(&self) -> String {
        let mut text = format!("## {}\n\n{}\n\n{HEAD}", self.title, self.about);
        self.rows.iter().for_each(|row| text.push_str(&row.line()));
        text
    }

    /// Holds every line against that of the page: numbers of ours as numbers, all else to the letter.
    fn holds(&self, page: &str) {
        let renew = "run the test with WHIRL_RENEW_GOLDEN=1";
        let own = self.text();
        let mut lines = page.trim_end().lines();
        let first = own.lines().count() - self.rows.len();
        for own in own.lines().take(first) {
            assert_eq!(lines.next(), Some(own), "docs/validation.md: {renew}");
        }
        for row in &self.rows {
            let line = lines.next().unwrap_or_default();
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            let (own, mut differs) = (row.line(), String::new());
            let own_cells: Vec<&str> = own.split('|').map(str::trim).collect();
            for place in [1, 2, 5] {
                if cells.get(place) != own_cells.get(place) {
                    let _ =
                        write!(differs, "{:?} for {:?}; ", cells.get(place), own_cells.get(place));
                }
            }
            let shown: f64 = cells.get(3).and_then(|own| own.parse().ok()).unwrap_or(f64::NAN);
            let size = if row.theirs == 0.0 { 1.0 } else { row.theirs.abs() };
            let rounding = 10f64.powi(1 - DIGITS as i32) * row.ours.abs();
            if !((shown - row.ours).abs() <= ON_PAGE * row.tolerance * size + rounding) {
                let _ = write!(differs, "{shown} for {}", row.ours);
            }
            assert!(differs.is_empty(), "docs/validation.md, {}: {differs}: {renew}", self.title);
        }
        assert_eq!(lines.next(), None, "docs/validation.md, {}: {renew}", self.title);
    }
}

/// A number with [`DIGITS`] digits, as short as it is.
fn shown(value: f64) -> String {
    let short: f64 = format!("{value:.*e}", DIGITS - 1).parse().expect("a number");
    let size = short.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) {
        format!("{short:e}")
    } else {
        short.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_with_their_digits() {
        for (value, text) in [(14.609_875_2, "14.60988"), (0.0, "0"), (1e-9, "1e-9"), (3.0, "3")] {
            assert_eq!(shown(value), text);
        }
    }

    #[test]
    fn what_the_page_says_is_compared() {
        let of = |ours: f64| {
            let mut own = Section::new("a", "b", "c");
            own.compare("d", 2.0, ours, 1e-3);
            own
        };
        let page = of(2.0001).text();
        of(2.0001).holds(&page);
        of(2.000_11).holds(&page);
        for other in [of(2.0005).text(), page.replace("| d ", "| e "), page.clone() + "| more |"] {
            let differs = std::panic::catch_unwind(|| of(2.0001).holds(&other));
            assert!(differs.is_err(), "{other}");
        }
        assert!(std::panic::catch_unwind(|| of(2.003)).is_err());
    }
}
