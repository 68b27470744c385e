//! Oil films between a journal and its bore: Reynolds' equation on the developed bore, with two unknowns a node of which
//! one is zero, by the kernels of a film's spec.
//!
//! ```text
//! description: Grid, Opening, OilFilm      (immutable)
//! state:       Oil                         (pressure and fill of the nodes)
//! Balance:     residual ─▶ active set ─▶ elimination ─▶ next state, until the balance of oil holds
//! Journal:     displacement, tilts, rates ─▶ gaps ─▶ forces, moments and their slopes
//! Heat:        loss, oil that passes, housing ─▶ temperature ─▶ viscosity of the next step
//! Shapes:      a bore that gives way ─▶ gaps; the film pushes on its shapes
//! ```
//!
//! A node holds oil, and its rate balances what flows between cells:
//! R_a = Σ_cells R_cell + A_a (X(θ, h̃) − X₀)/Δt, with h̃ = h + ½ Δt ḣ, the gap whose difference over a step is Δt ḣ₁, so that
//! a whole film feels Newmark's own rate and oil is conserved in X. Without Δt the film is steady, or squeezed by a given ḣ.

mod balance;
mod band;
mod grid;
mod heat;
mod journal;
mod oil;
mod openings;
mod reaction;
mod shapes;
mod slopes;
mod solve;
#[cfg(test)]
mod tests;
mod warmed;

pub use balance::{Balance, Motion};
pub use grid::{Grid, Sample};
pub use heat::{Heat, OIL_LASTS, Viscosity, Warming};
pub use journal::{Journal, TIPPED};
pub use oil::Oil;
pub use openings::{OilFilm, Opening, Reach, WrongFilm};
pub use reaction::{INPUTS, JournalMotion, OUTPUTS, Reaction};
pub use shapes::{ShapeSlopes, Shapes};
pub use solve::Unsolved;
