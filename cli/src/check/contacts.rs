//! How far reduced bodies yield less than their meshes: their bores, and where loads act on them.

use std::fmt::Write;

use whirl_solver::cache::Cache;
use whirl_solver::contacts::{HARMONICS, lacking, lacking_of_loads};
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::reduction::Row;

use crate::case::Case;
use crate::errors::Failure;
use crate::machine::{BodyPlan, JoinedPlan};
use crate::report::table;

/// A part that is lacking is named with its remedy from here on.
const MUCH: f64 = 0.01;

/// Dofs of a body up to which what its loads lack is computed without being asked for: well below a second.
const CHEAP: usize = 20_000;

/// A body with a mesh: the name of its table, its kind, and its plan.
type Meshed<'a> = (String, BodyKind, &'a BodyPlan);

/// The bodies of a case that are reduced.
fn reduced_bodies<'a>(case: &Case, plan: &'a JoinedPlan) -> Vec<Meshed<'a>> {
    let all = case.machine.bodies.iter().zip(&plan.bodies);
    let meshed = all.filter_map(|(own, body)| {
        let kind = if own.turns() { BodyKind::Shaft } else { BodyKind::Support };
        let body = body.meshed().filter(|body| !body.rigid)?;
        Some((case.machine.table_of(own), kind, body))
    });
    meshed.collect()
}

/// Reduced as it is marched, from the cache if it is there.
fn reduced(
    (_, kind, body): &Meshed,
    cache: Option<&Cache>,
) -> Result<Reduced, whirl_solver::Error> {
    let (mesh, spec) = (&body.mesh, &body.spec);
    let known = cache.and_then(|cache| cache.load(&Reduced::key(*kind, mesh, spec)));
    known.map_or_else(|| Reduced::new(*kind, mesh, spec), Ok)
}

/// Says of every load with sets of its own how much of the static displacement under it the reduced body lacks; of large
/// bodies only if `wanted`.
///
/// # Errors
/// As the reduction of the bodies.
pub(super) fn say_loads(
    text: &mut String,
    case: &Case,
    (plan, wanted): (&JoinedPlan, bool),
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    for own in reduced_bodies(case, plan) {
        let (name, _, body) = &own;
        say_cost(text, name, body);
        if body.loads.is_empty() || !wanted && body.mesh.dof_count() > CHEAP {
            continue;
        }
        let loads: Vec<Row> = body.loads.iter().map(|(_, load)| load.clone()).collect();
        let found = reduced(&own, cache)
            .and_then(|reduced| lacking_of_loads(&body.mesh, &body.spec, &reduced, &loads));
        let found = found.map_err(|error| body.explain(error))?;
        let mut worst: Vec<(&str, f64)> = Vec::new();
        for ((load, _), part) in body.loads.iter().zip(found) {
            match worst.last_mut().filter(|(known, _)| known == load) {
                Some((_, most)) => *most = most.max(part),
                None => worst.push((load, part)),
            }
        }
        let parts: Vec<String> =
            worst.iter().map(|(load, part)| format!("{load} {:.2} %", 100.0 * part)).collect();
        line!(
            text,
            "part of the static displacement under each load that the reduced {name} lacks (retained nodes held): {}",
            parts.join(", ")
        );
        let most = worst.iter().fold(0.0, |most: f64, (_, part)| most.max(*part));
        if most > MUCH && body.spec.corrections.is_empty() {
            line!(
                text,
                "remove `static_correction = false` from `[{name}]` to keep the answers to these loads in addition \
                 to the {} modes",
                body.spec.modes
            );
        }
    }
    Ok(())
}

/// Says what the static answers of a body cost.
fn say_cost(text: &mut String, name: &str, body: &BodyPlan) {
    let (answers, modes) = (body.spec.corrections.len(), body.spec.modes);
    if answers > 0 {
        line!(
            text,
            "the reduced {name} keeps {answers} static answers beside {modes} modes and {} retained motions, a \
             coordinate each",
            body.spec.retained.len()
        );
    }
}

/// Says of every body with bores how far these yield less than those of its mesh.
///
/// # Errors
/// As the reduction of the bodies.
pub(super) fn say(
    text: &mut String,
    case: &Case,
    plan: &JoinedPlan,
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    let mut bodies = reduced_bodies(case, plan);
    bodies.retain(|(_, _, body)| !body.bores.is_empty());
    if bodies.is_empty() {
        line!(text, "no reduced body has a bore");
    }
    for own in bodies {
        let (name, _, body) = &own;
        let found = reduced(&own, cache)
            .and_then(|reduced| lacking(&body.mesh, &body.spec, &reduced, &body.bores));
        let found = found.map_err(|error| body.explain(error))?;
        say_body(text, name, body, &found);
    }
    Ok(())
}

fn say_body(text: &mut String, name: &str, body: &BodyPlan, found: &[[f64; HARMONICS]]) {
    line!(
        text,
        "\npart of the static compliance of its bores that the reduced {name} lacks, under loads cos nψ (retained \
         nodes held)"
    );
    let heads = std::iter::once(String::new()).chain((0..HARMONICS).map(|n| format!("n = {n}")));
    let mut rows = vec![heads.collect::<Vec<String>>()];
    for (bore, lacking) in body.bores.iter().zip(found) {
        let cells = lacking.iter().map(|part| format!("{:.2} %", 100.0 * part));
        rows.push(std::iter::once(bore.name.clone()).chain(cells).collect());
    }
    text.push_str(&table(&rows));
    text.push('\n');
    let worst = found.iter().flatten().fold(0.0, |most: f64, part| most.max(*part));
    if worst > MUCH {
        line!(
            text,
            "`static_correction = true` in `[{name}]` keeps the answers to these loads in addition to the {} modes; \
             more `modes` also help, but slowly",
            body.spec.modes
        );
    }
}
