//! A machine of bodies by name, and of what joins them: the tables `[body.NAME]`, `[joint.NAME]`, `[drives.NAME]` and
//! `[loads.NAME]`.

mod attached;
mod bodies;
mod bushing;
mod checks;
mod fit;
mod forces;
mod joints;
mod matrices;
pub(super) mod names;
pub(super) mod schema;

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::bearing::MotionKind;
use whirl_solver::error::Error;
use whirl_solver::mesh;
use whirl_solver::mesh::crank::CrankThrow;
use whirl_solver::mesh::shaft::SolidShaft;
use whirl_solver::mesh::support::RingSupport;
use whirl_specs::{Element, Motion};

pub(crate) use self::attached::{Attached, Carried};
use super::columns::Columns;
use super::cycle::Run;
use super::gravity::{self, Gravity};
use super::law::NamedLaw;
use super::library::FileStore;
use super::loads;
use super::machine::Materials;
use super::parameters::SetParameter;
use super::rotor::{self, Bearing, GroundSpring};
use super::supports::SupportName;

/// Keys that make a file one of named bodies.
const NAMED: [&str; 4] = ["body", "joint", "drives", "loads"];
/// Keys of one shaft on one support, and of one mass.
const SHORT: [&str; 8] =
    ["shaft", "support", "springs", "bearing", "drive", "load", "mass", "stop"];

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

/// A body.
#[derive(Debug, Clone)]
pub(crate) struct NamedBody {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// How it turns, if it does.
    pub(crate) turning: Option<Turning>,
    /// x and y of its axis, m.
    pub(crate) axis: [f64; 2],
    /// Whether the case says so.
    pub(crate) axis_given: bool,
    /// What it is made of.
    pub(crate) form: Form,
    /// What it carries beside that, if it turns.
    pub(crate) attached: Vec<Attached>,
}

impl NamedBody {
    /// One with a mesh that stands on the common axis, and does not turn.
    pub(super) fn of(name: Located, form: MeshedBody) -> NamedBody {
        NamedBody {
            name,
            turning: None,
            axis: [0.0; 2],
            axis_given: false,
            form: Form::Meshed(Box::new(form)),
            attached: Vec::new(),
        }
    }

    /// Whether its bores stand about its own axis: of all that turn, and of a rigid body whose table gives one. Those of a
    /// mesh stand where their nodes are, and all others about their journals.
    pub(crate) fn bores_on_axis(&self) -> bool {
        self.turning.is_some() || self.axis_given && matches!(self.form, Form::Rigid(_))
    }
}

/// How a body turns.
#[derive(Debug, Clone)]
pub(crate) enum Turning {
    /// As its couples make it, from a speed at t = 0 (rad/s).
    Free {
        /// rad/s, if the case says it.
        initial_speed: Option<f64>,
    },
    /// As it is told.
    Prescribed {
        /// At t = 0, rad/s.
        speed: f64,
        /// rad/s².
        acceleration: f64,
    },
    /// As a table of speed (rad/s) over time (s) tells it.
    Table(Arc<Columns>),
}

/// What a body is made of.
#[derive(Debug, Clone)]
pub(crate) enum Form {
    /// A mesh, which is reduced.
    Meshed(Box<MeshedBody>),
    /// Numbers.
    Rigid(RigidBody),
}

/// A body with a mesh.
#[derive(Debug, Clone)]
pub(crate) struct MeshedBody {
    /// Its mesh, and how it is reduced.
    pub(crate) body: rotor::Body,
    /// Sets of nodes held in all directions.
    pub(crate) held: Vec<Located>,
    /// Springs to the ground.
    pub(crate) ground_springs: Vec<GroundSpring>,
    /// Set of one node held along z.
    pub(crate) axial_restraint: Option<Located>,
    /// The section that turns with the frame: a set, or two sets of one node at opposite ends of a diameter.
    pub(crate) section: Vec<Located>,
    /// Whether the centrifugal stress stiffens it, if it turns.
    pub(crate) stiffening: bool,
    /// Whether it is taken as rigid, and not reduced.
    pub(crate) rigid: bool,
    /// Whether it may move along z, if it is rigid.
    pub(crate) moves_along_z: bool,
}

impl MeshedBody {
    /// One that nothing holds, with what a case may leave out of the rest.
    pub(super) fn of(body: rotor::Body) -> MeshedBody {
        MeshedBody {
            body,
            held: Vec::new(),
            ground_springs: Vec::new(),
            axial_restraint: None,
            section: Vec::new(),
            stiffening: false,
            rigid: false,
            moves_along_z: false,
        }
    }
}

/// A rigid body.
#[derive(Debug, Clone)]
pub(crate) struct RigidBody {
    /// kg.
    pub(crate) mass: f64,
    /// About its axis, kg·m².
    pub(crate) polar_inertia: f64,
    /// About x and y through its centre, kg·m²; a body without does not tilt.
    pub(crate) transverse_inertia: Option<f64>,
    /// Whether it may move along z.
    pub(crate) moves_along_z: bool,
    /// z of its centre, m, if the case says it.
    pub(crate) z: Option<f64>,
    /// To the ground along x and y, N/m.
    pub(crate) stiffness: [f64; 2],
    /// To the ground along x and y, N·s/m.
    pub(crate) damping: [f64; 2],
}

/// Dimensions from which a mesh is made.
#[derive(Debug, Clone)]
pub(crate) enum Dimensions {
    /// Of a solid shaft.
    Shaft(SolidShaft),
    /// Of one throw of a crankshaft.
    Crank(CrankThrow),
    /// Of rings below a beam.
    Support(RingSupport),
}

impl Dimensions {
    /// The mesh.
    ///
    /// # Errors
    /// Dimensions of which none can be made.
    pub(crate) fn mesh(&self, elements: &[&'static Element]) -> Result<mesh::Mesh, Error> {
        match self {
            Dimensions::Shaft(shaft) => shaft.mesh(elements),
            Dimensions::Crank(crank) => crank.mesh(elements),
            Dimensions::Support(support) => support.mesh(elements),
        }
    }

    /// How fine the layers of the mesh are, where that is known.
    pub(crate) fn fineness(&self) -> Option<mesh::Fineness> {
        match self {
            Dimensions::Shaft(shaft) => shaft.fineness(),
            Dimensions::Crank(_) => None,
            Dimensions::Support(support) => support.fineness(),
        }
    }
}

/// What joins two bodies, or a body and the ground: the values of a bearing, whose law a bushing and a coupling bring
/// with them.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    /// Its name, at its table; its number in the short form.
    pub(crate) name: Located,
    /// What results call it.
    pub(crate) called: SupportName,
    /// What it is.
    pub(crate) kind: JointKind,
    /// The journal, or the first side; the bore, or the second side.
    pub(crate) sides: [Side; 2],
    /// Its law and what the case says of it; the sets are those of the sides.
    pub(crate) bearing: Bearing,
    /// Laws of a bushing on other motions than the displacement in its plane.
    pub(crate) others: Vec<OtherLaw>,
    /// The file of its coefficients over the speed, if a bushing has one.
    pub(crate) table: Option<Located>,
    /// Whether its radial clearance is that which the meshes of both sides leave.
    pub(crate) clearance_from_mesh: bool,
    /// Angle of the only spring of a stop on one side, rad.
    pub(crate) angle: Option<f64>,
    /// Of the journal at the left end, the middle and the right end, m.
    pub(crate) run_out: [[f64; 2]; 3],
    /// Of the bore at the same, m.
    pub(crate) offset: [[f64; 2]; 3],
}

/// The law of a bushing on the tilts of its sides, or on their displacement along z.
#[derive(Debug, Clone)]
pub(crate) struct OtherLaw {
    /// On which.
    pub(crate) kind: MotionKind,
    /// Stiffness and damping.
    pub(crate) law: NamedLaw,
    /// Their values.
    pub(crate) parameters: Vec<SetParameter>,
    /// Where the case gives them.
    pub(crate) place: Located,
}

/// Kinds of joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum JointKind {
    /// A journal in its bore.
    Bearing,
    /// What strikes.
    Stop,
    /// Stiffness and damping in the plane.
    Bushing,
    /// Stiffness and damping between two rotations.
    Coupling,
}

impl JointKind {
    /// What messages call it, and its sides.
    pub(crate) fn words(self) -> (&'static str, [&'static str; 2]) {
        match self {
            JointKind::Bearing => ("bearing", ["journal", "bore"]),
            JointKind::Stop => ("stop", ["journal", "bore"]),
            JointKind::Bushing => ("bushing", ["first", "second"]),
            JointKind::Coupling => ("coupling", ["first", "second"]),
        }
    }
}

/// One side of a joint.
#[derive(Debug, Clone)]
pub(crate) struct Side {
    /// The body, by its place; none for the ground.
    pub(crate) body: Option<usize>,
    /// Where the case names it, or the joint.
    pub(crate) place: Located,
    /// Node sets on it: none, one or three.
    pub(crate) sets: Vec<Located>,
    /// Whether its one set is a surface, from one end of the joint to the other.
    pub(crate) surface: bool,
    /// z on a rigid body, m, if the case says it.
    pub(crate) z: Option<f64>,
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
    /// Whether a file is one of named bodies; none if it has short forms beside them, which has been noted.
    pub(super) fn is_in(file: &Table) -> Option<bool> {
        let named = NAMED.into_iter().find(|key| file.gives(key));
        let short = SHORT.into_iter().find(|key| file.gives(key));
        let (Some(named), Some(short)) = (named, short) else { return Some(named.is_some()) };
        let of_list = matches!(short, "bearing" | "load" | "stop");
        let heading = if of_list { format!("[[{short}]]") } else { format!("[{short}]") };
        let message = format!(
            "`{heading}` is a short form of a machine of its own, and `[{named}.NAME]` names bodies and joints: a file \
             has one form or the other"
        );
        let help = match short {
            "shaft" | "support" | "mass" => "describe it in a table `[body.NAME]`",
            "drive" => "describe it in a table `[drives.NAME]`",
            "load" => "describe it in a table `[loads.NAME]`",
            _ => "describe it in a table `[joint.NAME]`, with the values of `[springs]` in each",
        };
        file.push(file.written(short).error_here(Code::BAD_VALUE, message).help(help));
        // Which of both is meant, is open: neither is read as if it were.
        NAMED.iter().chain(&SHORT).chain(&["material"]).for_each(|key| file.pass_over(key));
        None
    }

    /// The machine, if all of it is right. `goes_on`: it has the speeds of another run.
    pub(super) fn read(store: FileStore, file: &Table, goes_on: bool) -> Option<JoinedMachine> {
        let before = file.errors();
        let materials = Materials::read(file);
        let (mut bodies, mut motions) = (Vec::new(), Vec::new());
        let joints = names::in_order(file, "joint");
        let thrust = joints.iter().any(|(_, joint)| bushing::acts_along(joint));
        for (name, table) in names::in_order(file, "body") {
            let read = table.read(|table| bodies::read(store, table, &name, (&materials, thrust)));
            bodies.push(read.body);
            motions.extend(read.motion);
        }
        if bodies.is_empty() && !file.has("body") {
            file.absent("body", "add a table `[body.NAME]` for each body of the machine");
        }
        let known: Vec<Located> = bodies.iter().map(|(name, _)| name.clone()).collect();
        let bodies: Option<Vec<NamedBody>> = bodies.into_iter().map(|(_, own)| own).collect();
        let turns = |body: usize| bodies.as_ref().map(|all| &all[body]);
        let labels: Vec<Located> = joints.iter().map(|(name, _)| name.clone()).collect();
        names::distinct(file, "body", &known);
        names::distinct(file, "joint", &labels);
        let joints = joints
            .into_iter()
            .map(|(name, table)| table.read(|table| joints::read(store, table, &name, &known)));
        let joints: Vec<Option<Joint>> = joints.collect();
        let drives = names::in_order(file, "drives");
        names::plain(file, "drive", drives.iter().map(|(name, _)| name));
        let drives = drives.into_iter().map(|(name, table)| {
            table.read(|table| forces::drive(store, table, &name, &known, turns, goes_on))
        });
        let drives: Vec<Option<Drive>> = drives.collect();
        let loads = names::in_order(file, "loads");
        names::plain(file, "load", loads.iter().map(|(name, _)| name));
        let loads = loads.into_iter();
        let loads = loads.map(|(name, table)| {
            table.read(|table| forces::load(store, table, &name, &known, turns))
        });
        let loads: Vec<Option<Load>> = loads.collect();
        let gravity = gravity::read(file);
        let motion = checks::one_motion(file, motions);
        if file.errors() > before {
            return None;
        }
        let machine = JoinedMachine {
            bodies: bodies?,
            joints: joints.into_iter().collect::<Option<_>>()?,
            drives: drives.into_iter().collect::<Option<_>>()?,
            loads: loads.into_iter().collect::<Option<_>>()?,
            motion: motion?,
            gravity,
            short: false,
        };
        machine.check(file, goes_on);
        Some(machine)
    }

    /// Notes what does not fit together.
    pub(super) fn check(&self, file: &Table, goes_on: bool) {
        checks::check(file, self, goes_on);
    }

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
