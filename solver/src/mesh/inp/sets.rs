//! Labelled things (nodes or cells) and named sets of them.

use std::collections::{BTreeMap, HashMap};

use whirl_text::nearest_in_any_case;

use super::cards::{Card, Token};
use super::{LinePosition, MeshReport};

/// Sets by name; names are compared in capitals and kept as first written.
#[derive(Debug, Default)]
pub(super) struct Sets {
    by_capitals: BTreeMap<String, (String, Vec<usize>)>,
}

impl Sets {
    /// Adds members to a set, made if it is new.
    pub(super) fn add(&mut self, name: &str, members: impl IntoIterator<Item = usize>) {
        let entry = self.by_capitals.entry(name.to_uppercase());
        entry.or_insert_with(|| (name.to_owned(), Vec::new())).1.extend(members);
    }

    pub(super) fn get(&self, name: &str) -> Option<&[usize]> {
        self.by_capitals.get(&name.to_uppercase()).map(|(_, members)| members.as_slice())
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> + Clone {
        self.by_capitals.values().map(|(name, _)| name.as_str())
    }

    /// Every set with its members once each, in the order of the source.
    pub(super) fn into_map<T: Ord + Copy>(
        self,
        member: impl Fn(usize) -> T,
    ) -> BTreeMap<String, Vec<T>> {
        let once = |members: Vec<usize>| {
            let mut seen = std::collections::BTreeSet::new();
            members.into_iter().map(&member).filter(|&member| seen.insert(member)).collect()
        };
        self.by_capitals.into_values().map(|(name, members)| (name, once(members))).collect()
    }
}

/// Things with labels, in the order of the file, and sets of them.
#[derive(Debug)]
pub(super) struct Labelled {
    /// `node` or `cell`.
    pub(super) noun: &'static str,
    pub(super) labels: Vec<u64>,
    pub(super) places: Vec<LinePosition>,
    pub(super) index: HashMap<u64, usize>,
    pub(super) sets: Sets,
    /// Whether every member of every set was found.
    pub(super) complete: bool,
}

impl Labelled {
    pub(super) fn new(noun: &'static str) -> Labelled {
        Labelled {
            noun,
            labels: Vec::new(),
            places: Vec::new(),
            index: HashMap::new(),
            sets: Sets::default(),
            complete: true,
        }
    }

    /// Adds a label; a label that is taken is an error and gives `None`.
    pub(super) fn add(
        &mut self,
        label: u64,
        token: &Token,
        report: &mut MeshReport,
    ) -> Option<usize> {
        let index = self.labels.len();
        if let Some(&first) = self.index.get(&label) {
            let what = format!("{} {label} is defined twice", self.noun);
            let help = format!(
                "line {} has the first; give this one another label",
                self.places[first].line
            );
            report.error(*token, what, help);
            return None;
        }
        self.index.insert(label, index);
        self.labels.push(label);
        self.places.push((*token).into());
        Some(index)
    }

    /// Keeps what has a new index in `place` (`usize::MAX`: none).
    pub(super) fn renumber(&mut self, place: &[usize]) {
        let kept: Vec<usize> = (0..place.len()).filter(|&old| place[old] != usize::MAX).collect();
        self.labels = kept.iter().map(|&old| self.labels[old]).collect();
        self.places = kept.iter().map(|&old| self.places[old]).collect();
        self.index = self.labels.iter().enumerate().map(|(index, &label)| (label, index)).collect();
        for (_, members) in self.sets.by_capitals.values_mut() {
            members.retain(|&old| place[old] != usize::MAX);
            members.iter_mut().for_each(|member| *member = place[*member]);
        }
    }
}

/// Reads `*NSET` or `*ELSET`: labels, names of sets above, or ranges (`GENERATE`).
pub(super) fn read(cards: &[&Card], keyword: &str, named: &mut Labelled, report: &mut MeshReport) {
    let before = report.errors.len();
    for card in cards.iter().filter(|card| card.keyword == keyword) {
        let example = format!("*{keyword}, {keyword}=NAME");
        let Some(name) = report.required(card, keyword, &example) else { continue };
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
    named.complete = report.errors.len() == before;
}

fn member(token: &Token, named: &Labelled, members: &mut Vec<usize>, report: &mut MeshReport) {
    let noun = named.noun;
    if token.text.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+') {
        let Some(label) = report.label(token, &format!("label of a {noun}")) else { return };
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
    let (Some(from), Some(to)) = (report.label(first, &of), report.label(last, &of)) else {
        return;
    };
    let step = match step {
        Some(token) => match report.label(token, "step") {
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

/// A hint with the nearest name, or the names there are.
pub(super) fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    if let Some(close) = nearest_in_any_case(name, known.clone()) {
        return format!("did you mean {close}?");
    }
    let some: Vec<&str> = known.take(8).collect();
    match some.is_empty() {
        true => "there are none".to_owned(),
        false => format!("there are {}", some.join(", ")),
    }
}
