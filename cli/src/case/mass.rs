//! The short form of one mass on a spring and a damper, between stops: `[mass]` and `[[stop]]`.
//!
//! m ẍ + d ẋ + k x = F + m e Ω² cos Ωt + stops, and along y the same with sin Ωt and without F.

use whirl_codegen::diagnostic::Located;
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{BearingValue, Parameter};
use whirl_codegen::rational::{Rational, nearest};
use whirl_solver::bodies::Rotation;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::loads::{Frame, Onset, TimeFunction};
use whirl_solver::model::{AttachmentKind, LoadAction};
use whirl_solver::rigid::RigidBody;

use super::joined::stop;
use super::joined_machine::{InputForm, JoinedMachine, Load};
use super::joint::{Joint, JointKind, Side};
use super::law::LawSource;
use super::library::FileStore;
use super::loads::{self, Spread};
use super::machine::motion;
use super::named_body::{Attached, Form, NamedBody};
use super::rotor::Bearing;
use super::supports::SupportName;
use super::{gravity, ground};

/// Place of the mass among the bodies.
const MASS: usize = 0;

/// One mass between stops, as a body by name; none where too much of it is missing.
pub(super) fn read(store: FileStore, file: &Table) -> Option<JoinedMachine> {
    let stops = file.tables("stop");
    let own = file.optional_table("mass");
    let turns = own.as_ref().is_some_and(|own| own.gives("unbalance"));
    let stops = stops.into_iter().enumerate();
    let joints: Vec<Option<Joint>> = stops
        .map(|(place, table)| table.read(|table| joint(store, table, (place + 1, turns))))
        .collect();
    let gravity = gravity::read(file);
    let ground = ground::read(store, file);
    own?.read(|table| {
        let body = body(table);
        let force = table.quantity("force").filter(|force| *force != 0.0);
        Some(JoinedMachine {
            loads: force.map(|force| load(table, force)).into_iter().collect(),
            motion: motion(table)?,
            bodies: vec![body],
            joints: joints.into_iter().collect::<Option<_>>()?,
            drives: Vec::new(),
            gravity,
            ground,
            form: InputForm::Mass,
        })
    })
}

/// The mass: a point in a frame that stands still, in which it turns if it is out of balance.
fn body(table: &Table) -> NamedBody {
    let or_zero = |key| table.quantity(key).unwrap_or(0.0);
    let mass = table.quantity_or_one("mass");
    let unbalance = table.in_table("unbalance", |own| {
        let moment = mass * own.quantity_or_one("eccentricity");
        let what = AttachmentKind::Unbalance([moment, 0.0]);
        let speed = own.quantity_or_one("speed");
        (Attached { name: own.heading().text("unbalance"), z: 0.0, what }, speed)
    });
    let form = RigidBody {
        mass,
        polar_inertia: 0.0,
        transverse_inertia: None,
        along: false,
        rocks: false,
        centre: [0.0; 3],
        stiffness: [or_zero("stiffness"); 2],
        damping: [or_zero("damping"); 2],
    };
    let still =
        unbalance.as_ref().map_or(Rotation::Held, |&(_, speed)| Rotation::Spinning { speed });
    NamedBody {
        rotation: Some(still),
        start: BodyStart {
            position: vec![or_zero("displacement"), 0.0],
            velocity: vec![or_zero("velocity"), 0.0],
            ..BodyStart::default()
        },
        attached: unbalance.into_iter().map(|(own, _)| own).collect(),
        ..NamedBody::of(table.heading().text("mass"), Form::Rigid(form))
    }
}

/// The constant force along x.
fn load(table: &Table, force: f64) -> Load {
    let load = loads::Load {
        sets: Vec::new(),
        acting: LoadAction::Force([force, 0.0, 0.0]),
        place: table.written("force"),
        frame: Frame::Space,
        spread: Spread::Each,
        time_function: TimeFunction::Constant,
        table: None,
        onset: Onset::Start,
    };
    let name = Located::new(load.place.source(), load.place.span(), "force");
    Load { name, body: MASS, z: None, load }
}

/// A stop as a joint to the ground, by its number; `turns`: whether the mass does so.
fn joint(store: FileStore, table: &Table, (number, turns): (usize, bool)) -> Option<Joint> {
    let parts = stop(store, table)?;
    let mut facts = parts.facts;
    facts.springs = Some(1);
    let clearance = match (parts.angle, &facts.radial_clearance) {
        (None, None) => clearance_of(&parts.law.source),
        _ => parts.clearance,
    };
    let radius = facts.journal_radius.as_ref().map(nearest);
    let side = |body, name: &str| Side::of(body, table.heading().text(name), Vec::new());
    let names = (table.heading().text(&number.to_string()), SupportName::numbered("Stop", number));
    let bearing = Bearing {
        journal: Vec::new(),
        bore: Vec::new(),
        springs: 1,
        stations: vec![0.0],
        radial_clearance: clearance,
        // Where nothing turns, a radius is of no effect.
        journal_radius: radius.or((!turns).then_some(0.0)),
        law: parts.law,
        parameters: parts.parameters,
        facts,
        table: table.heading().written(),
        places: table.places(),
    };
    let sides = [side(Some(MASS), "mass"), side(None, "ground")];
    Some(Joint { angle: parts.angle, ..Joint::of(names, JointKind::Stop, sides, bearing) })
}

/// The radial clearance of a law in m, 0 if no parameter is said to be one.
fn clearance_of(law: &LawSource) -> f64 {
    let si = |parameter: &Parameter| {
        let factor = parameter.unit.rational()?;
        let value = &parameter.written * factor;
        match parameter.bearing? {
            BearingValue::RadialClearance => Some(nearest(&value)),
            BearingValue::DiametralClearance => Some(nearest(&(value / Rational::from(2)))),
            _ => None,
        }
    };
    law.parameters().iter().find_map(si).unwrap_or(0.0)
}
