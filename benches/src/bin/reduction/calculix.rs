//! The same body for CalculiX: an input file with its mesh, what is held and its springs, and what `ccx` says of it.
//!
//! CalculiX assembles its own matrices. Its elements of the same names differ from ours in their points and modes, so that
//! the highest eigenvalue differs too; the work is of the same size.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Instant;

use whirl_solver::constraints::GroundSpring;
use whirl_solver::mesh::Mesh;

/// What a job was.
pub(super) struct Calculix {
    pub(super) version: String,
    /// The whole job, with its input file and its assembly.
    pub(super) seconds: f64,
    /// Eigenvalues (1/s²), ascending.
    pub(super) values: Vec<f64>,
}

/// A body as CalculiX gets it.
pub(super) struct Job<'a> {
    pub(super) name: &'a str,
    pub(super) mesh: &'a Mesh,
    /// Dofs, 3·node + component.
    pub(super) held: &'a [usize],
    pub(super) springs: &'a [GroundSpring],
    pub(super) modes: usize,
}

impl Job<'_> {
    /// The lowest modes, or why there are none. `$CCX` names the program where it is not `ccx`.
    pub(super) fn run(&self) -> Result<Calculix, String> {
        let program = std::env::var("CCX").unwrap_or_else(|_| "ccx".to_owned());
        let version = version(&program)?;
        let name = format!("whirl-{}-{}", self.name, std::process::id());
        let folder = std::env::temp_dir().join(&name);
        let done = fs::create_dir_all(&folder)
            .and_then(|()| fs::write(folder.join("job.inp"), self.input()))
            .and_then(|()| timed(&program, &folder));
        let text = fs::read_to_string(folder.join("job.dat"));
        // What is left of it is of no use, and the system cleans the folder of temporary files.
        let _ = fs::remove_dir_all(&folder);
        let seconds = done.map_err(|error| format!("failed: {error}"))?;
        let values = values(&text.map_err(|error| format!("wrote no results: {error}"))?);
        match values.len() {
            0 => Err("found no modes".to_owned()),
            _ => Ok(Calculix { version, seconds, values }),
        }
    }

    /// Numbers have a point and at most twenty characters: others are not read.
    fn input(&self) -> String {
        let mut text = String::from("*NODE, NSET=NALL\n");
        let mut line = |line: std::fmt::Arguments<'_>| {
            text.write_fmt(line).expect("memory can be written");
            text.push('\n');
        };
        for (node, [x, y, z]) in self.mesh.nodes().iter().enumerate() {
            line(format_args!("{}, {x:.12e}, {y:.12e}, {z:.12e}", node + 1));
        }
        let mut label = 0;
        for (place, block) in self.mesh.blocks().iter().enumerate() {
            let kind = block.element.abaqus.first().expect("a type of Abaqus");
            line(format_args!("*ELEMENT, TYPE={kind}, ELSET=BLOCK{place}"));
            for cell in block.cells() {
                label += 1;
                let order = block.element.abaqus_order.iter();
                let nodes: Vec<String> = order.map(|own| (cell[*own] + 1).to_string()).collect();
                line(format_args!("{label}, {}", nodes.join(", ")));
            }
            let material = &self.mesh.materials()[block.material];
            let [e, nu, rho] = ["E", "nu", "rho"].map(|name| material.properties[name]);
            line(format_args!(
                "*MATERIAL, NAME=M{place}\n*ELASTIC\n{e:.12e}, {nu:.12e}\n*DENSITY\n{rho:.12e}"
            ));
            line(format_args!("*SOLID SECTION, ELSET=BLOCK{place}, MATERIAL=M{place}"));
        }
        for (place, spring) in self.springs.iter().enumerate() {
            label += 1;
            let (node, component) = (spring.dof / 3 + 1, spring.dof % 3 + 1);
            line(format_args!("*ELEMENT, TYPE=SPRING1, ELSET=SPRING{place}\n{label}, {node}"));
            line(format_args!(
                "*SPRING, ELSET=SPRING{place}\n{component}\n{:.12e}",
                spring.stiffness
            ));
        }
        line(format_args!("*BOUNDARY"));
        for dof in self.held {
            let (node, component) = (dof / 3 + 1, dof % 3 + 1);
            line(format_args!("{node}, {component}, {component}"));
        }
        line(format_args!("*STEP\n*FREQUENCY\n{}\n*END STEP", self.modes));
        text
    }
}

/// What the program says of itself.
fn version(program: &str) -> Result<String, String> {
    let output = Command::new(program).arg("-v").output();
    let output = output.map_err(|error| format!("{program} is missing: {error}"))?;
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok(said.split_whitespace().last().unwrap_or("of an unknown version").to_owned())
}

/// Runs the job on all processors, and gives its seconds.
fn timed(program: &str, folder: &Path) -> io::Result<f64> {
    let processors = thread::available_parallelism().map_or(1, usize::from).to_string();
    let start = Instant::now();
    let mut command = Command::new(program);
    command.args(["-i", "job"]).current_dir(folder).env("OMP_NUM_THREADS", processors);
    let output = command.output()?;
    let seconds = start.elapsed().as_secs_f64();
    match output.status.success() {
        true => Ok(seconds),
        false => Err(io::Error::other(format!("it ended with {}", output.status))),
    }
}

/// The eigenvalues of a file of results: the second number in lines of five, which begin with the number of the mode.
fn values(text: &str) -> Vec<f64> {
    let mut values = Vec::new();
    for line in text.lines() {
        let numbers: Vec<&str> = line.split_whitespace().collect();
        if numbers.len() == 5 && numbers[0].parse() == Ok(values.len() + 1) {
            match numbers[1].parse() {
                Ok(value) => values.push(value),
                Err(_) => break,
            }
        } else if !values.is_empty() {
            break;
        }
    }
    values
}
