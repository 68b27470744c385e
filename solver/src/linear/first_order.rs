//! States of laws in the equations of small motions.
//!
//! They are coordinates without mass: ṡ = A s + B z + D ż, with the forces P s beside M′z̈ + C′ż + K′z, in which they stand still.
//! At a frequency ω they come to −P (iω − A)⁻¹ (B + iωD) beside K′ + iωC′.

use num_complex::Complex64;

use crate::bearing::LONG;
use crate::linalg::{FirstOrder, Matrix, solve_complex};

/// Adds what states do at a frequency (rad/s) to C′ and K′; at rest, where they follow at once, to K′ alone. Those that only
/// integrate let nothing stand but where their rates are zero: they are as stiff as after a [`LONG`] time.
pub(super) fn add(
    states: &FirstOrder,
    frequency: f64,
    damping: &mut Matrix,
    stiffness: &mut Matrix,
) {
    let (m, n) = (states.rates.rows, states.forces.rows);
    let matrix = against(states, frequency);
    for j in 0..n {
        let column: Vec<Complex64> = (0..m)
            .map(|i| Complex64::new(states.by_position[(i, j)], frequency * states.by_rate[(i, j)]))
            .collect();
        if column.iter().all(|own| *own == Complex64::ZERO) {
            continue;
        }
        let moved = solve_complex(m, &matrix, &column)
            .unwrap_or_else(|_| vec![Complex64::new(f64::NAN, f64::NAN); m]);
        for i in 0..n {
            let sum: Complex64 = (0..m).map(|k| states.forces[(i, k)] * moved[k]).sum();
            stiffness[(i, j)] -= sum.re;
            if frequency != 0.0 {
                damping[(i, j)] -= sum.im / frequency;
            }
        }
    }
}

/// iω − A; at rest, where states only integrate, as after a [`LONG`] time.
fn against(states: &FirstOrder, frequency: f64) -> Vec<Complex64> {
    let m = states.rates.rows;
    let at = |rate: Complex64| -> Vec<Complex64> {
        let entry = |k: usize| {
            let (i, j) = (k % m, k / m);
            let own = if i == j { rate } else { Complex64::ZERO };
            own - states.rates[(i, j)]
        };
        (0..m * m).map(entry).collect()
    };
    let matrix = at(Complex64::new(0.0, frequency));
    let nothing = vec![Complex64::ZERO; m];
    match frequency == 0.0 && solve_complex(m, &matrix, &nothing).is_err() {
        true => at(Complex64::new(1.0 / LONG, 0.0)),
        false => matrix,
    }
}

/// The forces of states by rates g that something else gives them at a frequency (rad/s): P (iω − A)⁻¹ g.
pub(super) fn driven(states: &FirstOrder, frequency: f64, rates: &[Complex64]) -> Vec<Complex64> {
    let (m, n) = (states.rates.rows, states.forces.rows);
    let moved = solve_complex(m, &against(states, frequency), rates)
        .unwrap_or_else(|_| vec![Complex64::new(f64::NAN, f64::NAN); m]);
    (0..n).map(|i| (0..m).map(|k| states.forces[(i, k)] * moved[k]).sum()).collect()
}
