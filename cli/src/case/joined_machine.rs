//! A machine of bodies by name, and of what joins, drives and loads them, as a case describes it.

use whirl_codegen::diagnostic::Located;
use whirl_solver::bearing::MotionKind;
use whirl_specs::Motion;

use super::gravity::Gravity;
use super::joint::{Joint, Side};
use super::named_body::{Form, NamedBody, Turning};
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
    /// How rotation and deformation are coupled, alike in all bodies that turn.
    pub(crate) motion: &'static Motion,
    /// Whether the case says it in the short form, as one shaft on one support: by its words messages name the parts.
    pub(crate) short: bool,
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
    /// z on a rigid body, m, if the case says it.
    pub(crate) z: Option<f64>,
    /// The force, and the sets of a mesh that carry it.
    pub(crate) load: loads::Load,
}

impl JoinedMachine {
    /// The table of the case that describes a body, without brackets.
    pub(crate) fn table_of(&self, body: &NamedBody) -> String {
        let name = body.name.text();
        if self.short { name.to_owned() } else { format!("body.{name}") }
    }

    /// The largest speed that the case gives a body in a run: of its drive, at its start, or as prescribed (rad/s).
    pub(crate) fn top_speed(&self, body: usize, run: Run) -> f64 {
        let aims = self.drives.iter().filter(|drive| drive.body == body && drive.couple.acts);
        aims.map(|drive| drive.couple.top_speed()).fold(self.told_speed(body, run), f64::max)
    }

    /// The same without the speeds at which drives aim, which it may never reach.
    pub(super) fn told_speed(&self, body: usize, run: Run) -> f64 {
        match &self.bodies[body].turning {
            Some(Turning::Prescribed { speed, acceleration }) => {
                speed.abs().max((speed + acceleration * run.duration).abs())
            }
            Some(Turning::Free { initial_speed }) => {
                initial_speed.filter(|_| !run.goes_on).unwrap_or(0.0).abs()
            }
            Some(Turning::Table(columns)) => columns.largest_upto(run.end()),
            None => 0.0,
        }
    }

    /// The speed that a body has in the end, where the case gives one (rad/s): that at which its drive aims, which is prescribed
    /// and constant or with which a table ends, or with which a body starts that no couple acts on.
    pub(super) fn constant_speed(&self, body: usize, run: Run) -> Option<f64> {
        let aims = || {
            let own = self.drives.iter().find(|drive| drive.body == body && drive.couple.acts)?;
            own.couple.table.is_none().then_some(own.couple.target_speed)
        };
        match &self.bodies[body].turning {
            Some(Turning::Prescribed { speed, acceleration: 0.0 }) => Some(*speed),
            Some(Turning::Table(columns)) => columns.constant_before(run.end()),
            Some(Turning::Free { initial_speed }) => {
                aims().or_else(|| initial_speed.filter(|_| !run.goes_on && !self.is_turned(body)))
            }
            _ => aims(),
        }
    }

    /// Whether the body of a side has tilts, or moves along z.
    pub(crate) fn side_has(&self, side: &Side, motion: MotionKind) -> bool {
        let Some(body) = side.body else { return false };
        match (&self.bodies[body].form, motion) {
            (Form::Rigid(own), MotionKind::Tilts) => own.transverse_inertia.is_some(),
            (Form::Rigid(own), MotionKind::Along) => own.moves_along_z,
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
