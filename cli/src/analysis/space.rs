//! The machine in space as analyses move it: surfaces of bodies with modes and orbits, for the page.

use std::sync::OnceLock;
use std::thread;

use num_complex::Complex64;
use whirl_solver::body::BodyNode;
use whirl_solver::cache::Cache;
use whirl_solver::linear::{LinearMachine, Mode, Orbit, Standstill, Way, Whirl};
use whirl_solver::machine::Field;

use super::words;
use crate::case::Case;
use crate::errors::Failure;
use crate::machine;
use crate::page::{MOTIONS, Moving, Shapes};

/// Speeds of a diagram whose motions are shown beside those at peaks and critical speeds, at most.
pub(super) const SPEEDS: usize = 5;

/// What pictures analyses make, and of what.
#[derive(Clone, Copy)]
pub(super) struct Pictures<'a> {
    /// Whether there are figures.
    pub(super) figures: bool,
    pub(super) cache: Option<&'a Cache>,
    /// The machine in space, if that is wanted.
    pub(super) space: Option<&'a Space<'a>>,
}

/// The surfaces of a case with how their points move, made when they are first asked for.
pub(crate) struct Space<'a> {
    case: &'a Case,
    cache: Option<&'a Cache>,
    made: OnceLock<Option<Points>>,
}

struct Points {
    shapes: Shapes,
    /// By bodies; the points of their shapes one after the other.
    fields: Vec<Field>,
    /// By shapes the body and how many points.
    counts: Vec<(usize, usize)>,
}

/// Motions of an analysis in space, while there is room for them.
pub(super) struct InSpace<'a> {
    points: &'a Points,
    moving: Moving,
}

/// What is said of a motion.
pub(super) struct Told {
    /// Under what it is listed, and its name there.
    pub(super) group: String,
    pub(super) name: String,
    pub(super) rpm: Option<f64>,
    pub(super) hertz: f64,
}

impl Told {
    /// A mode, by its place, at a speed (rad/s) of a body.
    pub(super) fn at_speed(
        linear: &LinearMachine,
        of: Option<(usize, f64)>,
        (place, mode): (usize, &Mode),
    ) -> Told {
        let group = match of {
            Some((body, speed)) => {
                let body = linear.machine().bodies[body].name();
                format!("modes at {} rpm of {body}", words::speed(speed))
            }
            None => "modes".to_owned(),
        };
        let whirl = of.map_or("-", |own| words::whirl(mode, own.1));
        let whirl = if whirl == "-" { String::new() } else { format!(", {whirl}") };
        let (hertz, decrement) = (words::hertz(mode), words::decrement(mode));
        Told {
            group,
            name: format!("{}: {hertz} Hz, δ = {decrement}{whirl}", place + 1),
            rpm: of.map(|own| words::rpm(own.1)),
            hertz: mode.hertz(),
        }
    }
}

impl<'a> Space<'a> {
    pub(crate) fn of(case: &'a Case, cache: Option<&'a Cache>) -> Self {
        Space { case, cache, made: OnceLock::new() }
    }

    /// Does work while the surfaces are made.
    pub(super) fn while_made<T>(&self, work: impl FnOnce() -> T) -> T {
        thread::scope(|scope| {
            // What goes wrong does so again when they are asked for.
            scope.spawn(|| self.make().is_ok());
            work()
        })
    }

    /// Without any motion yet; none where nothing has a shape.
    ///
    /// # Errors
    /// As the machine's.
    pub(super) fn begin(&self) -> Result<Option<InSpace<'_>>, Failure> {
        self.make()?;
        let made = self.made.get().and_then(Option::as_ref);
        Ok(made.map(|points| InSpace { points, moving: Moving::default() }))
    }

    fn make(&self) -> Result<(), Failure> {
        if self.made.get().is_none() {
            let _ = self.made.set(Points::of(self.case, self.cache)?);
        }
        Ok(())
    }
}

impl Points {
    /// Of a machine of its own, which has the same coordinates: points that are watched do not change how bodies are reduced.
    fn of(case: &Case, cache: Option<&Cache>) -> Result<Option<Self>, Failure> {
        let own = Case { fields: None, ..case.clone() };
        let build = |warnings: &mut Vec<String>| -> Result<Option<Self>, Failure> {
            let mut plan = machine::plan(&own, warnings)?;
            let Some(shapes) = Shapes::of_case(&own, &plan, true) else { return Ok(None) };
            let counts: Vec<(usize, usize)> =
                shapes.points().map(|(body, own)| (body, own.count())).collect();
            let mut sorted: Vec<_> = shapes.points().collect();
            sorted.sort_by_key(|own| own.0);
            plan.watch(sorted.into_iter());
            let fields = machine::build(&own, &plan, cache, warnings)?.machine.fields;
            Ok(Some(Points { shapes, fields, counts }))
        };
        // What is to be said of the case has been said.
        build(&mut Vec::new())
    }

    /// The points of each shape.
    fn each(&self) -> impl Iterator<Item = (usize, &[BodyNode])> {
        let mut taken: Vec<usize> = vec![0; self.fields.len()];
        self.counts.iter().filter_map(move |&(body, count)| {
            let field = self.fields.iter().position(|own| own.body == body)?;
            let first = taken[field];
            taken[field] += count;
            Some((body, &self.fields[field].nodes[first..first + count]))
        })
    }
}

impl InSpace<'_> {
    /// Adds a mode in a state, if there is room, whose amplitude says nothing; of a machine whose body `of` has a speed (rad/s).
    pub(super) fn mode(
        &mut self,
        (linear, at): (&LinearMachine, &Standstill),
        mode: &Mode,
        of: Option<(usize, f64)>,
        told: Told,
    ) {
        if self.room() == 0 {
            return self.moving.leave_out(1);
        }
        let whirl = match of.map(|(_, speed)| mode.whirl(speed)) {
            Some(Whirl::Forward) => "forward",
            Some(Whirl::Backward) => "backward",
            _ => "",
        };
        let mut moved = self.moved((linear, at), &mode.shape);
        let largest = moved.iter().flatten().map(size).fold((0.0, 0.0), larger);
        let turned = Complex64::from_polar(1.0 / largest.0.max(f64::MIN_POSITIVE), largest.1);
        moved.iter_mut().flatten().flatten().for_each(|own| *own *= turned);
        let unstable = if mode.grows() { ". It GROWS: the machine is not stable here" } else { "" };
        let way = match whirl {
            "" => linear
                .linearised(at)
                .and_then(|own| linear.way(&own.turning, &own.mass, mode))
                .unwrap_or(Way::Lateral),
            _ => Way::Lateral,
        };
        let how = match way {
            Way::Torsional => "About the axis: torsion".to_owned(),
            Way::Axial => "Along the axis".to_owned(),
            Way::Lateral => told_whirl(whirl, mode.sense),
        };
        let mut told = told;
        if way != Way::Lateral && !told.name.contains(words::way(way)) {
            told.name = format!("{}, {}", told.name, words::way(way));
        }
        self.add(told, format!("{how}{unstable}"), None, &moved);
    }

    /// Adds a response to an order of the rotation of a body, if there is room; phases count from its angle.
    pub(super) fn response(
        &mut self,
        (linear, at): (&LinearMachine, &Standstill),
        shape: &[Complex64],
        of: (usize, f64),
        told: Told,
    ) {
        if self.room() == 0 {
            return self.moving.leave_out(1);
        }
        let moved = self.moved((linear, at), shape);
        let largest = moved.iter().flatten().map(size).fold((0.0, 0.0), larger).0;
        // Of circles in both senses the share that is circular, over all points.
        let orbits = moved.iter().flatten().map(|own| Orbit::new([own[0], own[1]]));
        let (round, all) = orbits.fold((0.0, f64::MIN_POSITIVE), |(round, all), own| {
            let squares = own.major * own.major + own.minor * own.minor;
            (round + 2.0 * own.major * own.minor, all + squares)
        });
        let sense = round / all;
        let with = if of.1 < 0.0 { -sense } else { sense };
        let whirl = match with {
            own if own > CIRCULAR => "forward",
            own if own < -CIRCULAR => "backward",
            _ => "",
        };
        let words = told_whirl(whirl, sense);
        self.add(told, words, Some(largest), &moved);
    }

    fn moved(
        &self,
        (linear, at): (&LinearMachine, &Standstill),
        shape: &[Complex64],
    ) -> Vec<Vec<[Complex64; 3]>> {
        self.points.each().map(|own| linear.moved(at, own, shape)).collect()
    }

    fn add(
        &mut self,
        Told { group, name, rpm, hertz }: Told,
        words: String,
        metres: Option<f64>,
        moved: &[Vec<[Complex64; 3]>],
    ) {
        self.moving.add((group, name, words), (rpm, hertz, metres), moved);
    }

    /// For how many motions more there is room.
    pub(super) fn room(&self) -> usize {
        self.moving.room(self.points.counts.iter().map(|own| own.1).sum())
    }

    /// Counts motions for which there is no room.
    pub(super) fn leave_out(&mut self, motions: usize) {
        self.moving.leave_out(motions);
    }

    /// The file of the analysis; none without any motion.
    pub(super) fn file(self, analysis: &str) -> Option<(String, Vec<u8>)> {
        let json = self.moving.json(&self.points.shapes)?;
        Some((format!("{analysis}{MOTIONS}"), json.into_bytes()))
    }
}

/// Share of a motion that must be circular for its sense to be named.
const CIRCULAR: f64 = 0.1;

/// How a motion goes round, seen along +z with x up and y to the right: what turns from x to y goes clockwise.
fn told_whirl(whirl: &str, sense: f64) -> String {
    let way = if sense > 0.0 { "clockwise" } else { "anticlockwise" };
    match whirl {
        "forward" => format!("Forward whirl, with the rotation: {way} as seen along +z"),
        "backward" => format!("Backward whirl, against the rotation: {way} as seen along +z"),
        _ if sense.abs() > CIRCULAR => format!("It goes round {way} as seen along +z"),
        _ => "To and fro in a plane".to_owned(),
    }
}

/// How far a point gets (m), and the angle (rad) by which its motion is to be turned on so that it is there at first.
fn size(own: &[Complex64; 3]) -> (f64, f64) {
    // |Re(w e^{iφ})|² = (|w|² + Re(w·w e^{2iφ}))/2.
    let squares: f64 = own.iter().map(Complex64::norm_sqr).sum();
    let product: Complex64 = own.iter().map(|own| own * own).sum();
    ((0.5 * (squares + product.norm())).sqrt(), -0.5 * product.arg())
}

fn larger(one: (f64, f64), other: (f64, f64)) -> (f64, f64) {
    if other.0 > one.0 { other } else { one }
}

/// So many of them at most, evenly, both ends among them.
pub(super) fn evenly<T>(all: &[T], most: usize) -> Vec<&T> {
    match all.len() {
        count if count <= most => all.iter().collect(),
        count => (0..most).map(|k| &all[k * (count - 1) / (most - 1)]).collect(),
    }
}
