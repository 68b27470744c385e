//! What a step knows of the states of laws.

use serde::{Deserialize, Serialize};

/// Time (s) after which a state that only integrates is taken for settled, s = h ṡ: its rate is then this part of it a second,
/// and forces have no more than that to do with it.
pub(crate) const LONG: f64 = 1e6;

/// How the states of laws follow from what is known of them.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum Hold {
    /// Their rates are zero, whatever is known of them; those that only integrate stay as they are known, or as they begin.
    #[default]
    Rest,
    /// They are as the laws begin.
    Start,
    /// s = known + weight · ṡ, with the weight of a step (s); they are what is known of them where it is 0.
    Implicit(f64),
    /// Their rates are zero, those of states that only integrate as well: their inputs are such that s = time · ṡ with a long
    /// time (s). A value that is known of one, and a number, stays.
    Settled(f64),
}

/// What is known of the states of all laws: law after law, state after state, spring after spring. All of it is empty where
/// no law has any, and nothing is known where they rest.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LawStates {
    /// The states, or what of them does not hang on their rates.
    pub known: Vec<f64>,
    /// Their rates, in a step those at its start.
    pub rates: Vec<f64>,
    /// (w − ṡ)/Δt, by which the rates w that are integrated differ from ṡ; zero in Newmark's method.
    pub lag: Vec<f64>,
    /// How the states follow.
    pub hold: Hold,
    /// What is known of films, film after film: see `films`. Empty without films.
    pub films: Vec<f64>,
    /// Length of the step in which these become others (s).
    pub step: f64,
}

impl LawStates {
    /// Of so many states, as laws begin.
    pub fn beginning(count: usize) -> Self {
        let values = || vec![0.0; count];
        let hold = if count == 0 { Hold::default() } else { Hold::Start };
        LawStates { known: values(), rates: values(), lag: values(), hold, ..LawStates::default() }
    }

    /// Has them settle, with nothing known of any.
    pub(crate) fn settle(&mut self) {
        self.known.fill(f64::NAN);
        self.hold = Hold::Settled(LONG);
    }

    pub(crate) fn copy_from(&mut self, other: &LawStates) {
        self.known.clone_from(&other.known);
        self.rates.clone_from(&other.rates);
        self.lag.clone_from(&other.lag);
        self.hold = other.hold;
        self.films.clone_from(&other.films);
        self.step = other.step;
    }
}
