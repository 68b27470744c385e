//! Modes that the iteration misses are found by their count.

use whirl_solver::linalg::LowerTriangle;
use whirl_solver::reduction::Pencil;

#[test]
fn modes_that_the_iteration_misses_are_searched_for() {
    // Unconnected oscillators, twelve of them alike: a block of eight vectors sees eight of the twelve.
    let n = 400;
    let square = |dof: usize| if dof < 12 { 1.0 } else { dof as f64 };
    let stiffness = LowerTriangle::from_columns(n, |j| std::iter::once((j, square(j))));
    let mass = LowerTriangle::from_columns(n, |j| std::iter::once((j, 1.0)));
    let order: Vec<usize> = (0..n).collect();
    let components: Vec<usize> = order.iter().map(|dof| dof % 3).collect();
    let pencil = Pencil {
        stiffness: &stiffness,
        mass: &mass,
        order: &order,
        components: &components,
        memory: usize::MAX,
    };
    let (modes, _) = pencil.lowest_modes(15).expect("modes");
    assert_eq!(modes.eigenvalues.len(), 15);
    for (k, value) in modes.eigenvalues.iter().enumerate() {
        // Converged to 1e-10 of θ, and far from their neighbours.
        assert!((value / square(k) - 1.0).abs() < 1e-10, "{:?}", modes.eigenvalues);
    }
}
