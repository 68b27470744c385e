//! Generated kernels against what the core can do at most, against kernels written by hand and against plain matrix
//! code: one table of ratios from one run.

use std::cell::RefCell;
use std::hint::black_box;

use whirl_benches::hand::elements::quadratic;
use whirl_benches::measure::{Times, peak_operations, peak_task};
use whirl_benches::{hand, textbook};
use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::tape::Tape;
use whirl_specs::{Batch, ELEMENTS, Element, FormKernel, LAWS, Law, Registers};

/// Cells of a batch: their matrices do not fit into the first cache, as in an assembly.
const CELLS: usize = 64;
/// Springs of the reference system.
const SPRINGS: usize = 288;

fn main() {
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let registers = Registers::current();
    println!("registers: {}; fastest of many runs, taken in turns", registers.name());
    println!("in brackets: the middle half of the ratios of single rounds");
    println!();
    let kernels = [
        ("hex8", "stiffness"),
        ("hex8i", "stiffness"),
        ("hex8", "mass"),
        ("wedge6", "stiffness"),
        ("wedge6", "mass"),
        ("tet10", "stiffness"),
        ("wedge15", "stiffness"),
        ("hex20", "stiffness"),
        ("tet10", "mass"),
        ("wedge15", "mass"),
        ("hex20", "mass"),
    ];
    for (name, form) in kernels {
        cells(registers, name, form);
    }
    println!();
    for reference in [&hand::law::LINEAR, &hand::law::NONLINEAR] {
        law(reference);
    }
}

/// Numbers in (−1, 1), the same in every run.
fn values(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(|i| (1.3 * i as f64 + 0.7).sin())
}

/// Where kernels write: the same memory for all that are compared, since its place counts.
struct Buffers {
    matrices: Vec<Batch>,
    jacobians: Vec<f64>,
}

fn material(kernel: &FormKernel) -> Vec<f64> {
    let value = |name| match name {
        "E" => 200e9,
        "nu" => 0.3,
        _ => 7860.0,
    };
    kernel.material.iter().map(|property| value(property.name)).collect()
}

/// A task and what it is called.
type Named<'a> = (&'static str, Box<dyn FnMut() + 'a>);

/// The stiffness of all cells with plain matrices, in operators and added as it is made.
fn plain<'a>(element: &'static Element, cells: &'a [f64]) -> Vec<Named<'a>> {
    match element.origin.name {
        "hex8" => plain_of::<8, 24>(element, cells, textbook::gauss_8()),
        "tet10" => plain_of::<10, 30>(element, cells, quadratic::tet_4::points()),
        "wedge15" => plain_of::<15, 45>(element, cells, quadratic::wedge_18::points()),
        "hex20" => plain_of::<20, 60>(element, cells, quadratic::hex_27::points()),
        _ => Vec::new(),
    }
}

fn plain_of<'a, const NODES: usize, const ROWS: usize>(
    element: &'static Element,
    cells: &'a [f64],
    points: Vec<textbook::Point>,
) -> Vec<Named<'a>> {
    let plainly = move |stiffness: fn(&Element, &[textbook::Point], &[f64], (f64, f64)) -> _| {
        let points = points.clone();
        Box::new(move || {
            for x in cells.chunks_exact(3 * NODES) {
                let k: textbook::Stiffness<ROWS> =
                    stiffness(element, &points, black_box(x), (200e9, 0.3));
                black_box(k);
            }
        })
    };
    vec![
        ("nalgebra, K += Bᵀ(DB)", plainly(textbook::stiffness::<NODES, ROWS>)),
        ("nalgebra, K.gemm(Bᵀ, DB)", plainly(textbook::accumulated_stiffness::<NODES, ROWS>)),
    ]
}

fn cells(registers: Registers, name: &str, form: &str) {
    let named = |element: &&'static Element| element.origin.name == name;
    let element = ELEMENTS.iter().find(named).expect("an element that is shipped");
    let references = hand::elements::ELEMENTS.into_iter().chain(quadratic::ELEMENTS);
    let reference = references.into_iter().find(named).expect("a reference");
    let [ours, by_hand] =
        [element, reference].map(|element| element.form(form).expect("a form that is shipped"));
    let nodes = (0..CELLS).flat_map(|_| element.reference_nodes.iter().flatten());
    let cells: Vec<f64> = nodes
        .zip(values(CELLS * element.nodes * 3))
        .map(|(x, bump)| 5e-3 * (x + 0.1 * bump))
        .collect();
    let buffers = RefCell::new(Buffers {
        matrices: Batch::storage(CELLS, ours.structure.len(element.nodes)),
        jacobians: vec![0.0; CELLS],
    });
    let material = material(ours);
    let run = |kernel: &FormKernel| {
        let Buffers { matrices, jacobians } = &mut *buffers.borrow_mut();
        (kernel.evaluate)(black_box(&cells), &material, matrices, jacobians);
    };
    // The same kernel on narrower registers, then plain matrices.
    let mut others: Vec<Named> = Vec::new();
    for narrower in Registers::all().into_iter().filter(|other| *other < registers) {
        others.push((narrower.name(), Box::new(move || narrower.within(|| run(ours)))));
    }
    if form == "stiffness" {
        others.extend(plain(element, &cells));
    }
    let (mut most, mut generated, mut reference) =
        (|| peak_task(registers), || run(ours), || run(by_hand));
    let mut tasks: Vec<&mut dyn FnMut()> = vec![&mut most, &mut generated, &mut reference];
    tasks.extend(others.iter_mut().map(|(_, task)| &mut **task as &mut dyn FnMut()));
    let times = Times::measure(&mut tasks);
    let peak = peak_operations(registers) / times.fastest(0);
    let a_cell = |task: usize| times.fastest(task) / CELLS as f64;
    let line = |what: &str, task: usize, ratio: &str| {
        println!("  {what:<25}{:8.1} ns a cell{ratio}", 1e9 * a_cell(task));
    };
    println!("{name} {form}, {CELLS} cells");
    line("generated", 1, "");
    line("by hand", 2, &beside(&times, 1, 2));
    for (task, (what, _)) in (3..).zip(&others) {
        line(what, task, &format!("; that / generated {:.1}", times.ratio(task, 1)));
    }
    let share = |flops: usize, task: usize| 100.0 * flops as f64 / a_cell(task) / peak;
    println!(
        "  of the peak of {:.1} Gflop/s: generated {:.0} % by its own count of {} operations a cell, \
         {:.0} % by the {} of the hand-written kernel, by hand {:.0} %",
        1e-9 * peak,
        share(ours.flops, 1),
        ours.flops,
        share(by_hand.flops, 1),
        by_hand.flops,
        share(by_hand.flops, 2),
    );
}

/// How a task compares with its reference.
fn beside(times: &Times, task: usize, reference: usize) -> String {
    let [low, _, high] = times.ratios(task, reference);
    let ratio = times.ratio(task, reference);
    format!("; generated / by hand {ratio:.2} [{low:.2} to {high:.2}]")
}

fn law(reference: &'static Law) {
    let name = reference.origin.name;
    let ours = LAWS.iter().find(|law| law.origin.name == name).expect("a law that is shipped");
    let spec = LawSpec::read(&Source::new(ours.origin.spec, ours.origin.text))
        .unwrap_or_else(|errors| panic!("{errors}"));
    let tape = Tape::new(&spec.program().expect("a program"));
    // Clearances of a loaded bearing: some springs act, some do not.
    let h: Vec<f64> = values(SPRINGS).map(|x| 3.5e-5 + 1e-5 * x).collect();
    let inputs: Vec<f64> = ours.inputs.iter().flat_map(|_| h.iter().copied()).collect();
    let rows = ours.outputs.len() * (1 + ours.inputs.len());
    let outputs = RefCell::new(vec![0.0; rows * SPRINGS]);
    let mut workspace = vec![0.0; tape.workspace()];
    let run = |law: &Law, inputs: &[f64]| {
        (law.evaluate)(SPRINGS, black_box(inputs), black_box(&mut outputs.borrow_mut()));
    };
    let mut by_tape = || {
        let outputs = &mut outputs.borrow_mut();
        tape.evaluate(SPRINGS, black_box(&inputs), black_box(outputs), &mut workspace);
    };
    let (mut generated, mut by_hand) = (|| run(ours, &inputs), || run(reference, &inputs));
    let times = Times::measure(&mut [&mut generated, &mut by_hand, &mut by_tape]);
    let a_spring = |task: usize| 1e9 * times.fastest(task) / SPRINGS as f64;
    let [generated, by_hand, taped] = [0, 1, 2].map(a_spring);
    println!("law {name}, {SPRINGS} springs, Q and its derivatives");
    println!("  generated {generated:6.2} ns a spring");
    println!("  by hand   {by_hand:6.2} ns a spring{}", beside(&times, 0, 1));
    println!("  tape      {taped:6.2} ns a spring; that / generated {:.1}", taped / generated);
}
