//! What probes at a right angle to each other read.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use whirl_solver::linear::{LinearMachine, Point, Vibration};
use whirl_text::rounded;

use super::source::Source;
use crate::analysis::words;

/// What figures show of a motion.
#[derive(Debug, Clone, Copy)]
pub(super) enum Reading {
    /// The major semi-axis, with the phase along x.
    Orbit,
    /// Along a direction at an angle from x (rad).
    Probe(f64),
}

impl Reading {
    /// Two probes, or the orbit where there are none.
    pub(super) fn all(angle: Option<f64>) -> Vec<Reading> {
        angle.map_or(vec![Reading::Orbit], |angle| pair(angle).map(Reading::Probe).to_vec())
    }

    /// Zero to peak (m).
    pub(super) fn amplitude(self, own: &Vibration) -> f64 {
        match self {
            Reading::Orbit => own.orbit().major,
            Reading::Probe(angle) => own.along(angle),
        }
    }

    /// Parts of the complex amplitude (m).
    pub(super) fn vector(self, own: &Vibration) -> [f64; 2] {
        let value = match self {
            Reading::Orbit => own.amplitudes[0],
            Reading::Probe(angle) => own.reading(angle),
        };
        [value.re, value.im]
    }

    /// From the angle θ = 0 of the body (degrees).
    pub(super) fn phase(self, own: &Vibration) -> f64 {
        let [re, im] = self.vector(own);
        im.atan2(re).to_degrees()
    }

    /// What stands behind the name of a point.
    pub(super) fn suffix(self) -> String {
        match self {
            Reading::Orbit => String::new(),
            Reading::Probe(angle) => format!(" at {}°", degrees(angle)),
        }
    }
}

fn pair(angle: f64) -> [f64; 2] {
    [angle, angle + FRAC_PI_2]
}

/// An angle in degrees, without the last digits that units leave.
fn degrees(angle: f64) -> f64 {
    rounded(angle.to_degrees(), 10)
}

/// What both probes read at every point and speed.
pub(super) fn rows(
    linear: &LinearMachine,
    (points, angle): (&[Point], f64),
    speeds: &[f64],
    sources: &[Source],
) -> String {
    let mut text = String::from("speed_rpm,body,order,point,probe_deg,amplitude_um,phase_deg\n");
    for source in sources {
        let body = linear.machine().bodies[source.body].name();
        for (speed, motions) in speeds.iter().zip(&source.motions) {
            for (point, own) in points.iter().zip(motions) {
                for angle in pair(angle) {
                    let read = own.reading(angle);
                    writeln!(
                        text,
                        "{},{body},{},{},{},{},{}",
                        words::rpm(*speed),
                        source.order,
                        point.name,
                        degrees(angle),
                        1e6 * read.norm(),
                        read.arg().to_degrees()
                    )
                    .expect("text can be written");
                }
            }
        }
    }
    text
}
