//! A film as the law of a joint: from displacement, tilts, their rates and the speed to forces and moments.

use super::law::SpringLaw;
use crate::film::{INPUTS, Journal, JournalMotion, OUTPUTS};

/// A film between a journal and a bore that do not deform.
#[derive(Debug, Clone)]
pub struct FilmLaw {
    /// Name, as the case says it.
    pub name: String,
    /// Hash of its spec and of what the case says of it.
    pub hash: String,
    /// The film in its bore.
    pub journal: Journal,
}

impl FilmLaw {
    /// What a film takes of a joint, in the order of [`JournalMotion`].
    pub const TAKEN: [&str; INPUTS] = [
        "e_x",
        "e_y",
        "alpha_x",
        "alpha_y",
        "e_x_dot",
        "e_y_dot",
        "alpha_x_dot",
        "alpha_y_dot",
        "omega",
    ];
    /// What it gives to it, in the order of [`crate::film::Reaction`].
    pub const GIVEN: [&str; OUTPUTS] = ["F_x", "F_y", "M_x", "M_y", "M_z"];
}

impl SpringLaw for FilmLaw {
    fn name(&self) -> &str {
        &self.name
    }
    fn hash(&self) -> &str {
        &self.hash
    }
    fn inputs(&self) -> Vec<&str> {
        Self::TAKEN.to_vec()
    }
    fn outputs(&self) -> Vec<&str> {
        Self::GIVEN.to_vec()
    }
    fn workspace(&self) -> usize {
        0
    }
    /// A film has a state, which is none of the inputs: without it there are no numbers.
    fn evaluate(&self, _: usize, _: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        outputs.fill(f64::NAN);
    }
    fn film(&self) -> Option<&Journal> {
        Some(&self.journal)
    }
}

/// How a journal moves, from what a film takes.
pub(super) fn motion(taken: &[f64; INPUTS], step: Option<f64>) -> JournalMotion {
    let [x, y, about_x, about_y, x_dot, y_dot, about_x_dot, about_y_dot, omega] = *taken;
    JournalMotion {
        displacement: [x, y],
        tilt: [about_x, about_y],
        velocity: [x_dot, y_dot],
        tilting: [about_x_dot, about_y_dot],
        omega,
        step,
    }
}
