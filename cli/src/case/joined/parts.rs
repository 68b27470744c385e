//! What a joint of any kind has, as its table says it.

use whirl_codegen::diagnostic::Located;

use crate::case::gears::Gears;
use crate::case::joint::OtherLaw;
use crate::case::law::NamedLaw;
use crate::case::parameters::{BearingFacts, SetParameter};

/// What a joint of any kind has.
pub(in crate::case) struct Parts {
    pub(in crate::case) springs: usize,
    pub(in crate::case) law: NamedLaw,
    pub(in crate::case) parameters: Vec<SetParameter>,
    pub(in crate::case) facts: BearingFacts,
    pub(in crate::case) clearance: f64,
    /// Whether the meshes say the clearance.
    pub(in crate::case) from_mesh: bool,
    pub(in crate::case) stations: Vec<f64>,
    pub(in crate::case) angle: Option<f64>,
    pub(in crate::case) others: Vec<OtherLaw>,
    pub(in crate::case) table: Option<Located>,
    pub(in crate::case) gears: Option<Gears>,
}

impl Parts {
    /// Of a joint that acts once, without clearance, by a law with these values.
    pub(in crate::case) fn of_law(law: NamedLaw, parameters: Vec<SetParameter>) -> Parts {
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
            gears: None,
        }
    }

    /// With laws on other motions, and the file of its coefficients.
    pub(in crate::case) fn with(self, others: Vec<OtherLaw>, table: Option<Located>) -> Parts {
        Parts { others, table, ..self }
    }
}
