//! A body to be reduced: its mesh, with the dofs to retain and to hold, and the nodes whose motion is wanted.

mod explain;
mod sets;

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::{
    Constraints, GroundSpring, add_ground_springs, free_motions_of_mesh,
};
use whirl_solver::contacts::{BoreNodes, patterns};
use whirl_solver::error::{Error, ReductionError};
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};
use whirl_solver::model::{Form, MeshModel, Point};
use whirl_solver::reduction::Row;

use crate::case::{self, StaticCorrection};
use crate::machine::built::Counts;
use crate::machine::wording::AXES;
use crate::memory;

/// A body before its reduction.
pub(crate) struct BodyPlan {
    /// Mesh with materials.
    pub(crate) mesh: Mesh,
    /// How it is reduced; its nodes are the output nodes, whose motion is wanted.
    pub(crate) spec: BodySpec,
    /// For which set each of its motions is retained, as the case says it.
    pub(super) retained_for: Vec<Located>,
    /// Whether the case leaves out how many modes are kept, as it may of matrices.
    pub(super) all_modes: bool,
    /// What joints and loads see of it: their places are those of the nodes of the reduced body.
    points: Vec<Point>,
    /// What holds it, as the case says it.
    held_by: Located,
    /// What it is made from, as the case says it.
    pub(super) made_from: Located,
    /// Whether it is rigid, and nothing of it is reduced.
    pub(crate) rigid: bool,
    /// Whether it may move along z, if it is rigid.
    pub(in crate::machine) along: bool,
    /// Its bores, and where the case asks for static answers to loads on them.
    pub(crate) bores: Vec<BoreNodes>,
    static_correction: StaticCorrection,
    /// Loads of the case on it, by name, as unit loads on its dofs.
    pub(crate) loads: Vec<(String, Row)>,
    /// Motions that the outputs of the case ask for, as unit forces along them.
    asked_for: Vec<Row>,
    /// Whether it turns, so that what is fixed in space acts along x and y of it.
    pub(in crate::machine) turning: bool,
    /// Whether what is held keeps it from turning in its frame.
    pub(in crate::machine) held_to_frame: bool,
    /// Whether it turns freely, in the frame in which deformations have no angular momentum; else a section turns with the
    /// frame.
    pub(in crate::machine) mean_frame: bool,
    /// Whose mean rotation is that of the frame, in words; none where a drive says it, or where nothing turns.
    pub(crate) frame: Option<String>,
    /// Place of the retained motion that follows from the others in such a frame.
    pub(in crate::machine) follows: Option<usize>,
    /// The set of each of its springs to the ground, as the case says it.
    sprung: Vec<Located>,
    /// How messages say what holds a body.
    words: HoldingWords,
}

/// How messages say what holds a body.
#[derive(Debug, Clone)]
pub(in crate::machine) struct HoldingWords {
    /// What to do against a motion that is free, after "hold more nodes".
    pub(in crate::machine) springs: String,
    /// The key of nodes that are held.
    pub(in crate::machine) held: &'static str,
}

impl Default for HoldingWords {
    /// Those of a shaft on a support.
    fn default() -> Self {
        let springs = " or, on the support, add a spring `[[support.ground_spring]]`".to_owned();
        HoldingWords { springs, held: "mounts" }
    }
}

impl BodyPlan {
    pub(in crate::machine) fn new(mesh: Mesh, case: &case::Body, held_by: &Located) -> Self {
        let spec = BodySpec {
            corrections: Vec::new(),
            retained: Vec::new(),
            // What matrices lack is held.
            held: mesh.matrices().map(|own| own.absent().collect()).unwrap_or_default(),
            modes: case.modes,
            constraints: Constraints::new(),
            springs: Vec::new(),
            damping: Rayleigh { alpha: case.mass_damping, beta: case.damping },
            nodes: Vec::new(),
            stiffening: false,
            means: Vec::new(),
            sections: Vec::new(),
            memory: memory::available().unwrap_or(usize::MAX),
        };
        let (held_by, made_from) = (held_by.clone(), case.mesh.place());
        let words = HoldingWords::default();
        BodyPlan {
            mesh,
            spec,
            retained_for: Vec::new(),
            all_modes: matches!(&case.mesh, case::Mesh::Matrices(own) if own.all_modes),
            points: Vec::new(),
            held_by,
            made_from,
            bores: Vec::new(),
            static_correction: case.static_correction.clone(),
            loads: Vec::new(),
            asked_for: Vec::new(),
            turning: false,
            rigid: false,
            along: false,
            held_to_frame: false,
            mean_frame: false,
            frame: None,
            follows: None,
            sprung: Vec::new(),
            words,
        }
    }

    /// Adds a bore with its rings, or with a surface as one, of which the node set is given, too, and the pressures of a film under
    /// which it gives way.
    pub(in crate::machine) fn add_bore(
        &mut self,
        name: String,
        axis: [f64; 2],
        (rings, surface, pressures): (Vec<Vec<usize>>, Option<String>, Vec<Row>),
    ) {
        self.bores.push(BoreNodes { name, rings, surface, axis, pressures });
    }

    /// Asks for static answers to the loads of the case and to films under which its bores give way, unless it says otherwise, and
    /// to unit forces at its outputs and to loads on all bores, if it does.
    pub(in crate::machine) fn correct(&mut self, errors: &mut Diagnostics) {
        let own = &self.static_correction;
        let loads = own.loads.then(|| self.loads.iter().map(|(_, load)| load.clone()));
        let outputs = own.outputs.then(|| self.asked_for.iter().cloned());
        let wanted: Vec<Row> =
            loads.into_iter().flatten().chain(outputs.into_iter().flatten()).collect();
        for row in wanted {
            if !self.all_modes && !self.is_answered(&row) {
                self.spec.corrections.push(row);
            }
        }
        self.correct_bores(errors);
        let pressures = self.bores.iter().any(|own| !own.pressures.is_empty());
        if let (Some(place), false) = (&self.static_correction.pressure_named, pressures) {
            let message = format!(
                "`static_correction` keeps the answers to pressures of films, and no bore of {} gives way under one",
                self.mesh.origin()
            );
            let help =
                "leave `pressure` out, or name the bore of a film as the `surface` of this mesh";
            errors.push(place.error_here(Code::BAD_VALUE, message).help(help));
        }
        if self.static_correction.pressure {
            let pressures = self.bores.iter().flat_map(|own| &own.pressures);
            self.spec.corrections.extend(pressures.cloned());
        }
    }

    /// To how many pressures of films on its bores the static answers are kept.
    pub(in crate::machine) fn pressures_of_films(&self) -> usize {
        let all = self.bores.iter().map(|own| own.pressures.len()).sum();
        if self.static_correction.pressure { all } else { 0 }
    }

    /// Notes that the motion of an output point along these axes is asked for.
    pub(in crate::machine) fn ask_for(&mut self, point: usize, components: &[usize]) {
        let parts: [f64; 3] =
            std::array::from_fn(|axis| f64::from(u8::from(components.contains(&axis))));
        for axis in self.acts_along(parts) {
            let row = match self.points[point] {
                Point::Node(node) => [(3 * self.spec.nodes[node] + axis, 1.0)].into(),
                Point::OnMean(mean, _) => {
                    self.spec.means[mean].row(MeanComponent::Displacement(axis))
                }
            };
            self.asked_for.push(row);
        }
    }

    fn correct_bores(&mut self, errors: &mut Diagnostics) {
        let Some(place) = &self.static_correction.bores else { return };
        if self.bores.is_empty() {
            let message = format!(
                "`static_correction` keeps the answers to loads on bores, and {} has none",
                self.mesh.origin()
            );
            let help = "leave it out";
            errors.push(place.error_here(Code::BAD_VALUE, message).help(help));
            return;
        }
        for bore in &self.bores {
            // Sets without nodes are noted where they are read.
            let Ok(patterns) = patterns(&self.mesh, bore) else { continue };
            self.spec.corrections.extend(patterns.into_iter().map(|own| own.load));
        }
    }

    /// Whether what is retained or held answers a load, or another correction does.
    fn is_answered(&self, load: &Row) -> bool {
        let spec = &self.spec;
        let known = |dof: &usize| {
            spec.held.contains(dof) || spec.retained.iter().any(|own| own.single() == Some(*dof))
        };
        let rows = spec.retained.iter().map(|own| &own.terms).chain(&spec.corrections);
        load.iter().all(|(dof, _)| known(dof)) || { rows }.any(|own| own == load)
    }

    /// The body with other words for what holds it.
    pub(in crate::machine) fn saying(self, words: HoldingWords) -> Self {
        BodyPlan { words, ..self }
    }

    /// Sizes of the body, as in the paper's Table 1.
    pub(crate) fn counts(&self) -> Counts {
        // Held dofs are dofs of the interface, too.
        let absent = self.mesh.matrices().map_or(0, |own| own.absent().count());
        let retained = self.spec.retained.len() + self.spec.held.len() - absent;
        let physical = self.mesh.dof_count() - absent;
        Counts {
            elements: self.mesh.cell_count(),
            nodes: self.mesh.placed(),
            physical_dofs: physical,
            internal_dofs: physical - retained,
            retained_dofs: retained,
            modes: self.spec.modes,
            craig_bampton_dofs: self.spec.modes + self.spec.corrections.len() + retained,
        }
    }

    /// Notes a spring from a node to the ground.
    pub(in crate::machine) fn spring(&mut self, set: &Located, spring: GroundSpring) {
        self.spec.springs.push(spring);
        self.sprung.push(set.clone());
    }

    /// Checks for cells turned inside out and for motions that nothing stops.
    pub(in crate::machine) fn verify(&self) -> Result<(), Error> {
        let elastic = assemble(&self.mesh, "stiffness")?;
        let stiffness = add_ground_springs(elastic, &self.spec.springs)?;
        let mut held = Constraints::new();
        for retained in &self.spec.retained {
            held.equation(&*retained.name, retained.terms.iter().copied());
        }
        self.spec.held.iter().for_each(|&dof| held.fix(self.held_by.text(), dof));
        match free_motions_of_mesh(&self.mesh, &stiffness, &held, self.spec.memory)? {
            motions if motions.is_empty() => Ok(()),
            motions => {
                let free = ReductionError::Mechanism { motions };
                Err(free.with_labels(&self.mesh).into())
            }
        }
    }

    /// Holds nodes in all directions; `key`: of the case, that names the set.
    pub(in crate::machine) fn hold(&mut self, key: &str, set: &Located, nodes: &[usize]) {
        for &node in nodes {
            for (axis, letter) in AXES.iter().enumerate() {
                let dof = 3 * node + axis;
                let retained = self.spec.retained.iter();
                match retained.map(Retained::single).position(|known| known == Some(dof)) {
                    None => self.spec.held.push(dof),
                    Some(place) => {
                        let label = self.mesh.labels()[node];
                        let name = format!("{key} ({letter} of node {label} of {})", set.text());
                        self.spec.constraints.fix(name, place);
                    }
                }
            }
        }
        self.spec.held.sort_unstable();
        self.spec.held.dedup();
    }

    /// Retains a dof; its place among the retained ones.
    pub(in crate::machine) fn retain(&mut self, set: &Located, node: usize, axis: usize) -> usize {
        let dof = 3 * node + axis;
        let retained = &mut self.spec.retained;
        if let Some(place) = retained.iter().position(|known| known.single() == Some(dof)) {
            return place;
        }
        retained.push(Retained::dof(dof, format!("{} {}", set.text(), AXES[axis])));
        self.retained_for.push(set.clone());
        retained.len() - 1
    }

    /// Asks for the motion of a node; its place among the output points.
    pub(in crate::machine) fn output_node(&mut self, node: usize) -> usize {
        self.spec.nodes.push(node);
        self.points.push(Point::Node(self.spec.nodes.len() - 1));
        self.points.len() - 1
    }

    /// Asks for the mean motion of nodes that the mesh has, one at least; its place among the means.
    pub(in crate::machine) fn mean(&mut self, nodes: &[usize]) -> usize {
        let mean = NodeSetMean::new(&self.mesh, nodes).expect("nodes of the mesh");
        self.spec.means.push(mean);
        self.spec.means.len() - 1
    }

    /// Asks for the mean motion of sets that the mesh has, whose nodes are these, one at least; its place among the means.
    pub(in crate::machine) fn mean_of(&mut self, sets: &[Located], nodes: &[usize]) -> usize {
        if !sets.iter().any(|set| self.is_cut(set)) {
            return self.mean(nodes);
        }
        let names: Vec<&str> = sets.iter().map(Located::text).collect();
        let mean = NodeSetMean::of_sets(&self.mesh, &names).expect("sets of the mesh with faces");
        self.spec.means.push(mean);
        self.spec.means.len() - 1
    }

    /// Whether faces of a set count in part only: it is none of its nodes then.
    pub(in crate::machine) fn is_cut(&self, set: &Located) -> bool {
        self.mesh.is_cut(set.text())
    }

    /// Asks for the mean motion of a set as a point at its centre; its place among the output points.
    pub(in crate::machine) fn output_mean(&mut self, set: &Located, nodes: &[usize]) -> usize {
        let mean = self.mean_of(std::slice::from_ref(set), nodes);
        self.output_on(mean, self.spec.means[mean].centre())
    }

    /// The output point of nodes: of one its motion, of several their mean motion, whose displacements in the plane are
    /// retained; its place.
    pub(in crate::machine) fn output_in_plane(&mut self, set: &Located, nodes: &[usize]) -> usize {
        if let ([node], false) = (nodes, self.is_cut(set)) {
            self.retain(set, *node, 0);
            self.retain(set, *node, 1);
            return self.output_node(*node);
        }
        let mean = self.mean_of(std::slice::from_ref(set), nodes);
        for axis in 0..2 {
            self.retain_mean(set, mean, MeanComponent::Displacement(axis));
        }
        self.output_on(mean, self.spec.means[mean].centre())
    }

    /// Asks for the motion of a place (m) that moves with one of the means; its place among the output points.
    pub(in crate::machine) fn output_on(&mut self, mean: usize, position: [f64; 3]) -> usize {
        self.points.push(Point::OnMean(mean, position));
        self.points.len() - 1
    }

    /// Retains a component of one of the means, which are those of `set`; its place among the retained ones.
    pub(in crate::machine) fn retain_mean(
        &mut self,
        set: &Located,
        mean: usize,
        component: MeanComponent,
    ) -> usize {
        let (what, axis) = match component {
            MeanComponent::Displacement(axis) => ("mean", axis),
            MeanComponent::Rotation(axis) => ("mean turn", axis),
        };
        let name = format!("{what} of {} {}", set.text(), AXES[axis]);
        let retained = Retained::mean(&self.spec.means[mean], component, name);
        let all = &mut self.spec.retained;
        if let Some(place) = all.iter().position(|known| known.terms == retained.terms) {
            return place;
        }
        all.push(retained);
        self.retained_for.push(set.clone());
        all.len() - 1
    }

    /// Nodes of the mesh that are these output nodes.
    pub(in crate::machine) fn mesh_nodes(&self, places: &[usize]) -> Vec<usize> {
        let node = |&place: &usize| match self.points[place] {
            Point::Node(node) => Some(self.spec.nodes[node]),
            Point::OnMean(..) => None,
        };
        places.iter().filter_map(node).collect()
    }

    /// Where an output point is (m), undeformed.
    pub(in crate::machine) fn position(&self, place: usize) -> [f64; 3] {
        match self.points[place] {
            Point::Node(node) => self.mesh.nodes()[self.spec.nodes[node]],
            Point::OnMean(_, position) => position,
        }
    }

    /// The body as the solver takes it.
    pub(in crate::machine) fn form(&self) -> Form<'_> {
        let BodyPlan { mesh, spec, points, follows, .. } = self;
        let own = MeshModel { mesh, spec, points, follows: *follows };
        if self.rigid { Form::RigidMesh(own, self.along) } else { Form::Flexible(own) }
    }

    /// Asks for the motion of all nodes; the place of the first one among the output points.
    pub(in crate::machine) fn output_all(&mut self) -> usize {
        let first = self.points.len();
        (0..self.mesh.placed()).for_each(|node| {
            self.output_node(node);
        });
        first
    }
}
