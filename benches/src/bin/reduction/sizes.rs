//! How time and memory of a reduction grow with the body: the reference support with finer and finer cells.

use std::fs;
use std::thread;

use super::{Body, support_of, timed};

/// Cells for one of the reference mesh, along every direction.
const FINER: [f64; 4] = [1.0, 1.5, 2.0, 2.5];

/// Prints a row a mesh. The exponents are those of the dofs between a row and the one before it.
pub(super) fn table() {
    println!("| Dofs | Modes | Seconds | Grows as | Memory at most (MiB) | Grows as |");
    println!("|---|---|---|---|---|---|");
    let mut before: Option<[f64; 3]> = None;
    for finer in FINER {
        let body: Body = support_of(finer);
        // What was taken before it is of the mesh and its matrices, or given back.
        forget_peak();
        let (seconds, found) = timed(|| body.reduce());
        let (dofs, memory) = (body.inner.len(), peak());
        let now = [dofs as f64, seconds, memory.unwrap_or(f64::NAN)];
        let exponent = |of: usize| match before {
            Some(before) => {
                format!("n^{:.2}", (now[of] / before[of]).ln() / (now[0] / before[0]).ln())
            }
            None => String::new(),
        };
        let shown = memory.map_or("unknown here".to_owned(), |memory| format!("{memory:.0}"));
        let of_memory = if memory.is_some() { exponent(2) } else { String::new() };
        println!(
            "| {dofs} | {} | {seconds:.2} | {} | {shown} | {of_memory} |",
            found.modes(),
            exponent(1)
        );
        before = Some(now);
    }
    let processors = thread::available_parallelism().map_or(1, usize::from);
    println!();
    println!("on {processors} processors; the mesh and its matrices are part of the memory");
}

/// Lets the system count the largest memory anew; where it does not, what it counts is that of the largest body so far.
fn forget_peak() {
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// The most memory since then (MiB), where the system says.
fn peak() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib / 1024.0)
}
