//! `whirl check --picture`: bodies made from sections, as on their drawing, with what stands where on them.

use whirl_solver::mesh::sections::SectionRow;
use whirl_solver::model::AttachmentKind;
use whirl_solver::output::Wanted;
use whirl_text::rounded;

use super::made::rows;
use crate::case::{Case, NamedBody, OutputPoint};
use crate::errors::Failure;
use crate::figures::{Figure, Line, Mark, Panel, Style};

const STYLES: [Style; 4] = [Style::First, Style::Second, Style::Third, Style::Fourth];
/// What is nearer than this part of the body's length shares a number.
const NEAR: f64 = 1e-6;
/// How far the axis reaches out, as a part of the body's length.
const BEYOND: f64 = 0.03;

/// All bodies of a case that are made from sections.
///
/// # Errors
/// There is none.
pub(super) fn figure(case: &Case) -> Result<Figure, Failure> {
    let bodies = case.machine.bodies.iter().enumerate();
    let drawn = bodies.filter_map(|(place, body)| Some(panel(case, place, body, rows(body)?)));
    let panels: Vec<Panel> = drawn.collect();
    if panels.is_empty() {
        return Err(Failure::Argument {
            message: format!("no body of `{}` is made from `sections`", case.name),
            help: "leave `--picture` out; `whirl mesh FILE --picture` draws a mesh file".to_owned(),
        });
    }
    Ok(Figure { title: format!("{}: {}", case.name, case.title), panels, columns: 1 })
}

/// The longitudinal section of a body, by materials, and marks where something stands on it.
fn panel(case: &Case, place: usize, body: &NamedBody, rows: &[SectionRow]) -> Panel {
    let mut materials: Vec<&str> = Vec::new();
    let mut lines = Vec::new();
    for row in rows {
        let name = row.material.name.as_str();
        let known = materials.iter().position(|own| *own == name);
        let number = known.unwrap_or_else(|| {
            materials.push(name);
            materials.len() - 1
        });
        let ([from, to], [inner, outer]) = (row.z, [row.inner, row.outer]);
        for side in [1.0, -1.0] {
            let corners = [
                (from, inner[0]),
                (from, outer[0]),
                (to, outer[1]),
                (to, inner[1]),
                (from, inner[0]),
            ];
            lines.push(Line {
                points: corners.map(|(z, r)| (1e3 * z, 1e3 * side * r)).to_vec(),
                style: STYLES[number % STYLES.len()],
                name: name.to_owned(),
            });
        }
    }
    let ends = rows.iter().flat_map(|row| row.z);
    let [first, last] = ends
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], z| [least.min(z), most.max(z)]);
    // The axis reaches out a little, so that numbers at the ends are on the sheet.
    let beyond = BEYOND * (last - first);
    lines.push(Line {
        points: [first - beyond, last + beyond].map(|z| (1e3 * z, 0.0)).to_vec(),
        style: Style::Thin,
        name: "axis".to_owned(),
    });
    // What stands where is long: at its place is a number, and the rest in the legend.
    let reach = rows.iter().flat_map(|row| row.outer).fold(0.0, f64::max);
    let mut marks = Vec::new();
    for (place, (z, names)) in standing(case, place, body, NEAR * (last - first)).iter().enumerate()
    {
        let (number, z) = (place + 1, 1e3 * z);
        marks.push(Mark { x: z, name: number.to_string() });
        lines.push(Line {
            points: [-1e3 * reach, 1e3 * reach].map(|r| (z, r)).to_vec(),
            style: Style::Limit,
            name: format!("{number}: {names}, z = {} mm", rounded(z, 6)),
        });
    }
    Panel {
        title: body.name.text().to_owned(),
        x: "z (mm)".to_owned(),
        y: "radius (mm)".to_owned(),
        lines,
        marks,
        ..Panel::default()
    }
}

/// Discs, masses, joints, loads and outputs by their z (m), together where they are not farther apart than `near`.
fn standing(case: &Case, place: usize, body: &NamedBody, near: f64) -> Vec<(f64, String)> {
    let mut all: Vec<(f64, String)> = Vec::new();
    for own in &body.attached {
        let kind = match own.what {
            // What a row has beside its cells is no part of its own.
            AttachmentKind::Disc { mass: 0.0, .. } => continue,
            AttachmentKind::Disc { .. } => "disc",
            AttachmentKind::Mass { .. } => "mass",
            AttachmentKind::Unbalance(_) => "unbalance",
        };
        all.push((own.z, format!("{kind} {}", own.name.text())));
    }
    for joint in &case.machine.joints {
        let sides = joint.sides.iter().filter(|side| side.body == Some(place));
        let z = sides.filter_map(|side| side.z);
        all.extend(z.map(|z| (z, format!("joint {}", joint.name.text()))));
    }
    let loads = case.machine.loads.iter().filter(|own| own.body == place);
    all.extend(loads.filter_map(|own| Some((own.z?, format!("load {}", own.name.text())))));
    for output in &case.outputs {
        if let Wanted::Motion { body, point: OutputPoint::Section(z, _), .. } = &output.what
            && *body == place
        {
            all.push((*z, format!("output {}", output.name)));
        }
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut together: Vec<(f64, String)> = Vec::new();
    for (z, name) in all {
        match together.last_mut().filter(|own| z - own.0 <= near) {
            Some(own) => own.1.push_str(&format!(", {name}")),
            None => together.push((z, name)),
        }
    }
    together
}
