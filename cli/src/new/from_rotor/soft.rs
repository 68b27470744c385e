//! Shaft elements that have mass and hardly any stiffness, as those of sleeves and impellers, and materials of the others.

use super::fields::File;
use super::model::{Disc, Model, ShaftElement};
use super::notes::Notes;
use crate::ring::Ring;

/// What is softer than this part of the stiffest element at its node is mass alone.
const SOFT: f64 = 1e-3;
/// Diameters nearer than this part are the same.
const SAME: f64 = 1e-6;

/// Takes such elements out: what is inside of them gets their mass, or else they become discs. Then refuses materials of
/// elements that no solid has.
pub(super) fn split(file: &File, model: &mut Model, notes: &mut Notes) {
    let stiffest = |n: usize, all: &[ShaftElement]| {
        let here = all.iter().filter(|own| own.n == n);
        here.map(|own| own.material.youngs_modulus).fold(0.0, f64::max)
    };
    let all = std::mem::take(&mut model.shaft);
    let is_soft = |own: &ShaftElement| own.material.youngs_modulus < SOFT * stiffest(own.n, &all);
    let (mut soft, mut kept): (Vec<ShaftElement>, Vec<ShaftElement>) =
        all.iter().cloned().partition(is_soft);
    soft.sort_by(|a, b| (a.n, a.inner[0]).partial_cmp(&(b.n, b.inner[0])).expect("numbers"));
    for own in soft {
        let even = |ends: [f64; 2]| (ends[0] - ends[1]).abs() <= SAME * own.outer[0];
        let touches = |inside: &&mut ShaftElement| {
            let up_to = inside.mass_outer.unwrap_or(inside.outer[0]);
            inside.n == own.n
                && even(inside.outer)
                && (up_to - own.inner[0]).abs() <= SAME * own.outer[0]
                && inside.material.density == own.material.density
        };
        let inside = kept.iter_mut().find(touches).filter(|_| even(own.outer) && even(own.inner));
        match inside {
            Some(inside) => {
                inside.mass_outer = Some(own.outer[0]);
                notes.of(
                    &own.named.tag,
                    "has mass and no stiffness to speak of: it is in `mass_outer` of the section inside of it",
                );
            }
            None => {
                notes.of(
                    &own.named.tag,
                    "has mass and no stiffness to speak of: each half of its length is a disc, with the mass, the centre and the \
                     inertia of that half",
                );
                model.discs.extend(halves(&own));
            }
        }
    }
    kept.iter().for_each(|own| material(file, own));
    model.shaft = kept;
}

/// Both halves of an element as discs, each with its mass, its centre and its inertia.
fn halves(own: &ShaftElement) -> [Disc; 2] {
    let radius = |[a, b]: [f64; 2], z: f64| 0.5 * (a + (b - a) * z / own.length);
    let radii = |z: f64, n: i32| radius(own.outer, z).powi(n) - radius(own.inner, z).powi(n);
    [("left", 0.0), ("right", 0.5)].map(|(side, from)| {
        let between = [from, from + 0.5].map(|part| part * own.length);
        let ring = Ring::new(between, own.material.density, 0.0, radii);
        let mut named = own.named.clone();
        named.tag = format!("{} {side}", named.tag);
        let [polar, transverse] = ring.inertias;
        let inertias = [ring.mass, transverse, polar];
        Disc { named, n: own.n, beyond: ring.z, inertias, gear: false }
    })
}

fn material(file: &File, own: &ShaftElement) {
    const SI: &str = "ROSS takes moduli in Pa and densities in kg/m^3: give numbers with units as `Q_(211, \"GPa\")` and save \
                      the rotor again";
    let of = &own.material;
    let wrong = |what: String, help: &str| {
        file.wrong(own.material_place.clone(), format!("`{}`: {what}", own.named.tag), help);
    };
    if !(1e5..1e14).contains(&of.youngs_modulus) {
        wrong(format!("a Young's modulus of {:?} Pa is that of no solid", of.youngs_modulus), SI);
    } else if !(-1.0 < of.poissons_ratio && of.poissons_ratio < 0.5) {
        let what = format!(
            "E and G_s give a Poisson's ratio of {:.4}, which no isotropic solid has: it is between -1 and 0.5",
            of.poissons_ratio
        );
        wrong(what, "correct E or G_s in Python and save the rotor again");
    }
    if of.density > 1e5 {
        wrong(format!("a density of {:?} kg/m^3 is that of no solid", of.density), SI);
    }
}
