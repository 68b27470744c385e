//! A case from a rotor that the open program ROSS saved: `rotor.save("rotor.toml")` or `rotor.save("rotor.json")`.
//!
//! A tree of values ([`value`], [`json`]) becomes elements ([`elements`]), these shafts along z ([`layout`]), bodies and joints,
//! and a text.

mod bodies;
mod draft;
mod elements;
mod fields;
mod joints;
mod json;
mod layout;
mod model;
mod names;
mod notes;
mod soft;
mod text;
mod value;
mod webs;

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source};

use self::draft::Draft;
use self::fields::File;
use self::layout::Shaft;
use self::model::Model;
use self::notes::Notes;
use self::value::Value;
use crate::case::CaseText;
use crate::errors::Failure;
use crate::machine;

/// A case from a rotor.
#[derive(Debug)]
pub struct FromRotor {
    /// The text of the case.
    pub text: String,
    /// Files beside it by their names, with their texts.
    pub files: Vec<(String, String)>,
    /// What differs from the rotor or has no counterpart, a line each; the case has them as comments.
    pub notes: Vec<String>,
}

/// A shaft is at least and at most so long (m).
const LENGTHS: [f64; 2] = [1e-4, 200.0];
/// Its diameters are at most so large (m).
const LARGEST: f64 = 20.0;
/// The speed of a case where nothing says one (rad/s).
const USUAL_SPEED: f64 = 100.0 * PI;

/// The case that says what a file of ROSS does. `stem`: what it and its files will be called.
///
/// # Errors
/// A file that is none of a rotor, and everything in it that no rotor has.
pub(super) fn case(source: &Arc<Source>, stem: &str) -> Result<FromRotor, Failure> {
    let root = tree(source)?;
    let file = File::new(source.clone());
    let mut notes = Notes::default();
    let mut model = elements::read(&file, &root, &mut notes);
    if model.shaft.is_empty() && file.errors.borrow().is_empty() {
        return Err(Diagnostics::from(no_rotor(source, &root)).into());
    }
    soft::split(&file, &mut model, &mut notes);
    let shafts = layout::shafts(&file, &model, &mut notes);
    whole(&file, &model, &shafts);
    done(&file)?;
    if let Some(version) = model.version.as_deref().filter(|own| !own.starts_with("2.")) {
        notes.add(format!("written by ROSS {version}, and read as if by 2.3: check the numbers"));
    }
    let (mut bodies, materials) = bodies::bodies(&file, (&model, &shafts), &mut notes);
    let (speed, range) = speeds(&model);
    let (supports, joints) =
        joints::joints(&file, (&model, &shafts), &mut bodies, (speed.0, &mut notes));
    done(&file)?;
    if joints.iter().any(|own| matches!(own.acts, draft::Acts::Table(_))) {
        notes.add(
            "coefficients over the speed: between the rows monotone cubics, where ROSS has splines; beyond them constant, with a \
             warning, where ROSS goes on with its splines",
        );
    }
    if !model.couplings.is_empty() {
        notes.add(
            "couplings have no length, as in the equations of ROSS: what they join is at one z",
        );
    }
    if shafts.len() > 1 {
        notes.add(
            "all shafts turn at one speed, as in ROSS: change `speed` of the one or the other",
        );
    }
    let title =
        source.path.file_stem().map_or(stem.into(), |own| own.to_string_lossy().into_owned());
    let version = model.version.clone();
    let draft = Draft { title, version, materials, bodies, supports, joints, speed, range };
    let made = FromRotor {
        text: text::case(&draft, &notes, stem),
        files: text::files(&draft, stem),
        notes: notes.lines().collect(),
    };
    check(source, &made, stem)?;
    Ok(made)
}

/// The tree of a file, which is JSON or TOML.
fn tree(source: &Arc<Source>) -> Result<Value, Diagnostics> {
    let text = source.text.trim_start_matches('\u{feff}');
    let skipped = source.text.len() - text.len();
    // What is called `.json` may be TOML all the same.
    let named = source.path.extension().is_some_and(|own| own.eq_ignore_ascii_case("json"));
    let (of_json, tree) = match text.trim_start().starts_with('{') {
        true => (true, json::of_json(&source.text)),
        false => match value::of_toml(text) {
            Err(_) if named => (true, json::of_json(&source.text)),
            tree => (false, tree),
        },
    };
    tree.map_err(|(place, what)| {
        let skipped = if of_json { 0 } else { skipped };
        let place = place.start + skipped..place.end + skipped;
        let kind = if of_json { "JSON" } else { "TOML" };
        let help = "the file may be cut off or edited: save the rotor again with `rotor.save(…)`";
        fields::error(source, place, format!("this is no valid {kind}: {what}"), help).into()
    })
}

/// The error of a file without shaft elements.
fn no_rotor(source: &Arc<Source>, root: &Value) -> Diagnostic {
    let has = |key: &str| root.entries().iter().any(|own| own.name == key);
    let case = ["body", "shaft", "march", "joint", "include"].into_iter().any(has);
    let what = format!("`{}` is no rotor of ROSS: it has no shaft element", source.path.display());
    let help = match case {
        true => "it looks like a case of whirl: run it, or check it with `whirl check`",
        false => {
            "in Python `rotor.save(\"rotor.toml\")` or `rotor.save(\"rotor.json\")` writes one"
        }
    };
    fields::error(source, None, what, help)
}

/// Notes what is wrong with the whole rotor: its size, and that nothing holds it.
fn whole(file: &File, model: &Model, shafts: &[Shaft]) {
    let ends = shafts.iter().flat_map(|own| own.nodes.values().copied());
    let (low, high) = ends.fold((0.0, 0.0), |own: (f64, f64), z| (own.0.min(z), own.1.max(z)));
    let length = high - low;
    let outer = model.shaft.iter().flat_map(|own| own.outer).fold(0.0, f64::max);
    if !(LENGTHS[0]..=LENGTHS[1]).contains(&length) || outer > LARGEST {
        let what = format!("the rotor is {length:.6} m long and {outer:.6} m in diameter");
        let help = "ROSS takes lengths in m: give those in mm as `Q_(250, \"mm\")` and save the rotor again";
        file.wrong(model.shaft.first().map(|own| own.named.place.clone()), what, help);
    }
    if model.bearings.is_empty() {
        let help = "the file may be cut off; a rotor that hangs free has no counterpart: add bearings of little stiffness";
        file.wrong(None, "the rotor has no bearings: nothing holds it", help);
    }
}

/// The speed of the case, with whether the file gives it, and the speeds of its diagram (rad/s).
fn speeds(model: &Model) -> ((f64, bool), [f64; 2]) {
    let [_, highest, rated] = model.speeds.map(|own| own.filter(|own| *own > 0.0));
    let tables = model
        .bearings
        .iter()
        .filter(|own| own.speeds.len() > 1 && (0..8).any(|which| !own.is_constant(which)));
    let ends = tables.map(|own| [own.speeds[0], own.speeds[own.speeds.len() - 1]]);
    let rows = ends.reduce(|a, b| [f64::max(a[0], b[0]), f64::min(a[1], b[1])]);
    let of_rows = rows.filter(|own| own[0] < own[1]);
    let given = rated.or(highest);
    let speed = given.or(of_rows.map(|own| own[1])).unwrap_or(USUAL_SPEED);
    let to = highest.unwrap_or(0.0).max(1.25 * speed);
    let range = match of_rows {
        Some([first, last]) => [first, if to > first { to.min(last) } else { last }],
        None => [0.0, to],
    };
    ((speed, given.is_some() || of_rows.is_some()), range)
}

fn done(file: &File) -> Result<(), Diagnostics> {
    file.errors.take().into_result(())
}

/// Reads the case that was made, as nothing is written that cannot be read.
fn check(source: &Arc<Source>, made: &FromRotor, stem: &str) -> Result<(), Failure> {
    let mut text = CaseText::new(stem, Path::new(""), made.text.as_str());
    for (name, own) in &made.files {
        text = text.with_file(name, own.as_str());
    }
    let read = || {
        let case = machine::read_text(&text, &mut Vec::new())?;
        machine::plan(&case, &mut Vec::new())
    };
    read().map(drop).map_err(|failure| {
        let what = match &failure {
            Failure::Input(all) => {
                all.iter().next().map_or(String::new(), |own| own.message.clone())
            }
            other => other.to_string(),
        };
        let message = format!("this rotor cannot be a case: {what}");
        let error = Diagnostic::new(source, Code::BAD_VALUE, None, message);
        Failure::Input(error.help("change this in Python and save the rotor again").into())
    })
}
