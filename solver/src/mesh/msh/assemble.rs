//! From the elements of a file to solid cells, and sets of nodes and cells by physical groups.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use whirl_specs::Element;

use super::super::raw::{
    Cells, LinePosition, MeshReport, NodeTable, RawCell, RawMesh, count, in_own_order,
};
use super::contents::{Contents, Run};

/// What groups without a name are called, by dimension, before their tag.
const UNNAMED: [&str; 4] = ["POINT", "CURVE", "SURFACE", "VOLUME"];

/// Members of physical groups, by dimension and tag.
#[derive(Default)]
struct Groups {
    nodes: BTreeMap<(usize, i64), Vec<usize>>,
    cells: BTreeMap<i64, Vec<usize>>,
}

/// The solids of a file; what else there is gives sets of nodes.
pub(super) fn assemble(
    contents: Contents,
    elements: &[&'static Element],
    report: &mut MeshReport,
) -> RawMesh {
    let Contents { mut nodes, runs, names, .. } = contents;
    let mut cells = Cells::new();
    let mut groups = Groups::default();
    let mut left_out = [0; 3];
    let repeated = repeated_entities(&runs);
    let mut known = HashMap::new();
    let mut refused = BTreeSet::new();
    for run in &runs {
        if run.kind.dimension < 3 {
            left_out[run.kind.dimension] += run.labels.len();
            let members: Vec<usize> =
                run.nodes.iter().filter_map(|node| nodes.named.index.get(node).copied()).collect();
            for &group in &run.groups {
                groups.nodes.entry((run.kind.dimension, group)).or_default().extend(&members);
            }
            continue;
        }
        let Some(element) = run.kind.element(elements) else {
            if refused.insert(run.kind.number) {
                let (what, help) = run.kind.refusal(elements);
                report.error(run.places.first().copied().unwrap_or_default(), what, help);
            }
            continue;
        };
        let twice = repeated.contains(&run.entity).then_some(&mut known);
        solids(run, element, &nodes, &mut cells, &mut groups, twice, report);
    }
    tell_left_out(left_out, report);
    into_sets(groups, &names, &mut nodes, &mut cells, report);
    let sections = vec![None; cells.list.len()];
    let (materials, ties, sections_complete) = (Vec::new(), Vec::new(), refused.is_empty());
    let named_by_ties = BTreeSet::new();
    RawMesh { nodes, cells, materials, sections, sections_complete, ties, named_by_ties }
}

/// Volumes in several groups: version 2 has their cells once for every group.
fn repeated_entities(runs: &[Run]) -> BTreeSet<i64> {
    let mut first: HashMap<i64, &[i64]> = HashMap::new();
    let mut repeated = BTreeSet::new();
    for run in runs.iter().filter(|run| run.kind.dimension == 3) {
        if *first.entry(run.entity).or_insert(&run.groups) != run.groups {
            repeated.insert(run.entity);
        }
    }
    repeated
}

/// Adds the cells of a run. `twice`: cells by their nodes, where the same ones may have stood in another group.
fn solids(
    run: &Run,
    element: &'static Element,
    nodes: &NodeTable,
    cells: &mut Cells,
    groups: &mut Groups,
    mut twice: Option<&mut HashMap<Vec<u64>, (usize, Vec<i64>)>>,
    report: &mut MeshReport,
) {
    let mut members = Vec::with_capacity(run.labels.len());
    let listed = run.nodes.chunks_exact(run.kind.nodes);
    for ((&label, &place), listed) in run.labels.iter().zip(&run.places).zip(listed) {
        let earlier = twice.as_mut().and_then(|known| known.get_mut(listed));
        if let Some((cell, groups)) = earlier.filter(|(_, groups)| *groups != run.groups) {
            groups.clone_from(&run.groups);
            members.push(*cell);
            continue;
        }
        let own = cell_nodes(label, listed, element, nodes, place, report);
        if let Some(index) = cells.named.add(label, place, report) {
            cells.list.push(RawCell { element: Some(element), nodes: own });
            members.push(index);
            if let Some(known) = &mut twice {
                known.insert(listed.to_vec(), (index, run.groups.clone()));
            }
        }
    }
    for &group in &run.groups {
        let nodes = members.iter().flat_map(|&cell| cells.list[cell].nodes.iter().copied());
        groups.nodes.entry((3, group)).or_default().extend(nodes);
        groups.cells.entry(group).or_default().extend(&members);
    }
}

/// Indices of the nodes, in the element's own order; none after an error.
fn cell_nodes(
    cell: u64,
    listed: &[u64],
    element: &Element,
    nodes: &NodeTable,
    place: LinePosition,
    report: &mut MeshReport,
) -> Vec<usize> {
    let mut own: Vec<usize> = Vec::with_capacity(listed.len());
    for node in listed {
        match nodes.named.index.get(node) {
            None => {
                let what = format!("cell {cell} has node {node}, which is not defined");
                report.error(place, what, "are nodes missing under $Nodes? Export the file again");
            }
            Some(index) if own.contains(index) => {
                let what = format!("cell {cell} has node {node} twice");
                report.error(place, what, "mesh again: this cell is degenerate");
            }
            Some(&index) => own.push(index),
        }
    }
    match element.gmsh {
        Some((_, order)) if own.len() == listed.len() => in_own_order(&own, order),
        _ => Vec::new(),
    }
}

/// One line of what is in the file beside solids.
fn tell_left_out(numbers: [usize; 3], report: &mut MeshReport) {
    let nouns = ["point", "line", "face"];
    let there = numbers.into_iter().zip(nouns).filter(|(number, _)| *number > 0);
    let listed: Vec<String> = there.map(|(number, noun)| count(number, noun)).collect();
    if let Some((last, others)) = listed.split_last() {
        let all = match others {
            [] => last.clone(),
            _ => format!("{} and {last}", others.join(", ")),
        };
        let what = format!("left out: {all}; the nodes of their physical groups are node sets");
        report.warn(LinePosition::default(), what, "");
    }
}

/// Sets by the names of the groups.
fn into_sets(
    groups: Groups,
    names: &BTreeMap<(usize, i64), String>,
    nodes: &mut NodeTable,
    cells: &mut Cells,
    report: &mut MeshReport,
) {
    let name_of = |dimension: usize, tag: i64| match names.get(&(dimension, tag)) {
        Some(name) if !name.trim().is_empty() => name.trim().to_owned(),
        _ => format!("{}_{tag}", UNNAMED[dimension]),
    };
    let mut of_solids = vec![false; nodes.positions.len()];
    cells.list.iter().flat_map(|cell| &cell.nodes).for_each(|&node| of_solids[node] = true);
    // Points first: a name belongs to the smallest thing that has it.
    let mut taken: BTreeMap<String, (usize, i64)> = BTreeMap::new();
    for ((dimension, tag), mut members) in groups.nodes {
        let name = name_of(dimension, tag);
        let kind = UNNAMED[dimension].to_lowercase();
        members.sort_unstable();
        members.dedup();
        members.retain(|&node| of_solids[node]);
        if members.is_empty() {
            let what = format!("no node of the {kind} group `{name}` belongs to a solid");
            let help = "its node set is left out: mesh the body and its faces together";
            report.warn(LinePosition::default(), what, help);
            continue;
        }
        match taken.get(&name.to_uppercase()) {
            Some(&(first, _)) if first < dimension => {
                let smaller = UNNAMED[first].to_lowercase();
                let what = format!(
                    "`{name}` names a {smaller} group and a {kind} group: the node set is that of the {smaller} group"
                );
                report.warn(LinePosition::default(), what, "rename one of them in Gmsh");
                continue;
            }
            Some(&(_, first)) => {
                let what = format!(
                    "the {kind} groups {first} and {tag} have one name, `{name}` (capitals or not): their sets are one"
                );
                report.warn(LinePosition::default(), what, "rename one of them in Gmsh");
            }
            None => {
                taken.insert(name.to_uppercase(), (dimension, tag));
            }
        }
        nodes.named.sets.add(&name, members);
    }
    for (tag, members) in groups.cells {
        cells.named.sets.add(&name_of(3, tag), members);
    }
}
