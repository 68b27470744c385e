//! The table `[body.NAME]`.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::units::Dimension;
use whirl_solver::bodies::Rotation;
use whirl_solver::mesh::Material;
use whirl_solver::model::AttachmentKind;
use whirl_solver::rigid::RigidBody;
use whirl_solver::schedule::Schedule;
use whirl_specs::Motion;

use super::schema;
use super::{attached, fit, matrices};
use crate::case::columns::{self, Columns};
use crate::case::dimensions::Dimensions;
use crate::case::library::FileStore;
use crate::case::machine::{self, Materials};
use crate::case::named_body::{Attached, Form, MeshedBody, NamedBody};
use crate::case::rotor::{Body, Mesh};
use crate::case::{names, sections, selections};
use crate::ring::Ring;

/// What a table says of a body.
pub(super) struct BodyDraft {
    /// Its name, and the body if enough of it is right.
    pub(super) body: (Located, Option<NamedBody>),
    /// How its rotation is coupled to deformation, where the case says it.
    pub(super) motion: Option<(Located, &'static Motion)>,
}

/// Keys of a rigid body.
const RIGID: [&str; 4] = ["mass", "polar_inertia", "transverse_inertia", "stiffness"];
/// Keys of rigid bodies, with a mesh or without, and of all.
const OF_BOTH: [&str; 6] = ["z", "damping", "ground_spring", "moves_along_z", "rocks", "centre"];
/// Keys of a body with a mesh.
const MESHED: [&str; 18] = [
    "mesh",
    "matrices",
    "units",
    "merge",
    "dimensions",
    "sections",
    "cells",
    "rigid",
    "material",
    "regions",
    "sets",
    "modes",
    "static_correction",
    "mass_damping",
    "held",
    "axial_restraint",
    "section",
    "stiffening",
];

/// Keys of a mesh that a rigid one has not, and what to do instead.
const OF_FLEXIBLE: [(&str, &str); 9] = [
    ("modes", "leave it out"),
    ("damping", "leave it out: a rigid body has no deformation to damp"),
    ("mass_damping", "join the body to the ground by a `bushing` with `damping`"),
    ("stiffening", "leave it out: it is exact for a rigid body"),
    (
        "axial_restraint",
        "leave it out: a rigid body moves along z with `moves_along_z = true` only",
    ),
    ("static_correction", "leave it out: a rigid body has no deformation"),
    ("section", "leave it out: all sections of a rigid body turn alike"),
    ("held", "leave the body out, and let its joints name the ground"),
    ("ground_spring", "join the body to the ground by a `bushing`"),
];

pub(super) fn read(
    store: FileStore,
    table: &Table,
    name: &Located,
    (materials, thrust): (&Materials, bool),
) -> BodyDraft {
    let before = table.errors();
    let turns = table.optional_word("turns");
    let Some(turns) = turns else {
        // Which keys are those of such a body, is open.
        schema::BODY.iter().for_each(|key| table.pass_over(key.name));
        return BodyDraft { body: (name.clone(), None), motion: None };
    };
    let (rotation, initial_speed, speeds) = rotation(store, table, turns);
    let axis = table.quantity_pair("axis").unwrap_or_default();
    let axis_given = table.gives("axis");
    let motion = match table.gives("motion") {
        true => machine::motion(table).map(|motion| (table.written("motion"), motion)),
        false => None,
    };
    let meshed = MESHED.into_iter().find(|key| table.gives(key));
    let rigid = RIGID.into_iter().find(|key| table.gives(key));
    let turned = turns != "no";
    of_other_rotations(table, turns, rigid.is_some());
    let form = match (meshed, rigid) {
        (Some(meshed), Some(rigid)) => {
            let message =
                format!("`{rigid}` is of a rigid body, and `{meshed}` of one with a mesh");
            let help = "keep one of them: a mesh has its own mass";
            table.push(table.written(rigid).error_here(Code::BAD_VALUE, message).help(help));
            selections::read(table);
            MESHED.iter().chain(&RIGID).for_each(|key| table.pass_over(key));
            OF_BOTH.iter().for_each(|key| table.pass_over(key));
            None
        }
        (Some(meshed), None) => {
            let of_numbers = ["rocks", "centre"].into_iter().filter(|key| table.gives(key));
            for key in of_numbers.filter(|_| !turned) {
                table.pass_over(key);
                let message =
                    format!("`{key}` is of a rigid body by numbers, and this one has a `{meshed}`");
                let help = "leave it out: a mesh on a bushing at one of its sets rocks by itself";
                table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
            }
            read_meshed(store, table, materials, (turned, thrust)).map(Form::Meshed)
        }
        (None, Some(_)) => Some(Form::Rigid(read_rigid(table, turned))),
        (None, None) => {
            let help = "add `mesh = \"body.inp\"`, `sections = \"body.csv\"`, a table of `dimensions` or of `matrices`, or the `mass` of a rigid body";
            table.absent("mesh", help);
            MESHED.iter().chain(&RIGID).for_each(|key| table.pass_over(key));
            OF_BOTH.iter().for_each(|key| table.pass_over(key));
            None
        }
    };
    // What does not tilt moves alike at every z.
    let tilts = meshed.is_some() || table.gives("transverse_inertia");
    let mut attached = attached::read(table, turned, meshed.is_some(), tilts);
    let right = table.errors() == before;
    let name = name.clone();
    let body = form.filter(|_| right).map(|mut form| {
        carry(&mut form, &mut attached);
        let own = NamedBody::of(name.clone(), form);
        NamedBody { rotation, initial_speed, speeds, axis, axis_given, attached, ..own }
    });
    BodyDraft { body: (name, body), motion }
}

/// Lets the layers of a mesh that is made from dimensions end where masses are, and those of one made from sections where
/// anything is that the case names; what its rows have beside their cells is added.
fn carry(form: &mut Form, attached: &mut Vec<Attached>) {
    let Form::Meshed(own) = form else { return };
    let Mesh::Generated(made) = &mut own.body.mesh else { return };
    match &mut made.dimensions {
        Dimensions::Shaft(shaft) => {
            let masses =
                attached.iter().filter(|own| !matches!(own.what, AttachmentKind::Unbalance(_)));
            shaft.sections = masses.map(|own| own.z).collect();
            shaft.sections.sort_by(f64::total_cmp);
        }
        Dimensions::Sections(sections) => {
            for own in &sections.rings {
                let Ring { z, mass, inertias: [polar_inertia, diametral_inertia] } = own.ring;
                let what = AttachmentKind::Disc { mass, polar_inertia, diametral_inertia };
                attached.push(Attached { name: own.place.clone(), z, what });
            }
            let planes = &mut sections.table.planes;
            planes.extend(attached.iter().map(|own| own.z));
            planes.extend(own.body.selections.iter().flat_map(|own| own.selection.planes()));
        }
        Dimensions::Crank(_) | Dimensions::Support(_) => {}
    }
}

/// Notes keys of bodies that turn in another way, or not at all.
fn of_other_rotations(table: &Table, turns: &str, rigid: bool) {
    let note = |key: &str, whose: &str, help: &str| {
        if table.gives(key) {
            table.pass_over(key);
            let message = format!("`{key}` is of {whose}, but this one has `turns = \"{turns}\"`");
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    };
    const OF_PRESCRIBED: [&str; 3] = ["speed", "acceleration", "table"];
    match turns {
        "no" => {
            let help = "leave it out, or write `turns = \"free\"` or `turns = \"prescribed\"`";
            let rocks = table.gives("rocks");
            for key in
                OF_PRESCRIBED.into_iter().chain(["initial_speed", "polar_inertia", "section"])
            {
                // A mesh has no inertia of its own that it could give, and what rocks needs one.
                if key != "polar_inertia" || rigid && !rocks {
                    note(key, "a body that turns", help);
                }
            }
        }
        "free" => {
            let help = "write `initial_speed`, which holds at t = 0, or `turns = \"prescribed\"`";
            OF_PRESCRIBED.into_iter().for_each(|key| note(key, "a prescribed rotation", help));
        }
        _ => note(
            "initial_speed",
            "a body that turns freely",
            "write `speed`, which is prescribed, or `turns = \"free\"`",
        ),
    }
    if turns != "no" {
        let help = "leave it out: the body turns";
        ["rocks", "centre"].iter().for_each(|key| note(key, "a body that does not turn", help));
        let help = "join the body to the ground by a `bushing`";
        let own: &[&str] = if rigid { &["stiffness", "damping"] } else { &["ground_spring"] };
        own.iter().for_each(|key| note(key, "a body that does not turn", help));
        let help = "leave it out: it would drag the body along with its own frame; drag in space is damping of a `bushing` to the ground";
        note("mass_damping", "a body that does not turn", help);
    }
}

/// How a body turns, its speed at t = 0, and the table that tells its rotation.
fn rotation(
    store: FileStore,
    table: &Table,
    turns: &str,
) -> (Option<Rotation>, Option<f64>, Option<Arc<Columns>>) {
    match turns {
        "free" => (Some(Rotation::Free), machine::speed(table, "initial_speed"), None),
        "prescribed" if table.has("table") => {
            for key in ["speed", "acceleration"].into_iter().filter(|key| table.has(key)) {
                table.conflict(key, "table");
            }
            let measures: [&[Dimension]; 2] = [&[Dimension::TIME], &[Dimension::ANGULAR_SPEED]];
            let speeds = columns::read(store, table, "table", measures);
            let schedule = |own: &Arc<Columns>| {
                let schedule = Schedule::of_speeds(&own.rows).expect("rows that rise");
                Rotation::Scheduled(Arc::new(schedule))
            };
            (speeds.as_ref().map(schedule), None, speeds)
        }
        "prescribed" => {
            table.demand("speed");
            let speed = machine::speed(table, "speed").unwrap_or(0.0);
            let acceleration = table.quantity("acceleration").unwrap_or(0.0);
            (Some(Rotation::Prescribed { speed, acceleration }), None, None)
        }
        _ => (None, None, None),
    }
}

fn read_meshed(
    store: FileStore,
    table: &Table,
    materials: &Materials,
    (turns, thrust): (bool, bool),
) -> Option<Box<MeshedBody>> {
    let rigid = table.optional_boolean("rigid").unwrap_or(false);
    if rigid {
        for (key, help) in OF_FLEXIBLE {
            if table.has(key) {
                let message = format!("`{key}` is of a body that deforms, and this one is rigid");
                table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
            }
        }
    } else if !table.has("modes") && !table.gives("matrices") {
        let help = "add `modes = 20`: so many of its lowest modes with its joints and loads held are kept; more change little";
        table.absent("modes", help);
    }
    let body = if table.gives("sections") {
        sections::read(store, table, materials, turns)
    } else if table.gives("matrices") {
        matrices::read(store, table)
    } else {
        machine::meshed(store, table, materials, |dimensions, material| {
            made(dimensions, material, turns)
        })
    };
    if table.has("cells") && !table.gives("sections") {
        let message = "`cells` is of a body made from `sections`";
        let help = "leave it out; cells of `dimensions` are in their own table";
        table.push(table.written("cells").error_here(Code::BAD_VALUE, message).help(help));
    }
    let axial_restraint = table.optional_string("axial_restraint");
    let held = table.texts("held");
    let section = if turns { table.texts("section") } else { Vec::new() };
    if section.len() > 2 {
        let message =
            "`section` is one set, or two sets of one node at opposite ends of a diameter";
        let help = "such as `section = \"END\"`";
        table.push(table.written("section").error_here(Code::BAD_VALUE, message).help(help));
    }
    // Where a joint acts along z, it may hold the body.
    // Matrices need not have dofs along z; where they have, what may move is found.
    let along = !table.gives("matrices") && !table.gives("sections");
    if turns && along && !rigid && !thrust && axial_restraint.is_none() && held.is_empty() {
        table.demand("axial_restraint");
    }
    let ground_springs = if turns { Vec::new() } else { machine::ground_springs(table) };
    let moves_along_z = table.optional_boolean("moves_along_z").unwrap_or(false);
    if moves_along_z && !rigid {
        let message = "`moves_along_z` is of a rigid body, and this one deforms";
        let help = if turns {
            "leave it out, and `axial_restraint`, too: a bushing with `axial_stiffness` holds the body then"
        } else {
            "leave it out: what is not held moves along z"
        };
        table.push(table.written("moves_along_z").error_here(Code::BAD_VALUE, message).help(help));
    }
    let stiffening = turns && table.optional_boolean("stiffening").unwrap_or(true);
    let static_correction = machine::static_correction(table);
    let mass_damping = if turns { 0.0 } else { machine::mass_damping(table) };
    Some(Box::new(MeshedBody {
        body: Body { static_correction, mass_damping, ..body? },
        held,
        ground_springs,
        axial_restraint,
        section,
        stiffening,
        rigid,
        moves_along_z,
    }))
}

/// Dimensions of a shaft, of a crank or of a support.
fn made(table: &Table, material: Material, turns: bool) -> Dimensions {
    const SHAFT: [&str; 4] = ["length", "diameter", "supports", "support_length"];
    const SUPPORT: [&str; 9] = [
        "start",
        "length",
        "height",
        "width",
        "pedestal_height",
        "rings",
        "ring_length",
        "ring_thickness",
        "bore_radius",
    ];
    const CRANK: [&str; 7] = [
        "throw",
        "diameter",
        "support_length",
        "pin_diameter",
        "pin_length",
        "web_width",
        "web_thickness",
    ];
    let crank = turns && table.has("throw");
    let needed: &[&str] = match (crank, turns) {
        (true, _) => &CRANK,
        (_, true) => &SHAFT,
        _ => &SUPPORT,
    };
    needed.iter().for_each(|key| table.demand(key));
    let cells = machine::Cells::Quadratic;
    match (crank, turns) {
        (true, _) => Dimensions::Crank(machine::crank_throw(table, material, cells)),
        (_, true) => Dimensions::Shaft(machine::solid_shaft(table, material, cells)),
        _ => Dimensions::Support(machine::ring_support(table, material, cells)),
    }
}

fn read_rigid(table: &Table, turns: bool) -> RigidBody {
    table.demand("mass");
    let rocks = !turns && table.optional_boolean("rocks").unwrap_or(false);
    if turns || rocks {
        table.demand("polar_inertia");
    }
    let [x, y] = table.quantity_pair("centre").unwrap_or_default();
    if table.gives("centre") && !turns && !rocks {
        let message = "`centre` is of a body that rocks";
        let help =
            "add `rocks = true`, or leave it out: the centre of a rigid body is on its `axis`";
        table.push(table.written("centre").error_here(Code::BAD_VALUE, message).help(help));
    }
    // What stands in space beside a body that turns is a joint to the ground.
    let to_ground = |key: &str| -> [f64; 2] {
        let read = |table: &Table| ["x", "y"].map(|axis| table.quantity(axis).unwrap_or(0.0));
        let text = |text: &str| format!("{{ x = {text}, y = {text} }}");
        if turns || names::is_text(table, key, text) {
            return [0.0; 2];
        }
        table.in_table(key, read).unwrap_or_default()
    };
    if table.has("transverse_inertia") {
        table.demand("z");
    }
    let polar_inertia = if turns || rocks { table.quantity("polar_inertia") } else { None };
    let transverse_inertia = table.quantity("transverse_inertia");
    fit::inertias(table, polar_inertia, transverse_inertia);
    RigidBody {
        mass: table.quantity_or_one("mass"),
        polar_inertia: polar_inertia.unwrap_or(if turns || rocks { 1.0 } else { 0.0 }),
        transverse_inertia,
        along: table.optional_boolean("moves_along_z").unwrap_or(false),
        rocks,
        centre: [x, y, table.quantity("z").unwrap_or(0.0)],
        stiffness: to_ground("stiffness"),
        damping: to_ground("damping"),
    }
}
