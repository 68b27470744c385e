//! The fastest motion of a machine as it is at one instant.

use crate::equations::{Equations, State, Weights};
use crate::linalg::Cholesky;

/// The largest eigenvalue of M⁻¹K of the unknowns at a state, K = −∂r/∂q with all its springs, by the power
/// method; NaN where M cannot be inverted.
pub(in crate::dynamics) fn largest_eigenvalue(
    equations: &mut Equations,
    t: f64,
    state: &State,
) -> f64 {
    /// The method's error falls at least as 1/iterations.
    const ITERATIONS: usize = 100;
    let machine = equations.machine;
    let (size, first) = (machine.size(), machine.first_unknown());
    equations.evaluate(t, state);
    let mut stiffness = vec![0.0; size * size];
    equations.tangent(t, state, Weights::POSITION, &mut stiffness);
    let unknowns: Vec<usize> = (first..size).collect();
    let mass = equations.mass(state).select(&unknowns, &unknowns);
    let mut cholesky = Cholesky::new(mass.rows);
    if cholesky.factor(&mass.data).is_err() {
        return f64::NAN;
    }
    // A start with a part along every mode, the same every time.
    let mut x: Vec<f64> =
        (0..size).map(|i| if i < first { 0.0 } else { (1.0 + i as f64).sin() }).collect();
    let mut value = 0.0;
    for _ in 0..ITERATIONS {
        let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length == 0.0 || !length.is_finite() {
            return value;
        }
        x.iter_mut().for_each(|x| *x /= length);
        let mut next = vec![0.0; size];
        for (column, x) in stiffness.chunks_exact(size).zip(&x) {
            next.iter_mut().zip(column).for_each(|(sum, k)| *sum += k * x);
        }
        next[..first].fill(0.0);
        cholesky.solve_in_place(&mut next[first..]);
        value = crate::linalg::dot(&next, &x);
        x = next;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::small::machine;
    use crate::linalg::Matrix;
    use crate::machine::{Body, Machine, MachineParts, Rotation};

    /// The small machine without springs and loads.
    fn without_springs(rotation: Rotation) -> Machine {
        let mut machine = machine(rotation);
        assert!(machine.springs.count() > 0);
        let motion = machine.motion;
        let bodies = machine.bodies;
        machine = Machine::new(MachineParts {
            bodies,
            motion,
            clearance: &whirl_specs::CLEARANCES[0],
            laws: Vec::new(),
            bearings: Vec::new(),
            loads: Vec::new(),
        })
        .expect("no springs");
        assert!(machine.springs.count() == 0);
        machine
    }

    /// Whichever coordinate of a shaft or of its support is the stiff one: they move apart from each other.
    #[test]
    fn the_largest_eigenvalue_is_found_wherever_it_is() {
        for rotation in [Rotation::Free, Rotation::Held] {
            for stiff in 0..4 {
                let mut machine = without_springs(rotation.clone());
                let [Body::Turning { shaft, .. }, Body::Standing { support, .. }] =
                    machine.bodies.as_mut_slice()
                else {
                    panic!("a shaft on a support")
                };
                let value = |place: usize| if place == stiff { 3e4 } else { 2e3 };
                shaft.mass = Matrix::from_diagonal(&[2.0, 3.0]);
                shaft.stiffness = Matrix::from_diagonal(&[2.0 * value(0), 3.0 * value(1)]);
                (shaft.g0, shaft.y0) = (vec![0.0; 2], vec![0.0; 2]);
                support.stiffness = vec![value(2), value(3)];
                let state = State::new(machine.size());
                let found = largest_eigenvalue(&mut Equations::new(&machine), 0.0, &state);
                assert!((found / 3e4 - 1.0).abs() < 1e-9, "{rotation:?} {stiff}: {found}");
            }
        }
    }
}
