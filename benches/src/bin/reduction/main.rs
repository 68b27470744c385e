//! Modes of both bodies of the reference machine: ours beside SciPy's `eigsh` with SuperLU on the same matrices, and beside
//! CalculiX on the same meshes, in one run.
//!
//! A program that is missing is a row that says so. `sizes` as an argument shows larger bodies instead. No time is held
//! against a bound.

mod calculix;
mod sizes;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Instant;

use whirl_solver::assembly::assemble;
use whirl_solver::constraints::{GroundSpring, add_ground_springs};
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_solver::mesh::{Material, Mesh};
use whirl_solver::reduction::{CraigBampton, Interface, Solid};
use whirl_solver::sparse::SparseMatrix;
use whirl_specs::{ELEMENTS, Element};

use self::calculix::{Calculix, Job};

/// Times of ours, of which the fastest counts.
const ROUNDS: usize = 3;
const SUPPORTS: [f64; 4] = [0.024, 0.476, 0.928, 1.380];

fn main() {
    if std::env::args().nth(1).as_deref() == Some("sizes") {
        return sizes::table();
    }
    let bodies = [support(), shaft()];
    let (mut ours, mut theirs, mut of_calculix) = (0.0, Some(0.0), Some(0.0));
    println!("| Body | Modes | Program | Seconds | Over ours | Largest residual | Found |");
    println!("|---|---|---|---|---|---|---|");
    for body in &bodies {
        let (seconds, found) = (0..ROUNDS)
            .map(|_| timed(|| body.reduce()))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("there are rounds");
        ours += seconds;
        let named = format!("{}, {} dofs", body.name, body.inner.len());
        let residual = body.residual(&found);
        let count = found.modes();
        println!("| {named} | {count} | whirl | {seconds:.3} | 1 | {residual:.1e} | {count} |");
        match by_scipy(body, &found) {
            Ok(row) => {
                theirs = theirs.map(|sum| sum + row.seconds);
                let ratio = row.seconds / seconds;
                let Scipy { version, seconds, residual, found, .. } = row;
                println!(
                    "| {named} | {count} | SciPy {version} | {seconds:.3} | {ratio:.1} | {residual:.1e} | {found} |"
                );
            }
            Err(why) => {
                theirs = None;
                println!("| {named} | {count} | SciPy | {why} | | | |");
            }
        }
        match by_calculix(body, &found) {
            Ok((row, found)) => {
                of_calculix = of_calculix.map(|sum| sum + row.seconds);
                let ratio = row.seconds / seconds;
                let Calculix { version, seconds, .. } = row;
                println!(
                    "| {named} | {count} | CalculiX {version} | {seconds:.3} | {ratio:.1} | of its own matrices | {found} |"
                );
            }
            Err(why) => {
                of_calculix = None;
                println!("| {named} | {count} | CalculiX | {why} | | | |");
            }
        }
    }
    let side_by_side = (0..ROUNDS)
        .map(|_| {
            timed(|| {
                thread::scope(|scope| {
                    bodies
                        .each_ref()
                        .map(|own| scope.spawn(|| own.reduce()))
                        .map(|own| own.join().is_ok())
                })
            })
            .0
        })
        .fold(f64::INFINITY, f64::min);
    println!("| both | | whirl, one after the other | {ours:.3} | 1 | | |");
    println!(
        "| both | | whirl, side by side | {side_by_side:.3} | {:.2} | | |",
        side_by_side / ours
    );
    for (program, theirs) in [("SciPy", theirs), ("CalculiX", of_calculix)] {
        if let Some(theirs) = theirs {
            println!(
                "| both | | {program} | {theirs:.3} | {:.1}; {:.1} of side by side | | |",
                theirs / ours,
                theirs / side_by_side
            );
        }
    }
}

fn timed<T>(task: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let made = task();
    (start.elapsed().as_secs_f64(), made)
}

/// A body with its matrices, of which some dofs are held.
struct Body {
    name: &'static str,
    mesh: Mesh,
    stiffness: SparseMatrix,
    mass: SparseMatrix,
    held: Vec<usize>,
    springs: Vec<GroundSpring>,
    /// Those that are not held, ascending.
    inner: Vec<usize>,
    modes: usize,
}

impl Body {
    fn new(
        name: &'static str,
        mesh: Mesh,
        springs: Vec<GroundSpring>,
        held: Vec<usize>,
        modes: usize,
    ) -> Body {
        let stiffness = assemble(&mesh, "stiffness").expect("a stiffness");
        let stiffness = add_ground_springs(stiffness, &springs).expect("springs on dofs");
        let mass = assemble(&mesh, "mass").expect("a mass");
        let inner = (0..mesh.dof_count()).filter(|dof| !held.contains(dof)).collect();
        Body { name, mesh, stiffness, mass, held, springs, inner, modes }
    }

    /// Order of elimination, factor, modes and their count.
    fn reduce(&self) -> CraigBampton {
        let Body { stiffness, mass, .. } = self;
        let coordinates = self.mesh.nodes();
        let solid =
            Solid { stiffness, mass, coordinates, slots: &[], ties: &[], memory: usize::MAX };
        let interface = Interface { held: &self.held, ..Interface::default() };
        solid.reduce(&interface, self.modes).expect("a body that is held")
    }

    /// The largest ‖Kx − λMx‖/‖λMx‖ over the inner dofs.
    fn residual(&self, found: &CraigBampton) -> f64 {
        let product = |matrix: &SparseMatrix, x: &[f64]| {
            let mut product = vec![0.0; x.len()];
            matrix.multiply(x, &mut product);
            product
        };
        let of_mode = |mode: usize| {
            let (value, x) = (found.stiffness[(mode, mode)], found.shapes.col(mode));
            let (k, m) = (product(&self.stiffness, x), product(&self.mass, x));
            let squares =
                |of: &dyn Fn(usize) -> f64| self.inner.iter().map(|&i| of(i).powi(2)).sum::<f64>();
            (squares(&|i| k[i] - value * m[i]) / squares(&|i| value * m[i])).sqrt()
        };
        (0..found.modes()).map(of_mode).fold(0.0, f64::max)
    }

    /// Writes the inner part of a matrix in the Matrix Market format.
    fn write(&self, matrix: &SparseMatrix, path: &Path) {
        let mut place = vec![None; matrix.size()];
        self.inner.iter().enumerate().for_each(|(row, &dof)| place[dof] = Some(row + 1));
        let (columns, mut entries, mut count) = (matrix.to_columns(), String::new(), 0);
        for &dof in &self.inner {
            for (other, value) in columns.column(dof).filter(|(other, _)| *other >= dof) {
                if let (Some(row), Some(column)) = (place[other], place[dof]) {
                    writeln!(entries, "{row} {column} {value:e}").expect("memory can be written");
                    count += 1;
                }
            }
        }
        let n = self.inner.len();
        let head = format!("%%MatrixMarket matrix coordinate real symmetric\n{n} {n} {count}\n");
        fs::write(path, head + &entries).expect("a file can be written");
    }
}

/// What the script says.
struct Scipy {
    version: String,
    seconds: f64,
    residual: f64,
    found: String,
}

/// SciPy's modes, or why there are none.
fn by_scipy(body: &Body, ours: &CraigBampton) -> Result<Scipy, String> {
    let folder = std::env::temp_dir();
    let [stiffness, mass] =
        ["K", "M"].map(|name| folder.join(format!("whirl-{}-{name}.mtx", body.name)));
    body.write(&body.stiffness, &stiffness);
    body.write(&body.mass, &mass);
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/bin/reduction/scipy_modes.py");
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let mut command = Command::new(&python);
    command.arg(script).args([&stiffness, &mass]).arg(body.modes.to_string());
    let done = command.output().map_err(|error| format!("{python} is missing: {error}"))?;
    if !done.status.success() {
        let said = String::from_utf8_lossy(&done.stderr);
        return Err(format!("failed: {}", said.lines().last().unwrap_or("it said nothing")));
    }
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    let fields: Vec<&str> = said.split_whitespace().collect();
    let &[version, seconds, residual, found, highest] = fields.as_slice() else {
        return Err(format!("said what is not understood: {said}"));
    };
    let number = |text: &str| text.parse::<f64>().map_err(|error| format!("`{text}`: {error}"));
    let last = ours.stiffness[(body.modes - 1, body.modes - 1)];
    let apart = (number(highest)? / last - 1.0).abs();
    let found = format!("{found}, the highest λ within {apart:.0e}");
    Ok(Scipy {
        version: version.to_owned(),
        seconds: number(seconds)?,
        residual: number(residual)?,
        found,
    })
}

/// CalculiX' modes and what is found of them, or why there are none.
fn by_calculix(body: &Body, ours: &CraigBampton) -> Result<(Calculix, String), String> {
    let Body { name, mesh, held, springs, modes, .. } = body;
    let row = Job { name, mesh, held, springs, modes: *modes }.run()?;
    let found = row.values.len();
    let apart = |place: usize| (row.values[place] / ours.stiffness[(place, place)] - 1.0).abs();
    let (lowest, highest) = (apart(0), apart(found.min(*modes) - 1));
    let found =
        format!("{found}, the lowest λ within {lowest:.0e}, the highest within {highest:.0e}");
    Ok((row, found))
}

fn steel() -> Material {
    Material::isotropic("steel", 200e9, 0.3, 7860.0).expect("steel")
}

fn elements() -> Vec<&'static Element> {
    ELEMENTS.iter().collect()
}

/// Dofs of the nodes of sets along some components.
fn dofs(mesh: &Mesh, sets: &[&str], components: &[usize]) -> Vec<usize> {
    let nodes = sets.iter().flat_map(|set| mesh.node_set(set).expect("a set"));
    nodes.flat_map(|node| components.iter().map(move |component| 3 * node + component)).collect()
}

/// That of `hu2003.machine.toml`, its mounts held.
fn support() -> Body {
    support_of(1.0)
}

/// The same with so many cells for one, along every direction.
fn support_of(finer: f64) -> Body {
    let cells = |count: usize| (finer * count as f64).round() as usize;
    // Some numbers have to be even.
    let even = |count: usize| 2 * cells(count / 2);
    let SupportCells { height, width, pedestal, around, radial, .. } = SupportCells::default();
    let dimensions = RingSupport {
        start: 0.0115,
        length: 1.381,
        height: 0.050,
        width: 0.080,
        pedestal_height: 0.010,
        rings: SUPPORTS.to_vec(),
        ring_length: 0.025,
        ring_thickness: 0.020,
        bore_radius: 0.034_035_687,
        layers_in_ring: even(2),
        layers_between: cells(20),
        section: SupportCells {
            height: cells(height),
            width: even(width),
            pedestal: cells(pedestal),
            around: even(around),
            radial: cells(radial),
            order: 1,
        },
        material: steel(),
    };
    let mesh = dimensions.mesh(&elements()).expect("a mesh");
    let springs = dofs(&mesh, &["GROUND_SPRINGS"], &[1]).into_iter();
    let springs: Vec<GroundSpring> = springs
        .map(|dof| GroundSpring { name: "ground spring".to_owned(), dof, stiffness: 1e8 })
        .collect();
    let held = dofs(&mesh, &["MOUNTS"], &[0, 1, 2]);
    Body::new("support", mesh, springs, held, 150)
}

/// That of `hu2003.machine.toml`, its retained dofs held.
fn shaft() -> Body {
    let dimensions = SolidShaft {
        length: 1.404,
        diameter: 0.068,
        supports: SUPPORTS.to_vec(),
        support_length: 0.025,
        layers_in_support: 2,
        layers_between: 22,
        loads: vec![0.250, 0.702, 1.154],
        sections: Vec::new(),
        section: SectionCells::default(),
        material: steel(),
    };
    let mesh = dimensions.mesh(&elements()).expect("a mesh");
    let journals: Vec<String> = (1..=4)
        .flat_map(|k| ["LEFT", "MIDDLE", "RIGHT"].map(|place| format!("JOURNAL{k}_{place}")))
        .collect();
    let journals: Vec<&str> = journals.iter().map(String::as_str).collect();
    let mut held = dofs(&mesh, &journals, &[0, 1]);
    held.extend(dofs(&mesh, &["JOURNAL3_MIDDLE"], &[2]));
    held.extend(dofs(&mesh, &["DRIVE_TOP", "DRIVE_BOTTOM"], &[1]));
    Body::new("shaft", mesh, Vec::new(), held, 50)
}
