//! How far the bores of reduced bodies yield less than those of their meshes.

use std::fmt::Write;

use whirl_solver::cache::Cache;
use whirl_solver::contacts::{HARMONICS, lacking};
use whirl_solver::reduced::{BodyKind, Reduced};

use crate::case::{Case, System};
use crate::errors::Failure;
use crate::machine::{BodyPlan, Plan, PlannedBody};
use crate::report::table;

/// A part that is lacking is named with its remedy from here on.
const MUCH: f64 = 0.01;

/// Says it of every body with a mesh and bores.
///
/// # Errors
/// As the reduction of the bodies.
pub(super) fn say(
    text: &mut String,
    case: &Case,
    plan: Option<&Plan>,
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    let mut bodies: Vec<(String, BodyKind, &BodyPlan)> = Vec::new();
    match (&case.system, plan) {
        (System::Rotor(_), Some(Plan::Rotor(plan))) => {
            bodies.push(("support".to_owned(), BodyKind::Support, &plan.support));
        }
        (System::Joined(joined), Some(Plan::Joined(plan))) => {
            for (own, body) in joined.bodies.iter().zip(&plan.bodies) {
                let turns = own.turning.is_some();
                let kind = if turns { BodyKind::Shaft } else { BodyKind::Support };
                if let PlannedBody::Meshed(body) = body {
                    bodies.push((format!("body.{}", own.name.text()), kind, body));
                }
            }
        }
        _ => {}
    }
    bodies.retain(|(_, _, body)| !body.rigid && !body.bores.is_empty());
    if bodies.is_empty() {
        line!(text, "no bore is on a body that is reduced");
    }
    for (name, kind, body) in bodies {
        let (mesh, spec) = (&body.mesh, &body.spec);
        let known = cache.and_then(|cache| cache.load(&Reduced::key(kind, mesh, spec)));
        let reduced = known.map_or_else(|| Reduced::new(kind, mesh, spec), Ok);
        let found = reduced.and_then(|reduced| lacking(mesh, spec, &reduced, &body.bores));
        let found = found.map_err(|error| body.explain(error))?;
        say_body(text, &name, body, &found);
    }
    Ok(())
}

fn say_body(text: &mut String, name: &str, body: &BodyPlan, found: &[[f64; HARMONICS]]) {
    line!(
        text,
        "\nof {name}: part of the static compliance of its bores, under loads cos nψ around them and with its retained \
         nodes held, that its modes lack"
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
            "`static_correction = true` in `[{name}]` keeps the answers to these loads beside the {} modes; so do more `modes`, \
             slowly",
            body.spec.modes
        );
    }
}
