//! Generated kernels against hand-written kernels, in one run: read each group as a ratio.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use whirl_benches::hand;
use whirl_specs::{
    Batch, CLEARANCES, Contact, ContactState, ContactTangent, ELEMENTS, Element, LAWS, Law,
    MOTIONS, Motion, MotionState, Ring, TensorShape,
};

/// Springs of the reference system.
const SPRINGS: usize = 288;
/// Springs of one plane.
const PLANE: usize = 24;
/// Flexible coordinates of its shaft.
const N: usize = 75;
/// Cells of a batch.
const CELLS: usize = 64;

/// Numbers in (−1, 1), the same in every run.
fn values(count: usize) -> Vec<f64> {
    (0..count).map(|i| (1.3 * i as f64 + 0.7).sin()).collect()
}

fn laws(c: &mut Criterion) {
    for reference in [&hand::law::LINEAR, &hand::law::NONLINEAR] {
        let name = reference.origin.name;
        let ours = LAWS.iter().find(|law| law.origin.name == name).expect("a shipped law");
        let mut group = c.benchmark_group(format!("law {name}, {SPRINGS} springs"));
        group.throughput(Throughput::Elements(SPRINGS as u64));
        // Clearances of a loaded bearing: some springs act, some do not.
        let h: Vec<f64> = values(SPRINGS).iter().map(|x| 3.5e-5 + 1e-5 * x).collect();
        let run = |law: &'static Law| {
            let inputs: Vec<f64> = law.inputs.iter().flat_map(|_| h.iter().copied()).collect();
            let rows = law.outputs.len() * (1 + law.inputs.len());
            let mut outputs = vec![0.0; rows * SPRINGS];
            move |b: &mut criterion::Bencher| {
                b.iter(|| (law.evaluate)(SPRINGS, black_box(&inputs), black_box(&mut outputs)));
            }
        };
        group.bench_function("generated", run(ours));
        group.bench_function("by hand", run(reference));
    }
}

fn clearance(c: &mut Criterion) {
    let mut group = c.benchmark_group(format!("clearance, force and tangent, {PLANE} springs"));
    group.throughput(Throughput::Elements(PLANE as u64));
    let run = |kernels: &'static Contact| {
        let psi: Vec<f64> =
            (0..PLANE).map(|j| std::f64::consts::TAU * j as f64 / PLANE as f64).collect();
        let mut table = vec![0.0; kernels.table * PLANE];
        (kernels.prepare)(&psi, &mut table);
        let ring =
            Ring { position: [0.3, 1e-5, -4e-6], velocity: [471.0, 1e-3, 2e-3], c: 3.5687e-5 };
        let delta: Vec<f64> = values(PLANE).iter().map(|x| 1e-6 * x).collect();
        let (delta_dot, q) = (values(PLANE), values(PLANE));
        let mut h = vec![0.0; 2 * PLANE];
        let (mut on_ring, mut on_springs) = ([0.0; 3], vec![0.0; PLANE]);
        let mut tangent = ContactTangent::new(PLANE, 1);
        move |b: &mut criterion::Bencher| {
            b.iter(|| {
                let state = ContactState {
                    stride: PLANE,
                    table: &table,
                    ring: black_box(&ring),
                    radius: 0.0,
                    bore: &delta,
                    bore_dot: &delta_dot,
                };
                (kernels.evaluate)(PLANE, &state, &mut h);
                (kernels.force)(PLANE, &state, &q, &mut on_ring, &mut on_springs);
                (kernels.tangent)(PLANE, &state, &q, &h, 27027.0, &mut tangent);
                black_box((&h, &on_ring, &on_springs, &tangent));
            });
        }
    };
    group.bench_function("generated", run(&CLEARANCES[0].contacts[0]));
    group.bench_function("by hand", run(&hand::clearance::CLEARANCE.contacts[0]));
}

fn motion(c: &mut Criterion) {
    let ours = MOTIONS.iter().find(|motion| motion.origin.name == "consistent").expect("shipped");
    let pair: [(&str, &'static Motion); 2] =
        [("generated", ours), ("by hand", &hand::motion::MOTION)];
    let numbers = values(N * N);
    let symmetric: Vec<f64> =
        (0..N * N).map(|e| numbers[e] + numbers[(e % N) * N + e / N]).collect();
    let skew: Vec<f64> = (0..N * N).map(|e| numbers[e] - numbers[(e % N) * N + e / N]).collect();
    let (eta, eta_dot, eta_ddot) = (values(N), values(N), values(N));
    let state = MotionState {
        theta: 0.3,
        theta_dot: 471.0,
        theta_ddot: 10.0,
        eta: &eta,
        eta_dot: &eta_dot,
        eta_ddot: &eta_ddot,
    };
    let mut force = c.benchmark_group(format!("motion, Q_v - M q_ddot, n = {N}"));
    for (name, motion) in pair {
        let (tensors, mut workspace) = tensors(motion, &numbers, &symmetric, &skew);
        let mut out = vec![0.0; 1 + N];
        force.bench_function(name, |b| {
            b.iter(|| {
                (motion.inertia_force)(&tensors, black_box(&state), &mut workspace, &mut out)
            });
        });
    }
    force.finish();
    let mut tangent = c.benchmark_group(format!("motion, a2 M + PF - a1 P - B, n = {N}"));
    for (name, motion) in pair {
        let (tensors, mut workspace) = tensors(motion, &numbers, &symmetric, &skew);
        let mut out = vec![0.0; (1 + N) * (1 + N)];
        tangent.bench_function(name, |b| {
            b.iter(|| {
                let state = black_box(&state);
                (motion.tangent)(&tensors, state, 27027.0, 7.3e8, &mut workspace, &mut out);
            });
        });
    }
}

fn tensors<'t>(
    motion: &Motion,
    numbers: &'t [f64],
    symmetric: &'t [f64],
    skew: &'t [f64],
) -> (Vec<&'t [f64]>, Vec<f64>) {
    let one = |tensor: &whirl_specs::Tensor| match (tensor.shape, tensor.symmetry) {
        (TensorShape::Scalar, _) => &numbers[..1],
        (TensorShape::Vector, _) => &numbers[..N],
        (_, whirl_specs::Symmetry::Skew) => skew,
        _ => symmetric,
    };
    (motion.tensors.iter().map(one).collect(), vec![0.0; (motion.workspace)(N)])
}

fn elements(c: &mut Criterion) {
    for (name, form) in [("hex8", "stiffness"), ("hex8i", "stiffness"), ("hex8", "mass")] {
        let ours = ELEMENTS.iter().find(|element| element.origin.name == name).expect("shipped");
        let reference =
            hand::elements::ELEMENTS.iter().find(|e| e.origin.name == name).expect("a reference");
        let mut group = c.benchmark_group(format!("{name} {form}, {CELLS} cells"));
        group.throughput(Throughput::Elements(CELLS as u64));
        let cells = bricks(ours);
        for (who, element) in [("generated", ours), ("by hand", reference)] {
            let kernel = element.form(form).expect("a shipped form");
            let material: Vec<f64> = kernel
                .material
                .iter()
                .map(|property| match property.name {
                    "E" => 200e9,
                    "nu" => 0.3,
                    _ => 7860.0,
                })
                .collect();
            let mut matrices = Batch::storage(CELLS, kernel.structure.len(element.nodes));
            let mut jacobians = vec![0.0; CELLS];
            group.bench_function(BenchmarkId::from_parameter(who), |b| {
                b.iter(|| {
                    let cells = black_box(&cells);
                    (kernel.evaluate)(cells, &material, &mut matrices, &mut jacobians);
                });
            });
        }
    }
}

/// Distorted cells of centimetre size.
fn bricks(element: &Element) -> Vec<f64> {
    let bumps = values(CELLS * element.nodes * 3);
    let nodes = (0..CELLS).flat_map(|_| element.reference_nodes.iter().flatten());
    nodes.zip(bumps).map(|(x, bump)| 5e-3 * (x + 0.1 * bump)).collect()
}

criterion_group!(kernels, laws, clearance, motion, elements);
criterion_main!(kernels);
