//! What is checked of the nodes and cells of every file.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use whirl_text::{rounded, shown};

use super::super::FARTHEST;
use super::super::material::NEEDED;
use super::super::reading::ReadOptions;
use super::super::units::MeshUnits;
use super::grid::extent;
use super::report::{LinePosition, MeshReport, count, list};
use super::{RawMesh, Remedies};

impl RawMesh {
    /// Notes cells that have the nodes of others, and would give them their stiffness and mass again.
    pub(super) fn cells_stand_once(&self, report: &mut MeshReport) {
        let cells = &self.cells;
        let mut first: HashMap<Vec<usize>, usize> = HashMap::with_capacity(cells.list.len());
        let mut again = Vec::new();
        for (place, cell) in
            cells.list.iter().enumerate().filter(|(_, cell)| !cell.nodes.is_empty())
        {
            let mut nodes = cell.nodes.clone();
            nodes.sort_unstable();
            match first.entry(nodes) {
                Entry::Occupied(other) => again.push((place, *other.get())),
                Entry::Vacant(free) => drop(free.insert(place)),
            }
        }
        let Some(&(place, other)) = again.first() else { return };
        let label = |place: usize| cells.named.labels[place];
        let (what, take) = match again.len() {
            1 => (
                format!("cell {} has the nodes of cell {}", label(place), label(other)),
                "take one of them out",
            ),
            number => (
                format!(
                    "{number} cells have the nodes of others: {}; cell {} those of cell {}",
                    list(again.iter().map(|&(place, _)| label(place))),
                    label(place),
                    label(other)
                ),
                "take them out, or their originals",
            ),
        };
        let (here, first) = (cells.named.places[place], cells.named.places[other]);
        let help = match (first.line, again.len()) {
            (0, _) => take.to_owned(),
            (_, 1) => format!("{take}: {} has the first", report.line(first, here)),
            _ => format!("{take}, of which {} has the first", report.line(first, here)),
        };
        report.error(here, what, help);
    }

    /// Notes what the materials of cells lack, or what of them is not read. Where another material may take their
    /// place, what is there is kept: which cells need the rest is not known yet.
    pub(super) fn materials_are_read(
        &mut self,
        remedies: &Remedies,
        options: &ReadOptions,
        report: &mut MeshReport,
    ) {
        for (index, material) in self.materials.iter().enumerate() {
            if !self.sections.contains(&Some(index)) {
                continue;
            }
            for (place, what, help) in &material.remarks {
                report.warn(*place, what.clone(), help.clone());
            }
            for (place, what, help) in &material.unread {
                match options.open {
                    true => report.warn(*place, what.clone(), "the material of the case holds"),
                    false => report.error(*place, what.clone(), help.clone()),
                }
            }
            let is_bare = material.values.is_empty() && !material.broken;
            if options.open && (is_bare || !material.unread.is_empty()) {
                let own = self.sections.iter_mut().filter(|own| **own == Some(index));
                own.for_each(|own| *own = None);
            } else if !options.open && !material.broken && material.unread.is_empty() {
                let lacking = NEEDED.iter().map(|(symbol, _)| *symbol);
                let mut said = String::new();
                for symbol in lacking.filter(|symbol| !material.values.contains_key(symbol)) {
                    let steel = match symbol {
                        "rho" => options.units.written_density(7860.0),
                        _ => format!("{}, 0.3", options.units.written_modulus(200e9)),
                    };
                    let (what, help) = (remedies.lacks)(&material.name, symbol, &steel);
                    if what != said {
                        report.error(material.place, what.clone(), help);
                        said = what;
                    }
                }
            }
        }
    }

    /// Notes cells that the file gives no material. Where one was lost in an error, they are no further one.
    pub(super) fn cells_have_materials(&self, remedies: &Remedies, report: &mut MeshReport) {
        let bare: Vec<usize> =
            (0..self.cells.list.len()).filter(|&cell| self.sections[cell].is_none()).collect();
        if let Some(&first) = bare.first().filter(|_| self.sections_complete) {
            let labels = list(bare.iter().map(|&cell| self.cells.named.labels[cell]));
            let what = format!("{} without a section: {labels}", count(bare.len(), "cell"));
            report.error(self.cells.named.places[first], what, remedies.no_section);
        }
    }

    /// Leaves out nodes that belong to no cell, with a warning of those that nothing else names.
    pub(super) fn drop_unused_nodes(&mut self, report: &mut MeshReport) {
        let nodes = &self.nodes;
        let mut used = vec![false; nodes.positions.len()];
        self.cells.list.iter().flat_map(|cell| &cell.nodes).for_each(|&node| used[node] = true);
        let labels = &nodes.named.labels;
        let unused: Vec<usize> = (0..labels.len())
            .filter(|&node| !used[node] && !self.named_by_ties.contains(&labels[node]))
            .collect();
        if let Some(&first) = unused.first() {
            let list = list(unused.iter().map(|&node| labels[node]));
            let what = format!("{} in no cell, left out: {list}", count(unused.len(), "node"));
            let help = "delete them, or add the cells that they belong to";
            report.warn(nodes.named.places[first], what, help);
        }
        if used.contains(&false) {
            self.keep_nodes(|node| used[node]);
        }
    }

    /// Leaves out all nodes but these; cells and sets count anew.
    pub(super) fn keep_nodes(&mut self, keep: impl Fn(usize) -> bool) {
        let nodes = &mut self.nodes;
        let mut place = vec![usize::MAX; nodes.positions.len()];
        let kept = (0..nodes.positions.len()).filter(|&node| keep(node));
        kept.enumerate().for_each(|(new, old)| place[old] = new);
        let mut old = 0..;
        nodes.positions.retain(|_| keep(old.next().unwrap_or(0)));
        nodes.named.renumber(&place);
        let cells = self.cells.list.iter_mut().flat_map(|cell| &mut cell.nodes);
        cells.for_each(|node| *node = place[*node]);
        for tie in &mut self.ties {
            // Nodes of cells that were refused are no nodes of cells.
            tie.rows.retain(|row| row.iter().all(|(dof, _)| place[dof / 3] != usize::MAX));
            let terms = tie.rows.iter_mut().flatten();
            terms.for_each(|(dof, _)| *dof = 3 * place[*dof / 3] + *dof % 3);
        }
    }

    /// Notes the first node that is too far away to compute with.
    pub(super) fn are_near(&self, report: &mut MeshReport) {
        let positions = self.nodes.positions.iter();
        let mut far = positions.zip(&self.nodes.named.labels).zip(&self.nodes.named.places);
        let found = far.find_map(|((position, label), place)| {
            let along = (0..3).find(|&k| position[k].abs() > FARTHEST)?;
            Some((position[along], ["x", "y", "z"][along], label, *place))
        });
        if let Some((value, along, label, place)) = found {
            let what = format!(
                "node {label} has {along} = {} m, farther than 1000 km from the origin",
                shown(value, 4, 1e-3..1e4)
            );
            let help = "correct the number, or write the units of the file beside `mesh` in the case, such as `units = \"mm, N, t\"`";
            report.error(place, what, help);
        }
    }

    /// Warns of a size that looks like other units.
    pub(super) fn extent(&self, units: &MeshUnits, report: &mut MeshReport) {
        const USUAL: std::ops::Range<f64> = 1e-3..50.0;
        let extent = extent(&self.nodes.positions);
        if extent == 0.0 || USUAL.contains(&extent) {
            return;
        }
        let what = format!("the mesh is {} m long", rounded(extent, 6));
        let help = match extent > 1.0 && units.length == 1.0 {
            true => {
                "if its coordinates are in mm, write `units = \"mm, N, t\"` beside `mesh` in the case"
            }
            false => {
                "write the units of the file beside `mesh` in the case, such as `units = \"m, N, kg\"`"
            }
        };
        report.warn(LinePosition::default(), what, help);
    }
}
