//! One mass on a spring and a damper, between stops.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{Acts, BearingValue, Parameter};
use whirl_codegen::rational::{Rational, nearest};
use whirl_codegen::units::Quantity;
use whirl_specs::Motion;

use super::gravity::{self, Gravity};
use super::law::{self, LawSource, NamedLaw};
use super::library::FileStore;
use super::machine;
use super::parameters::{self, BearingFacts, Keys};

/// m ẍ + d ẋ + k x = F + m e Ω² cos Ωt + stops, and along y the same with sin Ωt and without F.
#[derive(Debug, Clone)]
pub(crate) struct Lumped {
    /// m in kg.
    pub(crate) mass: f64,
    /// k in N/m.
    pub(crate) stiffness: f64,
    /// d in N·s/m.
    pub(crate) damping: f64,
    /// x at t = 0 in m.
    pub(crate) displacement: f64,
    /// ẋ at t = 0 in m/s.
    pub(crate) velocity: f64,
    /// F in N, constant.
    pub(crate) force: f64,
    /// What turns in the mass out of balance.
    pub(crate) unbalance: Option<Unbalance>,
    /// How displacement is coupled to rotation; without effect here: the mass moves in the fixed frame, and turns, if it
    /// is out of balance, at its given speed.
    pub(crate) motion: &'static Motion,
    /// What the mass may hit.
    pub(crate) stops: Vec<Stop>,
    /// Gravity, if there is any.
    pub(crate) gravity: Option<Gravity>,
}

/// The whole mass turning at a constant speed with its centre off the axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unbalance {
    /// e in m.
    pub(crate) eccentricity: f64,
    /// Ω in rad/s.
    pub(crate) speed: f64,
}

/// A stop: h = gap − x above the mass, h = gap + x below it; its force Q(h, ḣ) pushes the mass away. Or one
/// all around, with a law of a ring.
#[derive(Debug, Clone)]
pub(crate) struct Stop {
    /// Where it stands.
    pub(crate) side: Side,
    /// h at x = 0, in m; around, the radial clearance of the law, 0 if it does not say which that is.
    pub(crate) gap: f64,
    /// Radius of the mass where it runs in the stop, in m, if the case says it.
    pub(crate) journal_radius: Option<f64>,
    /// Q(h, ḣ), or more, with the values that the case gives it.
    pub(crate) law: LawSource,
    /// The value of the key `law`.
    pub(crate) law_name: Located,
}

/// The side of a mass on which a stop stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// Towards greater x.
    Above,
    /// Towards smaller x.
    Below,
    /// In all directions of x and y.
    Around,
}

pub(super) fn read(store: FileStore, file: &Table) -> Option<Lumped> {
    let stops = file.tables("stop").into_iter();
    let stops = stops.filter_map(|table| table.read(|table| stop(store, table))).collect();
    let gravity = gravity::read(file);
    file.optional_table("mass")?.read(|mass| read_mass(mass, stops, gravity))
}

fn read_mass(mass: &Table, stops: Vec<Stop>, gravity: Option<Gravity>) -> Option<Lumped> {
    let or_zero = |key| mass.quantity(key).unwrap_or(0.0);
    Some(Lumped {
        mass: mass.quantity_or_one("mass"),
        stiffness: or_zero("stiffness"),
        damping: or_zero("damping"),
        displacement: or_zero("displacement"),
        velocity: or_zero("velocity"),
        force: or_zero("force"),
        unbalance: mass.in_table("unbalance", |table| Unbalance {
            eccentricity: table.quantity_or_one("eccentricity"),
            speed: table.quantity_or_one("speed"),
        }),
        motion: machine::motion(mass)?,
        stops,
        gravity,
    })
}

/// On which side a stop stands.
pub(super) fn side(table: &Table) -> Side {
    match table.optional_word("side") {
        Some("around") => Side::Around,
        Some("below") => Side::Below,
        _ => Side::Above,
    }
}

/// What messages call the values of a stop.
const KEYS: Keys = Keys { clearance: "gap" };

fn stop(store: FileStore, table: &Table) -> Option<Stop> {
    let side = side(table);
    let law = law::read(store, table);
    let set = parameters::read(table);
    let exactly = |key| table.exact_quantity(key).as_ref().map(parameters::exactly);
    let mut facts = BearingFacts {
        journal_radius: exactly("journal_radius"),
        length: exactly("length"),
        springs: Some(1),
        ..BearingFacts::default()
    };
    let gap = table.exact_quantity("gap");
    match (side, &law) {
        (Side::Around, Some(law)) => facts.radial_clearance = around(table, law, gap.as_ref()),
        (Side::Around, None) => {}
        (Side::Above | Side::Below, _) => table.demand("gap"),
    }
    let law = law?;
    let before = table.errors();
    fits(table, side, &law);
    parameters::check(table, &law, &set, KEYS, &mut facts);
    if table.errors() > before {
        return None;
    }
    let used = match law.used(&set, &facts) {
        Ok(used) => used,
        Err(errors) => {
            errors.into_iter().for_each(|error| table.push(error));
            return None;
        }
    };
    let gap = match side {
        Side::Around => clearance_of(&used),
        Side::Above | Side::Below => gap.map_or(1.0, |gap| gap.si()),
    };
    let journal_radius = facts.journal_radius.as_ref().map(nearest);
    Some(Stop { side, gap, journal_radius, law: used, law_name: law.name })
}

/// The radial clearance that the case gives the law of a ring, in m; a `gap` that the law has no use for is
/// noted.
pub(super) fn around(table: &Table, law: &NamedLaw, gap: Option<&Quantity>) -> Option<Rational> {
    let gap = gap?;
    // That a law of springs cannot stand all around, is noted elsewhere.
    if law.source.acts() != Acts::Ring {
        return None;
    }
    let of = |parameter: &Parameter| {
        matches!(
            parameter.bearing,
            Some(BearingValue::RadialClearance | BearingValue::DiametralClearance)
        )
    };
    let (message, help) = if !law.source.parameters().iter().any(of) {
        let message = "a stop all around has no `gap` of its own: it is in its law";
        let help = "leave `gap` out; or mark in the law which of its parameters is the gap: \
                    `bearing = \"radial_clearance\"`";
        (message, help)
    } else if gap.si() <= 0.0 {
        ("`gap` must be greater than zero all around", "such as `gap = \"35 um\"`")
    } else {
        return Some(parameters::exactly(gap));
    };
    table.push(table.written("gap").error_here(Code::BAD_VALUE, message).help(help));
    None
}

/// The radial clearance of a law in m, 0 if no parameter is said to be one.
fn clearance_of(law: &LawSource) -> f64 {
    let si = |parameter: &Parameter| {
        let factor = parameter.unit.rational()?;
        let value = &parameter.written * factor;
        match parameter.bearing? {
            BearingValue::RadialClearance => Some(nearest(&value)),
            BearingValue::DiametralClearance => Some(nearest(&(value / Rational::from(2)))),
            _ => None,
        }
    };
    law.parameters().iter().find_map(si).unwrap_or(0.0)
}

/// Notes a law of springs around the mass, or one of rings on one side of it.
pub(super) fn fits(stop: &Table, side: Side, law: &NamedLaw) {
    let acts = law.source.acts();
    let wanted = if side == Side::Around { Acts::Ring } else { Acts::Spring };
    if acts != wanted {
        let message =
            format!("`{}` is {}, not {}", law.name.text(), acts.called(), wanted.called());
        let help = match side {
            Side::Around => {
                "write `side = \"above\"` or `\"below\"`, or name a law that gives F_x and F_y"
            }
            _ => "write `side = \"around\"`, or name a law that gives Q",
        };
        stop.push(law.name.error_here(Code::BAD_VALUE, message).help(help));
    }
}
