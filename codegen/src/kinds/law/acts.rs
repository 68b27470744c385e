//! What a law acts on, found from the names of its inputs and outputs.

use crate::units::Dimension;

/// What a law acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Acts {
    /// On each spring: at a fixed angle ψ on the bore, along its normal and its tangent.
    Spring,
    /// On a whole ring: once a plane, from the displacement of the shaft's centre line.
    Ring,
    /// On a whole joint: once, from the displacement and the tilts of the sections on both sides.
    Joint,
    /// On a whole joint: once, from the displacement of the shaft's centre line and from what a sensor reads elsewhere.
    Sensor,
    /// On two gears: at their teeth, along the line of action.
    Gear,
}

impl Acts {
    /// All kinds.
    pub const ALL: [Acts; 5] = [Acts::Spring, Acts::Ring, Acts::Joint, Acts::Sensor, Acts::Gear];

    /// Whether a law of this kind may have all that one of the other has.
    pub(super) fn has_all_of(self, other: Acts) -> bool {
        self == other || matches!((self, other), (Acts::Joint | Acts::Sensor, Acts::Ring))
    }

    /// Inputs that such a law can take.
    pub fn inputs(self) -> &'static [Quantity] {
        match self {
            Acts::Spring => SPRING_INPUTS,
            Acts::Ring => RING_INPUTS,
            Acts::Joint => JOINT_INPUTS,
            Acts::Sensor => SENSOR_INPUTS,
            Acts::Gear => GEAR_INPUTS,
        }
    }

    /// Outputs that such a law can give.
    pub fn outputs(self) -> &'static [Quantity] {
        match self {
            Acts::Spring => SPRING_OUTPUTS,
            Acts::Ring => RING_OUTPUTS,
            Acts::Joint => JOINT_OUTPUTS,
            Acts::Sensor => RING_OUTPUTS,
            Acts::Gear => GEAR_OUTPUTS,
        }
    }

    /// Outputs without which such a law is of no use.
    pub(crate) fn needed(self) -> &'static [&'static str] {
        match self {
            Acts::Spring => &["Q"],
            Acts::Ring | Acts::Joint | Acts::Sensor => &["F_x", "F_y"],
            Acts::Gear => &["F_n"],
        }
    }

    /// What clearance files call the kind.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Acts::Spring => "spring",
            Acts::Ring => "ring",
            Acts::Joint => "joint",
            Acts::Sensor => "sensor",
            Acts::Gear => "gear",
        }
    }

    /// What it is called, with its article.
    pub fn called(self) -> &'static str {
        match self {
            Acts::Spring => "a law of a spring",
            Acts::Ring => "a law of a ring",
            Acts::Joint => "a law of a joint",
            Acts::Sensor => "a law of a joint with a sensor",
            Acts::Gear => "a law of a gear",
        }
    }
}

/// A quantity that the solver knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quantity {
    /// Its name in specs.
    pub name: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// What it is.
    pub title: &'static str,
}

const fn quantity(name: &'static str, dimension: Dimension, title: &'static str) -> Quantity {
    Quantity { name, dimension, title }
}

/// ω is α̇, the speed of the journal relative to the mean rotation of the bore.
const OMEGA: Quantity = quantity("omega", Dimension::ANGULAR_SPEED, "speed of the journal");
const THETA: Quantity = quantity("theta", Dimension::ANGLE, "rotation of the journal");

const SPRING_INPUTS: &[Quantity] = &[
    quantity("h", Dimension::LENGTH, "clearance"),
    quantity("h_dot", Dimension::SPEED, "rate of the clearance"),
    quantity("psi", Dimension::ANGLE, "angle of the spring on the bore, from the vertical axis x"),
    OMEGA,
    quantity("v_t", Dimension::SPEED, "tangential velocity of the journal's surface on the bore"),
    THETA,
];

const SPRING_OUTPUTS: &[Quantity] = &[
    quantity("Q", Dimension::FORCE, "normal force, positive if it pushes journal and bore apart"),
    quantity("T", Dimension::FORCE, "tangential force on the journal, positive along v_t"),
];

const E_X: Quantity =
    quantity("e_x", Dimension::LENGTH, "vertical displacement of the shaft in the bore");
const E_Y: Quantity =
    quantity("e_y", Dimension::LENGTH, "horizontal displacement of the shaft in the bore");
const E_X_DOT: Quantity = quantity("e_x_dot", Dimension::SPEED, "rate of e_x");
const E_Y_DOT: Quantity = quantity("e_y_dot", Dimension::SPEED, "rate of e_y");
const F_X: Quantity = quantity("F_x", Dimension::FORCE, "vertical force on the shaft");
const F_Y: Quantity = quantity("F_y", Dimension::FORCE, "horizontal force on the shaft");
const M_Z: Quantity = quantity("M_z", Dimension::TORQUE, "torque on the shaft about its axis");

const RING_INPUTS: &[Quantity] = &[E_X, E_Y, E_X_DOT, E_Y_DOT, OMEGA, THETA];

const RING_OUTPUTS: &[Quantity] = &[F_X, F_Y, M_Z];

const JOINT_INPUTS: &[Quantity] = &[
    E_X,
    E_Y,
    quantity("e_z", Dimension::LENGTH, "displacement of the shaft in the bore along z"),
    quantity(
        "alpha_x",
        Dimension::ANGLE,
        "tilt of the shaft in the bore about the vertical axis x",
    ),
    quantity(
        "alpha_y",
        Dimension::ANGLE,
        "tilt of the shaft in the bore about the horizontal axis y",
    ),
    E_X_DOT,
    E_Y_DOT,
    quantity("e_z_dot", Dimension::SPEED, "rate of e_z"),
    quantity("alpha_x_dot", Dimension::ANGULAR_SPEED, "rate of alpha_x"),
    quantity("alpha_y_dot", Dimension::ANGULAR_SPEED, "rate of alpha_y"),
    OMEGA,
    THETA,
];

const JOINT_OUTPUTS: &[Quantity] = &[
    F_X,
    F_Y,
    quantity("F_z", Dimension::FORCE, "force on the shaft along z"),
    quantity("M_x", Dimension::TORQUE, "moment on the shaft about the vertical axis x"),
    quantity("M_y", Dimension::TORQUE, "moment on the shaft about the horizontal axis y"),
    M_Z,
];

const SENSOR_INPUTS: &[Quantity] = &[
    E_X,
    E_Y,
    E_X_DOT,
    E_Y_DOT,
    quantity("y_x", Dimension::LENGTH, "vertical displacement of the shaft that its sensor reads"),
    quantity(
        "y_y",
        Dimension::LENGTH,
        "horizontal displacement of the shaft that its sensor reads",
    ),
    quantity("y_x_dot", Dimension::SPEED, "rate of y_x"),
    quantity("y_y_dot", Dimension::SPEED, "rate of y_y"),
    OMEGA,
    THETA,
];

const GEAR_INPUTS: &[Quantity] = &[
    quantity("e_n", Dimension::LENGTH, "overlap of the teeth along the line of action"),
    quantity("e_n_dot", Dimension::SPEED, "rate of e_n"),
];

const GEAR_OUTPUTS: &[Quantity] = &[quantity(
    "F_n",
    Dimension::FORCE,
    "force along the line of action, negative if it pushes the teeth apart",
)];

/// Everything that a law of any kind can take or give, each name once, and the kind that tells itself by it: the only one
/// that knows it, or the one whose names the others that know it have all of.
pub(super) fn known(
    list: fn(Acts) -> &'static [Quantity],
) -> Vec<(&'static Quantity, Option<Acts>)> {
    let mut known: Vec<(&'static Quantity, Option<Acts>)> = Vec::new();
    for acts in Acts::ALL {
        for quantity in list(acts) {
            match known.iter_mut().find(|(other, _)| other.name == quantity.name) {
                Some((_, Some(only))) if acts.has_all_of(*only) => {}
                Some((_, only)) => *only = None,
                None => known.push((quantity, Some(acts))),
            }
        }
    }
    known
}
