//! A march from the last state of another one: with the same bodies, under loads, laws and drives that may be others.
//!
//! Where nothing acts differently at that instant, the march goes on as the other would have done, to the bit: with its
//! accelerations and the factors that Newton's method kept. Where anything does, accelerations follow from the forces that
//! act now. Time and angles go on; energies, the steady state and what is measured of steps and laws count anew.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::bearing::{Hold, LawStates, Remembered};
use crate::cache::Key;
use crate::centre_of_mass::CentreOfMass;
use crate::dynamics::iteration::NewtonState;
use crate::dynamics::lengths::ControlMemory;
use crate::dynamics::marching::{Checkpoint, Clock, March, MarchOptions};
use crate::equations::{Equations, State};
use crate::error::Error;
use crate::film::{Grid, Shapes};
use crate::loads::Load;
use crate::machine::{Body, Machine};
use crate::shaft::Shaft;
use crate::support::Support;
use crate::told::ToldLoad;

/// Differences of angle (rad), and of speed as a share of it, that are rounding.
const ROUNDING: f64 = 1e-6;

/// The state of a machine after a step, body by body, with what is needed to go on from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LastState {
    bodies: Vec<LastBody>,
    /// Time after the step (s), and Δt.
    time: f64,
    time_step: f64,
    /// When its march began to count, and its steps.
    clock: Clock,
    /// Time at which the system was evaluated, which rounding may set apart from that after the step.
    evaluated: f64,
    /// Each load by what it is, and whether it has stopped.
    loads: Vec<(Key, bool)>,
    /// The terms of all rows.
    acting: Key,
    newton: NewtonState,
    /// What was remembered of the parts of steps, where the march chose them.
    control: Option<ControlMemory>,
    /// The states of laws, where there are any.
    remembered: Vec<LastLaw>,
    /// What films these are, and what is known of them.
    films: (Key, Vec<f64>),
}

/// The states of a law: known, rates and lag of [`LawStates`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct LastLaw {
    /// Where it acts, and what its states are called.
    content: Key,
    states: [Vec<f64>; 3],
}

/// A body of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct LastBody {
    name: String,
    /// What its coordinates are.
    content: Key,
    /// θ, θ̇, θ̈ of one that turns, and what its method carries on.
    rotation: Option<[f64; 4]>,
    /// η or x_b.
    flexible: State,
}

impl March<'_> {
    /// What another run can start from: the state after the last step.
    pub fn last_state(&self) -> LastState {
        LastState::new(self.machine, self.options.time_step, self.time(), self.checkpoint())
    }
}

impl LastState {
    fn new(machine: &Machine, time_step: f64, time: f64, from: Checkpoint) -> Self {
        let Checkpoint {
            state, time: evaluated, clock, released, told, newton, tally, meters, ..
        } = from;
        let bodies = machine.bodies.iter().zip(machine.places()).map(|(body, place)| {
            let part = |all: &[f64]| all[place.flexible.clone()].to_vec();
            LastBody {
                name: body.name().to_owned(),
                content: content(body),
                rotation: place
                    .rotation
                    .map(|at| [state.q[at], state.v[at], state.a[at], state.lag[at]]),
                flexible: State {
                    q: part(&state.q),
                    v: part(&state.v),
                    a: part(&state.a),
                    lag: part(&state.lag),
                    laws: LawStates::default(),
                },
            }
        });
        LastState {
            bodies: bodies.collect(),
            time,
            time_step,
            clock: Clock { step: clock.step + tally.step, ..clock },
            evaluated,
            loads: loads(machine).into_iter().zip(released.iter().copied()).collect(),
            acting: acting(machine, evaluated, &state, (&released, &told)),
            newton,
            control: meters.control().map(ControlMemory::counted_anew),
            remembered: remembered(machine, &state.laws),
            films: (films(machine), state.laws.films.clone()),
        }
    }

    /// Whether a machine can go on from it.
    ///
    /// # Errors
    /// It is of other bodies, or a rotation is prescribed that does not go on from it.
    pub fn check(&self, machine: &Machine) -> Result<(), Error> {
        self.fitting(machine).map(|_| ())
    }

    /// Whether laws with states and films, here or there, are not the same, so that what they remember begins anew.
    pub fn begins_anew(&self, machine: &Machine) -> bool {
        let own = placed_states(machine);
        let is_known = own.iter().map(|(content, _)| content);
        !is_known.eq(self.remembered.iter().map(|law| &law.content))
            || self.films.0 != films(machine)
    }

    /// Time of the state (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state in the coordinates of a machine that can go on from it.
    fn fitting(&self, machine: &Machine) -> Result<State, Error> {
        let state = self.state(machine)?;
        self.check_rotations(machine, &state)?;
        Ok(state)
    }

    /// The state in the coordinates of a machine.
    fn state(&self, machine: &Machine) -> Result<State, Error> {
        let mut differ = Vec::new();
        let mut state = State::new(machine.size());
        for (body, place) in machine.bodies.iter().zip(machine.places()) {
            let name = body.name();
            let Some(own) = self.bodies.iter().find(|own| own.name == name) else {
                differ.push(format!("it has no body `{name}`"));
                continue;
            };
            if own.content != content(body) || own.rotation.is_some() != place.rotation.is_some() {
                differ.push(format!("`{name}` is another one"));
                continue;
            }
            let State { q, v, a, lag, laws: _ } = &own.flexible;
            let all =
                [(&mut state.q, q), (&mut state.v, v), (&mut state.a, a), (&mut state.lag, lag)];
            all.into_iter().for_each(|(all, own)| all[place.flexible.clone()].copy_from_slice(own));
            if let (Some(at), Some([angle, speed, rate, lag])) = (place.rotation, own.rotation) {
                (state.q[at], state.v[at]) = (angle, speed);
                (state.a[at], state.lag[at]) = (rate, lag);
            }
        }
        let is_gone = |own: &&LastBody| machine.bodies.iter().all(|body| body.name() != own.name);
        let gone = self.bodies.iter().filter(is_gone);
        differ.extend(gone.map(|own| format!("its body `{}` is missing", own.name)));
        self.remember(machine, &mut state.laws);
        if differ.is_empty() { Ok(state) } else { Err(Error::OtherBodies(differ)) }
    }

    /// The states of laws, which go on where all laws with states act where they did and have the same ones, and all films are where
    /// they were on the same nodes; else all begin anew.
    fn remember(&self, machine: &Machine, laws: &mut LawStates) {
        *laws = machine.springs.beginning();
        let own = placed_states(machine);
        if own.is_empty() && laws.films.is_empty() || self.begins_anew(machine) {
            return;
        }
        laws.films.clone_from(&self.films.1);
        for ((_, place), law) in own.into_iter().zip(&self.remembered) {
            let all = [&mut laws.known, &mut laws.rates, &mut laws.lag];
            for (all, own) in all.into_iter().zip(&law.states) {
                all[place.clone()].copy_from_slice(own);
            }
        }
        laws.hold = Hold::Implicit(0.0);
    }

    /// Whether rotations that are prescribed go on from the state.
    fn check_rotations(&self, machine: &Machine, state: &State) -> Result<(), Error> {
        let mut given = state.clone();
        machine.set_given(self.time, false, [&mut given.q, &mut given.v, &mut given.a]);
        for at in 0..machine.first_unknown() {
            let apart = (given.q[at] - state.q[at]).abs();
            let jump = (given.v[at] - state.v[at]).abs();
            let angles = 1.0_f64.max(state.q[at].abs() * f64::EPSILON / ROUNDING);
            if apart > ROUNDING * angles || jump > ROUNDING * given.v[at].abs().max(1.0) {
                return Err(Error::OtherRotation {
                    body: machine.bodies[machine.owner(at).body].name().to_owned(),
                    time: self.time,
                    angle: given.q[at],
                    speed: given.v[at],
                    had_angle: state.q[at],
                    had_speed: state.v[at],
                });
            }
        }
        Ok(())
    }
}

impl<'m> March<'m> {
    /// A march from the last state of another one. Initial states of the options have no effect.
    ///
    /// # Errors
    /// The state is of other bodies; a rotation is prescribed that does not go on from it; a mass matrix that cannot be
    /// inverted.
    pub fn from_last(
        machine: &'m Machine,
        options: &MarchOptions,
        last: &LastState,
    ) -> Result<Self, Error> {
        let state = last.fitting(machine)?;
        let own = loads(machine);
        let known = |load: &Key| last.loads.iter().find(|(other, _)| other == load);
        let released: Vec<bool> =
            own.iter().map(|load| known(load).is_some_and(|(_, released)| *released)).collect();
        let same_loads = own.iter().eq(last.loads.iter().map(|(load, _)| load));
        let untold = vec![None; machine.loads.len()];
        let acting = acting(machine, last.evaluated, &state, (&released, &untold));
        let same = acting == last.acting;
        // With another Δt the state is no multiple of it.
        let same_step = last.time_step == options.time_step;
        let clock = match same_step {
            true => last.clock,
            false => Clock { time: last.time, step: 0 },
        };
        let time = if same { last.evaluated } else { last.time };
        let mut march = March::begin(machine, options, (state, released, time), !same)?;
        // A kept state has one place a coordinate and a load, in their order.
        let fits = options.automatic.is_some() == last.control.is_some();
        let newton = (same && same_loads && fits).then(|| last.newton.counted_anew());
        march.go_on(clock, time, newton);
        if same && same_step {
            march.meters.resume_control(last.control.clone());
        }
        Ok(march)
    }
}

/// What the coordinates of a body are: their names, and what they store of energy; not its nodes, which loads choose, nor
/// unbalance and damping.
fn content(body: &Body) -> Key {
    match body {
        Body::Turning { shaft, name: _, rotation: _ } => {
            let Shaft {
                j0,
                y0: _,
                g0: _,
                mass,
                stiffness,
                damping: _,
                spin_inertia,
                spin_coupling,
                spin_net,
                hertz,
                coordinates,
                nodes: _,
                measures: _,
                sections: _,
                centre_of_mass: CentreOfMass { mass: _, node },
            } = shaft;
            let matrices = [mass, stiffness, spin_inertia, spin_coupling, spin_net];
            // The coordinates of a rigid body are motions of its centre, which unbalance moves across the axis only.
            let centre = hertz.is_empty().then_some(node.position[2]);
            Key::of(&(coordinates, j0, matrices.map(|own| &own.data), centre))
        }
        // Coordinates of what stands have unit mass: what they are depends on the mass itself.
        Body::Standing { support, name: _ } => {
            let Support {
                stiffness,
                damping: _,
                hertz: _,
                coordinates,
                nodes: _,
                measures: _,
                sections: _,
                centre_of_mass: CentreOfMass { mass, node },
            } = support;
            Key::of(&(coordinates, stiffness, mass, node))
        }
    }
}

/// Names of the joints of some planes, plane by plane.
fn joints(machine: &Machine, planes: Range<usize>) -> Vec<&str> {
    let planes = machine.springs.planes[planes].iter();
    planes.map(|plane| machine.monitors[plane.bearing].name.as_str()).collect()
}

/// By laws with states what these are, and their places among all states.
fn placed_states(machine: &Machine) -> Vec<(Key, Range<usize>)> {
    let springs = &machine.springs;
    let mut first = 0;
    let mut all = Vec::new();
    for law in springs.laws.iter().filter(|law| !law.bound.states.is_empty()) {
        let of = |own: &Remembered| (own.name.clone(), own.unit.clone());
        let states: Vec<(String, String)> = law.bound.states.iter().map(of).collect();
        let place = first..first + law.springs * states.len();
        first = place.end;
        let joints = joints(machine, law.planes.clone());
        all.push((Key::of(&(joints, states, law.springs)), place));
    }
    all
}

/// Where films are, and on which nodes.
fn films(machine: &Machine) -> Key {
    let of_law = machine.springs.laws.iter().filter_map(|law| {
        let film = &law.bound.law.film()?.film;
        let joints = joints(machine, law.planes.clone());
        let openings: Vec<&str> = film.openings.iter().map(|own| own.name.as_str()).collect();
        let Grid { around, along, first, arc, .. } = film.grid;
        let heated = if law.bound.law.film()?.heat().is_some() { " heated" } else { "" };
        let shapes = law.shapes.as_ref().map(Shapes::count);
        let shapes = shapes.map_or(String::new(), |n| format!(" {n}"));
        let reach = format!("{first:?} {arc:?}{shapes}{heated}");
        Some((joints, film.name(), [around, along], openings, reach))
    });
    Key::of(&of_law.collect::<Vec<_>>())
}

/// The states of laws after a step.
fn remembered(machine: &Machine, laws: &LawStates) -> Vec<LastLaw> {
    let own = placed_states(machine).into_iter().map(|(content, place)| LastLaw {
        content,
        states: [&laws.known, &laws.rates, &laws.lag].map(|all| all[place.clone()].to_vec()),
    });
    own.collect()
}

/// Each load by what it is, of bodies by name: their order is no matter.
fn loads(machine: &Machine) -> Vec<Key> {
    let name = |body: usize| machine.bodies[body].name();
    let key = |load: &Load| {
        let followed = load.time_function.follows().map(name);
        let placed = Load { time_function: load.time_function.of(0), body: 0, ..load.clone() };
        Key::of(&(name(load.body), followed, format!("{placed:?}")))
    };
    machine.loads.iter().map(key).collect()
}

/// Everything that acts on a machine at an instant, to the bit, in the order of its coordinates.
fn acting(
    machine: &Machine,
    time: f64,
    state: &State,
    (released, told): (&[bool], &[Option<ToldLoad>]),
) -> Key {
    let mut equations = Equations::new(machine);
    equations.released.copy_from_slice(released);
    equations.told.copy_from_slice(told);
    equations.evaluate(time, state);
    let coordinates: Vec<String> =
        (0..machine.size()).map(|place| machine.coordinate(place)).collect();
    let terms = [
        &equations.inertia,
        &equations.damper,
        &equations.elastic,
        &equations.load,
        &equations.spring,
    ];
    Key::of(&(coordinates, machine.first_unknown(), terms, &equations.springs.forces))
}
