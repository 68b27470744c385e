//! The machine: reduced bodies, the motion that couples their deformation to their rotation, bearings between any
//! two of them, and loads.

use std::sync::Arc;

use whirl_specs::{Clearance, Motion};

pub use crate::bodies::{Body, BodyPlace, Rotation};

use crate::bearing::{Bearing, Plane, SpringLaw, SpringState, Springs};
use crate::bodies::{Layout, Owner};
use crate::body::BodyNode;
use crate::error::Error;
use crate::linalg::dot;
use crate::loads::Load;
use crate::monitor::Monitor;
use crate::output::Output;
use crate::shaft::Shaft;
use crate::trains::Trains;

/// What a machine is made from.
pub struct MachineParts {
    /// The bodies.
    pub bodies: Vec<Body>,
    /// How rotation and deformation of a turning body are coupled.
    pub motion: &'static Motion,
    /// The kernels of the clearance.
    pub clearance: &'static Clearance,
    /// The laws of the springs.
    pub laws: Vec<Box<dyn SpringLaw>>,
    /// Journals in their bores.
    pub bearings: Vec<Bearing>,
    /// External loads.
    pub loads: Vec<Load>,
}

/// A machine ready to be marched; a copy shares the springs. Its coordinates are q = {θ of every turning body, η or x_b of every body}.
#[derive(Clone)]
pub struct Machine {
    /// The bodies.
    pub bodies: Vec<Body>,
    layout: Layout,
    /// How rotation and deformation of a turning body are coupled.
    pub motion: &'static Motion,
    /// The springs of all bearings.
    pub springs: Arc<Springs>,
    /// External loads.
    pub loads: Vec<Load>,
    /// The outputs of each bearing.
    pub(crate) monitors: Vec<Monitor>,
    /// Outputs by request; see [`Machine::with_outputs`].
    pub(crate) outputs: Vec<Output>,
    /// All nodes of some of the bodies, for what is written of whole bodies.
    pub fields: Vec<Field>,
}

/// All nodes of a body, with their motion.
#[derive(Debug, Clone)]
pub struct Field {
    /// The body, by its place.
    pub body: usize,
    /// In the order of its mesh.
    pub nodes: Vec<BodyNode>,
}

impl Machine {
    /// Puts a machine together.
    ///
    /// # Errors
    /// A bearing whose sides are one body, or none that there is; a law that takes what no spring has, bore nodes
    /// without a spline, a motion that takes a tensor which a shaft does not have; a body that spins in a bore
    /// that moves.
    pub fn new(parts: MachineParts) -> Result<Self, Error> {
        let MachineParts { bodies, motion, clearance, laws, bearings, loads } = parts;
        for tensor in motion.tensors {
            let mut shafts = bodies.iter().filter_map(Body::shaft);
            if shafts.any(|shaft| shaft.tensor(tensor.name).is_none()) {
                return Err(Error::Machine(format!(
                    "the motion {} takes a tensor called {}; a shaft has {}",
                    motion.origin.name,
                    tensor.name,
                    Shaft::TENSORS
                )));
            }
        }
        for bearing in &bearings {
            check_sides(bearing, &bodies)?;
        }
        if let Some(load) = loads.iter().find(|load| load.body >= bodies.len()) {
            return Err(Error::Machine(format!(
                "a load acts on body {}, which is none",
                load.body
            )));
        }
        for load in &loads {
            if let Some(body) = load.time_function.follows() {
                let followed = bodies.get(body).and_then(Body::rotation);
                if followed.is_none_or(|rotation| rotation.spin().is_some()) {
                    let what = "a load follows the angle of a body that does not turn";
                    return Err(Error::Machine(what.to_owned()));
                }
            }
        }
        let layout = Layout::new(&bodies);
        let springs = Springs::new(clearance, laws, &bearings, &bodies, &layout.places)?;
        let monitors = bearings
            .iter()
            .enumerate()
            .map(|(number, bearing)| Monitor::new(number, bearing, &bodies, &springs))
            .collect();
        Ok(Machine {
            bodies,
            layout,
            motion,
            springs: Arc::new(springs),
            loads,
            monitors,
            outputs: Vec::new(),
            fields: Vec::new(),
        })
    }

    /// Leaves out the run-out of the journals of some bodies, by their places, and of no others.
    pub(crate) fn run_true(&mut self, bodies: impl Fn(usize) -> bool) {
        self.monitors.iter_mut().for_each(|own| own.runs_true = bodies(own.bodies[0]));
    }

    /// Whether a body turns in a frame that stands still.
    pub(crate) fn spins(&self, body: usize) -> bool {
        self.bodies[body].rotation().is_some_and(|own| own.spin().is_some())
    }

    /// The state of its springs, to be evaluated.
    pub(crate) fn spring_state(&self) -> SpringState {
        let mut own = SpringState::new(&self.springs);
        own.run_true(&self.springs, |bearing| {
            self.monitors.get(bearing).is_some_and(|own| own.runs_true)
        });
        own
    }

    /// Number of coordinates that are marched: the 226 of the reference system.
    pub fn active(&self) -> usize {
        self.size() - self.first_unknown()
    }

    /// What the joint of a plane and its law are called.
    pub(crate) fn names_of(&self, plane: &Plane) -> (String, String) {
        let law = self.springs.laws[plane.law].bound.law.name().to_owned();
        (self.monitors[plane.bearing].name.clone(), law)
    }

    /// Place in q from which on coordinates are unknown: the rotations that are given stand before.
    pub fn first_unknown(&self) -> usize {
        self.layout.given
    }

    /// Number of rotations; they are the first coordinates.
    pub(crate) fn rotations(&self) -> usize {
        self.layout.rotations
    }

    /// Length of q.
    pub fn size(&self) -> usize {
        self.layout.owners.len()
    }

    /// Where the coordinates of each body stand in q.
    pub fn places(&self) -> &[BodyPlace] {
        &self.layout.places
    }

    /// How far the bore of a bearing turns about its axis against the frame of its body (rad).
    pub(crate) fn turn_of_bore(&self, bearing: usize, q: &[f64]) -> f64 {
        let monitor = &self.monitors[bearing];
        let (own, body) = (&monitor.sections[1], monitor.bodies[1]);
        // A rigid body has one section, which is all of it.
        let whole = || self.bodies[body].measures().first().map(|own| own.rotation.row(2));
        let row = if own.is_empty() { whole().unwrap_or_default() } else { own.clone() };
        dot(&row, &q[self.places()[body].flexible.clone()])
    }

    /// What stands at a place of q.
    pub(crate) fn owner(&self, place: usize) -> Owner {
        self.layout.owners[place]
    }

    /// Bodies that turn, by their places, in their order.
    pub fn turning(&self) -> impl Iterator<Item = usize> {
        (0..self.bodies.len()).filter(|&body| self.layout.places[body].rotation.is_some())
    }

    /// Bodies that couples turn as they are told, by their places, in their order.
    pub(crate) fn driven(&self) -> impl Iterator<Item = usize> {
        let takes =
            |body: &usize| self.bodies[*body].rotation().is_some_and(Rotation::takes_a_couple);
        (0..self.bodies.len()).filter(takes)
    }

    /// Joints that tie rotations to each other by laws of the angle: torsional couplings and gears.
    pub(crate) fn twisting_joints(&self) -> impl Iterator<Item = usize> {
        let twists = |joint: &usize| {
            let mut planes = self.monitors[*joint].planes.iter();
            planes.any(|&plane| {
                let tied = || self.springs.tied(plane, self.layout.rotations).len() > 1;
                self.springs.may_twist(plane) && tied()
            })
        };
        (0..self.monitors.len()).filter(twists)
    }

    /// Bodies that joints tie to each other by their angles.
    pub fn tied_bodies(&self) -> Vec<usize> {
        let mut bodies: Vec<usize> =
            self.tied_rotations().into_iter().map(|theta| self.owner(theta).body).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }

    /// By body its speed over that of the first body of its train, as the gears have it.
    pub fn train_ratios(&self) -> Vec<f64> {
        let trains = self.trains();
        (0..self.bodies.len()).map(|body| trains.ratio(body)).collect()
    }

    /// What turns together by couplings and gears, by bodies.
    pub(crate) fn trains(&self) -> Trains {
        let mut trains = Trains::new(self.bodies.len());
        for joint in self.twisting_joints() {
            let monitor = &self.monitors[joint];
            let ratio = monitor.planes.iter().find_map(|&own| self.springs.gear_ratio(own));
            trains.tie(monitor.bodies, ratio.unwrap_or(1.0));
        }
        trains
    }

    /// Places in q of rotations that laws of the angle tie to each other: of torsional couplings and of gears.
    pub(crate) fn tied_rotations(&self) -> Vec<usize> {
        let springs = &self.springs;
        let twisting = (0..springs.planes.len()).filter(|&plane| springs.may_twist(plane));
        let tied = twisting.map(|plane| springs.tied(plane, self.layout.rotations));
        tied.filter(|own| own.len() > 1).flatten().map(|(place, _)| place).collect()
    }

    /// Angle (rad) and speed (rad/s) of a body that turns, as people see it, at time `t` (s); `theta` is those of its
    /// frame.
    pub(crate) fn turn(&self, body: usize, t: f64, theta: [f64; 2]) -> [f64; 2] {
        match self.bodies[body].rotation().and_then(|own| own.spin()) {
            Some(speed) => [speed * t, speed],
            None => theta,
        }
    }

    /// Sets θ, θ̇ and θ̈ of the rotations that are given to what they are at time `t` (s).
    /// `before`: what jumps at this instant has not done so yet.
    pub(crate) fn set_given(&self, t: f64, before: bool, state: [&mut [f64]; 3]) {
        let [q, v, a] = state;
        for place in 0..self.layout.given {
            let rotation = self.bodies[self.owner(place).body].rotation();
            if let Some([angle, speed, rate]) = rotation.and_then(|own| own.given(t, before)) {
                (q[place], v[place], a[place]) = (angle, speed, rate);
            }
        }
    }

    /// Whether a load has reached the speed at which it ends, at the rates of all coordinates.
    pub(crate) fn ends(&self, load: &Load, v: &[f64]) -> bool {
        let theta = self.places()[load.body].rotation;
        theta.is_some_and(|theta| load.reaches(v[theta]))
    }

    /// What coordinate `place` of q is.
    pub fn coordinate(&self, place: usize) -> String {
        let Owner { body, coordinate } = self.owner(place);
        let body = &self.bodies[body];
        match coordinate {
            None => format!("rotation angle of the {}", body.name()),
            Some(j) => format!("{}, {}", body.name(), body.coordinates()[j]),
        }
    }

    /// The tensors of the motion for a shaft, in the motion's order.
    pub(crate) fn tensors<'m>(&self, shaft: &'m Shaft) -> Vec<&'m [f64]> {
        let tensor = |name| shaft.tensor(name).expect("checked when the machine was made");
        self.motion.tensors.iter().map(|fact| tensor(fact.name)).collect()
    }
}

/// Whether the sides of a bearing can be joined.
fn check_sides(bearing: &Bearing, bodies: &[Body]) -> Result<(), Error> {
    let wrong = |what: String| Err(Error::Machine(format!("{}: {what}", bearing.name)));
    let [journal, bore] = bearing.sides.bodies;
    let (Some(journal), Some(own)) = (bodies.get(journal), bodies.get(bore)) else {
        return wrong("a side is on a body that there is not".to_owned());
    };
    if bearing.sides.bodies[0] == bore {
        return wrong(format!("both sides are on {}; a bearing joins two bodies", own.name()));
    }
    let spins = |body: &Body| body.rotation().and_then(|rotation| rotation.spin()).is_some();
    if spins(journal) && (own.size() > 0 || own.rotation().is_some()) || spins(own) {
        return wrong("a body that spins in a fixed frame needs a rigid bore".to_owned());
    }
    if bearing.sides.gear.is_some() && [journal, own].iter().any(|body| body.rotation().is_none()) {
        return wrong("gears are on bodies that turn".to_owned());
    }
    let off_axis = bearing.sides.bore_axis != [0.0; 2];
    if off_axis && own.rotation().is_some() {
        let name = own.name();
        return wrong(format!("the bore is off the axis of {name}, which turns about it"));
    }
    Ok(())
}
