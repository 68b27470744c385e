//! Shafts as rows of sections, with what stands on them by numbers.

use super::draft::{Body, Carried, Row};
use super::fields::File;
use super::layout::{SAME, Shaft};
use super::model::{Material, Model, Named, ShaftElement};
use super::names::Names;
use super::notes::Notes;
use super::webs;

/// Takes the place of a mass that is zero, and of inertias as parts of the other one.
const NEARLY_NOTHING: f64 = 1e-6;
/// A polar inertia is at most so many times twice the transverse one, as values of few digits have it.
const DIGITS: f64 = 1.01;

/// The bodies of shafts, in their order, with their materials.
pub(super) fn bodies(
    file: &File,
    (model, shafts): (&Model, &[Shaft]),
    notes: &mut Notes,
) -> (Vec<Body>, Vec<(String, Material)>) {
    let mut materials: Vec<(String, Material)> = Vec::new();
    let mut names = Names::default();
    let mut bodies: Vec<Body> = Vec::with_capacity(shafts.len());
    for (place, shaft) in shafts.iter().enumerate() {
        let mut rows = rows(&shaft.elements, shaft, |material| {
            let known = materials.iter().position(|own| own.1 == *material);
            known.unwrap_or_else(|| {
                materials.push((names.of(&material.name, "material"), material.clone()));
                materials.len() - 1
            })
        });
        webs::join(&mut rows, &mut materials, notes);
        let name =
            if shafts.len() == 1 { "rotor".to_owned() } else { format!("shaft_{}", place + 1) };
        let damping = damping(shaft, notes);
        bodies.push(Body { name, rows, carried: Vec::new(), damping, held_left: false });
    }
    carry(file, (model, shafts), &mut bodies, notes);
    (bodies, materials)
}

/// Rows from left to right and from the axis outwards; what continues a row is a part of it.
fn rows(
    elements: &[ShaftElement],
    shaft: &Shaft,
    mut material: impl FnMut(&Material) -> usize,
) -> Vec<Row> {
    let mut rows: Vec<(usize, Row)> = Vec::new();
    for own in elements {
        let (z, tag) = (shaft.nodes[&own.n], own.named.tag.clone());
        let material = material(&own.material);
        let near = |a: f64, b: f64| (a - b).abs() <= SAME * own.outer[0];
        let goes_on = |row: &&mut (usize, Row)| {
            let (next, row) = (row.0, &row.1);
            let ends = [row.outer, own.outer].map(|own| own[0]);
            let bores = [row.inner, own.inner].map(|own| own[0]);
            let even = [row.outer, own.outer, row.inner, own.inner];
            next == own.n
                && row.material == material
                && row.mass_outer == own.mass_outer
                && even.iter().all(|own| near(own[0], own[1]))
                && near(ends[0], ends[1])
                && near(bores[0], bores[1])
        };
        match rows.iter_mut().find(goes_on) {
            Some((next, row)) => {
                (*next, row.length) = (own.n + 1, row.length + own.length);
                row.elements[1] = tag;
            }
            None => {
                let (length, outer, inner, mass_outer) =
                    (own.length, own.outer, own.inner, own.mass_outer);
                let elements = [tag.clone(), tag];
                rows.push((
                    own.n + 1,
                    Row { z, length, outer, inner, mass_outer, material, elements },
                ));
            }
        }
    }
    let mut rows: Vec<Row> = rows.into_iter().map(|own| own.1).collect();
    let place = |own: &Row| [own.z, own.inner[0]];
    rows.sort_by(|a, b| place(a).partial_cmp(&place(b)).expect("numbers"));
    rows
}

/// The damping by stiffness that all elements have.
fn damping(shaft: &Shaft, notes: &mut Notes) -> f64 {
    let of = |own: &ShaftElement| own.beta;
    let most = shaft.elements.iter().map(of).fold(0.0, f64::max);
    let least = shaft.elements.iter().map(of).fold(most, f64::min);
    if least == most {
        if most > 0.0 {
            notes.add(format!(
                "differs: the damping beta = {most:?} s of the shaft acts in the frame that turns, where it drives whirl above a \
                 critical speed; in ROSS it acts in space and damps at every speed"
            ));
        }
        return most;
    }
    notes.add(format!(
        "left out: the damping beta of shaft elements, {least:?} to {most:?} s: a body has one for all (`damping`)"
    ));
    0.0
}

/// Gives bodies their discs and masses.
fn carry(file: &File, (model, shafts): (&Model, &[Shaft]), bodies: &mut [Body], notes: &mut Notes) {
    let mut names = Names::default();
    let mut add =
        |named: &Named, tag: &str, at: (usize, f64), inertias: [f64; 3], notes: &mut Notes| {
            let (n, beyond) = at;
            let Some(place) = shafts.iter().position(|own| own.nodes.contains_key(&n)) else {
                let help = format!("its node is one of the shaft: {}", known(shafts));
                let what = format!("`{}`: no shaft has a node {n}", named.tag);
                file.wrong(named.place.clone(), what, help);
                return;
            };
            let Some((mass, inertias)) = masses(tag, inertias, notes) else { return };
            let (name, z) = (names.of(tag, "disc"), shafts[place].nodes[&n] + beyond);
            bodies[place].carried.push(Carried { name, tag: tag.to_owned(), z, mass, inertias });
        };
    for own in &model.discs {
        add(&own.named, &own.named.tag, (own.n, own.beyond), own.inertias, notes);
    }
    for own in &model.couplings {
        for (side, called) in ["left", "right"].into_iter().enumerate() {
            let tag = format!("{} {called}", own.named.tag);
            add(&own.named, &tag, (own.n + side, 0.0), own.ends[side], notes);
        }
    }
    for own in &model.masses {
        if shafts.iter().any(|shaft| shaft.nodes.contains_key(&own.n)) {
            add(
                &own.named,
                &own.named.tag,
                (own.n, 0.0),
                [of_plane(own.mass, &own.named.tag, notes), 0.0, 0.0],
                notes,
            );
        }
    }
    for own in &model.bearings {
        let on_shaft = shafts.iter().any(|shaft| shaft.nodes.contains_key(&own.n));
        let added = [10, 13].map(|which| own.coefficients[which][0]);
        let some = (10..15).any(|which| own.has(which));
        let alike = added[0] == added[1] && added[0] > 0.0 && !own.has(11) && !own.has(12);
        let constant = (10..15).all(|which| own.is_constant(which));
        if !some {
            continue;
        }
        if on_shaft && own.link.is_none() && alike && constant {
            let tag = format!("{} fluid", own.named.tag);
            add(&own.named, &tag, (own.n, 0.0), [added[0], 0.0, 0.0], notes);
            notes.of(
                &own.named.tag,
                "its inertia mxx = myy is a mass on the shaft: take it out where gravity acts",
            );
        } else {
            notes.of(&own.named.tag, "left out: its coefficients of inertia (mxx, mxy, myx, myy, mzz), which joints do not have");
        }
    }
}

/// One mass for the motion along x and y.
pub(super) fn of_plane([x, y, _]: [f64; 3], tag: &str, notes: &mut Notes) -> f64 {
    if x != y {
        notes.of(
            tag,
            format!(
                "differs: its mass is {x:?} kg along x and {y:?} kg along y; here the mean of both"
            ),
        );
        return 0.5 * (x + y);
    }
    x
}

/// Mass and inertias such as a body can have, or none.
fn masses(tag: &str, given: [f64; 3], notes: &mut Notes) -> Option<(f64, Option<[f64; 2]>)> {
    let [mut mass, mut transverse, mut polar] = given;
    if given == [0.0; 3] {
        notes.of(tag, "left out: it has neither mass nor inertia");
        return None;
    }
    if mass == 0.0 {
        notes.of(tag, "differs: it has no mass in ROSS, and 1e-6 kg here");
        mass = NEARLY_NOTHING;
    }
    if transverse == 0.0 && polar == 0.0 {
        return Some((mass, None));
    }
    if polar > 2.0 * transverse * DIGITS {
        notes.of(
            tag,
            format!(
                "differs: no body has a polar inertia of more than twice the transverse one; the transverse one is {:?} kg*m^2 \
                 in ROSS, and half the polar one here",
                transverse
            ),
        );
        transverse = 0.5 * polar;
    }
    if polar == 0.0 {
        notes.of(
            tag,
            "differs: it has no polar inertia in ROSS, and a millionth of the transverse one here",
        );
        polar = NEARLY_NOTHING * transverse;
    }
    Some((mass, Some([transverse, polar])))
}

/// The nodes that there are.
pub(super) fn known(shafts: &[Shaft]) -> String {
    let ends = shafts.iter().filter_map(|own| {
        Some(format!("{} to {}", own.nodes.keys().min()?, own.nodes.keys().max()?))
    });
    ends.collect::<Vec<_>>().join(", ")
}
