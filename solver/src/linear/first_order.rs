//! States of laws in the equations of small motions.
//!
//! They are coordinates without mass: ṡ = A s + B z + D ż, with the forces P s beside M′z̈ + C′ż + K′z, in which they stand still.
//! At a frequency ω they come to −P (iω − A)⁻¹ (B + iωD) beside K′ + iωC′.

use num_complex::Complex64;

use crate::linalg::{FirstOrder, Matrix, solve_complex};

/// Adds what states do at a frequency (rad/s) to C′ and K′; at rest, where they follow at once, to K′ alone. No numbers where a motion
/// of that frequency does not determine them, such as an integral of a constant.
pub(super) fn add(
    states: &FirstOrder,
    frequency: f64,
    damping: &mut Matrix,
    stiffness: &mut Matrix,
) {
    let (m, n) = (states.rates.rows, states.forces.rows);
    let matrix: Vec<Complex64> = (0..m * m)
        .map(|k| {
            let (i, j) = (k % m, k / m);
            let own = if i == j { Complex64::new(0.0, frequency) } else { Complex64::ZERO };
            own - states.rates[(i, j)]
        })
        .collect();
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
