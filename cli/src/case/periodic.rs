//! What an analysis of the kind `periodic` says beside the others: how the motion over a cycle is looked for.

use whirl_codegen::diagnostic::{Code, Diagnostic, Located};
use whirl_codegen::document::Table;
use whirl_codegen::document::tree::Place;
use whirl_codegen::units::Quantity;
use whirl_solver::periodic::Method;

use crate::values::level::{Level, in_unit_of};

/// Steps of a cycle that a case may ask for.
pub(super) const STEPS: [usize; 2] = [8, 100_000];
/// Cycles that may be marched, and common periods in one.
pub(super) const MOST_MARCHED: usize = 100_000;
pub(super) const MOST_PERIODS: usize = 64;
/// Harmonics that may be asked for.
pub(super) const MOST_HARMONICS: usize = 1000;
/// Words of `method` and `begin`.
pub(super) const METHODS: &[&str] = &["accelerated", "shooting", "harmonic"];
pub(super) const BEGINNINGS: &[&str] = &["equilibrium", "rest"];
/// Keys that other kinds of analysis have no use for.
const KEYS: [&str; 12] = [
    "steps",
    "method",
    "harmonics",
    "self_excited",
    "near",
    "marched",
    "periods",
    "begin",
    "cycles",
    "vary",
    "points",
    "doublings",
];
/// Cycles in which a motion is looked for, where the case does not say it.
const CYCLES: usize = 400;
/// Points of a branch where the case does not say it, and the most of them.
const POINTS: usize = 200;
pub(super) const MOST_POINTS: usize = 10_000;
/// Doublings of the period, one after the other, at most.
pub(super) const MOST_DOUBLINGS: usize = 5;

/// How a periodic motion is looked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeriodicKeys {
    /// Steps of a cycle; those nearest to the time step of the march if there are none.
    pub(crate) steps: Option<usize>,
    /// By which method; the one that takes less time if there is none.
    pub(crate) method: Option<Method>,
    /// Harmonics that are balanced; as many as are enough if there is none.
    pub(crate) harmonics: Option<usize>,
    /// Whether the machine moves by itself, with a period that nothing tells.
    pub(crate) self_excited: bool,
    /// About which frequency that has (Hz).
    pub(crate) near: Option<f64>,
    /// Cycles that are marched first.
    pub(crate) marched: Option<usize>,
    /// Common periods of loads and speeds in a cycle.
    pub(crate) periods: usize,
    /// Where it begins; in equilibrium if there is one, and at rest otherwise, if there is none.
    pub(crate) begin: Option<Beginning>,
    /// Cycles at most.
    pub(crate) cycles: usize,
    /// The key over which motions are followed, if there is one.
    pub(crate) vary: Option<Varying>,
    /// Points of a branch at most.
    pub(crate) points: usize,
    /// How often the period may double along the branches that are followed.
    pub(crate) doublings: usize,
}

/// A key of the case with the range of its values.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Varying {
    /// As `--vary` takes it.
    pub(crate) key: String,
    /// Where it begins and ends, in its unit.
    pub(crate) ends: [f64; 2],
    /// That of the first end; none of numbers alone.
    pub(crate) unit: Option<String>,
    /// Where it stands.
    place: Place,
}

impl Varying {
    /// `KEY = FROM .. TO`.
    ///
    /// # Errors
    /// It is something else.
    fn read(text: &Located) -> Result<Varying, Box<Diagnostic>> {
        let help = "write a key of the case with a range: `vary = \"body.rotor.speed = 3000 rpm .. 9000 rpm\"`";
        let wrong =
            |message: String| Box::new(text.error_here(Code::BAD_VALUE, message).help(help));
        let own = text.text();
        let parts =
            own.split_once('=').and_then(|(key, range)| Some((key, range.split_once("..")?)));
        let Some((key, (from, to))) = parts else {
            return Err(wrong(format!("`{own}` is no key with a range")));
        };
        let read = |end: &str| {
            Quantity::parse(end.trim())
                .map_err(|error| wrong(format!("`{}`: {}", end.trim(), error.message)))
        };
        let [from, to] = [read(from)?, read(to)?];
        if !to.dimension().fits(from.dimension()) {
            return Err(wrong("the ends of the range are not of one kind".to_owned()));
        }
        let ends = [in_unit_of(&from, &from), in_unit_of(&to, &from)];
        if ends[0] == ends[1] {
            return Err(wrong("both ends of the range are the same".to_owned()));
        }
        let unit = Some(from.unit().text().to_owned()).filter(|unit| unit != "1");
        let place = Place { source: text.source().clone(), span: text.span() };
        Ok(Varying { key: key.trim().to_owned(), ends, unit, place })
    }

    /// A value as it would be written in a case, with all its digits.
    pub(crate) fn literal(&self, value: f64) -> String {
        Level::number(value, self.unit.as_deref(), self.place.clone()).literal
    }
}

/// Where the search begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Beginning {
    /// Where the loads of the start are balanced.
    Equilibrium,
    /// At rest, as the case has its bodies at t = 0.
    Rest,
}

impl Default for PeriodicKeys {
    fn default() -> Self {
        PeriodicKeys {
            steps: None,
            method: None,
            harmonics: None,
            self_excited: false,
            near: None,
            marched: None,
            periods: 1,
            begin: None,
            cycles: CYCLES,
            vary: None,
            points: POINTS,
            doublings: 0,
        }
    }
}

/// Notes keys of a periodic analysis in a table of another kind.
pub(super) fn refuse(table: &Table) {
    for key in KEYS.into_iter().filter(|key| table.has(key)) {
        let message = format!("`{key}` is of an analysis of the kind `periodic`");
        let help = "write `kind = \"periodic\"`, or leave it out";
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        table.pass_over(key);
    }
}

/// Reads what the kind `periodic` asks for.
pub(super) fn read(table: &Table) -> PeriodicKeys {
    let usual = PeriodicKeys::default();
    let place = |key: &str, words: &[&str]| {
        let word = table.optional_word(key)?;
        words.iter().position(|own| *own == word)
    };
    const ALL: [Method; 3] = [Method::Accelerated, Method::Shooting, Method::Harmonic];
    let method = place("method", METHODS).map(|own| ALL[own]);
    let self_excited = table.optional_boolean("self_excited") == Some(true);
    let near = table.quantity("near");
    if table.has("doublings") && !table.has("vary") {
        let message = "`doublings` are those of a branch over a key";
        let help = "give the key as `vary`, or leave it out";
        table.push(table.written("doublings").error_here(Code::BAD_VALUE, message).help(help));
    }
    of_its_own(table, self_excited);
    PeriodicKeys {
        steps: table.optional_count("steps"),
        method,
        harmonics: harmonics(table, method),
        self_excited,
        near,
        marched: table.optional_count("marched"),
        periods: table.optional_count("periods").unwrap_or(usual.periods),
        begin: place("begin", BEGINNINGS).map(|own| [Beginning::Equilibrium, Beginning::Rest][own]),
        cycles: table.optional_count("cycles").unwrap_or(usual.cycles),
        vary: vary(table, method),
        points: table.optional_count("points").unwrap_or(usual.points),
        doublings: table.optional_count("doublings").unwrap_or(usual.doublings),
    }
}

/// Notes keys that a motion with a period of its own has no use for, or alone.
fn of_its_own(table: &Table, self_excited: bool) {
    let note = |key: &str, message: &str, help: &str| {
        if table.gives(key) {
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    };
    if !self_excited {
        let help = "write `self_excited = true`, or leave it out";
        return note("near", "`near` is of a motion that is `self_excited`", help);
    }
    let help = "leave it out: the period is found";
    note("periods", "`periods` are those of loads and speeds", help);
    let help = "leave it out, and look for the motion at `speeds`";
    note("vary", "motions with a period of their own are not followed", help);
    if table.optional_word("method").is_some_and(|own| own != "harmonic") {
        let help = "leave out `method`";
        note("method", "motions with a period of their own are found by their harmonics", help);
    }
}

/// How many harmonics are balanced, where they are.
fn harmonics(table: &Table, method: Option<Method>) -> Option<usize> {
    let key = "harmonics";
    let given = table.optional_count(key)?;
    if method != Some(Method::Harmonic) && table.optional_boolean("self_excited") != Some(true) {
        let message = "`harmonics` are those of the method `harmonic`";
        let help = "write `method = \"harmonic\"`, or leave them out";
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
    }
    Some(given)
}

/// The key that varies; with speeds beside it there would be two.
fn vary(table: &Table, method: Option<Method>) -> Option<Varying> {
    let text = table.optional_string("vary")?;
    if matches!(method, Some(Method::Harmonic | Method::Accelerated)) {
        let message = "motions are followed over `vary` by shooting, by no other method";
        let help = "leave out `method`, or give `speeds` in place of `vary`";
        table.push(table.written("method").error_here(Code::BAD_VALUE, message).help(help));
    }
    if table.has("speeds") {
        let message = "motions are followed over `vary`, or found at each of `speeds`";
        let help = "leave out one of them: a speed varies as `vary = \"body.rotor.speed = 3000 rpm .. 9000 rpm\"`";
        table.push(text.error_here(Code::BAD_VALUE, message).help(help));
    }
    Varying::read(&text).map_err(|error| table.push(*error)).ok()
}
