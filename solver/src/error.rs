//! The error type of the solver, and what the readers of files say about their input.

mod periodic;
mod reduction;

use std::fmt;

pub use periodic::PeriodicError;
pub use reduction::{FreeMotion, ReductionError};

use crate::linalg::LinearAlgebraError;

/// One thing wrong in a file: where, what, and how to fix it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputError {
    /// Path of the file as the user gave it.
    pub file: String,
    /// Line, from 1; 0 where the whole file is meant.
    pub line: usize,
    /// Column in characters, from 1; 0 where the whole line is meant.
    pub column: usize,
    /// What is wrong, in the names of the file.
    pub what: String,
    /// How to fix it.
    pub help: String,
}

impl fmt::Display for InputError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.file)?;
        if self.line > 0 {
            write!(out, ":{}", self.line)?;
            if self.column > 0 {
                write!(out, ":{}", self.column)?;
            }
        }
        write!(out, ": {}", self.what)?;
        if !self.help.is_empty() {
            write!(out, "\n  help: {}", self.help)?;
        }
        Ok(())
    }
}

/// Everything wrong in a file, in the order of its lines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputErrors(pub Vec<InputError>);

impl fmt::Display for InputErrors {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.0.iter().enumerate() {
            if i > 0 {
                out.write_str("\n")?;
            }
            write!(out, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for InputErrors {}

/// What can go wrong between a mesh and a history.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A file of a mesh is wrong.
    #[error("{0}")]
    Input(#[from] InputErrors),
    /// A body that turns, of which nothing shows how.
    #[error(
        "{body} cannot be seen from space: {lack}. Give a joint, a disc or an output a set of nodes around its axis, or march it"
    )]
    NotRound {
        /// Its name.
        body: String,
        /// What it lacks.
        lack: String,
    },
    /// A joint whose coefficients depend on the frequency, beside a body that turns and is not round: one motion then has
    /// several frequencies.
    #[error(
        "the coefficients of {joint} depend on the frequency, but {body} turns and is not round: its motions have several frequencies each. Make {body} round, or give the coefficients over the speed alone"
    )]
    FrequenciesNotRound {
        /// The joint.
        joint: String,
        /// The body.
        body: String,
    },
    /// A law with states beside a joint whose coefficients are given over the frequency, in an analysis of small motions.
    #[error(
        "{joint} has the law {law}, which has states, and another joint has coefficients over the frequency: modes take one of both. Give that joint coefficients over the speed alone, or a law with states"
    )]
    Remembers {
        /// The joint.
        joint: String,
        /// The law.
        law: String,
    },
    /// A law with states beside a body that turns and is not round, in an analysis of small motions.
    #[error(
        "{joint} has the law {law}, which has states, but {body} turns and is not round: its motions have several frequencies each. Make {body} round, march the machine, or give the joint a law without states"
    )]
    RemembersNotRound {
        /// The joint.
        joint: String,
        /// The law.
        law: String,
        /// The body.
        body: String,
    },
    /// A law with states in a bore that turns, in a balance of forces.
    #[error(
        "the bore of {joint} turns, and its law {law} has states: they come to rest with the bore, while what stands in space does not. Begin at rest, or give the joint a law without states"
    )]
    RemembersTurning {
        /// The joint.
        joint: String,
        /// The law.
        law: String,
    },
    /// States of a law that no place gives rest.
    #[error(
        "{joint}: the states of its law {law} were found at rest nowhere: their rates have no zero where the balance was looked for, or hardly change about it. Begin at rest, or let each rate fall as its state grows"
    )]
    NoRest {
        /// The joint.
        joint: String,
        /// The law.
        law: String,
    },
    /// A state of a law without equilibrium.
    #[error(
        "{joint}: the state {state} of its law {law} has no equilibrium: where all forces balance it changes by {} {unit} a second, whatever it is. Begin at rest, let its rate fall as it grows, or leave open the speed that it is to bring about", whirl_text::shown(*rate, 5, 1e-3..1e6)
    )]
    NeverSettles {
        /// The joint.
        joint: String,
        /// Its law, and the state.
        law: String,
        /// Likewise.
        state: String,
        /// Its rate (SI), and the unit of the state.
        rate: f64,
        /// Likewise.
        unit: String,
    },
    /// Two bodies that are not round and turn at different speeds.
    #[error(
        "{} and {} are not round and turn at different speeds: their equations have no common period. Make one of them round, or march the machine",
        .bodies[0], .bodies[1]
    )]
    TwoNotRound {
        /// Their names.
        bodies: [String; 2],
    },
    /// A mesh names a set that it does not have.
    #[error("{origin} has no {kind} set called {name}{}", suggestion(.nearest))]
    MissingSet {
        /// File or maker of the mesh.
        origin: String,
        /// `node` or `element`.
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The nearest name that the mesh has.
        nearest: Option<String>,
    },
    /// A mesh whose parts do not fit together.
    #[error("{origin}: {what}")]
    Mesh {
        /// File or maker of the mesh.
        origin: String,
        /// What does not fit.
        what: String,
    },
    /// An element has no kernel for a form.
    #[error(
        "element {element} has no form called {form} (it has: {known}); is specs/forms/{form}.toml there?"
    )]
    MissingForm {
        /// Name of the element.
        element: String,
        /// Name of the form.
        form: String,
        /// Forms of the element.
        known: String,
    },
    /// A material lacks a property that a form needs.
    #[error("{origin}: material {material} has no {property}, which the form {form} needs")]
    MissingProperty {
        /// File or maker of the mesh.
        origin: String,
        /// Name of the material.
        material: String,
        /// Symbol of the property, such as `rho`.
        property: String,
        /// Name of the form.
        form: String,
    },
    /// Cells turned inside out.
    #[error("{}", inverted(.origin, .cells, *.count))]
    InvertedCells {
        /// File or maker of the mesh.
        origin: String,
        /// The first few, by label.
        cells: Vec<InvertedCell>,
        /// How many in all.
        count: usize,
    },
    /// A dimension of a generated mesh cannot be.
    #[error("{dimension} = {value} {what}: {help}")]
    Dimension {
        /// Name of the dimension, such as `bore_radius`.
        dimension: String,
        /// Its value with the unit.
        value: String,
        /// Why not, as what is said of it, such as `is not even`.
        what: String,
        /// What would do.
        help: String,
    },
    /// A constraint that repeats or contradicts others.
    #[error("{constraint} {what}")]
    Constraint {
        /// The constraint, by the name it was given.
        constraint: String,
        /// What is wrong with it, naming the others.
        what: String,
    },
    /// A spring to the ground beside which the body has no digits left.
    #[error(
        "{name} of {stiffness:.3e} N/m is {:.1e} times as stiff as the stiffest node of the body ({body:.1e} N/m), \
         at most {most:.0e} N/m is", .stiffness / .body
    )]
    StiffSpring {
        /// Its place among the springs, counted from 0.
        place: usize,
        /// How messages call it.
        name: String,
        /// N/m.
        stiffness: f64,
        /// Of the stiffest dof of the body (N/m).
        body: f64,
        /// The stiffest that is taken (N/m).
        most: f64,
    },
    /// A bearing law that the solver cannot use.
    #[error("law {law} {what}; {help}")]
    Law {
        /// Name of the law.
        law: String,
        /// The bearing that cannot use it, counted from 0; none if no bearing names the law.
        bearing: Option<usize>,
        /// What does not fit.
        what: String,
        /// How to fix it.
        help: String,
    },
    /// A ring of a bore that cannot carry springs: no spline goes through its nodes.
    #[error(
        "{bearing}: the bore's {} nodes on the {} must be at different angles about the axis, and at least three",
        nodes, ["left", "middle", "right"][*ring]
    )]
    Bore {
        /// Name of the bearing.
        bearing: String,
        /// Its place, counted from 0.
        place: usize,
        /// 0, 1, 2 for left, middle and right.
        ring: usize,
        /// Nodes of the ring.
        nodes: usize,
    },
    /// Several errors at once.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Several(Vec<Error>),
    /// Parts of a machine that do not fit together.
    #[error("{0}")]
    Machine(String),
    /// A law that has no value where a time step leads.
    #[error(
        "step {step} (t = {time:.6e} s) leads to a point at which the law `{law}` has no value, at bearing or stop \
         {bearing}: its formula gives no number there. Give the law a value wherever the journal may go, or find \
         out what drives it there"
    )]
    NoForce {
        /// The step, counted from 1.
        step: usize,
        /// Time at its end (s).
        time: f64,
        /// Name of the law.
        law: String,
        /// The bearing, counted from 1.
        bearing: usize,
    },
    /// A time step that no iteration solves.
    #[error(
        "step {step} (t = {time:.6e} s) does not converge, even in parts of {time_step:.2e} s: after \
         {iterations} iterations the residual is {residual:.2e} and the largest change of a spring force \
         {force_change:.2e} N; the largest contribution is that of {worst_dof}. A shorter time step or a law \
         without jumps and steep slopes may help"
    )]
    NewtonDiverged {
        /// The step, counted from 1.
        step: usize,
        /// Time at its end (s).
        time: f64,
        /// The shortest part tried (s).
        time_step: f64,
        /// Iterations made in it.
        iterations: usize,
        /// Norm of the residual, √(Σ r²/s).
        residual: f64,
        /// Largest change of a spring force in the last iteration (N).
        force_change: f64,
        /// The coordinate that contributes most to the residual.
        worst_dof: String,
    },
    /// Forces that no state balances at t = 0, or none that was found.
    #[error("{}", no_equilibrium(.rows, .journals, *.share))]
    NoEquilibrium {
        /// The coordinates whose rows are farthest from balance, and the forces left there (N, N·m).
        rows: Vec<(String, f64)>,
        /// Bearings with the largest eccentricities over their clearances.
        journals: Vec<(String, f64)>,
        /// The largest share of the loads for which a balance was found.
        share: f64,
    },
    /// Forces that are in balance only as far away as rounding lets them be.
    #[error(
        "there is no equilibrium: nothing holds the {} against the loads, and where forces seem to be in balance it has run away. \
         Add what holds it, such as a joint that takes up the couple or the force",
        .coordinates.join(", the ")
    )]
    RunsAway {
        /// The coordinates that run farthest.
        coordinates: Vec<String>,
    },
    /// Constant speeds at which no state was found in which the machine stands.
    #[error("no equilibrium was found with {at}: {}. {}", out_of_balance(.rows, .journals, *.share), remedy(.journals))]
    NotStanding {
        /// The bodies with their speeds.
        at: String,
        /// As of [`Error::NoEquilibrium`].
        rows: Vec<(String, f64)>,
        /// As there.
        journals: Vec<(String, f64)>,
        /// As there.
        share: f64,
    },
    /// A state in which the force of a joint jumps, so that small motions about it have no stiffness.
    #[error(
        "with {at} the force of {joint} jumps by {jump:.3e} N where the machine stands: nothing says what small motions \
         do there. Let the law change over a short distance or speed in place of a jump (`smooth`), or take another \
         speed or load"
    )]
    Jumps {
        /// The bodies with their speeds.
        at: String,
        /// The joint.
        joint: String,
        /// By how much (N).
        jump: f64,
    },
    /// A balance at t = 0 that is none: nothing holds the machine in it.
    #[error(
        "the start at equilibrium is not determined: nothing holds the {}. An unloaded journal floats in its \
         clearance, and a film carries only at speed: add a load, such as the weight, or give the speed, or start \
         at rest",
        .coordinates.join(", the ")
    )]
    Floating {
        /// The coordinates that move most in what nothing holds.
        coordinates: Vec<String>,
    },
    /// A state of another machine, whose coordinates mean something else.
    #[error(
        "the state is of other bodies: {}. Bodies keep their meaning where their mesh, material, modes, discs and the \
         sets that joints, drives and restraints retain stay as they are; laws, loads, drives, unbalance and damping may \
         change",
        .0.join("; ")
    )]
    OtherBodies(Vec<String>),
    /// A rotation that is prescribed otherwise than a state has it.
    #[error(
        "the rotation of {body} is prescribed to be at {angle:.6e} rad and {speed:.6e} rad/s at t = {time:.6e} s, \
         but the state from which it starts has {had_angle:.6e} rad and {had_speed:.6e} rad/s: prescribe a rotation \
         that continues from there, or let it turn freely"
    )]
    OtherRotation {
        /// Name of the body.
        body: String,
        /// Time of the state (s).
        time: f64,
        /// θ (rad) and θ̇ (rad/s) as prescribed.
        angle: f64,
        /// See `angle`.
        speed: f64,
        /// θ and θ̇ of the state.
        had_angle: f64,
        /// See `had_angle`.
        had_speed: f64,
    },
    /// A law whose force has no derivative where a machine stands or comes to.
    #[error(
        "{joint} with the law {law} has a force without a finite derivative {place}: its formula gives 0/0 or infinity there, as `sqrt(x^2)` does at x = 0. Keep roots and powers off zero, as in `sqrt(max(x^2, a^2))` with an a far below what matters"
    )]
    NoSlope {
        /// The joint.
        joint: String,
        /// Its law.
        law: String,
        /// Where, in words.
        place: String,
    },
    /// A joint beside which nothing else of a machine is seen, in an analysis of small motions.
    #[error(
        "{joint} with the law {law} has a stiffness or damping of {stiffness:.3e} (SI), beside which rounding hides how the machine moves: give it {most:.0e} at most, as what is a thousand times as stiff as the bodies that it joins already holds them"
    )]
    StiffJoint {
        /// The joint.
        joint: String,
        /// Its law.
        law: String,
        /// The largest of its stiffness and damping (SI).
        stiffness: f64,
        /// The largest that is taken.
        most: f64,
    },
    /// An analysis of small motions was asked to end within a speed.
    #[error("interrupted")]
    Interrupted,
    /// Linear algebra failed.
    #[error(transparent)]
    LinearAlgebra(#[from] LinearAlgebraError),
    /// A body could not be reduced to modes and retained dofs.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// There is no cycle, or no periodic motion was found.
    #[error("{0}")]
    Periodic(#[from] PeriodicError),
}

impl Error {
    /// Nothing, the only error, or all of them.
    pub(crate) fn of_all(mut errors: Vec<Error>) -> Result<(), Error> {
        match errors.len() {
            0 => Ok(()),
            1 => Err(errors.remove(0)),
            _ => Err(Error::Several(errors)),
        }
    }

    /// Whether it says that the machine does not stand at a speed, as at others it may.
    pub fn is_of_balance(&self) -> bool {
        matches!(
            self,
            Error::NotStanding { .. }
                | Error::RunsAway { .. }
                | Error::NoForce { .. }
                | Error::NoRest { .. }
                | Error::NeverSettles { .. }
                | Error::Jumps { .. }
                | Error::StiffJoint { .. }
                | Error::NoSlope { .. }
        )
    }

    /// Whether a matrix is singular: of a response at a critical speed without damping.
    pub fn is_singular(&self) -> bool {
        matches!(self, Error::LinearAlgebra(LinearAlgebraError::Singular { .. }))
    }

    /// The errors that it is made of: itself, or several.
    pub fn parts(&self) -> &[Error] {
        match self {
            Error::Several(errors) => errors,
            one => std::slice::from_ref(one),
        }
    }
}

/// A cell with det J ≤ 0 at one of its quadrature points.
#[derive(Debug, Clone, PartialEq)]
pub struct InvertedCell {
    /// Label in the source of the mesh.
    pub label: u64,
    /// Name of the element.
    pub element: String,
    /// The smallest det J over the quadrature points, m³.
    pub jacobian: f64,
}

fn no_equilibrium(rows: &[(String, f64)], journals: &[(String, f64)], share: f64) -> String {
    format!(
        "the start at equilibrium was not found: {}. Lower the loads to what the bearings carry, give the speed at which \
         they do, or start at rest",
        out_of_balance(rows, journals, share)
    )
}

/// What helps a machine to stand at a speed.
fn remedy(journals: &[(String, f64)]) -> &'static str {
    if journals.is_empty() {
        return "Look for a law that jumps where the loads are balanced, and let it change over a short distance (`smooth`), or \
                for loads that nothing carries";
    }
    "Lower the loads to what the bearings carry at this speed, or take a higher one; a law that jumps where the loads are \
     balanced must change over a short distance (`smooth`)"
}

fn out_of_balance(rows: &[(String, f64)], journals: &[(String, f64)], share: f64) -> String {
    let rows: Vec<String> =
        rows.iter().map(|(name, force)| format!("{name} by {force:.3e}")).collect();
    let journals: Vec<String> =
        journals.iter().map(|(name, ratio)| format!("{ratio:.3} in {name}")).collect();
    let journals = match journals.is_empty() {
        true => String::new(),
        false => format!("; the eccentricity ratios are {}", journals.join(", ")),
    };
    let share = match share > 0.0 {
        true => format!("; {:.0} % of the loads are balanced", 100.0 * share),
        false => String::new(),
    };
    format!("out of balance are {} (N or N·m){journals}{share}", rows.join(", "))
}

fn suggestion(nearest: &Option<String>) -> String {
    match nearest {
        Some(name) => format!("; did you mean {name}?"),
        None => String::new(),
    }
}

fn inverted(origin: &str, cells: &[InvertedCell], count: usize) -> String {
    let list: Vec<String> = cells
        .iter()
        .map(|cell| {
            format!(
                "cell {} ({}, smallest det J = {:.3e})",
                cell.label, cell.element, cell.jacobian
            )
        })
        .collect();
    let more = match count - cells.len() {
        0 => String::new(),
        rest => format!(" and {rest} more"),
    };
    format!(
        "{origin}: {}{more}: inverted or flat; usual reasons: nodes listed in another order \
         (Abaqus wants the second face on the side to which the first face's normal points), \
         a wrong node label, two nodes at one place, or a strongly distorted cell",
        list.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_error_reads_as_place_then_words() {
        let error = InputError {
            file: "a.inp".into(),
            line: 3,
            column: 7,
            what: "node 4 is not defined".into(),
            help: "define it".into(),
        };
        assert_eq!(error.to_string(), "a.inp:3:7: node 4 is not defined\n  help: define it");
    }
}
