//! A rigid journal in its bore: the film as forces and moments over displacement, tilts, their rates and the speed.

use std::f64::consts::TAU;

use whirl_specs::Clearance;

use super::balance::Balance;
use super::heat::Heated;
use super::oil::Oil;
use super::openings::{OilFilm, WrongFilm};
use super::reaction::{Gradients, INPUTS, JournalMotion, OUTPUTS, Reaction, arms};
use super::solve::Unsolved;

/// Sides to which a journal is displaced to see whether its film ever has a pressure.
const DIRECTIONS: u32 = 6;

/// Place of the gap among the measures of a clearance.
const GAP: usize = 0;

/// How far a bore may turn about its axis (rad): gaps are those of a small turn.
pub const TIPPED: f64 = 0.05;

/// A journal in a bore with a film between them.
#[derive(Debug, Clone)]
pub struct Journal {
    /// The film.
    pub film: OilFilm,
    /// Of every force, by place of a node around: slopes of its measure by e_x, e_y and the turn.
    gradients: Gradients,
    /// Which of the forces push the surfaces apart.
    pub(super) pushes: Vec<bool>,
    /// Slopes of the gap, with which they begin.
    pub(super) gap: Vec<[f64; 3]>,
    /// Gap of every node where the journal is centred (m).
    centred: Vec<f64>,
    /// Mean speed of both surfaces by the speed of the journal (m).
    pub(super) speed: f64,
    /// Its heat, if it has a temperature.
    pub(super) heated: Option<Heated>,
}

impl Journal {
    /// A journal with a radial clearance (m) in the bore of a film.
    ///
    /// # Errors
    /// A clearance that is not above zero; a film whose forces work on what the clearance's spec has not.
    pub fn new(
        film: OilFilm,
        kernels: &'static Clearance,
        clearance: f64,
    ) -> Result<Self, WrongFilm> {
        if !(clearance > 0.0) {
            let help = "give the radial clearance: radius of the bore less that of the journal";
            return Err(WrongFilm {
                what: "a film needs a clearance above zero".to_owned(),
                help: help.to_owned(),
            });
        }
        let grid = &film.grid;
        let mut out = vec![0.0; kernels.measures.len()];
        let mut at = vec![0.0; kernels.coordinates];
        let last = at.len() - 1;
        at[last] = grid.radius;
        // Measures are linear in the displacement, and in the turn where there is none.
        let mut slopes_of = |measure: usize| -> Vec<[f64; 3]> {
            let around = (0..grid.around).map(|i| {
                at[0] = grid.angle(i);
                [2, 3, 1].map(|coordinate| {
                    let value = |at: &[f64], out: &mut [f64]| {
                        (kernels.measure)(at, out);
                        out[measure]
                    };
                    let before = value(&at, &mut out);
                    at[coordinate] = 1.0;
                    let after = value(&at, &mut out);
                    at[coordinate] = 0.0;
                    after - before
                })
            });
            around.collect()
        };
        let place = |name: &str| match kernels.measures.iter().position(|own| *own == name) {
            Some(place) => Ok(place),
            None => Err(WrongFilm {
                what: format!("the clearance `{}` has no measure `{name}`", kernels.origin.name),
                help: format!("it has {}", kernels.measures.join(", ")),
            }),
        };
        let mut gradients = Gradients::new();
        let mut pushes = Vec::with_capacity(film.kernel.forces.len());
        for force in film.kernel.forces {
            let measure = place(force.on)?;
            pushes.push(measure == GAP);
            gradients.push(slopes_of(measure));
        }
        let gap = slopes_of(GAP);
        let slip = slopes_of(place("s")?);
        let centred = vec![clearance; grid.nodes()];
        let speed = slip[0][2] / 2.0;
        Ok(Journal { gradients, pushes, gap, centred, speed, heated: None, film })
    }

    /// Adds to the gap of every node: a bore that is not round, or steps and pockets in it (m). From angle and z.
    pub fn shape(&mut self, profile: impl Fn(f64, f64) -> f64) {
        let grid = &self.film.grid;
        for j in 0..grid.along {
            for i in 0..grid.around {
                self.centred[j * grid.around + i] += profile(grid.angle(i), grid.z(j));
            }
        }
    }

    /// By how much displacements and tilts of the journal open the gap at the i-th node around in the j-th row.
    pub fn opening(&self, i: usize, j: usize) -> [f64; 4] {
        let [x, y, about_x, about_y, ..] = arms(self.gap[i], self.film.grid.z(j));
        [x, y, about_x, about_y]
    }

    /// The smallest and the largest gap at a node where the journal is in the middle (m).
    pub fn gaps(&self) -> [f64; 2] {
        let all = || self.centred.iter().copied();
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The largest pressure in a steady film whose journal turns out of the middle, to any side; none where it has no solution that
    /// is a number.
    pub fn pressure(&self) -> Option<f64> {
        let mut balance = Balance::new(&self.film);
        let [gap, _] = self.gaps();
        let mut outputs = vec![0.0; self.film.outputs()];
        for direction in 0..DIRECTIONS {
            let (sin, cos) = (TAU * f64::from(direction) / f64::from(DIRECTIONS)).sin_cos();
            let displacement = [0.5 * gap * cos, 0.5 * gap * sin];
            let motion = JournalMotion { displacement, omega: 1.0, ..JournalMotion::default() };
            let mut oil = Oil::full(&self.film);
            self.settle(&motion, &mut oil, &mut balance).ok()?;
            if !self.forces(&mut balance, &mut outputs).iter().all(|own| own.is_finite()) {
                return None;
            }
            let most = oil.unknowns[0].iter().copied().fold(0.0, f64::max);
            if most > 0.0 {
                return Some(most);
            }
        }
        Some(0.0)
    }

    /// Puts gaps and speeds to the nodes. The number of nodes whose gap changes so fast within a step that they hold oil by the
    /// gap itself: by more than itself.
    pub fn place(&self, motion: &JournalMotion, balance: &mut Balance) -> usize {
        let grid = &self.film.grid;
        let own = &mut balance.motion;
        own.speed = self.speed * motion.omega;
        own.per_step = motion.step.map_or(0.0, f64::recip);
        let half = motion.step.map_or(0.0, |step| 0.5 * step);
        let mut fast = 0;
        for j in 0..grid.along {
            let z = grid.z(j);
            let section = |[x, y]: [f64; 2], [a, b]: [f64; 2]| [x + z * b, y - z * a];
            let [x, y] = section(motion.displacement, motion.tilt);
            let [vx, vy] = section(motion.velocity, motion.tilting);
            for (i, [gx, gy, _]) in self.gap.iter().enumerate() {
                let a = j * grid.around + i;
                let mut gap = self.centred[a] + gx * x + gy * y;
                let mut rate = gx * vx + gy * vy;
                if let Some([opened, opening]) = &own.deformed {
                    gap += opened[a];
                    rate += opening[a];
                }
                let shift = half * rate;
                let slow = shift.abs() <= 0.5 * gap;
                fast += usize::from(!slow);
                own.gap[a] = gap;
                own.shifted[a] = slow;
                own.stored_gap[a] = if slow { gap + shift } else { gap };
                own.squeeze[a] = if motion.step.is_none() { rate } else { 0.0 };
            }
        }
        fast
    }

    /// Solves the film where `motion` says, from the state given on. The number of changes.
    ///
    /// # Errors
    /// A balance that is not reached.
    pub fn settle(
        &self,
        motion: &JournalMotion,
        oil: &mut Oil,
        balance: &mut Balance,
    ) -> Result<usize, Unsolved> {
        self.place(motion, balance);
        balance.solve(&self.film, oil)
    }

    /// Takes the film as it is where `motion` says.
    pub fn take(&self, motion: &JournalMotion, oil: &Oil, balance: &mut Balance) {
        self.place(motion, balance);
        balance.evaluate(&self.film, oil);
    }

    /// Takes what nodes hold of a film at the beginning of a step, as its end will count it.
    pub fn begin(&self, motion: &JournalMotion, oil: &Oil, balance: &mut Balance) {
        self.take(motion, oil, balance);
        let Balance { before, stored, .. } = balance;
        let nodes = before.len();
        before.copy_from_slice(&stored[..nodes]);
    }

    /// What a film does to its journal as it was last solved or taken; `outputs` are the integrals of the film's spec.
    pub fn forces(&self, balance: &mut Balance, outputs: &mut [f64]) -> [f64; OUTPUTS] {
        balance.forces(&self.film, &self.gradients, outputs)
    }

    /// Slopes of the forces by displacements, tilts, their rates and the speed, after [`Journal::forces`]; of a step of this
    /// length (s), or of a steady film.
    pub fn slopes(
        &self,
        step: Option<f64>,
        oil: &Oil,
        balance: &mut Balance,
    ) -> [[f64; INPUTS]; OUTPUTS] {
        let by_speed = balance.slopes(&self.film, oil, &self.gradients);
        let mut slopes = [[0.0; INPUTS]; OUTPUTS];
        let grid = &self.film.grid;
        let half = step.map(|step| 0.5 * step);
        for j in 0..grid.along {
            for i in 0..grid.around {
                let a = j * grid.around + i;
                let own = &balance.motion;
                // The turn does not change the gap.
                let gradient = self.opening(i, j);
                let shifted = own.shifted[a];
                let [by_gap, by_stored] = [balance.by_node[0][a], balance.by_node[1][a]];
                for n in 0..OUTPUTS {
                    let (value, rate) = match half {
                        Some(half) => (by_gap[n] + by_stored[n], half * by_stored[n]),
                        None => (by_gap[n], by_stored[n]),
                    };
                    for (q, g) in gradient.iter().enumerate() {
                        slopes[n][q] += value * g;
                        slopes[n][4 + q] += if shifted { rate * g } else { 0.0 };
                    }
                }
            }
        }
        for n in 0..OUTPUTS {
            slopes[n][INPUTS - 1] = by_speed[n] * self.speed;
        }
        slopes
    }

    /// All of that.
    ///
    /// # Errors
    /// A balance that is not reached.
    pub fn react(
        &self,
        motion: &JournalMotion,
        oil: &mut Oil,
        balance: &mut Balance,
        outputs: &mut [f64],
    ) -> Result<Reaction, Unsolved> {
        self.settle(motion, oil, balance)?;
        let forces = self.forces(balance, outputs);
        Ok(Reaction { forces, slopes: self.slopes(motion.step, oil, balance) })
    }
}
