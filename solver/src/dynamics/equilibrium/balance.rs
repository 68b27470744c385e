//! The balance of forces that a start at equilibrium solves, and its derivatives.
//!
//! Unknowns z: η_s of every turning body and x_b of every standing one, in the order of q, then the speeds that are not
//! given. With η = η_s + η_c(θ̇), η̇ = θ̇ L η_s, θ = 0 and x_b at rest the rows are
//! f = Q_e + Q_s − K η_s − C η̇ (bodies that stand: K x_b), and Q_e + Q_s in the rows of θ of speeds that are not given.

use super::turning::{TurningStart, idle_speed};
use crate::bearing::Springs;
use crate::dynamics::newmark::State;
use crate::dynamics::spring_tangent::SpringTangent;
use crate::dynamics::system::{System, instant, placed};
use crate::error::Error;
use crate::linalg::{Columns, Matrix, add_product, multiply};
use crate::loads::{Frame, Load};
use crate::machine::{Body, Machine};

/// Shares at which a row is solved: of its largest term, and of the largest force projected on it (PHYSICS.md, 10).
const OF_TERM: f64 = 1e-6;
const OF_FORCE: f64 = 1e-9;
/// Forces that are not asked for better than to a share of [`OF_FORCE`], where there are none larger (N).
const LEAST_FORCE: f64 = 1.0;
/// Multiples of eps · Σ |terms| that rounding may leave.
const ROUNDING: f64 = 32.0;

/// The machine at t = 0 with the unknowns of its equilibrium.
pub(super) struct Balance<'m> {
    pub(super) machine: &'m Machine,
    pub(super) system: System<'m>,
    pub(super) state: State,
    /// A body each; none for one that stands.
    turning: Vec<Option<TurningStart<'m>>>,
    /// η_c by body, and its derivative by the speed, at `speeds`.
    centrifugal: Vec<[Vec<f64>; 2]>,
    speeds: Vec<f64>,
    /// Places in q of the unknowns, or of the θ whose speed is unknown; they are the places of the rows, too.
    pub(super) places: Vec<usize>,
    /// Where the speeds begin among them.
    pub(super) flexible: usize,
    /// The share of the loads that are fixed in space that acts.
    pub(super) share: f64,
    /// f, a row each, and what it may be.
    pub(super) force: Vec<f64>,
    bound: Vec<f64>,
    tangent: SpringTangent,
}

impl<'m> Balance<'m> {
    /// At rest in the middle. `speeds`: by body, where it turns freely and its speed is given (rad/s).
    pub(super) fn new(machine: &'m Machine, speeds: &[Option<f64>]) -> Result<Self, Error> {
        let (size, rotations) = (machine.size(), machine.rotations());
        let mut state = State::new(size);
        machine.set_given(0.0, false, [&mut state.q, &mut state.v, &mut state.a]);
        state.a.fill(0.0);
        let mut places: Vec<usize> = (rotations..size).collect();
        let flexible = places.len();
        let mut turning = Vec::new();
        for (number, body) in machine.bodies.iter().enumerate() {
            let Body::Turning { shaft, rotation, .. } = body else {
                turning.push(None);
                continue;
            };
            let theta = machine.places()[number].rotation.expect("a body that turns");
            if rotation.given(0.0, false).is_none() {
                match speeds.get(number).copied().flatten() {
                    Some(speed) => state.v[theta] = speed,
                    None => places.push(theta),
                }
            }
            turning.push(Some(TurningStart::new(shaft)?));
        }
        // Between two films a ring turns at about half the speed of what it carries.
        let fastest = state.v[..rotations]
            .iter()
            .fold(0.0, |most: f64, speed| if speed.abs() > most.abs() { *speed } else { most });
        for &theta in &places[flexible..] {
            state.v[theta] = idle_speed(machine, theta).unwrap_or(0.5 * fastest);
        }
        let rows = places.len();
        let mut balance = Balance {
            machine,
            system: System::new(machine),
            state,
            centrifugal: vec![[const { Vec::new() }; 2]; turning.len()],
            speeds: vec![f64::NAN; turning.len()],
            turning,
            places,
            flexible,
            share: 1.0,
            force: vec![0.0; rows],
            bound: vec![0.0; rows],
            tangent: SpringTangent::new(&machine.springs),
        };
        let z = balance.unknowns();
        balance.set(&z)?;
        Ok(balance)
    }

    /// The speed of each body's frame (rad/s); 0 for one that stands.
    pub(super) fn speed(&self, body: usize) -> f64 {
        self.machine.places()[body].rotation.map_or(0.0, |theta| self.state.v[theta])
    }

    /// z at the state.
    pub(super) fn unknowns(&self) -> Vec<f64> {
        let mut z: Vec<f64> =
            self.places[..self.flexible].iter().map(|&place| self.state.q[place]).collect();
        for (place, own) in self.machine.places().iter().zip(&self.centrifugal) {
            let first = place.flexible.start - self.machine.rotations();
            z[first..].iter_mut().zip(&own[0]).for_each(|(sum, turning)| *sum -= turning);
        }
        z.extend(self.places[self.flexible..].iter().map(|&theta| self.state.v[theta]));
        z
    }

    /// Sets the state to z, and computes f there.
    pub(super) fn set(&mut self, z: &[f64]) -> Result<(), Error> {
        for (&theta, speed) in self.places[self.flexible..].iter().zip(&z[self.flexible..]) {
            self.state.v[theta] = *speed;
        }
        let rotations = self.machine.rotations();
        for (number, own) in self.turning.iter().enumerate() {
            let place = self.machine.places()[number].flexible.clone();
            let standing = &z[place.start - rotations..place.end - rotations];
            self.state.q[place.clone()].copy_from_slice(standing);
            let Some(own) = own else {
                self.state.v[place].fill(0.0);
                continue;
            };
            let speed = self.speed(number);
            let turned = own.quarter_turn.apply(standing);
            let rates = self.state.v[place.clone()].iter_mut().zip(turned);
            rates.for_each(|(rate, turned)| *rate = speed * turned);
            if self.speeds[number] != speed {
                self.centrifugal[number] = own.centrifugal(speed)?;
                self.speeds[number] = speed;
            }
            let both = self.state.q[place].iter_mut().zip(&self.centrifugal[number][0]);
            both.for_each(|(sum, turning)| *sum += turning);
        }
        self.evaluate();
        Ok(())
    }

    /// f at the state, and what each row may be.
    fn evaluate(&mut self) {
        let machine = self.machine;
        self.system.evaluate(0.0, &self.state);
        self.loads();
        let system = &mut self.system;
        for (place, (own, centrifugal)) in
            machine.places().iter().zip(self.turning.iter().zip(&self.centrifugal))
        {
            if let Some(own) = own {
                let opposite: Vec<f64> = centrifugal[0].iter().map(|x| -x).collect();
                let elastic = &mut system.elastic[place.flexible.clone()];
                add_product(elastic, &own.shaft.stiffness, &opposite);
            }
        }
        let springs = system.springs.forces.iter().fold(LEAST_FORCE, |most, f| most.max(f.abs()));
        let products = self.products();
        let system = &self.system;
        for (row, &place) in self.places.iter().enumerate() {
            let terms = [
                system.load[place],
                system.spring[place],
                -system.elastic[place],
                -system.damper[place],
            ];
            let is_rotation = row >= self.flexible;
            let terms = if is_rotation { [terms[0], terms[1], 0.0, 0.0] } else { terms };
            self.force[row] = terms.iter().sum();
            let size = |f: fn(f64, f64) -> f64| terms.iter().map(|x| x.abs()).fold(0.0, f);
            let projected = springs * machine.springs.reach[place];
            self.bound[row] = OF_TERM * size(f64::max)
                + OF_FORCE * projected
                + ROUNDING * f64::EPSILON * (size(|a, b| a + b) + projected + products[row]);
        }
    }

    /// Whether a load has ended at the speed at which the machine starts.
    fn released(&self, load: &Load) -> bool {
        let theta = self.machine.places()[load.body].rotation;
        theta.is_some_and(|theta| load.reaches(self.state.v[theta]))
    }

    /// Loads at t = 0: those fixed in space as far as they act, and of those that turn with a body the couple on it.
    fn loads(&mut self) {
        let machine = self.machine;
        self.system.load.fill(0.0);
        let mut turning = vec![0.0; machine.size()];
        for load in &machine.loads {
            let (place, position) = placed(machine, load, &self.state.q);
            let now = instant(machine, 0.0, &self.state);
            let factor = load.factor(&now, self.released(load));
            match load.frame {
                Frame::Space => {
                    let factor = self.share * factor;
                    load.add_force(factor, &position, &self.state.q, place, &mut self.system.load);
                }
                Frame::Body => {
                    load.add_force(factor, &position, &self.state.q, place, &mut turning);
                }
            }
        }
        let rotations = ..machine.rotations();
        add(&mut self.system.load[rotations], &turning[rotations]);
    }

    /// Σ |products| of K η_s and C η̇ of the rows.
    fn products(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.places.len()];
        for (number, own) in self.turning.iter().enumerate() {
            let Some(own) = own else { continue };
            let place = self.machine.places()[number].flexible.clone();
            let first = place.start - self.machine.rotations();
            for (j, at) in place.enumerate() {
                let (moved, rate) = (self.state.q[at].abs(), self.state.v[at].abs());
                let columns = own.shaft.stiffness.col(j).iter().zip(own.shaft.damping.col(j));
                let rows = sums[first..].iter_mut().zip(columns);
                rows.for_each(|(sum, (k, c))| *sum += k.abs() * moved + c.abs() * rate);
            }
        }
        sums
    }

    /// |f| of a row over what it may be.
    pub(super) fn share_of(&self, row: usize) -> f64 {
        let share = self.force[row].abs() / self.bound[row];
        // Nothing of nothing is solved; what is no number is not.
        match self.force[row] == 0.0 {
            true => 0.0,
            false if share.is_nan() => f64::INFINITY,
            false => share,
        }
    }

    /// The largest |f| over what its row may be.
    pub(super) fn worst(&self) -> f64 {
        (0..self.force.len()).map(|row| self.share_of(row)).fold(0.0, f64::max)
    }

    /// −∂f/∂z at the state that was last set, n × n.
    pub(super) fn tangent(&mut self) -> Matrix {
        let (machine, size) = (self.machine, self.machine.size());
        let mut by_position = vec![0.0; size * size];
        let springs: &Springs = &machine.springs;
        self.tangent.subtract(springs, &self.system.springs, 0.0, size, &mut by_position);
        // B + a1 P with a1 = 1 and without it: P.
        let mut by_rate = vec![0.0; size * size];
        self.tangent.subtract(springs, &self.system.springs, 1.0, size, &mut by_rate);
        by_rate.iter_mut().zip(&by_position).for_each(|(both, own)| *both -= own);
        self.subtract_loads(&mut by_position, &mut by_rate);
        let n = self.places.len();
        let mut tangent = Matrix::zeros(n, n);
        for (number, own) in self.turning.iter().enumerate() {
            let place = machine.places()[number].flexible.clone();
            let first = place.start - machine.rotations();
            let Some(own) = own else {
                for (column, at) in place.enumerate() {
                    self.gather(&by_position[at * size..], tangent.col_mut(first + column));
                }
                continue;
            };
            let shaft = own.shaft;
            for (j, at) in place.clone().enumerate() {
                let (k, c) = (shaft.stiffness.col(j), shaft.damping.col(j));
                add(&mut by_position[at * size + place.start..], k);
                add(&mut by_rate[at * size + place.start..], c);
            }
            let columns = |data| Columns { rows: size, cols: place.len(), data };
            let range = place.start * size..place.end * size;
            let turned = multiply(columns(&by_rate[range.clone()]), own.quarter_turn.view());
            let speed = self.speed(number);
            for (j, at) in place.clone().enumerate() {
                let mut column = by_position[at * size..(at + 1) * size].to_vec();
                let rates = column.iter_mut().zip(turned.col(j));
                rates.for_each(|(sum, rate)| *sum += speed * rate);
                self.gather(&column, tangent.col_mut(first + j));
            }
            let theta = machine.places()[number].rotation;
            let unknown = self.places[self.flexible..].iter().position(|&own| Some(own) == theta);
            if let (Some(theta), Some(unknown)) = (theta, unknown) {
                let mut column = by_rate[theta * size..(theta + 1) * size].to_vec();
                self.add_speed_slope(number, own, (&by_position, &turned), &mut column);
                self.gather(&column, tangent.col_mut(self.flexible + unknown));
            }
        }
        for (body, place) in machine.bodies.iter().zip(machine.places()) {
            if let Body::Standing { support, .. } = body {
                for (k, at) in support.stiffness.iter().zip(place.flexible.clone()) {
                    tangent[(at - machine.rotations(), at - machine.rotations())] += k;
                }
            }
        }
        tangent
    }

    /// Subtracts the derivatives of the loads by positions and by rates, as far as the loads act.
    fn subtract_loads(&self, by_position: &mut [f64], by_rate: &mut [f64]) {
        let (machine, size) = (self.machine, self.machine.size());
        let now = instant(machine, 0.0, &self.state);
        let mut parts = [vec![0.0; size * size], vec![0.0; size * size]];
        for load in &machine.loads {
            let (_, position) = placed(machine, load, &self.state.q);
            for (a1, part) in [0.0, 1.0].into_iter().zip(&mut parts) {
                part.fill(0.0);
                load.subtract_tangent(&now, self.released(load), &position, a1, part);
            }
            let (share, rows) = match load.frame {
                Frame::Space => (self.share, 0..size),
                // Only its couple acts.
                Frame::Body => (1.0, 0..machine.rotations()),
            };
            let [position, both] = &parts;
            for place in
                (0..size).flat_map(|column| rows.clone().map(move |row| column * size + row))
            {
                by_position[place] += share * position[place];
                by_rate[place] += share * (both[place] - position[place]);
            }
        }
    }

    /// Adds to a column over q how η̇ = θ̇ L η_s and η_c change with the speed of a body; K acts on η_s alone.
    fn add_speed_slope(
        &self,
        body: usize,
        own: &TurningStart,
        (by_position, turned): (&[f64], &Matrix),
        column: &mut [f64],
    ) {
        let (size, place) = (column.len(), self.machine.places()[body].flexible.clone());
        let [turning, slope] = &self.centrifugal[body];
        let standing = self.state.q[place.clone()].iter().zip(turning).map(|(sum, own)| sum - own);
        let standing: Vec<f64> = standing.collect();
        add(column, &turned.apply(&standing));
        for (j, (at, slope)) in place.clone().zip(slope).enumerate() {
            let both = &by_position[at * size..(at + 1) * size];
            column.iter_mut().zip(both).for_each(|(sum, value)| *sum += slope * value);
            let k = own.shaft.stiffness.col(j);
            column[place.clone()].iter_mut().zip(k).for_each(|(sum, k)| *sum -= slope * k);
        }
    }

    /// The rows of a column over q.
    fn gather(&self, column: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(&self.places).for_each(|(out, &place)| *out = column[place]);
    }

    /// The inertia of each unknown: what its row of M has on the diagonal.
    pub(super) fn inertias(&self) -> Vec<f64> {
        let mut all = vec![1.0; self.machine.size()];
        for (own, place) in self.turning.iter().zip(self.machine.places()) {
            if let (Some(own), Some(theta)) = (own, place.rotation) {
                all[theta] = own.shaft.j0;
                for (j, at) in place.flexible.clone().enumerate() {
                    all[at] = own.shaft.mass[(j, j)];
                }
            }
        }
        self.places.iter().map(|&place| all[place]).collect()
    }

    /// The clearance of each bearing (m).
    pub(super) fn clearances(&self) -> Vec<f64> {
        let planes = &self.machine.springs.planes;
        let first = |planes: &[usize]| planes.first().copied();
        let monitors = self.machine.monitors.iter();
        monitors
            .map(|own| first(&own.planes).map_or(0.0, |place| planes[place].clearance))
            .collect()
    }

    /// Eccentricity over clearance in each bearing, with its name.
    pub(super) fn ratios(&self) -> Vec<(String, Option<f64>)> {
        let eccentricities = self.eccentricities(&self.state.q).into_iter();
        let both = eccentricities.zip(self.clearances()).zip(&self.machine.monitors);
        let ratios = both.map(|(([x, y], clearance), own)| {
            (own.name.clone(), (clearance > 0.0).then(|| x.hypot(y) / clearance))
        });
        ratios.collect()
    }

    /// Eccentricity of the journal in each bearing (m, along x and y), θ being 0.
    pub(super) fn eccentricities(&self, q: &[f64]) -> Vec<[f64; 2]> {
        let monitors = self.machine.monitors.iter().map(|monitor| {
            let [journal, bore] =
                monitor.bodies.map(|body| &q[self.machine.places()[body].flexible.clone()]);
            let [journal, bore] = monitor.displacements(journal, bore);
            [0, 1].map(|axis| {
                journal[axis] + monitor.run_out[axis] + monitor.apart[axis]
                    - bore[axis]
                    - monitor.offset[axis]
            })
        });
        monitors.collect()
    }
}

fn add(sum: &mut [f64], terms: &[f64]) {
    sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
}
