//! Sums over the points of a cell for pairs of basis functions: what kernels of forms call as [`crate::cells`].

#![allow(clippy::needless_range_loop, reason = "indices of parts read as in the formulas")]

use crate::Lane;

/// Σ_q a_iq b_jq at `[i][j]` for the parts i, j of function a and of each function b: with two of them at once a sum waits
/// less for the one before it, and a's values are read once.
#[inline(always)]
pub fn sums<L: Lane, const PARTS: usize, const B: usize>(
    of_a: &[[L; PARTS]],
    of_b: [&[[L; PARTS]]; B],
) -> [[[L; PARTS]; PARTS]; B] {
    let mut sums = [[[L::splat(0.0); PARTS]; PARTS]; B];
    let of_b = of_b.map(|of_b| &of_b[..of_a.len()]);
    for (q, a_q) in of_a.iter().enumerate() {
        for n in 0..B {
            let b_q = of_b[n][q];
            for i in 0..PARTS {
                for j in 0..PARTS {
                    sums[n][i][j] = a_q[i].mul_add(b_q[j], sums[n][i][j]);
                }
            }
        }
    }
    sums
}

/// The same for a function with itself, whose sums are symmetric.
#[inline(always)]
pub fn own_sums<L: Lane, const PARTS: usize>(of_a: &[[L; PARTS]]) -> [[L; PARTS]; PARTS] {
    let mut sums = [[L::splat(0.0); PARTS]; PARTS];
    for a_q in of_a {
        for i in 0..PARTS {
            for j in i..PARTS {
                sums[i][j] = a_q[i].mul_add(a_q[j], sums[i][j]);
            }
        }
    }
    for i in 0..PARTS {
        for j in 0..i {
            sums[i][j] = sums[j][i];
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_products_over_the_points() {
        let (a, b) = ([[1.0, 2.0], [3.0, 4.0]], [[5.0, 6.0], [7.0, 8.0]]);
        let with_b = [[26.0, 30.0], [38.0, 44.0]];
        let with_a = [[10.0, 14.0], [14.0, 20.0]];
        assert_eq!(sums(&a, [&b]), [with_b]);
        assert_eq!(sums(&a, [&b, &a]), [with_b, with_a]);
        assert_eq!(own_sums(&a), with_a);
    }
}
