//! The variables of a unit: outputs are columns of the history, inputs the loads, couples and speeds of the case, parameters
//! keys of it. Their value references count from 0 in this order.

use whirl_codegen::units::Dimension;
use whirl_solver::history::Column;
use whirl_solver::loads::{Action, Load};
use whirl_solver::model::LoadAction;

use super::parameters::Parameter;
use crate::case::Case;
use crate::machine::Built;

/// A variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// Its unit, as a case would write it; `1` of a number.
    pub unit: String,
    /// What it stands for.
    pub role: Role,
    /// Its value where nothing else is said; none of an output.
    pub start: Option<f64>,
}

/// What a variable stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A column of the history, by its place.
    Output(usize),
    /// A part along x, y or z (0, 1, 2) of a load, by its place among those that can be told.
    Load(usize, usize),
    /// The speed of a body, by its place among those that can be told.
    Speed(usize),
    /// A key of the case, by its place among the parameters.
    Parameter(usize),
}

/// All variables, with what inputs act on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Variables {
    /// In the order of their value references.
    pub(crate) all: Vec<Variable>,
    /// The loads that can be told.
    pub(crate) loads: Vec<ToldGroup>,
    /// The bodies of which the speed can be told, by their places.
    pub(crate) speeds: Vec<usize>,
}

/// A load of the case as the machine has it: on each node of a set, or as a pair of forces.
#[derive(Debug, Clone, PartialEq)]
pub struct ToldGroup {
    /// Loads of the machine, by their places.
    pub loads: Vec<usize>,
    /// Along x, y, z as the case has it (N, N·m, or a factor on a table that has the unit).
    pub start: [f64; 3],
    /// How far the two nodes of a pair of forces are apart along x (m), if the couple is one.
    arm: Option<f64>,
}

impl ToldGroup {
    /// The amplitude of the `place`-th load of the group where the whole is `value`.
    pub fn amplitude(&self, place: usize, value: [f64; 3]) -> [f64; 3] {
        match self.arm {
            Some(arm) => {
                let half = value[2] / arm;
                [0.0, if place == 0 { half } else { -half }, 0.0]
            }
            None => value,
        }
    }
}

/// Columns that say nothing of the machine: time is no variable of a unit, iterations are of the method.
const NO_OUTPUTS: [&str; 2] = ["t_s", "iterations"];

impl Variables {
    /// The variables of a case with its machine.
    pub(crate) fn of(case: &Case, built: &Built, parameters: &[Parameter]) -> Variables {
        let mut own = Variables { all: Vec::new(), loads: Vec::new(), speeds: Vec::new() };
        for (place, Column { name, unit, meaning }) in built.columns().into_iter().enumerate() {
            if !NO_OUTPUTS.contains(&name.as_str()) {
                own.all.push(Variable {
                    name,
                    description: meaning,
                    unit: unit.to_string(),
                    role: Role::Output(place),
                    start: None,
                });
            }
        }
        own.add_loads(case, built);
        own.add_speeds(built);
        for (place, parameter) in parameters.iter().enumerate() {
            own.all.push(Variable {
                name: parameter.key.clone(),
                description: format!("`{}` of the case", parameter.key),
                unit: parameter.unit().to_owned(),
                role: Role::Parameter(place),
                start: Some(parameter.start),
            });
        }
        own
    }

    fn add_loads(&mut self, case: &Case, built: &Built) {
        for own in &case.machine.loads {
            let name = format!("load.{}", own.name.text());
            let scaled = own.load.table.as_ref();
            let scaled = scaled.is_none_or(|(own, _)| own.measures[1] == Dimension::NUMBER);
            let frame = match own.load.frame {
                whirl_solver::loads::Frame::Body => "turning with the body",
                whirl_solver::loads::Frame::Space => "fixed in space",
            };
            let varies = match own.load.time_function {
                whirl_solver::loads::TimeFunction::Constant => "",
                _ => ", times what the case says of its variation",
            };
            let on = case.machine.bodies[own.body].name.text();
            let words = |what: &str| format!("{what} on {on}, {frame}{varies}");
            self.add_load(built, &name, (own.load.acting, scaled), &words);
        }
        for drive in case.machine.drives.iter().filter(|own| own.couple.acts) {
            let name = format!("drive.{}", drive.name.text());
            let on = case.machine.bodies[drive.body].name.text();
            let (torque, until) = match drive.couple.table.is_some() {
                true => (1.0, ", as a factor on its table"),
                false => (drive.couple.torque, ", until its target speed is reached"),
            };
            let couple = LoadAction::Couple([0.0, 0.0, torque]);
            let words = |what: &str| format!("driving {what} on {on}{until}");
            self.add_drive(built, &name, (couple, drive.couple.table.is_none()), &words);
        }
    }

    /// A load with a variable for each of its parts.
    fn add_load(
        &mut self,
        built: &Built,
        name: &str,
        (acting, scaled): (LoadAction, bool),
        words: &dyn Fn(&str) -> String,
    ) {
        let Some(group) = told_group(built, name, acting) else { return };
        let axes: &[usize] = if group.arm.is_some() { &[2] } else { &[0, 1, 2] };
        self.add_group(group, (name, axes), (acting, scaled), words);
    }

    /// A couple about the axis.
    fn add_drive(
        &mut self,
        built: &Built,
        name: &str,
        (acting, scaled): (LoadAction, bool),
        words: &dyn Fn(&str) -> String,
    ) {
        let Some(group) = told_group(built, name, acting) else { return };
        self.add_group(group, (name, &[2]), (acting, scaled), words);
    }

    fn add_group(
        &mut self,
        group: ToldGroup,
        (name, axes): (&str, &[usize]),
        (acting, scaled): (LoadAction, bool),
        words: &dyn Fn(&str) -> String,
    ) {
        let (letter, what, unit) = match acting {
            LoadAction::Force(_) => ("f", "force along", "N"),
            LoadAction::Couple(_) => ("m", "couple about", "N*m"),
        };
        for &axis in axes {
            let along = ["x", "y", "z"][axis];
            self.all.push(Variable {
                name: format!("{name}.{letter}{along}"),
                description: words(&format!("{what} {along}")),
                unit: if scaled { unit.to_owned() } else { "1".to_owned() },
                role: Role::Load(self.loads.len(), axis),
                start: Some(group.start[axis]),
            });
        }
        self.loads.push(group);
    }

    fn add_speeds(&mut self, built: &Built) {
        for (place, body) in built.machine.bodies.iter().enumerate() {
            let Some(speed) = body.rotation().and_then(|own| own.told_speed()) else { continue };
            let name = body.name();
            self.all.push(Variable {
                name: format!("speed.{name}"),
                description: format!(
                    "speed of {name}, reached in proportion to time at the end of a communication step"
                ),
                unit: "rad/s".to_owned(),
                role: Role::Speed(self.speeds.len()),
                start: Some(speed),
            });
            self.speeds.push(place);
        }
    }
}

/// The loads of the machine that a load of the case has become; none where it acts on nothing.
fn told_group(built: &Built, name: &str, acting: LoadAction) -> Option<ToldGroup> {
    let all = built.machine.loads.iter().enumerate();
    let own: Vec<(usize, &Load)> = all.filter(|(_, load)| load.name == name).collect();
    let (LoadAction::Force(start) | LoadAction::Couple(start)) = acting;
    let arm = match (acting, own.as_slice()) {
        (LoadAction::Couple(_), [(_, first), (_, second)]) => match (&first.action, &second.action)
        {
            (Action::Force { node: top, .. }, Action::Force { node: bottom, .. }) => {
                Some(top.position[0] - bottom.position[0])
            }
            _ => None,
        },
        _ => None,
    };
    let loads: Vec<usize> = own.into_iter().map(|(place, _)| place).collect();
    (!loads.is_empty()).then_some(ToldGroup { loads, start, arm })
}
