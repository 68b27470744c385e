//! The tables `[analysis.NAME]`: small motions about the state in which the machine stands at constant speeds, and motions that
//! repeat themselves.

use clap::ValueEnum;
use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, suggest};
use whirl_codegen::document::Table;
use whirl_codegen::document::tree::Place;
use whirl_codegen::units::{Dimension, Quantity};

use super::machine::MOST_SPEED;
use super::{JoinedMachine, Lateral, PeriodicKeys, lateral, names, periodic};
use crate::values::range::{Range, is_range};

/// Values of an analysis at most: more would fill the memory.
const MOST: usize = 10_000;
/// Speeds of a range that does not say how many.
const SPEEDS: usize = 31;
/// Modes where it is not asked how many.
pub(crate) const MODES: usize = 10;
/// Orders of every shaft that excite torsion, and multiples of the frequency of teeth.
const TORSION: [f64; 2] = [1.0, 2.0];
const MESH_ORDERS: [f64; 1] = [1.0];
/// API 684, and the standards of machines that refer to it: torsional natural frequencies are 10 % off all excitations.
const MARGIN: f64 = 0.1;
/// Planes along a body.
const STATIONS: usize = 41;

/// Keys that one kind alone takes.
const OF_ONE_KIND: [(&str, AnalysisKind); 6] = [
    ("margin", AnalysisKind::Torsion),
    ("operation", AnalysisKind::Torsion),
    ("mesh_orders", AnalysisKind::Torsion),
    ("stiffness", AnalysisKind::Map),
    ("stations", AnalysisKind::Forces),
    ("format", AnalysisKind::Matrices),
];

/// An analysis under its name.
#[derive(Debug, Clone)]
pub(crate) struct Analysis {
    /// Its name.
    pub(crate) name: String,
    /// Its table; none of one that the command line describes.
    pub(crate) table: Option<Located>,
    /// What it finds.
    pub(crate) kind: AnalysisKind,
    /// The body whose speed it is over, by its place, where the case says it.
    pub(crate) of: Option<usize>,
    /// Speeds of that (rad/s), ascending; those of the case where there are none.
    pub(crate) speeds: Vec<f64>,
    /// By body the ratio of its speed to that, where the case says it.
    pub(crate) ratios: Vec<Option<f64>>,
    /// How many modes, the slowest ones.
    pub(crate) count: usize,
    /// Orders of critical speeds, none for once a turn of every body; of torsion, orders of every shaft that excite it.
    pub(crate) orders: Vec<f64>,
    /// Multiples of the frequency of teeth that excite torsion.
    pub(crate) mesh_orders: Vec<f64>,
    /// Speeds of operation (rad/s), ascending, from which torsion keeps off; those of the case where there are none.
    pub(crate) operation: Vec<f64>,
    /// Share by which it does.
    pub(crate) margin: f64,
    /// Stiffnesses of the joints of a map (N/m), ascending; the usual ones where there are none.
    pub(crate) stiffness: Vec<f64>,
    /// Planes along each body at which forces are wanted.
    pub(crate) stations: usize,
    /// Of a response: the angle from x to the first of two probes at a right angle (rad), where figures show what they read.
    pub(crate) probe_angle: Option<f64>,
    /// Of matrices.
    pub(crate) format: MatrixFormat,
    /// What standards ask for, of a lateral analysis.
    pub(crate) lateral: Option<Box<Lateral>>,
    /// Of a periodic motion.
    pub(crate) periodic: PeriodicKeys,
}

/// What an analysis finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AnalysisKind {
    /// Modes at one speed or a few.
    Modes,
    /// Modes followed over speeds, with critical speeds and thresholds of stability.
    Campbell,
    /// Response to unbalance over speeds.
    Response,
    /// Stiffness and damping of joints over speeds.
    Coefficients,
    /// The least stable motion over speeds, with thresholds.
    Stability,
    /// Undamped critical speeds over the stiffness of the joints.
    Map,
    /// Matrices of small motions at one speed or a few.
    Matrices,
    /// Torsional modes of a train, with what excites them.
    Torsion,
    /// Forces and moments along bodies.
    Forces,
    /// What standards ask of response and stability.
    Lateral,
    /// A motion that repeats itself, with its multipliers.
    Periodic,
}

impl Analysis {
    /// One that asks for nothing special.
    pub(crate) fn of_kind(kind: AnalysisKind) -> Analysis {
        Analysis {
            name: kind.word().to_owned(),
            table: None,
            kind,
            of: None,
            speeds: Vec::new(),
            ratios: Vec::new(),
            count: MODES,
            orders: kind.orders(),
            mesh_orders: MESH_ORDERS.to_vec(),
            operation: Vec::new(),
            margin: MARGIN,
            stiffness: Vec::new(),
            stations: STATIONS,
            probe_angle: None,
            format: MatrixFormat::default(),
            lateral: None,
            periodic: PeriodicKeys::default(),
        }
    }
}

/// A format in which matrices are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum MatrixFormat {
    /// One archive, for NumPy
    #[default]
    Npz,
    /// Matrix Market: a text file for each matrix
    #[value(name = "mtx")]
    Market,
    /// One file of MATLAB 5
    Mat,
}

impl MatrixFormat {
    pub(super) const WORDS: &'static [&'static str] = &["npz", "mtx", "mat"];
    const ALL: [MatrixFormat; 3] = [MatrixFormat::Npz, MatrixFormat::Market, MatrixFormat::Mat];

    fn of(word: &str) -> Option<Self> {
        let place = MatrixFormat::WORDS.iter().position(|own| *own == word)?;
        Some(MatrixFormat::ALL[place])
    }
}

impl AnalysisKind {
    pub(super) const WORDS: &'static [&'static str] = &[
        "modes",
        "campbell",
        "response",
        "coefficients",
        "stability",
        "map",
        "matrices",
        "torsion",
        "forces",
        "lateral",
        "periodic",
    ];
    const ALL: [AnalysisKind; 11] = [
        AnalysisKind::Modes,
        AnalysisKind::Campbell,
        AnalysisKind::Response,
        AnalysisKind::Coefficients,
        AnalysisKind::Stability,
        AnalysisKind::Map,
        AnalysisKind::Matrices,
        AnalysisKind::Torsion,
        AnalysisKind::Forces,
        AnalysisKind::Lateral,
        AnalysisKind::Periodic,
    ];

    /// The kind that a case names so.
    pub(crate) fn of(word: &str) -> Option<Self> {
        AnalysisKind::ALL.into_iter().find(|own| own.word() == word)
    }

    /// What an analysis is called.
    pub(crate) fn heading(self) -> &'static str {
        match self {
            AnalysisKind::Modes => "Modes at constant speed",
            AnalysisKind::Campbell => "Campbell diagram and critical speeds",
            AnalysisKind::Response => "Response to unbalance",
            AnalysisKind::Coefficients => "Stiffness and damping of the joints",
            AnalysisKind::Stability => "Stability",
            AnalysisKind::Map => "Undamped critical speeds over the stiffness of the joints",
            AnalysisKind::Matrices => "Matrices",
            AnalysisKind::Torsion => "Torsion",
            AnalysisKind::Forces => "Forces along the bodies",
            AnalysisKind::Lateral => "Lateral analysis after API 617",
            AnalysisKind::Periodic => "Motions that repeat themselves",
        }
    }

    /// Orders where none are asked for; none where they are those of the bodies that turn.
    pub(crate) fn orders(self) -> Vec<f64> {
        if self == AnalysisKind::Torsion { TORSION.to_vec() } else { Vec::new() }
    }

    /// As a case names it.
    pub(crate) fn word(self) -> &'static str {
        let place = AnalysisKind::ALL.iter().position(|own| *own == self);
        AnalysisKind::WORDS[place.expect("all are listed")]
    }
}

/// All analyses of a file that are right.
pub(super) fn read(file: &Table, joined: Option<&JoinedMachine>) -> Vec<Analysis> {
    let tables = names::in_order(file, "analysis");
    let labels: Vec<Located> = tables.iter().map(|(name, _)| name.clone()).collect();
    names::distinct(file, "analysis", &labels);
    tables
        .into_iter()
        .filter_map(|(name, table)| table.read(|table| read_one(&name, table, joined)))
        .collect()
}

fn read_one(name: &Located, table: &Table, joined: Option<&JoinedMachine>) -> Option<Analysis> {
    let word = table.optional_word("kind");
    let kind = AnalysisKind::ALL.into_iter().find(|own| Some(own.word()) == word);
    let (of, speeds) = (table.optional_string("of"), table.optional_string("speeds"));
    let stiffness = table.optional_string("stiffness");
    let ratios = table.named_values("ratios");
    let count = table.optional_count("count").unwrap_or(MODES);
    let orders = table.positive_numbers("orders");
    let mesh_orders = table.positive_numbers("mesh_orders");
    let operation = table.optional_string("operation");
    let given = table.gives("margin");
    let margin = if given { table.number_or_middle("margin") } else { MARGIN };
    let stations = table.optional_count("stations").unwrap_or(STATIONS);
    let format = table.optional_word("format").and_then(MatrixFormat::of);
    let probe_angle = match kind {
        Some(AnalysisKind::Response) => table.quantity("probe_angle"),
        _ => None,
    };
    let lateral = match kind {
        Some(AnalysisKind::Lateral) => Some(Box::new(lateral::read(table, joined)?)),
        _ => {
            let both: &[&str] = match kind {
                Some(AnalysisKind::Response) => &["probe_angle"],
                _ => &[],
            };
            lateral::refuse(table, both);
            None
        }
    };
    let periodic = match kind {
        Some(AnalysisKind::Periodic) => periodic::read(table),
        _ => {
            periodic::refuse(table);
            PeriodicKeys::default()
        }
    };
    let kind = kind?;
    for (key, own) in OF_ONE_KIND {
        if kind != own && table.gives(key) {
            let message = format!("`{key}` is of analyses of `kind = \"{}\"`", own.word());
            let help = "leave it out, or ask for that kind";
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    let mut analysis = Analysis {
        name: name.text().to_owned(),
        table: Some(name.clone()),
        count,
        orders: if orders.is_empty() { kind.orders() } else { each_once(&orders) },
        mesh_orders: if mesh_orders.is_empty() {
            MESH_ORDERS.to_vec()
        } else {
            each_once(&mesh_orders)
        },
        margin,
        stations,
        probe_angle,
        format: format.unwrap_or_default(),
        lateral,
        periodic,
        ..Analysis::of_kind(kind)
    };
    let mut errors = Diagnostics::new();
    if let Some(speeds) = &speeds {
        match self::speeds(speeds) {
            Ok(found) => analysis.speeds = found,
            Err(error) => errors.push(*error),
        }
    }
    if let Some(operation) = &operation {
        match self::speeds(operation) {
            Ok(found) => analysis.operation = found,
            Err(error) => errors.push(*error),
        }
    }
    if let Some(stiffness) = &stiffness {
        match self::stiffness(stiffness) {
            Ok(found) => analysis.stiffness = found,
            Err(error) => errors.push(*error),
        }
    }
    if let Some(joined) = joined {
        let mut body =
            |name: &Located| turning(joined, name).map_err(|error| errors.push(*error)).ok();
        analysis.of = of.as_ref().and_then(&mut body);
        analysis.ratios = vec![None; joined.bodies.len()];
        for (name, value) in &ratios {
            let (place, ratio) = (body(name), value.text().parse::<f64>());
            match (place, ratio) {
                (Some(place), Ok(_)) if analysis.of == Some(place) => {
                    let message = format!("the speeds are those of `{}` itself", name.text());
                    let help = "give ratios of other bodies alone";
                    table.push(value.error_here(Code::BAD_VALUE, message).help(help));
                }
                (Some(place), Ok(ratio)) => analysis.ratios[place] = Some(ratio),
                (_, Err(_)) => {
                    let message = format!("the ratio of `{}` is no number", name.text());
                    let help = "write the speed of the body over that of `of`, such as `-1.5`";
                    table.push(value.error_here(Code::BAD_VALUE, message).help(help));
                }
                (None, Ok(_)) => {}
            }
        }
    }
    errors.iter().for_each(|error| table.push(error.clone()));
    Some(analysis)
}

/// The body that turns and is called so.
///
/// # Errors
/// There is none.
pub(crate) fn turning(joined: &JoinedMachine, name: &Located) -> Result<usize, Box<Diagnostic>> {
    let turns = |place: &usize| joined.bodies[*place].turns();
    let own = |place: &usize| joined.bodies[*place].name.text() == name.text();
    let all = || (0..joined.bodies.len()).filter(turns);
    if let Some(place) = all().find(own) {
        return Ok(place);
    }
    let names: Vec<&str> = all().map(|place| joined.bodies[place].name.text()).collect();
    let message = format!("there is no body `{}` that turns", name.text());
    let help = suggest(name.text(), &names).unwrap_or_else(|| match names.is_empty() {
        true => "no body of this case turns: leave it out".to_owned(),
        false => format!("bodies that turn: {}", names.join(", ")),
    });
    Err(name.error_here(Code::BAD_VALUE, message).help(help).into())
}

/// Speeds as they are written (rad/s), ascending: a range, or one of them.
///
/// # Errors
/// What is no speed.
pub(crate) fn speeds(text: &Located) -> Result<Vec<f64>, Box<Diagnostic>> {
    let help = "write `speeds = \"0 rpm .. 30000 rpm, 61\"`, or one such as `\"3000 rpm\"`";
    let words = ["speeds are angular speeds", "a speed"];
    let all = levels(text, &Dimension::ANGULAR_SPEED, words, help)?;
    if all.iter().any(|own| own.abs() > MOST_SPEED) {
        let message = "no shaft turns with more than 10 million rpm";
        return Err(text.error_here(Code::BAD_VALUE, message).help(help).into());
    }
    Ok(all)
}

/// Numbers without those that stand there before.
pub(crate) fn each_once(all: &[f64]) -> Vec<f64> {
    let is_first = |place: &usize| !all[..*place].contains(&all[*place]);
    (0..all.len()).filter(is_first).map(|place| all[place]).collect()
}

/// Stiffnesses as they are written (N/m), ascending and above zero: a range, or one of them.
///
/// # Errors
/// What is no stiffness.
pub(crate) fn stiffness(text: &Located) -> Result<Vec<f64>, Box<Diagnostic>> {
    let help = "write `stiffness = \"1e5 N/m .. 1e10 N/m, 41, log\"`, or one such as `\"1e7 N/m\"`";
    let words = ["the stiffness of joints is one along a line", "a stiffness"];
    let all = levels(text, &Dimension::STIFFNESS, words, help)?;
    match all.first() {
        Some(first) if !(*first > 0.0) => {
            let message = "joints without stiffness do not hold the machine";
            Err(text.error_here(Code::BAD_VALUE, message).help(help).into())
        }
        _ => Ok(all),
    }
}

/// Values of a dimension as they are written, ascending.
fn levels(
    text: &Located,
    dimension: &Dimension,
    [kind, one]: [&str; 2],
    help: &str,
) -> Result<Vec<f64>, Box<Diagnostic>> {
    let wrong = |own: &Dimension| {
        let message = format!("{kind}, and this is {own}");
        Box::new(text.error_here(Code::WRONG_UNIT, message).help(help))
    };
    let own = text.text();
    if !is_range(own) {
        let read = Quantity::parse(own)
            .map_err(|error| Box::new(text.error_here(error.code, error.message).help(help)))?;
        if !read.dimension().fits(dimension) {
            return Err(wrong(read.dimension()));
        }
        return Ok(vec![read.si()]);
    }
    let place = Place { source: text.source().clone(), span: text.span() };
    let range = Range::read(own, &place)?;
    let count = range.count.unwrap_or(SPEEDS);
    if count > MOST {
        let message = format!("an analysis goes through no more than {MOST} values");
        return Err(text.error_here(Code::BAD_VALUE, message).help(help).into());
    }
    let mut values = Vec::with_capacity(count);
    for k in 0..count {
        let level = range.even(k, count);
        let Some(quantity) = level.quantity() else {
            let message = format!("{one} has a unit");
            return Err(Box::new(text.error_here(Code::WRONG_UNIT, message).help(help)));
        };
        if !quantity.dimension().fits(dimension) {
            return Err(wrong(quantity.dimension()));
        }
        values.push(quantity.si());
    }
    values.sort_by(f64::total_cmp);
    Ok(values)
}
