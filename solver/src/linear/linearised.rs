//! The equations of small motions about a state that stands.

use std::borrow::Cow;

use num_complex::Complex64;

use super::beside::beside;
use super::dependent::Dependent;
use super::first_order;
use super::round::LinearMachine;
use crate::dynamics::{Standing, standing_at};
use crate::error::Error;
use crate::linalg::{FirstOrder, LinearAlgebraError, Matrix, Periodic, solve_complex};
use crate::machine::Machine;

/// Angles among which those that nothing holds are looked for.
const MOST_ANGLES: usize = 6;

/// A state in which the machine stands at constant speeds, with the equations of small motions about it.
pub struct Standstill {
    pub(super) found: Standing,
    /// Places in q of the angles that small motions change: those of bodies whose speed was found, and of others that turn freely
    /// and are tied to some that turn.
    pub(super) angles: Vec<usize>,
    /// Whether it is of bodies made round.
    pub(super) is_mean: bool,
    /// θ̇ by body (rad/s); 0 of one that stands.
    pub speeds: Vec<f64>,
}

impl Standstill {
    /// Eccentricity over clearance in each bearing, with its name; none where it has no clearance.
    pub fn eccentricities(&self) -> &[(String, Option<f64>)] {
        &self.found.eccentricities
    }
}

/// M′z̈ + C′ż + K′z = 0 of motions z: over the angles of bodies that turn at no given speed, then the
/// coordinates of all bodies in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearised {
    /// How many angles there are.
    pub angles: usize,
    /// The bodies that turn by these angles, by their places.
    pub turning: Vec<usize>,
    /// M′, symmetric.
    pub mass: Matrix,
    /// C′, with gyroscopic terms.
    pub damping: Matrix,
    /// K′.
    pub stiffness: Matrix,
    /// Ω_f (rad/s) of the frame in which they are seen; 0 of space.
    pub frame: f64,
    /// What varies with the angle of a body, M′, C′ and K′ being the means over its turns.
    pub(crate) varying: Option<Periodic>,
    /// Joints whose coefficients depend on the frequency; C′ and K′ have those of what stands still.
    pub(crate) dependent: Vec<Dependent>,
    /// States of laws; C′ and K′ have them stand still.
    pub(crate) remembered: Option<FirstOrder>,
}

impl Linearised {
    /// Whether coefficients of joints depend on the frequency of the motion, by themselves or as laws have states.
    pub fn depends_on_frequency(&self) -> bool {
        !self.dependent.is_empty() || self.remembered.is_some()
    }

    /// The equations with the coefficients that joints and states of laws have at a frequency (rad/s): exact for motions of that frequency.
    pub fn at_frequency(&self, frequency: f64) -> Cow<'_, Linearised> {
        if !self.depends_on_frequency() {
            return Cow::Borrowed(self);
        }
        let mut own = Linearised { dependent: Vec::new(), remembered: None, ..self.clone() };
        for joint in &self.dependent {
            joint.add(frequency, &mut own.damping, &mut own.stiffness);
        }
        if let Some(states) = &self.remembered {
            first_order::add(states, frequency, &mut own.damping, &mut own.stiffness);
        }
        Cow::Owned(own)
    }

    /// The motion z of Re(z e^{iωt}) by a force, (K′ + iωC′ − ω²M′) z = f.
    ///
    /// # Errors
    /// A matrix that is singular.
    pub(super) fn moved_by(
        &self,
        frequency: f64,
        force: &[Complex64],
    ) -> Result<Vec<Complex64>, Error> {
        let held = self.at_frequency(frequency);
        let Linearised { mass, damping, stiffness, .. } = &*held;
        let square = frequency * frequency;
        let entry = |m: f64, c: f64, k: f64| Complex64::new(k - square * m, frequency * c);
        let entries = mass.data.iter().zip(&damping.data).zip(&stiffness.data);
        let matrix: Vec<Complex64> = entries.map(|((m, c), k)| entry(*m, *c, *k)).collect();
        match solve_complex(mass.rows, &matrix, force) {
            Err(LinearAlgebraError::Singular { .. }) if frequency == 0.0 && self.angles > 0 => {
                Ok(self.with_free_angles_held(&matrix, force)?)
            }
            solved => Ok(solved?),
        }
    }

    /// A mean position, where nothing holds some angle of bodies that turn freely: with as few angles as they are as will do. The
    /// torque that the position leaves on such a body changes its speed a little, not its angle.
    ///
    /// # Errors
    /// A matrix that is singular otherwise.
    fn with_free_angles_held(
        &self,
        matrix: &[Complex64],
        force: &[Complex64],
    ) -> Result<Vec<Complex64>, LinearAlgebraError> {
        let n = self.mass.rows;
        let held = |which: u32| {
            let (mut matrix, mut force) = (matrix.to_vec(), force.to_vec());
            for angle in (0..self.angles.min(MOST_ANGLES)).filter(|angle| which >> angle & 1 == 1) {
                for other in 0..n {
                    matrix[angle + n * other] = Complex64::ZERO;
                    matrix[other + n * angle] = Complex64::ZERO;
                }
                matrix[angle * (n + 1)] = Complex64::ONE;
                force[angle] = Complex64::ZERO;
            }
            solve_complex(n, &matrix, &force)
        };
        let mut choices: Vec<u32> = (1..1 << self.angles.min(MOST_ANGLES)).collect();
        choices.sort_by_key(|which| which.count_ones());
        let mut found = held(0);
        for which in choices {
            if found.is_ok() {
                break;
            }
            found = held(which);
        }
        found
    }

    /// Whether they are constant as space sees them.
    pub fn stands_in_space(&self) -> bool {
        self.frame == 0.0 && self.varying.is_none()
    }
}

impl LinearMachine {
    /// The state in which loads that stand in space are balanced at the speeds, as [`LinearMachine::speeds`] gives them; from
    /// one nearby, if there is one. At rest bodies are as they are, round or not.
    ///
    /// # Errors
    /// There is none, or it was not found; a force jumps there.
    pub fn standing(
        &self,
        at: &[Option<f64>],
        near: Option<&Standstill>,
    ) -> Result<Standstill, Error> {
        let is_still = self.turning().all(|body| at.get(body).copied().flatten() == Some(0.0));
        self.standing_of(if is_still { &self.still } else { &self.machine }, at, near)
    }

    /// The states at several speeds, each found by itself, on all processors; see [`LinearMachine::standing`].
    pub fn standing_all(&self, at: &[Vec<Option<f64>>]) -> Vec<Result<Standstill, Error>> {
        beside(self.threads, at, &|own| self.standing(own, None))
    }

    /// The same with bodies made round at rest, too, so that modes go on from there to other speeds.
    pub(super) fn standing_round(
        &self,
        at: &[Option<f64>],
        near: Option<&Standstill>,
    ) -> Result<Standstill, Error> {
        self.standing_of(&self.machine, at, near)
    }

    fn standing_of(
        &self,
        machine: &Machine,
        at: &[Option<f64>],
        near: Option<&Standstill>,
    ) -> Result<Standstill, Error> {
        let from = near.map(|own| own.found.unknowns.as_slice());
        let found = standing_at(machine, at, &self.generators, from);
        let found = found.map_err(|error| self.not_standing(at, error))?;
        let places = self.machine.places().iter();
        let speeds = places.map(|own| own.rotation.map_or(0.0, |theta| found.state.v[theta]));
        let tied = self.machine.tied_rotations();
        let free = self.turning().filter_map(|body| {
            let theta = self.machine.places()[body].rotation?;
            let is_unknown = theta >= self.machine.first_unknown();
            // At a speed that is told a body swings as well, if it turns freely and joints tie it to others.
            let swings = at.get(body).copied().flatten().is_none()
                || self.all_swing
                || tied.contains(&theta);
            (is_unknown && swings).then_some(theta)
        });
        let mut angles: Vec<usize> = free.collect();
        angles.sort_unstable();
        let is_mean = std::ptr::eq(machine, &raw const self.machine);
        let stood = Standstill { speeds: speeds.collect(), found, angles, is_mean };
        self.has_no_jump(at, &stood)?;
        self.has_no_stiff_joint(&stood)?;
        Ok(stood)
    }

    /// An error with the speeds at which it was.
    fn not_standing(&self, at: &[Option<f64>], error: Error) -> Error {
        let Error::NoEquilibrium { rows, journals, share } = error else { return error };
        let at = self.told(at);
        Error::NotStanding { at, rows, journals, share }
    }

    /// Bodies with the speeds that they are given, in words.
    pub(super) fn told(&self, at: &[Option<f64>]) -> String {
        let rpm =
            |speed: f64| whirl_text::shown(speed * 60.0 / std::f64::consts::TAU, 6, 1e-3..1e7);
        let known =
            self.machine.bodies.iter().zip(at).filter_map(|(body, speed)| {
                Some(format!("{} at {} rpm", body.name(), rpm((*speed)?)))
            });
        let known: Vec<String> = known.collect();
        if known.is_empty() { "no body turning".to_owned() } else { known.join(", ") }
    }

    /// The machine that stands in a state.
    pub(super) fn machine_of(&self, at: &Standstill) -> &Machine {
        if at.is_mean { &self.machine } else { &self.still }
    }

    /// The bodies of the angles of small motions.
    pub(super) fn turning_by(&self, at: &Standstill) -> Vec<usize> {
        at.angles.iter().map(|&theta| self.machine.owner(theta).body).collect()
    }

    /// Places in q of the coordinates of small motions.
    pub(super) fn kept(&self, at: &Standstill) -> Vec<usize> {
        let flexible = self.machine.rotations()..self.machine.size();
        at.angles.iter().copied().chain(flexible).collect()
    }

    /// The equations of small motions: seen from space, where all bodies that turn are round. With one that is not, in its frame
    /// if nothing varies there, or with what varies with its angle seen from space.
    ///
    /// # Errors
    /// Several bodies that are not round at different speeds; one beside a joint whose coefficients depend on the frequency.
    pub fn linearised(&self, at: &Standstill) -> Result<Linearised, Error> {
        let dependent = self.dependent(at)?;
        let Some((uneven, body)) = self.uneven_at(at)? else {
            let machine = self.uneven.as_ref().filter(|_| at.is_mean);
            let tangents = machine.map(|own| self.tangents(own, at, &|_| 0.0));
            let tangents = tangents.as_ref().unwrap_or(&at.found.tangents);
            let seen = self.seen(at, &|_| 0.0, (0.0, 0.0));
            let constant = self.constant(at, self.in_frame((&at.angles, tangents), &seen));
            return Ok(Linearised { dependent, remembered: self.remembered(at), ..constant });
        };
        if let Some(plane) = self.machine.springs.remembering(|_| true) {
            let (joint, law) = self.machine.names_of(plane);
            let body = self.machine.bodies[body].name().to_owned();
            return Err(Error::RemembersNotRound { joint, law, body });
        }
        if let Some(joint) = dependent.first() {
            return Err(Error::FrequenciesNotRound {
                joint: self.machine.monitors[joint.joint].name.clone(),
                body: self.machine.bodies[body].name().to_owned(),
            });
        }
        Ok(self.varying(at, uneven, body))
    }

    /// M′, C′ and K′ about a state as equations that nothing varies, seen from space.
    pub(super) fn constant(
        &self,
        at: &Standstill,
        [mass, damping, stiffness]: [Matrix; 3],
    ) -> Linearised {
        Linearised {
            angles: at.angles.len(),
            turning: self.turning_by(at),
            mass,
            damping,
            stiffness,
            frame: 0.0,
            varying: None,
            dependent: Vec::new(),
            remembered: None,
        }
    }
}
