//! A lane type that records what is done, so that what leads to a result can be counted.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::Lane;
use crate::register::{Register, Zeros};

/// What was done: how many operations it counts for, and the values that it was done to.
type Done = (usize, [Traced; 3]);

thread_local! {
    static DONE: RefCell<Vec<Done>> = const { RefCell::new(Vec::new()) };
    /// What was written as results of a function.
    static WRITTEN: RefCell<Vec<Traced>> = const { RefCell::new(Vec::new()) };
}

/// In place of a number, where it comes from: place k of what was done as k + 1, zero where nothing was done. So it
/// stays what it is in memory that holds numbers, and what was cleared comes from nothing.
#[derive(Debug, Clone, Copy, Default)]
#[repr(transparent)]
pub(crate) struct Traced(f64);

fn done<const N: usize>(operations: usize, with: [Traced; N]) -> Traced {
    let mut three = [Traced::default(); 3];
    three[..N].copy_from_slice(&with);
    DONE.with_borrow_mut(|all| {
        all.push((operations, three));
        Traced(all.len() as f64)
    })
}

/// Operations without which something of what was written would not be: a compiler leaves out the others.
pub(crate) fn needed() -> usize {
    let (mut done, mut needed) = (DONE.take(), WRITTEN.take());
    let mut operations = 0;
    while let Some(Traced(place)) = needed.pop() {
        let Some(place) = (place as usize).checked_sub(1) else { continue };
        let (own, with) = std::mem::take(&mut done[place]);
        operations += own;
        needed.extend(with);
    }
    operations
}

macro_rules! operators {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait for Traced {
            type Output = Traced;
            fn $method(self, other: Traced) -> Traced {
                done(1, [self, other])
            }
        }
        impl $trait<f64> for Traced {
            type Output = Traced;
            fn $method(self, _: f64) -> Traced {
                done(1, [self])
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Traced {
    type Output = Traced;
    fn neg(self) -> Traced {
        done(0, [self])
    }
}

impl Lane for Traced {
    type Mask = Traced;

    fn splat(_: f64) -> Self {
        Traced::default()
    }
    fn sqrt(self) -> Self {
        done(1, [self])
    }
    fn abs(self) -> Self {
        done(0, [self])
    }
    fn each(self, _: fn(f64) -> f64) -> Self {
        done(1, [self])
    }
    fn powf(self, exponent: Self) -> Self {
        done(1, [self, exponent])
    }
    fn lt(self, other: Self) -> Self {
        done(0, [self, other])
    }
    fn le(self, other: Self) -> Self {
        done(0, [self, other])
    }
    fn and(a: Self, b: Self) -> Self {
        done(0, [a, b])
    }
    fn or(a: Self, b: Self) -> Self {
        done(0, [a, b])
    }
    fn not(a: Self) -> Self {
        done(0, [a])
    }
    fn select(mask: Self, a: Self, b: Self) -> Self {
        done(0, [mask, a, b])
    }
}

// SAFETY: a number.
unsafe impl Zeros for Traced {}

impl Register for Traced {
    const WIDTH: usize = 1;
    const MANY: bool = true;
    type Chunk = [f64; 1];
    type Single = f32;

    fn chunks(row: &[f64]) -> &[[f64; 1]] {
        f64::chunks(row)
    }
    fn chunks_mut(row: &mut [f64]) -> &mut [[f64; 1]] {
        f64::chunks_mut(row)
    }
    fn load([value]: &[f64; 1]) -> Self {
        Traced(*value)
    }
    fn store(self, chunk: &mut [f64; 1]) {
        WRITTEN.with_borrow_mut(|all| all.push(self));
        *chunk = [self.0];
    }
    fn gather(_: &[f64], values: &mut [Self]) {
        values.fill(Traced::default());
    }
    fn scatter(values: &[Self], rows: &mut [f64]) {
        let chunks = Self::chunks_mut(rows).iter_mut();
        chunks.zip(values).for_each(|(chunk, value)| value.store(chunk));
    }
}
