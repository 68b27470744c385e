//! Matrices by the cards `DMIG` of Nastran, of a punch file or of bulk data.

use std::collections::{BTreeMap, HashMap};

use super::super::bdf::{Dmig, DmigColumn};
use super::super::body_matrices::Slot;
use super::super::raw::{LinePosition, MeshReport, count, list};
use super::build::RawDof;
use super::entries::{Entries, Entry, Form};

/// The matrices of a file by their names in capitals.
pub(super) struct DmigFile {
    pub(super) matrices: BTreeMap<String, Dmig>,
    /// Index of the file in which errors about all of it are.
    pub(super) file: usize,
}

/// Node and component of a dof.
type Key = (u64, u64);

/// Dofs by node and component.
pub(super) struct Dofs {
    pub(super) list: Vec<RawDof>,
    index: HashMap<Key, usize>,
}

impl DmigFile {
    fn get(&self, name: &str, key: &str, report: &mut MeshReport) -> Option<&Dmig> {
        let found = self.matrices.get(&name.to_ascii_uppercase());
        if found.is_none() {
            let what = format!("the file has no DMIG `{name}`");
            let known = list(self.matrices.keys());
            let help = format!("write its name as `{key}` of the case: the file has {known}");
            report.error(LinePosition { file: self.file, line: 0, column: 0 }, what, help);
        }
        found
    }

    /// The dofs of these matrices, by node and component; `keys`: of the case, with their names.
    pub(super) fn dofs(&self, keys: &[(&str, &str)], report: &mut MeshReport) -> Dofs {
        let mut all: BTreeMap<Key, LinePosition> = BTreeMap::new();
        for (key, name) in keys {
            let Some(matrix) = self.get(name, key, report) else { continue };
            for column in &matrix.columns {
                all.entry((column.node, column.component)).or_insert(column.place);
                for entry in &column.entries {
                    all.entry((entry.node, entry.component)).or_insert(entry.place);
                }
            }
        }
        let mut dofs = Dofs { list: Vec::with_capacity(all.len()), index: HashMap::new() };
        for ((label, component), place) in all {
            let slot = match component {
                0 => Slot::Coordinate,
                i @ 1..=3 => Slot::Translation(i as usize - 1),
                i @ 4..=6 => Slot::Turn(i as usize - 4),
                _ => {
                    let what = format!("{component} is no component of node {label}");
                    report.error(place, what, "components are 1 to 6, and 0 of a scalar point");
                    continue;
                }
            };
            dofs.index.insert((label, component), dofs.list.len());
            dofs.list.push(RawDof { label, slot, place });
        }
        dofs
    }

    /// A square matrix, called `called`.
    pub(super) fn entries(
        &self,
        (key, name): (&str, &str),
        called: &str,
        dofs: &Dofs,
        report: &mut MeshReport,
    ) -> Option<Entries> {
        let before = report.error_count();
        let matrix = self.get(name, key, report)?;
        let known = if name == called { called.to_owned() } else { format!("{called} ({name})") };
        let form = match matrix.form {
            6 => Form::Symmetric,
            1 => Form::General,
            other => {
                let what = format!(
                    "{known} has the form {other}, and must be square (1) or symmetric (6)"
                );
                report.error(matrix.place, what, "export it as a square or symmetric matrix");
                return None;
            }
        };
        let mut list = Vec::new();
        for column in &matrix.columns {
            let Some(own) = dofs.of(column.node, column.component, column.place, report) else {
                continue;
            };
            for entry in &column.entries {
                let Some(row) = dofs.of(entry.node, entry.component, entry.place, report) else {
                    continue;
                };
                list.push(Entry { row, column: own, value: entry.value, line: entry.place.line });
            }
        }
        let file = matrix.place.file;
        (report.error_count() == before).then_some(Entries { name: known, file, form, list })
    }

    /// A matrix of one column, by the dofs.
    pub(super) fn column(
        &self,
        (key, name): (&str, &str),
        dofs: &Dofs,
        report: &mut MeshReport,
    ) -> Option<Vec<f64>> {
        let matrix = self.get(name, key, report)?;
        let [DmigColumn { entries, .. }] = &matrix.columns[..] else {
            let what =
                format!("{name} has {}, and must have one", count(matrix.columns.len(), "column"));
            report.error(
                matrix.place,
                what,
                "write the load at 1 rad/s as one column, with form 2 or 9",
            );
            return None;
        };
        let mut values = vec![0.0; dofs.list.len()];
        for entry in entries {
            if let Some(dof) = dofs.of(entry.node, entry.component, entry.place, report) {
                values[dof] += entry.value;
            }
        }
        Some(values)
    }
}

impl Dofs {
    fn of(
        &self,
        node: u64,
        component: u64,
        place: LinePosition,
        report: &mut MeshReport,
    ) -> Option<usize> {
        let found = self.index.get(&(node, component)).copied();
        if found.is_none() && component <= 6 {
            let what = format!("component {component} of node {node} is no dof of K or M");
            report.error(place, what, "export all matrices of the same dofs");
        }
        found
    }
}
