//! What the rounding of the machine's coordinates leaves in the generalised forces of its springs.
//!
//! A measure is a sum Σ c q of coordinates that may be large while it is small itself: the angle between two shafts that have
//! turned a thousand times, the distance of two bodies that have gone far. No iteration can make it smaller than
//! ε Σ |c q|, nor a force smaller than that times its slope.

use whirl_specs::{BoreMotion, ContactTangent};

use super::plane::Plane;
use super::springs::Springs;
use super::state::{SpringState, TurnedRows};
use crate::linalg::largest_and_sum;

/// Memory for what forces would change by if the terms of their measures were none, coordinate by coordinate.
pub(crate) struct SpringRounding {
    /// Derivatives of a plane by positions, and with those by rates added.
    by_position: Vec<ContactTangent>,
    by_both: Vec<ContactTangent>,
    turned: TurnedRows,
    /// Generalised forces (N, N·m), one a coordinate.
    pub(crate) forces: Vec<f64>,
}

/// Sizes of the terms of the three measures of a ring, or of a motion of its bore at a spring: positions and rates.
type Sizes = [f64; 2];

impl SpringRounding {
    /// Memory for springs of a machine of so many coordinates.
    pub(crate) fn new(springs: &Springs, size: usize) -> Self {
        let tangent = |plane: &Plane| {
            ContactTangent::new(plane.springs.len(), springs.laws[plane.law].motions.len())
        };
        let tangents = || springs.planes.iter().map(tangent).collect();
        SpringRounding {
            by_position: tangents(),
            by_both: tangents(),
            turned: TurnedRows::default(),
            forces: vec![0.0; size],
        }
    }

    /// Fills [`SpringRounding::forces`] at a state at which the springs were just updated.
    pub(crate) fn take(&mut self, springs: &Springs, state: &mut SpringState, [q, v]: [&[f64]; 2]) {
        state.slope_films(springs);
        self.forces.fill(0.0);
        for (place, plane) in springs.planes.iter().enumerate() {
            let (first, both) = (&mut self.by_position[place], &mut self.by_both[place]);
            state.tangent(springs, place, 0.0, first, &mut self.turned);
            state.tangent(springs, place, 1.0, both, &mut self.turned);
            let change = |a: f64, b: f64, sizes: Sizes| {
                let part =
                    |slope: f64, size: f64| if size == 0.0 { 0.0 } else { slope.abs() * size };
                part(a, sizes[0]) + part(b - a, sizes[1])
            };
            let rows = state.rows(place);
            let mut ring = rows.each_ref().map(|row| [along_sizes(row, q), along_sizes(row, v)]);
            let still = constant_sizes(plane, state.planes[place].apart.value);
            ring[1..].iter_mut().zip(still).for_each(|(own, still)| own[0] += still);
            let law = &springs.laws[plane.law];
            let bores = &springs.bores[law.bores];
            let (motions, n, start) = (law.motions.len(), plane.springs.len(), plane.springs.start);
            let bore = |motion: usize, j: usize| -> Option<(usize, Sizes)> {
                let row = law.motions[motion]? + start + j;
                let coefficients = bores.transposed.col(row);
                let sizes = [q, v].map(|x| {
                    let given = bores.given.iter().filter(|own| own.0 == row);
                    let given: f64 = given.map(|&(_, place, own)| (own * x[place]).abs()).sum();
                    let x = &x[bores.place.clone()];
                    largest_and_sum(x.len(), |k| coefficients[k] * x[k]).1 + given
                });
                let offset = bores.offset.as_ref().map_or(0.0, |all| all[row].abs());
                Some((row, [sizes[0] + offset, sizes[1]]))
            };
            let bores_moved: Vec<Option<(usize, Sizes)>> =
                (0..motions * n).map(|k| bore(k / n, k % n)).collect();
            // The moment of a film is a sum of pressures on both sides of its middle.
            let pressed = law.bound.law.film().map_or(0.0, |journal| {
                let own = &state.laws[plane.law].forces;
                let [x, y] = [0, 1].map(|axis| own[law.bound.forces[axis] * law.springs + start]);
                0.5 * journal.film.grid.length * x.hypot(y)
            });
            let mut on_ring = [0.0; 3];
            for (i, sum) in on_ring.iter_mut().enumerate() {
                for (k, sizes) in ring.iter().enumerate() {
                    *sum += change(first.ring_ring[i][k], both.ring_ring[i][k], *sizes);
                }
            }
            for b in 0..motions {
                for j in 0..n {
                    let Some((row, sizes)) = bores_moved[b * n + j] else { continue };
                    for (i, sum) in on_ring.iter_mut().enumerate() {
                        let at = (i * motions + b) * n + j;
                        *sum += change(first.ring_bore[at], both.ring_bore[at], sizes);
                    }
                    let mut on_bore = match law.bound.kind.bore.get(b) {
                        Some(own) if tilts(own) => pressed,
                        _ => 0.0,
                    };
                    for (k, sizes) in ring.iter().enumerate() {
                        let at = (3 * b + k) * n + j;
                        on_bore += change(first.bore_ring[at], both.bore_ring[at], *sizes);
                    }
                    for other in 0..motions {
                        let at = (b * motions + other) * n + j;
                        let slopes = [first.bore_bore[at], both.bore_bore[at]];
                        if slopes != [0.0; 2] {
                            let moved = bores_moved[other * n + j];
                            let sizes = moved.map_or([0.0; 2], |(_, sizes)| sizes);
                            on_bore += change(slopes[0], slopes[1], sizes);
                        }
                    }
                    let places = bores.place.clone().zip(bores.transposed.col(row));
                    places.for_each(|(k, part)| self.forces[k] += part.abs() * on_bore);
                }
            }
            for (row, force) in rows.iter().zip(on_ring) {
                row.iter().for_each(|&(k, part)| self.forces[k] += part.abs() * force);
            }
        }
    }
}

/// Whether a motion is a tilt of a section, through which a moment acts.
fn tilts(motion: &BoreMotion) -> bool {
    use BoreMotion::{MeanTiltX, MeanTiltY, SectionTiltX, SectionTiltY};
    matches!(motion, MeanTiltX | MeanTiltY | SectionTiltX | SectionTiltY)
}

/// Σ |coefficient · x|.
fn along_sizes(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|&(j, coefficient)| (coefficient * x[j]).abs()).sum()
}

/// Sizes of what in ε_x and ε_y does not come from coordinates (m): clearance, run-out, and axes that are apart.
fn constant_sizes(plane: &Plane, apart: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|axis| plane.clearance.abs() + plane.run_out[axis].abs() + apart[axis].abs())
}
