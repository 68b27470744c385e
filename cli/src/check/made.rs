//! What a page says of what bodies are made of, and how they are held.

use whirl_solver::mesh::sections::SectionRow;
use whirl_solver::mesh::{Material, Mesh};
use whirl_text::{rounded, shown};

use crate::case::{self, Dimensions, Form, JoinedMachine, MeshedBody, NamedBody};
use crate::machine::{JoinedPlan, PlannedBody};
use crate::page::Section;

/// Rows of a table of sections, at most.
const MOST_ROWS: usize = 60;
/// Materials of a body, at most.
const MOST_MATERIALS: usize = 6;

/// A line a body with a mesh: its size, its materials, what holds it.
pub(super) fn lines(machine: &JoinedMachine, plan: &JoinedPlan) -> Vec<String> {
    let of = |(body, own): (&NamedBody, &PlannedBody)| {
        let (Form::Meshed(form), Some(meshed)) = (&body.form, own.meshed()) else { return None };
        let mesh = &meshed.mesh;
        let mut said: Vec<String> = size(mesh, body.turns()).into_iter().collect();
        let all = mesh.materials().iter().filter(|own| !own.properties.is_empty());
        let all: Vec<String> = all.map(material).collect();
        said.extend(all.iter().take(MOST_MATERIALS).cloned());
        if all.len() > MOST_MATERIALS {
            said.push(format!("{} more materials", all.len() - MOST_MATERIALS));
        }
        said.extend(held(form, mesh));
        (!said.is_empty()).then(|| format!("{}: {}", body.name.text(), said.join("; ")))
    };
    machine.bodies.iter().zip(&plan.bodies).filter_map(of).collect()
}

/// The sections of bodies that are made from a table, a table each.
pub(super) fn sections(machine: &JoinedMachine) -> Vec<Section> {
    let of = |body: &NamedBody| {
        let rows = rows(body)?;
        let heads = ["z (mm)", "outer diameter (mm)", "inner diameter (mm)", "material"];
        let mm = |ends: [f64; 2], scale: f64| {
            let [from, to] = ends.map(|own| rounded(1e3 * scale * own, 6).to_string());
            if from == to { from } else { format!("{from} to {to}") }
        };
        let row = |own: &SectionRow| {
            let inner = if own.inner == [0.0; 2] { "–".to_owned() } else { mm(own.inner, 2.0) };
            vec![mm(own.z, 1.0), mm(own.outer, 2.0), inner, own.material.name.clone()]
        };
        let mut table = vec![heads.map(str::to_owned).to_vec()];
        table.extend(rows.iter().take(MOST_ROWS).map(row));
        let more = rows.len().saturating_sub(MOST_ROWS);
        let lines = (more > 0).then(|| format!("{more} more rows"));
        let title = format!("Sections of {}", body.name.text());
        Some(Section { title, table, lines: lines.into_iter().collect() })
    };
    machine.bodies.iter().filter_map(of).collect()
}

/// The rows of a body that is made from sections.
pub(super) fn rows(body: &NamedBody) -> Option<&[SectionRow]> {
    let Form::Meshed(own) = &body.form else { return None };
    let case::Mesh::Generated(made) = &own.body.mesh else { return None };
    match &made.dimensions {
        Dimensions::Sections(own) => Some(&own.table.rows),
        _ => None,
    }
}

/// Its length and largest diameter, or how far it reaches in each direction; none of matrices.
fn size(mesh: &Mesh, turns: bool) -> Option<String> {
    if mesh.cell_count() == 0 {
        return None;
    }
    let mm = |own: f64| rounded(1e3 * own, 6);
    let ends = [0, 1, 2].map(|axis| {
        let nodes = mesh.nodes().iter().map(|node| node[axis]);
        nodes.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
    });
    let [x, y, [from, to]] = ends;
    Some(match turns {
        true => {
            let radius = mesh.nodes().iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max);
            let along = format!("z = {} to {} mm", mm(from), mm(to));
            format!("{along}, largest diameter {} mm", mm(2.0 * radius))
        }
        false => format!(
            "x from {} to {}, y from {} to {}, z from {} to {} mm",
            mm(x[0]),
            mm(x[1]),
            mm(y[0]),
            mm(y[1]),
            mm(from),
            mm(to)
        ),
    })
}

fn material(own: &Material) -> String {
    let of = |symbol: &str| own.properties.get(symbol).copied();
    let all = [("E", "E", 1e-9, " GPa"), ("nu", "ν", 1.0, ""), ("rho", "ρ", 1.0, " kg/m³")];
    let values = all.into_iter().filter_map(|(symbol, letter, scale, unit)| {
        let value = shown(scale * of(symbol)?, 6, 1e-3..1e6);
        Some(format!("{letter} = {value}{unit}"))
    });
    format!("{}: {}", own.name, values.collect::<Vec<_>>().join(", "))
}

/// What ties it to the ground beside its joints.
fn held(form: &MeshedBody, mesh: &Mesh) -> Vec<String> {
    let nodes = |set: &str| mesh.node_set(set).map_or(0, <[usize]>::len);
    let plural = |count: usize| if count == 1 { "" } else { "s" };
    let mut all = Vec::new();
    for set in &form.held {
        let count = nodes(set.text());
        let plural = plural(count);
        all.push(format!("held in all directions at {} ({count} node{plural})", set.text()));
    }
    for own in &form.ground_springs {
        let (count, along) = (nodes(own.set.text()), ["x", "y", "z"][own.direction]);
        let stiffness = shown(own.stiffness, 6, 1e-3..1e6);
        let (set, plural) = (own.set.text(), plural(count));
        let each = if count == 1 { "" } else { " each" };
        all.push(format!(
            "springs to the ground along {along} at {set}: {count} node{plural}, {stiffness} N/m{each}"
        ));
    }
    let along = form.axial_restraint.as_ref();
    all.extend(along.map(|own| format!("held along z at {}", own.text())));
    all
}
