//! The text of the case.

use std::f64::consts::PI;
use std::fmt::Write;

use whirl_text::rounded;

use super::draft::{Acts, Body, Draft, Joint, Row, Side};
use super::notes::Notes;

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

/// A number with the digits that say something.
fn number(x: f64) -> String {
    let text = format!("{:?}", rounded(x, 12) + 0.0);
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// A length in quotes.
fn length(x: f64) -> String {
    format!("\"{} mm\"", number(1e3 * x))
}

/// A speed in quotes.
fn speed(x: f64) -> String {
    format!("\"{} rpm\"", number(x * 30.0 / PI))
}

/// Text of TOML.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// A comment of one line.
fn remark(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Tables of a case that will be called `stem`: the names of their files, and what is in them.
pub(super) fn files(draft: &Draft, stem: &str) -> Vec<(String, String)> {
    let table = |own: &Joint| match &own.acts {
        Acts::Table(text) => Some((file(stem, &own.name), text.clone())),
        _ => None,
    };
    draft.joints.iter().filter_map(table).collect()
}

fn file(stem: &str, joint: &str) -> String {
    format!("{stem}.{joint}.csv")
}

/// The case.
pub(super) fn case(draft: &Draft, notes: &Notes, stem: &str) -> String {
    let mut text = String::new();
    let version = draft.version.as_deref().map_or(String::new(), |own| format!(" {}", remark(own)));
    line!(
        text,
        "# Made by `whirl new case` from a rotor of ROSS{version}. Its shaft is a solid body here, not a beam: steps, cones and"
    );
    line!(
        text,
        "# layers are as stiff as they are, so that a stepped rotor is a little softer (docs/rotors.md)."
    );
    for own in notes.lines() {
        line!(text, "# - {}", remark(&own));
    }
    line!(text, "title = {}", quoted(&draft.title));
    for (name, own) in &draft.materials {
        line!(text, "\n[material.{name}]");
        line!(text, "youngs_modulus = \"{} Pa\"", number(own.youngs_modulus));
        line!(text, "poissons_ratio = {}", number(own.poissons_ratio));
        line!(text, "density = \"{} kg/m^3\"", number(own.density));
    }
    draft.bodies.iter().for_each(|own| body(&mut text, draft, own));
    for own in &draft.supports {
        line!(text, "\n[body.{}]{}", own.name, called(&own.name, &own.tag));
        line!(text, "turns = \"no\"\nmass = \"{} kg\"", number(own.mass));
        if own.moves_along_z {
            line!(text, "moves_along_z = true");
        }
    }
    draft.joints.iter().for_each(|own| joint(&mut text, own, stem));
    line!(
        text,
        "\n[analysis.modes]                       # at the speed of the case: whirl analyse CASE modes"
    );
    line!(text, "kind = \"modes\"\ncount = 12");
    line!(text, "\n[analysis.campbell]");
    let [from, to] = draft.range.map(speed);
    line!(
        text,
        "kind = \"campbell\"\nspeeds = \"{} .. {}, 31\"",
        from.trim_matches('"'),
        to.trim_matches('"')
    );
    let first = &draft.bodies[0];
    let z = first.carried.first().map_or(first.rows[0].z, |own| own.z);
    line!(text, "\n# For `whirl response` and `whirl run`; a rotor of ROSS has no unbalance.");
    line!(
        text,
        "# [body.{}.unbalance.one]\n# z = {}\n# mass = \"1 g\"\n# radius = \"100 mm\"",
        first.name,
        length(z)
    );
    line!(text, "#\n# [march]\n# time_step = \"2e-5 s\"\n# duration = \"0.5 s\"");
    text
}

/// What the file calls something that the case calls otherwise.
fn called(name: &str, tag: &str) -> String {
    if name == tag { String::new() } else { format!("   # {}", remark(tag)) }
}

fn body(text: &mut String, draft: &Draft, own: &Body) {
    let (at, given) = draft.speed;
    let guessed = if given { "" } else { "   # guessed: the file has no speed" };
    line!(text, "\n[body.{}]", own.name);
    line!(
        text,
        "turns = \"prescribed\"                   # torsion is that of a shaft held where its frame turns"
    );
    line!(text, "speed = {}{guessed}", speed(at));
    line!(text, "modes = 30");
    if own.damping > 0.0 {
        line!(text, "damping = \"{} s\"", number(own.damping));
    }
    if own.held_left {
        line!(text, "axial_restraint = \"LEFT_END\"");
    }
    let usual = own.rows[0].material;
    line!(text, "material = {:?}", draft.materials[usual].0);
    line!(text, "sections = [");
    for row in &own.rows {
        let [first, last] = &row.elements;
        let tags = if first == last || last.is_empty() {
            first.clone()
        } else {
            format!("{first} to {last}")
        };
        let material = if row.material == usual {
            String::new()
        } else {
            format!(", material = {:?}", draft.materials[row.material].0)
        };
        line!(text, "    {{ {}{material} }},   # {}", lengths(row), remark(&tags));
    }
    line!(text, "]");
    for disc in &own.carried {
        let kind = if disc.inertias.is_some() { "disc" } else { "added" };
        line!(text, "\n[body.{}.{kind}.{}]{}", own.name, disc.name, called(&disc.name, &disc.tag));
        line!(text, "z = {}\nmass = \"{} kg\"", length(disc.z), number(disc.mass));
        if let Some([transverse, polar]) = disc.inertias {
            line!(text, "polar_inertia = \"{} kg*m^2\"", number(polar));
            line!(text, "transverse_inertia = \"{} kg*m^2\"", number(transverse));
        }
    }
}

fn lengths(row: &Row) -> String {
    let mut text = format!("z = {}, length = {}", length(row.z), length(row.length));
    for (name, [left, right]) in [("outer", row.outer), ("inner", row.inner)] {
        match left == right {
            true if left == 0.0 => {}
            true => write!(text, ", {name} = {}", length(left)).expect("text can be written"),
            false => {
                let (left, right) = (length(left), length(right));
                write!(text, ", {name}_left = {left}, {name}_right = {right}")
                    .expect("text can be written");
            }
        }
    }
    if let Some(mass_outer) = row.mass_outer {
        write!(text, ", mass_outer = {}", length(mass_outer)).expect("text can be written");
    }
    text
}

fn side(own: &Side) -> String {
    match own.end {
        Some(set) => format!("{{ body = {:?}, sets = [{set:?}] }}", own.body),
        None => format!("{{ body = {:?}, z = {} }}", own.body, length(own.z)),
    }
}

/// Coefficients of a plane that are not zero, as a table; none if all are.
fn plane(own: [f64; 4], unit: &str) -> Option<String> {
    let each = ["xx", "xy", "yx", "yy"].iter().zip(own).filter(|own| own.1 != 0.0);
    let each: Vec<String> =
        each.map(|(key, value)| format!("{key} = \"{} {unit}\"", number(value))).collect();
    (!each.is_empty()).then(|| format!("{{ {} }}", each.join(", ")))
}

fn joint(text: &mut String, own: &Joint, stem: &str) {
    let (kind, sides) = match own.acts {
        Acts::Springs(..) | Acts::Table(_) => ("bushing", ["first", "second"]),
        Acts::Torsion(..) => ("coupling", ["first", "second"]),
        Acts::Law(..) => ("bearing", ["journal", "bore"]),
    };
    line!(text, "\n[joint.{}]{}\nkind = {kind:?}", own.name, called(&own.name, &own.tag));
    line!(text, "{} = {}", sides[0], side(&own.first));
    if let Some(other) = &own.second {
        line!(text, "{} = {}", sides[1], side(other));
    }
    match &own.acts {
        Acts::Springs(stiffness, damping) => {
            for (key, value) in
                [("stiffness", plane(*stiffness, "N/m")), ("damping", plane(*damping, "N*s/m"))]
            {
                if let Some(value) = value {
                    line!(text, "{key} = {value}");
                }
            }
        }
        Acts::Table(_) => line!(text, "table = {}", quoted(&file(stem, &own.name))),
        Acts::Torsion(stiffness, damping) => {
            line!(text, "stiffness = \"{} N*m/rad\"", number(*stiffness));
            if *damping != 0.0 {
                line!(text, "damping = \"{} N*m*s/rad\"", number(*damping));
            }
        }
        Acts::Law(stiffness, damping) => law(text, *stiffness, *damping),
    }
    if own.along[0] != 0.0 && !matches!(own.acts, Acts::Law(..)) {
        line!(text, "axial_stiffness = \"{} N/m\"", number(own.along[0]));
        if own.along[1] != 0.0 {
            line!(text, "axial_damping = \"{} N*s/m\"", number(own.along[1]));
        }
    }
}

/// The law of springs between two bodies that turn.
fn law(text: &mut String, stiffness: [f64; 3], damping: [f64; 3]) {
    let mut all = Vec::new();
    for (letter, units, values) in
        [("k", ["N/m", "N*m/rad"], stiffness), ("c", ["N*s/m", "N*m*s/rad"], damping)]
    {
        let each = [("x", 0), ("y", 0), ("z", 1), ("ax", 2), ("ay", 2)];
        for (direction, which) in each.into_iter().filter(|own| values[own.1] != 0.0) {
            let unit = units[usize::from(which == 2)];
            all.push(format!(
                "{letter}_{direction}_{direction} = \"{} {unit}\"",
                number(values[which])
            ));
        }
    }
    line!(text, "law = \"linear-5x5\"\nparameters = {{ {} }}", all.join(", "));
}
