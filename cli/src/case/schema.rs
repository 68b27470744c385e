//! What case and machine files may say. An included file can give whatever is left out, so that only
//! the entries of lists, which are never merged, need keys in the file itself.

use whirl_codegen::document::schema::Shape::{
    Between, Count, Either, Flag, List, Named, Number, Table, Text, Tuple, Words,
};
use whirl_codegen::document::schema::{Key, Shape, key, merged, needed};

use super::Case;
use super::analyses::{AnalysisKind, MatrixFormat};
use super::joined::schema as joined;
use super::lateral::STAGES;
use super::march::{AUTOMATIC, ESTIMATE, GENERALIZED_ALPHA, MOST_STEPS, NEWMARK, ONE_CYCLE};
use super::outputs::QUANTITIES;
use super::periodic::{
    BEGINNINGS, METHODS, MOST_DOUBLINGS, MOST_HARMONICS, MOST_MARCHED, MOST_PERIODS, MOST_POINTS,
    STEPS,
};
use super::shapes::{
    ANGLE, ANSWERS, CLEARANCE, CROSS_STIFFNESS, DAMPING, DAMPING_RATE, DAMPING_TIME, DENSITY,
    DURATION, FORCE, FREQUENCY, GAS_DENSITY, GRAVITY, GROUND_SPRING, LENGTH, MASS, MERGE, MODULUS,
    MOST_CELLS, MOST_MODES, MOST_SPRINGS, MOTION, NAMES, PARAMETERS, PARAMETERS_EXAMPLE, POSITION,
    POWER, SELECTION, SPEED, START, STIFFNESS, TARGET_SPEED, TIME, TOLERANCE, TORQUE,
    TURNING_SPEED, VELOCITY,
};

impl Case {
    /// One line that says what the file is.
    pub(crate) const TITLE: &'static str = "case or machine";
    /// The table of the whole file.
    pub(crate) const SHAPE: &'static Shape = &Table(&[CASE]);
}

/// Left, middle and right.
const SETS: Shape = Tuple(&Text, 3);

const CASE: &[Key] = &[
    key("include", NAMES, "files whose keys apply where this one does not give them"),
    merged("title", Text, "one-line description").like("\"what this case is\""),
    key("source", Text, "paper, standard or book"),
    key("material", Named(&Table(&[MATERIAL])), "materials by name"),
    key("shaft", Table(&[BODY, SHAFT]), "the rotating body"),
    key("support", Table(&[BODY, SUPPORT]), "the standing body"),
    key("springs", Table(&[SPRINGS]), "what all bearings share"),
    key("bearing", List(&Table(&[BEARING, SPRINGS])), "where the shaft runs in the support"),
    key("drive", Table(&[DRIVE]), "what turns the shaft"),
    key("load", List(&Table(&[LOAD, ACTING])), "forces and couples on the shaft"),
    key("body", Named(&Table(&[joined::BODY])), "bodies by name, instead of shaft and support"),
    key(
        "joint",
        Named(&Table(&[joined::JOINT])),
        "what joins two bodies, or a body and the ground",
    ),
    key("drives", Named(&Table(&[joined::DRIVE])), "what turns bodies"),
    key("loads", Named(&Table(&[joined::LOAD, ACTING])), "forces and couples on bodies"),
    key("gravity", Tuple(&GRAVITY, 3), "along x, y and z, on all bodies")
        .like("[\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]"),
    key("ground_motion", Table(&[GROUND_MOTION]), "acceleration of the ground over time"),
    key("mass", Table(&[LUMPED]), "instead of shaft and support: one mass"),
    key("stop", List(&Table(&[STOP])), "what the mass may hit"),
    key("start", Table(&[BEGINNING]), "initial state; at rest if left out"),
    key("march", Table(&[MARCH]), "steps in time; a case that is only analysed needs none"),
    key("reduction", Table(&[REDUCTION]), "how bodies are reduced"),
    key("output", Named(&Table(&[OUTPUT])), "further columns of history.csv, by name"),
    key("analysis", Named(&Table(&[ANALYSIS])), "linear analyses at constant speeds, by name"),
    key("fields", Table(&[FIELDS]), "motions of whole bodies, and films, as VTU files"),
    key("figures", Table(&[FIGURES]), "laws drawn, and numbers of the figures in the paper"),
];

const MATERIAL: &[Key] = &[
    merged("youngs_modulus", MODULUS, "E"),
    merged("poissons_ratio", Between(-1.0, 0.5), "ν").like("0.3"),
    merged("density", DENSITY, "mass a volume; 0 of what only holds other parts"),
];

const BODY: &[Key] = &[
    key("mesh", Text, "a mesh file: Gmsh, Nastran, UNV, or input of Abaqus or CalculiX"),
    key("units", Text, "of length, force and mass in the mesh file; m, N, kg if left out")
        .like("\"mm, N, t\""),
    MERGE,
    key("material", Text, "a material, of a mesh file where it has no sections"),
    key("regions", Named(&Text), "materials by the names of element sets, in place of the mesh's"),
    key(
        "sets",
        Named(&Table(&[SELECTION])),
        "node sets by where they are, in place of sets of the mesh",
    ),
    merged("modes", Count(0, MOST_MODES), "fixed-interface modes kept").like("20"),
    key("damping", DAMPING_TIME, "C = damping · K"),
];

const SHAFT: &[Key] = &[
    key("dimensions", Table(&[SHAFT_DIMENSIONS]), "a mesh made from a few dimensions"),
    merged("axial_restraint", Text, "set of one node held along z").like("\"NAME_OF_A_NODE_SET\""),
    key("motion", MOTION, "how rotation is coupled to deformation"),
    key("stiffening", Flag, "false leaves out the stiffness by the centrifugal stress"),
    key(
        "static_correction",
        ANSWERS,
        "static answers kept beside the modes: to its loads if left out; false: none",
    )
    .like("[\"loads\", \"outputs\"]"),
];

const SHAFT_DIMENSIONS: &[Key] = &[
    merged("length", LENGTH, "of the shaft"),
    merged("diameter", LENGTH, "of the shaft"),
    merged("supports", List(&POSITION), "z of their middles"),
    merged("support_length", LENGTH, "along z"),
    merged("layers_in_support", Count(1, MOST_CELLS), "cells along a support"),
    merged("layers_between", Count(1, MOST_CELLS), "cells along z between supports"),
    key("loads", List(&POSITION), "z of loaded nodes on the centre line"),
    key("cells", Table(&[SHAFT_CELLS]), "cells of the section"),
];

const SHAFT_CELLS: &[Key] = &[
    key("sectors", Count(1, MOST_CELLS), "cells around"),
    key("rings", Count(1, MOST_CELLS), "cells from the centre outwards"),
    key("order", Count(1, 2), "1: linear cells, the default here; 2: quadratic ones"),
];

const SUPPORT: &[Key] = &[
    key("dimensions", Table(&[SUPPORT_DIMENSIONS]), "a mesh made from a few dimensions"),
    merged("mounts", Text, "node set held in x, y and z").like("\"NAME_OF_A_NODE_SET\""),
    key("ground_spring", List(&Table(&[GROUND_SPRING])), "springs to the ground"),
    key("mass_damping", DAMPING_RATE, "C = mass_damping · M beside `damping`"),
    key(
        "static_correction",
        ANSWERS,
        "true keeps the static answers to loads on the bores beside the modes",
    ),
];

const SUPPORT_DIMENSIONS: &[Key] = &[
    merged("start", POSITION, "z of the beam's end"),
    merged("length", LENGTH, "of the beam"),
    merged("height", LENGTH, "of the beam"),
    merged("width", LENGTH, "of the beam"),
    merged("pedestal_height", LENGTH, "between beam and ring"),
    merged("rings", List(&POSITION), "z of their middles"),
    merged("ring_length", LENGTH, "along z"),
    merged("ring_thickness", LENGTH, "of the wall"),
    merged("bore_radius", LENGTH, "of the bore"),
    merged("layers_in_ring", Count(1, MOST_CELLS), "cells along a ring"),
    merged("layers_between", Count(1, MOST_CELLS), "cells along z between rings"),
    key("cells", Table(&[SUPPORT_CELLS]), "cells of the section"),
];

const SUPPORT_CELLS: &[Key] = &[
    key("height", Count(1, MOST_CELLS), "cells over the height of the beam"),
    key("width", Count(1, MOST_CELLS), "cells over the width of the beam"),
    key("pedestal", Count(1, MOST_CELLS), "cells over the height of the pedestal"),
    key("around", Count(1, MOST_CELLS), "cells around the ring"),
    key("radial", Count(1, MOST_CELLS), "cells over the ring's wall"),
    key("order", Count(1, 2), "1: linear cells, the default here; 2: quadratic ones"),
];

const SPRINGS: &[Key] = &[
    key("number", Count(3, MOST_SPRINGS), "springs in a ring").like("24"),
    key("radial_clearance", CLEARANCE, "of the undeformed bearing"),
    key(
        "journal_radius",
        LENGTH,
        "for slip and for laws; that of the bore less the clearance if left out",
    ),
    key("length", LENGTH, "along the axis, for laws; between the ends of the journal if left out"),
    key("law", Text, "the name of a law, or the path of a law file").like("\"hu2003-nonlinear\""),
    key("parameters", PARAMETERS, "of the law, by name").like(PARAMETERS_EXAMPLE),
];

const BEARING: &[Key] = &[
    needed("journal", SETS, "sets of one node: left, middle, right")
        .like("[\"JOURNAL1_LEFT\", \"JOURNAL1_MIDDLE\", \"JOURNAL1_RIGHT\"]"),
    needed("bore", SETS, "sets around the bore: left, middle, right")
        .like("[\"BORE1_LEFT\", \"BORE1_MIDDLE\", \"BORE1_RIGHT\"]"),
    key("stations", List(&POSITION), "z of the rings of springs"),
];

const DRIVE: &[Key] = &[
    key("top", Text, "set of one node").like("\"DRIVE_TOP\""),
    key("bottom", Text, "set of one node").like("\"DRIVE_BOTTOM\""),
    key(
        "section",
        Text,
        "a node set in place of `top` and `bottom`: the couple acts on its mean rotation",
    )
    .like("\"END\""),
    key("torque", TORQUE, "until the target speed is reached; negative turns the other way"),
    key("target_speed", TARGET_SPEED, "at which the couple ends"),
    key(
        "release",
        Words(&["located", "step"]),
        "where in a step the couple ends; located if left out",
    ),
    key("table", Text, "couple over time or speed, in place of `torque`").like("\"motor.csv\""),
    key("acts", Flag, "false leaves the shaft without a drive"),
];

const LOAD: &[Key] = &[needed("sets", NAMES, "node sets").like("[\"LOAD1\"]")];

/// What a load does, of a shaft and of a body by name.
const GROUND_MOTION: &[Key] = &[
    needed("table", Text, "accelerations over time: `time [s], x [g], y [m/s^2]`")
        .like("\"quake.csv\""),
    key("factor", Between(-1000.0, 1000.0), "by which they are multiplied; 1 if left out")
        .like("0.5"),
    key("x", Text, "the column along x; `x` if left out").like("\"NS\""),
    key("y", Text, "the column along y; `y` if left out").like("\"EW\""),
    key("z", Text, "the column along z; `z` if left out").like("\"UD\""),
];

const ACTING: &[Key] = &[
    key("force", Either(&[FORCE, Tuple(&FORCE, 3)]), "its amplitude, or a list along x, y and z"),
    key(
        "couple",
        Either(&[TORQUE, Tuple(&TORQUE, 3)]),
        "on the mean rotation of the sets, about z, or a list",
    ),
    key("direction", Words(&["x", "y", "z"]), "x of a force if left out, z of a couple"),
    key("frame", Words(&["space", "body"]), "where its direction is constant; space if left out"),
    key(
        "spread",
        Words(&["each", "mean"]),
        "a force on each node, or one on their mean motion; each if left out",
    ),
    key("frequency", FREQUENCY, "of F sin(2πft + φ); a constant load without it"),
    key("order", Number, "n of F sin(nθ + φ)").like("2"),
    key("phase", ANGLE, "φ"),
    key("table", Text, "a file of two columns: over time or an angle, a factor or the load itself")
        .like("\"gas.csv\""),
    key("period", Text, "of the table, which repeats then").like("\"720 deg\""),
    key("start", START, "from then on it acts"),
    key("ramp", Tuple(&START, 2), "between these times it rises from nothing to all of it")
        .like("[\"0 s\", \"0.1 s\"]"),
];

const LUMPED: &[Key] = &[
    key("unbalance", Table(&[UNBALANCE]), "the mass turns off its axis"),
    merged("mass", MASS, "m"),
    key("stiffness", STIFFNESS, "of its spring"),
    key("damping", DAMPING, "of its damper"),
    key("displacement", POSITION, "at t = 0"),
    key("velocity", VELOCITY, "at t = 0"),
    key("force", FORCE, "constant"),
    key("motion", MOTION, "without effect: a mass moves in the fixed frame"),
];

const UNBALANCE: &[Key] =
    &[merged("eccentricity", LENGTH, "of the centre of mass"), merged("speed", SPEED, "constant")];

const STOP: &[Key] = &[
    key(
        "side",
        Words(&["above", "below", "around"]),
        "towards greater or smaller x, or all around",
    ),
    key("gap", POSITION, "clearance at x = 0; all around, the radial clearance of the law"),
    key("journal_radius", LENGTH, "of the mass where it slides on the stop, for slip and for laws"),
    key("length", LENGTH, "of the stop along the axis, for laws"),
    needed("law", Text, "the name of a law, or the path of a law file").like("\"my.law.toml\""),
    key("parameters", PARAMETERS, "of the law, by name").like(PARAMETERS_EXAMPLE),
];

const BEGINNING: &[Key] = &[
    key(
        "kind",
        Words(&["rest", "equilibrium", "state"]),
        "at rest but for speeds, in equilibrium at them, or as another run ended",
    ),
    key("speed", TURNING_SPEED, "of the shaft, of a machine that names no bodies"),
    key("from", Text, "the folder of results of another run").like("\"results/NAME\""),
];

const MARCH: &[Key] = &[
    merged(
        "time_step",
        Either(&[Words(&[AUTOMATIC]), TIME]),
        "Δt, or \"auto\" where the program chooses it, which needs a duration and output_step",
    )
    .like("\"7.4e-5 s\""),
    key(
        "step_tolerance",
        Between(0.0, 0.1),
        "local error of a step that the program chooses, as a fraction of the largest displacement; 1e-4 if left out",
    )
    .like("1e-5"),
    key("steps", Count(1, MOST_STEPS), "or a duration"),
    key("duration", DURATION, "or a number of steps"),
    key(
        "output_step",
        DURATION,
        "from one row of history.csv to the next, a multiple of a time_step that is given",
    ),
    key(
        "integrator",
        Words(&[NEWMARK, GENERALIZED_ALPHA]),
        "how steps are integrated: without damping of its own, or with one of motion that is far faster than the step; \
         newmark if left out",
    ),
    key(
        "spectral_radius",
        Between(0.0, 1.0),
        "of generalized-alpha: what a step leaves of motion that is far faster; 0.9 if left out",
    )
    .like("0.8"),
    key("force_tolerance", TOLERANCE, "change of a spring force at which a step has converged"),
    key("cycle_frequency", FREQUENCY, "of the cycle over which results are summed up"),
    key("stop_when_steady", Flag, "true ends the run at its steady state"),
    key(
        "steady_test",
        Words(&[ESTIMATE, ONE_CYCLE]),
        "what tells the steady state: an estimate of what is left to change, below 1 %, or that a cycle repeats the one \
         before to 1 %; estimate if left out",
    ),
];

const REDUCTION: &[Key] =
    &[key("memory_limit", Text, "bytes that it may take at a time").like("\"8 GiB\"")];

const OUTPUT: &[Key] = &[
    merged(
        "quantity",
        Words(&QUANTITIES),
        "of a body: motion of a point, energy, power; of a joint: force, deformation and its rate, power; moment and tilt, or force and deformation along z, of one that acts so; what is in its film",
    ),
    key("body", Text, "the name of a body; \"shaft\", \"support\" or \"mass\" in a short form")
        .like("\"rotor\""),
    key("joint", Text, "the name of a joint; the number of a support or a stop in a short form")
        .like("\"front\""),
    key("set", Text, "node set of a mesh: the motion of its node, or the mean of its nodes")
        .like("\"DISC\""),
    key(
        "z",
        POSITION,
        "on a rigid body, at its centre if left out; of a mesh the mean of the section there",
    ),
    key("frame", Words(&["space", "body"]), "whose components; space if left out"),
    key("components", NAMES, "of \"x\", \"y\" and \"z\"; x and y if left out")
        .like("[\"x\", \"y\"]"),
];

const ANALYSIS: &[Key] = &[
    merged(
        "kind",
        Words(AnalysisKind::WORDS),
        "modes at a speed or followed over speeds, response, coefficients of joints, stability, undamped critical speeds, matrices for other programs, torsion of a train, forces along bodies, what standards ask for, a motion that repeats itself",
    ),
    key("of", Text, "the body whose speed it is; the fastest if left out").like("\"rotor\""),
    key(
        "speeds",
        Text,
        "of that body: one, or a range with a number; those of the case if left out",
    )
    .like("\"0 rpm .. 30000 rpm, 61\""),
    key("ratios", Named(&Number), "speeds of other bodies over that; as in the case if left out")
        .like("{ outer = -1.5 }"),
    key("count", Count(1, 200), "how many modes, the slowest ones; 10 if left out"),
    key(
        "orders",
        List(&Number),
        "of critical speeds, once a turn of every body if left out; of torsion, of every shaft, 1 and 2 if left out",
    )
    .like("[1, 2]"),
    key("mesh_orders", List(&Number), "of torsion: of the teeth of gears; 1 if left out")
        .like("[1, 2]"),
    key("operation", Text, "of torsion: speeds of operation; that of the case if left out")
        .like("\"2700 rpm .. 3300 rpm\""),
    key("margin", Between(0.0, 1.0), "of torsion: share by which modes keep off; 0.1 if left out")
        .like("0.1"),
    key("stiffness", Text, "of the joints of a map, one or a range with a number")
        .like("\"1e5 N/m .. 1e10 N/m, 41, log\""),
    key("stations", Count(1, 1000), "of forces: planes along each body; 41 if left out"),
    key("format", Words(MatrixFormat::WORDS), "of the files of matrices; npz if left out"),
    key(
        "edition",
        Count(7, 9),
        "of API 617, whose formulas a lateral analysis uses; 9 if left out",
    ),
    key("minimum_speed", SPEED, "N_ma, the minimum allowable speed"),
    key("maximum_speed", SPEED, "N_mc, the maximum continuous speed"),
    key("trip_speed", SPEED, "105 % of the maximum speed if left out"),
    key(
        "probes",
        NAMES,
        "points where vibration is measured; the journals of the body if left out",
    )
    .like("[\"joint.left\", \"joint.right\"]"),
    key(
        "probe_angle",
        ANGLE,
        "from x to the first of two probes, 90 deg apart; 45 deg if left out of a lateral analysis, none of a response",
    ),
    key(
        "clearances",
        Named(&LENGTH),
        "least diametral clearance at points, beside that of bearings",
    )
    .like("{ \"output.eye\" = \"500 um\" }"),
    key("scale_limit", Between(0.0, 1e6), "the largest scale factor S_cc; 6 if left out").like("6"),
    key(
        "unbalance_modes",
        List(&Number),
        "forward modes by which unbalance is placed, from 1; 1 and 2 if left out",
    )
    .like("[1, 2]"),
    key("unbalance", Named(&Table(&[APPLIED])), "unbalance in planes that the case chooses"),
    key("journal_loads", Named(&FORCE), "static loads of joints; found if left out")
        .like("{ left = \"450 N\" }"),
    key("stages", Named(&Table(&[STAGE])), "impellers, blades and seals that push across"),
    key(
        "cross_coupling_z",
        POSITION,
        "where Q of stages between the bearings acts; midway between the journals if left out",
    ),
    key("gas_density", GAS_DENSITY, "average of suction and discharge, for regions A and B"),
    key("seals", NAMES, "joints left out of stability of level I").like("[\"seal\"]"),
    key(
        "variants",
        Named(&Table(&[VARIANT])),
        "other values of keys, such as clearances or viscosity",
    ),
    key(
        "steps",
        Count(STEPS[0], STEPS[1]),
        "of a cycle of a periodic motion; as near to the time step of the march as they can be if left out",
    )
    .like("360"),
    key("method", Words(METHODS), "of a periodic motion; the one that takes less time if left out"),
    key(
        "harmonics",
        Count(1, MOST_HARMONICS),
        "balanced by the method `harmonic`, beside the mean; as many as are enough if left out",
    )
    .like("30"),
    key("self_excited", Flag, "true looks for a motion that the machine has by itself, such as oil whirl, with its period"),
    key(
        "near",
        FREQUENCY,
        "about which frequency a motion that is self-excited has; half of the fastest rotation if left out",
    )
    .like("\"24 Hz\""),
    key("marched", Count(0, MOST_MARCHED), "cycles of a periodic motion marched before the method")
        .like("8"),
    key(
        "periods",
        Count(1, MOST_PERIODS),
        "common periods of loads and speeds in a cycle of a periodic motion; 1 if left out",
    )
    .like("2"),
    key(
        "begin",
        Words(BEGINNINGS),
        "where the search for a periodic motion begins; in equilibrium if there is one",
    ),
    key("cycles", Count(1, MOST_MARCHED), "of a periodic motion at most; 400 if left out")
        .like("400"),
    key("vary", Text, "a key of the case with a range, over which periodic motions are followed")
        .like("\"body.rotor.speed = 3000 rpm .. 9000 rpm\""),
    key("points", Count(2, MOST_POINTS), "of a branch of periodic motions at most; 200 if left out")
        .like("200"),
    key("doublings", Count(0, MOST_DOUBLINGS), "of the period, whose branches are followed as well")
        .like("1"),
];

const APPLIED: &[Key] = &[
    needed("z", List(&POSITION), "of each plane").like("[\"500 mm\"]"),
    needed("load", List(&MASS), "W by which the unbalance of each is found").like("[\"40 kg\"]"),
    key("phase", List(&ANGLE), "of each; 0 if left out").like("[\"180 deg\"]"),
];

const STAGE: &[Key] = &[
    key("kind", Words(STAGES), "impeller if left out"),
    key("z", POSITION, "needed of a stage beyond the bearings"),
    key("power", POWER, "rated, of the stage"),
    key("diameter", LENGTH, "of the impeller; pitch diameter of blades"),
    key("width", LENGTH, "the smaller of impeller and diffuser at its outlet; height of blades"),
    key("density_ratio", Between(0.0, 1000.0), "discharge over suction, of an impeller")
        .like("1.6"),
    key("stiffness", CROSS_STIFFNESS, "across, in place of a power"),
];

const VARIANT: &[Key] = &[needed("set", NAMES, "keys of the case with their values, as of --vary")
    .like("[\"joint.left.radial_clearance = 90 um\"]")];

const FIELDS: &[Key] = &[
    key("bodies", NAMES, "those that have a mesh if left out").like("[\"shaft\"]"),
    key("films", NAMES, "joints whose films are written; all that have one if left out")
        .like("[\"front\"]"),
    key("frames", Count(1, 1000), "of the last cycle; 24 if neither they nor times are given")
        .like("24"),
    key("times", List(&DURATION), "of further frames").like("[\"10 ms\"]"),
    key("stresses", Flag, "at the nodes of every frame, and the largest over the cycle"),
];

const FIGURES: &[Key] = &[
    key("laws", NAMES, "laws drawn beside each other"),
    key("law", Count(1, 999), "number of the figure in the paper"),
    key("reactions", Count(1, 999), "number of the figure in the paper"),
    key("eccentricity", Count(1, 999), "number of the figure in the paper"),
    key("rotation", Count(1, 999), "number of the figure in the paper"),
];
