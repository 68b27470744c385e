"""Rational functions with common stable poles through matrices over the frequency.

D(s) = K₀ + C₀ s + Σ_j R_j s/(s + p_j): poles are moved as in vector fitting (B. Gustavsen, A. Semlyen, IEEE Trans. Power
Delivery 14 (1999) 1052-1061; relaxed: B. Gustavsen, IEEE Trans. Power Delivery 21 (2006) 1587-1592), one entry after the other
condensed (D. Deschrijver et al., IEEE Microwave Wireless Comp. Lett. 18 (2008) 383-385). What comes of it is led to the least
squares by Gauss-Newton steps in the logarithms of the poles, K₀, C₀ and R_j being eliminated (G. Golub, V. Pereyra, SIAM J.
Numer. Anal. 10 (1973) 413-432).
"""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

__all__ = ["Rational", "Samples", "believable", "fitted", "grows"]

# Most movements of poles by vector fitting, steps of least squares, and changes of weights; these for an
# error up to so many times the one that is wanted.
MOVES, STEPS, EVENED = 30, 60, 15
FAR = 20.0
# Poles are kept within these shares of the ends of the band, which does not tell them from springs
# and dampers beyond; faster ones would ask for shorter steps for nothing.
SLOWEST, FASTEST = 0.01, 10.0
# Real poles are kept apart by this factor: nearer ones have residues that cancel each other.
APART = 1.1
# Residues this much larger than the values cancel each other.
CANCEL = 1e4
# An entry below this share of the largest one of its row is measured by that share of it, and a row
# by the other one of the largest row.
SMALL_ENTRY = 0.1
SMALL_ROW = 1e-3


@dataclass(frozen=True)
class Rational:
    """D(s) = K₀ + C₀ s + Σ_j R_j s/(s + p_j), with the conjugate of every term whose pole is complex.

    Attributes
    ----------
    static, damper : numpy.ndarray
        K₀ and C₀, shape ``(2, 2)``.
    poles : numpy.ndarray
        p_j, complex, Re p > 0, Im p ≥ 0, shape ``(terms,)``.
    residues : numpy.ndarray
        R_j, complex, real where p_j is, shape ``(terms, 2, 2)``.
    """

    static: np.ndarray
    damper: np.ndarray
    poles: np.ndarray
    residues: np.ndarray

    def __call__(self, s: np.ndarray) -> np.ndarray:
        """D at ``s`` (1/s), shape ``(..., 2, 2)``."""
        s = np.asarray(s, dtype=np.complex128)[..., None, None]
        value = self.static + self.damper * s
        for pole, residue in zip(self.poles, self.residues):
            value = value + residue * s / (s + pole)
            if pole.imag:
                value = value + residue.conj() * s / (s + pole.conj())
        return value

    def slope(self) -> np.ndarray:
        """dD/ds at s = 0: the damping of slow motion, shape ``(2, 2)``."""
        value = self.damper.copy()
        for pole, residue in zip(self.poles, self.residues):
            value += (2.0 if pole.imag else 1.0) * (residue / pole).real
        return value

    @property
    def count(self) -> int:
        """Poles, both of a pair."""
        return len(self.poles) + int((self.poles.imag != 0).sum())


class Samples:
    """D(iω) = K + iωC at the rows of a table, with how much each counts.

    A row at ω = 0 has K, and C as the slope of D; C counts by the error that it makes half way to the next row.

    Attributes
    ----------
    omega : numpy.ndarray
        Rising, rad/s; a little above zero in place of zero, shape ``(rows,)``.
    values : numpy.ndarray
        D, shape ``(rows, 2, 2)``.
    size : numpy.ndarray
        By what an error is measured, shape ``(rows, 2, 2)``.
    """

    def __init__(self, omega: np.ndarray, stiffness: np.ndarray, damping: np.ndarray):
        self.omega = omega.astype(np.float64)
        # What is left of it is of the square of this share.
        counted = self.omega.copy()
        if len(omega) > 1 and omega[0] == 0.0:
            self.omega[0], counted[0] = 1e-6 * omega[1], 0.5 * omega[1]
        own = self.omega[:, None, None]
        self.values = stiffness + 1j * own * damping
        self._share = (counted / np.where(self.omega > 0, self.omega, 1.0))[:, None, None]
        largest = np.abs(self._counted(self.values)).max(axis=(1, 2))
        largest = np.maximum(largest, SMALL_ROW * largest.max())[:, None, None]
        self.size = np.maximum(np.abs(self._counted(self.values)), SMALL_ENTRY * largest)
        self._weight = np.ones(len(self.omega))

    def _counted(self, values: np.ndarray) -> np.ndarray:
        return values.real + 1j * self._share * values.imag

    def errors(self, fit: Rational) -> np.ndarray:
        """The errors as shares, shape ``(rows, 2, 2)``."""
        return np.abs(self._counted(fit(1j * self.omega) - self.values)) / self.size

    def evened(self, fit: Rational) -> Samples:
        """These samples, with rows counting the more the further the fit is from them (C. L. Lawson)."""
        own = copy.copy(self)
        errors = self.errors(fit).max(axis=(1, 2))
        own._weight = self._weight * np.sqrt(np.maximum(errors / errors.max(), 1e-3))
        own._weight /= np.sqrt(np.mean(own._weight**2))
        return own

    @property
    def band(self) -> tuple[float, float]:
        """Lowest frequency above zero and highest one (rad/s)."""
        above = self.omega[1:] if self._share[0, 0, 0] > 1.0 else self.omega
        return float(above[0]), float(above[-1])

    def entries(self):
        """Values and weights of real and imaginary parts, entry after entry."""
        for row in range(2):
            for column in range(2):
                weight = self._weight / self.size[:, row, column]
                weights = np.concatenate([weight, weight * self._share[:, 0, 0]])
                yield self.values[:, row, column], weights


def _parts(values: np.ndarray) -> np.ndarray:
    """Real parts above imaginary ones."""
    return np.concatenate([values.real, values.imag])


def _fractions(s: np.ndarray, poles: np.ndarray) -> np.ndarray:
    """1/(s + p), of a pair the sum of both and i times the difference, shape ``(len(s), poles)``."""
    columns = []
    for pole in poles:
        own = 1.0 / (s + pole)
        if pole.imag:
            other = 1.0 / (s + pole.conj())
            columns += [own + other, 1j * (own - other)]
        else:
            columns.append(own)
    return np.stack(columns, axis=1) if columns else np.zeros((len(s), 0), dtype=np.complex128)


def _basis(s: np.ndarray, poles: np.ndarray, damper: bool) -> np.ndarray:
    """1, s and s/(s + p), whose factors are real."""
    first = np.stack([np.ones_like(s), s], axis=1)[:, : 2 if damper else 1]
    return np.concatenate([first, s[:, None] * _fractions(s, poles)], axis=1)


def _moved(samples: Samples, poles: np.ndarray, damper: bool, scale: float) -> np.ndarray:
    """Zeros of σ, with σ D and σ = d + Σ c_j/(s + p_j) of these poles: where the poles belong, growing ones included."""
    s = 1j * samples.omega / scale
    basis, fractions = _basis(s, poles, damper), _fractions(s, poles)
    sigma = np.concatenate([fractions, np.ones((len(s), 1))], axis=1)
    known = basis.shape[1]
    rows, total = [], 0.0
    for value, weight in samples.entries():
        whole = np.concatenate([basis, -value[:, None] * sigma], axis=1)
        weighted = weight[:, None] * np.concatenate([whole.real, whole.imag])
        rows.append(np.linalg.qr(weighted)[1][known:, known:])
        total += float(np.sum((weight * _parts(value)) ** 2))
    # Not all of σ is zero.
    rows.append(np.sqrt(total) / len(s) * sigma.real.sum(axis=0, keepdims=True))
    system = np.concatenate(rows)
    right = np.zeros(len(system))
    right[-1] = np.sqrt(total)
    *factors, d = np.linalg.lstsq(system, right, rcond=None)[0]
    matrix = np.zeros((len(factors), len(factors)))
    into = np.zeros(len(factors))
    place = 0
    for pole in poles:
        if pole.imag:
            block = [[-pole.real, -pole.imag], [pole.imag, -pole.real]]
            matrix[place : place + 2, place : place + 2] = block
            into[place] = 2.0
            place += 2
        else:
            matrix[place, place] = -pole.real
            into[place] = 1.0
            place += 1
    d = d if abs(d) > 1e-8 else 1e-8
    return -np.linalg.eigvals(matrix - np.outer(into, np.array(factors) / d))


def _kept(poles: np.ndarray, pairs: bool, limits: tuple[float, float]) -> np.ndarray:
    """Poles that decay, within limits; apart and real where pairs are not meant, else one of each pair."""
    flipped = np.abs(poles.real) + 1j * poles.imag
    real = np.abs(flipped.imag) <= 1e-9 * np.abs(flipped)
    if not pairs:
        # Both of a pair become real ones beside each other.
        spread = np.where(real, 1.0, np.where(flipped.imag > 0, 1.1, 1.0 / 1.1))
        return np.sort(np.clip(np.abs(flipped) * spread, *limits)).astype(np.complex128)
    one = flipped[(flipped.imag > 0) | real]
    real = np.abs(one.imag) <= 1e-9 * np.abs(one)
    size = np.clip(np.abs(one), *limits)
    return np.where(real, size + 0j, one * size / np.abs(one))


def _angles(poles: np.ndarray) -> np.ndarray:
    """Logarithms of real poles, and of both parts of complex ones."""
    return np.log(np.concatenate([poles.real, poles.imag[poles.imag > 0]]))


def _of_angles(angles: np.ndarray, like: np.ndarray) -> np.ndarray:
    own = np.exp(angles)
    poles = own[: len(like)].astype(np.complex128)
    poles[like.imag > 0] += 1j * own[len(like) :]
    return poles


def _apart(angles: np.ndarray, like: np.ndarray) -> np.ndarray:
    """Logarithms with those of real poles apart, the slower ones moved."""
    angles = angles.copy()
    real = np.flatnonzero(like.imag == 0)
    order = real[np.argsort(angles[real], kind="stable")][::-1]
    for above, below in zip(order, order[1:]):
        angles[below] = min(angles[below], angles[above] - np.log(APART))
    return angles


def _residuals(samples: Samples, poles: np.ndarray, damper: bool, scale: float) -> np.ndarray:
    """What the best factors of these poles leave of all entries, weighted."""
    basis = _basis(1j * samples.omega / scale, poles, damper)
    basis = np.concatenate([basis.real, basis.imag])
    left = []
    for value, weight in samples.entries():
        columns, wanted = weight[:, None] * basis, weight * _parts(value)
        across = np.linalg.qr(columns)[0]
        left.append(wanted - across @ (across.T @ wanted))
    return np.concatenate(left)


def _least(samples, poles, damper, limits, scale):
    """Poles of least squares near these, by damped Gauss-Newton steps."""
    angles = _apart(_angles(poles), poles)
    low, high = np.log(limits)

    def left(at):
        return _residuals(samples, _of_angles(at, poles), damper, scale)

    own = left(angles)
    damping = 1e-3
    for _ in range(STEPS):
        columns = []
        for place in range(len(angles)):
            moved = angles.copy()
            moved[place] += 1e-6
            columns.append((left(moved) - own) / 1e-6)
        slope = np.stack(columns, axis=1)
        normal, force = slope.T @ slope, -slope.T @ own
        while damping < 1e8:
            weight = np.diag(damping * np.maximum(np.diag(normal), 1e-300))
            step = np.linalg.lstsq(normal + weight, force, rcond=None)[0]
            tried = _apart(np.clip(angles + np.clip(step, -1.0, 1.0), low, high), poles)
            found = left(tried)
            if found @ found < own @ own:
                break
            damping *= 10.0
        else:
            break
        done = np.abs(tried - angles).max() < 1e-12
        gained = own @ own - found @ found <= 1e-6 * (own @ own)
        angles, own, damping = tried, found, max(0.1 * damping, 1e-12)
        if done or gained:
            break
    return _of_angles(angles, poles)


def _with_factors(samples: Samples, poles: np.ndarray, damper: bool, scale: float) -> Rational:
    basis = _basis(1j * samples.omega / scale, poles, damper)
    basis = np.concatenate([basis.real, basis.imag])
    factors = np.stack(
        [
            np.linalg.lstsq(weight[:, None] * basis, weight * _parts(value), rcond=None)[0]
            for value, weight in samples.entries()
        ],
        axis=1,
    ).reshape(-1, 2, 2)
    static, rest = factors[0], factors[1:]
    own = np.zeros((2, 2))
    if damper:
        own, rest = rest[0] / scale, rest[1:]
    residues = np.zeros((len(poles), 2, 2), dtype=np.complex128)
    place = 0
    for number, pole in enumerate(poles):
        residues[number] = rest[place]
        if pole.imag:
            residues[number] += 1j * rest[place + 1]
        place += 2 if pole.imag else 1
    order = np.lexsort((poles.imag, np.abs(poles)))
    return Rational(static, own, (scale * poles)[order], residues[order])


def _begun(count: int, pairs: bool, band: tuple[float, float]) -> np.ndarray:
    """Poles over the band: real ones, or pairs that are hardly damped."""
    low, high = band
    if not pairs:
        spaced = np.geomspace(low, high, count) if count > 1 else np.array([np.sqrt(low * high)])
        return spaced.astype(np.complex128)
    spaced = np.linspace(low, high, count // 2 + 2)[1:-1]
    poles = 0.05 * spaced + 1j * spaced
    return np.append(poles, np.sqrt(low * high)) if count % 2 else poles


def fitted(
    samples: Samples,
    count: int,
    *,
    pairs: bool = False,
    damper: bool = True,
    tolerance: float = 0.0,
) -> Rational:
    """The fit with so many poles, real ones or also conjugate pairs.

    It is of least squares. Where its largest error is beyond the tolerance, but not by far, rows are weighted so that it falls.

    Parameters
    ----------
    samples : Samples
    count : int
        Of poles, both of a pair.
    pairs : bool
        Whether poles may be complex.
    damper : bool
        Whether there is C₀; it is zero otherwise.
    tolerance : float
        Largest error that is wanted, as a share.
    """
    low, high = samples.band if len(samples.omega) > 1 else (1.0, 1.0)
    scale = high
    band = (low / scale, 1.0)
    limits = (SLOWEST * band[0], FASTEST)
    if count == 0:
        return _with_factors(samples, np.zeros(0, dtype=np.complex128), damper, scale)
    best, best_left = None, np.inf
    poles = _begun(count, pairs, band)
    for _ in range(MOVES):
        before = poles
        poles = _kept(_moved(samples, poles, damper, scale), pairs, limits)
        left = _residuals(samples, poles, damper, scale)
        if left @ left < best_left:
            best, best_left = poles, left @ left
        if len(poles) == len(before) and np.allclose(poles, before, rtol=1e-10, atol=0):
            break
    starts = [best] if pairs else [best, _begun(count, pairs, band)]
    ends = [_least(samples, own, damper, limits, scale) for own in starts]
    sizes = [np.linalg.norm(_residuals(samples, own, damper, scale)) for own in ends]
    poles = ends[int(np.argmin(sizes))]
    best_fit = fit = _with_factors(samples, poles, damper, scale)
    best_error = samples.errors(fit).max()
    for _ in range(EVENED):
        if not tolerance < best_error < FAR * tolerance:
            break
        samples = samples.evened(fit)
        poles = _least(samples, poles, damper, limits, scale)
        fit = _with_factors(samples, poles, damper, scale)
        if samples.errors(fit).max() < best_error:
            best_fit, best_error = fit, samples.errors(fit).max()
    return best_fit


def believable(samples: Samples, fit: Rational) -> bool:
    """Whether terms do not cancel each other, and no resonance falls between rows."""
    largest = np.abs(samples.values).max()
    if len(fit.poles) and np.abs(fit.residues).max() > CANCEL * largest:
        return False
    for pole in fit.poles[fit.poles.imag > 0]:
        # Its width at half the power is twice its real part.
        place = np.clip(np.searchsorted(samples.omega, pole.imag), 1, len(samples.omega) - 1)
        if 2.0 * pole.real < samples.omega[place] - samples.omega[place - 1]:
            return False
    return True


def grows(samples: Samples, count: int, tolerance: float) -> np.ndarray:
    """Poles of growing motions with which so many poles, not held stable, reach the tolerance; empty where there are none."""
    low, high = samples.band
    poles = _begun(count, False, (low / high, 1.0))
    for _ in range(MOVES):
        moved = _moved(samples, poles, True, high)
        real = np.abs(moved.imag) <= 1e-9 * np.abs(moved)
        poles = np.where(real, moved.real + 0j, moved)[(moved.imag > 0) | real]
    # Beyond the band rounding decides on the sign.
    size = np.abs(poles)
    growing = (poles.real < 0) & (size > SLOWEST * low / high) & (size < FASTEST)
    fit = _with_factors(samples, poles, True, high)
    reached = samples.errors(fit).max() <= tolerance
    return high * poles[growing] if reached and growing.any() else np.zeros(0)
