//! The equations of a machine over a cycle: residuals of all instants, as harmonics, and their derivative.

use super::series::Series;
use crate::equations::{Equations, State, Tangents};
use crate::linalg::{Matrix, multiply};
use crate::machine::Machine;
use crate::periodic::cycle::Cycle;
use crate::periodic::in_space::InSpace;

/// A machine at the instants of a cycle.
pub(super) struct Balance<'m> {
    equations: Equations<'m>,
    state: State,
    start: f64,
    period: f64,
    /// Mean speeds of rotations that are unknown (rad/s), by their places among the unknowns.
    speeds: Vec<f64>,
    /// How coordinates of bodies that turn are seen.
    space: InSpace,
}

/// −∂r/∂q̈, −∂r/∂q̇ and −∂r/∂q at all instants: their means, and by what they differ there.
pub(super) struct Derivative {
    pub(super) means: [Matrix; 3],
    /// By order of the derivative: of each instant, nothing where all are alike.
    beside: [Vec<Matrix>; 3],
}

impl<'m> Balance<'m> {
    /// Of a machine over a cycle, with the mean speeds of rotations that are unknown (rad/s).
    pub(super) fn new(
        machine: &'m Machine,
        cycle: Cycle,
        (speeds, space): (Vec<f64>, InSpace),
    ) -> Balance<'m> {
        let mut state = State::new(machine.size());
        machine.set_given(cycle.start, false, [&mut state.q, &mut state.v, &mut state.a]);
        let mut equations = Equations::new(machine);
        // Drives that end at a speed have ended where the body has it.
        let theta = |body: usize| machine.places()[body].rotation;
        let ended = machine
            .loads
            .iter()
            .map(|load| theta(load.body).is_some_and(|theta| load.reaches(state.v[theta])));
        equations.released = ended.collect();
        Balance { equations, state, start: cycle.start, period: cycle.period, speeds, space }
    }

    /// Takes another length of the cycle (s).
    pub(super) fn set_period(&mut self, period: f64) {
        self.period = period;
    }

    fn machine(&self) -> &'m Machine {
        self.equations.machine
    }

    /// Puts z and its rates at a share of the cycle into the state; gives the time (s).
    fn place(&mut self, seen: [&[f64]; 3], share: f64) -> f64 {
        let (machine, first) = (self.machine(), self.machine().first_unknown());
        let since = share * self.period;
        let time = self.start + since;
        let State { q: to_q, v: to_v, a: to_a, .. } = &mut self.state;
        for (to, from) in [&mut *to_q, &mut *to_v, &mut *to_a].into_iter().zip(seen) {
            to[first..].copy_from_slice(from);
        }
        let all = [&mut *to_q, &mut *to_v, &mut *to_a].map(|all| &mut all[first..]);
        self.space.to_bodies(all, since);
        for (place, speed) in self.speeds.iter().enumerate() {
            to_q[first + place] += speed * since;
            to_v[first + place] += speed;
        }
        machine.set_given(time, false, [to_q, to_v, to_a]);
        time
    }

    /// Evaluates the machine there; gives the time (s).
    fn evaluate(&mut self, seen: [&[f64]; 3], share: f64) -> f64 {
        let time = self.place(seen, share);
        self.equations.evaluate(time, &self.state);
        time
    }

    /// The residual of what was evaluated last, of forces on z.
    fn own_residual(&self, share: f64) -> Vec<f64> {
        let mut own = self.equations.residual[self.machine().first_unknown()..].to_vec();
        self.space.forces(&mut own, share * self.period);
        own
    }

    /// q and q̇ of the unknowns at the start of the cycle.
    pub(super) fn at_start(&mut self, series: &Series, coefficients: &Matrix) -> Vec<f64> {
        let samples = series.sampled(coefficients);
        self.place(samples.each_ref().map(|own| own.col(0)), 0.0);
        let first = self.machine().first_unknown();
        [&self.state.q[first..], &self.state.v[first..]].concat()
    }

    /// Harmonics of the residual.
    pub(super) fn residual(&mut self, series: &Series, coefficients: &Matrix) -> Matrix {
        self.sampled(series, coefficients, |own, share| own.own_residual(share))
    }

    /// The same, with what it changes by.
    pub(super) fn linearised(
        &mut self,
        series: &Series,
        coefficients: &Matrix,
    ) -> (Matrix, Derivative) {
        let n = coefficients.rows;
        let mut all: [Vec<Matrix>; 3] = Default::default();
        let residual = self.sampled(series, coefficients, |own, share| {
            let Tangents { mass, damping, stiffness, .. } = own.equations.tangents(&own.state);
            let seen = own.space.tangents([mass, damping, stiffness], share * own.period);
            all.iter_mut().zip(seen).for_each(|(all, own)| all.push(own));
            own.own_residual(share)
        });
        let means = all.each_ref().map(|all| {
            let mut mean = Matrix::zeros(n, n);
            let share = 1.0 / all.len() as f64;
            for own in all {
                mean.data.iter_mut().zip(&own.data).for_each(|(sum, own)| *sum += share * own);
            }
            mean
        });
        for (all, mean) in all.iter_mut().zip(&means) {
            let least = f64::EPSILON * mean.norm_max();
            let mut varies = false;
            for own in all.iter_mut() {
                own.data.iter_mut().zip(&mean.data).for_each(|(own, mean)| *own -= mean);
                varies |= own.norm_max() > 8.0 * least;
            }
            if !varies {
                all.clear();
            }
        }
        (residual, Derivative { means, beside: all })
    }

    /// Harmonics of what is found at every instant, by its share of the cycle.
    fn sampled(
        &mut self,
        series: &Series,
        coefficients: &Matrix,
        mut of: impl FnMut(&mut Self, f64) -> Vec<f64>,
    ) -> Matrix {
        let samples = series.sampled(coefficients);
        let instants = series.instants();
        let mut found = Vec::with_capacity(instants * coefficients.rows);
        for j in 0..instants {
            let share = j as f64 / instants as f64;
            self.evaluate(samples.each_ref().map(|own| own.col(j)), share);
            found.extend(of(self, share));
        }
        series.coefficients(&Matrix { rows: coefficients.rows, cols: instants, data: found })
    }

    /// What a history has of the motion at the ends of so many steps of the cycle, one row a step.
    pub(super) fn rows(
        &mut self,
        coefficients: &Matrix,
        steps: usize,
        mut take: impl FnMut(&mut Equations, &State, f64),
    ) {
        let harmonics = coefficients.cols / 2;
        let samples = Series::new(self.period, harmonics, steps).sampled(coefficients);
        for step in 1..=steps {
            let own = samples.each_ref().map(|own| own.col(step % steps));
            let time = self.evaluate(own, step as f64 / steps as f64);
            take(&mut self.equations, &self.state, time);
        }
    }
}

impl Derivative {
    /// Harmonics of what −∂r comes to as all frequencies grow by a share of themselves, over that share.
    pub(super) fn by_frequency(&self, series: &Series, coefficients: &Matrix) -> Matrix {
        let [_, v, a] = series.sampled(coefficients);
        let twice = Matrix { data: a.data.iter().map(|own| 2.0 * own).collect(), ..a };
        let still = Matrix::zeros(v.rows, v.cols);
        self.of_samples(series, [&twice, &v, &still])
    }

    /// Harmonics of what −∂r comes to by a change of the coefficients.
    pub(super) fn apply(&self, series: &Series, change: &Matrix) -> Matrix {
        let [q, v, a] = series.sampled(change);
        self.of_samples(series, [&a, &v, &q])
    }

    /// The same of samples in the order of the derivatives.
    fn of_samples(&self, series: &Series, moved: [&Matrix; 3]) -> Matrix {
        let mut sum = Matrix::zeros(moved[0].rows, series.instants());
        for ((mean, beside), moved) in self.means.iter().zip(&self.beside).zip(moved) {
            let whole = multiply(mean.view(), moved.view());
            sum.data.iter_mut().zip(&whole.data).for_each(|(sum, own)| *sum += own);
            for (j, own) in beside.iter().enumerate() {
                let part = own.apply(moved.col(j));
                sum.col_mut(j).iter_mut().zip(part).for_each(|(sum, own)| *sum += own);
            }
        }
        series.coefficients(&sum)
    }
}
