//! A bore on a mesh that gives way under its film, against the compliance of the whole mesh.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use nalgebra::{DMatrix, DVector};
use whirl_solver::assembly::assemble;
use whirl_solver::constraints::{GroundSpring, add_ground_springs};
use whirl_solver::film::{Balance, Journal, JournalMotion, Oil, OilFilm, ShapeSlopes, Shapes};
use whirl_solver::linalg::{Matrix, SparseCholesky};
use whirl_solver::mesh::{Mesh, Surface, inp};
use whirl_specs::{CLEARANCES, ELEMENTS, FILMS};
use whirl_tests::validation::Section;

use crate::workbench::Workbench;

const RADIUS: f64 = 0.025;
const CLEARANCE: f64 = 30e-6;
const WIDTH: f64 = 0.02;
const OUTER: f64 = 0.032;
const FOOT: f64 = 0.07;
const SPEED: f64 = 100.0 * PI;
const GRID: [usize; 2] = [72, 7];
const FLOODED: f64 = 5e4;

/// Cells of the ring around, of its width, and of the shank around the ring and down to its foot.
const AROUND: usize = 36;
const ALONG: usize = 2;
const SHANK: [usize; 2] = [6, 3];

/// Nodes of a mesh of quadratic hexahedra, each once.
#[derive(Default)]
struct Cells {
    nodes: Vec<[f64; 3]>,
    cells: Vec<Vec<usize>>,
}

impl Cells {
    /// A cell of the 27 places (0 to 2 along each side) that a function gives, of which hexahedra of 20 nodes have the corners and
    /// the middles of edges.
    fn add(&mut self, place: impl Fn([f64; 3]) -> [f64; 3]) {
        const CORNERS: [[u8; 3]; 8] = [
            [0, 0, 0],
            [2, 0, 0],
            [2, 2, 0],
            [0, 2, 0],
            [0, 0, 2],
            [2, 0, 2],
            [2, 2, 2],
            [0, 2, 2],
        ];
        const EDGES: [[usize; 2]; 12] = [
            [0, 1],
            [1, 2],
            [2, 3],
            [3, 0],
            [4, 5],
            [5, 6],
            [6, 7],
            [7, 4],
            [0, 4],
            [1, 5],
            [2, 6],
            [3, 7],
        ];
        let corners = CORNERS.map(|own| own.map(|k| 0.5 * f64::from(k)));
        let middles = EDGES.map(|[a, b]| [0, 1, 2].map(|k| 0.5 * (corners[a][k] + corners[b][k])));
        let cell = corners.into_iter().chain(middles).map(|at| {
            let own = place(at);
            let same = |node: &[f64; 3]| (0..3).all(|k| (node[k] - own[k]).abs() < 1e-8);
            self.nodes.iter().position(same).unwrap_or_else(|| {
                self.nodes.push(own);
                self.nodes.len() - 1
            })
        });
        let cell = cell.collect();
        self.cells.push(cell);
    }

    fn text(&self) -> String {
        let mut text = "*NODE\n".to_owned();
        for (k, [x, y, z]) in self.nodes.iter().enumerate() {
            writeln!(text, "{}, {x:e}, {y:e}, {z:e}", k + 1).unwrap();
        }
        text += "*ELEMENT, TYPE=C3D20, ELSET=ALL\n";
        for (k, cell) in self.cells.iter().enumerate() {
            let labels: Vec<String> = cell.iter().map(|node| (node + 1).to_string()).collect();
            let (first, rest) = labels.split_at(10);
            writeln!(text, "{}, {},\n{}", k + 1, first.join(", "), rest.join(", ")).unwrap();
        }
        let at_bore = |[x, y, _]: &[f64; 3]| (x.hypot(*y) - RADIUS).abs() < 1e-7;
        let at_foot = |[_, y, _]: &[f64; 3]| (y + FOOT).abs() < 1e-7;
        let sets: [(&str, &dyn Fn(&[f64; 3]) -> bool); 2] =
            [("BORE", &at_bore), ("FOOT", &at_foot)];
        for (name, inside) in sets {
            writeln!(text, "*NSET, NSET={name}").unwrap();
            for (k, _) in self.nodes.iter().enumerate().filter(|(_, node)| inside(node)) {
                writeln!(text, "{},", k + 1).unwrap();
            }
        }
        text + "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.\n\
                *SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n"
    }
}

/// A ring whose shank stands on its foot, below.
fn ring() -> String {
    let mut own = Cells::default();
    let step = TAU / AROUND as f64;
    let first = -0.5 * PI - 0.5 * step * SHANK[0] as f64;
    for i in 0..AROUND {
        for k in 0..ALONG {
            own.add(|[a, b, c]| {
                let (sin, cos) = (first + step * (i as f64 + b)).sin_cos();
                let r = RADIUS + (OUTER - RADIUS) * a;
                [r * cos, r * sin, WIDTH * ((k as f64 + c) / ALONG as f64 - 0.5)]
            });
        }
    }
    for i in 0..SHANK[0] {
        for j in 0..SHANK[1] {
            for k in 0..ALONG {
                own.add(|[a, b, c]| {
                    let (sin, cos) = (first + step * (i as f64 + b)).sin_cos();
                    let down = (j as f64 + a) / SHANK[1] as f64;
                    let y = OUTER * sin * (1.0 - down) - FOOT * down;
                    [OUTER * cos, y, WIDTH * ((k as f64 + c) / ALONG as f64 - 0.5)]
                });
            }
        }
    }
    own.text()
}

fn journal() -> Journal {
    let kernel = FILMS.iter().find(|own| own.origin.name == "jfo").expect("a shipped film");
    let mut film = OilFilm::new(kernel, GRID, [RADIUS - CLEARANCE, WIDTH], 0.0).expect("a film");
    film.set("mu_0", 0.01).unwrap();
    film.set("sigma", 1e-7).unwrap();
    for side in 0..2 {
        film.flood(side, FLOODED).unwrap();
    }
    Journal::new(film, &CLEARANCES[0], CLEARANCE).expect("a journal")
}

/// Points of a cell of the film around and along it.
const POINTS: [usize; 2] = [8, 16];

/// The mean of the surface along the normal at every node of the film, weighed by the function of the node: straight around and of
/// second degree along, so that a pressure between nodes acts where it is.
fn opened_by(surface: &Surface, places: &[[f64; 2]]) -> Vec<Vec<(usize, f64)>> {
    let [around, along] = GRID;
    let mut rows = vec![BTreeMap::new(); places.len()];
    let mut weights = vec![0.0; places.len()];
    let (step, rise) = (TAU / around as f64, 2.0 * WIDTH / (along - 1) as f64);
    for (c, k) in (0..around).flat_map(|c| (0..along / 2).map(move |k| (c, k))) {
        for (m, n) in (0..POINTS[0]).flat_map(|m| (0..POINTS[1]).map(move |n| (m, n))) {
            let [s, t] = [(m, POINTS[0]), (n, POINTS[1])].map(|(m, n)| (m as f64 + 0.5) / n as f64);
            let at = [step * (c as f64 + s), rise * (k as f64 + t) - 0.5 * WIDTH];
            let point = surface.at(at[0], at[1]).expect("a face");
            let up = [(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)];
            for (i, (j, up)) in
                [0, 1].into_iter().flat_map(|i| up.into_iter().enumerate().map(move |j| (i, j)))
            {
                let a = (2 * k + j) * around + (c + i) % around;
                let weight = up * [1.0 - s, s][i];
                let (sin, cos) = places[a][0].sin_cos();
                weights[a] += weight;
                for &(node, own) in &point {
                    *rows[a].entry(3 * node).or_insert(0.0) += weight * own * cos;
                    *rows[a].entry(3 * node + 1).or_insert(0.0) += weight * own * sin;
                }
            }
        }
    }
    let rows = rows.into_iter().zip(weights);
    rows.map(|(row, all)| row.into_iter().map(|(dof, own)| (dof, own / all)).collect()).collect()
}

/// By how much forces at the nodes of the film open the gap there, by the whole mesh (m/N).
fn compliance(mesh: &Mesh, places: &[[f64; 2]]) -> DMatrix<f64> {
    let stiffness = assemble(mesh, "stiffness").expect("a stiffness");
    let foot = mesh.node_set("FOOT").expect("a foot");
    let springs: Vec<GroundSpring> = foot
        .iter()
        .flat_map(|node| (0..3).map(move |axis| 3 * node + axis))
        .map(|dof| GroundSpring { name: "foot".into(), dof, stiffness: 1e15 })
        .collect();
    let held = add_ground_springs(stiffness, &springs).expect("held");
    let lower = held.lower().expect("a symmetric matrix");
    let size = held.size();
    let order: Vec<usize> = (0..size).collect();
    let factor = SparseCholesky::new(&lower, &order, usize::MAX).expect("positive definite");
    let surface = Surface::of_set(mesh, "BORE", [0.0; 2]).expect("a bore");
    let rows = opened_by(&surface, places);
    let mut moved = vec![0.0; size * rows.len()];
    for (column, row) in moved.chunks_exact_mut(size).zip(&rows) {
        row.iter().for_each(|&(dof, value)| column[dof] += value);
    }
    factor.solve_in_place(&mut moved);
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| {
        rows[i].iter().map(|&(dof, value)| value * moved[size * j + dof]).sum()
    })
}

/// The largest pressure (MPa) and the smallest gap (µm) of the journal in equilibrium under a load (N) down, in a bore of this
/// compliance: Newton's method on its displacement and the opening of the gap at every node.
fn carried(journal: &Journal, compliance: &DMatrix<f64>, load: f64) -> [f64; 2] {
    let nodes = journal.film.grid.nodes();
    let shapes = Shapes::new(Matrix::from_fn(nodes, nodes, |i, j| f64::from(u8::from(i == j))));
    let mut balance = Balance::new(&journal.film);
    balance.tolerance = 1e-13;
    let mut outputs = vec![0.0; journal.film.outputs()];
    let mut slopes = ShapeSlopes::new(&shapes);
    let mut pushed = vec![0.0; nodes];
    let (mut e, mut opened) = ([0.0, 0.5 * CLEARANCE.copysign(load)], DVector::zeros(nodes));
    for part in 1..=80 {
        // By and by, as far as the load.
        let own = load * (f64::from(part) / 40.0).min(1.0);
        let motion = JournalMotion { displacement: e, omega: SPEED, ..JournalMotion::default() };
        let mut oil = Oil::full(&journal.film);
        balance.motion.deformed = Some([opened.as_slice().to_vec(), vec![0.0; nodes]]);
        journal.settle(&motion, &mut oil, &mut balance).expect("a film");
        let forces = journal.forces(&mut balance, &mut outputs);
        journal.push(&balance, &shapes, &mut pushed);
        let rigid = journal.slopes(None, &oil, &mut balance);
        journal.slopes_of_shapes(None, &oil, &mut balance, &shapes, &mut slopes);
        let on_nodes = DVector::from_column_slice(&pushed);
        let mut residual = DVector::zeros(nodes + 2);
        residual[0] = forces[0];
        residual[1] = forces[1] + own;
        residual.rows_mut(2, nodes).copy_from(&(&opened - compliance * &on_nodes));
        let lacks =
            residual[0].hypot(residual[1]) / load + residual.rows(2, nodes).amax() / CLEARANCE;
        if part > 40 && lacks < 1e-9 {
            let most = oil.unknowns[0].iter().copied().fold(0.0, f64::max);
            let least = balance.motion.gap.iter().copied().fold(f64::INFINITY, f64::min);
            return [1e-6 * most, 1e6 * least];
        }
        let of_nodes = DMatrix::from_fn(nodes, nodes + 2, |k, j| match j {
            0 | 1 => slopes.by_inputs[k][j],
            _ => slopes.by_shapes[0][(k, j - 2)],
        });
        let by_nodes = compliance * of_nodes;
        let matrix = DMatrix::from_fn(nodes + 2, nodes + 2, |i, j| match (i, j) {
            (0 | 1, 0 | 1) => rigid[i][j],
            (0 | 1, _) => slopes.on_journal[0][j - 2][i],
            _ => f64::from(u8::from(i == j)) - by_nodes[(i - 2, j)],
        });
        let step = matrix.lu().solve(&residual).expect("a step");
        // No farther at once than the gap is wide.
        let least = balance.motion.gap.iter().copied().fold(f64::INFINITY, f64::min);
        let most = step.rows(2, nodes).amax().max(step[0].hypot(step[1]));
        let factor = (least / most).min(1.0);
        e = [e[0] - factor * step[0], e[1] - factor * step[1]];
        opened -= factor * step.rows(2, nodes);
    }
    panic!("no equilibrium");
}

/// The same of a case.
fn of_case(load: f64, body: &str, film: &str) -> [f64; 2] {
    let case = format!(
        r#"title = "a ring with a shank"
[body.journal]
turns = "prescribed"
speed = "3000 rpm"
mass = "2 kg"
polar_inertia = "0.001 kg*m^2"
[body.ring]
turns = "no"
mesh = "ring.inp"
units = "m, N, kg"
modes = 10
held = "FOOT"
{body}
[joint.b]
kind = "bearing"
journal = {{ body = "journal" }}
bore = {{ body = "ring", surface = "BORE" }}
law = "jfo"
parameters = {{ mu_0 = "10 mPa*s", sigma = "0.1 um" }}
radial_clearance = "30 um"
journal_radius = "24.97 mm"
film = {{ left = "0.5 bar", right = "0.5 bar"{film} }}
[loads.pull]
body = "journal"
force = ["0 N", "{load} N", "0 N"]
[output.f]
quantity = "film"
joint = "b"
[march]
time_step = "5e-5 s"
steps = 2
[start]
kind = "equilibrium"
"#
    );
    let bench = Workbench::new().file("case.toml", &case).file("ring.inp", &ring());
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-report"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    let history = bench.history("out");
    ["pmax_f_MPa", "hmin_f_um"].map(|name| history.column(name)[0])
}

#[test]
fn a_ring_with_a_shank_gives_way_as_the_whole_mesh_does() {
    let mut section = Section::new(
        "A ring with a shank under its oil film",
        "the film of `jfo` on the compliance of all nodes of the mesh, by Newton's method on the gap at every node of the film",
        "cargo test -p whirl-cli --test cli -- a_ring_with_a_shank_gives_way_as_the_whole_mesh_does",
    );
    let mesh =
        inp::read(&ring(), "ring.inp", &ELEMENTS.iter().collect::<Vec<_>>()).expect("a mesh").mesh;
    let journal = journal();
    let compliance = compliance(&mesh, &journal.film.grid.places());
    // Towards the shank, and away from it.
    for load in [-10e3, 10e3] {
        let theirs = carried(&journal, &compliance, load);
        let ours = of_case(load, "", "");
        let rigid = of_case(load, "", ", flexible = false");
        let few = of_case(load, "static_correction = false", "");
        let side = if load < 0.0 { "shank" } else { "cap" };
        let what = format!("{theirs:?}, rigid {rigid:?}, ten modes {few:?}, ours {ours:?}");
        section.compare(&format!("largest pressure, {side} (MPa)"), theirs[0], ours[0], 0.02);
        section.compare(&format!("smallest gap, {side} (µm)"), theirs[1], ours[1], 0.01);
        // A rigid bore is another bearing, and modes alone do not make it this one.
        assert!(rigid[0] > 1.2 * theirs[0] && few[0] > 1.1 * theirs[0], "{what}");
    }
    section.finish();
}

#[test]
fn what_cannot_give_way_is_refused() {
    let case = |body: &str, rest: &str| {
        format!(
            r#"title = "a ring"
[body.journal]
turns = "prescribed"
speed = "3000 rpm"
mass = "2 kg"
polar_inertia = "0.001 kg*m^2"
[body.ring]
turns = "no"
mesh = "ring.inp"
units = "m, N, kg"
modes = 2
held = "FOOT"
{body}
[joint.b]
kind = "bearing"
journal = {{ body = "journal" }}
law = "reynolds"
radial_clearance = "30 um"
journal_radius = "24.97 mm"
{rest}
[march]
time_step = "5e-5 s"
steps = 2
"#
        )
    };
    let on_ring = "bore = { body = \"ring\", surface = \"BORE\" }";
    let cases = [
        (
            case("", "length = \"20 mm\"\nfilm = { flexible = true }"),
            "the bore of this film cannot give way: it is no `surface` of a flexible body",
            "bore = { body = \"NAME\", surface = \"SET\" }",
        ),
        (
            case(
                "static_correction = [\"pressure\"]",
                &format!("{on_ring}\nfilm = {{ flexible = false }}"),
            ),
            "no bore of ring.inp gives way under one",
            "leave `pressure` out",
        ),
        (
            case("", &format!("{on_ring}\nlength = \"30 mm\"")),
            "where the film belongs; it extends from z = -10 mm to 10 mm",
            "or write `flexible = false` in its table `film`",
        ),
    ];
    for (case, what, help) in cases {
        let bench = Workbench::new().file("case.toml", &case).file("ring.inp", &ring());
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        let said = outcome.stderr.replace("\n", " ");
        assert!(said.contains(what) && said.contains(help), "{said}");
        assert!(!bench.path("out").exists());
    }
    // Long enough, and as round as it is.
    let short = case("", &format!("{on_ring}\nlength = \"30 mm\"\nfilm = {{ flexible = false }}"));
    let bench = Workbench::new().file("case.toml", &short).file("ring.inp", &ring());
    assert_eq!(bench.whirl(&["check", "case.toml"]).status, 0);
}
