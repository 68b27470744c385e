//! Undamped critical speeds over the stiffness of the supports.
//!
//! With all joints springs of one stiffness k along x and y, and no damping, motions of frequency Ω seen from space solve
//! K x = Ω² N x, N = M − iG − L, where C′ = ΩG and K′ = K + Ω²L without them: one Hermitian problem for all speeds. Forward and
//! backward ones are told apart by their sense.

use num_complex::Complex64;

use super::frame::Seen;
use super::modes::Mode;
use super::round::LinearMachine;
use super::shapes::{apply, inner};
use super::torsion::Way;
use super::track::{mac, matched};
use crate::bodies::Body;
use crate::equations::{Equations, State, Tangents, Weights};
use crate::error::Error;
use crate::linalg::{Cholesky, Matrix, congruence, hermitian_eigen};

/// MAC from which on a motion is one of the stiffness before.
const ALIKE: f64 = 0.2;

/// A speed at which an undamped motion goes round with the rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct Undamped {
    /// The motion; Im λ is the speed of the body whose speeds they are (rad/s).
    pub mode: Mode,
    /// Which way it moves.
    pub way: Way,
    /// Its number among the motions that are followed from stiffness to stiffness, from 0.
    pub branch: usize,
}

impl Undamped {
    /// rad/s.
    pub fn speed(&self) -> f64 {
        self.mode.value.im
    }
}

/// The machine without its joints and without damping.
pub struct Unsupported {
    /// K and N.
    stiffness: Matrix,
    inertia: Vec<Complex64>,
    /// M.
    mass: Matrix,
    /// Rows of what joints measure along x and y, over all coordinates.
    rows: Vec<Vec<f64>>,
}

impl LinearMachine {
    /// What joints do beside holding their journals along x and y, and not in such a machine, in words.
    pub fn left_out_of_map(&self) -> Vec<String> {
        let joints = self.machine.monitors.iter();
        let words = joints.flat_map(|joint| {
            let acts = [
                (joint.tilts.is_some(), "against tilting"),
                (joint.along.is_some(), "along the axis"),
                (joint.torque, "about the axis"),
            ];
            let acts = acts.into_iter().filter(|own| own.0);
            acts.map(|(_, how)| format!("{} {how}", joint.name))
        });
        words.collect()
    }

    /// The machine without its joints at speeds in the ratios of `speeds`, one body at 1 rad/s and the bodies that are found at
    /// rest; its joints held by nothing.
    pub fn unsupported(&self, speeds: &[Option<f64>]) -> Unsupported {
        // So fast that what goes by the square of the speed is no rounding.
        const FAST: f64 = 1e3;
        let mut machine = self.machine.clone();
        for body in &mut machine.bodies {
            match body {
                Body::Turning { shaft, .. } => shaft.damping.data.fill(0.0),
                Body::Standing { support, .. } => support.damping.fill(0.0),
            }
        }
        let released = vec![true; machine.loads.len()];
        let tangents = |factor: f64| -> (Vec<f64>, [Matrix; 3]) {
            let mut state = State::new(machine.size());
            let mut own = vec![0.0; machine.bodies.len()];
            for (body, place) in machine.places().iter().enumerate() {
                let speed = speeds.get(body).copied().flatten().unwrap_or(0.0) * factor;
                if let Some(theta) = place.rotation {
                    (state.v[theta], own[body]) = (speed, speed);
                }
            }
            let mut equations = Equations::new(&machine);
            equations.release(&released);
            equations.evaluate(0.0, &state);
            let size = machine.size();
            let mut of = |weights: Weights| {
                let mut data = vec![0.0; size * size];
                equations.tangent_of_bodies(0.0, &state, weights, &mut data);
                Matrix { rows: size, cols: size, data }
            };
            let stiffness = of(Weights::POSITION);
            let less = |own: Matrix| {
                let data = own.data.iter().zip(&stiffness.data).map(|(a, b)| a - b).collect();
                Matrix { data, ..own }
            };
            let damping = less(of(Weights { rate: 1.0, acceleration: 0.0 }));
            let mass = less(of(Weights { rate: 0.0, acceleration: 1.0 }));
            (own, [mass, damping, stiffness])
        };
        let at = |factor: f64| -> [Matrix; 3] {
            let (speeds, [mass, damping, stiffness]) = tangents(factor);
            let first = self.machine.first_unknown();
            let unknown: Vec<usize> = (first..self.machine.size()).collect();
            let [mass, damping, stiffness] =
                [mass, damping, stiffness].map(|own| own.select(&unknown, &unknown));
            let tangents = Tangents { mass, damping, stiffness, planes: Vec::new() };
            let seen: Vec<Option<Seen>> = (0..self.machine.bodies.len())
                .map(|body| {
                    let [once, twice] = self.generators[body].as_ref()?;
                    let turns = speeds[body] != 0.0;
                    turns.then_some(Seen {
                        generators: [once, twice],
                        angle: 0.0,
                        rate: speeds[body],
                    })
                })
                .collect();
            self.in_frame((&[], &tangents), &seen)
        };
        let ([mass, _, stiffness], [_, gyroscopic, turned]) = (at(0.0), at(FAST));
        let entries = (0..mass.data.len()).map(|k| {
            let by_square = (turned.data[k] - stiffness.data[k]) / (FAST * FAST);
            Complex64::new(mass.data[k] - by_square, -gyroscopic.data[k] / FAST)
        });
        let inertia = entries.collect();
        let joints = self.machine.monitors.iter();
        let rows = joints
            .flat_map(|joint| joint.rows().over(mass.rows, |body| self.block(0, body), |_| None));
        Unsupported { stiffness: stiffness.symmetric_part(), inertia, rows: rows.collect(), mass }
    }

    /// The slowest undamped critical speeds with all joints springs of a stiffness (N/m) along x and y, for each of several that
    /// follow each other, up to the first before which it was asked to end.
    ///
    /// # Errors
    /// Joints that do not hold the machine.
    pub fn undamped(
        &self,
        machine: &Unsupported,
        stiffness: &[f64],
        count: usize,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Vec<Vec<Undamped>>, Error> {
        let mut all: Vec<Vec<Undamped>> = Vec::with_capacity(stiffness.len());
        let mut branches = 0;
        for &value in stiffness.iter().take_while(|_| goes_on()) {
            let modes = self.undamped_at(machine, value, count)?;
            let mut of = vec![None; modes.len()];
            if let Some(before) = all.last() {
                let from: Vec<Mode> = before.iter().map(|own| own.mode.clone()).collect();
                let to = matched(&machine.mass, &from, &modes).to;
                for (own, place) in before.iter().zip(to) {
                    // Where one leaves the list as another comes into it, these are two.
                    let is_one = |place: &usize| {
                        let moved = apply(&machine.mass, &own.mode.shape);
                        mac(&moved, &modes[*place].shape) > ALIKE
                    };
                    if let Some(place) = place.filter(is_one) {
                        of[place] = Some(own.branch);
                    }
                }
            }
            let own = modes.into_iter().zip(of).map(|(mode, branch)| {
                let branch = branch.unwrap_or_else(|| {
                    branches += 1;
                    branches - 1
                });
                Ok(Undamped { way: self.way(&[], &machine.mass, &mode)?, mode, branch })
            });
            all.push(own.collect::<Result<_, Error>>()?);
        }
        Ok(all)
    }

    /// Those at one stiffness, slowest first.
    fn undamped_at(
        &self,
        machine: &Unsupported,
        stiffness: f64,
        count: usize,
    ) -> Result<Vec<Mode>, Error> {
        let n = machine.mass.rows;
        let mut whole = machine.stiffness.clone();
        for row in &machine.rows {
            for j in (0..n).filter(|&j| row[j] != 0.0) {
                let weight = stiffness * row[j];
                whole.col_mut(j).iter_mut().zip(row).for_each(|(sum, own)| *sum += weight * own);
            }
        }
        let mut factor = Cholesky::new(n);
        factor.factor(&whole.data)?;
        // L⁻ᵀ of K = LLᵀ: the eigenvalues of L⁻¹ N L⁻ᵀ are 1/Ω².
        let mut back = Matrix::identity(n);
        factor.solve_upper_in_place(&mut back.data);
        let part = |of: fn(&Complex64) -> f64| {
            let own = machine.inertia.iter().map(of).collect();
            let own = Matrix { rows: n, cols: n, data: own };
            congruence(&own, &back)
        };
        let (re, im) = (part(|own| own.re), part(|own| own.im));
        let entries = re.data.iter().zip(&im.data).map(|(re, im)| Complex64::new(*re, *im));
        let (values, vectors) = hermitian_eigen(n, &entries.collect::<Vec<_>>())?;
        let found = (0..n).rev().filter(|&k| values[k] > 0.0).take(count).map(|k| {
            let mut shape = apply(&back, &vectors[k * n..(k + 1) * n]);
            let size = inner(&shape, &apply(&machine.mass, &shape)).re.sqrt();
            shape.iter_mut().for_each(|own| *own /= size);
            let sense = inner(&apply(&machine.mass, &shape), &self.turned(0, &shape)).re;
            let value = Complex64::new(0.0, 1.0 / values[k].sqrt());
            Mode { value, shape, sense, shares: Vec::new(), beside: Vec::new() }
        });
        Ok(found.collect())
    }
}
