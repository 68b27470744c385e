//! Time steps of the fifth analysis as the program makes them, beside their least work and beside plain full Newton, in one
//! run on one thread. Lost agreement fails it, time never does. Numbers of springs a ring as arguments pick machines.

use std::hint::black_box;
use std::time::Instant;
use std::{env, fs};

use whirl_benches::hand::product::{product, transposed};
use whirl_benches::measure::Times;
use whirl_benches::plain::PlainStep;
use whirl_cli::simulate::begin;
use whirl_solver::cache::Cache;
use whirl_solver::dynamics::{March, Newmark};

/// Steps that are timed together.
const SOME: usize = 100;
/// Steps after which a step is made by plain full Newton, too.
const COMPARED: usize = 400;

/// 4500 rpm at 2° a step (s): the machine's own pace in the last two thirds of the analysis.
const PACE: f64 = 74.07e-6;

fn main() {
    if !env::args().any(|argument| argument == "--bench") {
        return;
    }
    println!("hu2003-5 on one thread; medians; a machine at 4500 rpm takes 74.1 µs a step of 2°");
    println!();
    let picked: Vec<usize> = env::args().filter_map(|argument| argument.parse().ok()).collect();
    for springs in [24, 72].iter().filter(|own| picked.is_empty() || picked.contains(own)) {
        analysis(*springs);
        println!();
    }
}

fn analysis(springs: usize) {
    let folder = env::temp_dir().join(format!("whirl-marching-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("marching.toml");
    let text = format!("include = \"hu2003-5.toml\"\n[springs]\nnumber = {springs}\n");
    fs::write(&file, text).expect("a file");
    let mut warnings = Vec::new();
    let said = |failure: whirl_cli::errors::Failure| -> ! { panic!("{}", failure.report()) };
    let case = whirl_cli::read(file.to_str().expect("a path"), &mut warnings)
        .unwrap_or_else(|failure| said(failure));
    let built = whirl_cli::build(&case, Cache::of_platform().as_ref(), &mut warnings)
        .unwrap_or_else(|failure| said(failure));
    fs::remove_dir_all(&folder).expect("removed");
    let machine = built.machine();
    let (mut march, options) = begin(&case, &built).unwrap_or_else(|failure| said(failure));

    let mut plain = PlainStep::new(machine, Newmark::default(), options.time_step);
    let (mut steps, mut plains, mut plain_iterations) = (Vec::new(), Vec::new(), 0);
    while !march.is_done() {
        if march.progress().step % COMPARED == 0 && march.progress().step > 0 {
            let (mut state, released) = (march.state().clone(), march.released().to_vec());
            let start = Instant::now();
            let end = march.time() + options.time_step;
            plain_iterations += plain.advance(end, &mut state, &released);
            plains.push(start.elapsed().as_secs_f64());
            advance(&mut march);
            // A step in which a drive ends is cut there, which the plain one is not.
            if march.released() == released {
                agrees(&march.state().q, &state.q, march.time());
            }
            continue;
        }
        let start = Instant::now();
        let last = march.progress().step;
        for _ in 0..SOME {
            if march.is_done()
                || march.progress().step % COMPARED == 0 && march.progress().step > last
            {
                break;
            }
            advance(&mut march);
        }
        let made = march.progress().step - last;
        steps.push(start.elapsed().as_secs_f64() / made as f64);
    }
    let (count, simulated) = (march.progress().step, march.time());
    let outcome = march.outcome();
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    let run_up = median(&steps[..steps.len() / 3]);
    let (step, plain) = (median(&steps), median(&plains));

    let support = machine.places().last().expect("the support").flexible.len();
    let least = least_work(machine.springs.count(), support, machine.size());
    let [forward, backward, double, single] = least;
    println!("{springs} springs a ring, {} coordinates, {count} steps", machine.size());
    println!(
        "  a step                            {:8.1} µs, {:.2} × the machine's pace",
        1e6 * step,
        PACE / step
    );
    println!("  a step of the run-up              {:8.1} µs", 1e6 * run_up);
    println!("  simulated ÷ wall time             {:8.2}", simulated / (mean * count as f64));
    println!(
        "  iterations a step                 {:8.2}",
        outcome.iterations as f64 / count as f64
    );
    println!(
        "  factorisations in 1000 steps      {:8.2}",
        1e3 * outcome.factorisations as f64 / count as f64
    );
    for (what, time) in
        ["T_b times a vector", "T_bᵀ times a vector", "n × n, double", "n × n, single"]
            .iter()
            .zip(least)
    {
        println!("  {what:<34}{:8.1} µs", 1e6 * time);
    }
    println!(
        "  a step ÷ the sum of three         {:8.2} with the product in double precision, {:.2} in single",
        step / (forward + backward + double),
        step / (forward + backward + single)
    );
    println!(
        "  plain full Newton with nalgebra   {:8.1} µs a step, {:.2} iterations; that ÷ ours {:.0}",
        1e6 * plain,
        plain_iterations as f64 / plains.len() as f64,
        plain / step
    );
}

fn advance(march: &mut March<'_>) {
    march.advance().unwrap_or_else(|error| panic!("{error}"));
}

/// Both have solved the same equations from the same state.
fn agrees(own: &[f64], plain: &[f64], time: f64) {
    let largest = plain[1..].iter().fold(0.0, |most: f64, q| most.max(q.abs()));
    for (place, (own, plain)) in own.iter().zip(plain).enumerate() {
        let (difference, scale) = ((own - plain).abs(), if place == 0 { 1.0 } else { largest });
        assert!(difference <= 1e-6 * scale, "coordinate {place} at {time} s: {own} and {plain}");
    }
}

/// Products that a step with kept factors cannot do without, the last of them in double and in single precision (s).
fn least_work(rows: usize, columns: usize, size: usize) -> [f64; 4] {
    let values = |n: usize| -> Vec<f64> { (0..n).map(|i| (1.3 * i as f64).sin()).collect() };
    let (t_b, x, f) = (values(rows * columns), values(columns), values(rows));
    let (mut u, mut back) = (vec![0.0; rows], vec![0.0; columns]);
    let (double, r) = (values(size * size), values(size));
    let [single, r_single] =
        [&double, &r].map(|own| own.iter().map(|own| *own as f32).collect::<Vec<f32>>());
    let (mut moved, mut moved_single) = (vec![0.0; size], vec![0.0_f32; size]);
    let mut forward = || product(black_box(&t_b), black_box(&x), black_box(&mut u));
    let mut backward = || transposed(black_box(&t_b), black_box(&f), black_box(&mut back));
    let mut solve = || product(black_box(&double), black_box(&r), black_box(&mut moved));
    let mut half =
        || product(black_box(&single), black_box(&r_single), black_box(&mut moved_single));
    let times = Times::measure(&mut [&mut forward, &mut backward, &mut solve, &mut half]);
    [0, 1, 2, 3].map(|task| times.median(task))
}

fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}
