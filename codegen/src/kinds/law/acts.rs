//! What a law acts on, found from the names of its inputs and outputs.

use crate::units::Dimension;

/// What a law acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Acts {
    /// On each spring: at a fixed angle ψ on the bore, along its normal and its tangent.
    Spring,
    /// On a whole ring: once a plane, from the displacement of the shaft's centre line.
    Ring,
}

impl Acts {
    /// Both kinds.
    pub const ALL: [Acts; 2] = [Acts::Spring, Acts::Ring];

    /// Inputs that such a law can take.
    pub fn inputs(self) -> &'static [Quantity] {
        match self {
            Acts::Spring => SPRING_INPUTS,
            Acts::Ring => RING_INPUTS,
        }
    }

    /// Outputs that such a law can give.
    pub fn outputs(self) -> &'static [Quantity] {
        match self {
            Acts::Spring => SPRING_OUTPUTS,
            Acts::Ring => RING_OUTPUTS,
        }
    }

    /// Outputs without which such a law is of no use.
    pub(crate) fn needed(self) -> &'static [&'static str] {
        match self {
            Acts::Spring => &["Q"],
            Acts::Ring => &["F_x", "F_y"],
        }
    }

    /// What clearance files call the kind.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Acts::Spring => "spring",
            Acts::Ring => "ring",
        }
    }

    /// What it is called, with its article.
    pub fn called(self) -> &'static str {
        match self {
            Acts::Spring => "a law of a spring",
            Acts::Ring => "a law of a ring",
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

const RING_INPUTS: &[Quantity] = &[
    quantity("e_x", Dimension::LENGTH, "vertical displacement of the shaft in the bore"),
    quantity("e_y", Dimension::LENGTH, "horizontal displacement of the shaft in the bore"),
    quantity("e_x_dot", Dimension::SPEED, "rate of e_x"),
    quantity("e_y_dot", Dimension::SPEED, "rate of e_y"),
    OMEGA,
    THETA,
];

const RING_OUTPUTS: &[Quantity] = &[
    quantity("F_x", Dimension::FORCE, "vertical force on the shaft"),
    quantity("F_y", Dimension::FORCE, "horizontal force on the shaft"),
    quantity("M_z", Dimension::TORQUE, "torque on the shaft about its axis"),
];

/// Everything that a law of any kind can take or give, each name once, and the only kind that knows it if
/// there is one.
pub(super) fn known(
    list: fn(Acts) -> &'static [Quantity],
) -> Vec<(&'static Quantity, Option<Acts>)> {
    let mut known: Vec<(&'static Quantity, Option<Acts>)> = Vec::new();
    for acts in Acts::ALL {
        for quantity in list(acts) {
            match known.iter_mut().find(|(other, _)| other.name == quantity.name) {
                Some((_, only)) => *only = None,
                None => known.push((quantity, Some(acts))),
            }
        }
    }
    known
}
