//! The balance of forces that a start at equilibrium solves, and its derivatives.
//!
//! Unknowns z: η_s of every turning body and x_b of every standing one, in the order of q, then what is unknown of the
//! rotations (`rotations`). With η = η_s + η_c(θ̇), η̇ = ω̃ L η_s, η̈ = ω̃² L² η_s and x_b at rest the rows are
//! f = Q_e + Q_s − G0 θ̈ − K η_s − C η̇ (bodies that stand: K x_b), of a round body with Q_v − M q̈ of η_s, and Q_e + Q_s − J0 θ̈ in the
//! rows of θ. ω̃ is θ̇, or what the steps of the march make of it.

mod loads;
mod memory;
mod tangent;

use self::memory::Memory;
use super::rotations::{Rotations, Turn, Twisting};
use super::turning::TurningStart;
use crate::equations::{Equations, SpringTangent, State, frame_of};
use crate::error::Error;
use crate::linalg::{add_product, dot, multiply};
use crate::machine::{Body, Machine};
use crate::monitor::Turned;
use crate::shaft::Shaft;

/// Shares at which a row is solved: of its largest term, and of the largest force projected on it (PHYSICS.md, 10).
const OF_TERM: f64 = 1e-6;
const OF_FORCE: f64 = 1e-9;
/// Forces that are not asked for better than to a share of [`OF_FORCE`], where there are none larger (N).
const LEAST_FORCE: f64 = 1.0;
/// A couple (N·m) that is none: a drag by the square of a speed never gets to zero.
const NO_COUPLE: f64 = 1e-15;
/// Rounding of a row over the largest force of a spring from which on it stands nowhere: its forces cancel only as it has moved far away.
const GONE: f64 = 1e-4;
/// A coordinate (m, rad, or m √kg of a mode) that is farther than any machine moves.
const FAR: f64 = 1e3;
/// Multiples of eps · Σ |terms| that rounding may leave, where terms are also those of the measures of springs.
const ROUNDING: f64 = 32.0;

/// The machine at t = 0 with the unknowns of its equilibrium.
pub(super) struct Balance<'m> {
    pub(super) machine: &'m Machine,
    pub(super) equations: Equations<'m>,
    pub(super) state: State,
    /// A body each; none for one that stands.
    turning: Vec<Option<TurningStart<'m>>>,
    /// η_c by body, and its derivative by the speed, at `speeds`.
    centrifugal: Vec<[Vec<f64>; 2]>,
    speeds: Vec<f64>,
    /// η_s with its rates, and nothing but the speeds.
    standing: State,
    turned: State,
    /// Q_v − M q̈ of η_s, of bodies that are round.
    inertia: Vec<f64>,
    /// Places in q of the rows: those of the unknowns, then those of θ for what is unknown of the rotations.
    pub(super) places: Vec<usize>,
    /// Where the rotations begin among them.
    pub(super) flexible: usize,
    pub(super) rotations: Vec<Turn>,
    /// Bodies that turn freely by themselves at a given speed, with θ, as their couples accelerate them.
    accelerated: Vec<(usize, usize)>,
    /// By body what θ̈ takes of the coordinates that do not turn against space, as twists: G0 without unbalance.
    twisting: Vec<Vec<f64>>,
    /// Δt (s) of equal steps by the trapezoidal rule.
    step: Option<f64>,
    /// Whether unknown speeds stay as they are, their rows left out.
    pub(super) held: bool,
    /// The share of the loads that are fixed in space that acts.
    pub(super) share: f64,
    /// Σ |loads| of every coordinate: they may balance each other.
    load_sizes: Vec<f64>,
    /// f, a row each, and what it may be.
    pub(super) force: Vec<f64>,
    bound: Vec<f64>,
    /// Rows with terms so large that their rounding comes near the forces.
    pub(super) gone: Vec<usize>,
    /// What a force anywhere on its body comes to in each row.
    shares: Vec<f64>,
    tangent: SpringTangent,
    memory: Memory,
}

impl<'m> Balance<'m> {
    /// At rest in the middle, as a march starts. `speeds`: by body, where it turns freely and its speed is given (rad/s).
    pub(super) fn new(
        machine: &'m Machine,
        speeds: &[Option<f64>],
        step: Option<f64>,
    ) -> Result<Self, Error> {
        let turning = |_, shaft: &'m Shaft, speed: f64| TurningStart::new(shaft, speed);
        Balance::of(machine, speeds, (step, true), at_rest(machine), &turning)
    }

    /// The same at speeds that stay: `speeds` are also those of bodies whose rotation is given, and couples that would speed up a
    /// body at a given speed are carried by what drives it. `turning`: a body at a speed.
    pub(super) fn steady(
        machine: &'m Machine,
        speeds: &[Option<f64>],
        turning: &dyn Fn(usize) -> TurningStart<'m>,
    ) -> Result<Self, Error> {
        let mut state = at_rest(machine);
        for (place, speed) in machine.places().iter().zip(speeds) {
            if let (Some(theta), Some(speed)) = (place.rotation, speed) {
                (state.v[theta], state.a[theta]) = (*speed, 0.0);
            }
        }
        let turning = |body: usize, _: &'m Shaft, _: f64| Ok(turning(body));
        Balance::of(machine, speeds, (None, false), state, &turning)
    }

    /// At a state with the rotations that are given. `accelerates`: whether couples speed up bodies at given speeds.
    fn of(
        machine: &'m Machine,
        speeds: &[Option<f64>],
        (step, accelerates): (Option<f64>, bool),
        mut state: State,
        turning: &dyn Fn(usize, &'m Shaft, f64) -> Result<TurningStart<'m>, Error>,
    ) -> Result<Self, Error> {
        let (size, first) = (machine.size(), machine.rotations());
        let mut equations = Equations::new(machine);
        let mut tangent = SpringTangent::new(&machine.springs);
        let twisting = twisting(machine, &mut equations, &mut tangent, &state);
        let Rotations { rows, unknowns } = Rotations::new(machine, speeds, &twisting, &mut state);
        let mut places: Vec<usize> = (first..size).collect();
        let flexible = places.len();
        places.extend(rows);
        let accelerated = (0..machine.bodies.len()).filter_map(|body| {
            let theta = machine.places()[body].rotation?;
            let is_free = machine.bodies[body].rotation()?.given(0.0, false).is_none();
            (accelerates && is_free && !places.contains(&theta)).then_some((body, theta))
        });
        let accelerated = accelerated.collect();
        let bodies = machine.bodies.iter().zip(machine.places()).enumerate();
        let turning = bodies.map(|(number, (body, place))| {
            let Body::Turning { shaft, .. } = body else { return Ok(None) };
            let theta = place.rotation.expect("a body that turns");
            turning(number, shaft, state.v[theta]).map(Some)
        });
        let turning: Vec<Option<TurningStart>> = turning.collect::<Result<_, Error>>()?;
        let twisted = turning.iter().map(|own| own.as_ref().map_or(Vec::new(), twisted));
        let (rows, twisting) = (places.len(), twisted.collect());
        let mut balance = Balance {
            machine,
            equations,
            centrifugal: vec![[const { Vec::new() }; 2]; turning.len()],
            speeds: vec![f64::NAN; turning.len()],
            standing: State::new(size),
            turned: State::new(size),
            inertia: vec![0.0; size],
            turning,
            places,
            flexible,
            rotations: unknowns,
            accelerated,
            twisting,
            step,
            held: false,
            share: 1.0,
            load_sizes: vec![0.0; size],
            force: vec![0.0; rows],
            bound: vec![0.0; rows],
            gone: Vec::new(),
            shares: vec![0.0; rows],
            tangent,
            memory: Memory::default(),
            state,
        };
        balance.shares = balance.shares();
        let z = balance.unknowns();
        balance.set(&z)?;
        Ok(balance)
    }

    /// The states of laws where they were evaluated last.
    pub(super) fn states(&self) -> Vec<f64> {
        let mut laws = self.state.laws.clone();
        self.equations.springs.keep_states(&mut laws);
        laws.known
    }

    /// The speed of each body's frame (rad/s); 0 for one that stands.
    pub(super) fn speed(&self, body: usize) -> f64 {
        self.machine.places()[body].rotation.map_or(0.0, |theta| self.state.v[theta])
    }

    /// ω̃ of a body: its speed, or that whose rates the steps of the march give to what turns at its speed, where that is
    /// told and stays.
    fn pace(&self, body: usize) -> f64 {
        let speed = self.speed(body);
        let rotation = self.machine.bodies[body].rotation();
        let stays = rotation.and_then(|own| own.given(0.0, false)).is_some_and(|own| own[2] == 0.0);
        match self.step {
            // Longer steps turn it about as far as a sixth of a revolution.
            Some(step) if stays && (speed * step).abs() < 1.0 => {
                let half = 0.5 * speed * step;
                if half == 0.0 { speed } else { speed * half.tan() / half }
            }
            _ => speed,
        }
    }

    /// z at the state.
    pub(super) fn unknowns(&self) -> Vec<f64> {
        let mut z: Vec<f64> =
            self.places[..self.flexible].iter().map(|&place| self.state.q[place]).collect();
        for (place, own) in self.machine.places().iter().zip(&self.centrifugal) {
            let first = place.flexible.start - self.machine.rotations();
            z[first..].iter_mut().zip(&own[0]).for_each(|(sum, turning)| *sum -= turning);
        }
        z.extend(self.rotations.iter().map(|own| own.value(&self.state)));
        z
    }

    /// Sets the state to z, and computes f there.
    pub(super) fn set(&mut self, z: &[f64]) -> Result<(), Error> {
        for (own, &value) in self.rotations.iter().zip(&z[self.flexible..]) {
            own.set(value, &mut self.state);
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
            let (speed, pace) = (self.speed(number), self.pace(number));
            let turned = own.quarter_turn.apply(standing);
            let rates = self.state.v[place.clone()].iter_mut().zip(turned);
            rates.for_each(|(rate, turned)| *rate = pace * turned);
            if let Some(half_turn) = &own.half_turn {
                let turned = half_turn.apply(standing);
                let rates = self.state.a[place.clone()].iter_mut().zip(turned);
                rates.for_each(|(rate, turned)| *rate = pace * pace * turned);
            }
            self.standing.q[place.clone()].copy_from_slice(standing);
            if self.speeds[number] != speed {
                self.centrifugal[number] = own.centrifugal(speed)?;
                self.speeds[number] = speed;
            }
            let both = self.state.q[place].iter_mut().zip(&self.centrifugal[number][0]);
            both.for_each(|(sum, turning)| *sum += turning);
        }
        let theta = ..rotations;
        for part in [&mut self.standing, &mut self.turned] {
            part.v[theta].copy_from_slice(&self.state.v[theta]);
        }
        self.standing.v[rotations..].copy_from_slice(&self.state.v[rotations..]);
        self.standing.a[rotations..].copy_from_slice(&self.state.a[rotations..]);
        self.evaluate();
        Ok(())
    }

    /// Q_v − M q̈ of η_s: what it adds to that of a body which only turns.
    fn stand(&mut self) {
        let numbers = (0..self.turning.len()).filter(|&body| self.turning[body].is_some());
        for (own, body) in self.equations.turning.iter_mut().zip(numbers) {
            let place = self.machine.places()[body].flexible.clone();
            if self.turning[body].as_ref().is_none_or(|own| own.half_turn.is_none()) {
                self.inertia[place].fill(0.0);
                continue;
            }
            self.inertia[place.clone()].copy_from_slice(&own.inertia(&self.standing)[1..]);
            let turned = own.inertia(&self.turned)[1..].iter();
            self.inertia[place].iter_mut().zip(turned).for_each(|(own, turned)| *own -= turned);
        }
    }

    /// f at the state, and what each row may be.
    fn evaluate(&mut self) {
        let machine = self.machine;
        self.equations.evaluate(0.0, &self.state);
        self.loads();
        for &(_, theta) in &self.accelerated {
            let couple = self.equations.load[theta] + self.equations.spring[theta];
            self.state.a[theta] = couple / self.own_inertia(theta);
        }
        self.stand();
        let equations = &mut self.equations;
        let bodies = self.turning.iter().zip(&self.centrifugal).enumerate();
        for (place, (body, (own, centrifugal))) in machine.places().iter().zip(bodies) {
            if let Some(own) = own {
                let opposite: Vec<f64> = centrifugal[0].iter().map(|x| -x).collect();
                let elastic = &mut equations.elastic[place.flexible.clone()];
                add_product(elastic, &own.shaft.stiffness, &opposite);
                let theta = place.rotation.expect("a body that turns");
                let inertia = self.inertia[place.flexible.clone()].iter_mut();
                let rate = self.state.a[theta];
                inertia.zip(&self.twisting[body]).for_each(|(sum, g0)| *sum -= g0 * rate);
            }
        }
        let springs =
            equations.springs.forces.iter().fold(LEAST_FORCE, |most, f| most.max(f.abs()));
        let products = self.products();
        let equations = &mut self.equations;
        let rates = [&self.state.q[..], &self.state.v[..]];
        equations.spring_rounding.take(&machine.springs, &mut equations.springs, rates);
        let equations = &self.equations;
        self.gone.clear();
        for (row, place) in self.places.clone().into_iter().enumerate() {
            let terms = [
                equations.load[place],
                equations.spring[place],
                -equations.elastic[place],
                -equations.damper[place],
                self.inertia[place],
            ];
            let terms = match row >= self.flexible {
                true => {
                    [terms[0], terms[1], -self.own_inertia(place) * self.state.a[place], 0.0, 0.0]
                }
                false => terms,
            };
            if self.holds(row) {
                (self.force[row], self.bound[row]) = (0.0, 1.0);
                continue;
            }
            self.force[row] = terms.iter().sum();
            let size = |f: fn(f64, f64) -> f64| terms.iter().map(|x| x.abs()).fold(0.0, f);
            let projected = springs * machine.springs.reach[place];
            let projected = projected.max(LEAST_FORCE * self.shares[row]);
            // Of a law without slopes nothing is known.
            let measured =
                Some(equations.spring_rounding.forces[place]).filter(|own| own.is_finite());
            let rounding =
                f64::EPSILON * (size(|a, b| a + b) + products[row] + measured.unwrap_or(0.0));
            // Of rotations nothing is projected.
            let share = self.shares[row];
            let is_far = self.state.q[place].abs() > FAR;
            if is_far && share > 0.0 && rounding > GONE * springs * share {
                self.gone.push(row);
            }
            let nothing = if row >= self.flexible { NO_COUPLE } else { 0.0 };
            self.bound[row] = nothing
                + OF_TERM * size(f64::max)
                + OF_FORCE * projected
                + ROUNDING
                    * f64::EPSILON
                    * (size(|a, b| a + b)
                        + projected
                        + products[row]
                        + self.load_sizes[place]
                        + measured.unwrap_or(0.0));
        }
    }

    /// Whether a row is that of a speed that stays as it is.
    fn holds(&self, row: usize) -> bool {
        let own = row.checked_sub(self.flexible).map(|own| &self.rotations[own]);
        self.held && matches!(own, Some(Turn::Speed(_)))
    }

    /// J0 of the body with θ at a place.
    fn own_inertia(&self, theta: usize) -> f64 {
        let own = self.turning.iter().zip(self.machine.places());
        let own = own.filter(|(_, place)| place.rotation == Some(theta));
        own.filter_map(|(own, _)| own.as_ref()).map(|own| own.shaft.j0).sum()
    }

    /// Σ |products| of K η_s, C η̇ and the inertia of the rows.
    fn products(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.places.len()];
        for (number, own) in self.turning.iter().enumerate() {
            let Some(own) = own else { continue };
            let place = self.machine.places()[number].flexible.clone();
            let first = place.start - self.machine.rotations();
            for (j, at) in place.enumerate() {
                let [moved, rate] = [&self.state.q, &self.state.v].map(|own| own[at].abs());
                // Those by Q_v are as large as those by M q̈: M θ̇², 2 M θ̇².
                let turned =
                    if own.half_turn.is_some() { 4.0 * self.state.a[at].abs() } else { 0.0 };
                let columns = own.shaft.stiffness.col(j).iter().zip(own.shaft.damping.col(j));
                let rows = sums[first..].iter_mut().zip(columns.zip(own.shaft.mass.col(j)));
                rows.for_each(|(sum, ((k, c), m))| {
                    *sum += k.abs() * moved + c.abs() * rate + m.abs() * turned;
                });
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

    /// What a force anywhere on a body comes to in its rows, by their inertia: √(M_ii / max M_jj).
    fn shares(&self) -> Vec<f64> {
        let inertias = self.inertias();
        let mut shares = vec![0.0; inertias.len()];
        for place in self.machine.places() {
            let first = place.flexible.start - self.machine.rotations();
            let rows = first..first + place.flexible.len();
            let most = inertias[rows.clone()].iter().copied().fold(0.0, f64::max);
            for row in rows.filter(|_| most > 0.0) {
                shares[row] = (inertias[row] / most).sqrt();
            }
        }
        shares
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

    /// Eccentricity of the journal in each bearing (m, along x and y of space), bodies being turned as in the state.
    pub(super) fn eccentricities(&self, q: &[f64]) -> Vec<[f64; 2]> {
        let (places, own) = (self.machine.places(), &self.state.q);
        let monitors = self.machine.monitors.iter().map(|monitor| {
            let [journal, bore] = monitor.bodies.map(|body| frame_of(self.machine, body, own));
            let turned = Turned { journal, run_out: journal, bore };
            monitor.displaced(places, q, &turned).deformation
        });
        monitors.collect()
    }
}

/// Pairs of bodies between which an angle makes a couple.
fn twisting(
    machine: &Machine,
    equations: &mut Equations,
    tangent: &mut SpringTangent,
    state: &State,
) -> Vec<Twisting> {
    let size = machine.size();
    equations.evaluate(0.0, state);
    tangent.subtract(&machine.springs, &equations.springs, 0.0, size, &mut vec![0.0; size * size]);
    let planes = machine.springs.planes.iter().enumerate();
    let planes = planes.filter_map(|(plane, own)| {
        let meshes = machine.springs.gear_ratio(plane);
        let twists = own.other.is_none() && machine.springs.may_twist(plane);
        let twists = twists && (meshes.is_some() || tangent.by_angle(plane) != 0.0);
        let bodies = machine.monitors[own.bearing].bodies;
        twists.then_some(Twisting { bodies, ratio: meshes.unwrap_or(1.0) })
    });
    planes.collect()
}

/// G0 of a body in the coordinates that its quarter turn leaves at rest: g + (L²)ᵀ g, as L² is −1 where it turns.
fn twisted(own: &TurningStart) -> Vec<f64> {
    let (g0, quarter) = (&own.shaft.g0, &own.quarter_turn);
    let half = multiply(quarter.view(), quarter.view());
    (0..g0.len()).map(|i| g0[i] + dot(half.col(i), g0)).collect()
}

/// The state in the middle with the rotations that are given, the laws settled.
fn at_rest(machine: &Machine) -> State {
    let mut state = State::new(machine.size());
    state.laws.settle();
    machine.set_given(0.0, false, [&mut state.q, &mut state.v, &mut state.a]);
    state
}

fn add(sum: &mut [f64], terms: &[f64]) {
    sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
}
