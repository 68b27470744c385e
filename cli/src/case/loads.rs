//! Loads fixed in space.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::Located;

use super::reader::{ANGLE, FORCE, FREQUENCY, Reader};

/// A force on sets of shaft nodes, fixed in space: F(t) = F, or F sin(2π f t + φ).
#[derive(Debug, Clone)]
pub struct Load {
    /// Sets of the shaft's mesh; every node of each carries the force.
    pub sets: Vec<Located>,
    /// 0 for x, 1 for y.
    pub direction: usize,
    /// F in N.
    pub force: f64,
    /// f in Hz; a static load has none.
    pub frequency: Option<f64>,
    /// φ in rad.
    pub phase: f64,
}

impl Load {
    /// Angular frequency in rad/s; zero for a static load.
    pub fn omega(&self) -> f64 {
        self.frequency.map_or(0.0, |frequency| TAU * frequency)
    }
}

pub(super) fn read(file: &Reader) -> Vec<Load> {
    let each = |load: Reader| Load {
        sets: load.needed_names("sets", None, "[\"LOAD1\"]"),
        direction: load.choice("direction", &[("x", 0), ("y", 1)]).unwrap_or(0),
        force: load.needed("force", &FORCE),
        frequency: load.quantity("frequency", &FREQUENCY),
        phase: load.quantity("phase", &ANGLE).unwrap_or(0.0),
    };
    file.tables("load").into_iter().map(each).collect()
}
