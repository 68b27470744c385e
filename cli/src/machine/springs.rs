//! Laws of springs, each once, and the places of springs around a bore.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::Error;
use whirl_solver::bearing::{FrequencyLaw, SpringLaw};
use whirl_solver::cache::Key;
use whirl_specs::{CLEARANCES, Clearance};

use crate::case::{Joint, LawSource};
use crate::errors::Failure;
use crate::law_file::LawFile;

/// How to fix a ring of a bore whose nodes springs cannot stand between.
pub(super) const NAME_A_RING: &str = "name a set of nodes all around the bore, in one plane";

/// Laws in the order in which they are first named, each once.
#[derive(Default)]
pub(super) struct Laws {
    used: Vec<LawSource>,
    laws: Vec<Box<dyn SpringLaw>>,
}

impl Laws {
    /// The place of a law, which is added if it is new.
    pub(super) fn place(&mut self, law: &LawSource) -> Result<usize, Failure> {
        let name = law.name();
        let same = |known: &LawSource| known.name() == name && law.film().is_none();
        if let Some(place) = self.used.iter().position(same) {
            return Ok(place);
        }
        self.laws.push(match law {
            LawSource::BuiltIn(law) => Box::new(*law),
            LawSource::File(spec) => Box::new(LawFile::new(spec, &[])?),
            LawSource::Film(film) => Box::new(film.built()?),
            LawSource::Given(law) => {
                let own = LawFile::new(&law.spec, &law.given)?;
                match &law.over_frequency {
                    Some(over) => Box::new(FrequencyLaw {
                        hash: Key::of(&format!("{}\0{}", own.hash(), over.file.text)).hex(),
                        still: Box::new(own),
                        table: over.table.clone(),
                    }),
                    None => Box::new(own),
                }
            }
        });
        self.used.push(law.clone());
        Ok(self.used.len() - 1)
    }

    /// The laws as the case uses them.
    pub(super) fn used(&self) -> Vec<LawSource> {
        self.used.clone()
    }

    /// Names and hashes of the specs.
    pub(super) fn hashes(&self) -> Vec<(String, String)> {
        let hashes = self.laws.iter().map(|law| law.hash().to_string());
        self.used.iter().map(LawSource::name).zip(hashes).collect()
    }

    /// The laws.
    pub(super) fn into_laws(self) -> Vec<Box<dyn SpringLaw>> {
        self.laws
    }
}

/// Errors of a machine where the case causes them: at the law of a bearing, or at the set of a ring of its
/// bore.
pub(super) fn explain(error: Error, joints: &[Joint]) -> Failure {
    let mut placed = Diagnostics::new();
    for part in error.parts() {
        match part {
            Error::Law { law, bearing: Some(place), what, help } => {
                let message = format!("the law `{law}` {what}");
                let found = joints[*place].bearing.law.name.error_here(Code::BAD_VALUE, message);
                placed.push(found.help(help.clone()));
            }
            Error::Bore { place, ring, .. } => {
                let Some(set) = joints[*place].bearing.bore.get(*ring) else { continue };
                placed.push(set.error_here(Code::BAD_VALUE, part.to_string()).help(NAME_A_RING));
            }
            _ => {}
        }
    }
    match placed.into_result(()) {
        Ok(()) => error.into(),
        Err(placed) => placed.into(),
    }
}

/// Fixed angles ψ_j of `count` springs, rad.
pub(super) fn angles(count: usize) -> Vec<f64> {
    (0..count).map(|j| TAU * j as f64 / count as f64).collect()
}

/// The clearance of a journal in its bore.
///
/// # Panics
/// If the specs have none: then no bearing can be built.
pub(super) fn clearance() -> &'static Clearance {
    CLEARANCES
        .iter()
        .find(|clearance| clearance.origin.name == "journal")
        .expect("specs/motion describes the clearance of a journal")
}
