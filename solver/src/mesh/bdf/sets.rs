//! Labels in ranges, and sets of them.

use std::collections::BTreeMap;

use super::super::raw::{LinePosition, MeshReport};
use super::fields::Card;
use super::files::{Line, Sources, is_command};
use super::numbers;

/// Labels from one to another in steps, but for some.
#[derive(Debug, Clone, Default)]
struct Range {
    first: u64,
    last: u64,
    step: u64,
    but: Vec<[u64; 2]>,
}

impl Range {
    fn has(&self, label: u64) -> bool {
        (self.first..=self.last).contains(&label)
    }
}

/// Labels as written, which may be far more than a mesh has.
#[derive(Debug, Clone, Default)]
pub(super) struct Ranges(Vec<Range>);

impl Ranges {
    /// Reads `1, 2, 5 THRU 20 EXCEPT 7, 30 THRU 40 BY 2`; gives the word that is not understood.
    fn read<'t>(words: &[&'t str]) -> Result<Ranges, &'t str> {
        let mut ranges: Vec<Range> = Vec::new();
        let mut excepting = false;
        let mut at = 0;
        while at < words.len() {
            let word = words[at];
            at += 1;
            if word.eq_ignore_ascii_case("EXCEPT") && !ranges.is_empty() {
                let next = words.get(at).copied().and_then(numbers::whole);
                let of = ranges.last().filter(|of| next.is_some_and(|next| of.has(next)));
                of.ok_or(word)?;
                excepting = true;
                continue;
            }
            let first = numbers::whole(word).ok_or(word)?;
            let mut last = first;
            let mut step = 1;
            if let Some(&to) = next(words, at, "THRU") {
                last = numbers::whole(to).filter(|last| *last >= first).ok_or(to)?;
                at += 2;
                if let Some(&by) = next(words, at, "BY") {
                    step = numbers::whole(by).filter(|step| *step > 0).ok_or(by)?;
                    at += 2;
                }
            }
            // What follows EXCEPT is taken out for as long as it lies in the range before.
            match ranges.last_mut() {
                Some(range) if excepting && range.has(first) => {
                    range.but.push([first, last]);
                }
                _ => {
                    excepting = false;
                    ranges.push(Range { first, last, step, but: Vec::new() });
                }
            }
        }
        Ok(Ranges(ranges))
    }

    /// Reads the filled fields of a card from one on.
    pub(super) fn of_card(card: &Card, from: usize, report: &mut MeshReport) -> Ranges {
        let words: Vec<&str> = card.filled_from(from).map(|field| field.text).collect();
        Ranges::read(&words).unwrap_or_else(|word| {
            let field = card.filled_from(from).find(|field| field.text == word).copied();
            if let Some(field) = field {
                report.wrong(card, &field, "label", "a whole number from 1, or THRU between two");
            }
            Ranges::default()
        })
    }

    pub(super) fn extend(&mut self, other: Ranges) {
        self.0.extend(other.0);
    }

    /// What of `known` (label and index, sorted) the ranges have, in their order, and how many single labels are
    /// missing in it.
    pub(super) fn among(&self, known: &[(u64, usize)]) -> (Vec<usize>, usize) {
        let mut found = Vec::new();
        let mut missing = 0;
        let mut taken = Intervals::default();
        for Range { first, last, step, but } in &self.0 {
            let mut excepted = Intervals::default();
            but.iter().for_each(|[from, to]| drop(excepted.add(*from, *to)));
            // What was taken before is not looked at again: ranges may be many and wide.
            let pieces = match *step == 1 && but.is_empty() {
                true => taken.add(*first, *last),
                false => vec![[*first, *last]],
            };
            for [from, to] in pieces {
                let start = known.partition_point(|(label, _)| *label < from);
                let own = known[start..].iter().take_while(|(label, _)| *label <= to);
                let before = found.len();
                let fits =
                    |label: u64| (label - first).is_multiple_of(*step) && !excepted.has(label);
                found.extend(own.filter(|(label, _)| fits(*label)).map(|(_, index)| *index));
                missing += usize::from(first == last && found.len() == before);
            }
        }
        (found, missing)
    }
}

/// Numbers in intervals that do not overlap: the last by the first.
#[derive(Debug, Default)]
struct Intervals(BTreeMap<u64, u64>);

impl Intervals {
    fn has(&self, number: u64) -> bool {
        self.0.range(..=number).next_back().is_some_and(|(_, last)| number <= *last)
    }

    /// Adds an interval, and gives what of it is new.
    fn add(&mut self, first: u64, last: u64) -> Vec<[u64; 2]> {
        let (mut low, mut high) = (first, last);
        let start = self.0.range(..=first).next_back().filter(|(_, end)| **end >= first);
        let start = start.map_or(first, |(start, _)| *start);
        let met: Vec<[u64; 2]> = self.0.range(start..=last).map(|(a, b)| [*a, *b]).collect();
        let mut fresh = Vec::new();
        let mut next = Some(first);
        for [from, to] in met {
            self.0.remove(&from);
            (low, high) = (low.min(from), high.max(to));
            if let Some(at) = next.filter(|at| *at < from) {
                fresh.push([at, from - 1]);
            }
            next = to.checked_add(1);
        }
        fresh.extend(next.filter(|at| *at <= last).map(|at| [at, last]));
        self.0.insert(low, high);
        fresh
    }
}

/// The word behind `keyword`, if that comes next.
fn next<'w, 't>(words: &'w [&'t str], at: usize, keyword: &str) -> Option<&'w &'t str> {
    words.get(at).filter(|word| word.eq_ignore_ascii_case(keyword))?;
    words.get(at + 1)
}

/// A set of labels, of nodes or of elements.
#[derive(Debug, Clone)]
pub(super) struct RawSet {
    /// `SET` of case control, `SET1` or `SET3`.
    pub(super) card: &'static str,
    pub(super) label: u64,
    pub(super) members: Ranges,
    pub(super) place: LinePosition,
    /// Whether the set says that it is one of grid points.
    pub(super) of_nodes: bool,
}

/// Sets of case control, which stands before `BEGIN BULK`; those of all, of real numbers and of sets are left out.
pub(super) fn of_control(
    sources: &Sources,
    lines: &[Line],
    report: &mut MeshReport,
) -> Vec<RawSet> {
    let mut sets = Vec::new();
    let mut lines = lines.iter();
    while let Some(line) = lines.next() {
        let text = bare(sources.text(line));
        if !is_command(text, "SET") {
            continue;
        }
        let mut statement = text.to_owned();
        while statement.trim_end().ends_with(',') {
            let Some(next) = lines.next() else { break };
            statement.push_str(bare(sources.text(next)));
        }
        let Some((head, members)) = statement.split_once('=') else { continue };
        let Some(label) = head.split_whitespace().nth(1).and_then(numbers::whole) else { continue };
        let words: Vec<&str> = members
            .split(|c: char| c == ',' || c.is_whitespace())
            .filter(|w| !w.is_empty())
            .collect();
        match Ranges::read(&words) {
            Ok(members) => {
                let place = line.place();
                sets.push(RawSet { card: "SET", label, members, place, of_nodes: false });
            }
            Err(word) if word.eq_ignore_ascii_case("ALL") || numbers::is_real(word) => {}
            Err(word) => {
                let what = format!("SET {label} is left out: `{word}` is not understood");
                report.warn(line.place(), what, "write SET 5 = 1, 2, 10 THRU 20");
            }
        }
    }
    sets
}

fn bare(text: &str) -> &str {
    text.split('$').next().unwrap_or_default()
}

/// Reads `SET1` and `SET3`; a `SET3` of other things than grid points is left out.
pub(super) fn of_bulk(card: &Card, report: &mut MeshReport) -> Option<RawSet> {
    let label = report.label(card, 0, "label of the set")?;
    let (name, from) = match card.name.as_ref() {
        "SET3" => {
            let kind = card.field(1)?.text.to_ascii_uppercase();
            if !["GRID", "POINT"].contains(&kind.as_str()) {
                return None;
            }
            ("SET3", 2)
        }
        _ => ("SET1", 1),
    };
    let members = Ranges::of_card(card, from, report);
    Some(RawSet { card: name, label, members, place: card.place, of_nodes: name == "SET3" })
}

#[cfg(test)]
mod tests {
    use super::Ranges;

    fn found(text: &str) -> Result<(Vec<usize>, usize), String> {
        let known: Vec<(u64, usize)> = (1..=40).map(|label| (label, label as usize)).collect();
        let words: Vec<&str> = text.split_whitespace().collect();
        let ranges = Ranges::read(&words).map_err(str::to_owned)?;
        Ok(ranges.among(&known))
    }

    #[test]
    fn ranges_have_steps_and_exceptions() {
        assert_eq!(found("3 1 99"), Ok((vec![3, 1], 1)));
        assert_eq!(found("38 THRU 99999999999"), Ok((vec![38, 39, 40], 0)));
        assert_eq!(found("1 thru 9 by 4 20"), Ok((vec![1, 5, 9, 20], 0)));
        assert_eq!(found("5 THRU 7 3 THRU 9 8 1 THRU 4"), Ok((vec![5, 6, 7, 3, 4, 8, 9, 1, 2], 0)));
        assert_eq!(found("1 THRU 9 EXCEPT 2 THRU 7 9 30"), Ok((vec![1, 8, 30], 0)));
        for (text, word) in [
            ("1 THRU", "THRU"),
            ("9 THRU 1", "1"),
            ("1 THUR 9", "THUR"),
            ("EXCEPT 1", "EXCEPT"),
            ("1 THRU 9 30 EXCEPT 2", "EXCEPT"),
        ] {
            assert_eq!(found(text), Err(word.to_owned()));
        }
    }
}
