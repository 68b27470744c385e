//! Films: values against direct evaluation of the file's formulas, slopes against the same over dual numbers.

use std::fs;
use std::path::Path;

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::film::{CellValues, Derived, FieldKind, FilmSpec};
use whirl_codegen::operation::Dual;
use whirl_codegen::schedule::Program;

use crate::flip::{flips, run};
use crate::random::Random;

const POINTS: usize = 12;
/// Directions in which cells and nodes are moved: both unknowns and the gap at one node, and the speed.
const OWN: usize = 3;

fn specs() -> Vec<FilmSpec> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/films");
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).expect("films") {
        let path = entry.expect("a file").path();
        let text = fs::read_to_string(&path).expect("a text");
        all.push(
            FilmSpec::read(&Source::new(&path, text)).unwrap_or_else(|errors| panic!("{errors}")),
        );
    }
    assert!(all.len() >= 2);
    all
}

fn points(spec: &FilmSpec) -> Vec<CellValues<f64>> {
    let mut random = Random::new(3, 11);
    let mut uniform = |low: f64, high: f64| {
        low + (high - low) * (random.next() >> 11) as f64 / (1_u64 << 53) as f64
    };
    let count = spec.nodes[0] * spec.nodes[1];
    let numbers = spec.uniform();
    let one = |place: usize| CellValues {
        nodes: [(1e5, 4e7), (0.05, 0.8), (2e-6, 4e-5)]
            .map(|(low, high)| (0..count).map(|_| uniform(low, high)).collect()),
        uniform: numbers
            .iter()
            .map(|(name, _)| match *name {
                "dx" => 1.7e-3,
                "dz" => 4e-3,
                "u" => [3.7, -2.9][place % 2],
                // Far from zero and from one, so that every sign counts.
                "alpha" => uniform(1e-8, 4e-8),
                "sigma" => uniform(4e-6, 1e-5),
                "mu_0" => uniform(5e-3, 0.05),
                _ => uniform(0.3, 0.7),
            })
            .collect(),
    };
    (0..POINTS).map(one).collect()
}

fn dual(cell: &CellValues<f64>, direction: usize) -> CellValues<Dual> {
    let count = cell.nodes[0].len();
    let mut place = 0;
    let mut take = |value: &f64| {
        place += 1;
        Dual { value: *value, slope: f64::from(u8::from(place - 1 == direction)) }
    };
    let nodes = cell.nodes.each_ref().map(|row| row.iter().map(&mut take).collect());
    let uniform = cell.uniform.iter().enumerate().map(|(i, value)| {
        let slope = f64::from(u8::from(i == 2 && direction == OWN * count));
        Dual { value: *value, slope }
    });
    CellValues { nodes, uniform: uniform.collect() }
}

fn close(found: f64, expected: f64, scale: f64) -> bool {
    (found - expected).abs() <= 1e-9 * scale.max(expected.abs())
}

/// What a kernel of cells should give at a point, and what it does.
struct Cells<'s> {
    spec: &'s FilmSpec,
    derived: Derived,
    program: Program,
    direct: fn(&FilmSpec, &CellValues<Dual>) -> Vec<Dual>,
}

impl Cells<'_> {
    /// The program's inputs at a point.
    fn inputs(&self, cell: &CellValues<f64>) -> Vec<f64> {
        let count = cell.nodes[0].len();
        let mut inputs = cell.uniform.clone();
        let fields =
            |a: usize| self.spec.at_node([0, 1, 2].map(|row| cell.nodes[row][a]), &cell.uniform);
        for (kind, ..) in &self.derived.fields {
            let row = match kind {
                FieldKind::Unknown(row) => *row,
                FieldKind::Gap => 2,
                FieldKind::Nodal(row) => OWN + row,
            };
            inputs.extend((0..count).map(|a| fields(a)[row]));
        }
        inputs
    }

    /// By direct evaluation: of every direction values with slopes.
    fn expected(&self, cell: &CellValues<f64>) -> Vec<Vec<Dual>> {
        let directions = OWN * cell.nodes[0].len() + 1;
        (0..directions).map(|direction| (self.direct)(self.spec, &dual(cell, direction))).collect()
    }

    /// Of every direction the slopes of all fields at its node.
    fn slopes(&self, cell: &CellValues<f64>) -> Vec<Vec<f64>> {
        let count = cell.nodes[0].len();
        let along = |direction: usize| {
            let values = dual(cell, direction);
            let own = [0, 1, 2].map(|row| values.nodes[row][direction % count]);
            let fields = self.spec.at_node(own, &values.uniform);
            fields.iter().map(|field| field.slope).collect()
        };
        (0..OWN * count).map(along).collect()
    }

    /// Whether outputs of the program are the values, and their slopes those along every direction.
    fn agrees(&self, outputs: &[f64], expected: &[Vec<Dual>], at_nodes: &[Vec<f64>]) -> bool {
        let count = at_nodes.len() / OWN;
        let mut row = 0;
        for (place, own) in self.derived.values.iter().enumerate() {
            let scale = expected[0].iter().map(|value| value.value.abs()).fold(0.0, f64::max);
            if !close(outputs[row], expected[0][place].value, 1e-6 * scale) {
                return false;
            }
            let slopes = &outputs[row + 1..][..own.slopes.len()];
            row += 1 + own.slopes.len();
            let is_output = own.slopes.is_empty() && own.name.starts_with("output");
            for node in 0..count {
                for input in 0..OWN {
                    let direction = input * count + node;
                    let (mut sum, mut size) = (0.0, 0.0);
                    for (slope, value) in own.slopes.iter().zip(slopes) {
                        if slope.node != node {
                            continue;
                        }
                        let field = match self.derived.fields[slope.field].0 {
                            FieldKind::Unknown(row) => row,
                            FieldKind::Gap => 2,
                            FieldKind::Nodal(row) => OWN + row,
                        };
                        let term = value * at_nodes[direction][field];
                        sum += term;
                        size += term.abs();
                    }
                    let wanted = expected[direction][place].slope;
                    if !is_output && !close(sum, wanted, size) {
                        return false;
                    }
                }
            }
            if own.by_speed.is_some() {
                let wanted = expected[OWN * count][place].slope;
                if !close(outputs[row], wanted, 0.0) {
                    return false;
                }
                row += 1;
            }
        }
        true
    }
}

fn check(cells: &Cells<'_>) {
    let points: Vec<_> = points(cells.spec)
        .iter()
        .map(|cell| (cells.inputs(cell), cells.expected(cell), cells.slopes(cell)))
        .collect();
    for (inputs, expected, slopes) in &points {
        let outputs = run(&cells.program, inputs, None);
        assert!(cells.agrees(&outputs, expected, slopes), "{}", cells.spec.name);
    }
    let mut all = Vec::new();
    for output in 0..cells.program.outputs.len() {
        for flip in flips(&cells.program, output) {
            if !all.contains(&flip) {
                all.push(flip);
            }
        }
    }
    assert!(all.len() > 300, "{}: {} signs", cells.spec.name, all.len());
    for flip in all {
        // What is left where terms cancel but for rounding has no sign that matters.
        let same = points.iter().all(|(inputs, ..)| {
            let [with, without] = [Some(flip), None].map(|flip| run(&cells.program, inputs, flip));
            with.iter().zip(&without).all(|(a, b)| (a - b).abs() <= 1e-14 * b.abs())
        });
        if same {
            continue;
        }
        let seen = points.iter().any(|(inputs, expected, slopes)| {
            !cells.agrees(&run(&cells.program, inputs, Some(flip)), expected, slopes)
        });
        assert!(
            seen,
            "{}: {:?} of {:?}",
            cells.spec.name, flip, cells.program.instructions[flip.place]
        );
    }
}

#[test]
fn one_sign_in_the_residual_of_a_cell_is_seen() {
    for spec in &specs() {
        let (derived, program) =
            spec.residual_program().unwrap_or_else(|errors| panic!("{errors}"));
        check(&Cells { spec, derived, program, direct: FilmSpec::residual_of });
    }
}

#[test]
fn one_sign_in_forces_and_outputs_is_seen() {
    for spec in &specs() {
        let (derived, program) = spec.surface_program().unwrap_or_else(|errors| panic!("{errors}"));
        check(&Cells { spec, derived, program, direct: FilmSpec::surface_of });
    }
}

#[test]
fn one_sign_at_the_nodes_is_seen() {
    for spec in &specs() {
        let programs = [
            (
                spec.nodal_program().unwrap_or_else(|errors| panic!("{errors}")),
                OWN,
                spec.nodal.len(),
            ),
            (
                spec.stored_program().unwrap_or_else(|errors| panic!("{errors}")),
                OWN + spec.nodal.len(),
                1,
            ),
        ];
        for (program, first, count) in programs {
            let points: Vec<(Vec<f64>, Vec<Vec<Dual>>)> = points(spec)
                .iter()
                .map(|cell| {
                    let own = [0, 1, 2].map(|row| cell.nodes[row][0]);
                    let directions = (0..OWN).map(|direction| {
                        let own: [Dual; OWN] = std::array::from_fn(|i| Dual {
                            value: own[i],
                            slope: f64::from(u8::from(i == direction)),
                        });
                        let uniform: Vec<Dual> =
                            cell.uniform.iter().map(|value| Dual::constant(*value)).collect();
                        spec.at_node(own, &uniform)[first..first + count].to_vec()
                    });
                    let directions = directions.collect();
                    ([cell.uniform.clone(), own.to_vec()].concat(), directions)
                })
                .collect();
            let agrees = |outputs: &[f64], expected: &[Vec<Dual>]| {
                (0..count).all(|place| {
                    close(outputs[4 * place], expected[0][place].value, 0.0)
                        && (0..OWN).all(|by| {
                            close(outputs[4 * place + 1 + by], expected[by][place].slope, 0.0)
                        })
                })
            };
            for (inputs, expected) in &points {
                assert!(agrees(&run(&program, inputs, None), expected), "{}", spec.name);
            }
            for output in 0..program.outputs.len() {
                for flip in flips(&program, output) {
                    let same = points.iter().all(|(inputs, _)| {
                        let [with, without] =
                            [Some(flip), None].map(|flip| run(&program, inputs, flip));
                        with.iter().zip(&without).all(|(a, b)| (a - b).abs() <= 1e-14 * b.abs())
                    });
                    if same {
                        continue;
                    }
                    let seen = points.iter().any(|(inputs, expected)| {
                        !agrees(&run(&program, inputs, Some(flip)), expected)
                    });
                    assert!(
                        seen,
                        "{}: {:?} of {:?}",
                        spec.name, flip, program.instructions[flip.place]
                    );
                }
            }
        }
    }
}
