//! The machine of a variant with stations along the body, its journals, and the state at the maximum continuous speed.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::assembly::mass_above;
use whirl_solver::cache::Cache;
use whirl_solver::linear::{LinearMachine, Linearised, Mode, Point, Standstill};
use whirl_solver::model::AttachmentKind;
use whirl_solver::output::{Motion, Wanted};
use whirl_text::shown;

use crate::analysis::stations;
use crate::case::{Analysis, Case, Gravity, Joint, JointKind, Lateral, NamedBody, Output};
use crate::errors::Failure;
use crate::machine::{self, PlannedBody};

/// m/s².
const GRAVITY: f64 = 9.80665;
/// Stations along a body with a mesh.
const STATIONS: usize = 41;
/// Loads of journals above so many times the weight are not of it alone.
const ABOVE: f64 = 1.01;
/// Loads of journals below this share of the weight are none.
const NOTHING: f64 = 1e-6;

/// A journal of the body.
#[derive(Debug, Clone)]
pub(super) struct Journal {
    /// Its joint, by its place.
    pub(super) joint: usize,
    /// The name of that.
    pub(super) name: Located,
    /// m.
    pub(super) z: f64,
    /// kg.
    pub(super) load: f64,
}

/// Of a mode with a modal mass of 1 kg: the mass of the body times the square of its motion across from which on it is one.
const ACROSS: f64 = 1e-4;

/// A machine as the analysis takes it.
pub(super) struct Model {
    pub(super) linear: LinearMachine,
    /// The body whose speed it is.
    pub(super) of: usize,
    /// The sense in which it turns in the case: 1 from x to y, −1 from y to x.
    pub(super) sense: f64,
    /// Those that the case knows.
    pub(super) points: Vec<Point>,
    /// z (m), rising, and the motion there.
    pub(super) stations: Vec<(f64, Point)>,
    /// By z, seals left out.
    pub(super) journals: Vec<Journal>,
    /// Points of joints that have a clearance, with it (m, diametral).
    pub(super) clearances: Vec<(String, f64)>,
    /// The state at N_mc and its equations.
    pub(super) at: Standstill,
    pub(super) equations: Linearised,
    /// Mass beyond the first and the last journal (kg).
    pub(super) overhung: [f64; 2],
    /// What is said of the loads.
    pub(super) notes: String,
}

impl Model {
    /// Whether a mode moves the body across its axis, and not along or about it alone.
    pub(super) fn moves_across(&self, mode: &Mode) -> bool {
        let across = self.stations.iter().map(|own| {
            let motion = self.linear.motion_in(&self.at, &own.1, mode);
            motion.orbit().major
        });
        let most = across.fold(0.0, f64::max);
        let mass = self.linear.machine().bodies[self.of].centre_of_mass().mass;
        mass * most * most > ACROSS
    }

    /// Builds it.
    ///
    /// # Errors
    /// As the machine's; a body without journals, or one that is not round.
    pub(super) fn new(
        case: &Case,
        (analysis, lateral): (&Analysis, &Lateral),
        without_seals: bool,
        (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    ) -> Result<Model, Failure> {
        let mut own = case.clone();
        let of = body(&own, analysis)?;
        let sense = if own.machine.fastest(of, own.run()) < 0.0 { -1.0 } else { 1.0 };
        let of_motion =
            |own: &Output| matches!(own.what, Wanted::Motion { motion: Motion::Displacement, .. });
        own.outputs.retain(of_motion);
        own.fields = None;
        let plan = machine::plan(&own, &mut Vec::new())?;
        let mut journals = Vec::new();
        let mut clearances = Vec::new();
        for (place, joint) in own.machine.joints.iter().enumerate() {
            if !carries(joint, of) {
                continue;
            }
            let clearance = 2.0 * plan.clearance(place).0;
            if clearance > 0.0 && joint.kind != JointKind::Bushing {
                clearances.push((format!("joint.{}", joint.name.text()), clearance));
            }
            if !lateral.seals.contains(&place) {
                journals.push(Journal {
                    joint: place,
                    name: joint.name.clone(),
                    z: stations::middle(&plan, place),
                    load: 0.0,
                });
            }
        }
        journals.sort_by(|a, b| a.z.total_cmp(&b.z));
        let (Some(first), Some(last)) = (journals.first(), journals.last()) else {
            return Err(no_journal(&own, of));
        };
        let ends = [first.z, last.z];
        let named = &own.machine.bodies[of];
        let overhung = overhung(named, &plan.bodies[of], ends)?;
        let joints: Vec<f64> = journals.iter().map(|own| own.z).collect();
        let mut levels = stations::levels(named, &plan.bodies[of], &joints, STATIONS);
        let stages = lateral.stages.iter().filter_map(|own| own.z);
        let planes = lateral.unbalance.iter().flat_map(|own| own.planes.iter().map(|own| own.z));
        // A body of matrices has its nodes only: of what nobody placed the nearest one is taken.
        let by_nodes = plan.bodies[of].meshed().is_some_and(|own| own.mesh.matrices().is_some());
        let midway = (!by_nodes).then_some(0.5 * (ends[0] + ends[1]));
        levels.extend(stages.chain(planes).chain(lateral.cross_coupling_z.or(midway)));
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        for (number, z) in levels.iter().enumerate() {
            own.outputs.push(stations::station(&own, of, *z, number));
        }
        if without_seals {
            let mut number = 0;
            own.machine.joints.retain(|_| {
                number += 1;
                !lateral.seals.contains(&(number - 1))
            });
            for journal in &mut journals {
                journal.joint -= lateral.seals.iter().filter(|own| **own < journal.joint).count();
            }
        }
        let built = machine::build_planned(&own, cache, warnings)?;
        let linear = LinearMachine::new(built.machine)?;
        let mut points = linear.points();
        let stations = points.split_off(points.len() - levels.len());
        let speeds = linear.speeds(of, sense * lateral.maximum, &analysis.ratios);
        let at = linear.standing(&speeds, None)?;
        let equations = linear.linearised(&at)?;
        if !equations.stands_in_space() {
            return Err(Failure::Argument {
                message: format!("a body of `{}` that turns is not round", own.name),
                help: "a lateral analysis is of round rotors: give the mesh three or more equal sectors".to_owned(),
            });
        }
        let mut model = Model {
            linear,
            of,
            sense,
            points,
            stations: levels.into_iter().zip(stations).collect(),
            journals,
            clearances,
            at,
            equations,
            overhung,
            notes: String::new(),
        };
        if !without_seals {
            let by_weight = || under_weight(own, analysis, (of, sense * lateral.maximum), cache);
            model.load(lateral, by_weight)?;
        }
        Ok(model)
    }

    /// The loads of the journals (kg): as the case says, as the joints carry them at N_mc, or by the weight along x where
    /// nothing loads them.
    fn load(
        &mut self,
        lateral: &Lateral,
        by_weight: impl FnOnce() -> Result<Vec<f64>, Failure>,
    ) -> Result<(), Failure> {
        let weight = self.linear.machine().bodies[self.of].centre_of_mass().mass * GRAVITY;
        let mut found = carried(&self.linear, &self.at);
        let is_told = |own: &Journal| lateral.journal_loads.iter().any(|told| told.0 == own.joint);
        if self.journals.iter().all(|own| found[own.joint] < NOTHING * weight)
            && !self.journals.iter().all(is_told)
        {
            found = by_weight()?;
        }
        for own in &mut self.journals {
            let told = lateral.journal_loads.iter().find(|told| told.0 == own.joint);
            own.load = told.map_or(found[own.joint], |told| told.1) / GRAVITY;
        }
        let (sum, mass) = (self.journals.iter().map(|own| own.load).sum::<f64>(), weight / GRAVITY);
        if lateral.journal_loads.is_empty() && sum > ABOVE * mass {
            self.notes = format!(
                "note: the journals carry {} kg, more than the mass of {}, {} kg: other loads than its weight are in W and with it in \
                 U_a. Give those of the weight by `journal_loads` if unbalance should go by these\n",
                shown(sum, 5, 1e-4..1e7),
                self.linear.machine().bodies[self.of].name(),
                shown(mass, 5, 1e-4..1e7)
            );
        }
        Ok(())
    }

    /// The station nearest to z (m).
    pub(super) fn station(&self, z: f64) -> &Point {
        let away = |own: &&(f64, Point)| (own.0 - z).abs();
        let nearest = self.stations.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        &nearest.expect("a station").1
    }

    /// z of the first and the last journal (m).
    pub(super) fn span(&self) -> [f64; 2] {
        [self.journals[0].z, self.journals[self.journals.len() - 1].z]
    }

    /// A point that the case knows, by its name.
    ///
    /// # Errors
    /// There is none.
    pub(super) fn point(&self, name: &Located) -> Result<Point, Failure> {
        let own = self.points.iter().find(|own| own.name == name.text());
        own.cloned().ok_or_else(|| {
            let known: Vec<&str> = self.points.iter().map(|own| own.name.as_str()).collect();
            let message = format!("there is no point `{}`", name.text());
            let help = format!(
                "name one of `{}`, or add an `[output.NAME]` with `quantity = \"displacement\"`",
                known.join("`, `")
            );
            let mut errors = Diagnostics::new();
            errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
            Failure::Input(errors)
        })
    }
}

/// What each joint carries across the axis (N) in a state.
fn carried(linear: &LinearMachine, at: &Standstill) -> Vec<f64> {
    linear.coefficients(at).iter().map(|own| own.force[0].hypot(own.force[1])).collect()
}

/// The same where the machine hangs along −x, with its body at a speed (rad/s).
///
/// # Errors
/// As the machine's; it does not stand there.
fn under_weight(
    mut case: Case,
    analysis: &Analysis,
    (of, speed): (usize, f64),
    cache: Option<&Cache>,
) -> Result<Vec<f64>, Failure> {
    let place = case.machine.bodies[of].name.clone();
    case.machine.gravity = Some(Gravity { acceleration: [-GRAVITY, 0.0, 0.0], place });
    let linear =
        LinearMachine::new(machine::build_planned(&case, cache, &mut Vec::new())?.machine)?;
    let at = linear.standing(&linear.speeds(of, speed, &analysis.ratios), None);
    let at = at.map_err(|error| Failure::Argument {
        message: format!(
            "nothing in the case loads the journals, and its weight along x cannot: {error}"
        ),
        help: "give the case its `gravity`, or the loads of all journals by `journal_loads`"
            .to_owned(),
    })?;
    Ok(carried(&linear, &at))
}

/// As [`super::foreseen`].
pub(super) fn foreseen(case: &Case, analysis: &Analysis) -> Result<(), Failure> {
    let of = body(case, analysis)?;
    let seals = analysis.lateral.as_deref().map_or(&[][..], |own| own.seals.as_slice());
    let mut joints = case.machine.joints.iter().enumerate();
    match joints.any(|(place, own)| carries(own, of) && !seals.contains(&place)) {
        true => Ok(()),
        false => Err(no_journal(case, of)),
    }
}

/// Whether a joint may be a journal of a body.
fn carries(joint: &Joint, of: usize) -> bool {
    let is_on = joint.sides.iter().any(|side| side.body == Some(of));
    is_on && joint.kind != JointKind::Coupling
}

fn no_journal(case: &Case, of: usize) -> Failure {
    Failure::Argument {
        message: format!(
            "`{}` has no journal: a lateral analysis needs its loads",
            case.machine.bodies[of].name.text()
        ),
        help: "add a `[joint.NAME]` that carries the body, and name seals only in `seals`"
            .to_owned(),
    }
}

/// The body whose speed it is: the one that the case names, or the fastest.
fn body(case: &Case, analysis: &Analysis) -> Result<usize, Failure> {
    let top = |body: usize| case.machine.top_speed(body, case.run());
    let turning = (0..case.machine.bodies.len()).filter(|body| case.machine.bodies[*body].turns());
    let fastest = turning.max_by(|a, b| top(*a).total_cmp(&top(*b)).then(b.cmp(a)));
    analysis.of.or(fastest).ok_or_else(|| Failure::Argument {
        message: format!("nothing turns in `{}`: it has no lateral analysis", case.name),
        help: "give a body `turns = \"prescribed\"` and a `speed`".to_owned(),
    })
}

/// Mass beyond the outer journals (kg).
fn overhung(body: &NamedBody, planned: &PlannedBody, ends: [f64; 2]) -> Result<[f64; 2], Failure> {
    let carried = |beyond: &dyn Fn(f64) -> bool| -> f64 {
        let own = body.attached.iter().filter(|own| beyond(own.z));
        own.map(|own| match own.what {
            AttachmentKind::Disc { mass, .. } | AttachmentKind::Mass { mass, .. } => mass,
            AttachmentKind::Unbalance(_) => 0.0,
        })
        .sum()
    };
    let mut both = [carried(&|z| z < ends[0]), carried(&|z| z > ends[1])];
    if let Some(plan) = planned.meshed() {
        let whole = mass_above(&plan.mesh, f64::NEG_INFINITY)?;
        both[0] += whole - mass_above(&plan.mesh, ends[0])?;
        both[1] += mass_above(&plan.mesh, ends[1])?;
    }
    Ok(both)
}
