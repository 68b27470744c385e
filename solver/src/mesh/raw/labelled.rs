//! Labelled things (nodes or cells) and named sets of them.

use std::collections::{BTreeMap, HashMap};

use whirl_text::nearest_in_any_case;

use super::report::{LinePosition, MeshReport};

/// Sets by name; names are compared in capitals and kept as first written.
#[derive(Debug, Default)]
pub(crate) struct Sets {
    by_capitals: BTreeMap<String, (String, Vec<usize>)>,
}

impl Sets {
    /// Adds members to a set, made if it is new.
    pub(crate) fn add(&mut self, name: &str, members: impl IntoIterator<Item = usize>) {
        let entry = self.by_capitals.entry(name.to_uppercase());
        entry.or_insert_with(|| (name.to_owned(), Vec::new())).1.extend(members);
    }

    pub(crate) fn get(&self, name: &str) -> Option<&[usize]> {
        self.by_capitals.get(&name.to_uppercase()).map(|(_, members)| members.as_slice())
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &str> + Clone {
        self.by_capitals.values().map(|(name, _)| name.as_str())
    }

    /// Takes out the sets without members.
    pub(crate) fn drop_empty(&mut self) {
        self.by_capitals.retain(|_, (_, members)| !members.is_empty());
    }

    /// Takes out the sets all of whose members are such.
    pub(crate) fn drop_those_of(&mut self, such: impl Fn(usize) -> bool) {
        let kept = |members: &[usize]| members.is_empty() || !members.iter().all(|&own| such(own));
        self.by_capitals.retain(|_, (_, members)| kept(members));
    }

    /// The sets by name, with members as often as they were added.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &[usize])> {
        self.by_capitals.values().map(|(name, members)| (name.as_str(), members.as_slice()))
    }

    /// Puts another member in place of each.
    pub(crate) fn map_members(&mut self, other: impl Fn(usize) -> usize) {
        let members = self.by_capitals.values_mut().flat_map(|(_, members)| members);
        members.for_each(|member| *member = other(*member));
    }

    /// Every set with its members once each, in the order of the source.
    pub(crate) fn into_map<T: Ord + Copy>(
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
pub(crate) struct Labelled {
    /// `node` or `cell`.
    pub(crate) noun: &'static str,
    pub(crate) labels: Vec<u64>,
    pub(crate) places: Vec<LinePosition>,
    pub(crate) index: HashMap<u64, usize>,
    pub(crate) sets: Sets,
    /// Whether every member of every set was found.
    pub(crate) complete: bool,
    /// Whether labels were lost in an error: what is missing is then no further error.
    pub(crate) lost: bool,
}

impl Labelled {
    pub(crate) fn new(noun: &'static str) -> Labelled {
        Labelled {
            noun,
            labels: Vec::new(),
            places: Vec::new(),
            index: HashMap::new(),
            sets: Sets::default(),
            complete: true,
            lost: false,
        }
    }

    /// Adds a label; a label that is taken is an error and gives `None`.
    pub(crate) fn add(
        &mut self,
        label: u64,
        at: impl Into<LinePosition>,
        report: &mut MeshReport,
    ) -> Option<usize> {
        let at = at.into();
        let index = self.labels.len();
        if let Some(&first) = self.index.get(&label) {
            let what = format!("{} {label} is defined twice", self.noun);
            let first = self.places[first];
            let help = match first.line {
                0 => "give one of them another label".to_owned(),
                _ => {
                    let line = report.line(first, at);
                    format!("{line} has the first; give this one another label")
                }
            };
            report.error(at, what, help);
            return None;
        }
        self.index.insert(label, index);
        self.labels.push(label);
        self.places.push(at);
        Some(index)
    }

    /// Keeps what has a new index in `place` (`usize::MAX`: none).
    pub(crate) fn renumber(&mut self, place: &[usize]) {
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

/// A hint with the nearest name, or the names there are.
pub(crate) fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    if let Some(close) = nearest_in_any_case(name, known.clone()) {
        return format!("did you mean {close}?");
    }
    let some: Vec<&str> = known.take(8).collect();
    match some.is_empty() {
        true => "there are none".to_owned(),
        false => format!("there are {}", some.join(", ")),
    }
}
