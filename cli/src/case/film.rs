//! Films in joints: their nodes, ends and openings, as cases say them, and the film that they make.

use std::f64::consts::PI;

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{BearingValue, Given, Limits, Parameter};
use whirl_codegen::rational::{Rational, nearest};
use whirl_codegen::units::{Quantity, Unit};
use whirl_solver::bearing::FilmLaw;
use whirl_solver::cache;
use whirl_solver::film::{Grid, Journal, OilFilm, Reach, WrongFilm};
use whirl_solver::output::Integral;
use whirl_specs::{CLEARANCES, FILMS, Film};

use super::film_table::{FilmTable, Opening, Side};
use super::library::FileStore;
use super::values::listed;

/// The parameter that changes with the temperature.
const VISCOSITY: &str = "mu_0";

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
            None => FilmTable::of_name(name),
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
        let integrals = self.kernel.outputs.iter().map(|own| Integral {
            name: own.name.to_owned(),
            unit: own.unit,
            meaning: own.title.to_owned(),
        });
        let mut integrals: Vec<Integral> = integrals.collect();
        if self.told.heat.as_ref().is_some_and(|own| own.given().is_none()) {
            let (name, meaning) = ("temperature".to_owned(), "temperature of the film".to_owned());
            integrals.push(Integral { name, unit: "K", meaning });
        }
        (self.told.called(), integrals)
    }

    /// How results call it.
    pub(super) fn name(&self) -> String {
        let name = self.kernel.origin.name;
        match self.given.as_slice() {
            [] => name.to_owned(),
            given => format!("{name} ({})", listed(given)),
        }
    }

    /// Names of the parameters that have other values than its file.
    pub(super) fn set(&self) -> Vec<&str> {
        let viscosity = self.told.heat.is_some().then_some(VISCOSITY);
        self.given.iter().map(|own| own.name.as_str()).chain(viscosity).collect()
    }

    /// Its nodes, and what its openings have of them, for people.
    pub(crate) fn described(&self) -> Vec<String> {
        let Ok(FilmLaw { journal, .. }) = self.built() else { return Vec::new() };
        let film = &journal.film;
        let [dx, dz] = film.grid.spacing().map(|own| whirl_text::rounded(1e3 * own, 4));
        let FilmTable { grid: [around, along], arc, openings, bore, .. } = &self.told;
        let mut lines = vec![format!("film of {around} × {along} nodes, {dx} × {dz} mm apart")];
        if let Some(arc) = arc {
            let degrees = |angle: f64| whirl_text::rounded(angle.to_degrees(), 4);
            let [start, end] = [arc.start, arc.start + arc.size].map(degrees);
            lines.push(format!("arc from {start}° to {end}°"));
        }
        if !bore.is_round() {
            lines.extend(bore.described());
            let gaps = journal.gaps().map(|own| whirl_text::rounded(1e6 * own, 4));
            let [least, most] = gaps;
            lines
                .push(format!("gaps from {least} to {most} µm where the journal is in the middle"));
        }
        lines.extend(self.told.heat.iter().map(|own| own.described()));
        for (place, own) in openings.iter().enumerate() {
            let ([i, j], size) = film.covered(film.sides() + place);
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
                limits: Limits::default(),
            }
        });
        let of_joint = OF_JOINT.iter().map(|(name, own, bearing, title)| Parameter {
            name: (*name).to_owned(),
            title: (*title).to_owned(),
            unit: unit(own),
            written: Rational::from(0),
            value: Rational::from(0),
            bearing: Some(*bearing),
            limits: Limits::default(),
        });
        own.chain(of_joint).collect()
    }

    /// Whether it does not close, as that of a pad.
    pub(crate) fn is_arc(&self) -> bool {
        self.told.arc.is_some()
    }

    /// Where it begins, how far it reaches (rad), its radius and its length (m), if it does not close.
    pub(crate) fn pad(&self) -> Option<[f64; 4]> {
        let arc = self.told.arc?;
        let grid = self.built().ok()?.journal.film.grid;
        let [around, along] = self.told.grid.map(|nodes| nodes as f64 - 1.0);
        let [dx, dz] = grid.spacing();
        Some([arc.start, arc.size, dx * around / arc.size, dz * along])
    }

    /// From where to where it reaches around the bore.
    fn reach(&self) -> Reach {
        let arc = self.told.arc;
        Reach { first: arc.map_or(0.0, |own| own.start), arc: arc.map(|own| own.size) }
    }

    /// Where the case says that its bore gives way.
    pub(crate) fn asked_to_give_way(&self) -> Option<&Located> {
        self.told.flexible.1.as_ref()
    }

    /// Its nodes on a bore of this length (m) that is to give way; none if what is said of them is wrong.
    pub(crate) fn grid_that_gives_way(&self, length: f64) -> Option<Grid> {
        // Angles and shares are those of any radius.
        let film = OilFilm::reaching(self.kernel, self.told.grid, [1.0, length], self.reach());
        film.ok().filter(|_| self.told.flexible.0).map(|own| own.grid)
    }

    /// The film with its values.
    ///
    /// # Errors
    /// As [`FilmSource::with`].
    pub(crate) fn built(&self) -> Result<FilmLaw, Diagnostics> {
        let FilmTable { grid, grid_place, arc, sides, openings, bore, place, .. } = &self.told;
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
        let reach = self.reach();
        let mut film = match OilFilm::reaching(self.kernel, *grid, [radius, length], reach) {
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
        for (place, (own, at)) in sides.iter().enumerate() {
            let done = match own {
                Side::Open => film.open(place),
                Side::Closed => {
                    film.close(place);
                    Ok(())
                }
                Side::Flooded(pressure) => film.flood(place, *pressure),
            };
            if let Err(wrong) = done {
                note(at, wrong);
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
            sides.iter().map(|(side, _)| *side).collect::<Vec<_>>(),
            if bore.is_round() { String::new() } else { bore.numbers() }
        ));
        let hash = match &self.told.heat {
            Some(heat) => cache::Key::of(&format!("{} {}", hash.hex(), heat.numbers())),
            None => hash,
        };
        let hash = match arc {
            Some(arc) => cache::Key::of(&format!("{} {arc:?}", hash.hex())),
            None => hash,
        };
        let mut journal = match Journal::new(film, &CLEARANCES[0], clearance) {
            Ok(journal) => journal,
            Err(wrong) => {
                note(place, wrong);
                return Err(errors);
            }
        };
        if value(VISCOSITY).is_some_and(|own| !(own > 0.0)) {
            let what = format!("the viscosity `{VISCOSITY}` is not above zero");
            note(place, WrongFilm { what, help: format!("such as `{VISCOSITY} = \"20 mPa*s\"`") });
            return Err(errors);
        }
        if let Some(heat) = &self.told.heat {
            let parameters = self.kernel.parameters.iter();
            let own = parameters.clone().find(|own| own.name == VISCOSITY).map(|own| own.value);
            let mu = value(VISCOSITY).or(own).unwrap_or_default();
            let own = heat.heat(mu);
            if heat.has_rows() && value(VISCOSITY).is_some() {
                let what =
                    format!("`{VISCOSITY}` is given beside the viscosity over the temperature");
                let help = format!(
                    "leave `{VISCOSITY}` out of `parameters`, or `viscosity` out of `heat`"
                );
                note(&heat.place, WrongFilm { what, help });
            }
            let done = match heat.given() {
                Some(given) => journal.film.set(VISCOSITY, own.viscosity.at(given)),
                None => journal.warm(own),
            };
            if let Err(wrong) = done {
                note(&heat.place, wrong);
            }
        }
        if !bore.is_round() {
            journal.shape(|angle, z| bore.depth([angle, z], [clearance, radius, length]));
            let nodes = journal.film.grid.places();
            for name in bore.missed(&nodes, (radius, length)) {
                let what = format!("no node of the film lies in the pocket `{}`", name.text());
                let help = "place it within the film and its `arc`, make it larger, or take more nodes in `grid`"
                    .to_owned();
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
        let closed = sides.iter().all(|(side, _)| *side == Side::Closed) && openings.is_empty();
        // Rows of nodes at open ends hold oil, so that the balance alone shows only where they feed too little.
        let is_fed = !journal.film.carries_fill()
            || !openings.is_empty()
            || sides.iter().any(|(side, _)| matches!(side, Side::Flooded(_)));
        match journal.pressure() {
            _ if !sound => {}
            _ if closed => {
                let what = format!(
                    "the film `{name}` has neither an end nor an opening through which oil comes or goes"
                );
                let help = "open an end, flood it, or add an opening";
                note(&sides[0].1, WrongFilm { what, help: help.to_owned() });
            }
            Some(pressure) if pressure > 0.0 && is_fed => {}
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
