//! Why a body could not be reduced.

use std::fmt;

use crate::linalg::LinearAlgebraError;

/// Why a body could not be reduced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReductionError {
    /// The linear algebra failed.
    #[error(transparent)]
    LinearAlgebra(#[from] LinearAlgebraError),
    /// A matrix that must be symmetric is not known to be.
    #[error(
        "the {matrix} matrix is not symmetric by its structure; is its form symmetric in u and v?"
    )]
    NotSymmetric {
        /// `stiffness` or `mass`.
        matrix: &'static str,
    },
    /// More modes asked for than there are dofs that can move.
    #[error(
        "{asked} modes asked for, but only {available} dofs can move once the retained ones are held; ask for fewer modes"
    )]
    TooManyModes {
        /// Modes asked for.
        asked: usize,
        /// Dofs left.
        available: usize,
    },
    /// A retained dof does not exist or is listed twice.
    #[error(
        "retained dof {dof} (node {node}, component {component}) is listed twice or is not one of the {dofs} dofs of the body"
    )]
    Retained {
        /// The dof, 3·node + component, from 0.
        dof: usize,
        /// Its node, from 0.
        node: usize,
        /// Its component: 0 x, 1 y, 2 z.
        component: usize,
        /// Dofs of the body.
        dofs: usize,
    },
    /// A retained motion follows from those before it and from what is held.
    #[error(
        "retained motion {place} follows from others that are retained or held: take one of them out"
    )]
    Follows {
        /// Its place among the retained ones, from 0.
        place: usize,
        /// The place of the one before that ties make the same.
        same: Option<usize>,
    },
    /// With the retained dofs held the body can still move without being strained.
    #[error(
        "with its retained dofs held the body can still move freely: {}; hold or retain a dof, or add a spring, against each of these motions",
        list(motions)
    )]
    Mechanism {
        /// The free motions.
        motions: Vec<FreeMotion>,
    },
    /// Rounding of the stiffest dof hides all lower modes.
    #[error(
        "node {node} is so stiff along {} for its mass (at {stiffest:.1e} Hz) that rounding hides the modes, \
         which lie at {modes:.1e} Hz", ["x", "y", "z"][*component]
    )]
    Hidden {
        /// The stiffest node: its label in a mesh, its index where there are matrices only.
        node: u64,
        /// Its component: 0 x, 1 y, 2 z.
        component: usize,
        /// √(K_ii/M_ii)/2π of this dof (Hz).
        stiffest: f64,
        /// The highest of the modes wanted (Hz).
        modes: f64,
    },
    /// The block Lanczos iteration stopped before all modes had converged.
    #[error(
        "only {converged} of {asked} modes converged in {slices} slices of the spectrum: they lie closer together \
         than rounding can resolve; ask for fewer modes, or leave out cells that are much smaller or stiffer than \
         the others"
    )]
    NotConverged {
        /// Modes that converged.
        converged: usize,
        /// Modes wanted.
        asked: usize,
        /// Slices, or shifts of one, that were tried.
        slices: usize,
    },
    /// The modes found below a frequency are not as many as the Sturm count says.
    #[error("{found} modes were found below {hertz} Hz, but the Sturm count says {counted}")]
    Miscounted {
        /// Modes found.
        found: usize,
        /// Modes there are.
        counted: usize,
        /// Frequency (Hz) below which they were counted.
        hertz: f64,
    },
}

fn list(motions: &[FreeMotion]) -> String {
    motions.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// A motion that strains nothing.
#[derive(Debug, Clone, PartialEq)]
pub enum FreeMotion {
    /// The body shifts.
    Translation {
        /// Unit vector.
        direction: [f64; 3],
    },
    /// The body turns, perhaps sliding along the axis as well.
    Rotation {
        /// Unit vector along the axis.
        direction: [f64; 3],
        /// The point of the axis nearest to the middle of the body (m).
        through: [f64; 3],
    },
    /// Part of the mesh is loose: neither joined to the rest nor held.
    Part {
        /// A node of it: its label in a mesh, its index where there are matrices only.
        node: u64,
    },
}

impl fmt::Display for FreeMotion {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            FreeMotion::Translation { direction } => write!(f, "shift along {}", axis(direction)),
            FreeMotion::Rotation { direction, through: [x, y, z] } => {
                let direction = axis(direction);
                // Without the sign of what rounds to zero.
                let [x, y, z] = [x, y, z].map(|value| (1e4 * value).round() / 1e4 + 0.0);
                write!(f, "turn about an axis along {direction} through ({x:.4}, {y:.4}, {z:.4}) m")
            }
            FreeMotion::Part { node } => {
                write!(f, "the part of the mesh around node {node} is loose")
            }
        }
    }
}

fn axis(direction: &[f64; 3]) -> String {
    for (component, name) in direction.iter().zip(["x", "y", "z"]) {
        if component.abs() > 1.0 - 1e-6 {
            return name.to_string();
        }
    }
    let [x, y, z] = direction;
    format!("({x:.3}, {y:.3}, {z:.3})")
}
