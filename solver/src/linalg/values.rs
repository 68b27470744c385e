//! Memory for the values of a factor. That of a large one is in large pages where the system has them: as many small ones take
//! as long to be brought into use as the values take to be computed.

use std::ops::{Deref, DerefMut};

use memmap2::MmapMut;

/// Values from which on large pages pay: some of 2 MiB.
const MANY: usize = 1 << 20;

/// Values, zero at first.
#[derive(Debug)]
pub(super) enum Values {
    Few(Vec<f64>),
    Many(MmapMut),
}

impl Values {
    pub(super) fn zeros(count: usize) -> Values {
        let few = || Values::Few(vec![0.0; count]);
        if count < MANY {
            return few();
        }
        let Ok(pages) = MmapMut::map_anon(count * size_of::<f64>()) else { return few() };
        // Advice that is not taken changes nothing but the time.
        #[cfg(target_os = "linux")]
        let _ = pages.advise(memmap2::Advice::HugePage);
        Values::Many(pages)
    }
}

impl Deref for Values {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        match self {
            Values::Few(values) => values,
            Values::Many(pages) => bytemuck::cast_slice(pages),
        }
    }
}

impl DerefMut for Values {
    fn deref_mut(&mut self) -> &mut [f64] {
        match self {
            Values::Few(values) => values,
            Values::Many(pages) => bytemuck::cast_slice_mut(pages),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_zero_and_keep_what_is_written() {
        for count in [0, 1, MANY - 1, MANY, MANY + 1] {
            let mut values = Values::zeros(count);
            assert_eq!(values.len(), count);
            assert!(values.iter().all(|value| *value == 0.0));
            values.iter_mut().enumerate().for_each(|(i, value)| *value = i as f64);
            assert!(values.iter().enumerate().all(|(i, value)| *value == i as f64));
        }
    }
}
