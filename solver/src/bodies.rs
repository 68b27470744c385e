//! The bodies of a machine, and where their coordinates stand in q.

use std::ops::Range;
use std::sync::Arc;

use crate::body::BodyNode;
use crate::centre_of_mass::CentreOfMass;
use crate::measure::MeanMotion;
use crate::schedule::Schedule;
use crate::section::Section;
use crate::shaft::Shaft;
use crate::support::Support;

/// How the frame of a turning body turns.
#[derive(Debug, Clone, PartialEq)]
pub enum Rotation {
    /// θ follows from its equation of motion.
    Free,
    /// θ stays 0: the frame of the body stands still.
    Held,
    /// θ = Ω t + ½ α t²: its row is no equation, what is left of it is the couple that this takes.
    Prescribed {
        /// Ω, the speed at t = 0 (rad/s).
        speed: f64,
        /// α (rad/s²).
        acceleration: f64,
    },
    /// θ over time as it is told; its row as of a prescribed one.
    Scheduled(Arc<Schedule>),
    /// The frame of the body stands still, and the body turns in it from angle 0: its coordinates are those
    /// of points that do not turn with it, such as the centre of a mass, while laws get the angle and the
    /// speed.
    Spinning {
        /// rad/s.
        speed: f64,
    },
}

impl Rotation {
    /// θ (rad), θ̇ (rad/s) and θ̈ (rad/s²) of the frame at time `t` (s); none of a rotation that is free. `before`: θ̈ where it
    /// jumps at t is that until then.
    pub(crate) fn given(&self, t: f64, before: bool) -> Option<[f64; 3]> {
        match self {
            Rotation::Free => None,
            Rotation::Held | Rotation::Spinning { .. } => Some([0.0; 3]),
            Rotation::Prescribed { speed, acceleration } => {
                let angle = (speed + 0.5 * acceleration * t) * t;
                Some([angle, speed + acceleration * t, *acceleration])
            }
            Rotation::Scheduled(schedule) if before => Some(schedule.until(t)),
            Rotation::Scheduled(schedule) => Some(schedule.at(t)),
        }
    }

    /// Speed with which the body turns in its frame (rad/s).
    pub(crate) fn spin(&self) -> Option<f64> {
        match *self {
            Rotation::Spinning { speed } => Some(speed),
            _ => None,
        }
    }

    /// Speed at t = 0 (rad/s) of one that a march can be told: see [`March::tell`](crate::dynamics::March::tell).
    pub fn told_speed(&self) -> Option<f64> {
        let given = self.takes_a_couple().then(|| self.given(0.0, false));
        given.flatten().map(|[_, speed, _]| speed)
    }

    /// Whether a couple makes the frame turn as it is told.
    pub(crate) fn takes_a_couple(&self) -> bool {
        matches!(self, Rotation::Prescribed { .. } | Rotation::Scheduled(_))
    }
}

/// A body of a machine. Positions of its nodes count from its own axis.
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a machine has a handful of bodies")]
pub enum Body {
    /// One with a frame that turns about its axis, parallel to z.
    Turning {
        /// Its name in messages and results.
        name: String,
        /// Its tensors.
        shaft: Shaft,
        /// How its frame turns.
        rotation: Rotation,
    },
    /// One in the fixed frame.
    Standing {
        /// Its name in messages and results.
        name: String,
        /// Its oscillators.
        support: Support,
    },
}

impl Body {
    /// A body that turns.
    pub fn turning(name: &str, shaft: Shaft, rotation: Rotation) -> Body {
        Body::Turning { name: name.to_owned(), shaft, rotation }
    }

    /// A body that does not turn.
    pub fn standing(name: &str, support: Support) -> Body {
        Body::Standing { name: name.to_owned(), support }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            Body::Turning { name, .. } | Body::Standing { name, .. } => name,
        }
    }

    /// Its coordinates without a rotation.
    pub fn size(&self) -> usize {
        match self {
            Body::Turning { shaft, .. } => shaft.size(),
            Body::Standing { support, .. } => support.size(),
        }
    }

    /// The nodes whose motion is known.
    pub fn nodes(&self) -> &[BodyNode] {
        match self {
            Body::Turning { shaft, .. } => &shaft.nodes,
            Body::Standing { support, .. } => &support.nodes,
        }
    }

    /// As [`Body::nodes`].
    pub(crate) fn nodes_mut(&mut self) -> &mut Vec<BodyNode> {
        match self {
            Body::Turning { shaft, .. } => &mut shaft.nodes,
            Body::Standing { support, .. } => &mut support.nodes,
        }
    }

    /// Frequencies of its modes with what it retains held (Hz).
    pub fn hertz(&self) -> &[f64] {
        match self {
            Body::Turning { shaft, .. } => &shaft.hertz,
            Body::Standing { support, .. } => &support.hertz,
        }
    }

    /// Its mean motions.
    pub fn measures(&self) -> &[MeanMotion] {
        match self {
            Body::Turning { shaft, .. } => &shaft.measures,
            Body::Standing { support, .. } => &support.measures,
        }
    }

    /// Its sections, by z.
    pub fn sections(&self) -> &[Section] {
        match self {
            Body::Turning { shaft, .. } => &shaft.sections,
            Body::Standing { support, .. } => &support.sections,
        }
    }

    /// What each coordinate is.
    pub(crate) fn coordinates(&self) -> &[String] {
        match self {
            Body::Turning { shaft, .. } => &shaft.coordinates,
            Body::Standing { support, .. } => &support.coordinates,
        }
    }

    /// Its mass, and where that is.
    pub fn centre_of_mass(&self) -> &CentreOfMass {
        match self {
            Body::Turning { shaft, .. } => &shaft.centre_of_mass,
            Body::Standing { support, .. } => &support.centre_of_mass,
        }
    }

    /// Its tensors, if it turns.
    pub fn shaft(&self) -> Option<&Shaft> {
        match self {
            Body::Turning { shaft, .. } => Some(shaft),
            Body::Standing { .. } => None,
        }
    }

    /// Its oscillators, if it stands.
    pub fn support(&self) -> Option<&Support> {
        match self {
            Body::Turning { .. } => None,
            Body::Standing { support, .. } => Some(support),
        }
    }

    /// How it turns, if it does.
    pub fn rotation(&self) -> Option<&Rotation> {
        match self {
            Body::Turning { rotation, .. } => Some(rotation),
            Body::Standing { .. } => None,
        }
    }
}

/// Where the coordinates of a body stand in q.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyPlace {
    /// θ, of a body that turns.
    pub rotation: Option<usize>,
    /// η, or x_b.
    pub flexible: Range<usize>,
}

/// What stands at a place of q.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Owner {
    /// The body.
    pub(crate) body: usize,
    /// Its coordinate; none for its rotation.
    pub(crate) coordinate: Option<usize>,
}

/// The order of q: rotations that are given, rotations that are unknown, then the coordinates of body after body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Layout {
    pub(crate) places: Vec<BodyPlace>,
    pub(crate) owners: Vec<Owner>,
    /// Rotations that are no unknowns.
    pub(crate) given: usize,
    /// All rotations.
    pub(crate) rotations: usize,
}

impl Layout {
    pub(crate) fn new(bodies: &[Body]) -> Layout {
        let is_given = |body: &Body| body.rotation().map(|own| own.given(0.0, false).is_some());
        let turning = |given: bool| {
            let bodies = bodies.iter().enumerate();
            bodies.filter(move |(_, body)| is_given(body) == Some(given)).map(|(place, _)| place)
        };
        let given = turning(true).count();
        let mut owners: Vec<Owner> = turning(true)
            .chain(turning(false))
            .map(|body| Owner { body, coordinate: None })
            .collect();
        let rotations = owners.len();
        let mut places = Vec::with_capacity(bodies.len());
        for (body, own) in bodies.iter().enumerate() {
            let rotation = owners[..rotations].iter().position(|owner| owner.body == body);
            let first = owners.len();
            owners.extend((0..own.size()).map(|j| Owner { body, coordinate: Some(j) }));
            places.push(BodyPlace { rotation, flexible: first..owners.len() });
        }
        Layout { places, owners, given, rotations }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn given_rotations_come_first_and_bodies_follow_in_their_order() {
        let shaft = || Shaft::lumped(1.0, [1.0; 2], [0.0; 2], 0.0);
        let support = || Support::lumped(1.0, [1.0; 2], [0.0; 2], &[]);
        let bodies = [
            Body::turning("a", shaft(), Rotation::Free),
            Body::standing("b", support()),
            Body::turning("c", shaft(), Rotation::Held),
            Body::turning("d", shaft(), Rotation::Free),
        ];
        let layout = Layout::new(&bodies);
        let places: Vec<_> =
            layout.places.iter().map(|own| (own.rotation, own.flexible.clone())).collect();
        assert_eq!(places, [(Some(1), 3..5), (None, 5..7), (Some(0), 7..9), (Some(2), 9..11)]);
        assert_eq!((layout.given, layout.rotations, layout.owners.len()), (1, 3, 11));
        assert_eq!(layout.owners[0], Owner { body: 2, coordinate: None });
        assert_eq!(layout.owners[6], Owner { body: 1, coordinate: Some(1) });
    }

    #[test]
    fn a_prescribed_angle_is_the_integral_of_its_speed() {
        let rotation = Rotation::Prescribed { speed: 3.0, acceleration: -2.0 };
        assert_eq!(rotation.given(2.0, false), Some([2.0, -1.0, -2.0]));
        assert_eq!(Rotation::Free.given(2.0, false), None);
        assert_eq!(Rotation::Held.given(2.0, false), Some([0.0; 3]));
    }
}
