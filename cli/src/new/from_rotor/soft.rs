//! Shaft elements that have mass and hardly any stiffness, as those of sleeves and impellers, and materials of the others.

use std::f64::consts::PI;

use super::fields::File;
use super::model::{Disc, Model, ShaftElement};
use super::notes::Notes;

/// What is softer than this part of the stiffest element at its node is mass alone.
const SOFT: f64 = 1e-3;
/// Diameters nearer than this part are the same.
const SAME: f64 = 1e-6;

/// Takes such elements out: what is inside of them gets their mass, or else both of their nodes. Then refuses materials of
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
                    "has mass and no stiffness to speak of: half of it is a disc at each of its nodes",
                );
                model.discs.extend(halves(&own));
            }
        }
    }
    kept.iter().for_each(|own| material(file, own));
    model.shaft = kept;
}

/// Both halves of an element as discs, of which each is thin.
fn halves(own: &ShaftElement) -> [Disc; 2] {
    // Of the whole, with the mean of its ends.
    let power = |k: i32| {
        let at = |d: [f64; 2]| 0.5 * (d[0].powi(k) + d[1].powi(k));
        at(own.outer) - at(own.inner)
    };
    let density = own.material.density * own.length * PI;
    let (mass, polar) = (0.5 * density * power(2) / 4.0, 0.5 * density * power(4) / 32.0);
    [own.n, own.n + 1].map(|n| {
        let mut named = own.named.clone();
        named.tag += if n == own.n { " left" } else { " right" };
        Disc { named, n, inertias: [mass, 0.5 * polar, polar], gear: false }
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
