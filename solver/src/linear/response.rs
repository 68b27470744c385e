//! Response to unbalance: circles that forces turning with a body make of the state that stands.

use num_complex::Complex64;

use super::linearised::{Linearised, Standstill};
use super::modes::Orbit;
use super::round::LinearMachine;
use crate::error::Error;
use crate::linalg::{dot, solve_complex};
use crate::output::{Motion, Wanted};

/// Share of the inertia of a body below which its unbalance is rounding.
const ROUNDING: f64 = 1e-10;

/// A point whose motion is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Its name, as the tables of a case have it: `joint.NAME` or `output.NAME`.
    pub name: String,
    /// Rows over the coordinates of bodies: motion along x and y of space.
    rows: Vec<(usize, [Vec<f64>; 2])>,
}

/// How a point moves: Re(w e^{iωt}).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Complex amplitudes along x and y (m).
    pub amplitudes: [Complex64; 2],
}

impl Vibration {
    /// Its ellipse (m).
    pub fn orbit(&self) -> Orbit {
        Orbit::new(self.amplitudes)
    }
}

impl LinearMachine {
    /// The points that can be watched: journals in their bores, then the displacements that the machine puts out.
    pub fn points(&self) -> Vec<Point> {
        let joints = self.machine.monitors.iter().map(|joint| {
            let minus = joint.bore.each_ref().map(|row| row.iter().map(|own| -own).collect());
            let rows = vec![(joint.bodies[0], joint.journal.clone()), (joint.bodies[1], minus)];
            let label = joint.label.trim_start_matches('_');
            Point { name: format!("joint.{label}"), rows }
        });
        let outputs = self.machine.outputs.iter().filter_map(|output| match &output.what {
            Wanted::Motion { body, point, motion: Motion::Displacement, .. } => {
                let row = |axis: usize| {
                    (0..point.shapes.cols).map(|j| point.shapes[(axis, j)]).collect::<Vec<f64>>()
                };
                let rows = vec![(*body, [row(0), row(1)])];
                Some(Point { name: format!("output.{}", output.name), rows })
            }
            _ => None,
        });
        joints.chain(outputs).collect()
    }

    /// Bodies that have unbalance, by their places.
    pub fn unbalanced(&self) -> impl Iterator<Item = usize> {
        self.turning().filter(|&body| self.unbalance(body).iter().any(|own| *own != 0.0))
    }

    /// What turns with a body of its y0: −(Sᵀ)² y0. What is so small beside its inertia, √(J0 Y_jj), is rounding of its mesh.
    fn unbalance(&self, body: usize) -> Vec<f64> {
        let (Some(shaft), Some([_, square])) =
            (self.still.bodies[body].shaft(), &self.generators[body])
        else {
            return Vec::new();
        };
        let bound = |j: usize| ROUNDING * (shaft.j0 * shaft.spin_inertia[(j, j)]).sqrt();
        let turns = square.apply_transpose(&shaft.y0).into_iter().enumerate();
        turns.map(|(j, own)| if own.abs() <= bound(j) { 0.0 } else { -own }).collect()
    }

    /// X = (K′ + iωC′ − ω²M′)⁻¹ f of the unbalance of a body at its speed ω = Ω, f = Ω² (y + iSᵀy), by points. Phases count from
    /// the angle θ = 0 of the body.
    ///
    /// # Errors
    /// A matrix that is singular: a critical speed without damping.
    pub fn unbalance_response(
        &self,
        (at, equations): (&Standstill, &Linearised),
        body: usize,
        points: &[Point],
    ) -> Result<Vec<Vibration>, Error> {
        let Linearised { mass, damping, stiffness, .. } = equations;
        let omega = at.speeds[body];
        let n = mass.rows;
        let force = self.unbalance_force(at, body);
        let entry = |m: f64, c: f64, k: f64| Complex64::new(k - omega * omega * m, omega * c);
        let entries = mass.data.iter().zip(&damping.data).zip(&stiffness.data);
        let matrix: Vec<Complex64> = entries.map(|((m, c), k)| entry(*m, *c, *k)).collect();
        let moved = solve_complex(n, &matrix, &force)?;
        let of = |point: &Point| {
            let amplitudes = self
                .rows(at, point)
                .map(|row| row.iter().zip(&moved).map(|(row, own)| row * own).sum::<Complex64>());
            Vibration { amplitudes }
        };
        Ok(points.iter().map(of).collect())
    }

    /// f over the coordinates of [`Linearised`].
    pub(super) fn unbalance_force(&self, at: &Standstill, body: usize) -> Vec<Complex64> {
        let mut force = vec![Complex64::ZERO; self.kept(at).len()];
        let load = self.unbalance(body);
        let Some([once, _]) = &self.generators[body] else { return force };
        let square = at.speeds[body] * at.speeds[body];
        let across = once.apply_transpose(&load);
        let own = self.block(at.angles.len(), body);
        for (own, (along, across)) in force[own].iter_mut().zip(load.iter().zip(&across)) {
            *own = square * Complex64::new(*along, *across);
        }
        force
    }

    /// Motion of a point along x and y of space by a unit of each coordinate of [`Linearised`]. An angle turns the displacement
    /// in which its body stands.
    pub(super) fn rows(&self, at: &Standstill, point: &Point) -> [Vec<f64>; 2] {
        let mut all = [0, 1].map(|_| vec![0.0; self.kept(at).len()]);
        for (body, rows) in &point.rows {
            let place = &self.machine.places()[*body];
            let block = self.block(at.angles.len(), *body);
            for (all, row) in all.iter_mut().zip(rows) {
                all[block.clone()].iter_mut().zip(row).for_each(|(sum, own)| *sum += own);
            }
            let angle = at.angles.iter().position(|own| Some(*own) == place.rotation);
            if let Some(angle) = angle {
                let stands = &at.found.state.q[place.flexible.clone()];
                let [x, y] = rows.each_ref().map(|row| dot(row, stands));
                all[0][angle] -= y;
                all[1][angle] += x;
            }
        }
        all
    }
}
