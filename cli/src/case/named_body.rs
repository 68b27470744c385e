//! A body by its name: how it turns, what it is made of, and what it carries.

use std::sync::Arc;

use whirl_codegen::diagnostic::Located;

use super::columns::Columns;
use super::rotor::{self, GroundSpring};

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

/// What is carried, and where.
#[derive(Debug, Clone)]
pub(crate) struct Attached {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// z of the section that carries it, m.
    pub(crate) z: f64,
    /// What it is.
    pub(crate) what: Carried,
}

/// What a section carries.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Carried {
    /// A rigid disc, its centre of mass on the axis.
    Disc {
        /// kg.
        mass: f64,
        /// About the axis, kg·m².
        polar_inertia: f64,
        /// About a diameter, kg·m².
        transverse_inertia: f64,
    },
    /// A point mass.
    Mass {
        /// kg.
        mass: f64,
        /// Along x and y of the turning frame, m.
        place: [f64; 2],
    },
    /// Mass times eccentricity along x and y of the turning frame, kg·m.
    Unbalance([f64; 2]),
}
