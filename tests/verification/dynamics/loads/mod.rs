//! Loads, drives and weights of machines as they run.

mod orders;
mod prescribed;
mod release;
mod weight;

use whirl_solver::dynamics::{March, MarchOptions, State};
use whirl_solver::linalg::Matrix;
use whirl_solver::machine::Machine;

use super::DISCS;

/// No section of the discs turns against its frame: couples act on θ alone.
fn rigid_turn() -> Matrix {
    Matrix::zeros(3, 2 * DISCS)
}

/// The state at the end of a march.
fn end(machine: &Machine, options: &MarchOptions) -> State {
    let mut march = March::new(machine, options).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    march.state().clone()
}
