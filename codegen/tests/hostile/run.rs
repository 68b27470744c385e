//! One input after another: what it does, how long it takes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use crate::corpus::Corpus;
use crate::random::Random;
use crate::{injection, mutate, target};

/// An input with its number, from which it can be made again.
pub(crate) struct Input {
    pub(crate) is_formula: bool,
    pub(crate) text: String,
}

/// What became of an input.
pub(crate) struct Outcome {
    pub(crate) accepted: bool,
    pub(crate) panic: Option<String>,
    pub(crate) time: Duration,
}

/// What this thread has worked, so that other work on the machine does not count, where the system tells.
struct Clock {
    worked: Option<Duration>,
    wall: Instant,
}

impl Clock {
    fn start() -> Self {
        Clock { worked: worked(), wall: Instant::now() }
    }

    fn spent(&self) -> Duration {
        match (self.worked, worked()) {
            (Some(before), Some(now)) => now.saturating_sub(before),
            _ => self.wall.elapsed(),
        }
    }
}

fn worked() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

/// Two in three inputs are formulas.
pub(crate) fn input(corpus: &Corpus, seed: u64, number: u64) -> Input {
    let mut random = Random::new(seed, number);
    let is_formula = random.below(3) > 0;
    let texts = if is_formula { &corpus.formulas } else { &corpus.specs };
    Input { is_formula, text: mutate::mutant(texts, &mut random) }
}

/// Does everything with an input; the generated text must hold no token of the input's own.
pub(crate) fn run(input: &Input, vocabulary: &injection::Vocabulary) -> Outcome {
    let start = Clock::start();
    let done = catch_unwind(AssertUnwindSafe(|| {
        if input.is_formula {
            return (target::formula(&input.text), None);
        }
        let files = target::spec(&input.text);
        (files.is_some(), files)
    }));
    let time = start.spent();
    let done = done.and_then(|(accepted, files)| {
        catch_unwind(AssertUnwindSafe(|| {
            if let Some(files) = files {
                injection::check(&files, &input.text, vocabulary);
            }
            accepted
        }))
    });
    match done {
        Ok(accepted) => Outcome { accepted, panic: None, time },
        Err(payload) => {
            let text = payload.downcast_ref::<String>().cloned();
            let text =
                text.or_else(|| payload.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            Outcome { accepted: false, panic: Some(text.unwrap_or_default()), time }
        }
    }
}
