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
    let at = |rate: Complex64| -> Vec<Complex64> {
        let entry = |k: usize| {
            let (i, j) = (k % m, k / m);
            let own = if i == j { rate } else { Complex64::ZERO };
            own - states.rates[(i, j)]
        };
        (0..m * m).map(entry).collect()
    };
    let mut matrix = at(Complex64::new(0.0, frequency));
    let nothing = vec![Complex64::ZERO; m];
    if frequency == 0.0 && solve_complex(m, &matrix, &nothing).is_err() {
        matrix = at(Complex64::new(1.0 / LONG, 0.0));
    }
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
