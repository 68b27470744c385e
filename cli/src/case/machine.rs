//! The tables that describe a rotating machine.

mod bearings;
mod bodies;
mod drive;
mod materials;
mod places;

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::{Code, Located, suggest};
use whirl_codegen::document::Table;
use whirl_specs::{MOTIONS, Motion};

pub(super) use self::bodies::{
    Cells, body as meshed, crank_throw, ground_springs, ring_support, solid_shaft,
    static_correction,
};
pub(super) use self::drive::{leads_to_its_target, needs_a_section, read_one as drive};
pub(super) use self::materials::Materials;
use self::places::SHAFT;
use super::joined::{Drive, Form, JoinedMachine, Load, Turning};
use super::library::FileStore;
use super::{gravity, loads};

/// The motion derived from the kinetic energy.
const DEFAULT_MOTION: &str = "consistent";

/// One shaft on one support, as bodies by name; none where too much of it is missing. `goes_on`: the shaft has the speed of
/// another run, and not that of the start.
pub(super) fn read(
    store: FileStore,
    file: &Table,
    start_speed: Option<f64>,
    goes_on: bool,
) -> Option<JoinedMachine> {
    let materials = Materials::read(file);
    let shaft = bodies::shaft(store, file, &materials);
    let support = bodies::support(store, file, &materials);
    let joints = bearings::joints(store, file);
    let drive = drive::drive(store, file, (!goes_on).then_some(start_speed.unwrap_or(0.0)));
    let loads = loads::read(store, file);
    let gravity = gravity::read(file);
    let ((mut shaft, motion), support, couple) = (shaft?, support?, drive?);
    shaft.turning = Some(Turning::Free { initial_speed: start_speed });
    if let Form::Meshed(own) = &mut shaft.form {
        own.section = couple.section_sets();
    }
    let place = shaft.name.clone();
    let loads = loads.into_iter().enumerate().map(|(number, load)| {
        let name = Located::new(load.place.source(), load.place.span(), (number + 1).to_string());
        Load { name, body: SHAFT, z: None, load }
    });
    Some(JoinedMachine {
        bodies: vec![shaft, support],
        joints: joints?,
        drives: vec![Drive { name: place.clone(), body: SHAFT, place, couple }],
        loads: loads.collect(),
        gravity,
        motion,
        short: true,
    })
}

/// Beyond any machine, but far below where numbers end (rad/s): ten million revolutions per minute.
const MOST_SPEED: f64 = 1e7 * TAU / 60.0;

/// A speed of rotation (rad/s); one that no machine has is noted.
pub(super) fn speed(table: &Table, key: &str) -> Option<f64> {
    let speed = table.quantity(key)?;
    if speed.abs() > MOST_SPEED {
        let message = format!("`{key}` is faster than any machine turns");
        let help = format!("write at most `{key} = \"1e7 rpm\"`");
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
    }
    Some(speed)
}

/// The motion that a table names, or the default one.
pub(super) fn motion(table: &Table) -> Option<&'static Motion> {
    let name = table.optional_string("motion");
    let wanted = name.as_ref().map_or(DEFAULT_MOTION, |name| name.text()).to_string();
    let found = called(&wanted);
    if found.is_none() {
        let known: Vec<&str> = MOTIONS.iter().map(|motion| motion.origin.name).collect();
        let place = name.unwrap_or_else(|| table.heading().text(""));
        let error = place.error_here(Code::BAD_VALUE, format!("there is no motion `{wanted}`"));
        table.push(error.maybe_help(suggest(&wanted, &known)));
    }
    found
}

fn called(name: &str) -> Option<&'static Motion> {
    MOTIONS.iter().find(|motion| motion.origin.name == name)
}

/// In place of one that is not there, which has been noted.
pub(super) fn default_motion() -> Option<&'static Motion> {
    called(DEFAULT_MOTION)
}
