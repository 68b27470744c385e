//! The matrices that a body without cells has.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::sparse::{SparseColumns, SparseMatrix};

/// What a dof of a body is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Slot {
    /// The displacement of a node with a place along x, y, z (0, 1, 2), in m.
    Translation(usize),
    /// The small rotation of a node about x, y, z (0, 1, 2), in rad.
    Turn(usize),
    /// A coordinate without a place, such as that of a mode.
    Coordinate,
    /// None: the matrices do not have it, and it is held.
    Absent,
}

/// The matrices of a body, in SI units; all have a row and a column a dof, 3·nodes.
#[derive(Debug, Clone)]
pub struct BodyMatrices {
    /// What each dof is.
    pub(crate) slots: Vec<Slot>,
    /// Nodes that have a place, the first ones of the mesh.
    pub(crate) placed: usize,
    /// Every node by its index, so that one is a set.
    pub(super) each: Vec<usize>,
    /// Sets with nodes that have no dofs: how many, and the label of the first one.
    pub(super) lacking: Vec<(String, usize, u64)>,
    /// K (N/m), M (kg).
    pub(super) stiffness: SparseMatrix,
    pub(super) mass: SparseMatrix,
    /// What couples deformation and rotation about z; none where it is not known.
    pub(super) spin: Option<Spin>,
    /// G (N per (rad/s)² and m).
    pub(super) stiffening: Option<SparseMatrix>,
    /// Which of the rigid motions K resists: shifts along x, y, z and turns about them.
    pub(super) held: [bool; 6],
}

/// Y and H of a body (kg).
#[derive(Debug, Clone)]
pub(super) struct Spin {
    pub(super) inertia: SparseMatrix,
    pub(super) coupling: SparseMatrix,
    /// Y x0 (kg·m), where it does not follow from Y and the positions of the nodes.
    pub(super) load: Option<Vec<f64>>,
}

/// How the matrices for a turning body are got where M alone does not tell them.
const SPIN_HELP: &str = "M tells them where it is the same along x, y and z (whole models of solids, or masses on nodes): \
     export K and M of the whole model; or give `spin_inertia`, `spin_coupling` and `spin_load` of the same dofs";

impl BodyMatrices {
    /// Dofs that the matrices lack, ascending.
    pub fn absent(&self) -> impl Iterator<Item = usize> + '_ {
        let slots = self.slots.iter().enumerate();
        slots.filter(|(_, slot)| **slot == Slot::Absent).map(|(dof, _)| dof)
    }

    /// Whether a dof is one of the matrices.
    pub fn has(&self, dof: usize) -> bool {
        self.slots.get(dof).is_some_and(|slot| *slot != Slot::Absent)
    }

    /// Number of dofs.
    pub fn count(&self) -> usize {
        self.slots.iter().filter(|slot| **slot != Slot::Absent).count()
    }

    /// The dofs that turn these nodes about x, y and z, one a node; `labels`: of all nodes of the mesh.
    pub(super) fn turns(&self, labels: &[u64], nodes: &[usize]) -> Vec<[Option<usize>; 3]> {
        let mut of_label: BTreeMap<u64, [Option<usize>; 3]> = BTreeMap::new();
        for (dof, slot) in self.slots.iter().enumerate().skip(3 * self.placed) {
            if let Slot::Turn(axis) = *slot {
                of_label.entry(labels[dof / 3]).or_default()[axis] = Some(dof);
            }
        }
        let own = |node: &usize| of_label.get(&labels[*node]).copied().unwrap_or_default();
        nodes.iter().map(own).collect()
    }

    /// How many nodes of a set have no dofs, and the label of the first of them; none where all have.
    pub fn lacking(&self, set: &str) -> Option<(usize, u64)> {
        let found = self.lacking.iter().find(|(name, ..)| name.eq_ignore_ascii_case(set));
        found.map(|&(_, count, label)| (count, label))
    }

    /// Load Y x0 that is given (kg·m, 3·nodes), in place of what follows from Y and the positions.
    pub(crate) fn spin_load(&self) -> Option<&[f64]> {
        self.spin.as_ref().and_then(|spin| spin.load.as_deref())
    }

    /// The matrix in place of an assembled one.
    pub(crate) fn form(&self, form: &str, origin: &str) -> Result<SparseMatrix, Error> {
        let spin = self.spin.as_ref();
        let found = match form {
            "stiffness" => Some(&self.stiffness),
            "mass" => Some(&self.mass),
            "spin_inertia" => spin.map(|spin| &spin.inertia),
            "spin_coupling" => spin.map(|spin| &spin.coupling),
            _ => self.stiffening.as_ref(),
        };
        found.cloned().ok_or_else(|| {
            let (what, help) = self.missing(form);
            Error::Mesh { origin: origin.to_owned(), what: format!("{what}; {help}") }
        })
    }

    /// Why a body that is `kind` (`that turns`, `rigid`) cannot have this stiffness, and what to do; none if it is free.
    pub fn lacks_to_be_free(&self, kind: &str) -> Option<(String, String)> {
        let held = self.held_against();
        if held.is_empty() {
            return None;
        }
        let what = format!(
            "the stiffness holds the body to the ground against {}, but a body {kind} must be free",
            held.join(", ")
        );
        let help = "write K and M without constraints and ground springs; what joins the body is said in the case";
        Some((what, help.to_owned()))
    }

    /// What a body that turns lacks beside K and M, and how to get it; none if it lacks nothing.
    pub fn lacks_to_turn(&self, stiffening: bool) -> Option<(String, String)> {
        let form = if self.spin.is_none() { "spin_inertia" } else { "stiffening" };
        if form == "stiffening" && (!stiffening || self.stiffening.is_some()) {
            return None;
        }
        let (what, help) = self.missing(form);
        Some((what.to_owned(), help.to_owned()))
    }

    /// The rigid motions that K resists, in words.
    pub(super) fn held_against(&self) -> Vec<&'static str> {
        const NAMES: [&str; 6] = [
            "shifts along x",
            "shifts along y",
            "shifts along z",
            "turns about x",
            "turns about y",
            "turns about z",
        ];
        NAMES.into_iter().zip(self.held).filter(|(_, held)| *held).map(|(name, _)| name).collect()
    }

    /// Why there is no matrix of this form, and how to get it.
    fn missing(&self, form: &str) -> (&'static str, &'static str) {
        match form {
            "stiffening" => (
                "matrices have no cells from which the stress of rotation could follow",
                "give G as `stiffening` of the matrices, or write `stiffening = false` for the body, which leaves out how \
                 rotation stiffens it",
            ),
            _ => (
                "a body that turns needs the matrices Y and H, which are not given and do not follow from M",
                SPIN_HELP,
            ),
        }
    }

    /// All that a reduced body depends on, for the key of a cache.
    pub(crate) fn content(&self) -> impl Serialize + use<> {
        let BodyMatrices {
            slots,
            placed,
            // Sets, and what follows from K.
            each: _,
            lacking: _,
            held: _,
            stiffness,
            mass,
            spin,
            stiffening,
        } = self;
        let spin = spin.as_ref().map(|Spin { inertia, coupling, load }| {
            (listed(inertia), listed(coupling), load.clone())
        });
        let stiffening = stiffening.as_ref().map(listed);
        (slots.clone(), *placed, listed(stiffness), listed(mass), spin, stiffening)
    }
}

/// Where each column of a matrix begins, and its rows and values.
fn listed(matrix: &SparseMatrix) -> (Vec<usize>, Vec<usize>, Vec<f64>) {
    let SparseColumns { starts, rows, values, .. } = matrix.to_columns();
    (starts, rows, values)
}
