//! Films in joints: their nodes, ends and openings, as cases say them, and the film that they make.

use std::f64::consts::PI;

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_codegen::document::Table;
use whirl_codegen::document::schema::Shape::{Either, List, Named, Number, Words};
use whirl_codegen::document::schema::{Key, Shape, key, merged};
use whirl_codegen::kinds::law::{BearingValue, Given, Parameter};
use whirl_codegen::rational::{Rational, nearest};
use whirl_codegen::units::{Quantity, Unit};
use whirl_solver::bearing::FilmLaw;
use whirl_solver::cache;
use whirl_solver::film::{Journal, OilFilm, WrongFilm};
use whirl_solver::output::Integral;
use whirl_specs::{CLEARANCES, FILMS, Film};

use super::film_bore::{Around, BoreShape, POCKET};
use super::library::FileStore;
use super::names;
use super::shapes::{ANGLE, ARC, LENGTH, POSITION, SUPPLY};
use super::values::listed;

/// The table `film` of a joint.
pub(super) const FILM: &[Key] = &[
    key("grid", List(&Number), "nodes around and along; 72 and 7 if left out").like("[72, 7]"),
    key("left", Either(&[SUPPLY, Words(&ENDS)]), LEFT).like("\"open\""),
    key("right", Either(&[SUPPLY, Words(&ENDS)]), "the same of the end at greater z")
        .like("\"2 bar\""),
    key("opening", Named(&Shape::Table(&[OPENING])), "holes and grooves in the bore, by name"),
    key("pocket", Named(&Shape::Table(&[POCKET])), "places of the bore that are deeper, by name"),
];

const LEFT: &str = "the end at smaller z: open to air at the pressure of the cavity, closed, or flooded with this pressure; open if left out";

const OPENING: &[Key] = &[
    merged("angle", ANGLE, "of its middle, from x of the bore towards y"),
    key("arc", ARC, "around the bore"),
    key("width", LENGTH, "around the bore, in place of `arc`"),
    key("z", POSITION, "of its middle, from the middle of the film; 0 if left out"),
    merged("length", LENGTH, "along z"),
    merged("pressure", SUPPLY, "of the oil in it, above that of the cavity"),
];

/// Nodes around and along where a case says none.
const GRID: [usize; 2] = [72, 7];
/// Most of them.
const MOST: [f64; 2] = [2000.0, 101.0];
/// Keys of both ends, and what results call these.
const ENDS_CALLED: [&str; 2] = ["left", "right"];
/// Words for ends without a pressure.
const ENDS: [&str; 2] = ["open", "closed"];
/// Values that a film takes from its joint.
const OF_JOINT: [(&str, &str, BearingValue, &str); 3] = [
    ("R", "mm", BearingValue::JournalRadius, "radius of the journal"),
    ("L", "mm", BearingValue::Length, "length of the film"),
    ("c", "um", BearingValue::RadialClearance, "radial clearance"),
];

/// A film as the law of a joint.
#[derive(Debug, Clone)]
pub(crate) struct FilmSource {
    kernel: &'static Film,
    /// What the joint says of it.
    told: FilmTable,
    /// Values of its parameters, and of the joint.
    given: Vec<Given>,
}

/// The table `film` of a joint.
#[derive(Debug, Clone)]
struct FilmTable {
    grid: [usize; 2],
    grid_place: Located,
    ends: [(End, Located); 2],
    openings: Vec<Opening>,
    bore: BoreShape,
    /// Where the joint names the film.
    place: Located,
}

/// An end of a film.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Open,
    Closed,
    /// With this pressure above that of the cavity (Pa).
    Flooded(f64),
}

/// A hole or a groove in the bore.
#[derive(Debug, Clone)]
struct Opening {
    name: Located,
    /// Its middle, from x (rad), and from the middle of the film (m).
    angle: f64,
    z: f64,
    size: Around,
    /// Along z (m).
    length: f64,
    /// Above that of the cavity (Pa).
    pressure: f64,
}

impl Opening {
    fn read(table: &Table, name: Located) -> Option<Self> {
        let size = Around::read(table);
        let z = table.quantity("z").unwrap_or(0.0);
        let [angle, length, pressure] =
            ["angle", "length", "pressure"].map(|key| table.quantity(key));
        let (angle, size, length, pressure) = (angle?, size?, length?, pressure?);
        Some(Opening { name, angle, z, size, length, pressure })
    }
}

/// The shipped film of this name.
pub(super) fn shipped(name: &str) -> Option<&'static Film> {
    FILMS.iter().find(|film| film.origin.name == name)
}

/// Names of the shipped films.
pub(super) fn names() -> Vec<&'static str> {
    FILMS.iter().map(|film| film.origin.name).collect()
}

/// Reads the table of a joint whose law is no film, whether there is one.
pub(super) fn pass(store: FileStore, joint: &Table, law: &Located) -> bool {
    let own = joint.optional_table("film");
    own.map(|own| own.read(|own| FilmTable::read(store, own, law))).is_some()
}

/// A number of a shipped film as its file has it, which is one of few digits.
fn written(value: f64) -> Rational {
    let parsed = Quantity::parse(&format!("{value:.11e}"));
    parsed.map_or_else(|_| Rational::from(0), |own| own.value().clone())
}

impl FilmSource {
    /// A film that the table of a joint names, with what its table `film` says.
    pub(super) fn read(
        store: FileStore,
        joint: &Table,
        kernel: &'static Film,
        name: &Located,
    ) -> Self {
        let own = joint.optional_table("film");
        let told = match own {
            Some(own) => own.read(|own| FilmTable::read(store, own, name)),
            None => FilmTable {
                grid: GRID,
                grid_place: name.clone(),
                ends: [(); 2].map(|()| (End::Open, name.clone())),
                openings: Vec::new(),
                bore: BoreShape::default(),
                place: name.clone(),
            },
        };
        FilmSource { kernel, told, given: Vec::new() }
    }

    /// With these values.
    ///
    /// # Errors
    /// What does not fit: nodes, openings, numbers with which nothing flows.
    pub(super) fn with(&self, given: Vec<Given>) -> Result<Self, Diagnostics> {
        let own = FilmSource { given, ..self.clone() };
        own.built().map(|_| own)
    }

    /// What its history calls its openings, both ends first, and its integrals: name, unit and what it is.
    pub(super) fn columns(&self) -> (Vec<String>, Vec<Integral>) {
        let openings = self.told.openings.iter().map(|own| own.name.text());
        let integrals = self.kernel.outputs.iter().map(|own| Integral {
            name: own.name.to_owned(),
            unit: own.unit,
            meaning: own.title.to_owned(),
        });
        (ENDS_CALLED.into_iter().chain(openings).map(str::to_owned).collect(), integrals.collect())
    }

    /// How results call it.
    pub(super) fn name(&self) -> String {
        let name = self.kernel.origin.name;
        match self.given.as_slice() {
            [] => name.to_owned(),
            given => format!("{name} ({})", listed(given)),
        }
    }

    /// Its nodes, and what its openings have of them, for people.
    pub(crate) fn described(&self) -> Vec<String> {
        let Ok(FilmLaw { journal, .. }) = self.built() else { return Vec::new() };
        let film = &journal.film;
        let [dx, dz] = film.grid.spacing().map(|own| whirl_text::rounded(1e3 * own, 4));
        let FilmTable { grid: [around, along], openings, bore, .. } = &self.told;
        let mut lines = vec![format!("film of {around} × {along} nodes, {dx} × {dz} mm apart")];
        if !bore.is_round() {
            lines.extend(bore.described());
            let gaps = journal.gaps().map(|own| whirl_text::rounded(1e6 * own, 4));
            let [least, most] = gaps;
            lines
                .push(format!("gaps from {least} to {most} µm where the journal is in the middle"));
        }
        for (place, own) in openings.iter().enumerate() {
            let ([i, j], size) = film.covered(ENDS_CALLED.len() + place);
            let [width, length] = size.map(|own| whirl_text::rounded(1e3 * own, 4));
            lines.push(format!(
                "opening {}: {i} × {j} nodes, {width} × {length} mm by them",
                own.name.text()
            ));
        }
        lines
    }

    /// Its parameters, those of the joint last.
    pub(super) fn parameters(&self) -> Vec<Parameter> {
        let unit = |text: &str| Unit::parse(text).expect("units of a shipped film are units");
        let own = self.kernel.parameters.iter().map(|own| {
            let written = written(own.value / own.per_unit);
            Parameter {
                name: own.name.to_owned(),
                title: own.title.to_owned(),
                unit: unit(own.unit),
                value: written.clone(),
                written,
                bearing: None,
            }
        });
        let of_joint = OF_JOINT.iter().map(|(name, own, bearing, title)| Parameter {
            name: (*name).to_owned(),
            title: (*title).to_owned(),
            unit: unit(own),
            written: Rational::from(0),
            value: Rational::from(0),
            bearing: Some(*bearing),
        });
        own.chain(of_joint).collect()
    }

    /// The film with its values.
    ///
    /// # Errors
    /// As [`FilmSource::with`].
    pub(crate) fn built(&self) -> Result<FilmLaw, Diagnostics> {
        let FilmTable { grid, grid_place, ends, openings, bore, place } = &self.told;
        let mut errors = Diagnostics::new();
        let mut note = |at: &Located, wrong: WrongFilm| {
            errors.push(at.error_here(Code::BAD_VALUE, wrong.what).help(wrong.help));
        };
        let value = |name: &str| {
            let own = self.given.iter().find(|own| own.name == name);
            own.map(|own| own.unit.to_si(nearest(&own.value)))
        };
        let [radius, length, clearance] =
            OF_JOINT.map(|(name, ..)| value(name).unwrap_or_default());
        let mut film = match OilFilm::new(self.kernel, *grid, [radius, length], 0.0) {
            Ok(film) => film,
            Err(wrong) => {
                note(grid_place, wrong);
                return Err(errors);
            }
        };
        for own in self.kernel.parameters {
            if let Some(Err(wrong)) = value(own.name).map(|value| film.set(own.name, value)) {
                note(place, wrong);
            }
        }
        for (end, (own, at)) in ends.iter().enumerate() {
            match own {
                End::Open => {}
                End::Closed => film.close(end),
                End::Flooded(pressure) => {
                    if let Err(wrong) = film.flood(end, *pressure) {
                        note(at, wrong);
                    }
                }
            }
        }
        for own in openings {
            let half = own.size.half(radius);
            if half > PI * (1.0 + 1e-12) {
                let what = format!(
                    "the opening `{}` reaches around the bore more than once",
                    own.name.text()
                );
                let help = "write `arc = \"360 deg\"` for a groove all around".to_owned();
                note(&own.name, WrongFilm { what, help });
                continue;
            }
            let added = film.supply(
                own.name.text(),
                own.angle - half..own.angle + half,
                own.z - 0.5 * own.length..own.z + 0.5 * own.length,
                own.pressure,
            );
            if let Err(wrong) = added {
                note(&own.name, wrong);
            }
        }
        let numbers = openings.iter().map(|own| {
            let Opening { name, angle, z, size, length, pressure } = own;
            format!("{} {angle:?} {z:?} {size:?} {length:?} {pressure:?}", name.text())
        });
        let numbers: Vec<String> = numbers.collect();
        let hash = cache::Key::of(&format!(
            "{} {} {grid:?} {:?} {numbers:?} {}",
            self.kernel.origin.hash,
            self.name(),
            ends.each_ref().map(|(end, _)| *end),
            if bore.is_round() { String::new() } else { bore.numbers() }
        ));
        let mut journal = match Journal::new(film, &CLEARANCES[0], clearance) {
            Ok(journal) => journal,
            Err(wrong) => {
                note(place, wrong);
                return Err(errors);
            }
        };
        if !bore.is_round() {
            journal.shape(|angle, z| bore.depth([angle, z], [clearance, radius, length]));
            let nodes = journal.film.grid.places();
            for name in bore.missed(&nodes, (radius, length)) {
                let what = format!("the pocket `{}` lies between nodes of the film", name.text());
                let help = "make it larger, or take more nodes in `grid`".to_owned();
                note(name, WrongFilm { what, help });
            }
            let [least, _] = journal.gaps();
            if !(least > 0.0) {
                let least = whirl_text::shown(1e6 * least, 3, 1e-3..1e6);
                let what = format!(
                    "the shape of the bore leaves a gap of {least} µm where the journal is in its middle"
                );
                let help = "depths are beyond the round bore of the `radial_clearance`: make them greater, or that".to_owned();
                note(bore.place().unwrap_or(place), WrongFilm { what, help });
                return Err(errors);
            }
        }
        // What is wrong with its openings is not what it lacks.
        let sound = errors.is_empty();
        let mut note = |at: &Located, wrong: WrongFilm| {
            errors.push(at.error_here(Code::BAD_VALUE, wrong.what).help(wrong.help));
        };
        let name = self.kernel.origin.name;
        let closed = ends.iter().all(|(end, _)| *end == End::Closed) && openings.is_empty();
        match journal.pressure() {
            _ if !sound => {}
            _ if closed => {
                let what = format!(
                    "the film `{name}` has neither an end nor an opening through which oil comes or goes"
                );
                let help = "open an end, flood it, or add an opening";
                note(&ends[0].1, WrongFilm { what, help: help.to_owned() });
            }
            Some(pressure) if pressure > 0.0 => {}
            Some(_) => {
                let what = format!(
                    "nothing feeds the film `{name}`: its oil leaves at the ends, and it runs dry"
                );
                let help = "add an opening to the table `film` of the joint, or the pressure of an end that is flooded; or take a \
                            film that carries no fill, such as `reynolds`";
                note(place, WrongFilm { what, help: help.to_owned() });
            }
            None => {
                let what = format!(
                    "with these parameters the film `{name}` has no pressure that is a number"
                );
                let mut help =
                    "its viscosity and its roughness are above zero, and an end is open, or an opening".to_owned();
                if !bore.is_round() {
                    help += "; a pocket much deeper than the clearance has one pressure: make it an opening";
                }
                note(place, WrongFilm { what, help });
            }
        }
        errors.into_result(FilmLaw { name: self.name(), hash: hash.hex(), journal })
    }
}

impl FilmTable {
    fn read(store: FileStore, table: &Table, name: &Located) -> Self {
        let counts = table.positive_numbers("grid");
        let (grid, grid_place) = match counts.as_slice() {
            [around, along]
                if [around, along].iter().all(|own| own.fract() == 0.0)
                    && *around <= MOST[0]
                    && *along <= MOST[1] =>
            {
                ([*around as usize, *along as usize], table.written("grid"))
            }
            _ => {
                if table.gives("grid") {
                    let message = format!(
                        "`grid` is two whole numbers: nodes around, {} at most, and along, {} at most",
                        MOST[0], MOST[1]
                    );
                    let help = "such as `grid = [72, 7]`";
                    let at = table.written("grid");
                    table.push(at.error_here(Code::BAD_VALUE, message).help(help));
                }
                (GRID, name.clone())
            }
        };
        let end = |key: &'static str| {
            let said = table.gives(key).then(|| table.written(key));
            let word = said.as_ref().map(|own| own.text().trim_matches(['"', '\'']).to_owned());
            let end = match word.as_deref() {
                None => End::Open,
                Some("open") => End::Open,
                Some("closed") => End::Closed,
                Some(_) => table.quantity(key).map_or(End::Open, End::Flooded),
            };
            if word.is_some_and(|own| ENDS.contains(&own.as_str())) {
                table.pass_over(key);
            }
            (end, said.unwrap_or_else(|| name.clone()))
        };
        let ends = ENDS_CALLED.map(end);
        let all = names::in_order(table, "opening");
        for (name, _) in all.iter().filter(|(name, _)| ENDS_CALLED.contains(&name.text())) {
            let message =
                format!("an opening cannot be called `{}`, as an end of the film is", name.text());
            table.push(name.error_here(Code::BAD_VALUE, message).help("give it another name"));
        }
        names::plain(table, "opening", all.iter().map(|(name, _)| name));
        let openings =
            all.into_iter().filter_map(|(name, own)| own.read(|own| Opening::read(own, name)));
        let (openings, bore) = (openings.collect(), BoreShape::read(store, table));
        FilmTable { grid, grid_place, ends, openings, bore, place: name.clone() }
    }
}
