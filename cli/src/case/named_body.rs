//! A body by its name: how it turns, what it is made of, and what it carries.

use std::sync::Arc;

use whirl_codegen::diagnostic::Located;
use whirl_solver::bodies::Rotation;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::model::AttachmentKind;
use whirl_solver::rigid::RigidBody;

use super::columns::Columns;
use super::dimensions::Dimensions;
use super::rotor::{self, GroundSpring};

/// A body.
#[derive(Debug, Clone)]
pub(crate) struct NamedBody {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// How its frame turns; none of a body that does not turn.
    pub(crate) rotation: Option<Rotation>,
    /// Speed at t = 0 (rad/s) of a body that turns freely, if the case says it.
    pub(crate) initial_speed: Option<f64>,
    /// The table of speed (rad/s) over time (s) that tells its rotation, if one does.
    pub(crate) speeds: Option<Arc<Columns>>,
    /// Where it is at t = 0 but for its rotation.
    pub(crate) start: BodyStart,
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
    /// One that stands on the common axis, does not turn, and carries nothing.
    pub(super) fn of(name: Located, form: Form) -> NamedBody {
        NamedBody {
            name,
            rotation: None,
            initial_speed: None,
            speeds: None,
            start: BodyStart::default(),
            axis: [0.0; 2],
            axis_given: false,
            form,
            attached: Vec::new(),
        }
    }

    /// Whether it is made from a table of sections: what stands on it may be placed by its z.
    pub(crate) fn has_sections(&self) -> bool {
        let Form::Meshed(own) = &self.form else { return false };
        let rotor::Mesh::Generated(made) = &own.body.mesh else { return false };
        matches!(made.dimensions, Dimensions::Sections(_))
    }

    /// Whether its frame turns: not that of a mass, which turns in it.
    pub(crate) fn turns(&self) -> bool {
        let still = matches!(self.rotation, Some(Rotation::Held | Rotation::Spinning { .. }));
        self.rotation.is_some() && !still
    }

    /// Whether it turns as its couples make it.
    pub(crate) fn is_free(&self) -> bool {
        matches!(self.rotation, Some(Rotation::Free))
    }

    /// Speed with which it turns in its frame (rad/s), if it does.
    pub(crate) fn spin(&self) -> Option<f64> {
        match self.rotation {
            Some(Rotation::Spinning { speed }) => Some(speed),
            _ => None,
        }
    }

    /// Whether its bores stand about its own axis: of all that turn, and of a rigid body whose table gives one. Those of a
    /// mesh stand where their nodes are, and all others about their journals.
    pub(crate) fn bores_on_axis(&self) -> bool {
        self.turns() || self.axis_given && matches!(self.form, Form::Rigid(_))
    }
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

/// What is carried, and where.
#[derive(Debug, Clone)]
pub(crate) struct Attached {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// z of the section that carries it, m.
    pub(crate) z: f64,
    /// What it is.
    pub(crate) what: AttachmentKind,
}
