//! The lines of a universal file, dataset by dataset.

use super::super::raw::LinePosition;

/// What to do where a file does not say what it should.
pub(super) const DAMAGED: &str = "is the file cut off or edited? Export it again";

/// Why reading cannot go on.
#[derive(Debug)]
pub(super) struct Stop {
    pub(super) place: LinePosition,
    pub(super) what: String,
    pub(super) help: &'static str,
}

/// A dataset: its number, and its lines with their numbers from 1.
#[derive(Debug)]
pub(super) struct Dataset<'t> {
    pub(super) number: u64,
    lines: Vec<(usize, &'t str)>,
    next: usize,
}

fn place(line: usize) -> LinePosition {
    LinePosition { file: 0, line, column: 0 }
}

/// All datasets of a file: each stands between lines of -1.
pub(super) fn datasets(text: &str) -> Result<Vec<Dataset<'_>>, Stop> {
    let mut all = Vec::new();
    let mut lines = (1..).zip(text.lines());
    while let Some((line, words)) = lines.next() {
        let words = words.trim();
        if words.is_empty() {
            continue;
        }
        let stop = |line: usize, what: String| Stop { place: place(line), what, help: DAMAGED };
        if words != "-1" {
            let shown: String = words.chars().take(24).collect();
            return Err(stop(
                line,
                format!("a dataset begins with -1, but this is `{}`", shown.escape_debug()),
            ));
        }
        let Some((line, words)) = lines.next() else {
            return Err(stop(
                line,
                "the file ends where the number of a dataset should stand".to_owned(),
            ));
        };
        let Ok(number) = words.trim().parse() else {
            let shown: String = words.trim().chars().take(24).collect();
            return Err(stop(
                line,
                format!("`{}` is not the number of a dataset that is read", shown.escape_debug()),
            ));
        };
        let mut own = Vec::new();
        loop {
            match lines.next() {
                Some((_, words)) if words.trim() == "-1" => break,
                Some(line) => own.push(line),
                None => {
                    return Err(stop(line, format!("the file ends within this dataset {number}")));
                }
            }
        }
        all.push(Dataset { number, lines: own, next: 0 });
    }
    Ok(all)
}

impl<'t> Dataset<'t> {
    /// The next line, if there is one.
    pub(super) fn line(&mut self) -> Option<(LinePosition, &'t str)> {
        let (line, words) = *self.lines.get(self.next)?;
        self.next += 1;
        Some((place(line), words))
    }

    /// Goes back by a line.
    pub(super) fn back(&mut self) {
        self.next = self.next.saturating_sub(1);
    }

    /// The next line, which must be there.
    pub(super) fn demand(&mut self, what: &str) -> Result<(LinePosition, &'t str), Stop> {
        let last = self.lines.last().map_or(0, |own| own.0);
        self.line().ok_or_else(|| Stop {
            place: place(last),
            what: format!("dataset {} ends where {what} should stand", self.number),
            help: DAMAGED,
        })
    }

    /// Whole numbers of the next line, as many as there are; `least` of them.
    pub(super) fn whole(
        &mut self,
        what: &str,
        least: usize,
    ) -> Result<(LinePosition, Vec<i64>), Stop> {
        let (place, line) = self.demand(what)?;
        match whole_numbers(line).filter(|own| own.len() >= least) {
            Some(numbers) => Ok((place, numbers)),
            None => Err(expected(place, what, line)),
        }
    }

    /// Three reals of the next line.
    pub(super) fn reals(&mut self, what: &str) -> Result<[f64; 3], Stop> {
        let (place, line) = self.demand(what)?;
        three(line).ok_or_else(|| expected(place, what, line))
    }
}

/// An error at a line that should say something else.
pub(super) fn expected(place: LinePosition, what: &str, line: &str) -> Stop {
    let shown: String = line.trim().chars().take(40).collect();
    let what = format!("{what} should stand here, not `{}`", shown.escape_debug());
    Stop { place, what, help: DAMAGED }
}

/// The numbers of a line, if all are whole.
pub(super) fn whole_numbers(line: &str) -> Option<Vec<i64>> {
    line.split_whitespace().map(|own| own.parse().ok()).collect()
}

/// Three numbers with exponents of E or D, all finite.
pub(super) fn three(words: &str) -> Option<[f64; 3]> {
    let mut numbers = words
        .split_whitespace()
        .map(|own| own.replace(['D', 'd'], "e").parse().ok().filter(|own: &f64| own.is_finite()));
    let three = [numbers.next()??, numbers.next()??, numbers.next()??];
    numbers.next().is_none().then_some(three)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn datasets_stand_between_marks() {
        let text = "    -1\n   164\n  1 SI\n    -1\n\n    -1\n  2411\n 1 1\n 2\n    -1\n";
        let all = datasets(text).expect("datasets");
        let shapes: Vec<(u64, usize)> =
            all.iter().map(|own| (own.number, own.lines.len())).collect();
        assert_eq!(shapes, [(164, 1), (2411, 2)]);
        assert_eq!(all[1].lines[1].0, 9);
        for (cut, wanted) in [
            ("    -1\n  2411\n 1 1\n", "ends within this dataset 2411"),
            ("    -1\n", "the number of a dataset should stand"),
            ("    -1\n    58b\n    -1\n", "`58b` is not the number"),
            ("  2411\n", "begins with -1, but this is `2411`"),
        ] {
            let stop = datasets(cut).expect_err(cut);
            assert!(stop.what.contains(wanted), "{}", stop.what);
        }
    }

    #[test]
    fn numbers_have_exponents_of_fortran() {
        assert_eq!(three(" 1.0D+00 -2.5d-01  3E2"), Some([1.0, -0.25, 300.0]));
        for bad in ["1 2", "1 2 3 4", "1 2 x", "1 2 nan", "1 2 1D999"] {
            assert_eq!(three(bad), None, "{bad}");
        }
    }
}
