//! The films of all joints: solved where the laws are evaluated, so that for all else a film is a law of a joint.
//!
//! What is known of a film ([`Known`]) is how it was at the end of the last step. In a step it is solved from that on, whatever
//! was evaluated before, so that its forces are a function of the motion and of what is known. Slopes are found when they are
//! asked for.

use super::film_law::motion;
use super::hold::{Hold, LawStates};
use super::placed_law::PlacedLaw;
use super::plane::Plane;
use super::springs::Springs;
use crate::film::{Balance, INPUTS, Journal, JournalMotion, OUTPUTS, Oil, ShapeSlopes, Shapes};

/// A step so short (s) that a film only follows the rates of its gap.
const INSTANT: f64 = 1e-7;
/// What may be lacking at a node, of what flows there: oil of a march is kept to 1e-10.
const BALANCED: f64 = 1e-13;

/// What may be lacking of a temperature in balance, of itself, and after how many trials it is found.
const BALANCED_HEAT: f64 = 1e-11;
const WARMEST: usize = 60;

/// Places of what is known of a film among what is known of all: the oil, the motion, and what is shown.
pub(super) struct Known {
    first: usize,
    oil: usize,
    /// Shapes of the bore.
    shapes: usize,
    shown: usize,
}

impl Known {
    pub(super) fn of(journal: &Journal, shapes: Option<&Shapes>, first: usize) -> Self {
        let film = &journal.film;
        Known {
            first,
            oil: 2 * film.grid.nodes(),
            shapes: shapes.map_or(0, Shapes::count),
            shown: film.openings.len() + film.outputs() + usize::from(journal.heat().is_some()),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.oil + self.moved() + self.shown
    }

    /// Values that say how journal and bore moved: what the film takes, then shapes of the bore and their rates.
    fn moved(&self) -> usize {
        INPUTS + 2 * self.shapes
    }

    pub(super) fn nodes(&self) -> usize {
        self.oil / 2
    }

    pub(super) fn oil<'a>(&self, all: &'a [f64]) -> &'a [f64] {
        &all[self.first..][..self.oil]
    }

    fn motion(&self, all: &[f64]) -> [f64; INPUTS] {
        let own = &all[self.first + self.oil..][..INPUTS];
        own.try_into().expect("as many")
    }

    fn deformed<'a>(&self, all: &'a [f64]) -> [&'a [f64]; 2] {
        let own = &all[self.first + self.oil + INPUTS..][..2 * self.shapes];
        own.split_at(self.shapes).into()
    }

    fn shown<'a>(&self, all: &'a [f64]) -> &'a [f64] {
        &all[self.first + self.oil + self.moved()..][..self.shown]
    }

    /// The temperature of a film that has one (K).
    pub(super) fn temperature(&self, all: &[f64]) -> f64 {
        *self.shown(all).last().expect("its last value")
    }

    /// The same, to be written.
    pub(super) fn temperature_mut<'a>(&self, all: &'a mut [f64]) -> &'a mut f64 {
        let [.., shown] = self.parts(all);
        shown.last_mut().expect("its last value")
    }

    pub(super) fn parts<'a>(&self, all: &'a mut [f64]) -> [&'a mut [f64]; 3] {
        let own = &mut all[self.first..][..self.count()];
        let (oil, rest) = own.split_at_mut(self.oil);
        let (motion, shown) = rest.split_at_mut(self.moved());
        [oil, motion, shown]
    }
}

/// A film at a joint.
pub(super) struct FilmAt {
    /// Which law, and which of its springs.
    pub(super) law: usize,
    pub(super) spring: usize,
    pub(super) known: Known,
    pub(super) oil: Oil,
    pub(super) balance: Balance,
    /// The oil at the beginning of the step.
    begun: Oil,
    /// What it takes, and the length of its step (s).
    pub(super) taken: [f64; INPUTS],
    pub(super) step: Option<f64>,
    /// What enters at its openings (m³/s), then the outputs of its spec, then the temperature of a film that has one (K).
    pub(super) shown: Vec<f64>,
    /// Oil between the surfaces (m³).
    pub(super) volume: f64,
    /// Whether its forces are found, and whether their slopes are.
    pub(super) solved: bool,
    pub(super) sloped: bool,
    /// Nodes that hold oil by the gap itself, as it changes too fast.
    pub(super) fast: usize,
    /// Whether it has a temperature.
    pub(super) heated: bool,
    /// How its bore gives way, where it does.
    pub(super) deformed: Option<DeformedBore>,
}

/// How a bore stands and moves in its shapes, and what its film does to them.
pub(super) struct DeformedBore {
    /// Of every shape how much (m), and its rate (m/s).
    pub(super) taken: [Vec<f64>; 2],
    /// Forces on them (N).
    pub(super) forces: Vec<f64>,
    pub(super) slopes: ShapeSlopes,
}

impl DeformedBore {
    fn new(shapes: &Shapes) -> Self {
        let none = || vec![0.0; shapes.count()];
        DeformedBore { taken: [none(), none()], forces: none(), slopes: ShapeSlopes::new(shapes) }
    }
}

/// All films, and what is known of them.
pub(super) struct Films {
    pub(super) given: LawStates,
    /// Whether films at rest are squeezed by the rates of their gaps. A march that stands still has rates of its rule for time,
    /// which move no surface.
    pub(super) squeezed: bool,
    pub(super) all: Vec<FilmAt>,
}

impl Films {
    pub(super) fn new(springs: &Springs) -> Self {
        let mut first = 0;
        let mut all = Vec::new();
        for (law, placed) in springs.laws.iter().enumerate() {
            let Some(journal) = placed.bound.law.film() else { continue };
            let shapes = placed.shapes.as_ref();
            for spring in 0..placed.springs {
                let known = Known::of(journal, shapes, first);
                first += known.count();
                let oil = Oil::full(&journal.film);
                let mut balance = Balance::new(&journal.film);
                balance.tolerance = BALANCED;
                let nodes = || vec![0.0; journal.film.grid.nodes()];
                balance.motion.deformed = shapes.map(|_| [nodes(), nodes()]);
                all.push(FilmAt {
                    law,
                    spring,
                    shown: vec![0.0; known.shown],
                    known,
                    begun: oil.clone(),
                    oil,
                    balance,
                    taken: [0.0; INPUTS],
                    step: None,
                    volume: 0.0,
                    solved: false,
                    sloped: false,
                    fast: 0,
                    heated: journal.heat().is_some(),
                    deformed: shapes.map(DeformedBore::new),
                });
            }
        }
        Films { given: LawStates::default(), squeezed: false, all }
    }

    /// Takes over what is known.
    pub(super) fn take(&mut self, springs: &Springs, laws: &LawStates) {
        let same = || {
            (self.given.hold, self.given.step) == (laws.hold, laws.step)
                && self.given.films == laws.films
        };
        if self.all.is_empty() || same() {
            return;
        }
        self.given.films.clone_from(&laws.films);
        (self.given.hold, self.given.step) = (laws.hold, laws.step);
        if let Hold::Implicit(_) = laws.hold {
            for own in &mut self.all {
                own.begin(springs.film_of(own.law), springs.shapes_of(own.law), &self.given);
            }
        }
    }
}

impl Springs {
    /// Whether a film is on an arc, as on a pad.
    pub(crate) fn have_arcs(&self) -> bool {
        let arc =
            |own: &PlacedLaw| own.bound.law.film().is_some_and(|own| own.film.grid.arc.is_some());
        self.laws.iter().any(arc)
    }

    pub(super) fn film_of(&self, law: usize) -> &Journal {
        self.laws[law].bound.law.film().expect("a film")
    }

    /// The shapes of the bore of a law's film, where it deforms.
    pub(super) fn shapes_of(&self, law: usize) -> Option<&Shapes> {
        self.laws[law].shapes.as_ref()
    }

    /// As laws begin, and films.
    pub(crate) fn beginning(&self) -> LawStates {
        let mut laws = LawStates::beginning(self.states());
        let count = self.laws.iter().filter_map(|own| {
            let known = Known::of(own.bound.law.film()?, own.shapes.as_ref(), 0);
            Some(own.springs * known.count())
        });
        laws.films = vec![0.0; count.sum()];
        if !laws.films.is_empty() {
            laws.hold = Hold::Start;
        }
        laws
    }
}

impl FilmAt {
    /// Whether it is that of a law at a spring.
    pub(super) fn is_at(&self, law: usize, spring: usize) -> bool {
        (self.law, self.spring) == (law, spring)
    }

    /// Begins a step from what is known.
    fn begin(&mut self, journal: &Journal, shapes: Option<&Shapes>, given: &LawStates) {
        self.begun.read(self.known.oil(&given.films));
        if let Hold::Implicit(weight) = given.hold
            && weight > 0.0
        {
            let deformed = self.known.deformed(&given.films);
            open(&mut self.balance, shapes, deformed, true);
            let motion = motion(&self.known.motion(&given.films), Some(given.step));
            journal.begin(&motion, &self.begun, &mut self.balance);
        }
    }

    /// Solves the film where it stands; its forces, which are no numbers where that fails.
    pub(super) fn solve(
        &mut self,
        (journal, shapes): (&Journal, Option<&Shapes>),
        given: &LawStates,
        squeezed: bool,
    ) -> [f64; OUTPUTS] {
        self.sloped = false;
        self.step = None;
        let steady = motion(&self.taken, None);
        let still = JournalMotion { velocity: [0.0; 2], tilting: [0.0; 2], ..steady };
        let in_step = matches!(given.hold, Hold::Implicit(_));
        let mut temperature = match journal.heat() {
            Some(_) if in_step => self.known.temperature(&given.films),
            Some(heat) => heat.inlet,
            None => 0.0,
        };
        journal.heat_to(temperature, &mut self.balance);
        self.solved = match given.hold {
            Hold::Rest | Hold::Settled(_) => {
                let motion = if squeezed { &steady } else { &still };
                let found = self.rest((journal, shapes), motion, squeezed);
                temperature = found.unwrap_or(f64::NAN);
                found.is_some()
            }
            Hold::Start => self.start((journal, shapes), [&still, &steady]),
            Hold::Implicit(weight) if weight > 0.0 => {
                self.oil.clone_from(&self.begun);
                self.open(shapes, true);
                self.step = Some(given.step);
                self.settle(journal, &JournalMotion { step: self.step, ..steady })
            }
            Hold::Implicit(_) => {
                self.oil.clone_from(&self.begun);
                self.open(shapes, true);
                journal.take(&steady, &self.oil, &mut self.balance);
                true
            }
        };
        let openings = journal.film.openings.len();
        let (flows, outputs) = self.shown.split_at_mut(openings);
        let forces = journal.forces(&mut self.balance, &mut outputs[..journal.film.outputs()]);
        if let (Some(shapes), Some(own)) = (shapes, &mut self.deformed) {
            journal.push(&self.balance, shapes, &mut own.forces);
        }
        if let (Some(heat), Some(last)) = (journal.heat(), outputs.last_mut()) {
            *last = temperature;
            if let Hold::Implicit(weight) = given.hold
                && weight > 0.0
            {
                let warming = journal.warming(&mut self.balance, outputs);
                outputs[journal.film.outputs()] = heat.after(temperature, &warming, given.step);
            }
        }
        self.volume = self.balance.oil(&journal.film);
        if given.hold == Hold::Implicit(0.0) {
            flows.copy_from_slice(&self.known.shown(&given.films)[..openings]);
        } else {
            for (opening, flow) in flows.iter_mut().enumerate() {
                *flow = self.balance.inflow(&journal.film, opening);
            }
        }
        if self.solved { forces } else { [f64::NAN; OUTPUTS] }
    }

    /// Solves the film as it is after a long time, at the temperature that balances its heat: that (K), or 0 of a film without one; none
    /// where that fails.
    fn rest(
        &mut self,
        (journal, shapes): (&Journal, Option<&Shapes>),
        motion: &JournalMotion,
        squeezed: bool,
    ) -> Option<f64> {
        self.oil = Oil::full(&journal.film);
        self.open(shapes, squeezed);
        if !self.settle(journal, motion) {
            return None;
        }
        let Some(heat) = journal.heat() else { return Some(0.0) };
        // The loss falls with the temperature, so that what would balance it less what it is has one zero.
        let mut outputs = vec![0.0; journal.film.outputs()];
        let mut lacks = |own: &mut Self, temperature: f64| -> Option<f64> {
            journal.heat_to(temperature, &mut own.balance);
            let found = own.settle(journal, motion);
            journal.forces(&mut own.balance, &mut outputs);
            let warming = journal.warming(&mut own.balance, &outputs);
            Some(heat.balanced(&warming) - temperature).filter(|lack| found && lack.is_finite())
        };
        let mut low = (heat.inlet, lacks(self, heat.inlet)?);
        let mut high = (low.0 + low.1, 0.0);
        high.1 = lacks(self, high.0)?;
        let mut last = high;
        for _ in 0..WARMEST {
            if last.1.abs() <= BALANCED_HEAT * last.0 {
                return Some(last.0);
            }
            let secant = high.0 - high.1 * (high.0 - low.0) / (high.1 - low.1);
            let next = if secant.is_finite() { secant } else { 0.5 * (low.0 + high.0) };
            last = (next, lacks(self, next)?);
            // The side that stays counts half, so that both ends come near.
            if (last.1 > 0.0) == (high.1 > 0.0) {
                low.1 *= 0.5;
            } else {
                low = high;
            }
            high = last;
        }
        None
    }

    fn settle(&mut self, journal: &Journal, motion: &JournalMotion) -> bool {
        let found = journal.settle(motion, &mut self.oil, &mut self.balance);
        self.fast = self.balance.fast();
        found.is_ok()
    }

    /// Puts to the nodes how the bore has given way, and how it moves if that counts.
    fn open(&mut self, shapes: Option<&Shapes>, moves: bool) {
        if let Some(own) = &self.deformed {
            let [by, rates] = &own.taken;
            open(&mut self.balance, shapes, [by, rates], moves);
        }
    }

    /// Whether the bore moves in its shapes.
    fn gives_way(&self) -> bool {
        self.deformed.as_ref().is_some_and(|own| own.taken[1].iter().any(|rate| *rate != 0.0))
    }

    /// As a machine begins: full as if it had been there for long, then with the rates of its gap.
    fn start(
        &mut self,
        (journal, shapes): (&Journal, Option<&Shapes>),
        [still, steady]: [&JournalMotion; 2],
    ) -> bool {
        self.oil = Oil::full(&journal.film);
        self.open(shapes, false);
        let found = self.settle(journal, still);
        if !found || still == steady && !self.gives_way() {
            return found;
        }
        self.step = Some(INSTANT);
        journal.begin(&JournalMotion { step: self.step, ..*still }, &self.oil, &mut self.balance);
        self.open(shapes, true);
        self.settle(journal, &JournalMotion { step: self.step, ..*steady })
    }
}

/// Opens the gap of a film where its bore has so much of every shape, and opens it further as fast as these say, if that counts.
fn open(balance: &mut Balance, shapes: Option<&Shapes>, [by, rates]: [&[f64]; 2], moves: bool) {
    let (Some(shapes), Some([opened, opening])) = (shapes, &mut balance.motion.deformed) else {
        return;
    };
    shapes.open(by, opened);
    if moves {
        shapes.open(rates, opening);
    } else {
        opening.fill(0.0);
    }
}

impl Springs {
    /// The planes of all films.
    pub(crate) fn planes_of_films(&self) -> impl Iterator<Item = &Plane> {
        let with_film = |plane: &&Plane| self.laws[plane.law].bound.law.film().is_some();
        self.planes.iter().filter(with_film)
    }

    /// Of each of them the temperatures (K) between which its viscosity is known.
    pub(crate) fn known_viscosities(&self) -> impl Iterator<Item = [f64; 2]> {
        self.planes_of_films().map(|plane| {
            let film = self.laws[plane.law].bound.law.film();
            let heat = film.and_then(|own| own.heat());
            heat.map_or([0.0, f64::INFINITY], |own| own.viscosity.known())
        })
    }
}
