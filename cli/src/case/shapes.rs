//! What tables of a case have in common: quantities, limits, and keys of several tables.

use whirl_codegen::document::schema::Shape::{
    Either, Flag, List, Named, Number, Quantity, Registered, Text, Tuple, Words,
};
use whirl_codegen::document::schema::{Key, Measure, Range, Shape, key, needed};
use whirl_codegen::units::Dimension;
use whirl_specs::MOTIONS;

macro_rules! measures {
    ($($name:ident: $dimension:ident, $example:literal, $range:ident;)*) => {
        $(pub(super) const $name: Shape = Quantity(Measure {
            dimension: Dimension::$dimension,
            example: $example,
            range: Range::$range,
        });)*
    };
}

measures! {
    LENGTH: LENGTH, "12.5 mm", Positive;
    BORE: LENGTH, "20 mm", NotNegative;
    CLEARANCE: LENGTH, "35 um", Positive;
    POSITION: LENGTH, "12.5 mm", Any;
    VELOCITY: SPEED, "1 m/s", Any;
    MASS: MASS, "100 kg", Positive;
    MODULUS: PRESSURE, "200 GPa", Positive;
    DENSITY: DENSITY, "7860 kg/m^3", NotNegative;
    TIME: TIME, "7.4e-5 s", Positive;
    DURATION: TIME, "0.1 s", Positive;
    START: TIME, "0.1 s", Any;
    GRAVITY: ACCELERATION, "9.81 m/s^2", Any;
    DAMPING_TIME: TIME, "1e-4 s", NotNegative;
    DAMPING_RATE: FREQUENCY, "5 1/s", NotNegative;
    INERTIA: INERTIA, "0.02 kg*m^2", Positive;
    STIFFNESS: STIFFNESS, "1e8 N/m", NotNegative;
    CROSS_STIFFNESS: STIFFNESS, "1e7 N/m", Any;
    CROSS_DAMPING: DAMPING, "1e4 N*s/m", Any;
    TORSIONAL_STIFFNESS: TORQUE, "1e4 N*m/rad", NotNegative;
    TORSIONAL_DAMPING: TORSIONAL_DAMPING, "10 N*m*s/rad", NotNegative;
    TILTING_STIFFNESS: TORQUE, "1e4 N*m/rad", Any;
    TILTING_DAMPING: TORSIONAL_DAMPING, "10 N*m*s/rad", Any;
    DAMPING: DAMPING, "20 N*s/m", NotNegative;
    MESH_STIFFNESS: STIFFNESS, "2e8 N/m", Positive;
    MESH_DAMPING: DAMPING, "500 N*s/m", NotNegative;
    FORCE: FORCE, "1000 N", Any;
    TOLERANCE: FORCE, "1e-3 N", Positive;
    TORQUE: TORQUE, "109 N*m", Any;
    TARGET_SPEED: ANGULAR_SPEED, "4500 rpm", Any;
    SPEED: ANGULAR_SPEED, "4500 rpm", Positive;
    TURNING_SPEED: ANGULAR_SPEED, "3000 rpm", Any;
    ACCELERATION: ANGULAR_ACCELERATION, "600 rpm/s", Any;
    FREQUENCY: FREQUENCY, "37.5 Hz", Positive;
    ANGLE: ANGLE, "90 deg", Any;
    POWER: POWER, "1200 kW", Positive;
    SUPPLY: PRESSURE, "2 bar", NotNegative;
    ARC: ANGLE, "20 deg", Positive;
    GAS_DENSITY: DENSITY, "45 kg/m^3", Positive;
    OIL_DENSITY: DENSITY, "870 kg/m^3", Positive;
    TEMPERATURE: TEMPERATURE, "313.15 K", Positive;
    HEAT_CAPACITY: HEAT_CAPACITY, "1950 J/kg/K", Positive;
    HELD_HEAT: HELD_HEAT, "50 J/K", NotNegative;
    HEAT_FLOW: HEAT_FLOW, "5 W/K", NotNegative;
}

/// Springs of a bearing in all its rings.
pub(super) const MOST_SPRINGS: usize = 10_000;
/// Modes of a body.
pub(super) const MOST_MODES: usize = 2_000;
/// Cells or layers along one direction.
pub(super) const MOST_CELLS: usize = 10_000;

/// True or false, or to what static answers are kept.
pub(super) const ANSWERS: Shape = Either(&[Flag, Text, List(&Text)]);
/// Names in a list, or one alone.
pub(super) const NAMES: Shape = Either(&[Text, List(&Text)]);
pub(super) const MOTION: Shape = Registered(motions);
/// Quantities with their units, or pure numbers.
pub(super) const PARAMETERS: Shape = Named(&Either(&[Text, Number]));
pub(super) const PARAMETERS_EXAMPLE: &str = "{ mu = \"12 mPa*s\" }";

/// Of a mesh file, also of a body by name.
pub(super) const MERGE: Key =
    key("merge", LENGTH, "nodes of the mesh file that are at most so far apart become one")
        .like("\"1e-6 m\"");

/// A node set by where it is.
pub(super) const SELECTION: &[Key] = &[
    key("radius", LENGTH, "of a cylinder about an axis along z: the nodes of its faces"),
    key("z", Tuple(&POSITION, 2), "of a cylinder: from where to where; all of it if left out")
        .like("[\"20 mm\", \"40 mm\"]"),
    key(
        "centre",
        Tuple(&POSITION, 2),
        "of a cylinder: x and y of its axis; the body's if left out",
    )
    .like("[\"0 mm\", \"0 mm\"]"),
    key("point", Tuple(&POSITION, 3), "nodes near it").like("[\"0 mm\", \"0 mm\", \"100 mm\"]"),
    key("plane", POSITION, "z of faces across the axis: their nodes"),
    key("section", POSITION, "z of a section: all nodes there, inside of the body, too"),
    key(
        "across",
        Words(&["x", "y", "z"]),
        "of a plane: the axis across which it stands, and on which its place is; z if left out",
    ),
    key(
        "within",
        LENGTH,
        "how far nodes may be from it: 1 % of the radius, 0.01 mm from a plane or a section if left out",
    ),
];

pub(super) const GROUND_SPRING: &[Key] = &[
    needed("set", Text, "node set").like("\"NAME_OF_A_NODE_SET\""),
    key("direction", Words(&["x", "y", "z"]), "x if left out"),
    needed("stiffness", STIFFNESS, "of each node"),
];

fn motions() -> Vec<&'static str> {
    MOTIONS.iter().map(|motion| motion.origin.name).collect()
}
