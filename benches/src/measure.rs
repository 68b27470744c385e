//! Times that can be compared: taken in turns, many of each.

use std::hint::black_box;
use std::time::{Duration, Instant};

use whirl_specs::registers::{Register, Registers, Task};

/// How often each task is timed.
const ROUNDS: usize = 400;
/// One timing covers as many runs as fill this.
const ENOUGH: Duration = Duration::from_micros(40);

/// Seconds that one run of each task took: task after task, round after round.
pub struct Times(Vec<Vec<f64>>);

impl Times {
    /// The tasks take turns, the first one last in every other round, so that what disturbs the machine
    /// disturbs all of them.
    pub fn measure(tasks: &mut [&mut dyn FnMut()]) -> Self {
        let runs: Vec<u32> = tasks.iter_mut().map(|task| runs(task)).collect();
        let mut times = vec![Vec::with_capacity(ROUNDS); tasks.len()];
        for round in 0..ROUNDS {
            for turn in 0..tasks.len() {
                let place = if round % 2 == 0 { turn } else { tasks.len() - 1 - turn };
                let time = timed(tasks[place], runs[place]).as_secs_f64();
                times[place].push(time / f64::from(runs[place]));
            }
        }
        Times(times)
    }

    /// The fastest of all timings of a task: what it takes where nothing disturbs it.
    pub fn fastest(&self, task: usize) -> f64 {
        self.0[task].iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The median of all timings of a task.
    pub fn median(&self, task: usize) -> f64 {
        let mut sorted = self.0[task].clone();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    }

    /// The fastest timing of a task over that of another.
    pub fn ratio(&self, task: usize, other: usize) -> f64 {
        self.fastest(task) / self.fastest(other)
    }

    /// Lower quartile, median and upper quartile of the ratios of one round each: how far a single
    /// comparison on this machine can be trusted.
    pub fn ratios(&self, task: usize, other: usize) -> [f64; 3] {
        let pairs = self.0[task].iter().zip(&self.0[other]);
        let mut ratios: Vec<f64> = pairs.map(|(task, other)| task / other).collect();
        ratios.sort_by(f64::total_cmp);
        [1, 2, 3].map(|quarter| ratios[quarter * (ratios.len() - 1) / 4])
    }
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
