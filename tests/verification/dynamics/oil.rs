//! Oil films in joints: their slopes in the tangent of a machine, moments on both sides, the oil that a march keeps, and marches
//! that are cut or begin at rest; in a block that is rigid and in one that gives way under its films.

use std::f64::consts::TAU;

use whirl_solver::bearing::{Bearing, BoreSurface, FilmLaw, Hold, Sides, SpringLaw};
use whirl_solver::body::BodyNode;
use whirl_solver::centre_of_mass::CentreOfMass;
use whirl_solver::dynamics::{BodyStart, Checkpoint, March, MarchOptions, equilibrium};
use whirl_solver::equations::{Equations, State, Weights};
use whirl_solver::film::{Grid, Journal, OilFilm};
use whirl_solver::history::History;
use whirl_solver::linalg::Matrix;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::measure::MeanMotion;
use whirl_solver::output::{Integral, Output, Wanted};
use whirl_solver::support::Support;
use whirl_specs::{CLEARANCES, FILMS};

use super::{DISCS, discs, force, options, parts, wild};

const RADIUS: f64 = 0.025;
const LENGTH: f64 = 0.025;
const CLEARANCE: f64 = 2.5e-5;
const OMEGA: f64 = 300.0;
const DT: f64 = 1e-4;
/// Of the block (kg, kg·m²).
const MASS: f64 = 8.0;
const TURNING: f64 = 0.01;

/// A film that is fed through a hole beside its load.
fn film(spec: &str) -> Box<dyn SpringLaw> {
    let kernel = FILMS.iter().find(|own| own.origin.name == spec).expect("a shipped film");
    let mut film = OilFilm::new(kernel, GRID, [RADIUS, LENGTH], 0.0).expect("a film");
    film.supply("hole", 1.2..1.8, -0.005..0.005, 2e5).expect("a hole");
    let journal = Journal::new(film, &CLEARANCES[0], CLEARANCE).expect("a journal");
    Box::new(FilmLaw { name: spec.to_owned(), hash: String::new(), journal })
}

/// Where both bores are (m).
const Z: [f64; 2] = [0.1, 0.3];
/// Nodes of a film.
const GRID: [usize; 2] = [48, 7];

/// How bores open along the normal at an angle and a part of half their length, where they give way: each in a coordinate of its
/// own, of so much stiffness (N/m) by a mass of [`MASS`].
const SHAPES: [(fn(f64, f64) -> f64, f64); 4] = [
    (|angle, _| (2.0 * angle).cos(), 3e8),
    (|angle, _| (2.0 * angle).sin(), 4e8),
    (|angle, along| (3.0 * angle).cos() * (1.0 + 0.5 * along), 5e8),
    (|angle, along| angle.sin() * along * along, 8e8),
];

/// Rings of nodes, then the nodes of both films, that move along x and y and turn about the axis as one block; if it gives way, the
/// nodes of the films in other shapes as well.
fn block(gives_way: bool) -> Support {
    let size = if gives_way { 3 + SHAPES.len() } else { 3 };
    let (a, b) = (MASS.sqrt().recip(), TURNING.sqrt().recip());
    let node = |angle: f64, z: f64, along: Option<f64>| {
        let (sin, cos) = angle.sin_cos();
        let [x, y] = [RADIUS * cos, RADIUS * sin];
        let shapes = Matrix::from_fn(3, size, |i, j| match (i, j) {
            (2, _) => 0.0,
            (i, j) if j < 3 => [[a, 0.0, -b * y], [0.0, a, b * x]][i][j],
            (i, j) => along.map_or(0.0, |own| a * [cos, sin][i] * SHAPES[j - 3].0(angle, own)),
        });
        BodyNode { position: [x, y, z], shapes }
    };
    let mut nodes = Vec::new();
    for z in Z {
        nodes.extend((0..8).map(|k| node(TAU * f64::from(k) / 8.0, z, None)));
    }
    for z in Z {
        for [angle, along] in grid().places() {
            nodes.push(node(angle, z + along, Some(2.0 * along / LENGTH)));
        }
    }
    let rigid =
        |rows: [[f64; 3]; 3]| Matrix::from_fn(3, size, |i, j| if j < 3 { rows[i][j] } else { 0.0 });
    let mean = |z: f64| MeanMotion {
        centre: [0.0, 0.0, z],
        displacement: rigid([[a, 0.0, 0.0], [0.0, a, 0.0], [0.0; 3]]),
        rotation: rigid([[0.0; 3], [0.0; 3], [0.0, 0.0, b]]),
    };
    let (mut stiffness, mut damping) =
        (vec![1e8 / MASS, 2e8 / MASS, 1e5 / TURNING], vec![50.0, 70.0, 30.0]);
    stiffness.extend(SHAPES.iter().take(size - 3).map(|(_, own)| own / MASS));
    damping.resize(size, 60.0);
    Support {
        hertz: Vec::new(),
        stiffness,
        damping,
        coordinates: (0..size).map(|k| format!("coordinate {k}")).collect(),
        nodes,
        measures: Z.map(mean).to_vec(),
        sections: Vec::new(),
        centre_of_mass: CentreOfMass::none(size),
    }
}

fn grid() -> Grid {
    let kernel = FILMS.iter().find(|own| own.origin.name == "jfo").expect("a shipped film");
    OilFilm::new(kernel, GRID, [RADIUS, LENGTH], 0.0).expect("a film").grid
}

/// The bore of a bearing whose film stands on nodes of its own.
fn surface(bearing: usize) -> BoreSurface {
    let first = 16 + bearing * GRID[0] * GRID[1];
    BoreSurface {
        stations: vec![Z[bearing]],
        middle: Z[bearing],
        points: vec![Vec::new()],
        mean: bearing,
        film: (0..GRID[0] * GRID[1]).map(|a| vec![(first + a, 1.0)]).collect(),
    }
}

/// Discs on a line in two films in a block, which may give way, pulled down, and unbalanced.
fn machine(spec: &str, rotation: Rotation, unbalance: f64, gives_way: bool) -> Machine {
    let mut parts = parts(discs(1e9), block(gives_way), rotation);
    let nodes = parts.bodies[0].nodes().to_vec();
    parts.laws = vec![film(spec), film(spec)];
    parts.bearings = (0..2)
        .map(|k| {
            let ring: Vec<usize> = (8 * k..8 * k + 8).collect();
            Bearing {
                others: Vec::new(),
                name: format!("bearing {}", k + 1),
                label: None,
                sides: Sides { surface: gives_way.then(|| surface(k)), ..Sides::default() },
                journal: [1 + 2 * k; 3],
                bore: if gives_way { Default::default() } else { [(); 3].map(|()| ring.clone()) },
                clearance: CLEARANCE,
                journal_radius: Some(RADIUS),
                stations: vec![0.5],
                angles: Vec::new(),
                law: k,
            }
        })
        .collect();
    let constant = TimeFunction::Constant;
    parts.loads = vec![force(&nodes[2], [-3000.0, 0.0, 0.0], constant.clone(), Frame::Space)];
    if unbalance > 0.0 {
        parts.loads.push(force(&nodes[1], [unbalance, 0.0, 0.0], constant, Frame::Body));
    }
    let openings = ["left", "right", "hole"].map(str::to_owned).to_vec();
    let loss = Integral { name: "loss".to_owned(), unit: "W", meaning: String::new() };
    let outputs = (0..2).map(|joint| Output {
        name: format!("f{joint}"),
        what: Wanted::Film { joint, openings: openings.clone(), integrals: vec![loss.clone()] },
    });
    let machine = Machine::new(parts).expect("a machine");
    machine.with_outputs(outputs.collect()).expect("outputs")
}

fn turning() -> Rotation {
    Rotation::Prescribed { speed: OMEGA, acceleration: 0.0 }
}

/// A march that begins in equilibrium.
fn begun(machine: &Machine, steps: usize) -> MarchOptions {
    let found = equilibrium(machine, &[None, None], Some(DT)).expect("an equilibrium");
    MarchOptions { initial: found.bodies, laws_at_rest: true, ..options(DT, steps) }
}

fn column(machine: &Machine, name: &str) -> usize {
    let names = History::for_machine(machine).names().to_vec();
    names.iter().position(|own| own == name).unwrap_or_else(|| panic!("{name} in {names:?}"))
}

#[test]
fn a_film_gives_the_tangent_of_a_machine_all_its_slopes() {
    for (spec, gives_way) in
        [("jfo", false), ("reynolds", false), ("jfo", true), ("reynolds", true)]
    {
        let machine = machine(spec, Rotation::Free, 300.0, gives_way);
        let start = BodyStart { speed: OMEGA, ..BodyStart::default() };
        let start = MarchOptions { initial: vec![start], ..options(DT, 40) };
        let mut march = March::new(&machine, &start).expect("begins");
        (0..40).for_each(|_| march.advance().expect("converges"));
        // A step that moves on from there.
        let mut state = march.state().clone();
        (state.laws.hold, state.laws.step) = (Hold::Implicit(0.5 * DT), DT);
        let mut random = wild(3);
        let shafts = 1 + 2 * DISCS;
        for i in 1..machine.size() {
            let scale = if i < shafts { 1.0 } else { MASS.sqrt() };
            let scale = if i == shafts + 2 { 0.0 } else { scale };
            state.q[i] += 2e-7 * scale * random();
            state.v[i] += 2e-3 * scale * random();
        }
        let (weights, size) = (Weights { rate: 2.0 / DT, acceleration: 0.0 }, machine.size());
        let mut equations = Equations::new(&machine);
        equations.evaluate(0.0, &state);
        let mut tangent = vec![0.0; size * size];
        equations.tangent(0.0, &state, weights, &mut tangent);
        let mut at = |by: f64, j: usize| {
            let mut moved: State = state.clone();
            moved.q[j] += by;
            moved.v[j] += weights.rate * by;
            equations.evaluate(0.0, &moved);
            equations.residual().to_vec()
        };
        for j in 0..size {
            // By so little that no front of a cavity moves.
            let by = if j == 0 { 1e-9 } else { 1e-12 };
            let (below, above) = (at(-by, j), at(by, j));
            let column = &tangent[j * size..][..size];
            let largest = column.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            for i in 0..size {
                let difference = (below[i] - above[i]) / (2.0 * by);
                let error = (column[i] - difference).abs();
                assert!(
                    error < 2e-5 * largest,
                    "{spec}: {i} by {j}: {} against {difference} of {largest}",
                    column[i]
                );
            }
        }
    }
}

/// Turned as a whole, a machine is as before: what films do to both of their sides has no moment.
#[test]
fn moments_of_a_film_on_both_sides_cancel() {
    for gives_way in [false, true] {
        moments_cancel(&machine("jfo", turning(), 300.0, gives_way));
    }
}

fn moments_cancel(machine: &Machine) {
    let mut march = March::new(machine, &begun(machine, 60)).expect("begins");
    (0..60).for_each(|_| march.advance().expect("converges"));
    let state = march.state();
    let mut equations = Equations::new(machine);
    equations.evaluate(march.time(), state);
    // By springs alone: from what the residual has more with them than without.
    let shaft = 1 + 2 * DISCS;
    let [x, y, turn] = [0, 1, 2].map(|k| shaft + k);
    let spring = equations.spring_forces();
    let (b_x, b_y) = (state.q[x], state.q[y]);
    // Coordinates of the block are √m times its motion, and √J times its turn.
    let on_shaft = spring[0];
    let on_block = TURNING.sqrt() * spring[turn] + b_x * spring[y] - b_y * spring[x];
    assert!(on_shaft.abs() > 0.3, "{on_shaft} N m");
    assert!((on_shaft + on_block).abs() < 1e-11 * on_shaft.abs(), "{on_shaft} {on_block}");
    // What results say of each film.
    let mut total = 0.0;
    for k in 0..2 {
        let row = |name: &str| march.row()[column(machine, name)];
        let [own, bore] = ["mz_f", "mz_bore_f"].map(|name| row(&format!("{name}{k}_Nm")));
        let node = 2 * (1 + 2 * k);
        let [u, v] = [state.q[1 + node], state.q[2 + node]];
        let turned = state.q[0];
        let u = [turned.cos() * u - turned.sin() * v, turned.sin() * u + turned.cos() * v];
        let e = [u[0] - b_x / MASS.sqrt(), u[1] - b_y / MASS.sqrt()];
        let force = [1, 2].map(|axis| {
            let name = ["RX", "RY"][axis - 1];
            row(&format!("{name}{}_N", k + 1))
        });
        let moment = e[0] * force[1] - e[1] * force[0];
        assert!(moment.abs() > 1e-3 * own.abs(), "{moment} beside {own}");
        assert!((own + bore + moment).abs() < 1e-9 * own.abs(), "{own} {bore} {moment}");
        total += own;
    }
    assert!(total < 0.0);
}

/// What is in a film grows by what enters, to the last digits: counted by the gap that the rule for time has.
#[test]
fn a_march_keeps_all_its_oil() {
    for gives_way in [false, true] {
        keeps_its_oil(&machine("jfo", turning(), 800.0, gives_way));
    }
}

fn keeps_its_oil(machine: &Machine) {
    let options = begun(machine, 300);
    let mut march = March::new(machine, &options).expect("begins");
    let mut entered = [0.0; 2];
    let mut largest: f64 = 0.0;
    march.advance().expect("converges");
    let first = march.stored_oil();
    for _ in 1..options.steps {
        march.advance().expect("converges");
        for (k, sum) in entered.iter_mut().enumerate() {
            for opening in ["left", "right", "hole"] {
                let flow = march.row()[column(machine, &format!("q_{opening}_f{k}_mL_s"))];
                *sum += 1e-6 * DT * flow;
                largest = largest.max(1e-6 * flow.abs());
            }
        }
    }
    let last = march.stored_oil();
    for k in 0..2 {
        let left = last[k] - first[k] - entered[k];
        let flowed = largest * DT * options.steps as f64;
        assert!(left.abs() < 1e-10 * flowed, "{left} of {flowed}: {} to {}", first[k], last[k]);
        assert!((last[k] - first[k]).abs() > 1e-6 * first[k], "nothing has changed");
    }
}

#[test]
fn a_march_from_equilibrium_stands_still_and_one_from_the_middle_comes_there() {
    for (spec, gives_way) in [("jfo", false), ("reynolds", false), ("jfo", true)] {
        let machine = machine(spec, turning(), 0.0, gives_way);
        let options = begun(&machine, 200);
        let start = options.initial.clone();
        let mut march = March::new(&machine, &options).expect("begins");
        (0..options.steps).for_each(|_| march.advance().expect("converges"));
        let at_end = |march: &March, k: usize| {
            ["EX", "EY"].map(|own| march.row()[column(&machine, &format!("{own}{}_um", k + 1))])
        };
        let here = at_end(&march, 0);
        let mut again =
            March::new(&machine, &MarchOptions { steps: 1, ..options.clone() }).unwrap();
        again.advance().expect("converges");
        let there = at_end(&again, 0);
        assert!(there[0].hypot(there[1]) > 0.2 * 25.0, "{there:?}");
        for (here, there) in here.into_iter().zip(there) {
            assert!((here - there).abs() < 1e-6 * 25.0, "{spec}: {here} from {there}");
        }
        assert!(start.len() == 2);
        let options = super::options(DT, if gives_way { 8000 } else { 3000 });
        let mut march = March::new(&machine, &options).expect("begins");
        while !march.is_done() {
            march.advance().expect("converges");
        }
        for (found, there) in at_end(&march, 0).into_iter().zip(there) {
            assert!((found - there).abs() < 1e-4 * 25.0, "{spec}: {found} to {there}");
        }
    }
}

#[test]
fn a_march_in_films_resumes_with_the_same_bits() {
    for gives_way in [false, true] {
        resumes_with_the_same_bits(&machine("jfo", turning(), 800.0, gives_way));
    }
}

fn resumes_with_the_same_bits(machine: &Machine) {
    let options = begun(machine, 400);
    let mut whole = March::new(machine, &options).expect("begins");
    let (mut rows, mut kept): (Vec<Vec<u64>>, Vec<Vec<u8>>) = (Vec::new(), Vec::new());
    let cuts = [1, 57, 201];
    while !whole.is_done() {
        whole.advance().expect("converges");
        rows.push(whole.row().iter().map(|value| value.to_bits()).collect());
        if cuts.contains(&rows.len()) {
            kept.push(postcard::to_allocvec(&whole.checkpoint()).expect("plain data"));
        }
    }
    let whole = whole.outcome();
    println!("{} iterations, {} factorisations", whole.iterations, whole.factorisations);
    for (bytes, cut) in kept.iter().zip(cuts) {
        let checkpoint: Checkpoint = postcard::from_bytes(bytes).expect("what was written");
        let mut resumed = March::resume(machine, &options, checkpoint).expect("resumes");
        for row in &rows[cut..] {
            resumed.advance().expect("converges");
            let own: Vec<u64> = resumed.row().iter().map(|value| value.to_bits()).collect();
            assert!(own == *row, "other bits after step {cut}");
        }
        assert_eq!(resumed.outcome(), whole);
    }
    // What the oil brakes is made into heat: nothing is stored for long.
    let energy = whole.energy;
    assert!(energy.error_fraction() < 1e-3, "{energy:?}");
    assert!(energy.spring_dissipated > 0.0 && energy.spring_stored == 0.0, "{energy:?}");
}

/// Another run goes on with the oil where it was, and with another step.
#[test]
fn a_march_goes_on_from_the_films_of_another() {
    let machine = machine("jfo", turning(), 800.0, true);
    let options = begun(&machine, 240);
    let mut whole = March::new(&machine, &options).expect("begins");
    (0..120).for_each(|_| whole.advance().expect("converges"));
    let last = whole.last_state();
    (0..120).for_each(|_| whole.advance().expect("converges"));
    let rest = MarchOptions { steps: 120, ..options.clone() };
    let mut same = March::from_last(&machine, &rest, &last).expect("goes on");
    (0..120).for_each(|_| same.advance().expect("converges"));
    let bits =
        |march: &March| -> Vec<u64> { march.row().iter().map(|own| own.to_bits()).collect() };
    assert!(bits(&same) == bits(&whole), "other bits");
    // In half the step: the same motion, nearly.
    let halved = MarchOptions { time_step: 0.5 * DT, steps: 240, ..options.clone() };
    let mut fine = March::from_last(&machine, &halved, &last).expect("goes on");
    (0..240).for_each(|_| fine.advance().expect("converges"));
    for axis in ["EX1_um", "EY1_um", "EX2_um", "EY2_um"] {
        let place = column(&machine, axis);
        let [fine, whole] = [&fine, &whole].map(|march| march.row()[place]);
        assert!((fine - whole).abs() < 0.02 * 25.0, "{axis}: {fine} beside {whole}");
    }
}
