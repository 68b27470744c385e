//! What goes into a film between a rigid journal and a rigid bore, and what comes out.

/// Forces along x and y, moments about x and y, and the moment about z, on the journal, in the bore's frame.
pub const OUTPUTS: usize = 5;
/// As many numbers as fill a register, the last of them zero.
pub(super) const WIDE: usize = 8;
/// Displacements along x and y, tilts about x and y; as many rates; the speed.
pub const INPUTS: usize = 9;

/// How the journal stands and moves in its bore.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JournalMotion {
    /// e_x, e_y of the middle (m).
    pub displacement: [f64; 2],
    /// Small rotations about x and y (rad).
    pub tilt: [f64; 2],
    /// Rates of both (m/s, rad/s).
    pub velocity: [f64; 2],
    /// Rates of the tilts (rad/s).
    pub tilting: [f64; 2],
    /// Speed of the journal against the bore (rad/s).
    pub omega: f64,
    /// Length of the step (s); none where the film is steady but for the rates.
    pub step: Option<f64>,
}

/// What a film does to its journal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reaction {
    /// F_x, F_y (N), M_x, M_y, M_z (N·m).
    pub forces: [f64; OUTPUTS],
    /// Slopes of each by displacements, tilts, their rates, and the speed.
    pub slopes: [[f64; INPUTS]; OUTPUTS],
}

/// Slopes of the measures of every force by displacement and turn of the journal, of every node around.
pub(super) type Gradients = Vec<Vec<[f64; 3]>>;

/// Forces and moments of unit force at a node: by e_x, e_y, tilts about x and y, and the turn.
#[inline(always)]
pub(super) fn arms([x, y, turn]: [f64; 3], z: f64) -> [f64; WIDE] {
    // A tilt moves a section at z along y by −z, one about y along x by z.
    [x, y, -z * y, z * x, turn, 0.0, 0.0, 0.0]
}
