//! Modes that the iteration misses are found by their count.

use whirl_solver::linalg::LowerTriangle;
use whirl_solver::reduction::{Constraints, Pencil};

#[test]
fn modes_that_the_iteration_misses_are_searched_for() {
    // Unconnected oscillators, twelve each with ω² = 1, 2 and 3, the others close together and far above: four
    // blocks of eight vectors hold eight of each twelve to rounding, and whatever converges ends the iteration.
    let n = 400;
    let square = |dof: usize| match dof {
        0..36 => (1 + dof / 12) as f64,
        _ => 1e6 * (1.0 + 1e-5 * dof as f64 / n as f64),
    };
    let stiffness = LowerTriangle::from_columns(n, |j| std::iter::once((j, square(j))));
    let mass = LowerTriangle::from_columns(n, |j| std::iter::once((j, 1.0)));
    let order: Vec<usize> = (0..n).collect();
    let components: Vec<usize> = order.iter().map(|dof| dof % 3).collect();
    let pencil = Pencil {
        stiffness: &stiffness,
        mass: &mass,
        order: &order,
        constraints: Constraints::NONE,
        components: &components,
        memory: usize::MAX,
        columns: 0,
    };
    let (modes, _) = pencil.lowest_modes(15).expect("modes");
    assert_eq!(modes.eigenvalues.len(), 15);
    for (k, value) in modes.eigenvalues.iter().enumerate() {
        // Pairs converge to 1e-10 of θ, their values to the square of that.
        assert!((value / square(k) - 1.0).abs() < 1e-10, "{:?}", modes.eigenvalues);
    }
}
