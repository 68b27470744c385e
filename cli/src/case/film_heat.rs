//! The temperature of a film, as cases say it: balanced with what heats and cools it, or given.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::document::schema::Shape::{Number, Text, Tuple};
use whirl_codegen::document::schema::{Key, key, needed};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Dimension;
use whirl_solver::film::{Heat, Viscosity};

use super::columns::{self, Columns};
use super::library::FileStore;
use super::shapes::{HEAT_CAPACITY, HEAT_FLOW, HELD_HEAT, OIL_DENSITY, TEMPERATURE};

/// The table `heat` of a film.
pub(super) const HEAT: &[Key] = &[
    needed(
        "inlet",
        TEMPERATURE,
        "of the oil that enters, and that at which it has the viscosity `mu_0`",
    ),
    key("vogel", Tuple(&TEMPERATURE, 2), VOGEL).like("[\"178.15 K\", \"797.7 K\"]"),
    key(
        "viscosity",
        Text,
        "a file in place of `vogel`: columns `temperature [K], viscosity [mPa*s]`",
    )
    .like("\"oil.csv\""),
    key("density", OIL_DENSITY, "of the oil; 870 kg/m^3 if left out"),
    key("heat_capacity", HEAT_CAPACITY, "of the oil; 1950 J/kg/K if left out"),
    key("share", Number, "of the loss that heats the oil; 1 if left out").like("0.8"),
    key("housing", HEAT_FLOW, "heat that the housing takes a kelvin; none if left out: adiabatic"),
    key("housing_temperature", TEMPERATURE, "of the housing; that of the inlet if left out"),
    key(
        "metal",
        HELD_HEAT,
        "heat capacity of the metal that warms up with the film; none if left out",
    ),
    key("temperature", TEMPERATURE, "given, in place of all that heats and cools"),
];

const VOGEL: &str = "T_v and B of the viscosity mu_0 exp(B/(T - T_v) - B/(T_in - T_v))";

/// Of mineral oil: kg/m³, J/(kg·K).
const DENSITY: f64 = 870.0;
const CAPACITY: f64 = 1950.0;
/// Keys that say what heats and cools.
const BALANCE: [&str; 6] =
    ["density", "heat_capacity", "share", "housing", "housing_temperature", "metal"];

/// The table `heat` of a film.
#[derive(Debug, Clone)]
pub(super) struct HeatTable {
    /// Where it is.
    pub(super) place: Located,
    law: Law,
    inlet: f64,
    carried: f64,
    share: f64,
    housing: [f64; 2],
    metal: f64,
    /// The temperature, if it is given (K).
    given: Option<f64>,
}

#[derive(Debug, Clone)]
enum Law {
    /// T_v and B (K).
    Vogel([f64; 2]),
    Rows(Arc<Columns>),
}

impl HeatTable {
    pub(super) fn read(store: FileStore, table: &Table) -> Option<Self> {
        let place = table.heading().text("heat");
        let inlet = table.quantity("inlet");
        let vogel = table.quantity_pair("vogel");
        let measures: [&[Dimension]; 2] = [&[Dimension::TEMPERATURE], &[Dimension::VISCOSITY]];
        let rows = columns::read(store, table, "viscosity", measures);
        let given = table.quantity("temperature");
        let or = |key: &str, usual: f64| table.quantity(key).unwrap_or(usual);
        let density = or("density", DENSITY);
        let carried = density * or("heat_capacity", CAPACITY);
        let share = table.optional_number("share").map_or(1.0, |(own, _)| nearest(&own));
        let taken = or("housing", 0.0);
        let around = table.quantity("housing_temperature").or(inlet);
        let metal = or("metal", 0.0);
        let refuse = |key: &str, message: String, help: &str| {
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        };
        if !(0.0..=1.0).contains(&share) {
            let message = "`share` is a part of the loss, from 0 to 1".to_owned();
            refuse("share", message, "such as `share = 0.8`");
        }
        if table.gives("temperature")
            && let Some(key) = BALANCE.into_iter().find(|key| table.gives(key))
        {
            let message =
                format!("`{key}` is of the balance of heat, and the `temperature` is given");
            refuse(key, message, "leave one of both out");
        }
        if table.gives("housing_temperature") && !table.gives("housing") {
            let message = "without `housing` nothing flows to the housing".to_owned();
            refuse(
                "housing_temperature",
                message,
                "add such as `housing = \"5 W/K\"`, or leave it out",
            );
        }
        let law = match (table.gives("vogel"), table.gives("viscosity")) {
            (true, true) => {
                let message = "`viscosity` is in a file and by `vogel`".to_owned();
                refuse("viscosity", message, "leave one of both out");
                None
            }
            (false, false) => {
                table.absent(
                    "vogel",
                    "add `vogel = [\"178.15 K\", \"797.7 K\"]`, or `viscosity = \"oil.csv\"`",
                );
                None
            }
            (true, false) => vogel.map(Law::Vogel),
            (false, true) => rows.map(Law::Rows),
        };
        if let (Some(Law::Vogel([bound, _])), Some(inlet)) = (&law, inlet)
            && *bound >= inlet.min(given.unwrap_or(inlet))
        {
            let message = "at the first temperature of `vogel` the viscosity has no bound: it is below all others".to_owned();
            refuse("vogel", message, "such as `vogel = [\"178.15 K\", \"797.7 K\"]`");
            return None;
        }
        if let Some(Law::Rows(own)) = &law
            && let Some(row) = own.rows.iter().position(|row| !(row[1] > 0.0))
        {
            let message =
                format!("row {} of `{}` has no viscosity above zero", row + 1, own.name.text());
            refuse("viscosity", message, "correct the file");
            return None;
        }
        if let Some(Law::Rows(own)) = &law
            && let Some(row) = own.rows.iter().position(|row| !(row[0] > 0.0))
        {
            let message = format!(
                "row {} of `{}` has no temperature above zero: kelvins count from there",
                row + 1,
                own.name.text()
            );
            refuse("viscosity", message, "add 273.15 to degrees Celsius");
            return None;
        }
        let (law, inlet) = (law?, inlet?);
        let housing = [taken, around.unwrap_or(inlet)];
        Some(HeatTable { place, law, inlet, carried, share, housing, metal, given })
    }

    /// Whether the viscosity comes from a file, and not from `mu_0`.
    pub(super) fn has_rows(&self) -> bool {
        matches!(self.law, Law::Rows(_))
    }

    /// Its temperature, if that is given (K).
    pub(super) fn given(&self) -> Option<f64> {
        self.given
    }

    /// The heat of a film that has this viscosity (Pa·s) at the inlet.
    pub(super) fn heat(&self, mu: f64) -> Heat {
        let viscosity = match &self.law {
            Law::Vogel([bound, b]) => Viscosity::Vogel([mu, self.inlet, *bound, *b]),
            Law::Rows(own) => Viscosity::Table(own.rows.clone()),
        };
        let HeatTable { inlet, carried, share, housing, metal, .. } = *self;
        Heat { viscosity, inlet, carried, share, housing, metal }
    }

    /// For people.
    pub(super) fn described(&self) -> String {
        let kelvin = |own: f64| whirl_text::rounded(own, 5);
        match self.given {
            Some(own) => format!("at {} K, given", kelvin(own)),
            None if self.housing[0] == 0.0 => {
                format!(
                    "its temperature is balanced, adiabatic, with oil from {} K",
                    kelvin(self.inlet)
                )
            }
            None => format!(
                "its temperature is balanced, with oil from {} K and a housing at {} K",
                kelvin(self.inlet),
                kelvin(self.housing[1])
            ),
        }
    }

    /// All numbers, by which films are told apart.
    pub(super) fn numbers(&self) -> String {
        format!("{:?} {:?}", self.heat(0.0), self.given)
    }
}
