//! Arrays of rows, one row a variable and one value a spring in each.

/// The first N rows of `len` values.
///
/// # Panics
/// If `data` is shorter.
#[inline(always)]
pub fn rows<const N: usize>(len: usize, data: &[f64]) -> [&[f64]; N] {
    let mut rest = data;
    std::array::from_fn(|_| {
        let (row, behind) = rest.split_at(len);
        rest = behind;
        row
    })
}

/// The first N rows of `len` values, to be written.
///
/// # Panics
/// If `data` is shorter.
#[inline(always)]
pub fn rows_mut<const N: usize>(len: usize, data: &mut [f64]) -> [&mut [f64]; N] {
    let mut rest = data;
    std::array::from_fn(|_| {
        let (row, behind) = std::mem::take(&mut rest).split_at_mut(len);
        rest = behind;
        row
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_each_other() {
        let mut data = [1.0, 2.0, 3.0, 4.0, 5.0];
        let [a, b] = rows(2, &data);
        assert_eq!((a, b), (&[1.0, 2.0][..], &[3.0, 4.0][..]));
        let [_, b] = rows_mut(2, &mut data);
        b[1] = 9.0;
        assert_eq!(data[3], 9.0);
    }
}
