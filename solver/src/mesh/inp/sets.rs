//! Sets of nodes and of cells, from their cards.

use super::super::raw::{Labelled, MeshReport, did_you_mean};
use super::cards::{Card, Token};
use super::values::{label, required};

/// Reads `*NSET` or `*ELSET`: labels, names of sets above, or ranges (`GENERATE`).
pub(super) fn read(cards: &[&Card], keyword: &str, named: &mut Labelled, report: &mut MeshReport) {
    let before = report.error_count();
    for card in cards.iter().filter(|card| card.keyword == keyword) {
        let example = format!("*{keyword}, {keyword}=NAME");
        let Some(name) = required(card, keyword, &example, report) else { continue };
        let mut members = Vec::new();
        for line in &card.lines {
            if card.parameter("GENERATE").is_some() {
                generate(line, named, &mut members, report);
            } else {
                let filled = line.iter().filter(|token| !token.text.is_empty());
                filled.for_each(|token| member(token, named, &mut members, report));
            }
        }
        named.sets.add(name.text, members);
    }
    named.complete = report.error_count() == before;
}

fn member(token: &Token, named: &Labelled, members: &mut Vec<usize>, report: &mut MeshReport) {
    let noun = named.noun;
    if token.text.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+') {
        let Some(label) = label(token, &format!("label of a {noun}"), report) else { return };
        match named.index.get(&label) {
            Some(&index) => members.push(index),
            None => {
                let help = "define it, or take it out of the set";
                report.error(*token, format!("{noun} {label} is not defined"), help);
            }
        }
        return;
    }
    let name = token.text.trim_matches('"');
    match named.sets.get(name) {
        Some(set) => members.extend(set),
        None => {
            let what = format!("no set of {noun}s called {name} stands above this line");
            report.error(*token, what, did_you_mean(name, named.sets.names()));
        }
    }
}

/// first, last, step: labels in the range that are not defined are an error.
fn generate(line: &[Token], named: &Labelled, members: &mut Vec<usize>, report: &mut MeshReport) {
    let noun = named.noun;
    let filled: Vec<&Token> = line.iter().filter(|token| !token.text.is_empty()).collect();
    let (first, last, step) = match filled[..] {
        [first, last] => (first, last, None),
        [first, last, step] => (first, last, Some(step)),
        _ => {
            let what = format!("GENERATE needs first, last, step; found {} values", filled.len());
            if let Some(token) = line.first() {
                report.error(*token, what, "write 1, 100, 1");
            }
            return;
        }
    };
    let of = format!("label of a {noun}");
    let (Some(from), Some(to)) = (label(first, &of, report), label(last, &of, report)) else {
        return;
    };
    let step = match step {
        Some(token) => match label(token, "step", report) {
            Some(step) => step,
            None => return,
        },
        None => 1,
    };
    if to < from || (to - from) % step != 0 {
        let what = format!("from {from} one does not come to {to} in steps of {step}");
        report.error(*first, what, "let last − first be a multiple of the step");
        return;
    }
    // A range may be far wider than the mesh: look at the labels, not at every number.
    let wanted = (to - from) / step + 1;
    let mut found: Vec<(u64, usize)> = named
        .index
        .iter()
        .filter(|&(&label, _)| label >= from && label <= to && (label - from) % step == 0)
        .map(|(&label, &index)| (label, index))
        .collect();
    found.sort_unstable();
    let missing = wanted - found.len() as u64;
    if missing > 0 {
        let what = format!("{missing} of the {wanted} labels from {from} to {to} are no {noun}s");
        report.error(*first, what, "narrow the range");
    }
    members.extend(found.into_iter().map(|(_, index)| index));
}
