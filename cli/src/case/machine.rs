//! The tables that describe a rotating machine.

mod bearings;
mod bodies;
mod drive;
mod materials;
mod motion;
mod places;
mod speed;

use whirl_codegen::diagnostic::Located;
use whirl_codegen::document::Table;

pub(super) use self::bodies::{
    Cells, body as meshed, crank_throw, ground_springs, mass_damping, ring_support, solid_shaft,
    static_correction,
};
pub(super) use self::drive::{leads_to_its_target, needs_a_section, read_one as drive};
pub(super) use self::materials::Materials;
pub(super) use self::motion::{default_motion, motion};
use self::places::SHAFT;
pub(super) use self::speed::{MOST_SPEED, speed};
use super::joined_machine::{Drive, InputForm, JoinedMachine, Load};
use super::library::FileStore;
use super::named_body::Form;
use super::{gravity, ground, loads};

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
    let ground = ground::read(store, file);
    let ((mut shaft, motion), support, couple) = (shaft?, support?, drive?);
    shaft.initial_speed = start_speed;
    if let Form::Meshed(own) = &mut shaft.form {
        own.section = couple.section.clone();
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
        ground,
        motion,
        form: InputForm::Shaft,
    })
}
