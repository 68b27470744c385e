//! What `whirl check` says of bodies: masses and inertias, what they carry, how they turn.

use std::fmt::Write;

use whirl_solver::assembly::{MassProperties, mass_properties};
use whirl_solver::bodies::Rotation;
use whirl_solver::model::AttachmentKind;
use whirl_text::rounded;

use super::frequencies::rpm;
use crate::case::{Attached, Case, Form, JoinedMachine, NamedBody, Start};
use crate::errors::Failure;
use crate::machine::{JoinedPlan, PlannedBody};
use crate::report::table;

/// Masses and inertias, and what bodies carry.
///
/// # Errors
/// Of linear algebra.
pub(super) fn say(
    text: &mut String,
    joined: &JoinedMachine,
    plan: &JoinedPlan,
) -> Result<(), Failure> {
    line!(text, "\nBodies\n{}", table(&masses(joined, plan)?).trim_end());
    carried(joined).iter().for_each(|own| line!(text, "{own}"));
    Ok(())
}

/// What bodies carry, a line each.
pub(super) fn carried(joined: &JoinedMachine) -> Vec<String> {
    let mut lines = Vec::new();
    for body in &joined.bodies {
        if let Form::Rigid(own) = &body.form
            && own.rocks
        {
            let [x, y] = [0, 1].map(|axis| rounded(1e3 * own.centre[axis], 6));
            let name = body.name.text();
            lines.push(format!(
                "{name} rocks about z; its centre of mass is at x = {x}, y = {y} mm"
            ));
        }
        for own in &body.attached {
            let (kind, what) = match own.what {
                AttachmentKind::Disc { mass, polar_inertia, diametral_inertia } => {
                    let [polar, transverse] =
                        [polar_inertia, diametral_inertia].map(|own| rounded(own, 6));
                    let inertias =
                        format!("polar inertia {polar} kg m², transverse {transverse} kg m²");
                    ("disc", format!("{mass} kg, {inertias}"))
                }
                AttachmentKind::Mass { mass, offset: [x, y] } => {
                    let radius = rounded(1e3 * x.hypot(y), 6);
                    let angle = rounded(y.atan2(x).to_degrees(), 6);
                    ("mass", format!("{mass} kg at radius {radius} mm, {angle}°"))
                }
                // It is a load, and adds to no inertia.
                AttachmentKind::Unbalance(_) => continue,
            };
            let (body, name) = (body.name.text(), own.name.text());
            let z = rounded(1e3 * own.z, 6);
            lines.push(format!("{body} carries {kind} {name} at z = {z} mm: {what}"));
        }
    }
    lines
}

/// How each body turns, if it does.
pub(super) fn say_speeds(text: &mut String, joined: &JoinedMachine, case: &Case) {
    let lines = speeds(joined, case);
    if !lines.is_empty() {
        line!(text, "\nSpeeds\n{}", lines.join("\n"));
    }
}

/// The same, a line a body.
pub(super) fn speeds(joined: &JoinedMachine, case: &Case) -> Vec<String> {
    let run = case.run();
    let told = |rotation: &Rotation| match *rotation {
        Rotation::Prescribed { speed, acceleration: 0.0 } => {
            format!("prescribed, {} rpm", rpm(speed))
        }
        Rotation::Prescribed { speed, acceleration } if run.duration > 0.0 => {
            let last = rpm(speed + acceleration * run.duration);
            format!("prescribed, from {} rpm to {last} rpm in {} s", rpm(speed), run.duration)
        }
        Rotation::Prescribed { speed, acceleration } => {
            format!("prescribed, from {} rpm by {} rpm/s", rpm(speed), rpm(acceleration))
        }
        _ if run.goes_on => "free, from the speed of the state".to_owned(),
        _ => match case.start {
            Start::Equilibrium => "free, from the speed at which its couples balance".to_owned(),
            _ => "free, from rest".to_owned(),
        },
    };
    let of = |body: &NamedBody| {
        let rotation = body.rotation.as_ref()?;
        Some(match (&body.speeds, body.initial_speed) {
            (Some(columns), _) => format!("prescribed by the table `{}`", columns.name.text()),
            (None, Some(speed)) if !run.goes_on => format!("free, from {} rpm", rpm(speed)),
            _ => told(rotation),
        })
    };
    let aim = |place: usize| {
        let own = joined.drives.iter().find(|own| own.body == place && own.couple.acts)?;
        let target = rpm(own.couple.target_speed);
        own.couple.table.is_none().then(|| format!("; its drive acts until {target} rpm"))
    };
    let line = |(place, body): (usize, &NamedBody)| {
        let turning = of(body)?;
        Some(format!("{}: {turning}{}", body.name.text(), aim(place).unwrap_or_default()))
    };
    joined.bodies.iter().enumerate().filter_map(line).collect()
}

/// The table of masses and inertias, all that bodies carry included: a row a body, below one of heads.
///
/// # Errors
/// Of linear algebra.
pub(super) fn masses(
    joined: &JoinedMachine,
    plan: &JoinedPlan,
) -> Result<Vec<Vec<String>>, Failure> {
    let heads =
        ["", "mass (kg)", "centre z (mm)", "polar inertia (kg m²)", "transverse inertia (kg m²)"];
    let mut rows = vec![heads.map(str::to_string).to_vec()];
    for (body, own) in joined.bodies.iter().zip(&plan.bodies) {
        let mut about_axes = None;
        let [mass, z, polar, transverse] = match own {
            PlannedBody::Rigid(rigid) => {
                let own = &rigid.body;
                let polar = (body.turns() || own.rocks).then_some(own.polar_inertia);
                [Some(own.mass), Some(own.centre[2]), polar, own.transverse_inertia]
            }
            PlannedBody::Meshed(meshed) => {
                let own = mass_properties(&meshed.mesh)?;
                about_axes = Some(across_axes(&own));
                let ([x, y, z], second) = (own.centre, own.second_moment);
                // Rounding of a centre at the origin is none of its places.
                let size =
                    meshed.mesh.nodes().iter().fold(0.0, |most: f64, node| most.max(node[2].abs()));
                let centre = if z.abs() < 1e-9 * size { 0.0 } else { z };
                // About its axis where it turns, else about its centre, as across it.
                let polar = second[0][0] + second[1][1]
                    - if body.turns() { 0.0 } else { own.mass * (x * x + y * y) };
                let across = second[1][1] + second[2][2] - own.mass * (y * y + z * z);
                [Some(own.mass), Some(centre), Some(polar), Some(across)]
            }
        };
        let [mass, z, polar, transverse] = carrying(&body.attached, [mass, z, polar, transverse]);
        // What does not tilt is alike at any z.
        let z = z.filter(|_| transverse.is_some());
        let shown_across = match about_axes {
            // With what it carries, which is alike about both.
            Some([about_x, about_y]) if (about_x - about_y).abs() > 1e-3 * about_x.max(about_y) => {
                let more = transverse.map_or(0.0, |own| own - about_x);
                format!(
                    "{} about x, {} about y",
                    rounded(about_x + more, 6),
                    rounded(about_y + more, 6)
                )
            }
            _ => transverse.map_or("–".to_string(), |value| rounded(value, 6).to_string()),
        };
        let shown = |value: Option<f64>, scale: f64| {
            value.map_or("–".to_string(), |value| rounded(scale * value, 6).to_string())
        };
        rows.push(vec![
            body.name.text().to_string(),
            shown(mass, 1.0),
            shown(z, 1e3),
            shown(polar, 1.0),
            shown_across,
        ]);
    }
    Ok(rows)
}

/// Mass, z of the centre, polar and transverse inertia of a body with what it carries.
fn carrying(attached: &[Attached], own: [Option<f64>; 4]) -> [Option<f64>; 4] {
    let ([Some(mass), Some(z), ..], polar, transverse) = (own, own[2], own[3]) else { return own };
    // Mass, z, polar and transverse inertia about its own centre.
    let parts = attached.iter().filter_map(|own| match own.what {
        AttachmentKind::Disc { mass, polar_inertia, diametral_inertia } => {
            Some([mass, own.z, polar_inertia, diametral_inertia])
        }
        AttachmentKind::Mass { mass, offset: [x, y] } => {
            let square = mass * (x * x + y * y);
            Some([mass, own.z, square, 0.5 * square])
        }
        AttachmentKind::Unbalance(_) => None,
    });
    let parts: Vec<[f64; 4]> = parts.collect();
    let total = mass + parts.iter().map(|[mass, ..]| mass).sum::<f64>();
    let centre = (mass * z + parts.iter().map(|[mass, z, ..]| mass * z).sum::<f64>()) / total;
    let polar = polar.map(|own| own + parts.iter().map(|part| part[2]).sum::<f64>());
    let moved = |mass: f64, z: f64| mass * (z - centre).powi(2);
    let across = parts.iter().map(|[mass, z, _, own]| own + moved(*mass, *z)).sum::<f64>();
    [Some(total), Some(centre), polar, transverse.map(|own| own + moved(mass, z) + across)]
}

/// Inertias of a mesh about x and y through its centre (kg m²).
fn across_axes(own: &MassProperties) -> [f64; 2] {
    let ([x, y, z], second) = (own.centre, own.second_moment);
    let about =
        |axis: usize, off: f64| second[axis][axis] + second[2][2] - own.mass * (off * off + z * z);
    [about(1, y), about(0, x)]
}
