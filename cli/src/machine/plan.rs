//! What is to be reduced: meshes with the dofs to retain and to hold, and the output nodes, found by the sets
//! of the case.

mod body;
mod driven;
pub(super) mod geometry;
mod matrices;

use whirl_codegen::diagnostic::{Diagnostics, Located};
use whirl_solver::constraints::GroundSpring;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::shaft::SolidShaft;
use whirl_solver::mesh::support::RingSupport;
use whirl_solver::model::Place;

pub(crate) use self::body::BodyPlan;
pub(super) use self::body::HoldingWords;
pub(super) use self::driven::Turn;
use self::geometry::stations::Extent;
use super::laws::laws;
use super::{fineness, meshes, outputs};
use crate::case::{self, Fields, LawSource, Output, Rotor, RotorDraft};
use crate::errors::Failure;

/// The axis of the short form (m).
const AXIS: [f64; 2] = [0.0; 2];

/// Letters of the components of a dof.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// Both bodies before their reduction.
pub(crate) struct MachinePlan {
    /// The rotating body.
    pub(crate) shaft: BodyPlan,
    /// The standing body.
    pub(crate) support: BodyPlan,
    /// Places of the journals' nodes in the shaft's output nodes, a bearing each.
    pub(super) journals: Vec<[usize; 3]>,
    /// Places of the bores' nodes in the support's output nodes, a bearing each.
    pub(super) bores: Vec<[Vec<usize>; 3]>,
    /// Where the drive acts on the shaft; of two nodes top, then bottom.
    pub(super) drive: Place,
    /// Where each load acts on the shaft.
    pub(super) loads: Vec<Place>,
    /// Places of the points of outputs in the output nodes of their bodies, an output each.
    pub(super) outputs: Vec<usize>,
    /// Bodies that are written as wholes, with the place of their first node among the output nodes.
    pub(super) fields: Vec<(usize, usize)>,
    /// The laws with the values with which the bearings use them, a bearing each; none of a case with errors.
    pub(crate) laws: Vec<LawSource>,
}

/// Both results, or the errors of both beside those that are there.
pub(super) fn both<A, B>(
    first: Result<A, Failure>,
    second: Result<B, Failure>,
    errors: &mut Diagnostics,
) -> Result<(A, B), Failure> {
    let mut take = |failure| match failure {
        Failure::Input(found) => {
            errors.append(found);
            None
        }
        other => Some(other),
    };
    let (first, second) = match (first, second) {
        (Ok(first), Ok(second)) => return Ok((first, second)),
        (first, second) => (first.err(), second.err()),
    };
    let rest: Vec<Failure> = [first, second].into_iter().flatten().filter_map(&mut take).collect();
    let placed = std::mem::take(errors);
    match rest.into_iter().next() {
        Some(failure) if placed.is_empty() => Err(failure),
        _ => Err(placed.into_result(()).expect_err("there are errors").into()),
    }
}

/// What a plan is made from: what a case says, or as much of it as is there.
pub(crate) struct Outline<'a> {
    shaft: Option<&'a case::Shaft>,
    support: Option<&'a case::Support>,
    bearings: Vec<BearingOutline<'a>>,
    drive: Option<&'a case::Drive>,
    loads: &'a [case::Load],
}

/// A bearing as far as a case says it.
pub(super) struct BearingOutline<'a> {
    /// Sets of the journal and of the bore.
    pub(super) sets: [&'a [Located]; 2],
    /// The bearing, if all that it must have is there.
    pub(super) whole: Option<&'a case::Bearing>,
    /// Names of the bodies of journal and bore, where the case names bodies.
    pub(super) bodies: Option<[&'a str; 2]>,
    /// Where its rings may stand, where its joint says more of that than its sets.
    pub(super) extent: Option<Extent>,
}

impl<'a> From<&'a Rotor> for Outline<'a> {
    fn from(rotor: &'a Rotor) -> Self {
        let bearings = rotor.bearings.iter();
        Outline {
            shaft: Some(&rotor.shaft),
            support: Some(&rotor.support),
            bearings: bearings
                .map(|own| BearingOutline {
                    sets: [&own.journal, &own.bore],
                    whole: Some(own),
                    bodies: None,
                    extent: None,
                })
                .collect(),
            drive: Some(&rotor.drive),
            loads: &rotor.loads,
        }
    }
}

impl<'a> From<&'a RotorDraft> for Outline<'a> {
    fn from(draft: &'a RotorDraft) -> Self {
        let bearings = draft.bearings.iter();
        Outline {
            shaft: draft.shaft.as_ref(),
            support: draft.support.as_ref(),
            bearings: bearings
                .map(|(sets, own)| BearingOutline {
                    sets: sets.each_ref().map(Vec::as_slice),
                    whole: own.as_ref(),
                    bodies: None,
                    extent: None,
                })
                .collect(),
            drive: draft.drive.as_ref(),
            loads: &draft.loads,
        }
    }
}

impl MachinePlan {
    /// Reads or makes the meshes, and finds the sets that the case names.
    ///
    /// # Errors
    /// Everything that is wrong with the meshes, every set that is missing or of the wrong size, and what
    /// does not fit together.
    pub(crate) fn new(
        rotor: &Rotor,
        (wanted, fields): (&[Output], Option<&Fields>),
        warnings: &mut Vec<String>,
    ) -> Result<MachinePlan, Failure> {
        let plan = MachinePlan::of(&Outline::from(rotor), Diagnostics::new(), warnings)?;
        let mut plan = plan.expect("nothing of a whole case is missing");
        let mut errors = Diagnostics::new();
        plan.outputs = outputs::places(wanted, |body, set, _| {
            let body = if body == 0 { &mut plan.shaft } else { &mut plan.support };
            set.map_or(0, |set| outputs::on_mesh(body, set, &mut errors))
        });
        for &body in fields.iter().flat_map(|own| &own.bodies) {
            let own = if body == 0 { &mut plan.shaft } else { &mut plan.support };
            plan.fields.push((body, own.output_all()));
        }
        errors.into_result(())?;
        plan.laws = laws(rotor, &plan)?;
        Ok(plan)
    }

    /// As [`MachinePlan::new`], for as much as is there of a case with these errors; they are reported together. None
    /// if nothing is wrong but a body is missing.
    ///
    /// # Errors
    /// These, and those of [`MachinePlan::new`].
    pub(crate) fn of(
        outline: &Outline,
        mut errors: Diagnostics,
        warnings: &mut Vec<String>,
    ) -> Result<Option<MachinePlan>, Failure> {
        let mut rest = None;
        let mut made = |mesh: Result<Mesh, Failure>, errors: &mut Diagnostics| {
            match mesh {
                Ok(mesh) => return Some(mesh),
                Err(Failure::Input(found)) => errors.append(found),
                Err(other) => rest = rest.take().or(Some(other)),
            }
            None
        };
        let shaft = outline.shaft.and_then(|case| {
            let mesh = meshes::mesh((&case.body, AXIS), SolidShaft::mesh, warnings);
            if let (case::Mesh::Generated(made), Ok(_)) = (&case.body.mesh, &mesh) {
                fineness::warn("shaft", &made.table, made.dimensions.fineness(), warnings);
            }
            Some(OnShaft::place(case, made(mesh, &mut errors)?, outline, &mut errors))
        });
        let support = outline.support.and_then(|case| {
            let mesh = meshes::mesh((&case.body, AXIS), RingSupport::mesh, warnings);
            Some(place_support(case, made(mesh, &mut errors)?, outline, &mut errors))
        });
        let mesh_of_support = support.as_ref().map(|(support, _)| &support.mesh);
        let mesh_of_shaft = shaft.as_ref().map(|own| &own.shaft.mesh);
        geometry::compare(mesh_of_shaft, mesh_of_support, outline, &mut errors);
        errors.into_result(())?;
        if let Some(failure) = rest {
            return Err(failure);
        }
        let (Some(on_shaft), Some((support, bores))) = (shaft, support) else { return Ok(None) };
        let OnShaft { shaft, journals, drive, loads } = on_shaft;
        Ok(Some(MachinePlan {
            shaft,
            support,
            journals,
            bores,
            drive,
            loads,
            outputs: Vec::new(),
            fields: Vec::new(),
            laws: Vec::new(),
        }))
    }

    /// Checks for what would keep the bodies from being reduced, without reducing them.
    ///
    /// # Errors
    /// Cells turned inside out, motions that nothing stops.
    pub(crate) fn verify(&self) -> Result<(), Failure> {
        let verify = |body: &BodyPlan| body.verify().map_err(|error| body.explain(error));
        let mut errors = Diagnostics::new();
        both(verify(&self.shaft), verify(&self.support), &mut errors)?;
        Ok(())
    }
}

/// The shaft with the nodes that the case names on it.
struct OnShaft {
    shaft: BodyPlan,
    journals: Vec<[usize; 3]>,
    drive: Place,
    loads: Vec<Place>,
}

impl OnShaft {
    fn place(
        case: &case::Shaft,
        mesh: Mesh,
        outline: &Outline,
        errors: &mut Diagnostics,
    ) -> OnShaft {
        let axial = &case.axial_restraint;
        let body = BodyPlan::new(mesh, &case.body, axial);
        let (journals, loads) = (Vec::new(), Vec::new());
        let mut own = OnShaft { shaft: body, journals, drive: Place::Mean(0), loads };
        let shaft = &mut own.shaft;
        shaft.spec.stiffening = case.stiffening;
        shaft.turning = true;
        for BearingOutline { sets: [sets, _], .. } in &outline.bearings {
            let mut journal = [0; 3];
            for (place, set) in sets.iter().take(3).enumerate() {
                let node = shaft.node(set, errors).unwrap_or(0);
                shaft.retain(set, node, 0);
                shaft.retain(set, node, 1);
                journal[place] = shaft.output_node(node);
            }
            own.journals.push(journal);
        }
        // The axial dof is held.
        let node = shaft.node(axial, errors).unwrap_or(0);
        let held = shaft.retain(axial, node, 2);
        shaft.spec.constraints.fix(format!("axial_restraint ({} z)", axial.text()), held);
        if let Some(drive) = outline.drive {
            own.drive = shaft.tie(drive, errors);
        }
        for (place, load) in outline.loads.iter().enumerate() {
            let name = format!("load {}", place + 1);
            own.loads.push(shaft.loaded((load, &name), errors));
        }
        shaft.correct(errors);
        shaft.bound(errors);
        own
    }
}

/// The support with the nodes that the case names on it, and those of the bores.
fn place_support(
    case: &case::Support,
    mesh: Mesh,
    outline: &Outline,
    errors: &mut Diagnostics,
) -> (BodyPlan, Vec<[Vec<usize>; 3]>) {
    let mounts = &case.mounts;
    let mut support = BodyPlan::new(mesh, &case.body, mounts);
    let mut bores = Vec::new();
    for BearingOutline { sets: [_, sets], .. } in &outline.bearings {
        let mut bore = [const { Vec::new() }; 3];
        for (ring, set) in bore.iter_mut().zip(*sets) {
            let nodes = support.nodes(set, errors);
            *ring = nodes.into_iter().map(|node| support.output_node(node)).collect();
        }
        bores.push(bore);
    }
    for (number, bore) in bores.iter().enumerate() {
        let rings = bore.iter().map(|ring| support.mesh_nodes(ring)).collect();
        support.add_bore(format!("bearing {}", number + 1), AXIS, (rings, None));
    }
    support.correct(errors);
    let held = support.nodes(mounts, errors);
    support.hold("mounts", mounts, &held);
    for spring in &case.ground_springs {
        for node in support.nodes(&spring.set, errors) {
            let axis = AXES[spring.direction];
            let own = GroundSpring {
                name: format!("ground spring ({} {axis})", spring.set.text()),
                dof: 3 * node + spring.direction,
                stiffness: spring.stiffness,
            };
            support.spring(&spring.set, own);
        }
    }
    support.bound(errors);
    (support, bores)
}
