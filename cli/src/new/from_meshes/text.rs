//! The text of a case from two meshes, and what is said of it.

use std::collections::BTreeMap;
use std::fmt::Write;

use whirl_solver::mesh::Cylinder;
use whirl_text::rounded;

use super::bearings::Meeting;
use super::draft::{Draft, Held, Part};
use crate::mesh_file::mm;

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

/// The set of the faces that hold a support, as the case calls it.
const FOOT: &str = "FOOT";

/// A length of a case, with the digits that sets by place need.
fn length(x: f64) -> String {
    format!("\"{} mm\"", rounded(1e3 * x, 10) + 0.0)
}

/// Text of TOML.
fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// The case.
pub(super) fn case(draft: &Draft) -> String {
    let Draft { shaft, support, .. } = draft;
    let mut text = String::new();
    line!(
        text,
        "# Made by `whirl new case` from two meshes: bearings are where cylinders of both meet. Check the lines that"
    );
    line!(
        text,
        "# end in `guessed`; fill in or delete those that begin with `#`. `whirl list` names the laws."
    );
    line!(text, "title = {}", quoted(&format!("{} in {}", shaft.name, support.name)));
    line!(text, "gravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]   # x is up: guessed");
    if shaft.lacks_material() || support.lacks_material() {
        line!(
            text,
            "\n[material.steel]                       # of cells without a material in their mesh: guessed"
        );
        line!(
            text,
            "youngs_modulus = \"206 GPa\"\npoissons_ratio = 0.3\ndensity = \"7850 kg/m^3\""
        );
    }
    turning(&mut text, draft);
    standing(&mut text, draft);
    for (k, own) in draft.meetings.iter().enumerate() {
        let [journal, bore] = &own.names;
        line!(text, "\n[joint.bearing_{}]", k + 1);
        line!(text, "kind = \"bearing\"");
        line!(text, "journal = {{ body = {:?}, surface = {journal:?} }}", shaft.name);
        line!(text, "bore = {{ body = {:?}, surface = {bore:?} }}", support.name);
        line!(text, "law = \"hu2003-nonlinear\"               # springs of an oil film: guessed");
        line!(text, "radial_clearance = \"from mesh\"         # or such as \"35 um\"");
        line!(text, "springs = 24");
    }
    line!(text, "\n# [loads.side]                          # as many as there are");
    line!(
        text,
        "# body = {:?}\n# sets = [{:?}]\n# spread = \"mean\"",
        shaft.name,
        draft.meetings[0].names[0]
    );
    line!(text, "# force = [\"100 N\", \"0 N\", \"0 N\"]");
    line!(text, "\n[start]\nkind = \"equilibrium\"                 # or \"rest\"");
    line!(
        text,
        "\n[march]\ntime_step = \"1e-5 s\"                   # 2000 steps a revolution: guessed"
    );
    line!(text, "duration = \"0.2 s\"");
    text
}

/// The table of the shaft.
fn turning(text: &mut String, draft: &Draft) {
    let first = &draft.meetings[0].names[0];
    let name = &draft.shaft.name;
    body(
        text,
        &draft.shaft,
        draft.axis,
        "turns = \"prescribed\"\nspeed = \"3000 rpm\"                     # guessed",
    );
    line!(text, "axial_restraint = {first:?}");
    sets(text, name, &draft.meetings, 0);
    let [from, to] = draft.meetings[0].z();
    line!(
        text,
        "\n# [body.{name}.unbalance.one]\n# mass = \"1 g\"\n# radius = {}\n# z = {}",
        length(draft.meetings[0].journal.radius),
        length(0.5 * (from + to))
    );
}

/// The table of the support.
fn standing(text: &mut String, draft: &Draft) {
    let name = &draft.support.name;
    body(text, &draft.support, draft.axis, "turns = \"no\"");
    line!(
        text,
        "static_correction = true               # its bores are as compliant as those of the mesh"
    );
    match &draft.held {
        Some(Held::Set(set)) => {
            line!(text, "held = [{}]                        # by its name: guessed", quoted(set))
        }
        Some(Held::Plane(..)) => line!(text, "held = [{FOOT:?}]                        # guessed"),
        None => line!(
            text,
            "# held = [\"SET\"]                        # the node sets at which it is fixed"
        ),
    }
    if let Some(Held::Plane(across, at)) = draft.held {
        let place = length(at);
        match across {
            0 => line!(
                text,
                "\n[body.{name}.sets.{FOOT}]                # faces at its lower side\nplane = {place}\nacross = \"x\""
            ),
            _ => line!(
                text,
                "\n[body.{name}.sets.{FOOT}]                # faces across the axis\nplane = {place}"
            ),
        }
    }
    sets(text, name, &draft.meetings, 1);
}

/// The keys that both bodies have.
fn body(text: &mut String, part: &Part, axis: [f64; 2], turns: &str) {
    line!(text, "\n[body.{}]\n{turns}\nmesh = {}", part.name, quoted(&part.path));
    if let Some(units) = &part.opened.units {
        line!(text, "units = {}", quoted(units));
    }
    if axis != [0.0; 2] {
        line!(text, "axis = [{}, {}]", length(axis[0]), length(axis[1]));
    }
    if part.lacks_material() {
        line!(text, "material = \"steel\"");
    }
    line!(text, "modes = 20\ndamping = \"1e-5 s\"                     # C = 1e-5 s K: guessed");
}

/// The sets of the journals, or of the bores, each once.
fn sets(text: &mut String, body: &str, meetings: &[Meeting], side: usize) {
    let mut all: BTreeMap<&str, &Cylinder> = BTreeMap::new();
    for own in meetings {
        all.insert(&own.names[side], [&own.journal, &own.bore][side]);
    }
    for (name, own) in all {
        line!(text, "\n[body.{body}.sets.{name}]\nradius = {}", length(own.radius));
        line!(text, "z = [{}, {}]", length(own.z[0]), length(own.z[1]));
    }
}

/// What was found, guessed and left open, for the terminal.
pub(super) fn decided(draft: &Draft) -> String {
    let Draft { shaft, support, .. } = draft;
    let mut text = String::new();
    for (k, own) in draft.meetings.iter().enumerate() {
        let ([journal, bore], [from, to]) = (&own.names, own.z());
        line!(
            text,
            "bearing_{}: {journal} of {} (radius {} mm) in {bore} of {} ({} mm), z {} to {} mm",
            k + 1,
            shaft.name,
            mm(own.journal.radius),
            support.name,
            mm(own.bore.radius),
            mm(from),
            mm(to)
        );
    }
    draft.left.iter().for_each(|why| line!(text, "no bearing: {why}"));
    for part in [shaft, support] {
        match &part.opened.units {
            Some(units) if draft.units_guessed => {
                line!(text, "guessed: {} is in \"{units}\", by its size", part.path)
            }
            None if draft.units_guessed => {
                line!(text, "guessed: {} is in m, N, kg, by its size", part.path)
            }
            _ => {}
        }
        if part.lacks_material() {
            line!(text, "guessed: {} is of steel, where its mesh has no material", part.name);
        }
    }
    match &draft.held {
        Some(Held::Set(set)) => line!(text, "guessed: {} is held at its set {set}", support.name),
        Some(Held::Plane(across, at)) => {
            let what = if *across == 0 { "lower side, x" } else { "end, z" };
            line!(
                text,
                "guessed: {} is held at its {what} = {} mm ({FOOT})",
                support.name,
                mm(*at)
            );
        }
        None => {
            line!(text, "to fill in: `held` of {}, the sets at which it is fixed", support.name)
        }
    }
    line!(text, "guessed: speed, damping, law of the bearings, gravity along -x, time step");
    text
}
