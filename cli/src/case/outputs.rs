//! The tables `[output.NAME]`: what the history has beside its usual columns.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::Acts;
use whirl_solver::bearing::MotionKind;
use whirl_solver::loads::Frame;
use whirl_solver::output::{self, JointQuantity, Motion};

use super::joined_machine::JoinedMachine;
use super::joint::JointKind;
use super::named_body::{Form, NamedBody};
use super::names;

/// Which point of a body an output is of.
#[derive(Debug, Clone)]
pub(crate) enum OutputPoint {
    /// The node of a set, or the mean of its nodes, of a body with a mesh.
    Set(Located),
    /// The mean of the section at a z (m) of a body with a mesh, and where the case says it.
    Section(f64, Located),
    /// At a z of a rigid body (m); its centre if the case does not say it.
    At(Option<f64>),
}

/// An output with its point as the case says it.
pub(crate) type Output = output::Output<OutputPoint>;

type Wanted = output::Wanted<OutputPoint>;

/// All outputs of a file that are right.
pub(super) fn read(file: &Table, machine: Option<&JoinedMachine>) -> Vec<Output> {
    let tables = names::in_order(file, "output");
    let labels: Vec<Located> = tables.iter().map(|(name, _)| name.clone()).collect();
    names::distinct(file, "output", &labels);
    let read = |(name, table): (Located, Table)| {
        let what = table.read(|table| read_one(table, machine))?;
        Some(Output { name: name.text().to_owned(), what })
    };
    let marches = file.has("march");
    match machine {
        Some(machine) if marches && tables.is_empty() && machine.joints.is_empty() => {
            of_bodies(machine)
        }
        _ => tables.into_iter().filter_map(read).collect(),
    }
}

/// Without joints no usual column of a history shows a motion: the displacement of every rigid body does.
fn of_bodies(machine: &JoinedMachine) -> Vec<Output> {
    let bodies = machine.bodies.iter().enumerate();
    let rigid = bodies.filter(|(_, own)| matches!(own.form, Form::Rigid(_)));
    let displacement = |(body, own): (usize, &NamedBody)| Output {
        name: own.name.text().to_owned(),
        what: Wanted::Motion {
            body,
            point: OutputPoint::At(None),
            motion: Motion::Displacement,
            frame: Frame::Space,
            components: vec![0, 1],
        },
    };
    rigid.map(displacement).collect()
}

/// What can be asked for.
pub(super) const QUANTITIES: [&str; 14] = [
    "displacement",
    "velocity",
    "acceleration",
    "force",
    "deformation",
    "rate",
    "moment",
    "tilt",
    "axial_force",
    "axial_deformation",
    "energy",
    "power",
    "film",
    "states",
];

/// Keys that some quantities have no use for.
const OF_SOME: [&str; 4] = ["set", "z", "frame", "components"];

fn read_one(table: &Table, machine: Option<&JoinedMachine>) -> Option<Wanted> {
    let (body, joint) = (table.optional_string("body"), table.optional_string("joint"));
    let (set, z) = (table.optional_string("set"), table.quantity("z"));
    let frame = match table.optional_word("frame") {
        Some("body") => Frame::Body,
        _ => Frame::Space,
    };
    let components = components(table);
    let quantity = table.optional_word("quantity")?;
    let (used, of_body, of_joint): (&[&str], bool, bool) = match quantity {
        "displacement" | "velocity" | "acceleration" => (&OF_SOME, true, false),
        "force" | "deformation" | "rate" | "moment" | "tilt" => (&["frame"], false, true),
        "axial_force" | "axial_deformation" | "film" | "states" => (&[], false, true),
        "energy" => (&[], true, false),
        _ => (&[], true, true),
    };
    for key in OF_SOME.into_iter().filter(|key| !used.contains(key) && table.has(key)) {
        let message = format!("`{key}` has no effect on the quantity `{quantity}`");
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help("leave it out"));
    }
    let (body, joint) = match (body, joint) {
        (Some(_), Some(_)) => {
            table.conflict("body", "joint");
            return None;
        }
        (None, None) => {
            let key = if of_body { "body" } else { "joint" };
            table.absent(key, &format!("add `{key} = \"NAME\"`: whose {quantity} is wanted"));
            return None;
        }
        both => both,
    };
    let wrong = |own: &Located, what: &str, help: &str| {
        let message = format!("the quantity `{quantity}` is {what}");
        table.push(own.error_here(Code::BAD_VALUE, message).help(help.to_owned()));
        None
    };
    let machine = machine?;
    if let Some(own) = &joint {
        if !of_joint {
            return wrong(own, "of a body, not of a joint", "write `body = \"NAME\"` instead");
        }
        let joint = place(table, own, "joint", machine.joints.iter().map(|own| &own.name))?;
        let known = &machine.joints[joint];
        let coupling = known.kind == JointKind::Coupling;
        let lacks = match quantity {
            "moment" | "tilt" if !known.acts_on(MotionKind::Tilts) => Some("on tilts, such as M_x"),
            "axial_force" | "axial_deformation" if !known.acts_on(MotionKind::Along) => {
                Some("along z, F_z")
            }
            _ => None,
        };
        if let Some(lacks) = lacks {
            let message = format!("the joint `{}` gives no force {lacks}", own.text());
            let help = "take a law of a joint that gives one, or a bushing with its stiffness";
            table.push(own.error_here(Code::BAD_VALUE, message).help(help));
            return None;
        }
        if quantity == "film" {
            let Some(film) = known.bearing.law.source.film() else {
                let message = format!("the law of the joint `{}` is no film", own.text());
                let help = "name a joint with a film, or another quantity, such as \"force\"";
                table.push(own.error_here(Code::BAD_VALUE, message).help(help));
                return None;
            };
            let (openings, integrals) = film.columns();
            return Some(Wanted::Film { joint, openings, integrals });
        }
        if quantity == "states" {
            let bearing = &known.bearing;
            let states = bearing.law.source.states();
            if states.is_empty() {
                let message = format!("the law of the joint `{}` has no states", own.text());
                let help =
                    "name a joint whose law has `[states]`, or another quantity, such as \"force\"";
                table.push(own.error_here(Code::BAD_VALUE, message).help(help));
                return None;
            }
            let places = match bearing.law.source.acts() {
                Acts::Joint | Acts::Sensor | Acts::Gear => 1,
                // Of a law of a ring each has one.
                Acts::Ring | Acts::Spring => bearing.facts.springs.unwrap_or(1),
            };
            return Some(Wanted::States { joint, states, places });
        }
        let quantity = match (quantity, coupling) {
            ("power", _) => return Some(Wanted::JointPower { joint }),
            ("moment", _) => JointQuantity::Moment,
            ("tilt", _) => JointQuantity::Tilt,
            ("axial_force", _) => JointQuantity::AxialForce,
            ("axial_deformation", _) => JointQuantity::AxialDeformation,
            ("force", false) => JointQuantity::Force,
            ("force", true) => JointQuantity::Torque,
            ("deformation", false) => JointQuantity::Deformation,
            ("deformation", true) => JointQuantity::Twist,
            (_, false) => JointQuantity::Rate,
            (_, true) => JointQuantity::TwistRate,
        };
        return Some(Wanted::Joint { joint, quantity, frame });
    }
    let own = body?;
    if !of_body {
        return wrong(&own, "of a joint, not of a body", "write `joint = \"NAME\"` instead");
    }
    let body = place(table, &own, "body", machine.bodies.iter().map(|own| &own.name))?;
    let motion = match quantity {
        "energy" => return Some(Wanted::Energy { body }),
        "power" => return Some(Wanted::Power { body }),
        "displacement" => Motion::Displacement,
        "velocity" => Motion::Velocity,
        _ => Motion::Acceleration,
    };
    let meshed = matches!(machine.bodies[body].form, Form::Meshed(_));
    if !meshed && table.has("set") {
        let message = format!("`{}` is rigid and has no node sets", own.text());
        let help = "write `z = \"…\"`, or nothing for its centre";
        table.push(table.written("set").error_here(Code::BAD_VALUE, message).help(help));
    }
    if meshed && set.is_some() && z.is_some() {
        table.conflict("set", "z");
        return None;
    }
    let point = match (meshed, set, z) {
        (true, Some(set), _) => OutputPoint::Set(set),
        (true, None, Some(z)) => OutputPoint::Section(z, table.written("z")),
        (true, None, None) => {
            let help = "add `set = \"NAME\"`: its node moves so, or the mean of its nodes; or `z = \"…\"`, for the mean of \
                        the section there";
            table.absent("set", help);
            return None;
        }
        (false, ..) => OutputPoint::At(z),
    };
    Some(Wanted::Motion { body, point, motion, frame, components })
}

/// Axes in the order of the case; x and y if it names none.
fn components(table: &Table) -> Vec<usize> {
    const AXES: [&str; 3] = ["x", "y", "z"];
    let mut components = Vec::new();
    for own in table.texts("components") {
        match AXES.iter().position(|axis| *axis == own.text()) {
            Some(axis) if components.contains(&axis) => {
                let message = format!("`{}` stands here twice", own.text());
                table.push(own.error_here(Code::BAD_VALUE, message).help("take one of them out"));
            }
            Some(axis) => components.push(axis),
            None => {
                let message = format!("`{}` is no component", own.text());
                let help = "name some of \"x\", \"y\" and \"z\"";
                table.push(own.error_here(Code::BAD_VALUE, message).help(help));
            }
        }
    }
    if table.has("components") && table.texts("components").is_empty() {
        let place = table.written("components");
        let help = "name some of \"x\", \"y\" and \"z\", or leave it out for x and y";
        table.push(place.error_here(Code::BAD_VALUE, "`components` names none").help(help));
    }
    if components.is_empty() { vec![0, 1] } else { components }
}

/// The place of a body or joint among those that the case has; one that it has not is noted.
fn place<'a>(
    table: &Table,
    name: &Located,
    what: &str,
    all: impl Iterator<Item = &'a Located>,
) -> Option<usize> {
    let known: Vec<&str> = all.map(Located::text).collect();
    let help = || match known.is_empty() {
        true => format!("this machine has no {what}"),
        false => format!("name one of `{}`", known.join("`, `")),
    };
    let message = format!("there is no {what} `{}`", name.text());
    names::place(table, name, &known, message, help)
}
