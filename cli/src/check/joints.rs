//! What `whirl check` says of joints.

use std::fmt::Write;

use whirl_codegen::kinds::law::Acts;
use whirl_solver::bearing::MotionKind;
use whirl_solver::mesh::measure::Circle;
use whirl_text::rounded;

use crate::case::{self, JoinedMachine, Joint, JointKind, LawSource, SetParameter};
use crate::machine::JoinedPlan;

/// Each joint with its law, clearance and place, or its coefficients.
pub(super) fn say(text: &mut String, joined: &JoinedMachine, plan: &JoinedPlan) {
    if !joined.joints.is_empty() {
        line!(text, "\nJoints");
    }
    for (first, more) in all(joined, plan) {
        line!(text, "{first}");
        more.iter().for_each(|own| line!(text, "  {own}"));
    }
}

/// The same: a line a joint, and what is to be said beside it.
pub(super) fn all(joined: &JoinedMachine, plan: &JoinedPlan) -> Vec<(String, Vec<String>)> {
    let of = |(place, (joint, law)): (usize, (&Joint, &LawSource))| {
        let (c, circles) = plan.clearance(place);
        let mut more = Vec::new();
        if let Some([journal, bore]) = circles {
            more.push(format!(
                "measured on the meshes: journal of radius {}, bore of radius {}",
                round(journal),
                round(bore)
            ));
        }
        // A bushing and gears tell of their coefficients themselves.
        let of_law = matches!(joint.kind, JointKind::Bearing | JointKind::Stop);
        let told = of_law.then(|| law.told_of_file()).flatten();
        more.extend(told.map(|own| format!("from the law: {own}")));
        more.extend(law.film().into_iter().flat_map(|own| own.described()));
        more.extend(plan.pressures(place).map(|count| {
            let bore = joint.sides[1].place.text();
            match count {
                0 => format!(
                    "the bore gives way under the film by the modes of {bore} alone: \
                     `static_correction` keeps no answers to its pressure"
                ),
                _ => format!("the bore gives way under the film: {bore} keeps its answers to {count} pressures"),
            }
        }));
        let turns = |body: usize| joined.bodies[body].turns();
        let turning = joint.sides[1].body.filter(|body| turns(*body));
        if let Some(bore) = turning.filter(|_| law.damps_against_bore()) {
            more.push(format!(
                "its damping turns with {}, as its law takes rates without omega: rotating damping, which destabilises \
                 above a critical speed",
                joined.bodies[bore].name.text()
            ));
        }
        more.extend(joint.sensor.as_ref().map(|own| {
            let [seen, base] = &own.sides;
            let at = |side: &crate::case::JointSide| match (side.sets.first(), side.z) {
                (Some(set), _) => set.text().trim_start_matches("bore at ").to_owned(),
                (None, z) => format!("z = {} mm", rounded(1e3 * z.unwrap_or(0.0), 6)),
            };
            let (first, second) = (seen.place.text(), base.place.text());
            match base.body {
                Some(_) => format!(
                    "its sensor sees {first} at {}, from {second} at {}",
                    at(seen),
                    at(base)
                ),
                None => format!("its sensor sees {first} at {}", at(seen)),
            }
        }));
        (of_joint((joint, joined), &law.name(), c, &plan.stations(place)), more)
    };
    joined.joints.iter().zip(&plan.laws).enumerate().map(of).collect()
}

fn of_joint(
    (joint, joined): (&Joint, &JoinedMachine),
    law: &str,
    c: f64,
    stations: &[f64],
) -> String {
    let (kind, [first, second]) = joint.kind.words();
    let [a, b] = joint.sides.each_ref().map(|side| side.place.text());
    let values = match joint.kind {
        JointKind::Bearing | JointKind::Stop => {
            let clearance = match c {
                0.0 => String::new(),
                _ => {
                    let from = if joint.clearance_from_mesh { " from mesh" } else { "" };
                    format!(", c = {} µm{from}", rounded(1e6 * c, 10))
                }
            };
            format!(", law {law}{clearance}{}", planes(joint, stations))
        }
        JointKind::Bushing | JointKind::Coupling => {
            format!("{}{}", values(joint), at_z(joint, stations))
        }
        JointKind::Gear => teeth(joint, joined),
    };
    let at =
        joint.sides.iter().find_map(|side| side.at.as_ref()).map_or(String::new(), |(at, _)| {
            let [x, y] = at.map(|own| rounded(1e3 * own, 6));
            format!(", at x = {x}, y = {y} mm")
        });
    format!("{kind} {}: {first} {a}, {second} {b}{at}{values}", joint.name.text())
}

/// Its rings of springs, or the planes in which a law of a ring acts.
fn planes(joint: &Joint, stations: &[f64]) -> String {
    let rings = match joint.bearing.law.source.acts() {
        Acts::Spring if joint.angle.is_none() => {
            let plural = if stations.len() == 1 { "" } else { "s" };
            format!(", {} ring{plural} of {} springs", stations.len(), joint.bearing.springs)
        }
        _ => String::new(),
    };
    let z = at_z(joint, stations);
    match rings.is_empty() {
        true => z,
        false => format!("{rings}{}", z.replacen(',', " at", 1)),
    }
}

/// Where it stands along z, if that is anywhere: a rigid body that does not tilt is alike at any z.
fn at_z(joint: &Joint, stations: &[f64]) -> String {
    let placed = |side: &crate::case::JointSide| !side.sets.is_empty() || side.z.is_some();
    if !joint.sides.iter().any(placed) && joint.bearing.stations.is_empty() {
        return String::new();
    }
    let mut z: Vec<String> = stations.iter().map(|z| rounded(1e3 * z, 6).to_string()).collect();
    z.dedup();
    format!(", z = {} mm", z.join(", "))
}

/// Ratio, radii and stiffness of gears.
fn teeth(joint: &Joint, joined: &JoinedMachine) -> String {
    let (Some(gears), [Some(first), Some(second)]) =
        (&joint.gears, joint.sides.each_ref().map(|side| side.body))
    else {
        return String::new();
    };
    let [x, y] = case::axes_apart([first, second].map(|body| &joined.bodies[body]));
    let [own, other] = gears.pitch_radii(x.hypot(y)).map(|radius| rounded(1e3 * radius, 6));
    let of = |name: &str| {
        let found = joint.bearing.parameters.iter().find(|own| own.name() == name);
        rounded(found.map_or(0.0, SetParameter::value), 10)
    };
    let backlash = match gears.backlash {
        true => format!(", backlash {} µm", rounded(1e6 * of("b"), 6)),
        false => String::new(),
    };
    format!(
        ", {}speed ratio {}, pitch radii {own} and {other} mm, pressure angle {}°, stiffness {:e} N/m, damping {} N s/m{backlash}",
        if gears.internal { "internal, " } else { "" },
        rounded(gears.ratio(), 8),
        rounded(gears.pressure_angle.to_degrees(), 6),
        of("k"),
        of("c")
    )
}

/// All stiffness and damping of a bushing or a coupling.
fn values(joint: &Joint) -> String {
    let units = match joint.kind {
        JointKind::Coupling => TORSIONAL,
        _ => LINEAR,
    };
    let mut text = match &joint.table {
        Some(file) if joint.bearing.law.source.over_frequency().is_some() => format!(
            ", stiffness and damping over speed and frequency in {}, for linear analyses alone",
            file.text()
        ),
        Some(file) => format!(", stiffness and damping over speed in {}", file.text()),
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
        // What couples both directions is seldom there.
        let own = own.filter(|own| own.value() != 0.0 || is_diagonal(own.name()));
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

/// Whether a parameter acts along the motion that it is of.
fn is_diagonal(name: &str) -> bool {
    let direction = name.split_once('_').map_or("", |(_, direction)| direction);
    matches!(direction, "" | "xx" | "yy")
}

/// Radius and roundness of a circle.
fn round(circle: Circle) -> String {
    let micrometres = (1e9 * circle.deviation).round() / 1e3;
    format!("{} mm (out of round by {micrometres} µm)", rounded(1e3 * circle.radius, 8))
}
