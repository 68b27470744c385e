//! What `whirl check` says of bodies by name and of what joins them.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_codegen::kinds::law::Acts;
use whirl_solver::assembly::mass_properties;
use whirl_solver::bearing::MotionKind;
use whirl_solver::bodies::Rotation;
use whirl_solver::mesh::measure::Circle;
use whirl_solver::mesh::{self as solid, Fineness};
use whirl_solver::model::AttachmentKind;
use whirl_text::rounded;

use crate::case::{
    Attached, Form, Gravity, JoinedMachine, Joint, JointKind, Mesh, NamedBody, Run, SetParameter,
};
use crate::errors::Failure;
use crate::machine::{Built, JoinedPlan, PlannedBody, fineness};
use crate::report::table;

/// Frequencies of a body that are said.
const FIRST: usize = 5;

/// Bodies, joints, drives and loads; `built` has the frequencies.
pub(super) fn say(
    text: &mut String,
    joined: &JoinedMachine,
    plan: &JoinedPlan,
    built: &Built,
    run: Run,
) -> Result<(), Failure> {
    text.push_str(&masses(joined, plan)?);
    text.push('\n');
    text.push_str(&sizes(plan, joined, built));
    for (body, own) in joined.bodies.iter().zip(&plan.bodies) {
        if let Some(found) = fineness_of(body) {
            line!(text, "{}: {}", body.name.text(), fineness::described(&found));
        }
        if let PlannedBody::Meshed(meshed) = own {
            super::sets::say(text, body.name.text(), &meshed.mesh)?;
            materials(text, body.name.text(), &meshed.mesh);
        }
    }
    let facts = built.bodies.iter().flat_map(|facts| &facts.bodies);
    for body in facts.filter(|body| !body.hertz.is_empty()) {
        let first: Vec<String> = body.hertz.iter().take(FIRST).map(|f| format!("{f:.2}")).collect();
        let more = if body.hertz.len() > FIRST { ", …" } else { "" };
        line!(
            text,
            "natural frequencies of {} with its joints and loads held: {}{more} Hz",
            body.name,
            first.join(", ")
        );
        turning(text, joined, built, &body.name, run)?;
    }
    for (body, own) in joined.bodies.iter().zip(&plan.bodies) {
        let frame = match own {
            PlannedBody::Meshed(plan) => plan.frame.as_ref().filter(|_| !plan.rigid),
            PlannedBody::Rigid(_) => None,
        };
        if let Some(frame) = frame {
            line!(text, "the frame of {} turns with {frame}", body.name.text());
        }
    }
    line!(text, "{} active coordinates", built.machine.active());
    for (place, (joint, law)) in joined.joints.iter().zip(&plan.laws).enumerate() {
        let (c, circles) = plan.clearance(place);
        line!(text, "{}", of_joint(joint, &law.name(), c, plan.rings(place)));
        if let Some([journal, bore]) = circles {
            line!(
                text,
                "  measured on the meshes: journal of radius {}, bore of radius {}",
                round(journal),
                round(bore)
            );
        }
        let turns = |body: usize| joined.bodies[body].turns();
        let turning = joint.sides[1].body.filter(|body| turns(*body));
        if let Some(bore) = turning.filter(|_| law.damps_against_bore()) {
            line!(
                text,
                "  its law takes rates without omega, and its bore turns with {}: this is rotating damping, which \
                 destabilises above a critical speed",
                joined.bodies[bore].name.text()
            );
        }
    }
    joined.bodies.iter().for_each(|body| alone(text, body));
    for drive in joined.drives.iter().filter(|drive| drive.couple.acts) {
        line!(
            text,
            "drive {}on {}: {}",
            if joined.is_named() { format!("{} ", drive.name.text()) } else { String::new() },
            drive.place.text(),
            drive.couple.described()
        );
    }
    for own in &joined.loads {
        let sets: Vec<&str> = own.load.sets.iter().map(|set| set.text()).collect();
        let of = own.load.followed().filter(|_| joined.is_named());
        let of = of.map(|body| joined.bodies[body].name.text());
        let place =
            if sets.is_empty() { String::new() } else { format!(" at {}", sets.join(", ")) };
        line!(
            text,
            "load {} on {}{place}: {}",
            own.name.text(),
            joined.bodies[own.body].name.text(),
            own.load.described("", of)
        );
    }
    if let Some(gravity) = &joined.gravity {
        line!(text, "gravity: {} m/s²", listed(gravity));
    }
    if !joined.is_mass() {
        line!(text, "motion: {}", joined.motion.origin.title);
    }
    Ok(())
}

/// What the numbers of a rigid body are beyond its mass: its springs to the ground, its start, its unbalance in its frame.
fn alone(text: &mut String, body: &NamedBody) {
    let (Form::Rigid(own), name) = (&body.form, body.name.text()) else { return };
    let ([k_x, k_y], [c_x, c_y]) = (own.stiffness, own.damping);
    if own.stiffness != [0.0; 2] || own.damping != [0.0; 2] {
        line!(
            text,
            "{name} to the ground: stiffness {k_x} N/m along x, {k_y} along y; damping {c_x} N s/m along x, {c_y} along y"
        );
    }
    let (position, velocity) = (&body.start.position, &body.start.velocity);
    if let (Some(x), Some(v)) = (position.first(), velocity.first()) {
        line!(text, "{name} starts at x = {x} m with {v} m/s");
    }
    for attached in &body.attached {
        if let (AttachmentKind::Unbalance([x, y]), Some(speed)) = (attached.what, body.spin()) {
            let force = x.hypot(y) * speed * speed;
            line!(text, "unbalance of {name}: {} kg m, {} N", x.hypot(y), rounded(force, 10));
        }
    }
}

/// Gravity along x, y and z.
fn listed(gravity: &Gravity) -> String {
    gravity.acceleration.map(|part| part.to_string()).join(", ")
}

/// How fine the layers of a flexible body are that is made from dimensions.
fn fineness_of(body: &NamedBody) -> Option<Fineness> {
    match &body.form {
        Form::Meshed(own) if !own.rigid => match &own.body.mesh {
            Mesh::Generated(made) => made.dimensions.fineness(),
            _ => None,
        },
        _ => None,
    }
}

/// What turning at its top speed makes of the natural frequencies of a body.
fn turning(
    text: &mut String,
    joined: &JoinedMachine,
    built: &Built,
    name: &str,
    run: Run,
) -> Result<(), Failure> {
    let Some(place) = joined.bodies.iter().position(|body| body.name.text() == name) else {
        return Ok(());
    };
    let (speed, shaft) = (joined.top_speed(place, run), built.machine.bodies[place].shaft());
    let Some(shaft) = shaft.filter(|_| speed > 0.0) else { return Ok(()) };
    let found = shaft.frequencies_at(speed).map_err(whirl_solver::Error::from)?;
    let of_speed = format!("  with all that it carries, turning at {} rpm", rpm(speed));
    let Some(found) = found else {
        line!(
            text,
            "{of_speed}: beyond a critical speed of the body with its joints and loads held"
        );
        return Ok(());
    };
    let at_rest = shaft.frequencies_at(0.0).map_err(whirl_solver::Error::from)?;
    let listed = |all: &[f64]| -> String {
        let first: Vec<String> = all.iter().take(FIRST).map(|f| format!("{f:.2}")).collect();
        first.join(", ")
    };
    line!(
        text,
        "{of_speed}, in its own frame: {}{} Hz; at rest: {} Hz",
        listed(&found),
        if found.len() > FIRST { ", …" } else { "" },
        listed(&at_rest.unwrap_or_default())
    );
    Ok(())
}

fn rpm(speed: f64) -> f64 {
    rounded(speed * 60.0 / TAU, 10)
}

/// Radius and roundness of a circle.
fn round(circle: Circle) -> String {
    let micrometres = (1e9 * circle.deviation).round() / 1e3;
    format!("{} mm (out of round by {micrometres} µm)", rounded(1e3 * circle.radius, 8))
}

fn of_joint(joint: &Joint, law: &str, c: f64, rings: usize) -> String {
    let (kind, [first, second]) = joint.kind.words();
    let [a, b] = joint.sides.each_ref().map(|side| side.place.text());
    let clearance = match joint.kind {
        JointKind::Stop if c != 0.0 || joint.angle.is_some() => {
            format!(", gap {} µm", rounded(1e6 * c, 10))
        }
        JointKind::Bearing if c != 0.0 => {
            let from = if joint.clearance_from_mesh { " from mesh" } else { "" };
            format!(", c = {} µm{from}", rounded(1e6 * c, 10))
        }
        _ => String::new(),
    };
    let values = match joint.kind {
        JointKind::Bearing | JointKind::Stop => {
            let springs = match joint.bearing.law.source.acts() {
                Acts::Spring if joint.angle.is_none() => {
                    let plural = if rings == 1 { "" } else { "s" };
                    format!(", {rings} ring{plural} of {} springs", joint.bearing.springs)
                }
                _ => String::new(),
            };
            format!("{clearance}{springs}, law {law}")
        }
        JointKind::Bushing | JointKind::Coupling => values(joint),
    };
    let side = match (joint.kind, joint.angle) {
        (JointKind::Stop, Some(0.0)) => " above",
        (JointKind::Stop, Some(_)) => " below",
        (JointKind::Stop, None) => " around",
        _ => "",
    };
    format!("{kind} {}{side}: {first} {a}, {second} {b}{values}", joint.name.text())
}

/// All stiffness and damping of a bushing or a coupling.
fn values(joint: &Joint) -> String {
    let units = match joint.kind {
        JointKind::Coupling => TORSIONAL,
        _ => LINEAR,
    };
    let mut text = match &joint.table {
        Some(file) => format!(", stiffness and damping over the speed in {}", file.text()),
        None => coefficients(&joint.bearing.parameters, "", units, false),
    };
    for own in &joint.others {
        text.push_str(&match own.kind {
            MotionKind::Tilts => coefficients(&own.parameters, "tilting ", TORSIONAL, false),
            MotionKind::Along => coefficients(&own.parameters, "axial ", LINEAR, true),
        });
    }
    text
}

const LINEAR: [&str; 2] = ["N/m", "N s/m"];
const TORSIONAL: [&str; 2] = ["N m/rad", "N m s/rad"];

/// Stiffness and damping; `one`: only those along x of the law, which stand for another direction.
fn coefficients(set: &[SetParameter], called: &str, units: [&str; 2], one: bool) -> String {
    let of = |letter: &str| {
        let own = set.iter().filter(|own| own.name().starts_with(letter));
        let own = own.filter(|own| !one || own.name().ends_with("_xx"));
        let shown = own.map(|own| {
            let value = rounded(own.value(), 10);
            let direction = own.name().split_once('_').map_or("", |(_, direction)| direction);
            let direction = if one { "" } else { direction };
            let space = if direction.is_empty() { "" } else { " " };
            let plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
            let value = if plain { value.to_string() } else { format!("{value:e}") };
            format!("{direction}{space}{value}")
        });
        shown.collect::<Vec<_>>().join(", ")
    };
    format!(", {called}stiffness {} {}, damping {} {}", of("k"), units[0], of("c"), units[1])
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
fn across_axes(body: &PlannedBody) -> Option<[f64; 2]> {
    let PlannedBody::Meshed(meshed) = body else { return None };
    let own = mass_properties(&meshed.mesh).ok()?;
    let ([x, y, z], second) = (own.centre, own.second_moment);
    let about =
        |axis: usize, off: f64| second[axis][axis] + second[2][2] - own.mass * (off * off + z * z);
    Some([about(1, y), about(0, x)])
}

/// The table of masses and inertias, all that bodies carry included.
fn masses(joined: &JoinedMachine, plan: &JoinedPlan) -> Result<String, Failure> {
    let heads = [
        "",
        "turns",
        "mass (kg)",
        "centre z (mm)",
        "polar inertia (kg m²)",
        "transverse inertia (kg m²)",
    ];
    let mut rows = vec![heads.map(str::to_string).to_vec()];
    for (body, own) in joined.bodies.iter().zip(&plan.bodies) {
        let turns = match (&body.rotation, &body.speeds) {
            (_, Some(columns)) => format!("table `{}`", columns.name.text()),
            (Some(Rotation::Free), _) => "free".to_string(),
            (Some(Rotation::Prescribed { speed, .. } | Rotation::Spinning { speed }), _) => {
                format!("{} rpm", rpm(*speed))
            }
            _ => "no".to_string(),
        };
        let [mass, z, polar, transverse] = match own {
            PlannedBody::Rigid(rigid) => {
                let polar = body.turns().then_some(rigid.body.polar_inertia);
                let own = &rigid.body;
                [Some(own.mass), Some(own.centre[2]), polar, own.transverse_inertia]
            }
            PlannedBody::Meshed(meshed) => {
                let own = mass_properties(&meshed.mesh)?;
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
        let shown_across = match across_axes(own) {
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
            turns,
            shown(mass, 1.0),
            shown(z, 1e3),
            shown(polar, 1.0),
            shown_across,
        ]);
    }
    Ok(table(&rows))
}

/// Materials of a mesh, with the cells that have them; none of matrices.
fn materials(text: &mut String, name: &str, mesh: &solid::Mesh) {
    let of = |(place, material): (usize, &solid::Material)| {
        let blocks = mesh.blocks().iter().filter(|block| block.material == place);
        let cells: usize = blocks.map(|block| block.len()).sum();
        format!("{} ({cells} cells)", material.name)
    };
    let all: Vec<String> = mesh.materials().iter().enumerate().map(of).collect();
    if !all.is_empty() {
        line!(text, "materials of {name}: {}", all.join(", "));
    }
}

/// The table of what is reduced.
fn sizes(plan: &JoinedPlan, joined: &JoinedMachine, built: &Built) -> String {
    let heads = ["", "elements", "nodes", "physical dofs", "retained dofs", "modes", "active"];
    let mut rows = vec![heads.map(str::to_string).to_vec()];
    let places = built.machine.places();
    for ((body, own), place) in joined.bodies.iter().zip(&plan.bodies).zip(places) {
        let PlannedBody::Meshed(own) = own else { continue };
        if own.rigid {
            continue;
        }
        let counts = own.counts();
        let mut row = vec![body.name.text().to_string()];
        let numbers = [
            counts.elements,
            counts.nodes,
            counts.physical_dofs,
            counts.retained_dofs,
            counts.modes,
            place.flexible.len(),
        ];
        row.extend(numbers.iter().map(ToString::to_string));
        rows.push(row);
    }
    if rows.len() == 1 { String::new() } else { table(&rows) + "\n" }
}
