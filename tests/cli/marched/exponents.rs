//! The exponents of which a history is a sum, by the matrix pencil: nothing of it knows of machines.

use nalgebra::{Complex, DMatrix, DVector};
use whirl_tests::History;

/// How a history is looked at.
pub(super) struct Window<'a> {
    pub(super) columns: &'a [&'a str],
    /// From when on (s).
    pub(super) from: f64,
    /// Between samples (s).
    pub(super) every: f64,
    /// How many exponents there are.
    pub(super) count: usize,
}

/// Samples, a row an instant, and their first instant (s).
fn sampled(history: &History, window: &Window) -> (DMatrix<f64>, f64) {
    let times = history.column("t_s");
    let step = times[1] - times[0];
    let stride = (window.every / step).round() as usize;
    let first = (window.from / step).round() as usize - 1;
    let rows: Vec<usize> = (first..times.len()).step_by(stride).collect();
    let columns = window.columns.iter().map(|name| history.column(name));
    let columns: Vec<DVector<f64>> = columns
        .map(|column| DVector::from_iterator(rows.len(), rows.iter().map(|row| column[*row])))
        .collect();
    (DMatrix::from_columns(&columns), times[first])
}

/// λ of a sum of e^{λt} over all columns together.
pub(super) fn exponents(history: &History, window: &Window) -> Vec<Complex<f64>> {
    let (mut samples, _) = sampled(history, window);
    for mut column in samples.column_iter_mut() {
        let mean = column.mean();
        column.add_scalar_mut(-mean);
        let most = column.amax();
        column /= most;
    }
    let (rows, width) = samples.shape();
    let depth = rows / 3;
    let shown = rows - depth;
    let hankel = DMatrix::from_fn(depth * width, shown, |i, j| samples[(i / width + j, i % width)]);
    let [before, after] = [0, 1].map(|first| hankel.columns(first, shown - 1).into_owned());
    let svd = before.svd(true, true);
    let (u, v) = (svd.u.expect("left vectors"), svd.v_t.expect("right vectors"));
    let mut places: Vec<usize> = (0..svd.singular_values.len()).collect();
    places.sort_by(|a, b| svd.singular_values[*b].total_cmp(&svd.singular_values[*a]));
    places.truncate(window.count);
    let shift = u.select_columns(&places).transpose() * after * v.select_rows(&places).transpose();
    let scales = places.iter().map(|place| 1.0 / svd.singular_values[*place]);
    let scales = DMatrix::from_diagonal(&DVector::from_iterator(places.len(), scales));
    let values = (shift * scales).complex_eigenvalues();
    values.iter().map(|own| own.ln() / window.every).collect()
}

/// Complex amplitudes at t = 0 of e^{λt} in each column, with all exponents fitted together.
pub(super) fn amplitudes(
    history: &History,
    window: &Window,
    exponents: &[Complex<f64>],
    of: Complex<f64>,
) -> Vec<Complex<f64>> {
    let (samples, start) = sampled(history, window);
    let mut all = vec![Complex::new(0.0, 0.0), of, of.conj()];
    all.extend(exponents.iter().filter(|own| {
        (*own - of).norm() > 1e-3 * of.norm()
            && (*own - of.conj()).norm() > 1e-3 * of.norm()
            && own.norm() > 1e-6 * of.norm()
    }));
    let rows = samples.nrows();
    let basis =
        DMatrix::from_fn(rows, all.len(), |i, j| (all[j] * (i as f64 * window.every)).exp());
    let svd = basis.svd(true, true);
    samples
        .column_iter()
        .map(|column| {
            let right = column.map(|own| Complex::new(own, 0.0));
            let own = svd.solve(&right, 1e-12).expect("a solution");
            // A e^{iΩt} and its conjugate: w = 2A.
            own[1] * 2.0 * (-of * start).exp()
        })
        .collect()
}
