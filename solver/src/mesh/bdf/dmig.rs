//! The cards `DMIG`, and grid points whether elements have them or not.

use std::collections::BTreeMap;

use super::super::placed_nodes::PlacedNodes;
use super::super::raw::{LinePosition, MeshReport};
use super::fields::{self, Card, Entry};
use super::files::{self, Load, is_command};
use super::names::Names;
use super::nodes::Grids;
use super::sets;
use super::systems::Systems;

/// A matrix.
#[derive(Debug)]
pub(in crate::mesh) struct Dmig {
    /// Of its head.
    pub(in crate::mesh) place: LinePosition,
    /// 1 square, 2 or 9 rectangular, 6 symmetric.
    pub(in crate::mesh) form: u64,
    pub(in crate::mesh) columns: Vec<DmigColumn>,
}

/// A column.
#[derive(Debug)]
pub(in crate::mesh) struct DmigColumn {
    pub(in crate::mesh) node: u64,
    pub(in crate::mesh) component: u64,
    pub(in crate::mesh) place: LinePosition,
    pub(in crate::mesh) entries: Vec<DmigEntry>,
}

/// An entry of a column.
#[derive(Debug)]
pub(in crate::mesh) struct DmigEntry {
    pub(in crate::mesh) node: u64,
    pub(in crate::mesh) component: u64,
    pub(in crate::mesh) value: f64,
    pub(in crate::mesh) place: LinePosition,
}

/// Reads the matrices of a file by their names in capitals. Other cards are left out.
pub(in crate::mesh) fn matrices(
    text: &str,
    load: Load<'_>,
    report: &mut MeshReport,
) -> BTreeMap<String, Dmig> {
    let sources = files::read(text, load, report);
    let mut all: BTreeMap<String, Dmig> = BTreeMap::new();
    // Comments between the columns of a punch file, and case control, are no cards of matrices.
    fields::each(&sources, &sources.lines, |entry| {
        if let Entry::Card(card) = entry
            && card.name == "DMIG"
        {
            read(card, &mut all, report);
            for (place, what, help) in &card.faults {
                report.error(*place, what, *help);
            }
        }
    });
    if all.is_empty() && report.error_count() == 0 {
        let help = "let Nastran write them: PARAM,EXTOUT,DMIGPCH or EXTSEOUT(DMIGPCH)";
        report.error_in_file("the file has no cards DMIG", help);
    }
    all
}

fn read(card: &Card, all: &mut BTreeMap<String, Dmig>, report: &mut MeshReport) {
    let Some(name) = card.field(0) else {
        report.error(
            card.place,
            "DMIG lacks the name of its matrix, its field 2",
            "fill the field",
        );
        return;
    };
    let key = name.text.to_ascii_uppercase();
    // The head has 0 where a column has its node.
    if card.field(1).is_some_and(|field| field.text == "0") {
        head(card, key, all, report);
        return;
    }
    let Some(matrix) = all.get_mut(&key) else {
        let what = format!("a column of {key} stands before its head");
        report.error(card.place, what, "write DMIG, NAME, 0, form, type above the columns");
        return;
    };
    let node = report.label(card, 1, "node of the column");
    let component = report.count_or_zero(card, 2, "component of the column");
    let (Some(node), Some(component)) = (node, component) else { return };
    let mut column = DmigColumn { node, component, place: card.place, entries: Vec::new() };
    let mut at = 4;
    while at < card.fields.len() {
        if (at..at + 4).any(|field| card.field(field).is_some()) {
            column.entries.extend(entry(card, at, report));
        }
        at += 4;
    }
    matrix.columns.push(column);
}

fn entry(card: &Card, at: usize, report: &mut MeshReport) -> Option<DmigEntry> {
    let node = report.label(card, at, "node of an entry")?;
    let component = report.count_or_zero(card, at + 1, "component of an entry")?;
    let place = card.field(at).map_or(card.place, |field| field.place);
    let Some(value) = card.field(at + 2) else {
        let what = format!("the entry of node {node} has no value");
        report.error(place, what, "the file may have been cut off: write it again");
        return None;
    };
    let value = report.real_in(card, value, "value of an entry")?;
    Some(DmigEntry { node, component, value, place })
}

fn head(card: &Card, key: String, all: &mut BTreeMap<String, Dmig>, report: &mut MeshReport) {
    let form = report.count_or_zero(card, 2, "form of the matrix");
    let kind = report.count_or_zero(card, 3, "type of the matrix");
    let (Some(form), Some(kind)) = (form, kind) else { return };
    if !(1..=2).contains(&kind) {
        let what = format!("{key} has values of type {kind}, and only real ones (1, 2) are read");
        report.error(card.place, what, "export the real matrix, without structural damping");
    }
    if let Some(first) = all.get(&key) {
        let line = report.line(first.place, card.place);
        let what = format!("there is a second head of {key}");
        report.error(card.place, what, format!("{line} has the first; keep one of both matrices"));
        return;
    }
    all.insert(key, Dmig { place: card.place, form, columns: Vec::new() });
}

/// Reads grid points with coordinate systems and sets; places in units of the file. Other cards are left out.
pub(in crate::mesh) fn grid_points(
    text: &str,
    load: Load<'_>,
    report: &mut MeshReport,
) -> PlacedNodes {
    let sources = files::read(text, load, report);
    let begin = sources.lines.iter().position(|line| is_command(sources.text(line), "BEGIN"));
    let (control, lines) = match begin {
        Some(begin) => (&sources.lines[..begin], &sources.lines[begin + 1..]),
        None => (&[][..], &sources.lines[..]),
    };
    let (mut grids, mut systems) = (Grids::default(), Systems::default());
    let mut own_axes: Vec<(u64, Option<u64>)> = Vec::new();
    let mut default_axes = 0;
    let mut names = Names::default();
    let comments =
        control.iter().filter_map(|line| sources.text(line).trim_start().strip_prefix('$'));
    comments.for_each(|comment| names.comment(comment));
    let mut all = sets::of_control(&sources, control, report);
    fields::each(&sources, lines, |entry| {
        let card = match entry {
            Entry::Card(card) => card,
            Entry::Comment(text) => return names.comment(text),
            Entry::Orphan(..) => return,
        };
        match card.name.as_ref() {
            "GRID" => {
                grids.read(card, report);
                let label = card.field(0).and_then(|field| field.text.parse().ok());
                let axes = card.field(5).and_then(|field| field.text.parse().ok());
                own_axes.extend(label.map(|label| (label, axes)));
            }
            "GRDSET" => {
                grids.read_defaults(card, report);
                default_axes = card.field(5).and_then(|field| field.text.parse().ok()).unwrap_or(0);
            }
            "CORD2R" | "CORD2C" | "CORD2S" => systems.read_points(card, report),
            "CORD1R" | "CORD1C" | "CORD1S" => systems.read_grids(card, report),
            "SET1" | "SET3" => all.extend(sets::of_bulk(card, report)),
            _ => return,
        }
        for (place, what, help) in &card.faults {
            report.error(*place, what, *help);
        }
    });
    let frames = systems.resolve(&grids, report);
    let positions = grids.positions(&systems, &frames, report);
    let mut nodes = PlacedNodes::default();
    for (index, position) in positions.into_iter().enumerate() {
        nodes.places.insert(grids.label(index), position);
    }
    let axes = own_axes.into_iter().map(|(label, axes)| (label, axes.unwrap_or(default_axes)));
    nodes.turned = axes.filter(|(_, axes)| *axes != 0).collect();
    let mut known: Vec<(u64, usize)> =
        (0..grids.len()).map(|index| (grids.label(index), index)).collect();
    known.sort_unstable();
    for set in &all {
        let (members, _) = set.members.among(&known);
        // A set may be one of elements, whose labels are not those of nodes.
        if !members.is_empty() {
            let plain = || format!("{}_{}", set.card, set.label);
            let name = names.set(set.label).map_or_else(plain, str::to_owned);
            let labels = members.into_iter().map(|index| grids.label(index));
            nodes.sets.entry(name).or_default().extend(labels);
        }
    }
    nodes
}
