//! One mass on a spring and a damper, between stops.

use whirl_specs::Motion;

use super::law::{self, NamedLaw};
use super::library::Shelf;
use super::machine;
use super::reader::{DAMPING, FORCE, MASS, POSITION, Reader, STIFFNESS, VELOCITY};

/// m ẍ + d ẋ + k x = F + stops.
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
    /// How the marcher couples displacement to rotation; of no effect here, since nothing turns.
    pub motion: &'static Motion,
    /// What the mass may hit.
    pub stops: Vec<Stop>,
}

/// A stop: h = gap − x above the mass, h = gap + x below it; its force Q(h, ḣ) pushes the mass away.
#[derive(Debug, Clone)]
pub struct Stop {
    /// Where it stands.
    pub side: Side,
    /// h at x = 0, in m.
    pub gap: f64,
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
}

pub(super) fn read(shelf: Shelf, file: &Reader) -> Option<Lumped> {
    let stop = |stop: Reader| {
        let side = stop.choice("side", &[("above", Side::Above), ("below", Side::Below)]);
        let gap = stop.needed("gap", &POSITION);
        let law = law::read(shelf, &stop);
        if law.is_none() && !stop.has("law") {
            stop.absent("law", "add `law = \"my.law.toml\"`");
        };
        Some(Stop { side: side.unwrap_or(Side::Above), gap, law: law? })
    };
    let stops = file.tables("stop").into_iter().filter_map(stop).collect();
    let mass = file.needed_table("mass")?;
    let or_zero = |key: &'static str, kind| mass.quantity(key, kind).unwrap_or(0.0);
    Some(Lumped {
        mass: mass.needed("mass", &MASS),
        stiffness: or_zero("stiffness", &STIFFNESS),
        damping: or_zero("damping", &DAMPING),
        displacement: or_zero("displacement", &POSITION),
        velocity: or_zero("velocity", &VELOCITY),
        force: or_zero("force", &FORCE),
        motion: machine::motion(&mass)?,
        stops,
    })
}
