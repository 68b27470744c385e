//! What the tables `[body.NAME]`, `[joint.NAME]`, `[drives.NAME]` and `[loads.NAME]` may say.

use whirl_codegen::document::schema::Shape::{
    Between, Count, Either, Flag, List, Named, Number, Table, Text, Tuple, Words,
};
use whirl_codegen::document::schema::{Key, Shape, key, merged};

use crate::case::film_bore::BORE_SHAPE;
use crate::case::film_table::FILM;
use crate::case::shapes::{
    ACCELERATION, ANGLE, ANSWERS, BORE, CLEARANCE, CROSS_DAMPING, CROSS_STIFFNESS, DAMPING,
    DAMPING_RATE, DAMPING_TIME, GROUND_SPRING, INERTIA, LENGTH, MASS, MERGE, MESH_DAMPING,
    MESH_STIFFNESS, MOST_CELLS, MOST_MODES, MOST_SPRINGS, MOTION, NAMES, PARAMETERS,
    PARAMETERS_EXAMPLE, POSITION, SELECTION, STIFFNESS, TARGET_SPEED, TILTING_DAMPING,
    TILTING_STIFFNESS, TORQUE, TORSIONAL_DAMPING, TORSIONAL_STIFFNESS, TURNING_SPEED,
};

/// In place of a clearance: the radius of the bore less that of the journal, as the meshes have them.
pub(crate) const FROM_MESH: &str = "from mesh";
/// A place in the plane.
const PLACE: Shape = Tuple(&POSITION, 2);
/// One place for all planes, or one each at the left end, the middle and the right end.
const PLACES: Shape = List(&Either(&[POSITION, PLACE]));
/// An example of either.
const PLACE_EXAMPLE: &str = "[\"0 mm\", \"0 mm\"]";

pub(crate) const BODY: &[Key] = &[
    merged("turns", Words(&["free", "prescribed", "no"]), "whether it turns about its axis"),
    key("axis", PLACE, "x and y of its axis, 0 if left out").like(PLACE_EXAMPLE),
    key("mesh", Text, "a mesh file: Gmsh, Nastran, UNV, or input of Abaqus or CalculiX"),
    key(
        "matrices",
        Table(&[MATRICES]),
        "stiffness and mass that another program wrote, in place of a mesh",
    ),
    key("units", Text, "of length, force and mass in the mesh file, or in `matrices`; m, N, kg if left out")
        .like("\"mm, N, t\""),
    MERGE,
    key(
        "dimensions",
        Table(&[DIMENSIONS]),
        "a mesh made from a few dimensions: if the body turns a shaft, or a crank, which has a throw; else a support",
    ),
    key(
        "sections",
        Either(&[Text, List(&Table(&[SECTION]))]),
        "a round body by its sections: a table in a file, or rows in a list, from left to right",
    )
    .like("\"rotor.csv\""),
    key("cells", Table(&[SECTION_CELLS]), "cells of a body made from `sections`"),
    key("material", Text, "a material, of a mesh file or of rows of `sections` where they have none"),
    key("regions", Named(&Text), "materials by the names of element sets, in place of the mesh's"),
    key("sets", Named(&Table(&[SELECTION])), "node sets by where they are, in place of sets of the mesh"),
    key("modes", Count(0, MOST_MODES), "fixed-interface modes kept").like("20"),
    key(
        "static_correction",
        ANSWERS,
        "static answers kept beside the modes: to its loads and to films on its bores if left out; true: to loads on its bores, too; false: none; \
         or a list of \"loads\", \"outputs\", \"bores\" and \"pressure\"",
    ),
    key(
        "damping",
        Either(&[DAMPING_TIME, Table(&[PLANE_DAMPING])]),
        "C = damping · K of a mesh; of a rigid body to the ground, by x and y",
    ),
    key("mass_damping", DAMPING_RATE, "C = mass_damping · M beside it, of a mesh that does not turn"),
    key("held", NAMES, "node sets held in x, y and z, or to the frame that turns")
        .like("[\"MOUNTS\"]"),
    key("ground_spring", List(&Table(&[GROUND_SPRING])), "springs to the ground"),
    key("axial_restraint", Text, "set whose nodes are held along z on average").like("\"NAME_OF_A_NODE_SET\""),
    key(
        "section",
        NAMES,
        "the section that turns with the frame: a set, or two of one node at opposite ends of a diameter",
    )
    .like("[\"TOP\", \"BOTTOM\"]"),
    key("rigid", Flag, "true takes a mesh as a rigid body that moves in the plane and tilts"),
    key("mass", MASS, "of a rigid body"),
    key("polar_inertia", INERTIA, "about the axis, of a rigid body that turns; about its centre, of one that rocks"),
    key("transverse_inertia", INERTIA, "about x and y through its centre; it may tilt then"),
    key("z", POSITION, "of its centre of mass"),
    key("stiffness", Table(&[PLANE_STIFFNESS]), "of a rigid body to the ground, by x and y"),
    key("speed", TURNING_SPEED, "of a prescribed rotation at t = 0"),
    key("acceleration", ACCELERATION, "of a prescribed rotation, 0 if left out"),
    key("table", Text, "of a prescribed rotation: speed over time, in place of `speed`")
        .like("\"run-up.csv\""),
    key("initial_speed", TURNING_SPEED, "of a free rotation at t = 0"),
    key("disc", Named(&Table(&[DISC])), "rigid discs on a mesh that turns, by name"),
    key("added", Named(&Table(&[ADDED])), "point masses on a body that turns, by name"),
    key("unbalance", Named(&Table(&[UNBALANCE])), "of a body that turns, by name"),
    key("motion", MOTION, "how rotation is coupled to deformation"),
    key(
        "stiffening",
        Flag,
        "of a mesh that turns: false leaves out the stiffness by the centrifugal stress",
    ),
    key("moves_along_z", Flag, "of a rigid body: true lets it move along z"),
    key("rocks", Flag, "of a rigid body that does not turn: true lets it turn a little about z, as pads do"),
    key("centre", PLACE, "x and y of the centre of mass of a body that rocks, 0 if left out")
        .like("[\"-60 mm\", \"0 mm\"]"),
];

const SECTION: &[Key] = &[
    key("length", LENGTH, "along z"),
    key(
        "z",
        POSITION,
        "of its left end; where the row before it ends if left out, and 0 of the first one",
    ),
    key("outer", LENGTH, "outer diameter at both ends"),
    key("outer_left", LENGTH, "outer diameter of a cone at its left end"),
    key("outer_right", LENGTH, "outer diameter of a cone at its right end"),
    key("inner", BORE, "inner diameter at both ends, 0 if left out"),
    key("inner_left", BORE, "inner diameter at its left end"),
    key("inner_right", BORE, "inner diameter at its right end"),
    key(
        "mass_outer",
        LENGTH,
        "diameter up to which there is mass, where `outer` is that of the stiffness",
    ),
    key("material", Text, "a material; that of the body if left out").like("\"steel\""),
    key("name", Text, "of the sets of its surface, of its bore and of its cells")
        .like("\"JOURNAL\""),
];

const SECTION_CELLS: &[Key] = &[
    key("sectors", Count(1, MOST_CELLS), "around the axis, 12 if left out").like("12"),
    key("refine", Count(1, 20), "layers and rings so many times as fine").like("2"),
    key(
        "tolerance",
        Between(0.0, 0.1),
        "part by which frequencies of bending may be off by the length of the layers: 0.0001 if left out",
    )
    .like("0.0001"),
];

const MATRICES: &[Key] = &[
    key(
        "stiffness",
        Text,
        "a file of K: Matrix Market, OUTPUT4 of Nastran (`\"model.op4:KAA\"`), .mtx of Abaqus; of DMIG the name of K, KAAX if left out",
    )
        .like("\"K.mtx\""),
    key("mass", Text, "a file of M; of DMIG the name of M, MAAX if left out")
        .like("\"M.mtx\""),
    key("dofs", Text, "a table of the dofs of files without labels: node, direction, x, y, z")
        .like("\"dofs.csv\""),
    key("dmig", Text, "a file with cards DMIG of Nastran, in place of `dofs`")
        .like("\"model.pch\""),
    key("calculix", Text, "the job of CalculiX that wrote .sti, .mas and .dof, in place of `dofs`")
        .like("\"JOB\""),
    key(
        "nodes",
        Text,
        "the input file of `dmig`, `calculix` or of .mtx of Abaqus with labels, with the places of the nodes",
    )
        .like("\"model.bdf\""),
    key(
        "spin_inertia",
        Text,
        "Y of a body that turns: a file such as that of K, or the name of a DMIG",
    )
    .like("\"Y.mtx\""),
    key("spin_coupling", Text, "H of a body that turns").like("\"H.mtx\""),
    key("spin_load", Text, "the centrifugal load at 1 rad/s, Y x0").like("\"load.mtx\""),
    key("stiffening", Text, "G, the stiffness by the stress of this load").like("\"G.mtx\""),
];

const DISC: &[Key] = &[
    merged("mass", MASS, "of the disc"),
    merged("polar_inertia", INERTIA, "about the axis"),
    merged("transverse_inertia", INERTIA, "about a diameter"),
    key("z", POSITION, "of the section that carries it"),
];

const ADDED: &[Key] = &[
    merged("mass", MASS, "of the point"),
    key("radius", LENGTH, "of the point, 0 if left out"),
    key("angle", ANGLE, "of the point, from x of the turning frame, 0 if left out"),
    key("z", POSITION, "of the section that carries it"),
];

const UNBALANCE: &[Key] = &[
    merged("mass", MASS, "out of balance; it adds to no inertia"),
    merged("radius", LENGTH, "at which it turns"),
    key("angle", ANGLE, "from x of the turning frame, 0 if left out"),
    key("z", POSITION, "of the section that carries it"),
];

const PLANE_STIFFNESS: &[Key] = &[key("x", STIFFNESS, "along x"), key("y", STIFFNESS, "along y")];

const PLANE_DAMPING: &[Key] = &[key("x", DAMPING, "along x"), key("y", DAMPING, "along y")];

const DIMENSIONS: &[Key] = &[
    key("length", LENGTH, "of the shaft, or of the beam"),
    key("diameter", LENGTH, "of the shaft"),
    key("supports", List(&POSITION), "z of the middles of the shaft's supports"),
    key("support_length", LENGTH, "along z"),
    key("layers_in_support", Count(1, MOST_CELLS), "cells along a support; chosen if left out"),
    key(
        "layers_between",
        Count(1, MOST_CELLS),
        "cells along z between supports or rings; chosen if left out",
    ),
    key("loads", List(&POSITION), "z of loaded nodes on the centre line"),
    key("throw", LENGTH, "of a crank: from its axis to the centre of its pin"),
    key("pin_diameter", LENGTH, "of the pin of a crank"),
    key("pin_length", LENGTH, "of the pin of a crank, along z"),
    key("web_width", LENGTH, "of the webs of a crank, across the throw"),
    key("web_thickness", LENGTH, "of each web of a crank, along z"),
    key("start", POSITION, "z of the beam's end"),
    key("height", LENGTH, "of the beam"),
    key("width", LENGTH, "of the beam"),
    key("pedestal_height", LENGTH, "between beam and ring"),
    key("rings", List(&POSITION), "z of the middles of the rings"),
    key("ring_length", LENGTH, "along z"),
    key("ring_thickness", LENGTH, "of the wall"),
    key("bore_radius", LENGTH, "of the bore"),
    key("layers_in_ring", Count(1, MOST_CELLS), "cells along a ring; chosen if left out"),
    key("cells", Table(&[CELLS]), "cells of the section"),
];

const CELLS: &[Key] = &[
    key("sectors", Count(1, MOST_CELLS), "cells around the shaft"),
    key("rings", Count(1, MOST_CELLS), "cells from the centre of the shaft outwards"),
    key("height", Count(1, MOST_CELLS), "cells over the height of the beam"),
    key("width", Count(1, MOST_CELLS), "cells over the width of the beam"),
    key("pedestal", Count(1, MOST_CELLS), "cells over the height of the pedestal"),
    key("around", Count(1, MOST_CELLS), "cells around the ring"),
    key("radial", Count(1, MOST_CELLS), "cells over the ring's wall"),
    key("order", Count(1, 2), "1: linear cells; 2: quadratic ones, the default"),
    key(
        "tolerance",
        Between(0.0, 0.1),
        "part by which frequencies of bending may be off, where layers of quadratic cells are left out: 0.001 if left out",
    )
    .like("0.001"),
];

pub(crate) const JOINT: &[Key] = &[
    merged("kind", Words(&["bearing", "stop", "bushing", "coupling", "gear"]), "what joins the bodies"),
    key("journal", Table(&[SIDE]), "of a bearing or a stop: what runs in the bore"),
    key("bore", Table(&[SIDE]), "of a bearing or a stop: what it runs in; the ground if left out"),
    key("first", Table(&[END, AT]), "of a bushing, a coupling or a gear"),
    key("second", Table(&[END]), "of a bushing, a coupling or a gear; the ground if left out"),
    key("law", Text, "the name of a law, or the path of a law file").like("\"ocvirk\""),
    key("parameters", PARAMETERS, "of the law, by name").like(PARAMETERS_EXAMPLE),
    key("film", Table(&[FILM, BORE_SHAPE]), "of a bearing whose law is a film: its nodes, ends and openings"),
    key("sensor", Table(&[SENSOR]), "of a bearing whose law reads one: where it looks at the journal's body"),
    key("springs", Count(3, MOST_SPRINGS), "in a ring, of a law that acts spring by spring")
        .like("24"),
    key(
        "radial_clearance",
        Either(&[CLEARANCE, Words(&[FROM_MESH])]),
        "of the undeformed bearing; or that which the meshes of journal and bore leave",
    )
    .like("\"35 um\""),
    key(
        "journal_radius",
        LENGTH,
        "for slip and for laws; that of the bore less the clearance if left out",
    ),
    key("length", LENGTH, "along the axis, for laws; between the ends of the journal if left out"),
    key("stations", List(&POSITION), "z of the rings of springs"),
    key(
        "run_out",
        PLACES,
        "of the journal, fixed in its body; or one at the left end, the middle, the right end",
    )
    .like(PLACE_EXAMPLE),
    key(
        "offset",
        PLACES,
        "of the bore, fixed in its body; or one at the left end, the middle, the right end",
    )
    .like(PLACE_EXAMPLE),
    key(
        "side",
        Words(&["above", "below", "around"]),
        "of a stop: towards greater or smaller x, or all around",
    ),
    key("gap", POSITION, "of a stop: clearance at x = 0; all around, the radial clearance"),
    key(
        "stiffness",
        Either(&[TORSIONAL_STIFFNESS, Table(&[BUSHING_STIFFNESS])]),
        "of a coupling; of a bushing, by direction of force and displacement",
    )
    .like("{ xx = \"1e8 N/m\", yy = \"1e8 N/m\" }"),
    key(
        "damping",
        Either(&[TORSIONAL_DAMPING, Table(&[BUSHING_DAMPING])]),
        "of a coupling; of a bushing, by direction of force and speed",
    )
    .like("{ xx = \"2e4 N*s/m\", yy = \"2e4 N*s/m\" }"),
    key(
        "table",
        Text,
        "of a bushing: a file of its stiffness and damping over the speed of the first side, also over the frequency, in place of both",
    )
    .like("\"film.csv\""),
    key(
        "tilting_stiffness",
        Table(&[BUSHING_TILTING_STIFFNESS]),
        "of a bushing, by axis of moment and of tilt",
    )
    .like("{ xx = \"1e4 N*m/rad\", yy = \"1e4 N*m/rad\" }"),
    key(
        "tilting_damping",
        Table(&[BUSHING_TILTING_DAMPING]),
        "of a bushing, by axis of moment and of rate of tilt",
    )
    .like("{ xx = \"10 N*m*s/rad\", yy = \"10 N*m*s/rad\" }"),
    key("axial_stiffness", CROSS_STIFFNESS, "of a bushing, along z").like("\"1e8 N/m\""),
    key("axial_damping", CROSS_DAMPING, "of a bushing, along z").like("\"2e4 N*s/m\""),
    key("teeth", List(&Number), "of the first and the second gear").like("[20, 40]"),
    key(
        "pitch_radii",
        Tuple(&CLEARANCE, 2),
        "of the first and the second gear; from their teeth and the distance of the axes if left out",
    )
    .like("[\"40 mm\", \"80 mm\"]"),
    key("internal", Flag, "whether the larger gear has its teeth inside; false if left out"),
    key(
        "pressure_angle",
        ANGLE,
        "of gears, 20 deg if left out; below zero where the first pushes the second from y to x",
    )
    .like("\"20 deg\""),
    key("mesh_stiffness", MESH_STIFFNESS, "of gears, along the line of action").like("\"2e8 N/m\""),
    key("mesh_damping", MESH_DAMPING, "of gears, along the line of action").like("\"500 N*s/m\""),
    key(
        "backlash",
        CLEARANCE,
        "of gears, along the line of action from flank to flank; without it teeth never part",
    )
    .like("\"100 um\""),
];

const END: &[Key] = &[
    merged("body", Text, "its name, or \"ground\"").like("\"rotor\""),
    key("sets", NAMES, "one node set, or three: left, middle, right").like("[\"J1\"]"),
    key(
        "z",
        POSITION,
        "on a body of `sections`; on a rigid one where the other side does not say it",
    ),
];

const AT: &[Key] = &[key(
    "at",
    PLACE,
    "of a bushing on a body that rocks: x and y; its centre of mass if left out",
)
.like("[\"-75 mm\", \"0 mm\"]")];

const SIDE: &[Key] = &[
    merged("body", Text, "its name, or \"ground\"").like("\"rotor\""),
    key("sets", NAMES, "one node set, or three: left, middle, right").like("[\"J1\"]"),
    key("surface", Text, "in place of sets: a node set all over the journal, or all over the bore")
        .like("\"JOURNAL\""),
    key(
        "z",
        POSITION,
        "on a body of `sections`; on a rigid one where the other side does not say it",
    ),
];

const SENSOR: &[Key] = &[
    key("z", POSITION, "on a body of `sections`, or on a rigid one"),
    key("set", Text, "on a mesh: a node set around the axis").like("\"PROBE\""),
    key(
        "base",
        Text,
        "a node set of a mesh that carries the bore, on which the sensor stands; the bore if left out",
    )
    .like("\"PROBE_HOLDER\""),
];

const BUSHING_STIFFNESS: &[Key] = &[
    key("xx", CROSS_STIFFNESS, "force along x against a displacement along x"),
    key("xy", CROSS_STIFFNESS, "force along x against a displacement along y"),
    key("yx", CROSS_STIFFNESS, "force along y against a displacement along x"),
    key("yy", CROSS_STIFFNESS, "force along y against a displacement along y"),
];

const BUSHING_DAMPING: &[Key] = &[
    key("xx", CROSS_DAMPING, "force along x against a speed along x"),
    key("xy", CROSS_DAMPING, "force along x against a speed along y"),
    key("yx", CROSS_DAMPING, "force along y against a speed along x"),
    key("yy", CROSS_DAMPING, "force along y against a speed along y"),
];

const BUSHING_TILTING_STIFFNESS: &[Key] = &[
    key("xx", TILTING_STIFFNESS, "moment about x against a tilt about x"),
    key("xy", TILTING_STIFFNESS, "moment about x against a tilt about y"),
    key("yx", TILTING_STIFFNESS, "moment about y against a tilt about x"),
    key("yy", TILTING_STIFFNESS, "moment about y against a tilt about y"),
];

const BUSHING_TILTING_DAMPING: &[Key] = &[
    key("xx", TILTING_DAMPING, "moment about x against a rate of tilt about x"),
    key("xy", TILTING_DAMPING, "moment about x against a rate of tilt about y"),
    key("yx", TILTING_DAMPING, "moment about y against a rate of tilt about x"),
    key("yy", TILTING_DAMPING, "moment about y against a rate of tilt about y"),
];

pub(crate) const DRIVE: &[Key] = &[
    merged("body", Text, "the name of a body that turns freely").like("\"rotor\""),
    key("top", Text, "set of one node, on a mesh").like("\"DRIVE_TOP\""),
    key("bottom", Text, "set of one node, on a mesh").like("\"DRIVE_BOTTOM\""),
    key(
        "section",
        Text,
        "a node set in place of `top` and `bottom`: the couple acts on its mean rotation",
    )
    .like("\"END\""),
    key("torque", TORQUE, "until the target speed is reached; negative turns the other way"),
    key("target_speed", TARGET_SPEED, "of the body, with the sign of the torque"),
    key(
        "release",
        Words(&["located", "step"]),
        "where in a step the couple ends; located if left out",
    ),
    key("table", Text, "couple over time or speed, in place of `torque`").like("\"motor.csv\""),
    key("acts", Flag, "false leaves the body without a drive"),
];

pub(crate) const LOAD: &[Key] = &[
    merged("body", Text, "the name of a body").like("\"rotor\""),
    key("sets", NAMES, "node sets of a mesh").like("[\"LOAD1\"]"),
    key(
        "z",
        POSITION,
        "on a body of `sections`, or on a rigid one; at the centre of that if left out",
    ),
    key("of", Text, "the body whose angle it follows; its own if left out").like("\"rotor\""),
];
