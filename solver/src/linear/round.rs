//! A machine as linear analyses take it: its bodies exactly round.

use std::num::NonZero;
use std::ops::Range;
use std::thread;

use super::load_orders::{Harmonics, harmonics};
use super::rigid::rounding;
use super::standing_loads::{Counted, begun, counted, is_of_two_angles, mean, nothing, spins_with};
use crate::bearing::Plane;
use crate::bodies::{Body, Rotation};
use crate::error::Error;
use crate::linalg::{Matrix, multiply};
use crate::machine::Machine;
use crate::roundness::Roundness;
use crate::shaft::Shaft;

/// Share of the inertia of a body below which its unbalance is rounding.
const ROUNDING: f64 = 1e-10;

/// A machine whose turning bodies have the means of their tensors over turns, in space the means of loads that go by an angle.
pub struct LinearMachine {
    pub(super) machine: Machine,
    /// As it is: at rest nothing needs to be round.
    pub(super) still: Machine,
    /// With those bodies as they are that are not round, if there are any.
    pub(super) uneven: Option<Machine>,
    /// The same with what turns with round bodies, unbalance, and loads as they go by an angle.
    pub(super) loaded: Machine,
    /// By body S and S², of one that turns.
    pub(super) generators: Vec<Option<[Matrix; 2]>>,
    /// By body S and S² of one that stands, as far as its rows show how it turns.
    pub(super) senses: Vec<Option<[Matrix; 2]>>,
    /// By body how round it was, of one that turns.
    pub(super) roundness: Vec<Option<Roundness>>,
    /// Loads that vary, by their names, with how they count.
    pub(super) counted: Vec<(String, Counted)>,
    /// By load its orders, if it goes by the angle of a body.
    pub(super) by_angle: Vec<Option<Harmonics>>,
    /// Whether all bodies that turn freely swing about their speed, known or not.
    pub(super) all_swing: bool,
    /// The largest ω² that rounding gives rigid motions of a body ((rad/s)²).
    pub(super) rounding: f64,
    /// On which speeds are looked at side by side; the numbers do not depend on it.
    pub(super) threads: usize,
}

impl LinearMachine {
    /// Makes the bodies round, and leaves out what turns with them: unbalance.
    ///
    /// # Errors
    /// A body that turns of which nothing shows how.
    pub fn new(mut machine: Machine) -> Result<LinearMachine, Error> {
        let has_table = |plane: &Plane| {
            let law = &machine.springs.laws[plane.law].bound.law;
            law.over_frequency().is_some()
        };
        if let (Some(plane), true) =
            (machine.springs.remembering(|_| true), machine.springs.planes.iter().any(has_table))
        {
            let (joint, law) = machine.names_of(plane);
            return Err(Error::Remembers { joint, law });
        }
        let mut all_counted = Vec::new();
        let turning: Vec<bool> =
            machine.bodies.iter().map(|own| own.rotation().is_some_and(turns)).collect();
        for load in &mut machine.loads {
            if spins_with(load, machine.bodies[load.body].rotation()) {
                *load = nothing(load);
                continue;
            }
            let name = match load.name.as_str() {
                "" => format!("a load of {}", machine.bodies[load.body].name()),
                name => name.to_owned(),
            };
            if is_of_two_angles(load) && turning[load.body] {
                all_counted.push((name, Counted::OfTwoAngles));
                *load = nothing(load);
                continue;
            }
            if let Err(order) = harmonics(load) {
                all_counted.push((name, Counted::BetweenOrders(order)));
                *load = mean(load);
                continue;
            }
            let own = counted(load).map(|own| (name, own));
            all_counted.extend(own.filter(|own| !all_counted.contains(own)));
            *load = begun(load);
        }
        // What turns with a body is no part of a state that stands: its run-out acts as its unbalance does.
        let spins: Vec<bool> = (machine.bodies.iter())
            .map(|body| body.rotation().is_some_and(|own| *own != Rotation::Held))
            .collect();
        machine.run_true(|body| spins[body]);
        let still = machine.clone();
        let mut uneven = Vec::new();
        let (mut generators, mut senses, mut all) = (Vec::new(), Vec::new(), Vec::new());
        for (place, body) in machine.bodies.iter_mut().enumerate() {
            let Body::Turning { name, shaft, rotation } = body else {
                let support = body.support().expect("a body that stands");
                senses.push(support.roundness().ok().map(|own| with_square(own.generator)));
                generators.push(None);
                all.push(None);
                continue;
            };
            let roundness = shaft.roundness()?;
            let both = with_square(roundness.generator.clone());
            if turns(rotation) {
                if !roundness.has_pairs() {
                    let (body, lack) = (name.clone(), roundness.lack());
                    return Err(Error::NotRound { body, lack });
                }
                if !roundness.is_round_at(0.0) {
                    uneven.push(place);
                }
                *shaft = shaft.mean_over_turns(&both[0], &both[1]);
            }
            senses.push(None);
            generators.push(Some(both));
            all.push(Some(roundness));
        }
        let mut loaded = machine.clone();
        let spinning: Vec<bool> = loaded
            .bodies
            .iter()
            .map(|body| body.rotation().is_some_and(|own| own.spin().is_some()))
            .collect();
        loaded.run_true(|body| spinning[body]);
        for (place, body) in loaded.bodies.iter_mut().enumerate() {
            if uneven.contains(&place) {
                *body = still.bodies[place].clone();
            } else if let (Body::Turning { shaft, .. }, Some([_, square]), Some(own)) =
                (body, &generators[place], still.bodies[place].shaft())
            {
                let [along, across] = unbalance(own, square);
                shaft.y0.iter_mut().zip(along).for_each(|(sum, own)| *sum += own);
                shaft.g0.iter_mut().zip(across).for_each(|(sum, own)| *sum += own);
            }
        }
        let by_angle = loaded.loads.iter().map(|own| harmonics(own).ok().flatten()).collect();
        for load in &mut machine.loads {
            *load = mean(load);
        }
        let uneven = (!uneven.is_empty()).then(|| {
            let mut own = machine.clone();
            for place in uneven {
                own.bodies[place] = still.bodies[place].clone();
            }
            own
        });
        let all_swing = false;
        let threads = thread::available_parallelism().map_or(1, NonZero::get);
        let roundness = all;
        let rounding = rounding(&machine)?;
        Ok(LinearMachine {
            machine,
            still,
            uneven,
            loaded,
            generators,
            senses,
            roundness,
            counted: all_counted,
            by_angle,
            all_swing,
            rounding,
            threads,
        })
    }

    /// The same with angles of all bodies that turn freely among its small motions, also at speeds that are told.
    pub fn with_swinging_bodies(self) -> LinearMachine {
        LinearMachine { all_swing: true, ..self }
    }

    /// The same at work on so many threads at most in place of one a processor.
    pub fn on_threads(self, threads: NonZero<usize>) -> LinearMachine {
        LinearMachine { threads: threads.get(), ..self }
    }

    /// The machine with its round bodies.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// How round a body was, if it turns.
    pub fn roundness(&self, body: usize) -> Option<&Roundness> {
        self.roundness[body].as_ref()
    }

    /// The bodies that turn and are not round.
    pub fn not_round(&self) -> impl Iterator<Item = usize> {
        let is_uneven =
            |body: &usize| self.roundness[*body].as_ref().is_some_and(|own| !own.is_round_at(0.0));
        self.turning().filter(is_uneven)
    }

    /// Speeds of all bodies with body `of` at `speed` (rad/s): those of `ratios` by their ratio to it, others with a given
    /// speed in the ratio in which the machine has them, where it has one (a body that turns freely in a train has that of the
    /// train); of those left the speed is to be found.
    pub fn speeds(&self, of: usize, speed: f64, ratios: &[Option<f64>]) -> Vec<Option<f64>> {
        let given = |body: usize| {
            let rotation = self.machine.bodies[body].rotation()?;
            rotation.given(0.0, false).map(|own| own[1])
        };
        let own = given(of).or_else(|| self.given_by_train(of)).filter(|own| *own != 0.0);
        let bodies = 0..self.machine.bodies.len();
        let speeds = bodies.map(|body| {
            self.machine.bodies[body].rotation().filter(|own| turns(own))?;
            if body == of {
                return Some(speed);
            }
            match (ratios.get(body).copied().flatten(), given(body), own) {
                (Some(ratio), ..) => Some(ratio * speed),
                (None, Some(other), Some(own)) => Some(other / own * speed),
                (None, other, _) => other,
            }
        });
        speeds.collect()
    }

    /// Turns of each body in a turn of body `of`, of those that turn in proportion to it with these `ratios`.
    pub fn turns_in_one(&self, of: usize, ratios: &[Option<f64>]) -> Vec<Option<f64>> {
        let [slow, fast] = [1.0, 2.0].map(|speed| self.speeds(of, speed, ratios));
        let trains = self.machine.trains();
        let of_body = |(body, both): (usize, (Option<f64>, Option<f64>))| match both {
            (Some(slow), Some(fast)) => (fast == 2.0 * slow && slow != 0.0).then_some(slow),
            // In a train with it.
            _ => (self.machine.bodies[body].rotation().is_some_and(turns)
                && trains.train(body) == trains.train(of))
            .then(|| trains.ratio(body) / trains.ratio(of)),
        };
        slow.into_iter().zip(fast).enumerate().map(of_body).collect()
    }

    /// The speed that a body of the same train whose rotation is given gives one that turns freely (rad/s).
    fn given_by_train(&self, of: usize) -> Option<f64> {
        let trains = self.machine.trains();
        let others =
            (0..self.machine.bodies.len()).filter(|own| trains.train(*own) == trains.train(of));
        others.into_iter().find_map(|other| {
            let speed = self.machine.bodies[other].rotation()?.given(0.0, false)?[1];
            Some(speed * trains.ratio(of) / trains.ratio(other))
        })
    }

    /// What turns with a body of its y0 and g0; none of one that stands.
    pub(super) fn unbalance(&self, body: usize) -> [Vec<f64>; 2] {
        match (self.still.bodies[body].shaft(), &self.generators[body]) {
            (Some(shaft), Some([_, square])) => unbalance(shaft, square),
            _ => [Vec::new(), Vec::new()],
        }
    }

    /// Bodies whose frames turn, by their places.
    pub fn turning(&self) -> impl Iterator<Item = usize> {
        let bodies = self.machine.bodies.iter().enumerate();
        bodies.filter(|(_, body)| body.rotation().is_some_and(turns)).map(|(place, _)| place)
    }

    /// Where the coordinates of a body stand among those of small motions, of which so many angles come first.
    pub(super) fn block(&self, angles: usize, body: usize) -> Range<usize> {
        let (place, first) = (&self.machine.places()[body].flexible, self.machine.rotations());
        angles + place.start - first..angles + place.end - first
    }
}

/// What turns with a body of its y0 and g0: −(Sᵀ)² y0 and −(Sᵀ)² g0. What is so small beside its inertia, √(J0 Y_jj), is rounding
/// of its mesh.
fn unbalance(shaft: &Shaft, square: &Matrix) -> [Vec<f64>; 2] {
    let bound = |j: usize| ROUNDING * (shaft.j0 * shaft.spin_inertia[(j, j)]).sqrt();
    [&shaft.y0, &shaft.g0].map(|own| {
        let turns = square.apply_transpose(own).into_iter().enumerate();
        turns.map(|(j, own)| if own.abs() <= bound(j) { 0.0 } else { -own }).collect()
    })
}

/// S and S².
fn with_square(generator: Matrix) -> [Matrix; 2] {
    let square = multiply(generator.view(), generator.view());
    [generator, square]
}

/// Whether the frame of a body turns.
pub(super) fn turns(rotation: &Rotation) -> bool {
    !matches!(rotation, Rotation::Held | Rotation::Spinning { .. })
}
