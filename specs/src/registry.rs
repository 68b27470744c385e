//! The shapes of the registries: what the generator states about each spec, beside its functions.

#![allow(
    clippy::type_complexity,
    reason = "the signature of a kernel is read where it is stored, with its arguments named"
)]

use crate::cell_kernel::{FormKernel, StressKernel};
use crate::origin::{Origin, Variable};

/// A finite element and the kernels of every form on it.
#[derive(Debug, Clone, Copy)]
pub struct Element {
    /// Where it comes from.
    pub origin: Origin,
    /// Nodes of one cell; every node has three translations.
    pub nodes: usize,
    /// Reference coordinates (ξ, η, ζ) of the nodes, in the spec's order.
    pub reference_nodes: &'static [[f64; 3]],
    /// Element types of Abaqus and CalculiX that are read as this element.
    pub abaqus: &'static [&'static str],
    /// `abaqus_order[i]` is the node of this element that stands at place i of an Abaqus line.
    pub abaqus_order: &'static [usize],
    /// Element type of Gmsh that is read as this element, with the node of this element at every place of one.
    pub gmsh: Option<(u8, &'static [usize])>,
    /// The card of Nastran that is read as this element where it lists as many nodes, with the node of this element
    /// at every place of one.
    pub nastran: Option<(&'static str, &'static [usize])>,
    /// VTK cell type.
    pub vtk: u8,
    /// `vtk_order[i]` is the node of this element at place i of a VTK cell.
    pub vtk_order: &'static [usize],
    /// N_a and ∂N_a/∂(ξ, η, ζ) of every node at a point of the cell.
    pub shape: fn([f64; 3], values: &mut [f64], slopes: &mut [[f64; 3]]),
    /// Faces of the cell.
    pub faces: &'static [Face],
    /// One kernel a form.
    pub forms: &'static [FormKernel],
    /// One kernel a stress.
    pub stresses: &'static [StressKernel],
}

impl Element {
    /// The kernel of the form called `form`, if the specs declare one.
    pub fn form(&self, form: &str) -> Option<&'static FormKernel> {
        self.forms.iter().find(|kernel| kernel.form == form)
    }

    /// The kernel of the stress that the form called `form` gives, if the specs name one.
    pub fn stress_of(&self, form: &str) -> Option<&'static StressKernel> {
        self.stresses.iter().find(|kernel| kernel.form == form)
    }
}

/// A face of an element, with its functions at the points of a rule over the face's coordinates s, t.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Nodes of the element whose functions do not vanish on the face.
    pub nodes: &'static [usize],
    /// 3 (s, t ≥ 0, s + t ≤ 1) or 4 (−1 ≤ s, t ≤ 1).
    pub corners: usize,
    /// (ξ, η, ζ) at s = t = 0.
    pub origin: [f64; 3],
    /// ∂(ξ, η, ζ)/∂s and ∂(ξ, η, ζ)/∂t.
    pub along: [[f64; 3]; 2],
    /// The points.
    pub points: &'static [FacePoint],
}

/// A point of a face. ∂x/∂s × ∂x/∂t points out of the cell, and is as long as the face has area for s and t.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacePoint {
    /// Weight; the weights of all points sum to the area over s and t.
    pub weight: f64,
    /// N_a for every node of the face.
    pub values: &'static [f64],
    /// ∂N_a/∂s and ∂N_a/∂t for every node of the face.
    pub slopes: &'static [[f64; 2]],
}

/// Computes a law and its derivatives over a row of springs.
///
/// `inputs`: one row of `springs` values an input, then one a state. `outputs`: for every output o, then for the rate of
/// every state, the rows o, ∂o/∂input₀, ∂o/∂input₁, …, and those by the states, of `springs` values each. All SI.
pub type LawKernel = fn(springs: usize, inputs: &[f64], outputs: &mut [f64]);

/// A bearing law: named inputs to named outputs with all first derivatives.
#[derive(Debug, Clone, Copy)]
pub struct Law {
    /// Where it comes from.
    pub origin: Origin,
    /// Inputs in kernel order, such as `h`, `h_dot`. Only those that the law uses.
    pub inputs: &'static [Variable],
    /// Outputs in kernel order, such as `Q`.
    pub outputs: &'static [Variable],
    /// What it remembers, in kernel order.
    pub states: &'static [LawState],
    /// The kernel.
    pub evaluate: LawKernel,
    /// The outputs alone, a row each, to the same bits: neither derivatives nor rates. Without it they are taken out of all.
    pub forces: Option<LawKernel>,
    /// The kernel for other numbers in the places of those of the file, if it has any.
    pub skeleton: Option<LawSkeleton>,
    /// The same of the outputs alone.
    pub forces_skeleton: Option<LawSkeleton>,
    /// The energy that is stored (J) over a row of springs, from rows of inputs and states, if the law says so.
    pub stored: Option<fn(springs: usize, inputs: &[f64], energies: &mut [f64])>,
    /// Where the law may be believed.
    pub valid: &'static [Validity],
    /// The measures of `valid` over a row of springs: one row an input, then one a state; one row a measure, SI.
    pub measure: fn(springs: usize, inputs: &[f64], measures: &mut [f64]),
}

/// What a law does whatever numbers it does it with.
#[derive(Debug, Clone, Copy)]
pub struct LawSkeleton {
    /// Laws with the same key do the same with other numbers.
    pub key: &'static str,
    /// How many numbers it takes.
    pub numbers: usize,
    /// The kernel: numbers, then rows as in [`LawKernel`].
    pub evaluate: fn(springs: usize, numbers: &[f64], inputs: &[f64], outputs: &mut [f64]),
}

/// A state of a law: a value that changes at a rate of its own.
#[derive(Debug, Clone, Copy)]
pub struct LawState {
    /// What it is.
    pub variable: Variable,
    /// The value at which it begins, SI; none where its rate is zero.
    pub start: Option<f64>,
    /// Between what values it usually is, SI, if the file says so.
    pub range: Option<[f64; 2]>,
}

/// A measure of a law's inputs, and the limits within which the law may be believed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Validity<Text = &'static str> {
    /// Name in the spec.
    pub name: Text,
    /// What is measured, for people.
    pub title: Text,
    /// What is wrong beyond the limits, and what to do.
    pub help: Text,
    /// Unit for people.
    pub unit: Text,
    /// One of this unit in SI.
    pub per_unit: f64,
    /// Least and largest value, SI; infinite where there is no limit.
    pub limits: [f64; 2],
}

/// The clearance h of a ring of springs as a function of ring coordinates (shared by the springs:
/// θ, ε_x, ε_y) and of the bore's motion at each spring, and the kinds of laws that may act there.
#[derive(Debug, Clone, Copy)]
pub struct Clearance {
    /// Where it comes from.
    pub origin: Origin,
    /// The axial interpolation A₁, A₂, A₃ of eq. (13) at z/L_b.
    pub axial: fn(z_over_length: f64) -> [f64; 3],
    /// Where the bodies of journal and bore turn about axes that are apart (m, in space): what that adds to
    /// ε_x and ε_y at an angle of the journal's body, its derivatives by that angle, and theirs.
    pub apart: fn(angle: f64, distance: [f64; 2]) -> [[f64; 2]; 3],
    /// Names of the measures on which forces work, the clearance first.
    pub measures: &'static [&'static str],
    /// How many coordinates measures depend on.
    pub coordinates: usize,
    /// All measures (m, rad) at a spring, from its angle, θ, ε_x and ε_y, the bore's motions, and last c and R.
    pub measure: fn(at: &[f64], out: &mut [f64]),
    /// Kinds of laws; that of normal forces Q(h, ḣ) first.
    pub contacts: &'static [Contact],
}

/// A way in which a bore moves, or the journal's section in its body: a coordinate of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoreMotion {
    /// Outwards at a spring (m).
    Radial,
    /// Along the tangent (−sin ψ, cos ψ) at a spring (m).
    Tangential,
    /// Mean of the ring of nodes along x (m).
    MeanX,
    /// Mean of the ring of nodes along y (m).
    MeanY,
    /// Mean rotation of the ring of nodes about z (rad).
    MeanTurn,
    /// Mean of the bore's section along z (m).
    MeanZ,
    /// Mean rotation of the bore's section about x (rad).
    MeanTiltX,
    /// Mean rotation of the bore's section about y (rad).
    MeanTiltY,
    /// None of the bore: mean rotation of the journal's section against the frame of its body (rad).
    SectionTurn,
    /// Mean of the journal's section along z (m).
    SectionZ,
    /// Mean rotation of the journal's section about x of its body (rad).
    SectionTiltX,
    /// Mean rotation of the journal's section about y of its body (rad).
    SectionTiltY,
    /// Where a sensor looks at the journal's body, along x of that body (m).
    SeenX,
    /// The same along y (m).
    SeenY,
    /// What the sensor stands on, along x (m).
    BaseX,
    /// The same along y (m).
    BaseY,
    /// The frame of the second of two gears, in space (rad).
    SecondFrame,
    /// The second of two gears in space, times the ratio of its base radius to that of the first (rad).
    SecondTurn,
}

/// How often a law of a kind acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactPlace {
    /// At every spring.
    Spring,
    /// Once a ring.
    Ring,
    /// Once a joint, on whole sections.
    Joint,
}

/// An input or a force of a kind of law.
#[derive(Debug, Clone, Copy)]
pub struct ContactVariable {
    /// What laws call it, such as `v_t` or `T`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Motions of the bore on which it depends (for a force: through which it acts), by their places in
    /// [`Contact::bore`].
    pub bore: &'static [usize],
    /// Whether the journal's radius is needed for it.
    pub radius: bool,
    /// Whether it is a rate: zero where nothing moves.
    pub rate: bool,
}

/// A kind of law, acting at every spring, once a ring or once a joint, and what follows from the measures on which its
/// forces work. Coordinates are those of the ring (θ, ε_x, ε_y), then the motions of the bore. Rows have `count`
/// values, springs of a plane or 1, and stand [`ContactState::stride`] apart: planes of one law can lie side by side.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// Name in the spec; `normal` for laws Q(h, ḣ).
    pub name: &'static str,
    /// Where such a law acts.
    pub place: ContactPlace,
    /// What a law may take.
    pub inputs: &'static [ContactVariable],
    /// What a law may give.
    pub forces: &'static [ContactVariable],
    /// Rows that `evaluate` gives: the inputs, then measures that are none but on which forces work.
    pub rows: usize,
    /// For every force the row of the measure that it works on.
    pub measures: &'static [usize],
    /// Motions of the bore, in kernel order.
    pub bore: &'static [BoreMotion],
    /// Rows of the table that `prepare` fills.
    pub table: usize,
    /// Fills the table from the springs' fixed angles ψ in rad. Once a machine.
    pub prepare: fn(psi: &[f64], table: &mut [f64]),
    /// All inputs and further measures, one row each.
    pub evaluate: fn(count: usize, state: &ContactState, inputs: &mut [f64]),
    /// Generalised forces on the ring, and on the motions of the bore (one row each), from the `forces` of
    /// the law (one row each).
    pub force: fn(
        count: usize,
        state: &ContactState,
        forces: &[f64],
        ring_force: &mut [f64; 3],
        bore_force: &mut [f64],
    ),
    /// B + a1·P: derivatives of the generalised forces. `slopes`: for every force the rows of its
    /// derivatives by all inputs.
    pub tangent: fn(
        count: usize,
        state: &ContactState,
        forces: &[f64],
        slopes: &[f64],
        a1: f64,
        tangent: &mut ContactTangent,
    ),
}

/// Where the kernels of a contact find the motion.
#[derive(Debug, Clone, Copy)]
pub struct ContactState<'a> {
    /// From one row to the next, in the rows of this state and in those that kernels take and give.
    pub stride: usize,
    /// What `prepare` filled.
    pub table: &'a [f64],
    /// Coordinates of the ring.
    pub ring: &'a Ring,
    /// Radius of the journal (m).
    pub radius: f64,
    /// Motions of the bore, one row each.
    pub bore: &'a [f64],
    /// Their rates.
    pub bore_dot: &'a [f64],
}

/// Derivatives of the generalised forces of a contact. Rows have one value a spring, or one a ring, and follow one
/// another.
#[derive(Debug, Clone, Default)]
pub struct ContactTangent {
    /// ∂(ring force)/∂(ring), row by row.
    pub ring_ring: [[f64; 3]; 3],
    /// ∂(ring force i)/∂(motion b of the bore): row i · motions + b.
    pub ring_bore: Vec<f64>,
    /// ∂(force on motion b)/∂(ring coordinate i): row 3 b + i.
    pub bore_ring: Vec<f64>,
    /// ∂(force on motion a)/∂(motion b): row a · motions + b.
    pub bore_bore: Vec<f64>,
}

impl ContactTangent {
    /// Zeros for `count` springs and that many motions of the bore.
    pub fn new(count: usize, motions: usize) -> Self {
        ContactTangent {
            ring_ring: [[0.0; 3]; 3],
            ring_bore: vec![0.0; 3 * motions * count],
            bore_ring: vec![0.0; 3 * motions * count],
            bore_bore: vec![0.0; motions * motions * count],
        }
    }
}

/// State of one ring: coordinates in the order θ (rad), ε_x, ε_y (m, body frame), their rates, and c (m).
#[derive(Debug, Clone, Copy, Default)]
pub struct Ring {
    /// θ, ε_x, ε_y.
    pub position: [f64; 3],
    /// θ̇, ε̇_x, ε̇_y.
    pub velocity: [f64; 3],
    /// Radial clearance of the undeformed bearing.
    pub c: f64,
}

/// Shape of a constant tensor of a motion; n is the number of flexible coordinates η.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TensorShape {
    /// One value.
    Scalar,
    /// n values.
    Vector,
    /// n × n values, column after column.
    Matrix,
}

/// What is known of a tensor under transposition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Symmetry {
    /// Nothing.
    None,
    /// Aᵀ = A.
    Symmetric,
    /// Aᵀ = −A.
    Skew,
}

/// A constant tensor that a motion takes, such as Ȳ.
#[derive(Debug, Clone, Copy)]
pub struct Tensor {
    /// Name in the spec: `J0`, `y0`, `g0`, `M`, `Y`, `W`, `H`.
    pub name: &'static str,
    /// Shape.
    pub shape: TensorShape,
    /// Symmetry.
    pub symmetry: Symmetry,
}

/// The moving state of a shaft: θ and the flexible coordinates η (n values each) with rates.
#[derive(Debug, Clone, Copy)]
pub struct MotionState<'a, L = f64> {
    /// θ (rad).
    pub theta: L,
    /// θ̇ (rad/s).
    pub theta_dot: L,
    /// θ̈ (rad/s²).
    pub theta_ddot: L,
    /// η.
    pub eta: &'a [L],
    /// η̇.
    pub eta_dot: &'a [L],
    /// η̈.
    pub eta_ddot: &'a [L],
}

/// Writes a vector of 1 + n values (row θ first) or a (1+n) × (1+n) matrix, column after column.
///
/// `tensors`: in the order of [`Motion::tensors`]. `workspace`: [`Motion::workspace`] values.
pub type MotionKernel =
    fn(tensors: &[&[f64]], state: &MotionState, workspace: &mut [f64], out: &mut [f64]);

/// The rigid rotation θ of a shaft coupled to its flexible coordinates η.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// Where it comes from.
    pub origin: Origin,
    /// The constant tensors, in kernel order.
    pub tensors: &'static [Tensor],
    /// Length of the workspace for n flexible coordinates.
    pub workspace: fn(n: usize) -> usize,
    /// Kinetic energy T (J); absent where a spec declares terms instead of an energy.
    pub kinetic_energy:
        Option<fn(tensors: &[&[f64]], state: &MotionState, workspace: &mut [f64]) -> f64>,
    /// Momenta ∂T/∂q̇ (1 + n); the first is the angular momentum about z. Absent as above.
    pub momentum: Option<MotionKernel>,
    /// Q_v − M q̈ (1 + n values).
    pub inertia_force: MotionKernel,
    /// Q_v (1 + n values), eq. (27).
    pub quadratic_velocity: MotionKernel,
    /// M(q), eq. (31).
    pub mass: MotionKernel,
    /// PF = ∂(M q̈)/∂q, eqs. (37), (40).
    pub pf: MotionKernel,
    /// B = ∂Q_v/∂q, eqs. (38), (41).
    pub b: MotionKernel,
    /// P = ∂Q_v/∂q̇, eqs. (39), (42).
    pub p: MotionKernel,
    /// a2·M + PF − a1·P − B, in one pass.
    pub tangent: fn(
        tensors: &[&[f64]],
        state: &MotionState,
        a1: f64,
        a2: f64,
        workspace: &mut [f64],
        out: &mut [f64],
    ),
}
