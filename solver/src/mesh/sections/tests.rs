use std::collections::BTreeMap;
use std::f64::consts::PI;

use whirl_specs::ELEMENTS;

use super::{SectionRow, SectionTable, TableCells};
use crate::assembly::mass_properties;
use crate::mesh::{Material, Mesh};

fn steel() -> Material {
    Material::isotropic("steel", 2e11, 0.3, 7800.0).expect("a material")
}

/// A row from z on, by diameters in mm.
fn row(z: [f64; 2], outer: [f64; 2], inner: [f64; 2]) -> SectionRow {
    let [outer, inner] = [outer, inner].map(|own| own.map(|d: f64| 0.5e-3 * d));
    SectionRow { z: z.map(|z| 1e-3 * z), outer, inner, material: steel(), name: None }
}

fn table(rows: Vec<SectionRow>) -> SectionTable {
    SectionTable { rows, planes: Vec::new(), cells: TableCells::default() }
}

fn mesh(own: &SectionTable) -> Mesh {
    own.mesh(&ELEMENTS.iter().collect::<Vec<_>>()).expect("a mesh")
}

/// Volume of frustums, m³.
fn volume(rows: &[SectionRow]) -> f64 {
    let cone = |[a, b]: [f64; 2]| (a * a + a * b + b * b) / 3.0;
    rows.iter().map(|own| PI * (own.z[1] - own.z[0]) * (cone(own.outer) - cone(own.inner))).sum()
}

/// Faces by their corners (in any order), with the nodes in the middles of their edges and how many cells have them.
fn faces(mesh: &Mesh) -> BTreeMap<Vec<usize>, (Vec<usize>, usize)> {
    let mut found = BTreeMap::new();
    for block in mesh.blocks() {
        for cell in block.cells() {
            for face in block.element.faces {
                let all: Vec<usize> = face.nodes.iter().map(|&a| cell[a]).collect();
                let corners = face.corners;
                let mut key = all[..corners].to_vec();
                let mut middles = all[corners..].to_vec();
                key.sort_unstable();
                middles.sort_unstable();
                let own = found.entry(key).or_insert((middles.clone(), 0));
                assert_eq!(own.0, middles, "two cells share a face with its whole edges");
                own.1 += 1;
            }
        }
    }
    found
}

/// Every table that a test of all meshes is made with, by what is special about it.
fn tables() -> Vec<(&'static str, SectionTable)> {
    let steps: Vec<SectionRow> = [40.0, 62.0, 55.0, 120.0, 70.0, 66.5, 66.0, 30.0, 45.0, 20.0]
        .iter()
        .enumerate()
        .map(|(k, &d)| {
            let z = 50.0 * k as f64;
            row([z, z + 50.0], [d; 2], [0.0; 2])
        })
        .collect();
    let many: Vec<SectionRow> = (0..200)
        .map(|k| {
            let z = 5.0 * f64::from(k);
            let d = 40.0 + 15.0 * (0.7 * f64::from(k)).sin();
            row([z, z + 5.0], [d; 2], [0.0; 2])
        })
        .collect();
    let mut named = vec![
        row([0.0, 100.0], [50.0; 2], [0.0; 2]),
        row([20.0, 80.0], [70.0; 2], [50.0; 2]),
        row([80.0, 95.0], [70.0, 50.0], [50.0; 2]),
    ];
    named[1].name = Some("SLEEVE".to_owned());
    vec![
        ("one row", table(vec![row([0.0, 100.0], [50.0; 2], [0.0; 2])])),
        ("ten diameters", table(steps)),
        ("200 rows", table(many)),
        (
            "cones and bores",
            table(vec![
                row([-20.0, 80.0], [50.0, 80.0], [20.0, 10.0]),
                row([80.0, 100.0], [200.0, 150.0], [10.0, 30.0]),
                row([100.0, 130.0], [60.0; 2], [30.0, 5.0]),
            ]),
        ),
        (
            "tiny chamfers",
            table(vec![
                row([0.0, 0.2], [49.6, 50.0], [0.0; 2]),
                row([0.2, 99.9], [50.0; 2], [0.0; 2]),
                row([99.9, 100.0], [50.0, 49.8], [0.0; 2]),
                row([100.0, 150.0], [300.0; 2], [0.0; 2]),
                row([150.0, 150.5], [300.0, 299.0], [0.0; 2]),
            ]),
        ),
        ("a thin tube", table(vec![row([0.0, 500.0], [100.0; 2], [99.8; 2])])),
        (
            "a coating flush with a journal",
            table(vec![
                row([0.0, 60.0], [100.0; 2], [0.0; 2]),
                row([60.0, 120.0], [99.96; 2], [0.0; 2]),
                row([60.0, 120.0], [100.0; 2], [99.96; 2]),
                row([120.0, 150.0], [100.0; 2], [0.0; 2]),
            ]),
        ),
        (
            "a gap beside a small step",
            table(vec![
                row([0.0, 50.0], [100.1; 2], [0.0; 2]),
                row([50.0, 100.0], [100.0; 2], [0.0; 2]),
                row([50.0, 100.0], [160.0; 2], [100.04; 2]),
                row([100.0, 150.0], [160.0; 2], [0.0; 2]),
            ]),
        ),
        ("a sleeve that runs out", table(named)),
        (
            "a drum on two webs",
            table(vec![
                row([0.0, 300.0], [40.0; 2], [10.0; 2]),
                row([50.0, 60.0], [200.0; 2], [40.0; 2]),
                row([240.0, 250.0], [200.0; 2], [40.0; 2]),
                row([50.0, 250.0], [220.0; 2], [200.0; 2]),
            ]),
        ),
        (
            "wanted planes",
            SectionTable {
                planes: vec![0.01, 0.0333, 0.0334, 0.09, 0.2],
                ..table(vec![row([0.0, 100.0], [50.0; 2], [0.0; 2])])
            },
        ),
    ]
}

/// The circle between both rows of a small step has one radius: that of the row with a name, or the mean.
#[test]
fn small_steps_are_levelled() {
    let step = |names: [Option<&str>; 2]| {
        let mut rows = vec![
            row([0.0, 100.0], [50.0; 2], [0.0; 2]),
            row([100.0, 200.0], [50.02; 2], [20.0; 2]),
        ];
        rows.iter_mut().zip(names).for_each(|(row, name)| row.name = name.map(str::to_owned));
        let own = table(rows);
        let mesh = mesh(&own);
        assert_eq!(mesh.worst_cell().expect("cells").1, 0);
        let there = mesh.nodes().iter().filter(|x| (x[2] - 0.1).abs() < 1e-9 && x[1].abs() < 1e-9);
        let mut radii: Vec<f64> = there.map(|x| 2e3 * x[0]).filter(|d| *d > 40.0).collect();
        radii.sort_by(f64::total_cmp);
        let scale = crate::mesh::quadratic::corner_radius(1.0, own.cells.sectors);
        radii.iter().map(|d| d / scale).collect::<Vec<f64>>()
    };
    for (names, known) in [
        ([None, None], &[50.01][..]),
        ([Some("LEFT"), None], &[50.0]),
        ([None, Some("RIGHT")], &[50.02]),
        // With the middle of the edge between them.
        ([Some("LEFT"), Some("RIGHT")], &[50.0, 50.01, 50.02]),
    ] {
        let found = step(names);
        assert_eq!(found.len(), known.len(), "{names:?}: {found:?}");
        for (found, known) in found.iter().zip(known) {
            assert!((found - known).abs() < 1e-9, "{names:?}: {found}");
        }
    }
}

#[test]
fn cells_fit_together_and_fill_the_table() {
    for (name, own) in tables() {
        for refine in [1, 2] {
            let own = SectionTable { cells: TableCells { refine, ..own.cells }, ..own.clone() };
            let mesh = mesh(&own);
            let (worst, inverted) = mesh.worst_cell().expect("cells");
            assert_eq!(inverted, 0, "{name}: {worst:?}");
            // Faces of one cell only are the surface: its area is that of the table only if no node hangs.
            let faces = faces(&mesh);
            assert!(faces.values().all(|own| own.1 <= 2), "{name}");
            let mass = mass_properties(&mesh).expect("mass").mass;
            let apart = mass / (7800.0 * volume(&own.rows)) - 1.0;
            assert!(apart.abs() < 2e-8, "{name}: {apart:e}");
            println!(
                "{name} x{refine}: {} nodes {} cells worst {:.3} mass {apart:.2e}",
                mesh.nodes().len(),
                mesh.cell_count(),
                worst.ratio
            );
        }
    }
}
