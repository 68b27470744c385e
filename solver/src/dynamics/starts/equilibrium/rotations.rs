//! What is unknown of the rotations of an equilibrium.
//!
//! Bodies between which laws of the angle act, as torsional couplings, turn at one speed, and their angles against each other
//! carry the couples. Of a group in which nothing has a given speed that speed is unknown, and the angle of each body but
//! one. Where one has it, as a prescribed body or one that stands, all have it. Where bodies that turn freely begin at a
//! given speed, at which their couples need not be in balance, the group has one acceleration, so that the couplings
//! carry what speeds up all of them alike. One by itself has that which its couple gives it (`balance`). Speeds and accelerations
//! of bodies on gears are in the ratio of the gears.

use crate::equations::State;
use crate::machine::Machine;
use crate::trains::Trains;

use super::turning::{idle_speed, largest};

/// An unknown of the rotations.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Turn {
    /// The speed of all with θ at these places of q, over their ratios.
    Speed(Vec<(usize, f64)>),
    /// The angle θ at a place.
    Angle(usize),
    /// The acceleration of all with θ at these places, over their ratios.
    Acceleration(Vec<(usize, f64)>),
}

/// Bodies between which an angle makes a couple, and the speed of the second over that of the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Twisting {
    pub(super) bodies: [usize; 2],
    pub(super) ratio: f64,
}

/// A body in a group, with its speed where the group turns with 1 rad/s.
type Member = (usize, f64);

/// Share by which speeds that belong together may differ.
const TOGETHER: f64 = 1e-9;

/// The unknowns, each in the row of a θ.
#[derive(Debug, Default)]
pub(super) struct Rotations {
    pub(super) rows: Vec<usize>,
    pub(super) unknowns: Vec<Turn>,
}

impl Rotations {
    /// Of a machine whose state has the rotations that are given, with θ̈; sets the speeds there from which the search
    /// begins. `speeds`: by body, where it turns freely and its speed is given (rad/s). `twisting`: pairs of bodies between
    /// which an angle makes a couple.
    pub(super) fn new(
        machine: &Machine,
        speeds: &[Option<f64>],
        twisting: &[Twisting],
        state: &mut State,
    ) -> Rotations {
        let mut own = Rotations::default();
        for group in groups(machine, twisting) {
            let of = |body: &usize| machine.places()[*body].rotation;
            // Speed and acceleration of the group, by what is known of a body in it.
            let known = |(body, ratio): &Member| match of(body) {
                None => Some([0.0; 2]),
                Some(theta) => {
                    let given =
                        machine.bodies[*body].rotation().and_then(|own| own.given(0.0, false));
                    given.map(|_| [state.v[theta] / ratio, state.a[theta] / ratio])
                }
            };
            let begins = |(body, ratio): &Member| {
                speeds.get(*body).copied().flatten().map(|speed| speed / ratio)
            };
            let (anchors, free): (Vec<Member>, Vec<Member>) =
                group.into_iter().partition(|own| known(own).is_some());
            let anchor = anchors.first().and_then(known);
            let first = anchor.map(|own| own[0]).or_else(|| free.iter().find_map(begins));
            let differs = |speed: Option<f64>| {
                let apart = |own: f64, first: f64| {
                    (own - first).abs() > TOGETHER * own.abs().max(first.abs())
                };
                speed.is_some_and(|own| first.is_none_or(|first| apart(own, first)))
            };
            let torn = anchors.iter().any(|own| differs(known(own).map(|own| own[0])))
                || free.iter().any(|own| differs(begins(own)));
            if torn {
                // At different speeds nothing is steady: each as if it were by itself.
                for member in &free {
                    let alone = (member.0, 1.0);
                    own.group(false, &[alone], begins(&alone), state, machine);
                }
                continue;
            }
            // One that begins at a given speed is that against which the others turn.
            let (given, rest): (Vec<Member>, Vec<Member>) =
                free.into_iter().partition(|own| begins(own).is_some());
            let free = [given, rest].concat();
            let rate = anchor.map(|own| own[1]);
            own.group(!anchors.is_empty(), &free, first, state, machine);
            for (body, ratio) in &free {
                if let Some(theta) = of(body) {
                    state.a[theta] = ratio * rate.unwrap_or(0.0);
                }
            }
        }
        own.begin(machine, state);
        own
    }

    /// A group with these bodies that turn freely; `speed`: that of the group, if it is known. `anchored`: whether a rotation in it
    /// is given.
    fn group(
        &mut self,
        anchored: bool,
        free: &[Member],
        speed: Option<f64>,
        state: &mut State,
        machine: &Machine,
    ) {
        let place = |&(body, ratio): &Member| Some((machine.places()[body].rotation?, ratio));
        let places: Vec<(usize, f64)> = free.iter().filter_map(place).collect();
        if let Some(speed) = speed {
            places.iter().for_each(|&(theta, ratio)| state.v[theta] = ratio * speed);
        }
        match speed {
            // By itself, at a given speed: nothing is unknown.
            Some(_) if !anchored && places.len() == 1 => return,
            Some(_) if anchored => {}
            Some(_) => self.unknowns.push(Turn::Acceleration(places.clone())),
            None if places.is_empty() => return,
            None => self.unknowns.push(Turn::Speed(places.clone())),
        }
        let turned = places.iter().skip(usize::from(!anchored));
        self.unknowns.extend(turned.map(|&(theta, _)| Turn::Angle(theta)));
        self.rows.extend(places.into_iter().map(|own| own.0));
    }

    /// The speeds from which the search begins.
    fn begin(&self, machine: &Machine, state: &mut State) {
        let unknown = self.unknowns.iter().filter_map(|own| match own {
            Turn::Speed(places) => Some(places),
            _ => None,
        });
        let mut open = Vec::new();
        for places in unknown {
            let idle = places
                .iter()
                .filter_map(|&(theta, ratio)| Some(idle_speed(machine, theta)? / ratio));
            match largest(idle) {
                Some(speed) => {
                    places.iter().for_each(|&(theta, ratio)| state.v[theta] = ratio * speed);
                }
                None => open.push(places),
            }
        }
        let fastest = state.v[..machine.rotations()]
            .iter()
            .fold(0.0, |most: f64, speed| if speed.abs() > most.abs() { *speed } else { most });
        // Between two films a ring turns at about half the speed of what it carries.
        for &(theta, ratio) in open.into_iter().flatten() {
            state.v[theta] = ratio * 0.5 * fastest;
        }
    }
}

impl Turn {
    /// Its value at a state.
    pub(super) fn value(&self, state: &State) -> f64 {
        match self {
            Turn::Speed(places) => state.v[places[0].0] / places[0].1,
            Turn::Angle(theta) => state.q[*theta],
            Turn::Acceleration(places) => state.a[places[0].0] / places[0].1,
        }
    }

    /// Sets it in a state.
    pub(super) fn set(&self, value: f64, state: &mut State) {
        match self {
            Turn::Speed(places) => {
                places.iter().for_each(|&(theta, ratio)| state.v[theta] = ratio * value);
            }
            Turn::Angle(theta) => state.q[*theta] = value,
            Turn::Acceleration(places) => {
                places.iter().for_each(|&(theta, ratio)| state.a[theta] = ratio * value);
            }
        }
    }
}

/// Bodies that turn, in groups that an angle between any two ties together; with those that stand, if these are tied to one.
fn groups(machine: &Machine, twisting: &[Twisting]) -> Vec<Vec<Member>> {
    let turns = |body: usize| machine.places()[body].rotation.is_some();
    let mut trains = Trains::new(machine.bodies.len());
    // What stands ties nothing together.
    for own in twisting.iter().filter(|own| own.bodies.iter().all(|body| turns(*body))) {
        trains.tie(own.bodies, own.ratio);
    }
    let mut all: Vec<Vec<Member>> = Vec::new();
    for first in 0..machine.bodies.len() {
        let members = (0..machine.bodies.len()).filter(|&body| trains.train(body) == first);
        let turning: Vec<Member> =
            members.filter(|&body| turns(body)).map(|body| (body, trains.ratio(body))).collect();
        if turning.is_empty() {
            continue;
        }
        let is_turning = |body: usize| turning.iter().any(|own| own.0 == body);
        let on_ground = twisting.iter().find_map(|own| {
            let [a, b] = own.bodies;
            let one = |a: usize, b: usize| {
                (is_turning(a) && machine.places()[b].rotation.is_none()).then_some((b, 1.0))
            };
            one(a, b).or_else(|| one(b, a))
        });
        all.push(turning.into_iter().chain(on_ground).collect());
    }
    all
}
