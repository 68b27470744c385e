//! The rotors: meshes made from dimensions, and meshes read from files.

use std::f64::consts::TAU;
use std::io::Read;
use std::path::Path;

use whirl_solver::bearing::SpringLaw;
use whirl_solver::history;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_solver::mesh::{Material, Mesh, MeshParts, inp};
use whirl_specs::{ELEMENTS, Element};

use super::by_hand::{BearingByHand, ByHand, LoadByHand};
use super::{History, Results};

fn elements() -> Vec<&'static Element> {
    ELEMENTS.iter().collect()
}

fn titanium() -> Material {
    Material::isotropic("titanium", 114e9, 0.31, 4430.0).expect("a material")
}

fn copper() -> Material {
    Material::isotropic("copper", 117e9, 0.34, 8930.0).expect("a material")
}

/// The mesh with a material in cells of some types, by Abaqus' names.
fn with(mesh: &Mesh, material: Material, types: &[&str]) -> Mesh {
    let (mut blocks, mut materials) = (mesh.blocks().to_vec(), mesh.materials().to_vec());
    let mut found = 0;
    for block in &mut blocks {
        if block.element.abaqus.iter().any(|name| types.contains(name)) {
            block.material = materials.len();
            found += 1;
        }
    }
    assert_eq!(found, 1, "one block has {types:?}");
    materials.push(material);
    Mesh::new(MeshParts {
        origin: mesh.origin().to_owned(),
        nodes: mesh.nodes().to_vec(),
        labels: mesh.labels().to_vec(),
        blocks,
        materials,
        node_sets: mesh.node_sets().clone(),
        element_sets: mesh.element_sets().clone(),
        ties: Vec::new(),
        matrices: None,
    })
    .expect("a mesh")
}

/// film.toml and wall.toml with the values of the case: Q = a exp(−h/b) (1 − c ḣ), T = −μ Q tanh(v_t/v), a = q L.
struct Film {
    name: &'static str,
    /// a (N), b (m), c (s/m), μ, v (m/s).
    constants: [f64; 5],
}

impl SpringLaw for Film {
    fn name(&self) -> &str {
        self.name
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        vec!["h", "h_dot", "v_t"]
    }
    fn outputs(&self) -> Vec<&str> {
        vec!["Q", "T"]
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        let [a, b, c, mu, v] = self.constants;
        for j in 0..springs {
            let [h, h_dot, v_t] = [0, 1, 2].map(|input| inputs[input * springs + j]);
            let thin = a * (-h / b).exp();
            let damped = 1.0 - c * h_dot;
            let slip = (v_t / v).tanh();
            let q = thin * damped;
            let friction = -mu * slip;
            let rows = [
                [q, -q / b, -thin * c, 0.0],
                [
                    friction * q,
                    -friction * q / b,
                    -friction * thin * c,
                    -mu * q * (1.0 - slip * slip) / v,
                ],
            ];
            for (row, value) in rows.as_flattened().iter().enumerate() {
                outputs[row * springs + j] = *value;
            }
        }
    }
}

fn film() -> Box<dyn SpringLaw> {
    Box::new(Film { name: "film", constants: [600.0, 30e-6, 0.4, 0.06, 0.5] })
}

fn wall() -> Box<dyn SpringLaw> {
    Box::new(Film { name: "wall", constants: [900.0, 45e-6, 0.2, 0.03, 0.8] })
}

/// hu2003-nonlinear: Q = 388 − 18632 h + 217550 h² below its first root, in N and mm.
struct Cubic;

impl SpringLaw for Cubic {
    fn name(&self) -> &str {
        "hu2003-nonlinear"
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        vec!["h"]
    }
    fn outputs(&self) -> Vec<&str> {
        vec!["Q"]
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, h: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        let [a, b, c] = [388.0, -18632e3, 217550e6];
        let root = 2.0 * a / (-b + f64::sqrt(b * b - 4.0 * a * c));
        for (j, &h) in h.iter().enumerate() {
            let acts = f64::from(u8::from(h < root));
            outputs[j] = acts * (a + b * h + c * h * h);
            outputs[springs + j] = acts * (b + 2.0 * c * h);
        }
    }
}

/// Every column of the run is the one of the machine put together by hand.
fn agrees(found: &History, expected: &history::History) {
    assert_eq!(found.names(), expected.names());
    let column = |name: &String| expected.column(name).expect("a column");
    for group in [&["t"][..], &["theta"], &["omega"], &["R"], &["X", "Y"], &["EX", "EY"], &["MZ"]] {
        let names: Vec<&String> = found
            .names()
            .iter()
            .filter(|name| {
                group.iter().any(|letters| {
                    name.starts_with(letters) && !(*letters == "t" && name.starts_with("theta"))
                })
            })
            .collect();
        let peak = names.iter().flat_map(|name| column(name)).fold(0.0, |m: f64, v| m.max(v.abs()));
        for name in names {
            let (found, expected) = (found.column(name), column(name));
            assert_eq!(found.len(), expected.len(), "{name}");
            for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
                // The order of coordinates differs, and with it the rounding of sums: each step is solved
                // to 1e-7 of its forces all the same, or by ten to a hundred times less.
                let wrong = (found - expected).abs();
                assert!(wrong <= 1e-6 * peak, "{name} in row {row}: {found}, by hand {expected}");
            }
        }
    }
    // The tolerance of the case ends the iteration: rounding may take a step less or more now and then.
    let iterations = column(&"iterations".to_owned());
    let same = found.column("iterations").iter().zip(&iterations).filter(|(a, b)| a == b).count();
    assert!(same * 20 >= iterations.len() * 19, "{same} steps of {} alike", iterations.len());
}

fn count(results: &Results, body: &str, key: &str) -> u64 {
    results.summary["counts"][body][key].as_u64().expect("a count")
}

#[test]
fn a_generated_rotor_is_what_its_case_says() {
    let shaft = SolidShaft {
        length: 0.310,
        diameter: 0.041,
        supports: vec![0.043, 0.251],
        support_length: 0.022,
        layers_in_support: 4,
        layers_between: 6,
        loads: vec![0.085, 0.178],
        sections: Vec::new(),
        section: SectionCells { sectors: 6, rings: 2, order: 2 },
        material: titanium(),
    };
    let support = RingSupport {
        start: 0.029,
        length: 0.239,
        height: 0.031,
        width: 0.026,
        pedestal_height: 0.009,
        rings: vec![0.043, 0.251],
        ring_length: 0.022,
        ring_thickness: 0.008,
        bore_radius: 0.02054,
        layers_in_ring: 2,
        layers_between: 5,
        section: SupportCells { height: 3, width: 2, pedestal: 4, around: 10, radial: 1, order: 2 },
        material: copper(),
    };
    let machine = ByHand {
        start_speed: -70.0 * std::f64::consts::TAU / 60.0,
        shaft: shaft.mesh(&elements()).expect("a mesh"),
        support: support.mesh(&elements()).expect("a mesh"),
        modes: [5, 7],
        damping: [3e-6, 2e-5],
        mass_damping: [0.0, 7.5],
        motion: "hu2003",
        axial_restraint: "JOURNAL2_RIGHT",
        stiffening: true,
        answers_loads: true,
        ground_springs: vec![
            ("GROUND_SPRINGS", 1, 2.3e6),
            ("BORE2_LEFT", 2, 4.1e5),
            ("BORE1_RIGHT", 0, 7e5),
        ],
        laws: vec![film(), wall()],
        bearings: vec![
            BearingByHand {
                k: 1,
                springs: 7,
                clearance: 40e-6,
                radius: Some(0.0204),
                law: 0,
                stations: vec![0.032, 0.043, 0.054],
            },
            BearingByHand {
                k: 2,
                springs: 5,
                clearance: 50e-6,
                radius: Some(0.0203),
                law: 1,
                stations: vec![0.243, 0.2595],
            },
        ],
        drive: Some((17.0, 900.0 * TAU / 60.0)),
        loads: vec![
            LoadByHand {
                sets: &["LOAD1", "JOURNAL2_RIGHT"],
                force: [0.0, -370.0],
                sine: Some((310.0, 35.0 * TAU / 360.0)),
            },
            LoadByHand { sets: &["LOAD2"], force: [520.0, 0.0], sine: None },
        ],
        time_step: 2e-5,
        steps: 260,
        force_tolerance: 2e-3,
    };
    let results = Results::of("generated", &[]);
    for (body, mesh, modes) in [("shaft", &machine.shaft, 5), ("support", &machine.support, 7)] {
        assert_eq!(count(&results, body, "nodes"), mesh.nodes().len() as u64);
        assert_eq!(count(&results, body, "elements"), mesh.cell_count() as u64);
        assert_eq!(count(&results, body, "modes"), modes);
    }
    agrees(&results.history, &machine.march());
    results.sums_up(1.0 / 450.0);
    let facts = &results.summary["case"];
    assert_eq!(facts["title"], "every key of a generated rotor");
    assert_eq!(facts["source"], "a test");
    for (figure, number) in
        [("laws", 71), ("reactions", 72), ("eccentricity", 73), ("rotation", 74)]
    {
        let text = results.figure(figure);
        assert!(text.contains(&format!("Fig. {number} of the paper")), "{figure}");
    }
    let laws = results.figure("laws");
    assert!(laws.contains("wall") && laws.contains("film"));
}

#[test]
fn a_read_rotor_is_what_its_case_says() {
    let text = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/data/{name}.gz"));
        let mut text = String::new();
        let packed = std::fs::File::open(&path).expect("the test data is there");
        flate2::read::GzDecoder::new(packed).read_to_string(&mut text).expect("text");
        text
    };
    let files = ["shaft.inp", "support.inp"].map(|name| (name, text(name)));
    let [shaft, support] = files.each_ref().map(|(name, text)| -> Mesh {
        inp::read(text, name, &elements()).unwrap_or_else(|errors| panic!("{errors}")).mesh
    });
    let machine = ByHand {
        start_speed: 0.0,
        shaft: with(&shaft, titanium(), &["C3D6"]),
        support: with(&support, copper(), &["C3D8I"]),
        modes: [6, 9],
        damping: [4e-6, 7e-6],
        mass_damping: [0.0; 2],
        motion: "consistent",
        axial_restraint: "JOURNAL4_LEFT",
        stiffening: false,
        answers_loads: false,
        ground_springs: vec![("GROUND_SPRINGS", 1, 1.9e8)],
        laws: vec![film(), Box::new(Cubic)],
        bearings: vec![
            BearingByHand {
                k: 1,
                springs: 9,
                clearance: 35e-6,
                radius: None,
                law: 1,
                stations: vec![0.014, 0.031, 0.033],
            },
            BearingByHand {
                k: 4,
                springs: 13,
                clearance: 33e-6,
                radius: None,
                law: 0,
                stations: vec![1.3675, 1.38, 1.3925],
            },
        ],
        drive: None,
        loads: vec![
            LoadByHand { sets: &["LOAD1"], force: [-410.0, 0.0], sine: Some((90.0, -0.4)) },
            LoadByHand { sets: &["LOAD3"], force: [0.0, 260.0], sine: None },
        ],
        time_step: 5e-5,
        steps: 90,
        force_tolerance: 1e-3,
    };
    let [shaft, (support, text)] = files;
    let bare: Vec<&str> = text.lines().filter(|line| !line.starts_with("*SOLID SECTION")).collect();
    let results = Results::of("read", &[shaft, (support, bare.join("\n") + "\n")]);
    agrees(&results.history, &machine.march());
    results.sums_up(1.0 / 500.0);
}
