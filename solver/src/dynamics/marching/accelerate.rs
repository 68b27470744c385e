//! The accelerations that forces give a machine.

use crate::equations::{Equations, State};
use crate::error::Error;
use crate::linalg::Lu;

/// Sets the accelerations of the unknowns at time `t` (s) from M q̈ = r at q̈ = 0, all loads included.
pub(in crate::dynamics) fn accelerate(
    equations: &mut Equations,
    t: f64,
    state: &mut State,
) -> Result<(), Error> {
    let first = equations.machine.first_unknown();
    state.a[first..].fill(0.0);
    state.lag.fill(0.0);
    equations.evaluate(t, state);
    state.a[first..].copy_from_slice(&equations.residual[first..]);
    for body in 0..equations.turning.len() {
        let own = &mut equations.turning[body];
        let (theta, flexible) = (own.theta(), own.place.flexible.clone());
        let given = theta < first;
        let block = own.unknown_mass(state, given);
        let mut mass = Lu::new(block.rows);
        mass.factor(&block.data)?;
        let mut own: Vec<f64> = own.of(&state.a).skip(usize::from(given)).collect();
        mass.solve_in_place(&mut own);
        state.a[flexible].copy_from_slice(&own[usize::from(!given)..]);
        if !given {
            state.a[theta] = own[0];
        }
    }
    equations.evaluate(t, state);
    equations.springs.keep_states(&mut state.laws);
    Ok(())
}
