//! Reducing both bodies, or finding them in the cache, each by itself.

use std::time::Instant;

use whirl_codegen::diagnostic::Diagnostics;
use whirl_solver::cache::{Cache, Key};
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::plan::{BodyPlan, MachinePlan, both};
use crate::errors::Failure;

/// Both bodies after their reduction.
pub(super) struct Bodies {
    pub(super) shaft: Shaft,
    pub(super) support: Support,
    /// Everything on which each depends that no text of a case says, as a hash.
    pub(super) content: [Key; 2],
    /// Wall time in s.
    pub(super) wall: f64,
    /// Whether both come from the cache.
    pub(super) cached: bool,
}

/// The bodies of a plan.
///
/// # Errors
/// Cells turned inside out, a body that can move freely, more modes than it has, and what else keeps
/// a body from being reduced.
pub(super) fn bodies(
    plan: &MachinePlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Bodies, Failure> {
    let start = Instant::now();
    // The bodies know nothing of each other.
    let mut of_support = Vec::new();
    let (shaft, support) = std::thread::scope(|scope| {
        let support =
            scope.spawn(|| reduced(BodyKind::Support, &plan.support, cache, &mut of_support));
        let shaft = reduced(BodyKind::Shaft, &plan.shaft, cache, warnings);
        (shaft, support.join().expect("a reduction does not panic"))
    });
    warnings.append(&mut of_support);
    let explained = |error| plan.shaft.explain(error);
    let shaft = shaft.and_then(|(found, own, known)| {
        Ok((found.shaft(&plan.shaft.spec).map_err(explained)?, own, known))
    });
    let explained = |error| plan.support.explain(error);
    let support = support.and_then(|(found, own, known)| {
        Ok((found.support(&plan.support.spec).map_err(explained)?, own, known))
    });
    let (shaft, support) = both(shaft, support, &mut Diagnostics::new())?;
    let ((shaft, first, known), (support, second, also)) = (shaft, support);
    Ok(Bodies {
        shaft,
        support,
        content: [first, second],
        wall: start.elapsed().as_secs_f64(),
        cached: known && also,
    })
}

/// A body, a hash of its content, and whether it comes from the cache.
pub(super) fn reduced(
    kind: BodyKind,
    plan: &BodyPlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<(Reduced, Key, bool), Failure> {
    let (mesh, spec) = (&plan.mesh, &plan.spec);
    let key = Reduced::key(kind, mesh, spec);
    // Which nodes and means are output, as what is applied to the body afterwards.
    let means: Vec<_> = spec.means.iter().map(|mean| (mean.nodes(), mean.weights())).collect();
    let content = Key::of(&(key.hex(), &spec.nodes, means));
    if let Some(found) = cache.and_then(|cache| cache.load(&key)) {
        return Ok((found, content, true));
    }
    let found = Reduced::new(kind, mesh, spec).map_err(|error| plan.explain(error))?;
    if let Some(cache) = cache
        && let Err(error) = cache.store(&key, &found)
    {
        let folder = cache.folder().display();
        warnings.push(format!("cannot keep a reduced body in {folder}: {error}"));
    }
    Ok((found, content, false))
}
