//! What a joint of any kind has, as its table says it.

use whirl_codegen::diagnostic::Located;

use crate::case::joint::OtherLaw;
use crate::case::law::NamedLaw;
use crate::case::parameters::{BearingFacts, SetParameter};

/// What a joint of any kind has.
pub(super) struct Parts {
    pub(super) springs: usize,
    pub(super) law: NamedLaw,
    pub(super) parameters: Vec<SetParameter>,
    pub(super) facts: BearingFacts,
    pub(super) clearance: f64,
    /// Whether the meshes say the clearance.
    pub(super) from_mesh: bool,
    pub(super) stations: Vec<f64>,
    pub(super) angle: Option<f64>,
    pub(super) others: Vec<OtherLaw>,
    pub(super) table: Option<Located>,
}

impl Parts {
    /// Of a joint that acts once, without clearance, by a law with these values.
    pub(super) fn of_law(law: NamedLaw, parameters: Vec<SetParameter>) -> Parts {
        Parts {
            springs: 1,
            law,
            parameters,
            facts: BearingFacts::default(),
            clearance: 0.0,
            from_mesh: false,
            stations: Vec::new(),
            angle: None,
            others: Vec::new(),
            table: None,
        }
    }

    /// With laws on other motions, and the file of its coefficients.
    pub(super) fn with(self, others: Vec<OtherLaw>, table: Option<Located>) -> Parts {
        Parts { others, table, ..self }
    }
}
