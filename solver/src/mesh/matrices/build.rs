//! From entries by dof to a mesh without cells.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use super::super::body_matrices::{BodyMatrices, Slot, Spin};
use super::super::placed_nodes::PlacedNodes;
use super::super::raw::{LinePosition, MeshReport, count, list};
use super::super::units::MeshUnits;
use super::super::{Mesh, MeshParts};
use super::entries::{Entries, Entry, Kind};
use super::{checks, rigid, spin};
use crate::error::InputErrors;
use crate::linalg::LowerTriangle;
use crate::sparse::{SparseColumns, SparseMatrix};

/// A dof of the files.
#[derive(Debug, Clone, Copy)]
pub(super) struct RawDof {
    /// Of its node; of a coordinate its number.
    pub(super) label: u64,
    /// Not [`Slot::Absent`].
    pub(super) slot: Slot,
    pub(super) place: LinePosition,
}

impl RawDof {
    /// As messages call it.
    pub(super) fn called(&self) -> String {
        let axis = |i: usize| ["x", "y", "z"][i];
        match self.slot {
            Slot::Translation(i) => format!("node {} {}", self.label, axis(i)),
            Slot::Turn(i) => format!("node {} r{}", self.label, axis(i)),
            Slot::Coordinate | Slot::Absent => format!("coordinate {}", self.label),
        }
    }
}

/// What the files hold.
pub(super) struct RawMatrices {
    pub(super) dofs: Vec<RawDof>,
    pub(super) nodes: PlacedNodes,
    pub(super) stiffness: Entries,
    pub(super) mass: Entries,
    pub(super) others: Others,
    pub(super) units: MeshUnits,
    /// What errors of the reduction call the body.
    pub(super) origin: String,
    /// The file that says where nodes are.
    pub(super) placed_by: String,
}

/// Matrices beside K and M.
pub(super) struct Others {
    pub(super) spin_inertia: Option<Entries>,
    pub(super) spin_coupling: Option<Entries>,
    pub(super) stiffening: Option<Entries>,
    /// One value a dof.
    pub(super) spin_load: Option<Vec<f64>>,
}

/// Where the dofs of the files are among those of the mesh.
struct Layout {
    slots: Vec<Slot>,
    /// One a dof of the files.
    place: Vec<usize>,
    nodes: Vec<[f64; 3]>,
    labels: Vec<u64>,
    placed: usize,
}

impl RawMatrices {
    /// The mesh, or all that is wrong.
    pub(super) fn finish(self, mut report: MeshReport) -> Result<(Mesh, MeshReport), InputErrors> {
        let called: Vec<String> = self.dofs.iter().map(RawDof::called).collect();
        self.stand_once(&mut report);
        let layout = self.layout(&mut report);
        let symmetric = |entries: &Entries, report: &mut MeshReport| {
            entries.lower(Kind::Symmetric, &called, report)
        };
        let stiffness = symmetric(&self.stiffness, &mut report);
        let mass = symmetric(&self.mass, &mut report);
        checks::minors(&self.stiffness, &stiffness, &called, &mut report);
        checks::minors(&self.mass, &mass, &called, &mut report);
        let inertia = self.others.spin_inertia.as_ref().map(|own| symmetric(own, &mut report));
        let stiffening = self.others.stiffening.as_ref().map(|own| symmetric(own, &mut report));
        let coupling = self
            .others
            .spin_coupling
            .as_ref()
            .map(|own| own.lower(Kind::Skew, &called, &mut report));
        if report.error_count() > 0 {
            return Err(report.into_errors());
        }
        let MeshUnits { length, force, mass: kg } = self.units;
        // Dofs in m, rad or without a unit, by those of the file; energies in J.
        let by = |dof: usize| match self.dofs[dof].slot {
            Slot::Translation(_) => length,
            _ => 1.0,
        };
        let placed = |list: &[Entry], energy: f64| -> LowerTriangle {
            let triplet = |entry: &Entry| {
                let [i, j] = [entry.row, entry.column].map(|dof| layout.place[dof]);
                let value = entry.value * (energy / by(entry.row) / by(entry.column));
                (i.max(j), i.min(j), value)
            };
            let size = layout.slots.len();
            SparseColumns::from_triplets(size, size, list.iter().map(triplet).collect())
                .into_lower()
        };
        let (potential, kinetic) = (force * length, kg * length * length);
        let stiffness = placed(&stiffness, potential);
        let mass = placed(&mass, kinetic);
        let load = self.others.spin_load.as_ref().map(|values| {
            let mut load = vec![0.0; layout.slots.len()];
            for (dof, value) in values.iter().enumerate() {
                load[layout.place[dof]] = value * (kinetic / by(dof));
            }
            load
        });
        let matrix = |list: &Vec<Entry>| SparseMatrix::Symmetric(placed(list, kinetic));
        let given = match (&inertia, &coupling, load) {
            (Some(inertia), Some(coupling), Some(load)) => {
                let coupling = skew(coupling, &layout, |entry| {
                    entry.value * (kinetic / by(entry.row) / by(entry.column))
                });
                Some(Spin { inertia: matrix(inertia), coupling, load: Some(load) })
            }
            _ => None,
        };
        let (spin, mass) = match (given, spin::of_mass(&layout.slots, &mass)) {
            (None, Some((spin, mass))) => (Some(spin), mass),
            (given, _) => (given, SparseMatrix::Symmetric(mass)),
        };
        let stiffness = SparseMatrix::Symmetric(stiffness);
        let held = rigid::resisted(&layout.nodes, &layout.slots, &stiffness);
        let (node_sets, lacking) = self.sets(&layout);
        let each = (0..layout.nodes.len()).collect();
        let stiffening = stiffening.as_ref().map(matrix);
        let Layout { slots, nodes, labels, placed, .. } = layout;
        let matrices =
            BodyMatrices { slots, placed, each, lacking, stiffness, mass, spin, stiffening, held };
        let [stiff, heavy] = [self.stiffness.file, self.mass.file];
        checks::body(&matrices, &nodes, &labels, [stiff, heavy], &mut report);
        if report.error_count() > 0 {
            return Err(report.into_errors());
        }
        let parts = MeshParts {
            origin: self.origin,
            nodes,
            labels,
            node_sets,
            matrices: Some(Arc::new(matrices)),
            ..MeshParts::default()
        };
        match Mesh::new(parts) {
            Ok(mesh) => Ok((mesh, report)),
            Err(error) => {
                report.error_in_file(
                    error.to_string(),
                    "correct it in the file, or write the file anew",
                );
                Err(report.into_errors())
            }
        }
    }

    /// Notes dofs that are listed twice.
    fn stand_once(&self, report: &mut MeshReport) {
        let mut first: HashMap<(u64, Slot), LinePosition> = HashMap::new();
        for dof in &self.dofs {
            if let Some(known) = first.insert((dof.label, dof.slot), dof.place) {
                let line = report.line(known, dof.place);
                let what = format!("{} is listed twice", dof.called());
                report.error(dof.place, what, format!("{line} has the first; list each dof once"));
            }
        }
    }

    /// Nodes with a place in the order of their first dofs, then one for the turns of each, then the coordinates, three a node.
    fn layout(&self, report: &mut MeshReport) -> Layout {
        let mut nodes: Vec<[f64; 3]> = Vec::new();
        let mut labels: Vec<u64> = Vec::new();
        let mut index: HashMap<u64, usize> = HashMap::new();
        let mut lost = Vec::new();
        for dof in self.dofs.iter().filter(|dof| dof.slot != Slot::Coordinate) {
            if index.contains_key(&dof.label) {
                continue;
            }
            let place = self.nodes.places.get(&dof.label);
            if place.is_none() {
                lost.push(dof);
            }
            if let Some(system) = self.nodes.turned.get(&dof.label) {
                let what = format!(
                    "the displacements of node {} are along the axes of coordinate system {system}",
                    dof.label
                );
                let help = "write the matrices in basic axes: leave the displacement coordinate system (CD) of its GRID blank";
                report.error(dof.place, what, help);
            }
            index.insert(dof.label, nodes.len());
            nodes.push(place.copied().unwrap_or_default());
            labels.push(dof.label);
        }
        if let Some(first) = lost.first() {
            let all = list(lost.iter().map(|dof| dof.label));
            let what = format!("{} without a place: {all}", count(lost.len(), "node"));
            let help = format!("say where they are in {}", self.placed_by);
            report.error(first.place, what, help);
        }
        let placed = nodes.len();
        if !self.dofs.iter().any(|dof| matches!(dof.slot, Slot::Translation(_))) {
            let what =
                "no dof is a displacement of a node, so that nothing could be joined to the body";
            report.error_in_file(what, "keep the displacements of the nodes of its joints as dofs");
        }
        let mut turns: HashMap<usize, usize> = HashMap::new();
        let mut slots = vec![Slot::Absent; 3 * placed];
        let mut extra = |place: [f64; 3], label: u64, slots: &mut Vec<Slot>| {
            nodes.push(place);
            labels.push(label);
            slots.extend([Slot::Absent; 3]);
            slots.len() - 3
        };
        let mut place = Vec::with_capacity(self.dofs.len());
        let mut next = None;
        for dof in &self.dofs {
            let node = index.get(&dof.label).copied().filter(|_| dof.slot != Slot::Coordinate);
            let at = match (dof.slot, node) {
                (Slot::Translation(i), Some(node)) => 3 * node + i,
                (Slot::Turn(i), Some(node)) => {
                    let known = turns.get(&node).copied();
                    let first = known.unwrap_or_else(|| {
                        let at = self.nodes.places.get(&dof.label).copied().unwrap_or_default();
                        extra(at, dof.label, &mut slots)
                    });
                    turns.insert(node, first);
                    first + i
                }
                _ => {
                    let first = self.dofs.iter().find(|own| own.slot != Slot::Coordinate);
                    let at = first.and_then(|own| self.nodes.places.get(&own.label));
                    let free = next.filter(|own| own % 3 != 0);
                    let own = free.unwrap_or_else(|| {
                        extra(at.copied().unwrap_or_default(), dof.label, &mut slots)
                    });
                    next = Some(own + 1);
                    own
                }
            };
            slots[at] = dof.slot;
            place.push(at);
        }
        Layout { slots, place, nodes, labels, placed }
    }

    /// The sets with those of their nodes that have dofs, and how many have none.
    fn sets(&self, layout: &Layout) -> (BTreeMap<String, Vec<usize>>, Vec<(String, usize, u64)>) {
        let nodes = layout.labels[..layout.placed].iter().enumerate();
        let index: HashMap<u64, usize> = nodes.map(|(node, &label)| (label, node)).collect();
        let (mut sets, mut lacking) = (BTreeMap::new(), Vec::new());
        for (name, labels) in &self.nodes.sets {
            let found = labels.iter().filter_map(|label| index.get(label).copied());
            sets.insert(name.clone(), found.collect());
            let mut lost = labels.iter().filter(|label| !index.contains_key(label));
            if let Some(&first) = lost.next() {
                lacking.push((name.clone(), 1 + lost.count(), first));
            }
        }
        (sets, lacking)
    }
}

/// Both halves of a skew matrix of which the entries below the diagonal are listed.
fn skew(list: &[Entry], layout: &Layout, value: impl Fn(&Entry) -> f64) -> SparseMatrix {
    let mut triplets = Vec::with_capacity(2 * list.len());
    for entry in list.iter().filter(|entry| entry.row != entry.column) {
        let [i, j] = [entry.row, entry.column].map(|dof| layout.place[dof]);
        triplets.extend([(i, j, value(entry)), (j, i, -value(entry))]);
    }
    let size = layout.slots.len();
    SparseMatrix::General(SparseColumns::from_triplets(size, size, triplets))
}
