//! A rotor with three discs by numbers on two bearings (Lalanne, Ferraris: Rotordynamics Prediction in Engineering;
//! Code_Aster SDLL124).

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};
use whirl_solver::attached::Disc;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::shaft::Shaft;

use super::{dense, elements, frequencies, mean_motion, sparse, spec, steel};

const LENGTH: f64 = 1.3;
const RADIUS: f64 = 0.05;
const DENSITY: f64 = 7800.0;
/// z, thickness, outer radius (m).
const DISCS: [[f64; 3]; 3] = [[0.2, 0.05, 0.12], [0.5, 0.05, 0.20], [1.0, 0.06, 0.20]];
const STIFFNESS: [f64; 2] = [7e7, 5e7];
const DAMPING: [f64; 2] = [700.0, 500.0];
const AT_REST: [f64; 4] = [60.615, 63.026, 169.49, 185.563];
const AT_SPEED: [f64; 4] = [54.112, 68.122, 154.65, 196.0];

fn mesh() -> Mesh {
    let shaft = SolidShaft {
        length: LENGTH,
        diameter: 2.0 * RADIUS,
        supports: DISCS.map(|[z, ..]| z).to_vec(),
        support_length: 0.04,
        layers_in_support: 2,
        layers_between: 24,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells::default(),
        material: steel(DENSITY),
    };
    shaft.mesh(&elements()).expect("a mesh")
}

/// The rotor in one plane: matrices of x, or of y, over the nodes of the centre line.
struct Plane {
    mass: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    net: DMatrix<f64>,
    coupling: DMatrix<f64>,
    /// Mean motion of the bearings' sections.
    bearings: [DVector<f64>; 2],
}

impl Plane {
    fn new() -> Plane {
        let mesh = mesh();
        let section = |z: f64| -> Vec<usize> {
            let near = |node: &usize| (mesh.nodes()[*node][2] - z).abs() < 1e-9;
            (0..mesh.nodes().len()).filter(near).collect()
        };
        let centre: Vec<usize> = (0..mesh.nodes().len())
            .filter(|&node| mesh.nodes()[node][..2].iter().all(|x| x.abs() < 1e-9))
            .collect();
        let [top, bottom] =
            ["DRIVE_TOP", "DRIVE_BOTTOM"].map(|set| mesh.single_node(set).expect("a node"));
        // The axial dof is held, the turn of the driven end, too. Sections of discs tilt as planes, for which all of their
        // axial dofs are kept: a moment on one of them alone would dent the section.
        let mut dofs = vec![3 * centre[0] + 2, 3 * top + 1, 3 * bottom + 1];
        dofs.extend([0, 1].iter().flat_map(|axis| centre.iter().map(move |node| 3 * node + axis)));
        let discs: Vec<Vec<usize>> = DISCS.iter().map(|[z, ..]| section(*z)).collect();
        dofs.extend(discs.iter().flatten().map(|node| 3 * node + 2));
        let stations = [0.0, LENGTH].into_iter().chain(DISCS.map(|[z, ..]| z));
        let sections: Vec<Vec<usize>> = stations.map(section).collect();
        let mut spec = spec(&dofs, 1, 0, sections.concat());
        spec.constraints.equation("turn", [(1, 1.0), (2, -1.0)]);
        let mut shaft = Shaft::from_mesh(&mesh, &spec).expect("a body");
        let mut start = 0;
        let places: Vec<Vec<usize>> = sections
            .iter()
            .map(|section| {
                start += section.len();
                (start - section.len()..start).collect()
            })
            .collect();
        for (places, [_, thickness, outer]) in places[2..].iter().zip(DISCS) {
            let [x, y, z, alpha, beta, _] = mean_motion(&shaft, places).map(|row| row.transpose());
            let square = outer.powi(2) + RADIUS.powi(2);
            let mass = DENSITY * PI * (outer.powi(2) - RADIUS.powi(2)) * thickness;
            let middle = shaft.nodes[places[0]].position[2];
            shaft = shaft.with_disc(&Disc {
                mass,
                polar_inertia: mass * square / 2.0,
                diametral_inertia: mass * (square / 4.0 + thickness.powi(2) / 12.0),
                z: middle,
                displacement: &sparse(&DMatrix::from_rows(&[x, y, z])),
                tilt: &sparse(&DMatrix::from_rows(&[alpha, beta])),
                twist: None,
            });
        }
        // The tied dofs follow the others: what is left are the planes of x and of y, which are alike.
        let (line, n, size) = (centre.len(), centre.len() + discs.len(), shaft.size());
        let mut own = DMatrix::zeros(size, 2 * n);
        for axis in [0, 1] {
            own.view_mut((1 + axis * line, axis * n), (line, line)).fill_with_identity();
            let mut row = 1 + 2 * line;
            for (place, disc) in discs.iter().enumerate() {
                for &node in disc {
                    own[(row, axis * n + line + place)] = mesh.nodes()[node][axis];
                    row += 1;
                }
            }
            assert_eq!(row, size);
        }
        let k = dense(&shaft.stiffness);
        let follows = k.row(0) * &own / -k[(0, 0)];
        let mut transform = own;
        transform.row_mut(0).copy_from(&follows);
        let part = |matrix: &whirl_solver::linalg::Matrix, column: usize| {
            let whole = transform.transpose() * dense(matrix) * &transform;
            let wanted = whole.view((0, column), (n, n)).into_owned();
            let mirrored = whole.view((n, n - column), (n, n)).into_owned();
            let sign = if column == 0 { 1.0 } else { -1.0 };
            assert!((&wanted - mirrored * sign).amax() < 1e-6 * wanted.amax(), "x and y are alike");
            wanted
        };
        let bearing = |places: &Vec<usize>| {
            let [x, ..] = mean_motion(&shaft, places);
            (transform.transpose() * x).rows(0, n).into_owned()
        };
        Plane {
            mass: part(&shaft.mass, 0),
            stiffness: part(&shaft.stiffness, 0),
            net: part(&shaft.spin_net, 0),
            coupling: part(&shaft.spin_coupling, n),
            bearings: [bearing(&places[0]), bearing(&places[1])],
        }
    }

    /// The lowest frequencies in the fixed frame (Hz).
    fn hertz(&self, speed: f64) -> Vec<f64> {
        // With p + iq = z e^{iθ}: M Z̈ + 2iΩ (H − M) Ż + (K + Ω² (2H − M − (Y − G))) Z.
        let n = self.mass.nrows();
        let gyroscopic = (&self.coupling - &self.mass) * (2.0 * speed);
        let own = &self.stiffness + (&self.coupling * 2.0 - &self.mass - &self.net) * speed.powi(2);
        let [mut m, mut b, mut a] = [0; 3].map(|_| DMatrix::zeros(2 * n, 2 * n));
        for axis in [0, 1] {
            let put = |to: &mut DMatrix<f64>, other: usize, value: &DMatrix<f64>| {
                let mut view = to.view_mut((axis * n, other * n), (n, n));
                view += value;
            };
            put(&mut m, axis, &self.mass);
            put(&mut a, axis, &own);
            put(&mut b, 1 - axis, &(&gyroscopic * if axis == 0 { -1.0 } else { 1.0 }));
            for row in &self.bearings {
                put(&mut a, axis, &(row * row.transpose() * STIFFNESS[axis]));
                put(&mut b, axis, &(row * row.transpose() * DAMPING[axis]));
            }
        }
        frequencies(&m, &b, &a).into_iter().map(|w| w / TAU).collect()
    }
}

#[test]
fn a_rotor_with_discs_by_numbers_has_the_frequencies_of_the_book() {
    let rotor = Plane::new();
    for (speed, expected) in [(0.0, AT_REST), (30_000.0 * TAU / 60.0, AT_SPEED)] {
        let found = rotor.hertz(speed);
        println!("{speed}: {:?}", &found[..6]);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 0.01, "{speed}: {found} {expected}");
        }
    }
}
