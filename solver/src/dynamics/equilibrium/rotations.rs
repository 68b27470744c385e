//! What is unknown of the rotations of an equilibrium.
//!
//! Bodies between which laws of the angle act, as torsional couplings, turn at one speed, and their angles against each other
//! carry the couples. Of a group in which nothing has a given speed that speed is unknown, and the angle of each body but
//! one. Where one has it, as a prescribed body or one that stands, all have it. Where bodies that turn freely begin at a
//! given speed, at which their couples need not be in balance, the group has one acceleration, so that the couplings
//! carry what speeds up all of them alike. One by itself has that which its couple gives it (`balance`).

use crate::equations::State;
use crate::machine::Machine;

use super::turning::{idle_speed, largest};

/// An unknown of the rotations.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Turn {
    /// The speed of all with θ at these places of q.
    Speed(Vec<usize>),
    /// The angle θ at a place.
    Angle(usize),
    /// The acceleration of all with θ at these places.
    Acceleration(Vec<usize>),
}

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
        twisting: &[[usize; 2]],
        state: &mut State,
    ) -> Rotations {
        let mut own = Rotations::default();
        for group in groups(machine, twisting) {
            let of = |body: &usize| machine.places()[*body].rotation;
            let known = |body: &usize| match of(body) {
                None => Some([0.0; 2]),
                Some(theta) => {
                    let given =
                        machine.bodies[*body].rotation().and_then(|own| own.given(0.0, false));
                    given.map(|_| [state.v[theta], state.a[theta]])
                }
            };
            let begins = |body: &usize| speeds.get(*body).copied().flatten();
            let (anchors, free): (Vec<usize>, Vec<usize>) =
                group.into_iter().partition(|body| known(body).is_some());
            let anchor = anchors.first().and_then(known);
            let first = anchor.map(|own| own[0]).or_else(|| free.iter().find_map(begins));
            let differs = |speed: Option<f64>| speed.is_some_and(|speed| Some(speed) != first);
            let torn = anchors.iter().any(|body| differs(known(body).map(|own| own[0])))
                || free.iter().any(|body| differs(begins(body)));
            if torn {
                // At different speeds nothing is steady: each as if it were by itself.
                for body in &free {
                    own.group(&[], &[*body], begins(body), state, machine);
                }
                continue;
            }
            let (free, places): (Vec<usize>, Vec<usize>) = {
                // One that begins at a given speed is that against which the others turn.
                let (given, rest): (Vec<usize>, Vec<usize>) =
                    free.into_iter().partition(|body| begins(body).is_some());
                ([given, rest].concat(), anchors)
            };
            let rate = anchor.map(|own| own[1]);
            own.group(&places, &free, first, state, machine);
            for theta in free.iter().filter_map(of) {
                state.a[theta] = rate.unwrap_or(0.0);
            }
        }
        own.begin(machine, state);
        own
    }

    /// A group with these bodies that turn freely; `speed`: the one that all have, if it is known.
    fn group(
        &mut self,
        anchors: &[usize],
        free: &[usize],
        speed: Option<f64>,
        state: &mut State,
        machine: &Machine,
    ) {
        let places: Vec<usize> =
            free.iter().filter_map(|&body| machine.places()[body].rotation).collect();
        if let Some(speed) = speed {
            places.iter().for_each(|&theta| state.v[theta] = speed);
        }
        let anchored = !anchors.is_empty();
        match speed {
            // By itself, at a given speed: nothing is unknown.
            Some(_) if !anchored && places.len() == 1 => return,
            Some(_) if anchored => {}
            Some(_) => self.unknowns.push(Turn::Acceleration(places.clone())),
            None if places.is_empty() => return,
            None => self.unknowns.push(Turn::Speed(places.clone())),
        }
        let turned = places.iter().skip(usize::from(!anchored));
        self.unknowns.extend(turned.map(|&theta| Turn::Angle(theta)));
        self.rows.extend(places);
    }

    /// The speeds from which the search begins.
    fn begin(&self, machine: &Machine, state: &mut State) {
        let unknown = self.unknowns.iter().filter_map(|own| match own {
            Turn::Speed(places) => Some(places),
            _ => None,
        });
        let mut open = Vec::new();
        for places in unknown {
            let idle = places.iter().filter_map(|&theta| idle_speed(machine, theta));
            match largest(idle) {
                Some(speed) => places.iter().for_each(|&theta| state.v[theta] = speed),
                None => open.push(places),
            }
        }
        let fastest = state.v[..machine.rotations()]
            .iter()
            .fold(0.0, |most: f64, speed| if speed.abs() > most.abs() { *speed } else { most });
        // Between two films a ring turns at about half the speed of what it carries.
        for &theta in open.into_iter().flatten() {
            state.v[theta] = 0.5 * fastest;
        }
    }
}

impl Turn {
    /// Its value at a state.
    pub(super) fn value(&self, state: &State) -> f64 {
        match self {
            Turn::Speed(places) => state.v[places[0]],
            Turn::Angle(theta) => state.q[*theta],
            Turn::Acceleration(places) => state.a[places[0]],
        }
    }

    /// Sets it in a state.
    pub(super) fn set(&self, value: f64, state: &mut State) {
        match self {
            Turn::Speed(places) => places.iter().for_each(|&theta| state.v[theta] = value),
            Turn::Angle(theta) => state.q[*theta] = value,
            Turn::Acceleration(places) => places.iter().for_each(|&theta| state.a[theta] = value),
        }
    }
}

/// Bodies that turn, in groups that an angle between any two ties together; with those that stand, if these are tied to one.
fn groups(machine: &Machine, twisting: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..machine.bodies.len()).collect();
    for &[a, b] in twisting {
        let (keep, other) = (group[a].min(group[b]), group[a].max(group[b]));
        // What stands ties nothing together.
        let turns = |body: usize| machine.places()[body].rotation.is_some();
        if turns(a) && turns(b) {
            group.iter_mut().filter(|own| **own == other).for_each(|own| *own = keep);
        }
    }
    let mut all: Vec<Vec<usize>> = Vec::new();
    for first in 0..group.len() {
        let members: Vec<usize> = (0..group.len()).filter(|&body| group[body] == first).collect();
        let turning: Vec<usize> =
            members.into_iter().filter(|&body| machine.places()[body].rotation.is_some()).collect();
        if turning.is_empty() {
            continue;
        }
        let on_ground = twisting.iter().find_map(|[a, b]| {
            let one = |a: usize, b: usize| {
                (turning.contains(&a) && machine.places()[b].rotation.is_none()).then_some(b)
            };
            one(*a, *b).or_else(|| one(*b, *a))
        });
        all.push(turning.into_iter().chain(on_ground).collect());
    }
    all
}
