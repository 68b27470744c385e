//! A bearing that is compared with its meshes, and how messages speak of it.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::Mesh;

use super::super::place::{digits, list};
use crate::case;

/// The axes of journal and bore are apart by at most this part of the clearance, which knows nothing of it.
const AXES: f64 = 0.01;

/// A bearing that is compared with its meshes.
pub(super) struct Comparison<'a, 'e> {
    /// Of the bearing, counted from 0.
    pub(super) place: usize,
    pub(super) whole: &'a case::Bearing,
    /// x and y of the axis of the journal's body, from which its mesh counts (m).
    pub(super) axis: [f64; 2],
    /// Names of the bodies of journal and bore, where the case names bodies.
    pub(super) bodies: Option<[&'a str; 2]>,
    pub(super) errors: &'e mut Diagnostics,
}

impl Comparison<'_, '_> {
    pub(super) fn note(&mut self, at: &Located, message: String, help: String) {
        self.errors.push(at.error_here(Code::BAD_VALUE, message).help(help));
    }

    /// What messages call the body of the journal.
    pub(super) fn shaft(&self) -> String {
        self.bodies.map_or("the shaft".to_owned(), |[name, _]| format!("`{name}`"))
    }

    /// How the case lists sets of the journal or the bore.
    pub(super) fn listed<'b>(&self, key: &str, names: impl IntoIterator<Item = &'b str>) -> String {
        let sets = list(names);
        match self.bodies {
            None => format!("write `{key} = {sets}`"),
            Some([journal, bore]) => {
                let body = if key == "journal" { journal } else { bore };
                format!("write `{key} = {{ body = {body:?}, sets = {sets} }}`")
            }
        }
    }

    /// Where the case says `key`, or the bearing.
    pub(super) fn place_of(&self, key: &str) -> Located {
        self.whole.places.get(key).unwrap_or(&self.whole.table).clone()
    }

    /// How far the axes of journal and bore may be apart.
    pub(super) fn off_axis(&self, mesh: &Mesh) -> f64 {
        (AXES * self.whole.radial_clearance).max(digits(mesh))
    }
}
