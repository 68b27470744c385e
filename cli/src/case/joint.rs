//! What joins two bodies, or a body and the ground.

use whirl_codegen::diagnostic::Located;
use whirl_solver::bearing::MotionKind;

use super::gears::Gears;
use super::law::NamedLaw;
use super::parameters::SetParameter;
use super::rotor::Bearing;
use super::supports::SupportName;

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
    /// The teeth of two gears.
    pub(crate) gears: Option<Gears>,
    /// What its law reads apart from where it acts.
    pub(crate) sensor: Option<Sensor>,
}

/// A sensor that looks at the body of the journal.
#[derive(Debug, Clone)]
pub(crate) struct Sensor {
    /// Where the case has it.
    pub(crate) place: Located,
    /// Where it looks at the journal's body, and what of the bore's body it stands on.
    pub(crate) sides: [Side; 2],
}

impl Joint {
    /// Whether it acts on a motion beside those in the plane: by a law for that alone, or by that of the whole joint.
    pub(crate) fn acts_on(&self, motion: MotionKind) -> bool {
        self.others.iter().any(|own| own.kind == motion) || self.bearing.law.source.acts_on(motion)
    }

    /// One that stands where its bodies have it, with nothing but the values of its bearing.
    pub(super) fn of(
        (name, called): (Located, SupportName),
        kind: JointKind,
        sides: [Side; 2],
        bearing: Bearing,
    ) -> Joint {
        Joint {
            name,
            called,
            kind,
            sides,
            bearing,
            others: Vec::new(),
            table: None,
            clearance_from_mesh: false,
            angle: None,
            run_out: [[0.0; 2]; 3],
            offset: [[0.0; 2]; 3],
            gears: None,
            sensor: None,
        }
    }
}

impl Side {
    /// On a body, or on the ground, with these node sets.
    pub(super) fn of(body: Option<usize>, place: Located, sets: Vec<Located>) -> Side {
        Side { body, place, sets, surface: false, z: None, at: None }
    }
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
    /// Teeth of two gears, on bodies whose axes are apart.
    Gear,
}

impl JointKind {
    /// What messages call it, and its sides.
    pub(crate) fn words(self) -> (&'static str, [&'static str; 2]) {
        match self {
            JointKind::Bearing => ("bearing", ["journal", "bore"]),
            JointKind::Stop => ("stop", ["journal", "bore"]),
            JointKind::Bushing => ("bushing", ["first", "second"]),
            JointKind::Coupling => ("coupling", ["first", "second"]),
            JointKind::Gear => ("gear", ["first", "second"]),
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
    /// z on a rigid body or on one made from sections, m, if the case says it.
    pub(crate) z: Option<f64>,
    /// x and y on a body that rocks (m), if the case says it, and where.
    pub(crate) at: Option<([f64; 2], Located)>,
}
