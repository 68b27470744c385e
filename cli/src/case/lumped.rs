//! One mass on a spring and a damper, between stops.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::spec::law::Acts;
use whirl_specs::Motion;

use super::law::{self, NamedLaw};
use super::library::Shelf;
use super::machine;
use super::reader::Reader;

/// m ẍ + d ẋ + k x = F + m e Ω² cos Ωt + stops, and along y the same with sin Ωt and without F.
#[derive(Debug, Clone)]
pub struct Lumped {
    /// m in kg.
    pub mass: f64,
    /// k in N/m.
    pub stiffness: f64,
    /// d in N·s/m.
    pub damping: f64,
    /// x at t = 0 in m.
    pub displacement: f64,
    /// ẋ at t = 0 in m/s.
    pub velocity: f64,
    /// F in N, constant.
    pub force: f64,
    /// What turns in the mass out of balance.
    pub unbalance: Option<Unbalance>,
    /// How the marcher couples displacement to rotation; of no effect here, since nothing turns.
    pub motion: &'static Motion,
    /// What the mass may hit.
    pub stops: Vec<Stop>,
}

/// The whole mass turning at a constant speed with its centre off the axis.
#[derive(Debug, Clone, Copy)]
pub struct Unbalance {
    /// e in m.
    pub eccentricity: f64,
    /// Ω in rad/s.
    pub speed: f64,
}

/// A stop: h = gap − x above the mass, h = gap + x below it; its force Q(h, ḣ) pushes the mass away. Or one
/// all around, with a law of a ring.
#[derive(Debug, Clone)]
pub struct Stop {
    /// Where it stands.
    pub side: Side,
    /// h at x = 0, in m; 0 around, where the law has the gap.
    pub gap: f64,
    /// Radius of the mass where it slides on the stop, m, for laws that need it.
    pub journal_radius: Option<f64>,
    /// Q(h, ḣ), or more.
    pub law: NamedLaw,
}

/// The side of a mass on which a stop stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Towards greater x.
    Above,
    /// Towards smaller x.
    Below,
    /// In all directions of x and y.
    Around,
}

pub(super) fn read(shelf: Shelf, file: &Reader) -> Option<Lumped> {
    let stop = |stop: Reader| {
        let side = match stop.word("side") {
            Some("around") => Side::Around,
            Some("below") => Side::Below,
            _ => Side::Above,
        };
        let law = law::read(shelf, &stop);
        let gap = gap(&stop, side);
        law.iter().for_each(|law| fits(&stop, side, law));
        let journal_radius = stop.quantity("journal_radius");
        Some(Stop { side, gap, journal_radius, law: law? })
    };
    let stops = file.tables("stop").into_iter().filter_map(stop).collect();
    let mass = file.table("mass")?;
    let or_zero = |key| mass.quantity(key).unwrap_or(0.0);
    Some(Lumped {
        mass: mass.quantity_or_one("mass"),
        stiffness: or_zero("stiffness"),
        damping: or_zero("damping"),
        displacement: or_zero("displacement"),
        velocity: or_zero("velocity"),
        force: or_zero("force"),
        unbalance: mass.table("unbalance").map(|table| Unbalance {
            eccentricity: table.quantity_or_one("eccentricity"),
            speed: table.quantity_or_one("speed"),
        }),
        motion: machine::motion(&mass)?,
        stops,
    })
}

fn gap(stop: &Reader, side: Side) -> f64 {
    if side != Side::Around {
        stop.demand("gap");
        return stop.quantity_or_one("gap");
    }
    if stop.quantity("gap").is_some() {
        let message = "a stop around the mass has no `gap` of its own: it is in its law";
        let help = "leave `gap` out";
        let place = stop.places().remove("gap").unwrap_or_else(|| stop.place().text(""));
        stop.push(place.error_here(Code::BAD_VALUE, message).help(help));
    }
    0.0
}

/// Notes a law of springs around the mass, or one of rings on one side of it.
fn fits(stop: &Reader, side: Side, law: &NamedLaw) {
    let acts = law.source.acts();
    let wanted = if side == Side::Around { Acts::Ring } else { Acts::Spring };
    if acts != wanted {
        let message =
            format!("`{}` is {}, not {}", law.name.text(), acts.called(), wanted.called());
        let help = match side {
            Side::Around => {
                "say `side = \"above\"` or `\"below\"`, or name a law that gives F_x and F_y"
            }
            _ => "say `side = \"around\"`, or name a law that gives Q",
        };
        stop.push(law.name.error_here(Code::BAD_VALUE, message).help(help));
    }
}
