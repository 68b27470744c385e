//! How many steps contacts last: multipliers of motions with short ones are not to be believed.

use crate::linalg::Matrix;

/// Part of the largest force of all below which a contact is of no account.
const COUNTS: f64 = 1e-3;

/// Steps of the shortest contact of a spring that is free at other times, over a cycle of forces, a column a step.
pub(super) fn fewest(forces: &Matrix) -> Option<usize> {
    let steps = forces.cols;
    let largest = forces.norm_max();
    let mut fewest: Option<usize> = None;
    for spring in 0..forces.rows {
        let acts = |step: usize| forces[(spring, step % steps)] != 0.0;
        let Some(free) = (0..steps).find(|step| !acts(*step)) else { continue };
        let (mut count, mut peak) = (0, 0.0_f64);
        for step in free + 1..=free + steps {
            if acts(step) {
                count += 1;
                peak = peak.max(forces[(spring, step % steps)].abs());
                continue;
            }
            if count > 0 && peak > COUNTS * largest {
                fewest = Some(fewest.map_or(count, |own| own.min(count)));
            }
            (count, peak) = (0, 0.0);
        }
    }
    fewest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_goes_on_over_the_end_of_the_cycle() {
        let rows = [[3.0, 0.0, 0.0, 4.0, 5.0, 1.0], [1.0; 6], [0.0, 1e-4, 0.0, 2.0, 2.0, 0.0]];
        let of = |rows: &[[f64; 6]]| fewest(&Matrix::from_fn(rows.len(), 6, |i, j| rows[i][j]));
        assert_eq!(of(&rows), Some(2));
        assert_eq!(of(&rows[..2]), Some(4));
        assert_eq!(of(&rows[1..2]), None);
    }
}
