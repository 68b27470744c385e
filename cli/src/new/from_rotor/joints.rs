//! Bearings, seals, supports and couplings as joints and bodies.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use super::bodies::{known, of_plane};
use super::draft::{Acts, Body, Joint, Side, Support};
use super::fields::File;
use super::layout::Shaft;
use super::model::{Bearing, Model};
use super::names::Names;
use super::notes::Notes;

/// Indices of xx, xy, yx, yy, and of zz, of stiffness and of damping.
const STIFFNESS: [usize; 4] = [0, 1, 2, 3];
const DAMPING: [usize; 4] = [4, 5, 6, 7];
const ALONG: [usize; 2] = [8, 9];

/// What a node belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Owner {
    Shaft(usize),
    Support(usize),
}

/// Supports with their nodes, and all joints.
pub(super) fn joints(
    file: &File,
    (model, shafts): (&Model, &[Shaft]),
    bodies: &mut [Body],
    (speed, notes): (f64, &mut Notes),
) -> (Vec<Support>, Vec<Joint>) {
    let mut names = Names::default();
    let taken: Vec<String> = bodies.iter().map(|own| own.name.clone()).collect();
    taken.iter().for_each(|own| drop(names.of(own, "body")));
    let (nodes, mut supports) = supports(file, (model, shafts), &mut names, notes);
    let owner = |node: usize| {
        let shaft = shafts.iter().position(|own| own.nodes.contains_key(&node)).map(Owner::Shaft);
        shaft.or_else(|| nodes.iter().position(|own| *own == node).map(Owner::Support))
    };
    let places = places(model, shafts);
    let mut make = Making {
        bodies,
        supports: &mut supports,
        places,
        names: Names::default(),
        joints: Vec::new(),
    };
    for bearing in &model.bearings {
        let tag = &bearing.named.tag;
        let ends: Vec<usize> = std::iter::once(bearing.n).chain(bearing.link).collect();
        let open = ends.iter().find(|own| owner(**own).is_none());
        if let Some(node) = open {
            let what = format!("`{tag}`: neither a shaft nor a point mass has its node {node}");
            let help = format!(
                "nodes of shafts are {}; a support is a point mass at a node of its own",
                known(shafts)
            );
            file.wrong(bearing.named.place.clone(), what, help);
            continue;
        }
        let mut ends: Vec<(usize, Owner)> =
            ends.iter().filter_map(|own| Some((*own, owner(*own)?))).collect();
        // What turns is the first side.
        if let [(_, Owner::Support(_)), (_, Owner::Shaft(_))] = ends.as_slice() {
            ends.swap(0, 1);
        }
        // Of two shafts the one with the wider bore is around the other one.
        if let [(a, Owner::Shaft(first)), (b, Owner::Shaft(second))] = ends[..]
            && shafts[first].bore(a) > shafts[second].bore(b)
        {
            ends.swap(0, 1);
        }
        if ends.len() == 2 && ends[0].1 == ends[1].1 {
            notes.of(tag, "left out: it joins two nodes of one body");
            continue;
        }
        make.bearing(bearing, &ends, speed, notes);
    }
    for coupling in &model.couplings {
        let ends = [coupling.n, coupling.n + 1].map(|node| owner(node).map(|own| (node, own)));
        let [Some(first), Some(second)] = ends else { continue };
        make.coupling(coupling, [first, second], notes);
    }
    let joints = make.joints;
    along(bodies, &mut supports, &joints, notes);
    (supports, joints)
}

/// Supports by their nodes: point masses that are on no shaft.
fn supports(
    file: &File,
    (model, shafts): (&Model, &[Shaft]),
    names: &mut Names,
    notes: &mut Notes,
) -> (Vec<usize>, Vec<Support>) {
    let mut all: BTreeMap<usize, Support> = BTreeMap::new();
    let on_shaft = |node: usize| shafts.iter().any(|own| own.nodes.contains_key(&node));
    for own in model.masses.iter().filter(|own| !on_shaft(own.n)) {
        let tag = own.named.tag.clone();
        let joined =
            model.bearings.iter().any(|other| other.n == own.n || other.link == Some(own.n));
        let mass = of_plane(own.mass, &tag, notes);
        let what = match (joined, mass > 0.0) {
            (false, _) => Some(format!(
                "`{tag}`: no shaft has its node {}, and no bearing leads there",
                own.n
            )),
            (true, false) => Some(format!("`{tag}`: the mass of a support is above zero")),
            (true, true) => None,
        };
        if let Some(what) = what {
            let help = "correct it in Python and save the rotor again with `rotor.save(…)`";
            file.wrong(own.named.place.clone(), what, help);
        }
        match all.get_mut(&own.n) {
            Some(known) => known.mass += mass,
            None => {
                let name = names.of(&tag, "support");
                all.insert(own.n, Support { name, tag, mass, moves_along_z: false });
            }
        }
    }
    all.into_iter().unzip()
}

/// z of all nodes (m): supports are where the bearings are that stand on them.
fn places(model: &Model, shafts: &[Shaft]) -> BTreeMap<usize, f64> {
    let mut places: BTreeMap<usize, f64> =
        shafts.iter().flat_map(|own| own.nodes.iter().map(|(n, z)| (*n, *z))).collect();
    loop {
        let before = places.len();
        for (a, b) in model.bearings.iter().filter_map(|own| Some((own.n, own.link?))) {
            for (known, open) in [(a, b), (b, a)] {
                if let (Some(&z), false) = (places.get(&known), places.contains_key(&open)) {
                    places.insert(open, z);
                }
            }
        }
        if places.len() == before {
            return places;
        }
    }
}

struct Making<'m> {
    bodies: &'m mut [Body],
    supports: &'m mut [Support],
    places: BTreeMap<usize, f64>,
    names: Names,
    joints: Vec<Joint>,
}

impl Making<'_> {
    fn side(&self, (node, owner): (usize, Owner)) -> Side {
        let body = match owner {
            Owner::Shaft(own) => self.bodies[own].name.clone(),
            Owner::Support(own) => self.supports[own].name.clone(),
        };
        Side { body, z: self.places.get(&node).copied().unwrap_or(0.0), end: None }
    }

    fn bearing(
        &mut self,
        bearing: &Bearing,
        ends: &[(usize, Owner)],
        speed: f64,
        notes: &mut Notes,
    ) {
        let tag = &bearing.named.tag;
        if bearing.has(ALONG[1]) && !bearing.has(ALONG[0]) {
            notes.of(tag, "left out: its damping along z (czz), as it has no stiffness along z");
        }
        if !(0..9).any(|which| bearing.has(which)) {
            notes.of(tag, "left out: it has neither stiffness nor damping");
            return;
        }
        let turns = |own: Option<&(usize, Owner)>| matches!(own, Some((_, Owner::Shaft(_))));
        let (first, second) = (turns(ends.first()), turns(ends.get(1)));
        let varies = STIFFNESS.iter().chain(&DAMPING).any(|own| !bearing.is_constant(*own));
        let at = |which: usize| bearing.at(which, speed);
        if varies && (!first || second) {
            notes.of(tag, "differs: its coefficients are those at the speed of the case, not a table: both its sides turn, or none does");
        }
        if ALONG.iter().any(|own| !bearing.is_constant(*own)) {
            notes.of(
                tag,
                "differs: its coefficients along z are those at the speed of the case, not a table",
            );
        }
        let acts = match (first && second, varies && first) {
            (true, _) => between(bearing, speed, notes),
            (false, true) => Acts::Table(table(bearing)),
            (false, false) => Acts::Springs(STIFFNESS.map(at), DAMPING.map(at)),
        };
        let sides: Vec<Side> = ends.iter().map(|own| self.side(*own)).collect();
        let mut sides = sides.into_iter();
        let Some(first) = sides.next() else { return };
        let (name, along) = (self.names.of(tag, "bearing"), ALONG.map(at));
        self.joints.push(Joint {
            name,
            tag: tag.clone(),
            first,
            second: sides.next(),
            acts,
            along,
        });
    }

    /// Springs of a coupling as a law between both shafts, and its torsion.
    fn coupling(
        &mut self,
        own: &super::model::Coupling,
        ends: [(usize, Owner); 2],
        notes: &mut Notes,
    ) {
        let tag = &own.named.tag;
        let [first, second] = ends.map(|own| self.side(own));
        let mut mean = |what: &str, [x, y]: [f64; 2]| {
            if x != y {
                notes.of(tag, format!("differs: its {what} differs along x and y in space, but would turn with the shaft; here the mean of both"));
            }
            0.5 * (x + y)
        };
        let (k, c) = (own.stiffness, own.damping);
        let stiffness =
            [mean("stiffness", [k[0], k[1]]), k[2], mean("tilting stiffness", [k[3], k[4]])];
        let damping = [mean("damping", [c[0], c[1]]), c[2], mean("tilting damping", [c[3], c[4]])];
        let along = [0.0; 2];
        if stiffness.iter().chain(&damping).any(|own| *own != 0.0) {
            if damping.iter().any(|own| *own != 0.0) {
                notes.of(tag, TURNING_DAMPING);
            }
            let acts = Acts::Law(stiffness, damping);
            let name = self.names.of(&format!("{tag} bending"), "coupling");
            let [mut first, mut second] = [first.clone(), second.clone()];
            // All nodes of both ends: a bore at a z would be the axis of a full shaft.
            (first.end, second.end) = (Some("RIGHT_END"), Some("LEFT_END"));
            let second = Some(second);
            self.joints.push(Joint { name, tag: tag.clone(), first, second, acts, along });
        }
        if k[5] != 0.0 || c[5] != 0.0 {
            let acts = Acts::Torsion(k[5], c[5]);
            let name = self.names.of(tag, "coupling");
            self.joints.push(Joint {
                name,
                tag: tag.clone(),
                first,
                second: Some(second),
                acts,
                along,
            });
        }
    }
}

const TURNING_DAMPING: &str = "differs: its damping acts in the frame of its second shaft, which turns; in ROSS it acts in space";

/// What a bearing does between two shafts that turn: the same in all directions.
fn between(bearing: &Bearing, speed: f64, notes: &mut Notes) -> Acts {
    let tag = &bearing.named.tag;
    let mut round = |what: &str, of: [usize; 4]| {
        let [xx, xy, yx, yy] = of.map(|own| bearing.at(own, speed));
        if xx != yy || xy != 0.0 || yx != 0.0 {
            notes.of(
                tag,
                format!(
                    "differs: its {what} is not the same in all directions, and stands in space in ROSS; between two shafts that \
                     turn it would turn with the second one, and is the mean of xx and yy here"
                ),
            );
        }
        0.5 * (xx + yy)
    };
    let stiffness = [round("stiffness", STIFFNESS), bearing.at(ALONG[0], speed), 0.0];
    let damping = [round("damping", DAMPING), bearing.at(ALONG[1], speed), 0.0];
    if damping.iter().any(|own| *own != 0.0) {
        notes.of(tag, TURNING_DAMPING);
    }
    Acts::Law(stiffness, damping)
}

/// Coefficients over the speed as a file.
fn table(bearing: &Bearing) -> String {
    let mut text = format!(
        "# {}, as ROSS has it\nspeed [rad/s]",
        bearing.named.tag.replace(['\n', '\r'], " ")
    );
    for (letter, unit) in [("k", "N/m"), ("c", "N*s/m")] {
        for direction in ["xx", "xy", "yx", "yy"] {
            write!(text, ", {letter}_{direction} [{unit}]").expect("text can be written");
        }
    }
    for (row, speed) in bearing.speeds.iter().enumerate() {
        write!(text, "\n{speed:?}").expect("text can be written");
        for which in STIFFNESS.into_iter().chain(DAMPING) {
            let own = &bearing.coefficients[which];
            write!(text, ", {:?}", own[row.min(own.len() - 1)]).expect("text can be written");
        }
    }
    text + "\n"
}

/// Lets supports move along z that a spring along z leads to the ground from, and holds shafts on which a law acts along z that
/// no spring holds.
fn along(bodies: &mut [Body], supports: &mut [Support], joints: &[Joint], notes: &mut Notes) {
    let stiff = |own: &Joint| match own.acts {
        Acts::Law(k, _) => k[1] != 0.0,
        Acts::Torsion(..) => false,
        _ => own.along[0] != 0.0,
    };
    let shafts: BTreeSet<&str> = bodies.iter().map(|own| own.name.as_str()).collect();
    // Names of bodies that springs along z lead to the ground from.
    let mut held: BTreeSet<&str> = BTreeSet::new();
    loop {
        let before = held.len();
        for own in joints.iter().filter(|own| stiff(own)) {
            match &own.second {
                None => drop(held.insert(own.first.body.as_str())),
                Some(other) if held.contains(other.body.as_str()) => {
                    held.insert(own.first.body.as_str());
                }
                Some(other) if held.contains(own.first.body.as_str()) => {
                    held.insert(other.body.as_str());
                }
                // A support that nothing else holds stands still.
                Some(other) if !shafts.contains(other.body.as_str()) => {
                    held.insert(own.first.body.as_str());
                }
                Some(_) => {}
            }
        }
        if held.len() == before {
            break;
        }
    }
    let grounded: BTreeSet<String> = joints
        .iter()
        .filter(|own| stiff(own) && own.second.is_none())
        .map(|own| own.first.body.clone())
        .collect();
    for own in supports {
        own.moves_along_z = grounded.contains(&own.name);
        let touched = joints.iter().any(|joint| {
            stiff(joint)
                && [Some(&joint.first), joint.second.as_ref()]
                    .into_iter()
                    .flatten()
                    .any(|side| side.body == own.name)
        });
        if touched && !own.moves_along_z {
            notes.of(&own.tag, "differs: it does not move along z, as no spring along z leads from it to the ground");
        }
    }
    let held: BTreeSet<String> = held.into_iter().map(str::to_owned).collect();
    for own in bodies {
        let by_law = joints.iter().any(|joint| {
            let sides = [Some(&joint.first), joint.second.as_ref()];
            matches!(joint.acts, Acts::Law(..))
                && sides.into_iter().flatten().any(|side| side.body == own.name)
        });
        own.held_left = by_law && !held.contains(&own.name);
    }
}
