//! Times that can be compared: taken in turns, the fastest of many.

use std::hint::black_box;
use std::time::{Duration, Instant};

use whirl_specs::registers::{Register, Registers, Task};

/// How often each task is timed.
const ROUNDS: usize = 300;
/// One timing covers as many runs as fill this.
const ENOUGH: Duration = Duration::from_micros(40);

/// Seconds that one run of each task takes. The tasks take turns, so that what disturbs the machine disturbs
/// all of them, and the fastest of many timings counts.
pub fn fastest(tasks: &mut [&mut dyn FnMut()]) -> Vec<f64> {
    let runs: Vec<u32> = tasks.iter_mut().map(|task| runs(task)).collect();
    let mut best = vec![f64::INFINITY; tasks.len()];
    for _ in 0..ROUNDS {
        for ((task, runs), best) in tasks.iter_mut().zip(&runs).zip(&mut best) {
            let time = timed(task, *runs).as_secs_f64() / f64::from(*runs);
            *best = best.min(time);
        }
    }
    best
}

fn timed(task: &mut dyn FnMut(), runs: u32) -> Duration {
    let start = Instant::now();
    for _ in 0..runs {
        task();
    }
    start.elapsed()
}

fn runs(task: &mut dyn FnMut()) -> u32 {
    let mut runs = 1;
    while timed(task, runs) < ENOUGH {
        runs *= 2;
    }
    runs
}

/// Multiply-adds in a row that depend on each other: as many chains hide the latency.
const CHAINS: usize = 12;
/// Steps of every chain.
const STEPS: usize = 2000;

/// Multiplications and additions of one run of [`peak_task`] on these registers.
pub fn peak_operations(registers: Registers) -> f64 {
    (2 * CHAINS * STEPS * registers.width()) as f64
}

/// Nothing but multiply-adds in registers: what the core can do at most.
pub fn peak_task(registers: Registers) {
    black_box(registers.run(Peak));
}

struct Peak;

impl Task for Peak {
    type Output = f64;

    #[inline(always)]
    fn run<L: Register>(self) -> f64 {
        let (factor, term) = (L::splat(black_box(0.999)), L::splat(black_box(0.001)));
        let mut chains = [L::splat(1.0); CHAINS];
        for _ in 0..STEPS {
            for chain in &mut chains {
                *chain = chain.mul_add(factor, term);
            }
        }
        let mut sum = chains[0];
        for chain in &chains[1..] {
            sum = sum + *chain;
        }
        let mut first = [0.0];
        L::scatter(&[sum], &mut first);
        first[0]
    }
}
