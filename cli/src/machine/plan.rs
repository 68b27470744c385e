//! What is to be reduced: meshes with the dofs to retain, hold and watch, found by the sets of the case.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::{Constraints, GroundSpring, add_ground_springs, free_motions};
use whirl_solver::error::Error;
use whirl_solver::mesh::Mesh;
use whirl_solver::reduction::ReductionError;

use super::{Counts, meshes};
use crate::case::{self, Rotor, RotorDraft};
use crate::errors::Failure;

/// Bytes that the factor of a stiffness matrix may take.
const FACTOR_MEMORY: usize = 8 << 30;
/// Most coordinates of a reduced body, whose matrices are dense.
const MOST_KEPT: usize = 5_000;
/// Letters of the components of a dof.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Both bodies before their reduction.
pub(crate) struct Plan {
    /// The rotating body.
    pub(crate) shaft: BodyPlan,
    /// The standing body.
    pub(crate) support: BodyPlan,
    /// Places of the journals' nodes in the shaft's watched nodes, a bearing each.
    pub(super) journals: Vec<[usize; 3]>,
    /// Places of the bores' nodes in the support's watched nodes, a bearing each.
    pub(super) bores: Vec<[Vec<usize>; 3]>,
    /// Places of the driven nodes in the shaft's watched nodes: top, bottom.
    pub(super) drive: [usize; 2],
    /// Places of the loaded nodes in the shaft's watched nodes, a load each.
    pub(super) loads: Vec<Vec<usize>>,
}

/// A body before its reduction.
pub(crate) struct BodyPlan {
    /// Mesh with materials.
    pub(crate) mesh: Mesh,
    /// How it is reduced; its nodes are those watched.
    pub(crate) spec: BodySpec,
    /// What holds it, as the case says it.
    held_by: Located,
    /// What it is made from, as the case says it.
    made_from: Located,
}

impl BodyPlan {
    fn new(mesh: Mesh, made_from: Located, modes: usize, damping: f64, held_by: &Located) -> Self {
        let spec = BodySpec {
            retained: Vec::new(),
            modes,
            constraints: Constraints::new(),
            springs: Vec::new(),
            damping: Rayleigh { alpha: 0.0, beta: damping },
            nodes: Vec::new(),
            memory: FACTOR_MEMORY,
        };
        BodyPlan { mesh, spec, held_by: held_by.clone(), made_from }
    }

    /// Sizes of the body, as in the paper's Table 1.
    pub(crate) fn counts(&self) -> Counts {
        let (physical, retained) = (self.mesh.dof_count(), self.spec.retained.len());
        Counts {
            elements: self.mesh.cell_count(),
            nodes: self.mesh.nodes().len(),
            physical_dofs: physical,
            internal_dofs: physical - retained,
            retained_dofs: retained,
            modes: self.spec.modes,
            craig_bampton_dofs: self.spec.modes + retained,
        }
    }

    /// Coordinates left after the equations.
    pub(crate) fn active(&self) -> usize {
        let spec = &self.spec;
        spec.modes + spec.retained.len() - spec.constraints.equations().len()
    }

    /// An error of the reduction, at its place in the case or in the mesh's file.
    pub(super) fn explain(&self, error: Error) -> Failure {
        match error {
            Error::InvertedCells { .. } => meshes::inverted(&error),
            Error::Reduction(ReductionError::Mechanism { motions }) => {
                let motions: Vec<String> = motions.iter().map(ToString::to_string).collect();
                let message =
                    format!("{} can still move freely: {}", self.mesh.origin(), motions.join("; "));
                let help = "against each of these motions hold more nodes or, on the support, add a spring \
                            `[[support.ground_spring]]`";
                Diagnostics::from(self.held_by.error_here(Code::BAD_VALUE, message).help(help))
                    .into()
            }
            Error::Reduction(_) | Error::Constraint { .. } => {
                let message = format!("{}: {error}", self.mesh.origin());
                Diagnostics::from(self.held_by.error_here(Code::BAD_VALUE, message)).into()
            }
            _ => {
                let message = error.to_string();
                Diagnostics::from(self.made_from.error_here(Code::BAD_VALUE, message)).into()
            }
        }
    }

    /// Looks for cells turned inside out and for motions that nothing stops.
    fn verify(&self) -> Result<(), Error> {
        let elastic = assemble(&self.mesh, "stiffness")?;
        let stiffness = add_ground_springs(&elastic, &self.spec.springs)?;
        let mut held = Constraints::new();
        self.spec.retained.iter().for_each(|retained| held.fix(&retained.name, retained.dof));
        match free_motions(self.mesh.nodes(), &stiffness, &held)? {
            motions if motions.is_empty() => Ok(()),
            motions => Err(ReductionError::Mechanism { motions }.into()),
        }
    }

    /// Retains a dof; its place among the retained ones.
    fn retain(&mut self, set: &Located, node: usize, axis: usize) -> usize {
        let dof = 3 * node + axis;
        let retained = &mut self.spec.retained;
        if let Some(place) = retained.iter().position(|known| known.dof == dof) {
            return place;
        }
        retained.push(Retained { dof, name: format!("{} {}", set.text(), AXES[axis]) });
        retained.len() - 1
    }

    /// Watches a node; its place among the watched ones.
    fn watch(&mut self, node: usize) -> usize {
        self.spec.nodes.push(node);
        self.spec.nodes.len() - 1
    }

    /// Notes more coordinates than dense matrices of them have room for.
    fn bound(&self, errors: &mut Diagnostics) {
        let kept = self.spec.retained.len();
        if kept + self.spec.modes > MOST_KEPT {
            let message = format!(
                "{} keeps {kept} degrees of freedom and {} modes, at most {MOST_KEPT} are allowed",
                self.mesh.origin(),
                self.spec.modes
            );
            let help = "lower `modes`, or hold and connect smaller sets of nodes";
            errors.push(self.held_by.error_here(Code::BAD_VALUE, message).help(help));
        }
    }

    /// Nodes of a set; what is wrong with it is noted, and none are given.
    fn nodes(&self, set: &Located, errors: &mut Diagnostics) -> Vec<usize> {
        // A set that the case does not say is missing, which has been told.
        if set.text().is_empty() && !errors.is_empty() {
            return Vec::new();
        }
        match self.mesh.node_set(set.text()) {
            Ok(nodes) => nodes.to_vec(),
            Err(error) => {
                let message = format!("{} has no node set `{}`", self.mesh.origin(), set.text());
                let help = match error {
                    Error::MissingSet { nearest: Some(near), .. } => {
                        format!("did you mean `{near}`?")
                    }
                    _ => {
                        let sets = self.mesh.node_sets().keys();
                        let known: Vec<&str> = sets.map(String::as_str).collect();
                        format!("name one of its sets{}", listed(&known))
                    }
                };
                errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
                Vec::new()
            }
        }
    }

    /// The only node of a set; what is wrong with it is noted.
    fn node(&self, set: &Located, errors: &mut Diagnostics) -> Option<usize> {
        let nodes = self.nodes(set, errors);
        let origin = self.mesh.origin();
        if nodes.len() != 1 && self.mesh.node_set(set.text()).is_ok() {
            let message = format!(
                "the node set `{}` of {origin} must have one node, but has {}",
                set.text(),
                nodes.len()
            );
            let single = self.mesh.node_sets().iter().filter(|(_, nodes)| nodes.len() == 1);
            let single: Vec<&str> = single.map(|(name, _)| name.as_str()).collect();
            let help = format!("name a set of one node{}", listed(&single));
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        }
        nodes.first().copied()
    }

    /// The ends of the driven section move alike along y, which ties the flexible shaft to the frame that
    /// turns with it; their places among the watched nodes.
    fn tie(&mut self, drive: &case::Drive, errors: &mut Diagnostics) -> [usize; 2] {
        let nodes = [&drive.top, &drive.bottom].map(|set| self.node(set, errors));
        if nodes[0].is_some() && nodes[0] == nodes[1] {
            let message = "the driven nodes `top` and `bottom` are the same node";
            let help = "name the sets of two nodes, at opposite ends of a diameter";
            errors.push(drive.bottom.error_here(Code::BAD_VALUE, message).help(help));
            return [0; 2];
        }
        let [top, bottom] = nodes.map(|node| node.unwrap_or(0));
        let ties = [self.retain(&drive.top, top, 1), self.retain(&drive.bottom, bottom, 1)];
        let name = format!("torsion ({} y = {} y)", drive.top.text(), drive.bottom.text());
        self.spec.constraints.equation(name, [(ties[0], 1.0), (ties[1], -1.0)]);
        [top, bottom].map(|node| self.watch(node))
    }
}

/// Names in a list after a colon, not too many of them; nothing if there are none.
fn listed(names: &[&str]) -> String {
    const MOST: usize = 16;
    let shown: Vec<String> = names.iter().take(MOST).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > MOST { ", …" } else { "" };
    if names.is_empty() { String::new() } else { format!(": {}{more}", shown.join(", ")) }
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
    /// Sets of the journal and of the bore, a bearing each.
    bearings: Vec<[&'a [Located]; 2]>,
    drive: Option<&'a case::Drive>,
    loads: &'a [case::Load],
}

impl<'a> From<&'a Rotor> for Outline<'a> {
    fn from(rotor: &'a Rotor) -> Self {
        let bearings = rotor.bearings.iter();
        Outline {
            shaft: Some(&rotor.shaft),
            support: Some(&rotor.support),
            bearings: bearings.map(|own| [own.journal.as_slice(), own.bore.as_slice()]).collect(),
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
            bearings: bearings.map(|(sets, _)| sets.each_ref().map(Vec::as_slice)).collect(),
            drive: draft.drive.as_ref(),
            loads: &draft.loads,
        }
    }
}

impl Plan {
    /// Reads or makes the meshes, and finds the sets that the case names.
    ///
    /// # Errors
    /// Everything that is wrong with the meshes, and every set that is missing or of the wrong size.
    pub(crate) fn new(rotor: &Rotor) -> Result<Plan, Failure> {
        Plan::of(&Outline::from(rotor), Diagnostics::new())
            .map(|plan| plan.expect("nothing of a whole case is missing"))
    }

    /// As [`Plan::new`], for as much as is there of a case with these errors; they are told together. None
    /// if nothing is wrong but a body is missing.
    ///
    /// # Errors
    /// These, and those of [`Plan::new`].
    pub(crate) fn of(outline: &Outline, mut errors: Diagnostics) -> Result<Option<Plan>, Failure> {
        let mut rest = None;
        let mut note = |failure, errors: &mut Diagnostics| match failure {
            Failure::Input(found) => errors.append(found),
            other => rest = rest.take().or(Some(other)),
        };
        let shaft = outline.shaft.and_then(|case| match meshes::shaft(case) {
            Ok(mesh) => Some(OnShaft::place(case, mesh, outline, &mut errors)),
            Err(failure) => {
                note(failure, &mut errors);
                None
            }
        });
        let support = outline.support.and_then(|case| match meshes::support(case) {
            Ok(mesh) => Some(place_support(case, mesh, outline, &mut errors)),
            Err(failure) => {
                note(failure, &mut errors);
                None
            }
        });
        errors.into_result(())?;
        if let Some(failure) = rest {
            return Err(failure);
        }
        let (Some(on_shaft), Some((support, bores))) = (shaft, support) else { return Ok(None) };
        let OnShaft { shaft, journals, drive, loads } = on_shaft;
        Ok(Some(Plan { shaft, support, journals, bores, drive, loads }))
    }

    /// Looks for what would keep the bodies from being reduced, without reducing them.
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
    drive: [usize; 2],
    loads: Vec<Vec<usize>>,
}

impl OnShaft {
    fn place(
        case: &case::Shaft,
        mesh: Mesh,
        outline: &Outline,
        errors: &mut Diagnostics,
    ) -> OnShaft {
        let axial = &case.axial_restraint;
        let body = BodyPlan::new(mesh, case.mesh.place(), case.modes, case.damping, axial);
        let mut own =
            OnShaft { shaft: body, journals: Vec::new(), drive: [0; 2], loads: Vec::new() };
        let shaft = &mut own.shaft;
        for [sets, _] in &outline.bearings {
            let mut journal = [0; 3];
            for (place, set) in sets.iter().take(3).enumerate() {
                let node = shaft.node(set, errors).unwrap_or(0);
                shaft.retain(set, node, 0);
                shaft.retain(set, node, 1);
                journal[place] = shaft.watch(node);
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
        for load in outline.loads {
            let nodes = load.sets.iter().flat_map(|set| shaft.nodes(set, errors));
            let nodes: Vec<usize> = nodes.collect();
            own.loads.push(nodes.into_iter().map(|node| shaft.watch(node)).collect());
        }
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
    let mut support = BodyPlan::new(mesh, case.mesh.place(), case.modes, case.damping, mounts);
    let mut bores = Vec::new();
    for [_, sets] in &outline.bearings {
        let mut bore = [const { Vec::new() }; 3];
        for (ring, set) in bore.iter_mut().zip(*sets) {
            let nodes = support.nodes(set, errors);
            *ring = nodes.into_iter().map(|node| support.watch(node)).collect();
        }
        bores.push(bore);
    }
    for node in support.nodes(mounts, errors) {
        for (axis, letter) in AXES.iter().enumerate() {
            let held = support.retain(mounts, node, axis);
            let label = support.mesh.labels()[node];
            let name = format!("mounts ({letter} of node {label})");
            support.spec.constraints.fix(name, held);
        }
    }
    for spring in &case.ground_springs {
        for node in support.nodes(&spring.set, errors) {
            let axis = AXES[spring.direction];
            support.spec.springs.push(GroundSpring {
                name: format!("ground spring ({} {axis})", spring.set.text()),
                dof: 3 * node + spring.direction,
                stiffness: spring.stiffness,
            });
        }
    }
    support.bound(errors);
    (support, bores)
}
