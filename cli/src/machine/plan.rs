//! What is to be reduced: meshes with the dofs to retain, hold and watch, found by the sets of the case.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::{Constraints, GroundSpring, add_ground_springs, free_motions};
use whirl_solver::error::Error;
use whirl_solver::mesh::Mesh;
use whirl_solver::reduction::ReductionError;

use super::{Counts, meshes};
use crate::case::{self, Rotor};
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
                        format!("it has {}", known.join(", "))
                    }
                };
                errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
                Vec::new()
            }
        }
    }

    /// The only node of a set; what is wrong with it is noted, and a stand-in given.
    fn node(&self, set: &Located, errors: &mut Diagnostics) -> usize {
        let nodes = self.nodes(set, errors);
        let origin = self.mesh.origin();
        if nodes.len() != 1 && self.mesh.node_set(set.text()).is_ok() {
            let message = format!(
                "the node set `{}` of {origin} must have one node, it has {}",
                set.text(),
                nodes.len()
            );
            errors.push(set.error_here(Code::BAD_VALUE, message));
        }
        nodes.first().copied().unwrap_or(0)
    }
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

impl Plan {
    /// Reads or makes the meshes, and finds the sets that the case names.
    ///
    /// # Errors
    /// Everything that is wrong with the meshes, or every set that is missing or of the wrong size.
    pub(crate) fn new(rotor: &Rotor) -> Result<Plan, Failure> {
        Plan::beside(rotor, Diagnostics::new())
    }

    /// As [`Plan::new`], for a case with these errors; they are told together.
    ///
    /// # Errors
    /// These, and those of [`Plan::new`].
    pub(crate) fn beside(rotor: &Rotor, mut errors: Diagnostics) -> Result<Plan, Failure> {
        let (shaft, support) = (&rotor.shaft, &rotor.support);
        let (shaft_mesh, support_mesh) = (meshes::shaft(shaft), meshes::support(support));
        let (shaft_mesh, support_mesh) = both(shaft_mesh, support_mesh, &mut errors)?;
        let mut plan = Plan {
            shaft: BodyPlan::new(
                shaft_mesh,
                shaft.mesh.place(),
                shaft.modes,
                shaft.damping,
                &shaft.axial_restraint,
            ),
            support: BodyPlan::new(
                support_mesh,
                support.mesh.place(),
                support.modes,
                support.damping,
                &support.mounts,
            ),
            journals: Vec::new(),
            bores: Vec::new(),
            drive: [0; 2],
            loads: Vec::new(),
        };
        plan.place_bearings(&rotor.bearings, &mut errors);
        plan.place_shaft(rotor, &mut errors);
        plan.place_support(&rotor.support, &mut errors);
        for body in [&plan.shaft, &plan.support] {
            body.bound(&mut errors);
        }
        Ok(errors.into_result(plan)?)
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

    fn place_bearings(&mut self, bearings: &[case::Bearing], errors: &mut Diagnostics) {
        for bearing in bearings {
            let (shaft, support) = (&mut self.shaft, &mut self.support);
            let mut journal = [0; 3];
            let mut bore = [const { Vec::new() }; 3];
            for (place, set) in bearing.journal.iter().take(3).enumerate() {
                let node = shaft.node(set, errors);
                shaft.retain(set, node, 0);
                shaft.retain(set, node, 1);
                journal[place] = shaft.watch(node);
            }
            for (ring, set) in bore.iter_mut().zip(&bearing.bore) {
                let nodes = support.nodes(set, errors);
                *ring = nodes.into_iter().map(|node| support.watch(node)).collect();
            }
            self.journals.push(journal);
            self.bores.push(bore);
        }
    }

    /// The axial dof is held; the ends of the driven section move alike along y, which ties the flexible
    /// shaft to the frame that turns with it.
    fn place_shaft(&mut self, rotor: &Rotor, errors: &mut Diagnostics) {
        let shaft = &mut self.shaft;
        let (axial, drive) = (&rotor.shaft.axial_restraint, &rotor.drive);
        let node = shaft.node(axial, errors);
        let held = shaft.retain(axial, node, 2);
        shaft.spec.constraints.fix(format!("axial_restraint ({} z)", axial.text()), held);
        let [top, bottom] = [&drive.top, &drive.bottom].map(|set| shaft.node(set, errors));
        let ties = [shaft.retain(&drive.top, top, 1), shaft.retain(&drive.bottom, bottom, 1)];
        if top == bottom && errors.is_empty() {
            let message = "the driven nodes `top` and `bottom` must be two nodes".to_string();
            errors.push(drive.bottom.error_here(Code::BAD_VALUE, message));
            return;
        }
        let name = format!("torsion ({} y = {} y)", drive.top.text(), drive.bottom.text());
        shaft.spec.constraints.equation(name, [(ties[0], 1.0), (ties[1], -1.0)]);
        self.drive = [shaft.watch(top), shaft.watch(bottom)];
        for load in &rotor.loads {
            let nodes = load.sets.iter().flat_map(|set| shaft.nodes(set, errors));
            let nodes: Vec<usize> = nodes.collect();
            self.loads.push(nodes.into_iter().map(|node| shaft.watch(node)).collect());
        }
    }

    fn place_support(&mut self, case: &case::Support, errors: &mut Diagnostics) {
        let support = &mut self.support;
        for node in support.nodes(&case.mounts, errors) {
            for (axis, letter) in AXES.iter().enumerate() {
                let held = support.retain(&case.mounts, node, axis);
                let label = support.mesh.labels()[node];
                let name = format!("mounts ({letter} of node {label})");
                support.spec.constraints.fix(name, held);
            }
        }
        for spring in &case.ground_springs {
            for node in support.nodes(&spring.set, errors) {
                support.spec.springs.push(GroundSpring {
                    name: format!(
                        "ground spring ({} {})",
                        spring.set.text(),
                        AXES[spring.direction]
                    ),
                    dof: 3 * node + spring.direction,
                    stiffness: spring.stiffness,
                });
            }
        }
    }
}
