//! Torsion: how much of a mode turns about the axis, which way it moves, where its nodes are, and what couplings and gears carry.
//!
//! The coordinates of a body that turns are a motion sideways, −S²x, one along the axis, which is what M⁻¹pᵀ of rows p of
//! displacements along z span, and the rest, which with the angle θ is torsion.

use num_complex::Complex64;

use super::linearised::Standstill;
use super::modes::Mode;
use super::round::LinearMachine;
use super::shapes::{apply, inner};
use crate::bodies::Body;
use crate::body::BodyNode;
use crate::error::Error;
use crate::linalg::{Cholesky, Matrix, dot};
use crate::loads::TimeFunction;

/// Rows along z from which motions along the axis are taken, at most.
const ROWS: usize = 24;
/// What rows before leave of one, below which it adds nothing.
const OWN: f64 = 1e-6;
/// Share of the largest twist below which one has no sign.
const STILL: f64 = 1e-6;

/// How a mode turns about the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Torsion {
    /// Share of its kinetic energy that is torsion (0 to 1).
    pub share: f64,
    /// The same by body, over all of its torsion.
    pub bodies: Vec<f64>,
    /// By body that turns the mean turn of its joints' sections over the largest (in the speed of the train's first body), with its
    /// sign; none of one that is tied to no other.
    pub twists: Vec<Option<f64>>,
    /// Where it has nodes.
    pub nodes: Vec<Node>,
}

/// Which way most of the inertia of a mode moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Across the axes of the bodies, as in bending; what does not turn counts here however it moves.
    Lateral,
    /// Along the axes.
    Axial,
    /// About the axes.
    Torsional,
}

/// Where a mode of torsion has a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Node {
    /// Between both sides of a joint, by its place.
    Joint(usize),
    /// Between the joints of a body, by its place.
    Body(usize),
}

/// What a coupling or a gear carries where the machine stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Torque {
    /// Place of the joint.
    pub joint: usize,
    /// On the sections of both bodies (N·m).
    pub torques: [f64; 2],
    /// Force of the teeth along the line of action (N), of gears: below zero if they pull.
    pub force: Option<f64>,
}

/// M-orthonormal motions of a body along its axis.
pub(super) fn along_axis(body: &Body, square: &Matrix) -> Result<Vec<Vec<f64>>, Error> {
    let Some(shaft) = body.shaft().filter(|own| own.size() > 0) else { return Ok(Vec::new()) };
    let n = shaft.size();
    let of_node = |node: &BodyNode| node.shapes.row(2);
    let of_mean = body.measures().iter().map(|own| own.displacement.row(2));
    let centre = std::iter::once(of_node(&shaft.centre_of_mass.node));
    let rows = centre.chain(of_mean).chain(body.nodes().iter().map(of_node));
    let mut mass = Cholesky::new(n);
    mass.factor(&shaft.mass.data)?;
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for row in rows.take(ROWS) {
        // Without what of it moves sideways.
        let turned = square.apply_transpose(&row);
        let row: Vec<f64> = row.iter().zip(turned).map(|(own, turned)| own + turned).collect();
        let mut own = row.clone();
        mass.solve_in_place(&mut own);
        let whole = dot(&row, &own);
        if !(whole > 0.0) {
            continue;
        }
        for other in &basis {
            let part = dot(&shaft.mass.apply(other), &own);
            own.iter_mut().zip(other).for_each(|(own, other)| *own -= part * other);
        }
        let left = dot(&shaft.mass.apply(&own), &own);
        if left > OWN * whole {
            own.iter_mut().for_each(|value| *value /= left.sqrt());
            basis.push(own);
        }
    }
    Ok(basis)
}

impl LinearMachine {
    /// What of a case makes couples that vary, by bodies of the trains of joints or one body, in words: unbalance, and loads over time
    /// or over an angle.
    pub fn exciting_torsion(&self, of: usize) -> Vec<String> {
        let tied = self.machine.tied_bodies();
        let is_own = |body: &usize| *body == of || tied.contains(body);
        let name = |body: usize| self.machine.bodies[body].name();
        let unbalanced = self.unbalanced().filter(is_own);
        let mut all: Vec<String> =
            unbalanced.map(|body| format!("the unbalance of {}", name(body))).collect();
        for load in self.loaded.loads.iter().filter(|own| is_own(&own.body)) {
            if matches!(load.time_function, TimeFunction::Constant) {
                continue;
            }
            let own = match load.name.as_str() {
                "" => format!("a load of {}", name(load.body)),
                own => own.to_owned(),
            };
            if !all.contains(&own) {
                all.push(own);
            }
        }
        all
    }

    /// How a mode turns about the axis. `turning`: the bodies whose angles take part, as [`super::Linearised::turning`] has them.
    ///
    /// # Errors
    /// A mass that is not positive definite.
    pub fn torsion(&self, turning: &[usize], mass: &Matrix, mode: &Mode) -> Result<Torsion, Error> {
        let angles = turning.len();
        let (twisted, _) = self.apart(angles, mode)?;

        let moved = apply(mass, &twisted);
        let whole = inner(&mode.shape, &apply(mass, &mode.shape)).re;
        let all = inner(&twisted, &moved).re;
        let of_body = |body: usize| {
            let block = self.block(angles, body);
            let angle = turning.iter().position(|own| *own == body);
            let angle = angle.map_or(0.0, |place| (twisted[place].conj() * moved[place]).re);
            (angle + inner(&twisted[block.clone()], &moved[block]).re) / all
        };
        let share = (all / whole).clamp(0.0, 1.0);
        let count = self.machine.bodies.len();
        let bodies = (0..count).map(|body| if all > 0.0 { of_body(body) } else { 0.0 }).collect();
        let (twists, nodes) = self.twists((turning, &twisted));
        Ok(Torsion { share, bodies, twists, nodes })
    }

    /// Which way a mode moves; see [`LinearMachine::torsion`] for `turning`.
    ///
    /// # Errors
    /// A mass that is not positive definite.
    pub fn way(&self, turning: &[usize], mass: &Matrix, mode: &Mode) -> Result<Way, Error> {
        let (twisted, axial) = self.apart(turning.len(), mode)?;
        let half = 0.5 * inner(&mode.shape, &apply(mass, &mode.shape)).re;
        Ok(match inner(&twisted, &apply(mass, &twisted)).re {
            about if about > half => Way::Torsional,
            _ if axial > half => Way::Axial,
            _ => Way::Lateral,
        })
    }

    /// What of a mode turns about the axes of the bodies that turn, and |q̇|² in M of what moves along them.
    fn apart(&self, angles: usize, mode: &Mode) -> Result<(Vec<Complex64>, f64), Error> {
        let mut twisted = vec![Complex64::ZERO; mode.shape.len()];
        let mut along = 0.0;
        twisted[..angles].copy_from_slice(&mode.shape[..angles]);
        for (body, generators) in self.generators.iter().enumerate() {
            let Some([_, square]) = generators else { continue };
            let block = self.block(angles, body);
            let own = &mode.shape[block.clone()];
            let sideways = apply(square, own);
            let mut rest: Vec<Complex64> = own.iter().zip(sideways).map(|(x, y)| x + y).collect();
            let machine = &self.machine;
            let inertia = &machine.bodies[body].shaft().expect("a body that turns").mass;
            for axial in along_axis(&machine.bodies[body], square)? {
                let moved = inertia.apply(&axial);
                let part: Complex64 = rest.iter().zip(&moved).map(|(x, m)| x * m).sum();
                rest.iter_mut().zip(&axial).for_each(|(x, own)| *x -= part * own);
                along += part.norm_sqr();
            }
            twisted[block].copy_from_slice(&rest);
        }
        Ok((twisted, along))
    }

    /// Twists of the bodies, and nodes between them.
    fn twists(
        &self,
        (turning, twisted): (&[usize], &[Complex64]),
    ) -> (Vec<Option<f64>>, Vec<Node>) {
        let machine = &self.machine;
        let ratios = machine.train_ratios();
        // By joint and side the turn of the section, in the speed of the first body of the train.
        let sides: Vec<(usize, [(usize, Complex64); 2])> = machine
            .twisting_joints()
            .map(|joint| {
                let monitor = &machine.monitors[joint];
                let side = |side: usize| {
                    let body = monitor.bodies[side];
                    let angle = turning.iter().position(|own| *own == body);
                    let angle = angle.map_or(Complex64::ZERO, |place| twisted[place]);
                    let own = &twisted[self.block(turning.len(), body)];
                    let section: Complex64 =
                        monitor.sections[side].iter().zip(own).map(|(row, x)| *row * x).sum();
                    (body, (angle + section) / ratios[body])
                };
                (joint, [side(0), side(1)])
            })
            .collect();
        let values = || sides.iter().flat_map(|own| own.1.iter().map(|side| side.1));
        let Some(largest) = values().max_by(|a, b| a.norm().total_cmp(&b.norm())) else {
            return (vec![None; machine.bodies.len()], Vec::new());
        };
        let real = |value: Complex64| if largest.norm() > 0.0 { (value / largest).re } else { 0.0 };
        let sign = |value: Complex64| match real(value) {
            own if own > STILL => 1,
            own if own < -STILL => -1,
            _ => 0,
        };
        let mut nodes = Vec::new();
        let mut twists = Vec::with_capacity(machine.bodies.len());
        for body in 0..machine.bodies.len() {
            let own: Vec<Complex64> = sides
                .iter()
                .flat_map(|(_, sides)| sides.iter().filter(|side| side.0 == body))
                .map(|side| side.1)
                .collect();
            let mean = own.iter().sum::<Complex64>() / own.len().max(1) as f64;
            twists.push((!own.is_empty()).then(|| real(mean)));
            if own.iter().any(|x| sign(*x) > 0) && own.iter().any(|x| sign(*x) < 0) {
                nodes.push(Node::Body(body));
            }
        }
        let crossing =
            sides.iter().filter(|(_, [a, b])| sign(a.1) * sign(b.1) < 0).map(|own| own.0);
        nodes.extend(crossing.map(Node::Joint));
        (twists, nodes)
    }

    /// What couplings and gears carry where the machine stands.
    pub fn torques(&self, at: &Standstill) -> Vec<Torque> {
        let machine = &self.machine;
        let joints = machine.twisting_joints().map(|joint| {
            let (monitor, first) = (&machine.monitors[joint], at.found.torques[joint]);
            let gear = monitor.planes.iter().find_map(|&own| machine.springs.base_radii(own));
            let (second, force) = match gear {
                Some([own, other]) => (first * other / own, Some(-first / own)),
                None => (-first, None),
            };
            Torque { joint, torques: [first, second], force }
        });
        joints.collect()
    }
}
