//! What case and machine files may say. An included file can give whatever is left out, so that only
//! the entries of lists, which are never merged, need keys.

use whirl_specs::MOTIONS;

use super::shape::Shape::{self, Count, Either, Flag, Number, Quantity, Table, Text, Words};
use super::shape::{Key, key, list, named, needed, tuple};

/// A case or machine file.
pub(super) fn case() -> Shape {
    let names = || Either(vec![Text, list(Text)]);
    let load = Table(vec![
        needed("sets", names(), "node sets; every node carries the force"),
        key("direction", Words(vec!["x", "y"]), "fixed in space; x if left out"),
        needed("force", Quantity("1000 N"), "on each node"),
        key("frequency", Quantity("37.5 Hz"), "of F sin(2πft + φ); a constant force without it"),
        key("phase", Quantity("90 deg"), "φ"),
    ]);
    let stop = Table(vec![
        key(
            "side",
            Words(vec!["above", "below", "around"]),
            "towards greater or smaller x, or all around",
        ),
        key("gap", Quantity("1 mm"), "clearance at x = 0; a law all around has it in itself"),
        needed("law", Text, "the name of a law, or the path of a law file"),
    ]);
    Table(vec![
        key("include", names(), "files whose keys hold where this one says nothing"),
        key("title", Text, "one line for people"),
        key("source", Text, "paper, standard or book"),
        key("material", named(material()), "materials by name"),
        key("shaft", shaft(), "the rotating body"),
        key("support", support(), "the standing body"),
        key("springs", Table(springs()), "what all bearings share"),
        key("bearing", list(bearing()), "where the shaft runs in the support"),
        key("drive", drive(), "what turns the shaft"),
        key("load", list(load), "forces on the shaft"),
        key("mass", mass(), "instead of shaft and support: one mass"),
        key("stop", list(stop), "what the mass may strike"),
        key("march", march(), "steps in time"),
        key("figures", figures(), "laws drawn, and numbers of the figures in the paper"),
    ])
}

fn material() -> Shape {
    Table(vec![
        key("youngs_modulus", Quantity("200 GPa"), "E"),
        key("poissons_ratio", Number, "between -1 and 0.5"),
        key("density", Quantity("7860 kg/m^3"), "mass a volume"),
    ])
}

fn position(name: &'static str, about: &'static str) -> Key {
    key(name, Quantity("24 mm"), about)
}

fn positions(name: &'static str, about: &'static str) -> Key {
    key(name, list(Quantity("24 mm")), about)
}

fn body(keys: Vec<Key>) -> Shape {
    let common = [
        key("mesh", Text, "an Abaqus or CalculiX input file in m, Pa, kg/m³"),
        key("material", Text, "the name of a material"),
        key("modes", Count(0), "fixed-interface modes kept"),
        key("damping", Quantity("1e-4 s"), "C = damping · K"),
    ];
    Table(common.into_iter().chain(keys).collect())
}

fn shaft() -> Shape {
    let cells = Table(vec![
        key("sectors", Count(1), "cells around"),
        key("rings", Count(1), "cells from the centre outwards"),
    ]);
    let dimensions = Table(vec![
        position("length", "of the shaft"),
        position("diameter", "of the shaft"),
        positions("supports", "z of their middles"),
        position("support_length", "along z"),
        key("layers_in_support", Count(1), "cells along a support"),
        key("layers_between", Count(1), "cells along z between supports"),
        positions("loads", "z of loaded nodes on the centre line"),
        key("cells", cells, "cells of the section"),
    ]);
    let motions = MOTIONS.iter().map(|motion| motion.origin.name).collect();
    body(vec![
        key("dimensions", dimensions, "a mesh made from a few dimensions"),
        key("axial_restraint", Text, "set of one node held along z"),
        key("motion", Words(motions), "how rotation is coupled to deformation"),
    ])
}

fn support() -> Shape {
    let cells = ["height", "width", "pedestal", "around", "radial"];
    let cells = Table(cells.into_iter().map(|name| key(name, Count(1), "cells")).collect());
    let dimensions = Table(vec![
        position("start", "z of the beam's end"),
        position("length", "of the beam"),
        position("height", "of the beam"),
        position("width", "of the beam"),
        position("pedestal_height", "between beam and ring"),
        positions("rings", "z of their middles"),
        position("ring_length", "along z"),
        position("ring_thickness", "of the wall"),
        position("bore_radius", "of the bore"),
        key("layers_in_ring", Count(1), "cells along a ring"),
        key("layers_between", Count(1), "cells along z between rings"),
        key("cells", cells, "cells of the section"),
    ]);
    let ground = Table(vec![
        needed("set", Text, "node set"),
        key("direction", Words(vec!["x", "y", "z"]), "x if left out"),
        needed("stiffness", Quantity("1e8 N/m"), "of each node"),
    ]);
    body(vec![
        key("dimensions", dimensions, "a mesh made from a few dimensions"),
        key("mounts", Text, "node set held in x, y and z"),
        key("ground_spring", list(ground), "springs to the ground"),
    ])
}

fn springs() -> Vec<Key> {
    vec![
        key("number", Count(3), "springs in a ring"),
        key("radial_clearance", Quantity("35 um"), "of the undeformed bearing"),
        key("journal_radius", Quantity("34 mm"), "for slip; that of the bore less the clearance"),
        key("law", Text, "the name of a law, or the path of a law file"),
    ]
}

fn bearing() -> Shape {
    let sets = || tuple(Text, 3);
    let mut keys = vec![
        needed("journal", sets(), "sets of one node: left, middle, right"),
        needed("bore", sets(), "sets around the bore: left, middle, right"),
        positions("stations", "z of the rings of springs"),
    ];
    keys.extend(springs());
    Table(keys)
}

fn drive() -> Shape {
    Table(vec![
        key("top", Text, "set of one node"),
        key("bottom", Text, "set of one node"),
        key("torque", Quantity("109 N*m"), "until the target speed is reached"),
        key("target_speed", Quantity("4500 rpm"), "of the shaft"),
        key("acts", Flag, "false leaves the shaft without a drive"),
    ])
}

fn mass() -> Shape {
    let motions = MOTIONS.iter().map(|motion| motion.origin.name).collect();
    let unbalance = Table(vec![
        key("eccentricity", Quantity("0.5 mm"), "of the centre of mass"),
        key("speed", Quantity("4500 rpm"), "constant"),
    ]);
    Table(vec![
        key("unbalance", unbalance, "the mass turns off its axis"),
        key("mass", Quantity("100 kg"), "m"),
        key("stiffness", Quantity("1e4 N/m"), "of its spring"),
        key("damping", Quantity("20 N*s/m"), "of its damper"),
        key("displacement", Quantity("1 mm"), "at t = 0"),
        key("velocity", Quantity("1 m/s"), "at t = 0"),
        key("force", Quantity("50 N"), "constant"),
        key("motion", Words(motions), "without effect: nothing turns"),
    ])
}

fn march() -> Shape {
    Table(vec![
        key("time_step", Quantity("7.4e-5 s"), "Δt"),
        key("steps", Count(1), "or a duration"),
        key("duration", Quantity("0.4 s"), "or a number of steps"),
        key(
            "force_tolerance",
            Quantity("1e-3 N"),
            "change of a spring force at which a step has converged",
        ),
        key(
            "cycle_frequency",
            Quantity("37.5 Hz"),
            "of the cycle over which results are summed up",
        ),
    ])
}

fn figures() -> Shape {
    let number = |name| key(name, Count(1), "number of the figure in the paper");
    let mut keys =
        vec![key("laws", Either(vec![Text, list(Text)]), "laws drawn beside each other")];
    keys.extend(["law", "reactions", "eccentricity", "rotation"].map(number));
    Table(keys)
}
