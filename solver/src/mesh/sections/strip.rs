//! Cells of a half plane between the radii of two planes: quadrilaterals, and triangles where one side has more of them.

/// What a triangle costs beside a lean of one.
const TRIANGLE: f64 = 1.0;

/// A cell by places of radii in the left and in the right plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flat {
    /// From the inner to the outer radius on both sides.
    Quadrilateral { left: [usize; 2], right: [usize; 2] },
    /// With an edge on the left.
    OnLeft { left: [usize; 2], right: usize },
    /// With an edge on the right.
    OnRight { left: usize, right: [usize; 2] },
}

/// Cells between radii of a left and a right plane, both ascending, which are `apart`, from the inside outwards: those whose
/// edges lean least, with few triangles. On an axis (radius 0 on both sides) stands a quadrilateral.
pub(super) fn cells(left: &[f64], right: &[f64], apart: f64) -> Vec<Flat> {
    let (m, n) = (left.len(), right.len());
    let axis = m > 1 && n > 1 && left[0] == 0.0 && right[0] == 0.0;
    let lean = |i: usize, j: usize| ((left[i] - right[j]) / apart).powi(2);
    // The least cost of all up to an edge from i to j, and whether radii on the left and on the right advance to it.
    let mut best = vec![(f64::INFINITY, [false; 2]); m * n];
    best[0].0 = lean(0, 0);
    for i in 0..m {
        for j in 0..n {
            for step in [[true, true], [true, false], [false, true]] {
                let [before_i, before_j] =
                    [i.checked_sub(step[0].into()), j.checked_sub(step[1].into())];
                let (Some(a), Some(b)) = (before_i, before_j) else { continue };
                let triangle = step != [true; 2];
                if axis && triangle && (a == 0 && b == 0 || i == 0 || j == 0) {
                    continue;
                }
                let cost = best[a * n + b].0 + lean(i, j) + if triangle { TRIANGLE } else { 0.0 };
                if cost < best[i * n + j].0 {
                    best[i * n + j] = (cost, step);
                }
            }
        }
    }
    let (mut i, mut j) = (m - 1, n - 1);
    let mut found = Vec::with_capacity(m + n);
    while (i, j) != (0, 0) {
        let step = best[i * n + j].1;
        let cell = match step {
            [true, true] => Flat::Quadrilateral { left: [i - 1, i], right: [j - 1, j] },
            [true, false] => Flat::OnLeft { left: [i - 1, i], right: j },
            _ => Flat::OnRight { left: i, right: [j - 1, j] },
        };
        found.push(cell);
        i -= usize::from(step[0]);
        j -= usize::from(step[1]);
    }
    found.reverse();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_radii_are_joined_by_quadrilaterals() {
        let radii = [0.0, 1.0, 2.0];
        let all = cells(&radii, &radii, 1.0);
        let own = |k: usize| Flat::Quadrilateral { left: [k, k + 1], right: [k, k + 1] };
        assert_eq!(all, [own(0), own(1)]);
    }

    #[test]
    fn where_one_side_has_more_radii_stand_triangles_off_the_axis() {
        let all = cells(&[0.0, 5.0], &[0.0, 2.0, 4.0, 5.0], 1.0);
        assert!(matches!(all[0], Flat::Quadrilateral { .. }));
        let triangles = all.iter().filter(|own| matches!(own, Flat::OnRight { .. })).count();
        assert_eq!((all.len(), triangles), (3, 2));
        // A layer that runs out to nothing.
        assert_eq!(cells(&[1.0], &[1.0, 2.0], 1.0), [Flat::OnRight { left: 0, right: [0, 1] }]);
    }
}
