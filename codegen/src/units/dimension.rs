//! What a quantity measures: exponents of the SI base quantities, and of the angle.

use std::fmt;

use num_rational::Ratio;
use num_traits::{CheckedAdd, CheckedMul, CheckedSub, One, Zero};

/// An exponent of a unit: rational, as in N/mm^1.5.
pub type Exponent = Ratio<i32>;

const fn exponent(n: i32) -> Exponent {
    Exponent::new_raw(n, 1)
}

/// Exponents of m, kg, s, K, A and rad. The angle is a number in SI; it is kept to tell rotation from
/// frequency, and ignored wherever other dimensions stand beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension {
    exponents: [Exponent; ALL],
}

const MASS: usize = 1;
const CURRENT: usize = 4;
const ANGLE: usize = 5;
const BASE_NAMES: [&str; ALL] = ["m", "kg", "s", "K", "A", "rad"];
/// How many there are, and those that are no angles.
const ALL: usize = 6;
pub(crate) const BASES: usize = 5;

impl Dimension {
    /// A pure number.
    pub const NUMBER: Dimension = Dimension::of(0, 0, 0);
    /// m.
    pub const LENGTH: Dimension = Dimension::of(1, 0, 0);
    /// m².
    pub(crate) const AREA: Dimension = Dimension::of(2, 0, 0);
    /// kg.
    pub const MASS: Dimension = Dimension::of(0, 1, 0);
    /// s.
    pub const TIME: Dimension = Dimension::of(0, 0, 1);
    /// K.
    pub const TEMPERATURE: Dimension = Dimension::of(0, 0, 0).with(3, 1);
    /// A.
    pub const CURRENT: Dimension = Dimension::of(0, 0, 0).with(CURRENT, 1);
    /// V.
    pub const VOLTAGE: Dimension = Dimension::of(2, 1, -3).with(CURRENT, -1);
    /// Ω.
    pub const RESISTANCE: Dimension = Dimension::of(2, 1, -3).with(CURRENT, -2);
    /// H.
    pub const INDUCTANCE: Dimension = Dimension::of(2, 1, -2).with(CURRENT, -2);
    /// Wb.
    pub const FLUX: Dimension = Dimension::of(2, 1, -2).with(CURRENT, -1);
    /// T.
    pub const FLUX_DENSITY: Dimension = Dimension::of(0, 1, -2).with(CURRENT, -1);
    /// rad.
    pub const ANGLE: Dimension = Dimension::of(0, 0, 0).with(ANGLE, 1);
    /// rad/s.
    pub const ANGULAR_SPEED: Dimension = Dimension::of(0, 0, -1).with(ANGLE, 1);
    /// Hz.
    pub const FREQUENCY: Dimension = Dimension::of(0, 0, -1);
    /// m/s.
    pub const SPEED: Dimension = Dimension::of(1, 0, -1);
    /// m/s².
    pub const ACCELERATION: Dimension = Dimension::of(1, 0, -2);
    /// N.
    pub const FORCE: Dimension = Dimension::of(1, 1, -2);
    /// N·m.
    pub const TORQUE: Dimension = Dimension::of(2, 1, -2);
    /// N/m.
    pub const STIFFNESS: Dimension = Dimension::of(0, 1, -2);
    /// N·s/m.
    pub const DAMPING: Dimension = Dimension::of(0, 1, -1);
    /// Pa.
    pub const PRESSURE: Dimension = Dimension::of(-1, 1, -2);
    /// Pa·s.
    pub const VISCOSITY: Dimension = Dimension::of(-1, 1, -1);
    /// kg/m³.
    pub const DENSITY: Dimension = Dimension::of(-3, 1, 0);
    /// J/(kg·K).
    pub const HEAT_CAPACITY: Dimension = Dimension::of(2, 0, -2).with(3, -1);
    /// J/K.
    pub const HELD_HEAT: Dimension = Dimension::of(2, 1, -2).with(3, -1);
    /// W/K.
    pub const HEAT_FLOW: Dimension = Dimension::of(2, 1, -3).with(3, -1);
    /// rad/s².
    pub const ANGULAR_ACCELERATION: Dimension = Dimension::of(0, 0, -2).with(ANGLE, 1);
    /// W.
    pub const POWER: Dimension = Dimension::of(2, 1, -3);
    /// N·m·s, of a damper between two rotations.
    pub const TORSIONAL_DAMPING: Dimension = Dimension::of(2, 1, -1);
    /// kg·m².
    pub const INERTIA: Dimension = Dimension::of(2, 1, 0);

    const fn of(length: i32, mass: i32, time: i32) -> Self {
        let mut exponents = [exponent(0); ALL];
        (exponents[0], exponents[1], exponents[2]) =
            (exponent(length), exponent(mass), exponent(time));
        Dimension { exponents }
    }

    const fn with(mut self, base: usize, n: i32) -> Self {
        self.exponents[base] = exponent(n);
        self
    }

    /// The base units with their exponents: m, kg, s, K, A and rad.
    pub fn exponents(&self) -> [(&'static str, Exponent); ALL] {
        std::array::from_fn(|base| (BASE_NAMES[base], self.exponents[base]))
    }

    /// The exponents of m, kg, s, K and A.
    pub(crate) fn bases(&self) -> [Exponent; BASES] {
        std::array::from_fn(|base| self.exponents[base])
    }

    /// Of a product; `None` if its exponents are beyond all use.
    pub(crate) fn checked_times(&self, other: &Dimension) -> Option<Dimension> {
        self.joined(other, CheckedAdd::checked_add)
    }

    /// Of a quotient; `None` if its exponents are beyond all use.
    pub(crate) fn checked_over(&self, other: &Dimension) -> Option<Dimension> {
        self.joined(other, CheckedSub::checked_sub)
    }

    /// Of a power; `None` if its exponents are beyond all use.
    pub(crate) fn checked_power(&self, exponent: Exponent) -> Option<Dimension> {
        let other = Dimension { exponents: [exponent; ALL] };
        self.joined(&other, CheckedMul::checked_mul)
    }

    fn joined(
        &self,
        other: &Dimension,
        join: fn(&Exponent, &Exponent) -> Option<Exponent>,
    ) -> Option<Dimension> {
        let mut joined = *self;
        for (e, other) in joined.exponents.iter_mut().zip(&other.exponents) {
            *e = join(e, other)?;
        }
        joined.is_sane().then_some(joined)
    }

    /// Of a product of units in use.
    pub(crate) fn times(&self, other: &Dimension) -> Dimension {
        let exponents = std::array::from_fn(|i| self.exponents[i] + other.exponents[i]);
        Dimension { exponents }
    }

    /// Of a quotient of units in use.
    pub(crate) fn over(&self, other: &Dimension) -> Dimension {
        let exponents = std::array::from_fn(|i| self.exponents[i] - other.exponents[i]);
        Dimension { exponents }
    }

    /// Of a power of a unit in use.
    pub(crate) fn power(&self, exponent: Exponent) -> Dimension {
        Dimension { exponents: self.exponents.map(|e| e * exponent) }
    }

    /// Whether the largest exponent and denominator are small enough to go on computing with.
    pub(crate) fn is_sane(&self) -> bool {
        const LARGEST: u32 = 1000;
        let small =
            |e: &Exponent| e.numer().unsigned_abs() <= LARGEST && *e.denom() <= LARGEST as i32;
        self.exponents.iter().all(small)
    }

    /// The same dimension with angles as pure numbers, as formulas see it.
    pub(crate) fn without_angle(&self) -> Dimension {
        self.with(ANGLE, 0)
    }

    /// Whether a quantity of this dimension may stand where `wanted` is expected: equal, where angles
    /// count only if nothing but time stands beside them (rpm is not Hz, but N·m/rad is N·m).
    pub fn fits(&self, wanted: &Dimension) -> bool {
        let rotation = [0, 1, 3, CURRENT].iter().all(|&base| self.exponents[base].is_zero());
        if rotation { self == wanted } else { self.without_angle() == wanted.without_angle() }
    }

    fn known(&self) -> Option<(&'static str, &'static str)> {
        KNOWN
            .iter()
            .find(|(dimension, _, _)| dimension == self)
            .or_else(|| KNOWN.iter().find(|(d, _, _)| *d == self.without_angle()))
            .map(|(_, name, example)| (*name, *example))
    }

    /// A quantity of this dimension, such as `1 mm` for a length.
    pub fn example(&self) -> Option<String> {
        self.known().map(|(_, example)| example.to_owned())
    }

    /// SI unit of this dimension, such as `kg/m^3` or `N/m^(3/2)`; `1` for a number.
    pub fn si_unit(&self) -> String {
        if let Some((_, symbol)) = SYMBOLS.iter().find(|(dimension, _)| dimension == self) {
            return (*symbol).to_owned();
        }
        // With the newton in place of the kilogram where that is shorter: N/m^(3/2), not kg/m^(1/2)/s^2.
        let newtons = self.exponents[MASS];
        let rest = self.over(&Dimension::FORCE.power(newtons));
        let length = |e: &Exponent| f64::from(*e.numer()).abs() / f64::from(*e.denom());
        let size = |d: &Dimension| d.exponents.iter().map(length).sum::<f64>();
        let (newtons, rest) = match size(&rest) + length(&newtons) < size(self) {
            true => (newtons, rest),
            false => (Exponent::zero(), *self),
        };
        let parts =
            std::iter::once(("N", newtons)).chain(BASE_NAMES.into_iter().zip(rest.exponents));
        let part = |sign: i32| -> Vec<String> {
            let wanted = |e: &Exponent| e.numer().signum() == sign;
            parts
                .clone()
                .filter(|(_, e)| wanted(e))
                .map(|(name, e)| match e * sign {
                    e if e.is_one() => name.to_owned(),
                    e if e.is_integer() => format!("{name}^{e}"),
                    e => format!("{name}^({e})"),
                })
                .collect()
        };
        let (above, below) = (part(1), part(-1));
        let mut text = if above.is_empty() { "1".to_owned() } else { above.join("*") };
        for unit in below {
            text.push('/');
            text.push_str(&unit);
        }
        text
    }
}

/// With an article: "a length", "an angular speed", "a quantity in m^2*s".
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.known() {
            Some((name, _)) => f.write_str(name),
            None => write!(f, "a quantity in {}", self.si_unit()),
        }
    }
}

const KNOWN: &[(Dimension, &str, &str)] = &[
    (Dimension::NUMBER, "a number without unit", "0.3"),
    (Dimension::LENGTH, "a length", "1 mm"),
    (Dimension::AREA, "an area", "1 mm^2"),
    (Dimension::MASS, "a mass", "1 kg"),
    (Dimension::TIME, "a time", "1 ms"),
    (Dimension::TEMPERATURE, "a temperature", "293 K"),
    (Dimension::ANGLE, "an angle", "30 deg"),
    (Dimension::ANGULAR_SPEED, "an angular speed", "4500 rpm"),
    (Dimension::FREQUENCY, "a frequency", "50 Hz"),
    (Dimension::SPEED, "a speed", "1 m/s"),
    (Dimension::ACCELERATION, "an acceleration", "9.81 m/s^2"),
    (Dimension::FORCE, "a force", "1000 N"),
    (Dimension::TORQUE, "a torque", "109 N*m"),
    (Dimension::STIFFNESS, "a stiffness", "1e8 N/m"),
    (Dimension::DAMPING, "a damping", "100 N*s/m"),
    (Dimension::PRESSURE, "a pressure", "200 GPa"),
    (Dimension::VISCOSITY, "a viscosity", "0.02 Pa*s"),
    (Dimension::DENSITY, "a density", "7860 kg/m^3"),
    (Dimension::HEAT_CAPACITY, "a heat capacity of a substance", "1950 J/kg/K"),
    (Dimension::HELD_HEAT, "a heat capacity", "50 J/K"),
    (Dimension::HEAT_FLOW, "a heat flow over a temperature", "5 W/K"),
    (Dimension::INERTIA, "a moment of inertia", "1 kg*m^2"),
    (Dimension::ANGULAR_ACCELERATION, "an angular acceleration", "600 rpm/s"),
    (Dimension::CURRENT, "a current", "5 A"),
    (Dimension::VOLTAGE, "a voltage", "150 V"),
    (Dimension::RESISTANCE, "a resistance", "0.5 Ohm"),
    (Dimension::INDUCTANCE, "an inductance", "10 mH"),
    (Dimension::FLUX, "a magnetic flux", "1 Wb"),
    (Dimension::FLUX_DENSITY, "a magnetic flux density", "1.2 T"),
];

const SYMBOLS: &[(Dimension, &str)] = &[
    (Dimension::FREQUENCY, "1/s"),
    (Dimension::FORCE, "N"),
    (Dimension::TORQUE, "N*m"),
    (Dimension::STIFFNESS, "N/m"),
    (Dimension::DAMPING, "N*s/m"),
    (Dimension::PRESSURE, "Pa"),
    (Dimension::VISCOSITY, "Pa*s"),
    (Dimension::VOLTAGE, "V"),
    (Dimension::RESISTANCE, "Ohm"),
    (Dimension::INDUCTANCE, "H"),
    (Dimension::FLUX, "Wb"),
    (Dimension::FLUX_DENSITY, "T"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_spelt_so_that_they_can_be_read_back() {
        let half = Exponent::new(3, 2);
        let hertz = Dimension::FORCE.over(&Dimension::LENGTH.power(half));
        assert_eq!(hertz.si_unit(), "N/m^(3/2)");
        let moment = Dimension::FORCE.times(&Dimension::LENGTH.power(Exponent::new(1, 2)));
        assert_eq!(moment.si_unit(), "N*m^(1/2)");
        assert_eq!(Dimension::FORCE.times(&Dimension::TIME).si_unit(), "N*s");
        for dimension in
            [hertz, moment, Dimension::DENSITY, Dimension::ANGULAR_SPEED, Dimension::DAMPING]
        {
            let unit = super::super::Unit::parse(&dimension.si_unit()).unwrap();
            assert_eq!(*unit.dimension(), dimension);
            assert!(unit.factor().is_one());
        }
    }
}
