//! A machine of bodies by name, and of what joins, drives and loads them, as a case describes it.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Located, Source};
use whirl_solver::bearing::MotionKind;
use whirl_solver::bodies::Rotation;
use whirl_specs::Motion;

use super::columns::farther;
use super::gravity::Gravity;
use super::ground::GroundMotion;
use super::joint::{Joint, Side};
use super::named_body::{Form, NamedBody};
use super::run::Run;
use super::{loads, rotor};

/// Bodies, and what joins, drives and loads them.
#[derive(Debug, Clone)]
pub(crate) struct JoinedMachine {
    /// In the order of the file.
    pub(crate) bodies: Vec<NamedBody>,
    /// In the order of the file.
    pub(crate) joints: Vec<Joint>,
    /// At most one a body.
    pub(crate) drives: Vec<Drive>,
    /// Forces and couples.
    pub(crate) loads: Vec<Load>,
    /// Gravity, if there is any.
    pub(crate) gravity: Option<Gravity>,
    /// How the ground is accelerated, if it is.
    pub(crate) ground: Option<GroundMotion>,
    /// How rotation and deformation are coupled, alike in all bodies that turn.
    pub(crate) motion: &'static Motion,
    /// How the case says it: by its words messages and results name the parts.
    pub(crate) form: InputForm,
}

/// How a case says what its machine is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum InputForm {
    /// By tables of bodies and joints.
    Named,
    /// As one shaft on one support.
    Shaft,
    /// As one mass between stops.
    Mass,
}

/// A couple that acts until a speed is reached.
#[derive(Debug, Clone)]
pub(crate) struct Drive {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// The body, by its place.
    pub(crate) body: usize,
    /// Where the case names it.
    pub(crate) place: Located,
    /// The couple; on a rigid body without sets.
    pub(crate) couple: rotor::Drive,
}

/// A force or a couple on a body.
#[derive(Debug, Clone)]
pub(crate) struct Load {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// The body, by its place.
    pub(crate) body: usize,
    /// z on a rigid body or on one made from sections, m, if the case says it.
    pub(crate) z: Option<f64>,
    /// The force, and the sets of a mesh that carry it.
    pub(crate) load: loads::Load,
}

impl JoinedMachine {
    /// The files of the tables that it names.
    pub(super) fn tables(&self) -> Vec<Arc<Source>> {
        let loads = self.loads.iter().filter_map(|own| Some(&own.load.table.as_ref()?.0));
        let drives = self.drives.iter().filter_map(|own| own.couple.table.as_ref());
        let turning = self.bodies.iter().filter_map(|own| own.speeds.as_ref());
        let columns = loads.chain(drives).chain(turning).map(|own| own.source.clone());
        columns.chain(self.ground.iter().map(|own| own.source.clone())).collect()
    }

    /// What acts on all mass alike at t = 0, as an acceleration (m/s²): gravity, less that of the ground.
    pub(crate) fn field_at_start(&self) -> [f64; 3] {
        let gravity = self.gravity.as_ref().map_or([0.0; 3], |own| own.acceleration);
        let ground = self.ground.as_ref().map_or([0.0; 3], GroundMotion::at_start);
        std::array::from_fn(|axis| gravity[axis] - ground[axis])
    }

    /// Whether the case names its bodies and joints.
    pub(crate) fn is_named(&self) -> bool {
        self.form == InputForm::Named
    }

    /// Whether it is one mass between stops.
    pub(crate) fn is_mass(&self) -> bool {
        self.form == InputForm::Mass
    }

    /// The table of the case that describes a body, without brackets.
    pub(crate) fn table_of(&self, body: &NamedBody) -> String {
        let name = body.name.text();
        if self.is_named() { format!("body.{name}") } else { name.to_owned() }
    }

    /// The largest speed that the case gives a body in a run: of its drive, at its start, or as prescribed (rad/s).
    pub(crate) fn top_speed(&self, body: usize, run: Run) -> f64 {
        self.fastest(body, run).abs()
    }

    /// The same with its sign: positive from x to y.
    pub(crate) fn fastest(&self, body: usize, run: Run) -> f64 {
        let aims = self.drives.iter().filter(|drive| drive.body == body && drive.couple.acts);
        aims.map(|drive| drive.couple.fastest()).fold(self.told(body, run), farther)
    }

    /// The top speed without those at which drives aim, which a body may never reach.
    pub(super) fn told_speed(&self, body: usize, run: Run) -> f64 {
        self.told(body, run).abs()
    }

    fn told(&self, body: usize, run: Run) -> f64 {
        let own = &self.bodies[body];
        if let Some(columns) = &own.speeds {
            return columns.farthest_upto(run.end());
        }
        match own.rotation {
            Some(Rotation::Prescribed { speed, acceleration }) => {
                farther(speed, speed + acceleration * run.duration)
            }
            _ => own.initial_speed.filter(|_| !run.goes_on).unwrap_or(0.0),
        }
    }

    /// The speed that a body has in the end, where the case gives one (rad/s): that at which its drive aims, which is prescribed
    /// and constant or with which a table ends, or with which a body starts that no couple acts on.
    pub(crate) fn constant_speed(&self, body: usize, run: Run) -> Option<f64> {
        let aims = || {
            let own = self.drives.iter().find(|drive| drive.body == body && drive.couple.acts)?;
            own.couple.table.is_none().then_some(own.couple.target_speed)
        };
        let own = &self.bodies[body];
        if let Some(columns) = &own.speeds {
            return columns.constant_before(run.end());
        }
        match own.rotation {
            Some(Rotation::Prescribed { speed, acceleration: 0.0 }) => Some(speed),
            Some(Rotation::Free) => aims()
                .or_else(|| own.initial_speed.filter(|_| !run.goes_on && !self.is_turned(body))),
            _ => aims(),
        }
    }

    /// The speeds of a body at the start and at the end of a run (rad/s), or the fastest one of a table; none where the case does not
    /// tell.
    pub(crate) fn speeds_in(&self, body: usize, run: Run) -> Vec<f64> {
        let own = &self.bodies[body];
        match own.rotation {
            _ if own.speeds.is_some() => vec![self.told(body, run)],
            Some(Rotation::Prescribed { speed, acceleration }) => {
                vec![speed, speed + acceleration * run.duration]
            }
            Some(Rotation::Free) => {
                let end = self.constant_speed(body, run);
                end.map_or_else(Vec::new, |end| vec![own.initial_speed.unwrap_or(0.0), end])
            }
            _ => Vec::new(),
        }
    }

    /// Whether the body of a side has tilts, or moves along z.
    pub(crate) fn side_has(&self, side: &Side, motion: MotionKind) -> bool {
        let Some(body) = side.body else { return false };
        match (&self.bodies[body].form, motion) {
            (Form::Rigid(own), MotionKind::Tilts) => own.transverse_inertia.is_some(),
            (Form::Rigid(own), MotionKind::Along) => own.along,
            (Form::Meshed(own), MotionKind::Along) => !own.rigid || own.moves_along_z,
            (Form::Meshed(_), MotionKind::Tilts) => true,
        }
    }

    /// Whether a couple acts on a body that turns freely: of a drive, of a load, or of the law of a joint.
    fn is_turned(&self, body: usize) -> bool {
        let drives = self.drives.iter().any(|own| own.body == body && own.couple.acts);
        let turns = |joint: &Joint| {
            let joins = joint.sides.iter().any(|side| side.body == Some(body));
            joins && joint.bearing.law.source.gives_torque()
        };
        drives
            || self.loads.iter().any(|own| own.body == body && own.load.turns())
            || self.joints.iter().any(turns)
    }
}
