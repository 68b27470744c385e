//! What may be wrong with modes, and what would mend it.

use std::f64::consts::TAU;
use std::fmt;

use whirl_text::rounded;

use super::linearised::{Linearised, Standstill};
use super::modes::Mode;
use super::round::LinearMachine;
use super::standing_loads::Counted;
use crate::error::Error;

/// Share of a mode's inertia from which on a body takes part.
const TAKES_PART: f64 = 0.2;
/// Frequencies of a reduction are twice those of the modes that are trusted.
const TWICE: f64 = 2.0;
/// Share by which entries of the equations may vary with the angles of bodies unsaid.
const VARIES: f64 = 1e-6;

/// Something that limits what modes are worth.
#[derive(Debug, Clone, PartialEq)]
pub enum Doubt {
    /// A body that turns and is not round.
    NotRound {
        /// Its name.
        body: String,
        /// What it lacks.
        lack: String,
        /// Whether its equations vary even in its own frame.
        varies: bool,
    },
    /// A body that counts as round below a frequency only, which modes exceed.
    RoundBelow {
        /// Its name.
        body: String,
        /// That frequency (Hz).
        hertz: f64,
    },
    /// Modes near the last one that a body has.
    EndOfReduction {
        /// Its name.
        body: String,
        /// The frequency of its last mode with its joints held (Hz).
        last: f64,
        /// The frequency of the first mode that is near it (Hz).
        first: f64,
    },
    /// Modes slower or faster than the rows of a table over the frequency.
    BeyondRows {
        /// The joint.
        joint: String,
        /// Frequencies of its first and last row (Hz).
        rows: [f64; 2],
        /// How many modes are slower, and how many are faster.
        modes: [usize; 2],
    },
    /// A law that is used where it may not be believed.
    NotValid {
        /// The joint, the law, and what of it is beyond its limit.
        joint: String,
        /// See `joint`.
        law: String,
        /// See `joint`.
        title: String,
        /// The worst value, and the limit that it is beyond, in `unit`.
        value: f64,
        /// See `value`.
        limit: f64,
        /// See `value`.
        unit: String,
        /// Speeds of the analysis at which it is, the least and the largest (rad/s), and whether that is not all of them.
        speeds: [f64; 2],
        /// See `speeds`.
        of_some: bool,
        /// What the law says of it.
        help: String,
    },
    /// Joints that stand open.
    Open {
        /// Joints whose clearance nothing closes, so that they have no stiffness.
        joints: Vec<String>,
        /// Where (rad/s).
        speed: f64,
    },
    /// Joints that are linear for small motions only.
    LinearWithin {
        /// The joints, with the amplitude (m) up to which they are, and the speed at which that is (rad/s).
        joints: Vec<(String, f64)>,
        /// See `joints`.
        speed: f64,
    },
    /// A response that is larger than the motion for which a joint is linear.
    NotSmall {
        /// The joint.
        joint: String,
        /// Where it is worst (rad/s), the amplitude there (m), and that up to which it is linear.
        speed: f64,
        /// See `speed`.
        amplitude: f64,
        /// See `speed`.
        within: f64,
        /// Whether its journal has a run-out.
        runs_out: bool,
    },
    /// A bore that turns and is off its axis, which stands in the state.
    TurningOffset {
        /// The joint, and the body of its bore.
        joint: String,
        /// See `joint`.
        body: String,
    },
    /// A load that varies, and how it counts.
    Load {
        /// Its name.
        load: String,
        /// How.
        counted: Counted,
    },
    /// Bodies that nothing holds where the machine stands.
    Unheld {
        /// Their names, with how they move.
        bodies: Vec<String>,
    },
    /// A motion that grows, beyond a speed so slowly that it is not told from one that nothing holds.
    TooSlow {
        /// The body that moves most.
        body: String,
        /// That speed (rad/s), and whether it is the slower speeds that are beyond it.
        speed: f64,
        /// See `speed`.
        below: bool,
        /// The frequency there (Hz).
        hertz: f64,
    },
    /// Equations that vary with angles though all bodies are round: joints that are not.
    Varies {
        /// The largest share of an entry.
        share: f64,
    },
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hertz = |own: f64| rounded(own, 4);
        match self {
            Doubt::NotRound { body, lack, varies: false } => {
                write!(
                    f,
                    "{body} is not round: {lack}. Modes are given in its rotating frame, in which the equations are constant"
                )
            }
            Doubt::NotRound { body, lack, varies: true } => write!(
                f,
                "{body} is not round: {lack}. The equations vary with its angle: modes are found by Hill's method, about the equilibrium of the averaged body"
            ),
            Doubt::RoundBelow { body, hertz: band } => write!(
                f,
                "{body} is round up to {} Hz only: higher modes are those of its average over a turn",
                hertz(*band)
            ),
            Doubt::EndOfReduction { body, last, first } => write!(
                f,
                "modes from {} Hz up are near the end of the reduction of {body} (its last mode with joints held: {} Hz): give it more `modes`",
                hertz(*first),
                hertz(*last)
            ),
            Doubt::BeyondRows { joint, rows: [first, last], modes: [slower, faster] } => {
                let of = |count: usize| if count == 1 { "mode is" } else { "modes are" };
                let slower = (*slower > 0)
                    .then(|| format!("{slower} {} below {} Hz", of(*slower), hertz(*first)));
                let faster = (*faster > 0)
                    .then(|| format!("{faster} {} above {} Hz", of(*faster), hertz(*last)));
                let both = [slower, faster].into_iter().flatten().collect::<Vec<_>>().join(", ");
                write!(
                    f,
                    "{both}, beyond the frequencies in the table of {joint}, and found with the coefficients of its nearest row"
                )
            }
            Doubt::NotValid {
                joint,
                law,
                title,
                value,
                limit,
                unit,
                speeds: [first, last],
                of_some,
                help,
            } => {
                let amount = |value: f64| match unit.as_str() {
                    "1" => rounded(value, 4).to_string(),
                    unit => format!("{} {unit}", rounded(value, 4)),
                };
                let [from, to] = [*first, *last].map(|own| rounded(own * 60.0 / TAU, 6));
                let at = match (of_some, first == last) {
                    (false, _) => String::new(),
                    (true, true) => format!(", at {from} rpm"),
                    (true, false) => format!(", at speeds from {from} to {to} rpm"),
                };
                write!(
                    f,
                    "{law} in {joint} is outside its range of validity{at}: {title} {}, limit {}. Remedy: {help}",
                    amount(*value),
                    amount(*limit)
                )
            }
            Doubt::Open { joints, speed } => write!(
                f,
                "at {} rpm nothing closes the clearance of {}: without stiffness there, what is found holds for motions within it",
                rounded(speed * 60.0 / TAU, 6),
                joints.join(", ")
            ),
            Doubt::LinearWithin { joints, speed } => {
                let joints = joints.iter().map(|(joint, within)| {
                    format!("{} µm in {joint}", whirl_text::shown(1e6 * within, 2, 1e-3..1e5))
                });
                write!(
                    f,
                    "at {} rpm the joints are linear, within 10 % of stiffness and damping, for amplitudes up to {}",
                    rounded(speed * 60.0 / TAU, 6),
                    joints.collect::<Vec<_>>().join(", ")
                )
            }
            Doubt::NotSmall { joint, speed, amplitude, within, runs_out } => {
                let um = |own: f64| whirl_text::shown(1e6 * own, 3, 1e-3..1e5);
                write!(
                    f,
                    "the response is too large for a linear analysis: {joint} moves by {} µm at {} rpm, but its stiffness or damping changes by 10 % within {} µm. Run it in time (`whirl run`), or reduce the {}",
                    um(*amplitude),
                    rounded(speed * 60.0 / TAU, 6),
                    um(*within),
                    if *runs_out {
                        "run-out and what else excites it"
                    } else {
                        "unbalance, or what else excites it"
                    }
                )
            }
            Doubt::TurningOffset { joint, body } => write!(
                f,
                "the `offset` of the bore of {joint} turns with {body}, but the state is found with it as it stands at angle 0: mean \
                 positions and forces of joints are not those of the machine. Give it as `run_out` of the other side, or run the case in \
                 time (`whirl run`)"
            ),
            Doubt::Load { load, counted } => match counted {
                Counted::AtStart => write!(f, "{load} varies in time: its value at t = 0 is used"),
                Counted::InFull => write!(f, "{load} is used in full, as at the end of its ramp"),
                Counted::OfTwoAngles => write!(
                    f,
                    "{load} is left out: it is fixed in a body that turns and goes by the angle of another one, so that it has orders of neither. Run it in time (`whirl run`)"
                ),
                Counted::BetweenOrders(order) => write!(
                    f,
                    "{load} is left out but for its mean: orders are told by halves up to 500000, and it has the order {}. Run it in time (`whirl run`)",
                    rounded(*order, 6)
                ),
                Counted::Later(from) => {
                    write!(f, "{load} is left out, as it starts only at {} s", rounded(*from, 4))
                }
            },
            Doubt::Unheld { bodies } => write!(
                f,
                "nothing holds {} where the machine stands: such motions have no frequency and are not listed. A journal floats in its clearance without a load, and a film carries only at speed: add a load, such as the weight, or what holds it",
                bodies.join(", ")
            ),
            Doubt::TooSlow { body, speed, below, hertz: own } => write!(
                f,
                "a motion of {body} that grows is too slow {} {} rpm ({} Hz there) to be told from one that nothing holds: whether it grows there as well is not known",
                if *below { "below" } else { "above" },
                rounded(speed * 60.0 / TAU, 4),
                hertz(*own)
            ),
            Doubt::Varies { share } => write!(
                f,
                "the joints are not uniform around their circumference, so that the equations vary by {} % over a turn: modes are those at angle 0",
                rounded(100.0 * share, 2)
            ),
        }
    }
}

impl LinearMachine {
    /// What is to be said of modes at a state.
    ///
    /// # Errors
    /// As [`LinearMachine::linearised`].
    pub fn doubts(
        &self,
        at: &Standstill,
        equations: &Linearised,
        modes: &[Mode],
    ) -> Result<Vec<Doubt>, Error> {
        let mut doubts = Vec::new();
        for body in self.not_round().filter(|&body| at.speeds[body] != 0.0) {
            doubts.push(Doubt::NotRound {
                body: self.machine.bodies[body].name().to_owned(),
                lack: self.roundness[body].as_ref().map_or(String::new(), |own| own.lack()),
                varies: equations.varying.is_some(),
            });
        }
        for (place, body) in self.machine.bodies.iter().enumerate() {
            let own = || modes.iter().filter(|mode| mode.shares[place] >= TAKES_PART);
            let highest = own().map(Mode::hertz).fold(0.0, f64::max);
            let name = || body.name().to_owned();
            let round = self.roundness[place].as_ref().filter(|own| own.is_round_at(0.0));
            if let Some(band) = round.map(|own| own.band()).filter(|own| *own < highest) {
                doubts.push(Doubt::RoundBelow { body: name(), hertz: band });
            }
            let last = match (body.shaft(), body.support()) {
                (Some(shaft), _) => shaft.hertz.last(),
                (_, Some(support)) => support.hertz.last(),
                _ => None,
            };
            let Some(&last) = last else { continue };
            let near = own().map(Mode::hertz).find(|hertz| TWICE * hertz > last);
            if let Some(first) = near {
                doubts.push(Doubt::EndOfReduction { body: name(), last, first });
            }
        }
        for joint in &equations.dependent {
            let rows = joint.over.frequencies();
            let rows = [rows[0], rows[rows.len() - 1]];
            let count =
                |is: &dyn Fn(f64) -> bool| modes.iter().filter(|own| is(own.value.im)).count();
            let modes = [count(&|own| own < rows[0]), count(&|own| own > rows[1])];
            if modes != [0; 2] {
                let joint = self.machine.monitors[joint.joint].name.clone();
                doubts.push(Doubt::BeyondRows { joint, rows: rows.map(|own| own / TAU), modes });
            }
        }
        for own in self.machine.monitors.iter().filter(|own| own.offset != [0.0; 2]) {
            let bore = own.bodies[1];
            if self.machine.places()[bore].rotation.is_some() && at.speeds[bore] != 0.0 {
                let body = self.machine.bodies[bore].name().to_owned();
                doubts.push(Doubt::TurningOffset { joint: own.name.clone(), body });
            }
        }
        if equations.frame == 0.0 {
            let bodies = self.unheld(at, equations)?;
            if !bodies.is_empty() {
                doubts.push(Doubt::Unheld { bodies });
            }
        }
        if equations.frame == 0.0 && equations.varying.is_none() {
            let share = self.varies(at);
            if share > VARIES {
                doubts.push(Doubt::Varies { share });
            }
        }
        Ok(doubts)
    }
}
