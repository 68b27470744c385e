//! Outputs by request: what a history has beside its usual columns.

use crate::bodies::Body;
use crate::body::BodyNode;
use crate::column::Column;
use crate::loads::Frame;

/// Letters of the axes in names of columns.
const AXES: [&str; 3] = ["x", "y", "z"];

/// What is wanted, under a name of its own. A point is `P`: of a reduced body as it moves, before that its place among the
/// nodes of its body.
#[derive(Debug, Clone, PartialEq)]
pub struct Output<P = BodyNode> {
    /// Between the quantity and the unit of its columns.
    pub name: String,
    /// What it is.
    pub what: Wanted<P>,
}

/// What can be wanted.
#[derive(Debug, Clone, PartialEq)]
pub enum Wanted<P = BodyNode> {
    /// How a point of a body moves.
    Motion {
        /// The body, by its place in the machine.
        body: usize,
        /// The point.
        point: P,
        /// Displacement or one of its derivatives.
        motion: Motion,
        /// Whose components they are. The displacement u of a body that turns is that beside its rotation: A(θ)u in
        /// space, u in the frame of the body; speed and acceleration are its derivatives there.
        frame: Frame,
        /// Axes, a column each.
        components: Vec<usize>,
    },
    /// What a joint does in the plane of its middle: two columns, or one about or along its axis.
    Joint {
        /// The joint, by its place among the bearings.
        joint: usize,
        /// Which of what it does.
        quantity: JointQuantity,
        /// Space, or the frame of the body of the journal.
        frame: Frame,
    },
    /// Kinetic energy ½ q̇ᵀM q̇ and strain energy ½ qᵀK q of a body (J).
    Energy {
        /// The body.
        body: usize,
    },
    /// Power of the loads on a body and of the couple that its prescribed rotation takes, and power that its own
    /// damping takes away (W).
    Power {
        /// The body.
        body: usize,
    },
    /// What is in the film of a joint: peak of the pressure and smallest gap with their places, integrals, moments on both
    /// sides, oil, and what enters at every opening.
    Film {
        /// The joint, by its place among the bearings.
        joint: usize,
        /// Names of its openings, both ends first.
        openings: Vec<String>,
        /// Its integrals.
        integrals: Vec<Integral>,
    },
    /// States of the law of a joint, at each of its places.
    States {
        /// The joint, by its place among the bearings.
        joint: usize,
        /// The states.
        states: Vec<StateOfLaw>,
        /// Planes of the joint, or springs in all of them where the law acts at springs.
        places: usize,
    },
    /// Power of a joint's forces on the body of the journal (W); negative where they brake it.
    JointPower {
        /// The joint.
        joint: usize,
    },
}

/// An integral over a film.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Integral {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// What it is.
    pub meaning: String,
}

/// A state of a law.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StateOfLaw {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
}

impl StateOfLaw {
    /// The unit in which histories have it, and one of SI in that.
    pub(crate) fn shown(&self) -> (&str, f64) {
        if self.unit == "m" { ("um", 1e6) } else { (&self.unit, 1.0) }
    }
}

/// A displacement, or a derivative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// µm.
    Displacement,
    /// mm/s.
    Velocity,
    /// m/s².
    Acceleration,
}

/// What is asked of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointQuantity {
    /// On the journal (N).
    Force,
    /// Displacement of the journal against the bore, run-out and offset included (µm).
    Deformation,
    /// Its rate (mm/s).
    Rate,
    /// Torque on the journal about its own centre (N·m).
    Torque,
    /// Angle of the journal against the bore (rad).
    Twist,
    /// Its rate (rad/s).
    TwistRate,
    /// Moments on the section of the journal about x and y (N·m).
    Moment,
    /// Tilts of the section of the journal against that of the bore about x and y (rad).
    Tilt,
    /// On the section of the journal along z (N).
    AxialForce,
    /// Displacement of the section of the journal against that of the bore along z (µm).
    AxialDeformation,
}

/// Whose an output is, by its place in the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// Of a body.
    Body(usize),
    /// Of a joint.
    Joint(usize),
}

impl<P> Wanted<P> {
    /// Whose it is.
    pub fn owner(&self) -> Owner {
        match self {
            Wanted::Motion { body, .. } | Wanted::Energy { body } | Wanted::Power { body } => {
                Owner::Body(*body)
            }
            Wanted::Joint { joint, .. }
            | Wanted::JointPower { joint }
            | Wanted::Film { joint, .. }
            | Wanted::States { joint, .. } => Owner::Joint(*joint),
        }
    }

    /// What oscillates there, with the axes of its columns; nothing of what has no spectrum worth a figure.
    pub fn oscillates(&self) -> Option<(&'static str, Vec<&'static str>)> {
        let (what, axes): (_, &[usize]) = match self {
            Wanted::Motion { motion, components, .. } => match motion {
                Motion::Displacement => ("displacement", components),
                Motion::Velocity => ("velocity", components),
                Motion::Acceleration => ("acceleration", components),
            },
            Wanted::Joint { quantity, .. } => match quantity {
                JointQuantity::Force => ("force", &[0, 1]),
                JointQuantity::Deformation => ("deformation", &[0, 1]),
                JointQuantity::Rate => ("rate", &[0, 1]),
                JointQuantity::Torque => ("torque", &[2]),
                JointQuantity::Twist => ("twist", &[2]),
                JointQuantity::TwistRate => ("twist rate", &[2]),
                JointQuantity::Moment => ("moment", &[0, 1]),
                JointQuantity::Tilt => ("tilt", &[0, 1]),
                JointQuantity::AxialForce => ("axial force", &[2]),
                JointQuantity::AxialDeformation => ("axial deformation", &[2]),
            },
            Wanted::Energy { .. }
            | Wanted::Power { .. }
            | Wanted::JointPower { .. }
            | Wanted::Film { .. }
            | Wanted::States { .. } => return None,
        };
        Some((what, axes.iter().map(|&axis| AXES[axis]).collect()))
    }
}

impl<P> Output<P> {
    /// With another point, which is given by the body and this one.
    pub fn with_points<Q>(self, point_of: &mut impl FnMut(usize, P) -> Q) -> Output<Q> {
        let Output { name, what } = self;
        let what = match what {
            Wanted::Motion { body, point, motion, frame, components } => {
                let point = point_of(body, point);
                Wanted::Motion { body, point, motion, frame, components }
            }
            Wanted::Joint { joint, quantity, frame } => Wanted::Joint { joint, quantity, frame },
            Wanted::Energy { body } => Wanted::Energy { body },
            Wanted::Power { body } => Wanted::Power { body },
            Wanted::JointPower { joint } => Wanted::JointPower { joint },
            Wanted::Film { joint, openings, integrals } => {
                Wanted::Film { joint, openings, integrals }
            }
            Wanted::States { joint, states, places } => Wanted::States { joint, states, places },
        };
        Output { name, what }
    }
}

impl Output<usize> {
    /// With its point as it moves.
    pub(crate) fn on(self, bodies: &[Body]) -> Output {
        self.with_points(&mut |body, point: usize| bodies[body].nodes()[point].clone())
    }
}

impl Output {
    /// Names of its columns.
    pub fn columns(&self) -> Vec<String> {
        self.described().into_iter().map(|own| own.name).collect()
    }

    /// Its columns.
    pub fn described(&self) -> Vec<Column> {
        let name = &self.name;
        let in_plane =
            |letter: &str, suffix: &str, unit: &'static str, what: &str| -> Vec<Column> {
                let of_axis = |axis: &&str| {
                    let meaning = format!("{what} {axis}, {name}");
                    Column::new(format!("{letter}{axis}_{name}_{suffix}"), unit, meaning)
                };
                AXES[..2].iter().map(of_axis).collect()
            };
        let plane = |letter: &str, suffix: &str, unit: &'static str, what: &str| {
            in_plane(letter, suffix, unit, &format!("{what} along"))
        };
        let about = |letter: &str, suffix: &str, unit: &'static str, what: &str| {
            in_plane(letter, suffix, unit, &format!("{what} about"))
        };
        let one = |column: String, unit: &'static str, what: &str| {
            Column::new(column, unit, format!("{what}, {name}"))
        };
        match &self.what {
            Wanted::Motion { motion, components, frame, .. } => {
                let (letter, suffix, unit, what) = match motion {
                    Motion::Displacement => ("", "um", "um", "displacement"),
                    Motion::Velocity => ("v", "mm_s", "mm/s", "velocity"),
                    Motion::Acceleration => ("a", "m_s2", "m/s^2", "acceleration"),
                };
                let whose = match frame {
                    Frame::Space => "in space",
                    Frame::Body => "in the frame of the body",
                };
                let axes = components.iter().map(|&axis| AXES[axis]);
                let columns = axes.map(|axis| {
                    let meaning = format!("{what} along {axis} {whose}, {name}");
                    Column::new(format!("{letter}{axis}_{name}_{suffix}"), unit, meaning)
                });
                columns.collect()
            }
            Wanted::Joint { quantity, .. } => match quantity {
                JointQuantity::Force => plane("f", "N", "N", "force on the journal"),
                JointQuantity::Deformation => {
                    plane("d", "um", "um", "displacement of the journal relative to the bore")
                }
                JointQuantity::Rate => plane("dv", "mm_s", "mm/s", "rate of deformation"),
                JointQuantity::Torque => {
                    vec![one(format!("mz_{name}_Nm"), "N*m", "torque on the journal")]
                }
                JointQuantity::Twist => {
                    vec![one(
                        format!("twist_{name}_rad"),
                        "rad",
                        "angle of the journal relative to the bore",
                    )]
                }
                JointQuantity::TwistRate => {
                    vec![one(format!("twist_rate_{name}_rad_s"), "rad/s", "rate of twist")]
                }
                JointQuantity::Moment => about("m", "Nm", "N*m", "moment on the journal"),
                JointQuantity::Tilt => {
                    about("tilt_", "rad", "rad", "tilt of the journal against the bore")
                }
                JointQuantity::AxialForce => {
                    vec![one(format!("fz_{name}_N"), "N", "force on the journal along z")]
                }
                JointQuantity::AxialDeformation => vec![one(
                    format!("dz_{name}_um"),
                    "um",
                    "displacement of the journal against the bore along z",
                )],
            },
            Wanted::Energy { .. } => ["kinetic", "strain"]
                .map(|kind| one(format!("{kind}_{name}_J"), "J", &format!("{kind} energy")))
                .to_vec(),
            Wanted::Power { .. } => vec![
                one(format!("power_{name}_W"), "W", "power of the loads on the body"),
                one(format!("damping_{name}_W"), "W", "power dissipated by the body's damping"),
            ],
            Wanted::Film { openings, integrals, .. } => {
                let mut all = vec![
                    one(
                        format!("pmax_{name}_MPa"),
                        "MPa",
                        "largest pressure at a node of the film",
                    ),
                    one(format!("pmax_angle_{name}_deg"), "deg", "where it is, from x of the bore"),
                    one(
                        format!("pmax_z_{name}_mm"),
                        "mm",
                        "where it is, from the middle of the film",
                    ),
                    one(format!("hmin_{name}_um"), "um", "smallest gap at a node of the film"),
                    one(format!("hmin_angle_{name}_deg"), "deg", "where it is, from x of the bore"),
                    one(
                        format!("hmin_z_{name}_mm"),
                        "mm",
                        "where it is, from the middle of the film",
                    ),
                ];
                all.extend(integrals.iter().map(|own| {
                    let suffix: String = own.unit.chars().filter(|c| c.is_alphanumeric()).collect();
                    one(format!("{}_{name}_{suffix}", own.name), own.unit, &own.meaning)
                }));
                all.extend([
                    one(format!("mz_{name}_Nm"), "N*m", "moment on the journal about its centre"),
                    one(format!("mz_bore_{name}_Nm"), "N*m", "moment on the bore about its centre"),
                    one(format!("oil_{name}_mm3"), "mm^3", "oil in the film"),
                ]);
                all.extend(openings.iter().map(|own| {
                    let what = format!("what enters the film at its opening {own}");
                    one(format!("q_{own}_{name}_mL_s"), "mL/s", &what)
                }));
                all
            }
            Wanted::States { states, places, .. } => {
                let one = |place: usize, own: &StateOfLaw| {
                    let (unit, _) = own.shown();
                    let (number, at) = match places {
                        1 => (String::new(), String::new()),
                        _ => (format!("_{}", place + 1), format!(" at its place {}", place + 1)),
                    };
                    let column = format!("{}_{name}{number}{}", own.name, in_name(unit));
                    let meaning = format!("state {} of the law{at}, {name}", own.name);
                    Column::new(column, unit.to_owned(), meaning)
                };
                let one = &one;
                let all =
                    (0..*places).flat_map(|place| states.iter().map(move |own| one(place, own)));
                all.collect()
            }
            Wanted::JointPower { .. } => {
                vec![one(
                    format!("power_{name}_W"),
                    "W",
                    "power of the joint's forces on the journal",
                )]
            }
        }
    }
}

/// A unit as names of columns have it, behind what it is the unit of: `_mm_s` of mm/s, nothing of 1.
fn in_name(unit: &str) -> String {
    let kept = unit.chars().filter(|c| c.is_alphanumeric() || *c == '/');
    match unit {
        "1" => String::new(),
        _ => format!("_{}", kept.collect::<String>().replace('/', "_")),
    }
}
