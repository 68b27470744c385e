//! Sets of nodes and of cells, from their cards.

use std::collections::HashMap;

use super::super::raw::{Cells, Labelled, MeshReport, NodeTable, count, did_you_mean};
use super::cards::{Card, Token};
use super::others::OtherElements;
use super::values::{label, label_help, required, whole};

/// Reads `*ELSET`; labels of elements that are left out go to sets of these.
pub(super) fn read_of_elements(
    cards: &[&Card],
    cells: &mut Cells,
    others: &mut OtherElements,
    report: &mut MeshReport,
) {
    read(cards, "ELSET", &mut cells.named, others, None, report);
}

/// Reads `*NSET`: labels, or the nodes of sets of `elements`.
pub(super) fn read_of_nodes(
    cards: &[&Card],
    nodes: &mut NodeTable,
    elements: Option<(&Cells, &OtherElements)>,
    report: &mut MeshReport,
) {
    read(cards, "NSET", &mut nodes.named, &mut OtherElements::default(), elements, report);
}

/// Labels, names of sets above, or ranges (`GENERATE`).
fn read(
    cards: &[&Card],
    keyword: &str,
    named: &mut Labelled,
    others: &mut OtherElements,
    elements: Option<(&Cells, &OtherElements)>,
    report: &mut MeshReport,
) {
    let before = report.error_count();
    for card in cards.iter().filter(|card| card.keyword == keyword) {
        let example = format!("*{keyword}, {keyword}=NAME");
        let Some(name) = required(card, keyword, &example, report) else {
            named.lost = true;
            continue;
        };
        let mut members = Members::default();
        if keyword == "NSET"
            && let Some(set) = card.parameter("ELSET").and_then(|parameter| parameter.value)
        {
            of_elements(&set, elements, &mut members, report);
        }
        for line in &card.lines {
            if card.parameter("GENERATE").is_some() {
                generate(line, named, others, &mut members, report);
            } else {
                let filled = line.iter().filter(|token| !token.text.is_empty());
                filled.for_each(|token| member(token, named, others, &mut members, report));
            }
        }
        if members.missing > 0 && !named.lost {
            let what = format!(
                "{} of the set {} that no {} has, left out",
                count(members.missing, "label"),
                name.text,
                named.noun
            );
            let help = match members.first_missing {
                Some(label) => {
                    format!("the first is {label}: take it out, or add the {}", named.noun)
                }
                None => {
                    format!("ranges may have gaps; if this one has none, add the {}s", named.noun)
                }
            };
            report.warn(name, what, help);
        }
        named.sets.add(name.text, members.own);
        if keyword == "ELSET" && !members.others.is_empty() {
            others.sets.add(name.text, members.others);
        }
    }
    named.complete = report.error_count() == before;
}

/// What is found of a set.
#[derive(Default)]
struct Members {
    own: Vec<usize>,
    /// Elements that are left out.
    others: Vec<usize>,
    /// Labels that nothing has, and the first that is not of a range.
    missing: usize,
    first_missing: Option<u64>,
}

/// The nodes of a set of elements.
fn of_elements(
    set: &Token,
    elements: Option<(&Cells, &OtherElements)>,
    members: &mut Members,
    report: &mut MeshReport,
) {
    let Some((cells, others)) = elements else {
        report.error(*set, "elements are not read here", "list the nodes of the set");
        return;
    };
    let own = cells.named.sets.get(set.text);
    if own.is_none() && !cells.named.lost {
        let what = format!("no set of cells is called {}", set.text);
        report.error(*set, what, did_you_mean(set.text, cells.named.sets.names()));
    }
    let of_cells = own.unwrap_or_default().iter().flat_map(|&cell| &cells.list[cell].nodes);
    members.own.extend(of_cells);
    let rest = others.sets.get(set.text).unwrap_or_default();
    members.own.extend(rest.iter().flat_map(|&element| &others.nodes[element]));
}

fn member(
    token: &Token,
    named: &Labelled,
    others: &OtherElements,
    members: &mut Members,
    report: &mut MeshReport,
) {
    let noun = named.noun;
    if token.text.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+') {
        let Some(label) = whole(token.text) else {
            let what = format!("label of a {noun} must be a whole number, found `{}`", token.text);
            report.error(*token, what, label_help(token.text));
            return;
        };
        let label = u64::try_from(label).unwrap_or(0);
        match (named.index.get(&label), others.index.get(&label)) {
            (Some(&index), _) => members.own.push(index),
            (None, Some(&index)) => members.others.push(index),
            (None, None) => {
                members.missing += 1;
                members.first_missing.get_or_insert(label);
            }
        }
        return;
    }
    let name = token.text.trim_matches('"');
    match named.sets.get(name) {
        Some(set) => {
            members.own.extend(set);
            members.others.extend(others.sets.get(name).unwrap_or_default());
        }
        None if named.lost => {}
        None => {
            let what = format!("no set of {noun}s called {name} stands above this line");
            report.error(*token, what, did_you_mean(name, named.sets.names()));
        }
    }
}

/// first, last, step. Labels in the range need not be there: preprocessors write ranges over gaps.
fn generate(
    line: &[Token],
    named: &Labelled,
    others: &OtherElements,
    members: &mut Members,
    report: &mut MeshReport,
) {
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
    let wanted = usize::try_from((to - from) / step + 1).unwrap_or(usize::MAX);
    let fits = |label: u64| label >= from && label <= to && (label - from).is_multiple_of(step);
    // A range may be far wider than the mesh, and a mesh far larger than a range: what is fewer is gone through.
    let within = |index: &HashMap<u64, usize>| -> Vec<(u64, usize)> {
        if wanted <= index.len() {
            let labels = (0..wanted as u64).map(|k| from + k * step);
            return labels.filter_map(|label| Some((label, *index.get(&label)?))).collect();
        }
        let own = index.iter().filter(|(label, _)| fits(**label));
        let mut found: Vec<(u64, usize)> = own.map(|(&label, &index)| (label, index)).collect();
        found.sort_unstable();
        found
    };
    let (own, left) = (within(&named.index), within(&others.index));
    members.missing = members.missing.saturating_add(wanted.saturating_sub(own.len() + left.len()));
    members.own.extend(own.into_iter().map(|(_, index)| index));
    members.others.extend(left.into_iter().map(|(_, index)| index));
}
