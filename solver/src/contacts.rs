//! How well a reduced body follows the loads that bearings bring to its bores: compliances under harmonics of the angle,
//! reduced against full, and the loads whose static answers correct the reduction.

use std::collections::BTreeMap;

use crate::body::BodySpec;
use crate::error::Error;
use crate::mesh::{Mesh, NodeSetMean};
use crate::reduced::Reduced;
use crate::reduction::Row;

/// Harmonics of the angle, from 0 (the bore widens) and 1 (it is shifted) to 4.
pub const HARMONICS: usize = 5;

/// The nodes of a bore.
#[derive(Debug, Clone, PartialEq)]
pub struct BoreNodes {
    /// What it is called.
    pub name: String,
    /// Nodes of the mesh, ring by ring; or all of a surface as one.
    pub rings: Vec<Vec<usize>>,
    /// The node set of a surface, faces of which may be cut.
    pub surface: Option<String>,
    /// x and y of its axis (m).
    pub axis: [f64; 2],
    /// Pressures of a film under which it gives way; see [`pressures`].
    pub pressures: Vec<Row>,
}

/// A radial load on a bore, cos nψ or sin nψ around it: forces on dofs that sum to 1 N without sign, about.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// n.
    pub harmonic: usize,
    /// Forces (N) on dofs.
    pub load: Row,
}

/// cos nψ and sin nψ.
const AROUND: [fn(f64) -> f64; 2] = [f64::cos, f64::sin];

/// Those of a harmonic; of 0 the first alone.
fn around(harmonic: usize) -> &'static [fn(f64) -> f64] {
    &AROUND[..if harmonic == 0 { 1 } else { 2 }]
}

/// The loads of all harmonics on each ring of a bore; a node has the part of its face's area.
///
/// # Errors
/// As [`NodeSetMean::new`].
pub fn patterns(mesh: &Mesh, bore: &BoreNodes) -> Result<Vec<Pattern>, Error> {
    let mut patterns = Vec::new();
    for ring in bore.rings.iter().filter(|ring| !ring.is_empty()) {
        let mean = match &bore.surface {
            Some(set) => NodeSetMean::of_sets(mesh, &[set])?,
            None => NodeSetMean::new(mesh, ring)?,
        };
        let nodes: Vec<(usize, f64, f64)> = mean
            .nodes()
            .iter()
            .zip(mean.weights())
            .map(|(&node, &weight)| {
                let [x, y, _] = mesh.nodes()[node];
                (node, weight, (y - bore.axis[1]).atan2(x - bore.axis[0]))
            })
            .collect();
        for harmonic in 0..HARMONICS {
            for shape in around(harmonic) {
                let load = nodes.iter().flat_map(|&(node, weight, angle)| {
                    let force = weight * shape(harmonic as f64 * angle);
                    let (sin, cos) = angle.sin_cos();
                    [(3 * node, force * cos), (3 * node + 1, force * sin)]
                });
                patterns.push(Pattern { harmonic, load: load.collect() });
            }
        }
    }
    Ok(patterns)
}

/// A node of a film on its bore.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmNode {
    /// Around the bore (rad).
    pub angle: f64,
    /// Along the film, from −1 to 1.
    pub along: f64,
    /// Its part of the area.
    pub area: f64,
    /// The mean of the bore around it, Σ c u over nodes of the mesh.
    pub point: Row,
}

/// Harmonics of the angle in the pressure of a film, for each power along it: even powers as the largest pressure and the
/// smallest gap of an elastic bearing need them, odd ones for tilts.
const PRESSURE: [usize; 5] = [16, 4, 16, 4, 16];

/// Pressures of a film on its bore, cos nψ and sin nψ times Legendre's polynomials along it: forces on dofs as the film itself has
/// them.
pub fn pressures(nodes: &[FilmNode]) -> Vec<Row> {
    let mut loads = Vec::new();
    for (power, &most) in PRESSURE.iter().enumerate() {
        for harmonic in 0..=most {
            for shape in around(harmonic) {
                let mut load = BTreeMap::new();
                for FilmNode { angle, along, area, point } in nodes {
                    let force = area * legendre(power, *along) * shape(harmonic as f64 * angle);
                    let (sin, cos) = angle.sin_cos();
                    for &(node, weight) in point {
                        *load.entry(3 * node).or_insert(0.0) += force * weight * cos;
                        *load.entry(3 * node + 1).or_insert(0.0) += force * weight * sin;
                    }
                }
                loads.push(load.into_iter().collect());
            }
        }
    }
    loads
}

/// Legendre's polynomial of this degree.
fn legendre(degree: usize, x: f64) -> f64 {
    let (mut before, mut own) = (0.0, 1.0);
    for n in 0..degree {
        let n = n as f64;
        (before, own) = (own, ((2.0 * n + 1.0) * x * own - n * before) / (n + 1.0));
    }
    own
}

/// Of each harmonic the largest part of the static compliance of a bore, by its own load and with what is retained held,
/// that the reduced body lacks.
///
/// # Errors
/// As the reduction of the mesh.
pub fn lacking(
    mesh: &Mesh,
    spec: &BodySpec,
    reduced: &Reduced,
    bores: &[BoreNodes],
) -> Result<Vec<[f64; HARMONICS]>, Error> {
    let mut all = Vec::new();
    for bore in bores {
        all.push(patterns(mesh, bore)?);
    }
    let loads: Vec<Row> = all.iter().flatten().map(|pattern| pattern.load.clone()).collect();
    let mut parts = lacking_of_loads(mesh, spec, reduced, &loads)?.into_iter();
    let mut lacking = Vec::with_capacity(bores.len());
    for patterns in &all {
        let mut worst = [0.0; HARMONICS];
        for (pattern, part) in patterns.iter().zip(parts.by_ref()) {
            worst[pattern.harmonic] = f64::max(worst[pattern.harmonic], part);
        }
        lacking.push(worst);
    }
    Ok(lacking)
}

/// Of each load the part of the static displacement under it, in its own direction and with what is retained held, that the
/// reduced body lacks; none of a load on what is retained or held alone.
///
/// # Errors
/// As the reduction of the mesh; a load on nodes whose motion is not kept.
pub fn lacking_of_loads(
    mesh: &Mesh,
    spec: &BodySpec,
    reduced: &Reduced,
    loads: &[Row],
) -> Result<Vec<f64>, Error> {
    let full = spec.compliances(mesh, loads)?;
    let part = |(load, full): (&Row, f64)| {
        let has = reduced.modal_compliance(load).ok_or_else(|| Error::Mesh {
            origin: mesh.origin().to_owned(),
            what: "the motion of the nodes of a load is not kept".to_owned(),
        })?;
        Ok(if full > 0.0 { ((full - has) / full).max(0.0) } else { 0.0 })
    };
    loads.iter().zip(full).map(part).collect()
}
