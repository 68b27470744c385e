//! Journals and bores that are surfaces of meshes, with springs on the faces of a bore.

use std::collections::{BTreeMap, HashMap};

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::bearing::BoreSurface;
use whirl_solver::film::{Grid, Sample};
use whirl_solver::mesh::{MeanComponent, Surface};

use super::clearance;
use super::planned_body::PlannedBody;
use super::planned_joint::PlannedJoint;
use crate::case::Joint;
use crate::machine::plan::BodyPlan;
use crate::machine::wording::mm;

/// z of both ends of a surface; an error where the set has no faces.
pub(super) fn ends(plan: &BodyPlan, set: &Located, errors: &mut Diagnostics) -> Option<[f64; 2]> {
    let surface = Surface::of_set(&plan.mesh, set.text(), [0.0; 2]).ok()?;
    if surface.is_empty() {
        let message = format!(
            "the nodes of `{}` span no face of {}: they are not a surface",
            set.text(),
            plan.mesh.origin()
        );
        let help =
            "name a set with all nodes of the faces, or write `sets` for rings and single nodes";
        errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    Some(surface.ends())
}

/// The output points of a journal at these z (m) on its axis: they move with the mean motion of its surface, of which
/// displacements and tilts are retained.
pub(super) fn journal(
    plan: &mut BodyPlan,
    (set, nodes): (&Located, &[usize]),
    (axis, z): ([f64; 2], [f64; 3]),
    errors: &mut Diagnostics,
) -> Option<[usize; 3]> {
    let mean = plan.mean_of(std::slice::from_ref(set), nodes);
    if !(0..2).all(|about| plan.spec.means[mean].turns_about(about)) {
        let message = format!("the nodes of `{}` define no tilt of the journal", set.text());
        let help = "name a set with the faces of the journal, from one end to the other";
        errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    for along in 0..2 {
        plan.retain_mean(set, mean, MeanComponent::Displacement(along));
        plan.retain_mean(set, mean, MeanComponent::Rotation(along));
    }
    Some(z.map(|z| plan.output_on(mean, [axis[0], axis[1], z])))
}

/// Where the springs of a bore stand.
pub(super) struct Springs<'a> {
    /// x and y of the axis of the bore (m).
    pub(super) axis: [f64; 2],
    /// z of every station and of the middle (m).
    pub(super) stations: Vec<f64>,
    pub(super) middle: f64,
    /// Around the axis (rad).
    pub(super) angles: &'a [f64],
    /// The nodes of a film under which the bore gives way, and z of its middle.
    pub(super) film: Option<&'a (Grid, f64)>,
}

/// The points of the faces on which springs stand.
pub(super) fn bore(
    plan: &mut BodyPlan,
    (set, nodes): (&Located, &[usize]),
    springs: Springs,
    errors: &mut Diagnostics,
) -> Option<BoreSurface> {
    let mesh = plan.mesh.clone();
    let surface = Surface::of_set(&mesh, set.text(), springs.axis).ok()?;
    let mut places: HashMap<usize, usize> = HashMap::new();
    let mut point = |what: &str, [angle, z]: [f64; 2]| {
        let Some(point) = surface.at(angle, z) else {
            let [from, to] = surface.ends();
            let message = format!(
                "`{}` has no face at {:.1}° and z = {}, where {what} belongs; it extends from z = {} to {}",
                set.text(),
                angle.to_degrees(),
                mm(z),
                mm(from),
                mm(to)
            );
            return Err(message);
        };
        let placed = point.into_iter().map(|(node, weight)| {
            let place = *places.entry(node).or_insert_with(|| plan.output_node(node));
            (place, weight)
        });
        Ok(placed.collect::<Vec<(usize, f64)>>())
    };
    let mut found = || -> Result<_, (String, &str)> {
        let mut points = Vec::with_capacity(springs.stations.len());
        for &z in &springs.stations {
            let (what, help) = match springs.film {
                Some(_) => ("the film", OF_FILM),
                None => ("a spring", OF_SPRINGS),
            };
            let ring = springs.angles.iter().map(|&angle| point(what, [angle, z]));
            points.push(ring.collect::<Result<Vec<_>, _>>().map_err(|own| (own, help))?);
        }
        let Some((grid, middle)) = springs.film else { return Ok((points, Vec::new())) };
        let mut film = vec![BTreeMap::new(); grid.nodes()];
        for Sample { angle, z, shares } in grid.samples() {
            let seen = point("the film", [angle, middle + z]).map_err(|own| (own, OF_FILM))?;
            for (node, share) in shares {
                for &(place, weight) in &seen {
                    *film[node].entry(place).or_insert(0.0) += share * weight;
                }
            }
        }
        Ok((points, film.into_iter().map(|own| own.into_iter().collect()).collect()))
    };
    let (points, film) = match found() {
        Ok(found) => found,
        Err((message, help)) => {
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
            return None;
        }
    };
    let mean = plan.mean_of(std::slice::from_ref(set), nodes);
    let Springs { stations, middle, .. } = springs;
    Some(BoreSurface { stations, middle, points, mean, film })
}

const OF_SPRINGS: &str =
    "list `stations` at which the bore is closed all around, or name a set with all its faces";
const OF_FILM: &str = "name a set with all faces of the bore, give the film a `length` that they have, or write `flexible = false` \
                       in its table `film`: then it stays as round as it is";

/// The axes of a bore and of its surface are apart by at most this part of the clearance.
const AXES: f64 = 0.01;
/// Nodes on a circle are known to this part of its radius.
const DIGITS: f64 = 1e-6;
/// What meshes leave between journal and bore differs from the clearance of the case by this part of it without a warning.
const GAP: f64 = 0.5;

/// Notes surfaces that are not about the axis, and says where radii leave another clearance than that of the case.
pub(super) fn compare(
    joint: &Joint,
    planned: &PlannedJoint,
    bodies: &[PlannedBody],
    warnings: &mut Vec<String>,
    errors: &mut Diagnostics,
) {
    let c = planned.bearing.radial_clearance;
    let mut radii = Vec::new();
    for (place, side) in joint.sides.iter().enumerate() {
        let (true, [set]) = (side.surface, side.sets.as_slice()) else { continue };
        let Some(found) = clearance::circle_of(side, bodies) else { continue };
        radii.push(found.radius);
        // What a case says of an offset may be drawn in the mesh, or not.
        let axes = match place {
            0 => [planned.axis; 2],
            _ => {
                let axis = planned.sides.bore_axis;
                [axis, [0, 1].map(|k| axis[k] + joint.offset[1][k])]
            }
        };
        let away = |[x, y]: [f64; 2]| (found.centre[0] - x).hypot(found.centre[1] - y);
        let off = away(axes[0]).min(away(axes[1]));
        let allowed = (AXES * c).max(DIGITS * found.radius).max(found.deviation);
        if off > allowed {
            let message = format!(
                "the axis of the surface `{}` is at x = {}, y = {}: {} from that of this joint",
                set.text(),
                mm(found.centre[0]),
                mm(found.centre[1]),
                mm(off)
            );
            let help = match place {
                0 => "name the surface of a journal about the axis of its body, or correct the `axis` of the body".to_owned(),
                _ => format!(
                    "write `offset = [\"{}\", \"{}\"]` if the bore is meant to be there, or correct the `axis` of the body",
                    mm(found.centre[0] - planned.sides.bore_axis[0]),
                    mm(found.centre[1] - planned.sides.bore_axis[1])
                ),
            };
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    if let ([bore], Some(journal), true) = (
        &radii[..],
        planned.bearing.journal_radius,
        joint.sides[1].surface && !joint.sides[0].surface,
    ) && (bore - journal - c).abs() > GAP * c + DIGITS * bore
    {
        warnings.push(format!(
            "{}: between the journal of radius {} of the joint `{}` and its bore in the mesh (radius {}) are {}, but the case \
             gives a clearance of {}, which is used",
            joint.name.source().path.display(),
            mm(journal),
            joint.name.text(),
            mm(*bore),
            mm(bore - journal),
            mm(c)
        ));
    }
    if let [journal, bore] = radii[..]
        && (bore - journal - c).abs() > GAP * c + DIGITS * bore
    {
        warnings.push(format!(
            "{}: the meshes leave {} between the surfaces of the joint `{}` (radii {} and {}), but the case gives a \
             clearance of {}, which is used",
            joint.name.source().path.display(),
            mm(bore - journal),
            joint.name.text(),
            mm(journal),
            mm(bore),
            mm(c)
        ));
    }
}
