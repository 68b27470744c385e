//! Motions of whole bodies, and films, for other programs: `[fields]`.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located};
use whirl_codegen::document::Table;

use super::joined_machine::JoinedMachine;
use super::named_body::Form;
use super::names;
use super::rotor::Mesh;

/// What is written of whole bodies and of films.
#[derive(Debug, Clone)]
pub(crate) struct Fields {
    /// Bodies, by their places in the machine.
    pub(crate) bodies: Vec<usize>,
    /// Joints whose films are written, by their places in the machine.
    pub(crate) films: Vec<usize>,
    /// Frames of the last cycle.
    pub(crate) frames: usize,
    /// Times of further frames (s), from t = 0 of tables and loads on, and where the case gives them.
    pub(crate) times: Vec<f64>,
    times_place: Located,
    /// Whether stresses are written, too.
    pub(crate) stresses: bool,
}

/// Frames of the last cycle, where a case says neither frames nor times.
const FRAMES: usize = 24;

pub(super) fn read(file: &Table, machine: Option<&JoinedMachine>) -> Option<Fields> {
    file.optional_table("fields")?.read(|table| {
        let (frames, times) = (table.optional_count("frames"), table.quantities("times"));
        let stresses = table.optional_boolean("stresses").unwrap_or(false);
        let named = ["bodies", "films"].map(|key| table.texts(key));
        // Without a machine its names are not known; what is wrong with it is said.
        let [bodies, films] = wanted(table, machine?, &named);
        let usual = if times.is_empty() { FRAMES } else { 0 };
        let times_place = table.written("times");
        let frames = frames.unwrap_or(usual);
        Some(Fields { bodies, films, frames, times, times_place, stresses })
    })
}

impl Fields {
    /// Whether a run from one time to another (s) reaches all times of frames.
    ///
    /// # Errors
    /// It does not.
    pub(crate) fn check_times(&self, run: [f64; 2]) -> Result<(), Diagnostics> {
        self.times_beyond(run).map_or(Ok(()), |error| Err(error.into()))
    }

    /// Counts times from `by` s later.
    pub(crate) fn shift(&mut self, by: f64) {
        self.times.iter_mut().for_each(|time| *time += by);
    }

    /// Times that a run from one time to another (s) does not reach.
    pub(crate) fn times_beyond(&self, [begun, end]: [f64; 2]) -> Option<Diagnostic> {
        let rounding = 1e-9 * end.abs();
        let within = begun - rounding..=end + rounding;
        let beyond = self.times.iter().find(|time| !within.contains(time))?;
        let shown = |time: f64| whirl_text::shown(time, 8, 1e-4..1e6);
        let message = format!(
            "`times` has {} s, and the run is from {} s to {} s",
            shown(*beyond),
            shown(begun),
            shown(end)
        );
        let help = "give times within the run; they count from t = 0, like those of tables, also in a run that \
             continues another one";
        Some(self.times_place.error_here(Code::BAD_VALUE, message).help(help))
    }
}

/// What a table names of what there is.
struct Named<'a> {
    key: &'static str,
    /// What it is, in words: "body `b` with a mesh", and more of them.
    words: [&'static str; 3],
    /// Names, and whether they have what is written.
    known: Vec<(&'a str, bool)>,
}

impl Named<'_> {
    /// Places of all that have what is written.
    fn all(&self) -> Vec<usize> {
        (0..self.known.len()).filter(|&place| self.known[place].1).collect()
    }

    /// Those that the table names, or all.
    fn wanted(&self, table: &Table, named: &[Located]) -> Vec<usize> {
        let all = self.all();
        if named.is_empty() {
            return all;
        }
        let names: Vec<&str> = all.iter().map(|&place| self.known[place].0).collect();
        let place = |name: &Located| {
            let [one, with, many] = self.words;
            let message = format!("there is no {one} `{}` with {with}", name.text());
            let help = || match names.is_empty() {
                true => format!("no {one} has one: leave `{}` out", self.key),
                false => format!("{many}: {}", names.join(", ")),
            };
            names::place(table, name, &names, message, help).map(|found| all[found])
        };
        named.iter().filter_map(place).collect()
    }
}

/// The bodies and the joints that the table names, or all that have a mesh or a film.
fn wanted(table: &Table, machine: &JoinedMachine, named: &[Vec<Located>; 2]) -> [Vec<usize>; 2] {
    // Names, and whether they have a mesh.
    let meshed = |form: &Form| match form {
        // Matrices have no cells to be written.
        Form::Meshed(own) => !matches!(own.body.mesh, Mesh::Matrices(_)),
        Form::Rigid(_) => false,
    };
    let bodies = machine.bodies.iter().map(|body| (body.name.text(), meshed(&body.form)));
    let joints = machine.joints.iter();
    let films = joints.map(|own| (own.name.text(), own.bearing.law.source.film().is_some()));
    let bodies = Named {
        key: "bodies",
        words: ["body", "a mesh", "bodies with a mesh"],
        known: bodies.collect(),
    };
    let films = Named {
        key: "films",
        words: ["joint", "a film", "joints with a film"],
        known: films.collect(),
    };
    if bodies.all().is_empty() && films.all().is_empty() {
        let message =
            "no body of this case has a mesh whose motion could be written, and no joint a film";
        let help = "take `[fields]` out, and ask for points by `[output.NAME]`";
        table.push(table.heading().error(Code::BAD_VALUE, message.to_owned()).help(help));
        return [Vec::new(), Vec::new()];
    }
    [bodies.wanted(table, &named[0]), films.wanted(table, &named[1])]
}
