//! The tangent of the balance.

use super::memory::Memory;
use super::{Balance, add};
use crate::bearing::Springs;
use crate::dynamics::starts::equilibrium::rotations::Turn;
use crate::equations::{State, TurningBody, instant, placed};
use crate::linalg::{Columns, Matrix, multiply};
use crate::loads::Frame;
use crate::machine::Body;

impl Balance<'_> {
    /// −∂f/∂z at the state that was last set, n × n.
    pub(in crate::dynamics::starts::equilibrium) fn tangent(&mut self) -> Matrix {
        let (machine, size) = (self.machine, self.machine.size());
        let springs: &Springs = &machine.springs;
        let mut memory = std::mem::take(&mut self.memory);
        let [by_position, by_rate] = memory.cleared(size);
        self.tangent.subtract(springs, &self.equations.springs, 0.0, size, by_position);
        // B + a1 P with a1 = 1 and without it: P.
        self.tangent.subtract(springs, &self.equations.springs, 1.0, size, by_rate);
        by_rate.iter_mut().zip(&*by_position).for_each(|(both, own)| *both -= own);
        self.subtract_loads(&mut memory);
        let Memory { by_position, by_rate, .. } = &mut memory;
        let n = self.places.len();
        let mut tangent = Matrix::zeros(n, n);
        // ∂f/∂θ̇ of every body, by its place.
        let mut by_speed = vec![Vec::new(); self.turning.len()];
        let mut number_of_turning = 0;
        for (number, own) in self.turning.iter().enumerate() {
            let place = machine.places()[number].flexible.clone();
            let first = place.start - machine.rotations();
            let Some(own) = own else {
                for (column, at) in place.enumerate() {
                    self.gather(&by_position[at * size..], tangent.col_mut(first + column));
                }
                continue;
            };
            let theta = machine.places()[number].rotation.expect("a body that turns");
            let shaft = own.shaft;
            let inertia = own.half_turn.as_ref().map(|half_turn| {
                let body = &mut self.equations.turning[number_of_turning];
                Inertia::new(body, half_turn, [&self.standing, &self.turned])
            });
            number_of_turning += 1;
            // Of joints and loads alone, as η_c sees them.
            let joints = by_position[place.start * size..place.end * size].to_vec();
            for (j, at) in place.clone().enumerate() {
                let (k, c) = (shaft.stiffness.col(j), shaft.damping.col(j));
                add(&mut by_position[at * size + place.start..], k);
                add(&mut by_rate[at * size + place.start..], c);
                if let Some(inertia) = &inertia {
                    add(&mut by_position[at * size + place.start..], inertia.by_position.col(j));
                    add(&mut by_rate[at * size + place.start..], inertia.by_rate.col(j));
                }
            }
            let columns = |data| Columns { rows: size, cols: place.len(), data };
            let range = place.start * size..place.end * size;
            let turned = multiply(columns(&by_rate[range]), own.quarter_turn.view());
            let pace = self.pace(number);
            for (j, at) in place.clone().enumerate() {
                let mut column = by_position[at * size..(at + 1) * size].to_vec();
                let rates = column.iter_mut().zip(turned.col(j));
                rates.for_each(|(sum, rate)| *sum += pace * rate);
                if let Some(inertia) = &inertia {
                    let rates = column[place.clone()].iter_mut().zip(inertia.twice.col(j));
                    rates.for_each(|(sum, rate)| *sum += pace * pace * rate);
                }
                self.gather(&column, tangent.col_mut(first + j));
            }
            let mut column = by_rate[theta * size..(theta + 1) * size].to_vec();
            self.add_speed_slope(number, (&joints, &turned), inertia.as_ref(), &mut column);
            by_speed[number] = column;
        }
        for (unknown, own) in self.rotations.iter().enumerate() {
            let mut column = vec![0.0; size];
            let of = |theta: &usize| {
                machine.places().iter().position(|place| place.rotation == Some(*theta))
            };
            match own {
                Turn::Speed(places) => {
                    for (theta, ratio) in places {
                        let Some(body) = of(theta) else { continue };
                        let own = column.iter_mut().zip(&by_speed[body]);
                        own.for_each(|(sum, value)| *sum += ratio * value);
                    }
                }
                Turn::Angle(theta) => {
                    add(&mut column, &by_position[theta * size..(theta + 1) * size]);
                }
                Turn::Acceleration(places) => {
                    for &(theta, ratio) in places {
                        column[theta] = ratio * self.own_inertia(theta);
                        let Some(body) = of(&theta) else { continue };
                        let place = machine.places()[body].flexible.clone();
                        let own = column[place].iter_mut().zip(&self.twisting[body]);
                        own.for_each(|(to, value)| *to = ratio * value);
                    }
                }
            }
            self.gather(&column, tangent.col_mut(self.flexible + unknown));
        }
        for (body, place) in machine.bodies.iter().zip(machine.places()) {
            if let Body::Standing { support, .. } = body {
                for (k, at) in support.stiffness.iter().zip(place.flexible.clone()) {
                    tangent[(at - machine.rotations(), at - machine.rotations())] += k;
                }
            }
        }
        for row in (self.flexible..n).filter(|row| self.holds(*row)) {
            (0..n).for_each(|column| tangent[(row, column)] = f64::from(u8::from(row == column)));
        }
        self.memory = memory;
        tangent
    }

    /// Subtracts the derivatives of the loads by positions and by rates, as far as the loads act: by the angles, and of the
    /// couples.
    fn subtract_loads(&self, memory: &mut Memory) {
        let (machine, size) = (self.machine, self.machine.size());
        let rotations = machine.rotations();
        let now = instant(machine, 0.0, &self.state);
        let Memory { by_position, by_rate, load } = memory;
        for own in &machine.loads {
            let (_, position) = placed(machine, own, &self.state.q);
            let share = if own.frame == Frame::Space { self.share } else { 1.0 };
            for (amplitude, last) in self.parts(own) {
                for (a1, part) in [0.0, 1.0].into_iter().zip(load.iter_mut()) {
                    let released = self.machine.ends(own, &self.state.v);
                    own.subtract_tangent(&amplitude, &now, released, &position, a1, part);
                }
                let [position, both] = &mut *load;
                for column in 0..size {
                    let rows = if column < rotations { size } else { rotations };
                    for row in 0..rows {
                        let place = column * size + row;
                        let [position, both] =
                            [&mut *position, &mut *both].map(|own| std::mem::take(&mut own[place]));
                        if row < last {
                            by_position[place] += share * position;
                            by_rate[place] += share * (both - position);
                        }
                    }
                }
            }
        }
    }

    /// Adds to a column over q how η̇ = θ̇ L η_s, η̈ and η_c change with the speed of a body, and its inertia with that;
    /// `joints`: −∂(Q_e + Q_s)/∂η, a column a coordinate.
    fn add_speed_slope(
        &self,
        body: usize,
        (joints, turned): (&[f64], &Matrix),
        inertia: Option<&Inertia>,
        column: &mut [f64],
    ) {
        let (size, place) = (column.len(), self.machine.places()[body].flexible.clone());
        let standing = &self.standing.q[place.clone()];
        add(column, &turned.apply(standing));
        for (both, slope) in joints.chunks_exact(size).zip(&self.centrifugal[body][1]) {
            column.iter_mut().zip(both).for_each(|(sum, value)| *sum += slope * value);
        }
        if let Some(inertia) = inertia {
            let twice = inertia.twice.apply(standing);
            let both = twice.iter().zip(&inertia.by_speed);
            let rows = column[place].iter_mut().zip(both);
            let speed = self.speed(body);
            rows.for_each(|(sum, (twice, own))| *sum += 2.0 * speed * twice + own);
        }
    }

    /// The rows of a column over q. The couple on a body that turns freely speeds it up, and with it what it carries.
    fn gather(&self, column: &[f64], out: &mut [f64]) {
        let mut column = column.to_vec();
        for &(body, theta) in &self.accelerated {
            let Some(own) = &self.turning[body] else { continue };
            let slope = column[theta] / own.shaft.j0;
            let rows = column[self.machine.places()[body].flexible.clone()].iter_mut();
            rows.zip(&self.twisting[body]).for_each(|(sum, g0)| *sum -= slope * g0);
        }
        out.iter_mut().zip(&self.places).for_each(|(out, &place)| *out = column[place]);
    }
}

/// Minus the derivatives of the inertia of η_s.
struct Inertia {
    by_position: Matrix,
    by_rate: Matrix,
    /// By η̈, times L².
    twice: Matrix,
    /// By θ̇.
    by_speed: Vec<f64>,
}

impl Inertia {
    /// `standing`, `turned`: a state with η_s, and one that only turns.
    fn new(body: &mut TurningBody, half_turn: &Matrix, [standing, turned]: [&State; 2]) -> Inertia {
        let n = half_turn.rows;
        let of = |whole: &Matrix| Matrix::from_fn(n, n, |i, j| whole[(1 + i, 1 + j)]);
        let less = |whole: &Matrix, less: &Matrix| {
            let data = whole.data.iter().zip(&less.data).map(|(own, less)| own - less);
            Matrix { data: data.collect(), ..*whole }
        };
        let parts = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let [still, by_rate, by_acceleration] =
            parts.map(|own| body.inertia_tangent(standing, own));
        let [alone, alone_by_rate, _] = parts.map(|own| body.inertia_tangent(turned, own));
        let (by_rate, by_acceleration) = (less(&by_rate, &still), less(&by_acceleration, &still));
        let by_speed = less(&by_rate, &less(&alone_by_rate, &alone));
        Inertia {
            by_position: of(&still),
            twice: multiply(of(&by_acceleration).view(), half_turn.view()),
            by_speed: by_speed.col(0)[1..].to_vec(),
            by_rate: of(&by_rate),
        }
    }
}
