//! The start of a machine in equilibrium at speed.
//!
//! A shaft that turns at a constant speed under loads fixed in space has a deflection η_s that stands in space, so that it
//! moves in the frame that turns: η̇_s = θ̇ L η_s, L = −S of a round body ([`crate::roundness`]), and η̈_s = θ̇² L² η_s. What the
//! centrifugal load does, η_c, turns with the frame and rests in it. Bodies that stand are at rest. The joints act with these
//! rates, the damping of the shaft does (`balance`). Left out are the loads that turn: unbalance, forces fixed to a body; so a
//! machine that has some starts with a transient.
//!
//! In a march by the trapezoidal rule in equal steps what turns by ΩΔt a step has rates as if its speed were
//! ω̃ = (2/Δt) tan(ΩΔt/2). With these in place of Ω the discrete motion stands exactly still.

mod balance;
mod rotations;
mod search;
mod settled;
#[cfg(test)]
mod standing;
#[cfg(test)]
mod tests;
mod turning;

use balance::Balance;
use search::{Found, Nearest, floating, search};
use turning::TurningStart;

use crate::bearing::{Hold, LONG, Plane};
use crate::dynamics::marching::BodyStart;
#[cfg(doc)]
use crate::dynamics::marching::MarchOptions;
use crate::equations::{Equations, State, Tangents, frame_of};
use crate::error::Error;
use crate::linalg::{FirstOrder, Matrix};
use crate::machine::Machine;

/// A state that stands in space at speeds that stay.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Standing {
    /// q, q̇ and q̈ at t = 0.
    pub(crate) state: State,
    /// The unknowns of the balance, from which another may begin.
    pub(crate) unknowns: Vec<f64>,
    /// Eccentricity over clearance in each bearing, with its name; none where it has no clearance.
    pub(crate) eccentricities: Vec<(String, Option<f64>)>,
    /// Displacement of the journal against the bore in each (m, along x and y of space).
    pub(crate) displacements: Vec<[f64; 2]>,
    /// Force on the journal in each (N, along x and y of space).
    pub(crate) forces: Vec<[f64; 2]>,
    /// Torque on the section of the journal about its own centre in each (N·m).
    pub(crate) torques: Vec<f64>,
    /// As [`Equilibrium::left`].
    pub(crate) left: f64,
    /// By load whether it does not act on small motions, as it turns with a body, and whether it has ended.
    pub(crate) released: Vec<bool>,
    pub(crate) ended: Vec<bool>,
    /// Of small motions about it, in the frames of the bodies.
    pub(crate) tangents: Tangents,
    /// States of laws beside them, which stand still in the tangents.
    pub(crate) remembered: Option<FirstOrder>,
}

/// The state of round bodies at speeds that stay, with what begins at t = 0 acting and without what turns with bodies.
/// `speeds`: θ̇ (rad/s) of all bodies that turn at a known one, by their places; those of the others are found. `generators`: S and
/// S² of the bodies that turn. `from`: unknowns of a state nearby.
///
/// # Errors
/// As [`equilibrium`], but for what nothing holds.
pub(crate) fn standing_at(
    machine: &Machine,
    speeds: &[Option<f64>],
    generators: &[Option<[Matrix; 2]>],
    from: Option<&[f64]>,
) -> Result<Standing, Error> {
    let turning = |body: usize| {
        let shaft = machine.bodies[body].shaft().expect("a body that turns");
        let [once, twice] = generators[body].as_ref().expect("its generator");
        TurningStart::round(shaft, once, twice.clone())
    };
    refuse_turning(machine)?;
    let mut balance = Balance::steady(machine, speeds, &turning)?;
    if let Err(nearest) = search(&mut balance, from)? {
        return Err(unbalanced(&mut balance, &nearest));
    }
    // At speeds that are told a controller of the speed has nothing to find.
    let going_on = settled::unsettled(&mut balance)?;
    if !going_on.is_empty() && !settled::freeze(&mut balance, &going_on)? {
        return Err(never_settles(&balance, going_on[0]));
    }
    // What turns with a body acts on no small motion but by its couple on the rotation.
    let ended: Vec<bool> =
        machine.loads.iter().map(|load| machine.ends(load, &balance.state.v)).collect();
    let both = machine.loads.iter().zip(&ended);
    let released =
        both.map(|(load, ended)| load.turns_with_its_body() || *ended).collect::<Vec<_>>();
    let left = balance.worst();
    let (eccentricities, unknowns) = (balance.ratios(), balance.unknowns());
    let mut state = balance.state.clone();
    // Couples that are not in balance load what ties bodies of a train as they accelerate it; its speed is told and stays.
    state.a[..machine.rotations()].fill(0.0);
    let displacements = balance.eccentricities(&state.q);
    balance.equations.release(&released);
    balance.equations.evaluate(0.0, &state);
    let forces = forces(&balance.equations, &state);
    let joints = machine.monitors.iter();
    let torques = joints.map(|joint| balance.equations.joint_torque(joint)).collect();
    let mut tangents = balance.equations.tangents(&state);
    let mut remembered = None;
    if machine.springs.states() > 0 {
        // Small motions have states of their own; joints are told as they are when these have come to rest, and with what they have
        // integrated.
        balance.equations.springs.keep_states(&mut state.laws);
        let mut rest = state.clone();
        rest.laws.hold = Hold::Rest;
        balance.equations.evaluate(0.0, &rest);
        let planes = balance.equations.tangents(&rest).planes;
        balance.equations.evaluate(0.0, &state);
        tangents = Tangents { planes, ..balance.equations.tangents(&state) };
        remembered = balance.equations.first_order(&state);
    }
    Ok(Standing {
        state,
        unknowns,
        eccentricities,
        displacements,
        forces,
        torques,
        left,
        released,
        ended,
        tangents,
        remembered,
    })
}

/// Refuses laws with states and films in bores that turn: they come to rest with the bore.
fn refuse_turning(machine: &Machine) -> Result<(), Error> {
    let turns = |plane: &Plane| {
        machine.places()[machine.monitors[plane.bearing].bodies[1]].rotation.is_some()
    };
    let springs = &machine.springs;
    match springs.remembering(turns).or_else(|| springs.with_film(turns)) {
        Some(plane) => {
            let (joint, law) = machine.names_of(plane);
            Err(Error::RemembersTurning { joint, law })
        }
        None => Ok(()),
    }
}

/// Forces of all joints on their journals at the state that was evaluated last (N, along x and y of space).
fn forces(equations: &Equations, state: &State) -> Vec<[f64; 2]> {
    let machine = equations.machine;
    let joints = machine.monitors.iter().map(|joint| {
        frame_of(machine, joint.bodies[0], &state.q).to_space(equations.joint_force(joint))
    });
    joints.collect()
}

/// The rows that an error names.
const NAMED: usize = 3;

/// A machine in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// How the bodies begin, in their order.
    pub bodies: Vec<BodyStart>,
    /// Eccentricity of the journal over the clearance in each bearing, with its name; none where it has no clearance.
    pub eccentricities: Vec<(String, Option<f64>)>,
    /// The largest force that is left in a row, over what it may be by 1e-6 of the row's largest term, 1e-9 of the largest
    /// force projected on it, and rounding: at most 1.
    pub left: f64,
    /// Iterations in all.
    pub iterations: usize,
}

/// The state in which all forces are balanced at t = 0. `speeds`: θ̇ (rad/s) of bodies that turn freely, by their places; of
/// one without it the speed is found at which no couple acts on it. Bodies on torsional couplings have one speed, and the
/// angles at which these carry the couples. `step`: Δt (s) of the march, if it takes equal steps by the trapezoidal rule
/// ([`MarchOptions::equal_step`]).
///
/// # Errors
/// There is none, or it was not found: what is out of balance; nothing holds the machine.
pub fn equilibrium(
    machine: &Machine,
    speeds: &[Option<f64>],
    step: Option<f64>,
) -> Result<Equilibrium, Error> {
    refuse_turning(machine)?;
    let mut balance = Balance::new(machine, speeds, step)?;
    let Found { iterations } = match search(&mut balance, None)? {
        Ok(found) => found,
        Err(nearest) => return Err(unbalanced(&mut balance, &nearest)),
    };
    if let Some(&place) = settled::unsettled(&mut balance)?.first() {
        return Err(never_settles(&balance, place));
    }
    let left = balance.worst();
    if let Some(rows) = floating(&mut balance) {
        if let Some(error) = without_slope(&balance) {
            return Err(error);
        }
        let coordinates = rows.iter().map(|&row| coordinate(&balance, row)).collect();
        return Err(Error::Floating { coordinates });
    }
    let bodies = machine.places().iter().enumerate().map(|(body, place)| BodyStart {
        angle: place.rotation.map_or(0.0, |theta| balance.state.q[theta]),
        speed: balance.speed(body),
        position: balance.state.q[place.flexible.clone()].to_vec(),
        velocity: balance.state.v[place.flexible.clone()].to_vec(),
    });
    Ok(Equilibrium { bodies: bodies.collect(), eccentricities: balance.ratios(), left, iterations })
}

/// A state, by its place among all, that never comes to rest.
fn never_settles(balance: &Balance, place: usize) -> Error {
    let named = balance.machine.springs.named_state(place);
    let (plane, law, state) = named.expect("a state of some law");
    Error::NeverSettles {
        joint: balance.machine.names_of(plane).0,
        law: law.to_owned(),
        state: state.name.clone(),
        rate: balance.states()[place] / LONG,
        unit: state.unit.clone(),
    }
}

/// A law whose force has no derivative where the search came to.
fn without_slope(balance: &Balance) -> Option<Error> {
    let plane = balance.equations.springs.without_slope(&balance.machine.springs)?;
    let (joint, law) = balance.machine.names_of(plane);
    Some(Error::NoSlope {
        joint,
        law,
        place: "where the search for the equilibrium ends".to_owned(),
    })
}

/// What is out of balance where the search came nearest.
fn unbalanced(balance: &mut Balance, nearest: &Nearest) -> Error {
    if let Err(error) = balance.set(&nearest.z) {
        return error;
    }
    if let Some((law, bearing)) = balance.equations.springs.without_value(&balance.machine.springs)
    {
        let remembers =
            |own: &Plane| own.bearing == bearing && balance.machine.names_of(own).1 == law;
        if let Some(plane) = balance.machine.springs.remembering(remembers) {
            return Error::NoRest { joint: balance.machine.names_of(plane).0, law };
        }
        return Error::NoForce { step: 0, time: 0.0, law, bearing: bearing + 1 };
    }
    if let Some(error) = without_slope(balance) {
        return error;
    }
    if !balance.gone.is_empty() {
        let mut rows = balance.gone.clone();
        let size = |row: &usize| balance.state.q[balance.places[*row]].abs();
        rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
        rows.truncate(NAMED);
        let coordinates = rows.iter().map(|&row| coordinate(balance, row)).collect();
        return Error::RunsAway { coordinates };
    }
    let mut rows: Vec<usize> = (0..balance.force.len()).collect();
    let share = |row: &usize| balance.share_of(*row);
    rows.sort_by(|a, b| share(b).total_cmp(&share(a)));
    // Where all are balanced to what was asked for, the search could not tell a balance from what is near it.
    let least = rows.first().map_or(1.0, |row| share(row).min(1.0));
    let out = rows.iter().filter(|row| share(row) >= least).take(NAMED);
    let out = out.map(|&row| (coordinate(balance, row), balance.force[row]));
    let mut journals: Vec<(String, f64)> = balance
        .ratios()
        .into_iter()
        .filter_map(|(name, ratio)| ratio.map(|ratio| (name, ratio)))
        .collect();
    journals.sort_by(|a, b| b.1.total_cmp(&a.1));
    journals.truncate(NAMED);
    Error::NoEquilibrium { rows: out.collect(), journals, share: nearest.share }
}

fn coordinate(balance: &Balance, row: usize) -> String {
    let name = balance.machine.coordinate(balance.places[row]);
    if row < balance.flexible { name } else { name.replace("rotation angle", "speed") }
}
