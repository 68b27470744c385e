//! Reducing both bodies, or finding them in the cache.

use std::time::Instant;

use serde::{Deserialize, Serialize};
use whirl_codegen::diagnostic::Diagnostics;
use whirl_solver::cache::{Cache, Key, instruction_set};
use whirl_solver::mesh::Mesh;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::plan::{BodyPlan, Plan, both};
use crate::errors::Failure;
use crate::version;

/// Both bodies after their reduction.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Bodies {
    pub(super) shaft: Shaft,
    pub(super) support: Support,
}

/// The bodies, the wall time in s that it took, and whether they come from the cache.
///
/// # Errors
/// Cells turned inside out, a body that can move freely, more modes than it has, and what else keeps
/// a body from being reduced.
pub(super) fn bodies(plan: &Plan, cache: Option<&Cache>) -> Result<(Bodies, f64, bool), Failure> {
    let start = Instant::now();
    let kept = cache.map(|cache| (cache, key(plan)));
    if let Some(found) = kept.and_then(|(cache, key)| cache.load(&key)) {
        return Ok((found, start.elapsed().as_secs_f64(), true));
    }
    // The bodies know nothing of each other.
    let (shaft, support) = std::thread::scope(|scope| {
        let support = scope.spawn(|| Support::from_mesh(&plan.support.mesh, &plan.support.spec));
        let shaft = Shaft::from_mesh(&plan.shaft.mesh, &plan.shaft.spec);
        (shaft, support.join().expect("a reduction does not panic"))
    });
    let (shaft, support) = both(
        shaft.map_err(|error| plan.shaft.explain(error)),
        support.map_err(|error| plan.support.explain(error)),
        &mut Diagnostics::new(),
    )?;
    let bodies = Bodies { shaft, support };
    if let Some((cache, key)) = kept
        && let Err(error) = cache.store(&key, &bodies)
    {
        let folder = cache.folder().display();
        eprintln!("warning: cannot keep the reduced machine in {folder}: {error}");
    }
    Ok((bodies, start.elapsed().as_secs_f64(), false))
}

/// Everything on which the bits of the reduced bodies depend.
fn key(plan: &Plan) -> Key {
    Key::of(&(
        (version::PACKAGE, version::COMMIT, instruction_set()),
        dependencies(&plan.shaft),
        dependencies(&plan.support),
    ))
}

fn dependencies(plan: &BodyPlan) -> impl Serialize + '_ {
    let spec = &plan.spec;
    let retained: Vec<(usize, &str)> =
        spec.retained.iter().map(|retained| (retained.dof, retained.name.as_str())).collect();
    let equations = spec.constraints.equations().iter();
    let equations: Vec<(&str, &[(usize, f64)])> =
        equations.map(|equation| (equation.name.as_str(), equation.terms.as_slice())).collect();
    let springs: Vec<(usize, f64)> =
        spec.springs.iter().map(|spring| (spring.dof, spring.stiffness)).collect();
    (mesh(&plan.mesh), (retained, spec.modes, equations, springs), spec.damping, &spec.nodes)
}

fn mesh(mesh: &Mesh) -> impl Serialize + '_ {
    let blocks: Vec<(&str, usize, &[usize])> = mesh
        .blocks()
        .iter()
        .map(|block| (block.element.origin.hash, block.material, block.connectivity.as_slice()))
        .collect();
    let materials: Vec<_> = mesh.materials().iter().map(|material| &material.properties).collect();
    (mesh.nodes(), blocks, materials)
}
