//! What `whirl check` says of what the history has beside its usual columns.

use whirl_solver::loads::Frame;
use whirl_solver::output::{JointQuantity, Motion, Wanted};
use whirl_text::rounded;

use crate::case::{Case, OutputPoint};

/// A line an output.
pub(super) fn all(case: &Case) -> Vec<String> {
    let body = |place: usize| case.machine.bodies[place].name.text();
    let joint = |place: usize| case.machine.joints[place].called.word.as_str();
    let of_frame = |frame: Frame| match frame {
        Frame::Space => "",
        Frame::Body => ", in the frame of the body",
    };
    let one = |what: &Wanted<OutputPoint>| match what {
        Wanted::Motion { body: own, point, motion, frame, components } => {
            let quantity = match motion {
                Motion::Displacement => "displacement",
                Motion::Velocity => "velocity",
                Motion::Acceleration => "acceleration",
            };
            let mm = |z: f64| rounded(1e3 * z, 6);
            let at = match point {
                OutputPoint::Set(set) => format!(" at the set {}", set.text()),
                OutputPoint::Section(z, _) => {
                    format!(" at z = {} mm, the mean of the section", mm(*z))
                }
                OutputPoint::At(Some(z)) => format!(" at z = {} mm", mm(*z)),
                OutputPoint::At(None) => String::new(),
            };
            let axes: Vec<&str> = components.iter().map(|own| ["x", "y", "z"][*own]).collect();
            let (axes, of) = (axes.join(", "), of_frame(*frame));
            format!("{quantity} of {}{at}, along {axes}{of}", body(*own))
        }
        Wanted::Joint { joint: own, quantity, frame } => {
            let quantity = match quantity {
                JointQuantity::Force => "force on the journal",
                JointQuantity::Deformation => "displacement across the joint",
                JointQuantity::Rate => "rate of the displacement across the joint",
                JointQuantity::Torque => "torque on the journal",
                JointQuantity::Twist => "twist of the joint",
                JointQuantity::TwistRate => "rate of the twist of the joint",
                JointQuantity::Moment => "moment on the journal",
                JointQuantity::Tilt => "tilt across the joint",
                JointQuantity::AxialForce => "axial force on the journal",
                JointQuantity::AxialDeformation => "axial displacement across the joint",
            };
            format!("{quantity}, {}{}", joint(*own), of_frame(*frame))
        }
        Wanted::Energy { body: own } => format!("energy of {}", body(*own)),
        Wanted::Power { body: own } => format!("power of {}", body(*own)),
        Wanted::JointPower { joint: own } => format!("power of {}", joint(*own)),
        Wanted::Film { joint: own, .. } => format!("what is in the film of {}", joint(*own)),
        Wanted::States { joint: own, .. } => format!("states of the law of {}", joint(*own)),
    };
    case.outputs.iter().map(|own| format!("output {}: {}", own.name, one(&own.what))).collect()
}
