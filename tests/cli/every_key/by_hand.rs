//! A machine put together from meshes, sets and numbers, without what reads cases.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use whirl_solver::bearing::{Bearing, Sides, SpringLaw};
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::{Constraints, GroundSpring};
use whirl_solver::dynamics::{
    BodyStart, Integrator, MarchOptions, NewtonOptions, SteadyRule, march,
};
use whirl_solver::history::History;
use whirl_solver::loads::{Frame, Load, Release, Target, TimeFunction};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::{CLEARANCES, MOTIONS};

/// A shaft on a support in numbers, SI.
pub(super) struct ByHand {
    /// rad/s.
    pub(super) start_speed: f64,
    pub(super) shaft: Mesh,
    pub(super) support: Mesh,
    /// Of the shaft, then of the support.
    pub(super) modes: [usize; 2],
    /// C = damping · K, likewise.
    pub(super) damping: [f64; 2],
    /// C = mass_damping · M beside it, likewise.
    pub(super) mass_damping: [f64; 2],
    pub(super) motion: &'static str,
    pub(super) axial_restraint: &'static str,
    pub(super) stiffening: bool,
    /// Whether the static answers to the loads are kept.
    pub(super) answers_loads: bool,
    /// Set, direction (0, 1, 2), N/m.
    pub(super) ground_springs: Vec<(&'static str, usize, f64)>,
    pub(super) laws: Vec<Box<dyn SpringLaw>>,
    pub(super) bearings: Vec<BearingByHand>,
    /// Torque and the speed at which it ends, rad/s.
    pub(super) drive: Option<(f64, f64)>,
    pub(super) loads: Vec<LoadByHand>,
    pub(super) time_step: f64,
    pub(super) steps: usize,
    pub(super) force_tolerance: f64,
}

/// A bearing between the sets JOURNALk_… and BOREk_….
pub(super) struct BearingByHand {
    pub(super) k: usize,
    pub(super) springs: usize,
    pub(super) clearance: f64,
    pub(super) radius: Option<f64>,
    pub(super) law: usize,
    /// z of the rings of springs (m).
    pub(super) stations: Vec<f64>,
}

/// A force in space on every node of some sets.
pub(super) struct LoadByHand {
    pub(super) sets: &'static [&'static str],
    /// N along x, y.
    pub(super) force: [f64; 2],
    /// Frequency (Hz) and phase (rad).
    pub(super) sine: Option<(f64, f64)>,
}

const PLACES: [&str; 3] = ["LEFT", "MIDDLE", "RIGHT"];

/// The only node of a set.
fn node(mesh: &Mesh, set: &str) -> usize {
    let nodes = mesh.node_set(set).expect("a set of the mesh");
    assert_eq!(nodes.len(), 1, "{set}");
    nodes[0]
}

fn body(mesh: &Mesh, which: usize, own: &ByHand, held: Held, nodes: Vec<usize>) -> BodySpec {
    assert!(nodes.iter().all(|&node| node < mesh.nodes().len()));
    BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained: held.retained,
        held: Vec::new(),
        modes: own.modes[which],
        constraints: held.constraints,
        springs: held.springs,
        damping: Rayleigh { alpha: own.mass_damping[which], beta: own.damping[which] },
        nodes,
        stiffening: which == 0 && own.stiffening,
        means: Vec::new(),
        memory: 1 << 30,
    }
}

/// What holds a body, and what is kept of it.
#[derive(Default)]
struct Held {
    retained: Vec<Retained>,
    constraints: Constraints,
    springs: Vec<GroundSpring>,
}

impl Held {
    fn retain(&mut self, node: usize, axis: usize) -> usize {
        self.retained.push(Retained::dof(3 * node + axis, format!("{node} {axis}")));
        self.retained.len() - 1
    }
}

impl ByHand {
    /// The columns that a run of the machine has.
    pub(super) fn march(self) -> History {
        let (shaft, support) = (self.reduced_shaft(), self.reduced_support());
        let bearings = self.placed_bearings(&shaft);
        let loads = self.placed_loads(&shaft);
        let named = |motion: &&whirl_specs::Motion| motion.origin.name == self.motion;
        let machine = Machine::new(MachineParts {
            bodies: vec![
                Body::turning("shaft", shaft, Rotation::Free),
                Body::standing("support", support),
            ],
            motion: MOTIONS.iter().find(named).expect("a shipped motion"),
            clearance: &CLEARANCES[0],
            laws: self.laws,
            bearings,
            loads,
        });
        let options = MarchOptions {
            time_step: self.time_step,
            automatic: None,
            steps: self.steps,
            integrator: Integrator::default(),
            newton: NewtonOptions {
                force_tolerance: self.force_tolerance,
                ..NewtonOptions::default()
            },
            cycle: None,
            steady_rule: SteadyRule::default(),
            stop_when_steady: false,
            initial: vec![BodyStart { speed: self.start_speed, ..BodyStart::default() }],
            laws_at_rest: false,
        };
        let machine = machine.expect("a machine");
        let outcome = march(&machine, &options, &mut |_| ControlFlow::Continue(()));
        outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history
    }

    /// The shaft; its nodes are three a bearing, the top and the bottom one of the drive, then those of the
    /// loads.
    fn reduced_shaft(&self) -> Shaft {
        let (mesh, mut held, mut nodes) = (&self.shaft, Held::default(), Vec::new());
        let [top, bottom] = ["DRIVE_TOP", "DRIVE_BOTTOM"].map(|set| node(mesh, set));
        let ties = [held.retain(top, 1), held.retain(bottom, 1)];
        held.constraints.equation("drive", [(ties[0], 1.0), (ties[1], -1.0)]);
        let axial = held.retain(node(mesh, self.axial_restraint), 2);
        held.constraints.fix("axial", axial);
        for bearing in &self.bearings {
            for place in PLACES {
                let journal = node(mesh, &format!("JOURNAL{}_{place}", bearing.k));
                for axis in [0, 1] {
                    held.retain(journal, axis);
                }
                nodes.push(journal);
            }
        }
        nodes.extend([top, bottom]);
        for load in &self.loads {
            for set in load.sets {
                nodes.extend(mesh.node_set(set).expect("a set of the mesh"));
            }
        }
        // The torque of a law turns the section of its journal, as the mean of the nodes at its middle.
        let mut means = Vec::new();
        for bearing in self.bearings.iter().filter(|own| self.has_torque(own)) {
            let z = mesh.nodes()[node(mesh, &format!("JOURNAL{}_MIDDLE", bearing.k))][2];
            let at = |node: &usize| (mesh.nodes()[*node][2] - z).abs() < 1e-6;
            let section: Vec<usize> = (0..mesh.nodes().len()).filter(at).collect();
            let mean = NodeSetMean::new(mesh, &section).expect("a section");
            let name = format!("turn of journal {}", bearing.k);
            held.retained.push(Retained::mean(&mean, MeanComponent::Rotation(2), name));
            means.push(mean);
        }
        let mut spec = body(mesh, 0, self, held, nodes);
        spec.means = means;
        // The answers to each load along x and y, as it turns against the shaft.
        for load in self.loads.iter().filter(|_| self.answers_loads) {
            let sets = load.sets.iter().flat_map(|set| mesh.node_set(set).expect("a set"));
            let nodes: Vec<usize> = sets.copied().collect();
            for axis in [0, 1] {
                let row: Vec<(usize, f64)> =
                    nodes.iter().map(|node| (3 * node + axis, 1.0)).collect();
                if !spec.corrections.contains(&row) {
                    spec.corrections.push(row);
                }
            }
        }
        Shaft::from_mesh(mesh, &spec).expect("a shaft")
    }

    /// The support; its nodes are those of the bores, ring after ring.
    fn reduced_support(&self) -> Support {
        let (mesh, mut held, mut nodes) = (&self.support, Held::default(), Vec::new());
        for &mount in mesh.node_set("MOUNTS").expect("mounts") {
            for axis in 0..3 {
                let dof = held.retain(mount, axis);
                held.constraints.fix("mount", dof);
            }
        }
        for &(set, axis, stiffness) in &self.ground_springs {
            for &node in mesh.node_set(set).expect("a set of the mesh") {
                let name = format!("{set} {axis}");
                held.springs.push(GroundSpring { name, dof: 3 * node + axis, stiffness });
            }
        }
        for ring in self.bores() {
            nodes.extend(mesh.node_set(&ring).expect("a set of the mesh"));
        }
        Support::from_mesh(mesh, &body(mesh, 1, self, held, nodes)).expect("a support")
    }

    /// Sets of the bores, three a bearing.
    fn bores(&self) -> impl Iterator<Item = String> + '_ {
        let rings = self.bearings.iter().flat_map(|own| PLACES.map(|place| (own.k, place)));
        rings.map(|(k, place)| format!("BORE{k}_{place}"))
    }

    fn has_torque(&self, bearing: &BearingByHand) -> bool {
        self.laws[bearing.law].outputs().contains(&"T")
    }

    fn placed_bearings(&self, shaft: &Shaft) -> Vec<Bearing> {
        let mut sections = 0..;
        let mut first = 0;
        let mut rings = self.bores().map(|set| {
            let count = self.support.node_set(&set).expect("a set of the mesh").len();
            first += count;
            (first - count..first).collect::<Vec<usize>>()
        });
        let mut placed = Vec::new();
        for (place, own) in self.bearings.iter().enumerate() {
            let journal = [0, 1, 2].map(|end| 3 * place + end);
            let [left, _, right] = journal.map(|node| shaft.nodes[node].position[2]);
            placed.push(Bearing {
                others: Vec::new(),
                label: None,
                sides: Sides {
                    torque_section: self.has_torque(own).then(|| sections.next()).flatten(),
                    ..Sides::default()
                },
                name: format!("bearing {place}"),
                journal,
                bore: [0, 1, 2].map(|_| rings.next().expect("three rings a bearing")),
                clearance: own.clearance,
                journal_radius: own.radius,
                stations: own.stations.iter().map(|z| (z - left) / (right - left)).collect(),
                angles: (0..own.springs).map(|j| TAU * j as f64 / own.springs as f64).collect(),
                law: own.law,
            });
        }
        placed
    }

    fn placed_loads(&self, shaft: &Shaft) -> Vec<Load> {
        let drive = 3 * self.bearings.len();
        let mut nodes = shaft.nodes[drive + 2..].iter();
        let mut placed = Vec::new();
        for own in &self.loads {
            let time_function = match own.sine {
                Some((frequency, phase)) => TimeFunction::Sine { frequency, phase },
                None => TimeFunction::Constant,
            };
            let [x, y] = own.force;
            for _ in own.sets.iter().flat_map(|set| self.shaft.node_set(set).expect("a set")) {
                let node = nodes.next().expect("a node a load").clone();
                let force = [x, y, 0.0];
                let time_function = time_function.clone();
                placed.push(Load::force(0, node, force, time_function, Frame::Space));
            }
        }
        if let Some((torque, target)) = self.drive {
            let [top, bottom] = [0, 1].map(|end| shaft.nodes[drive + end].clone());
            // ±F along y, as far apart along x as the nodes: a couple about +z.
            let force = torque / (top.position[0] - bottom.position[0]);
            for (node, force) in [(top, force), (bottom, -force)] {
                let time_function = TimeFunction::UntilSpeed(Target {
                    speed: target,
                    from_above: torque < 0.0,
                    release: Release::AtStep,
                });
                let force = [0.0, force, 0.0];
                placed.push(Load::force(0, node, force, time_function, Frame::Body));
            }
        }
        placed
    }
}
