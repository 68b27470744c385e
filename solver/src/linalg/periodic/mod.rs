//! Eigenvalues of M z̈ + C ż + K z = 0 whose matrices vary with an angle: Hill's determinant.
//!
//! X(t) = X_0 + Σ_k (X_k e^{ikΩt} + its conjugate) and z = e^{λt} Σ_k z_k e^{ikΩt} give for every j
//! Σ_k [(λ + ikΩ)² M_{j−k} + (λ + ikΩ) C_{j−k} + K_{j−k}] z_k = 0. Of its solutions every motion comes once for each shift of k
//! by the step s of the harmonics; the one is kept whose centre Σ k |z_k|² / Σ |z_k|² is in (−s/2, s/2].

mod blocks;
mod eigen;
mod equations;
mod forced;
mod refined;

pub(crate) use equations::{Harmonic, Periodic, PeriodicPair};
