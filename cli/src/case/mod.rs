//! A case: what a case file says, in SI, checked as far as it can be without building the machine.

mod law;
mod library;
mod loads;
mod lumped;
mod machine;
mod march;
mod parameters;
mod read;
mod rotor;
mod schema;

use std::sync::Arc;

use whirl_codegen::diagnostic::Source;

pub use law::{GivenLaw, LawSource, NamedLaw};
pub use library::embedded_cases;
pub use loads::Load;
pub use lumped::{Lumped, Side, Stop, Unbalance};
pub use march::March;
pub(crate) use parameters::rounded;
pub use parameters::{BearingFacts, SetParameter};
pub use read::read;
pub(crate) use read::{SystemDraft, draft};
pub(crate) use rotor::RotorDraft;
pub use rotor::{
    Bearing, Body, Drive, GeneratedMesh, GroundSpring, Mesh, MeshFile, Region, Rotor, Shaft,
    Support,
};

/// One case, ready to be built.
#[derive(Debug, Clone)]
pub struct Case {
    /// Name under which results are kept: that of the file without its ending.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Paper, standard or book; empty if the case does not say.
    pub origin: String,
    /// The files read, the case itself first.
    pub sources: Vec<Arc<Source>>,
    /// What is marched.
    pub system: System,
    /// Time step, duration and tolerances.
    pub march: March,
    /// What figures show beyond the results.
    pub figures: Figures,
}

impl Case {
    /// What results call the supports, in order.
    pub fn support_names(&self) -> Vec<String> {
        let (word, count) = match &self.system {
            System::Rotor(rotor) => ("Support", rotor.bearings.len()),
            System::Lumped(lumped) => ("Stop", lumped.stops.len()),
        };
        (1..=count).map(|k| format!("{word} {k}")).collect()
    }
}

/// What is marched.
#[derive(Debug, Clone)]
pub enum System {
    /// A flexible shaft in clearances on a flexible support.
    Rotor(Box<Rotor>),
    /// One mass between stops.
    Lumped(Lumped),
}

/// Numbers of the figures in the paper, for titles; a figure without number is drawn all the same.
#[derive(Debug, Clone, Default)]
pub struct Figures {
    /// Laws drawn beside each other; those of the case if it names none.
    pub laws: Vec<LawSource>,
    /// Q–h of the laws.
    pub law: Option<usize>,
    /// Reactions RX, RY.
    pub reactions: Option<usize>,
    /// Eccentricity orbits.
    pub eccentricity: Option<usize>,
    /// Angle and speed of rotation.
    pub rotation: Option<usize>,
}
