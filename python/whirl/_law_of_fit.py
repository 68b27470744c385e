"""The text of a law with states from a rational function."""

from __future__ import annotations

import textwrap

import numpy as np

from . import _toml
from ._coefficients import ENTRIES
from ._rational import Rational, Samples

__all__ = ["law_text", "printed"]

DIRECTIONS = ("x", "y")
WHERE = {"x": "vertical", "y": "horizontal"}
# The share by which the speed of a journal may differ from the table before its run is not sound.
REACH = 0.05
# Of least squares over twelve digits.
ROUNDING = 1e-11


def printed(fit: Rational, samples: Samples) -> Rational:
    """The fit with the digits that its law has; what is nothing but rounding beside the samples is zero."""
    size = np.abs(samples.values).max()

    def own(values: np.ndarray, nothing: float) -> np.ndarray:
        digits = [0.0 if abs(one) <= nothing else float(f"{one:.12g}") for one in values.ravel()]
        return np.array(digits).reshape(values.shape)

    def both(values: np.ndarray, nothing: float) -> np.ndarray:
        return own(values.real, nothing) + 1j * own(values.imag, nothing)

    least = ROUNDING * size
    return Rational(
        own(fit.static, least),
        own(fit.damper, least / samples.omega[-1]),
        both(fit.poles, 0.0),
        both(fit.residues, least),
    )


def law_text(
    fit: Rational, *, name: str, title: str, source: str, about: list[str], speed: float | None
) -> str:
    """The text of a law file.

    Parameters
    ----------
    fit : Rational
        In SI.
    name, title, source : str
        Keys of the law.
    about : list of str
        Paragraphs and lines of a comment.
    speed : float or None
        For which it holds, in rad/s; of a speed that is not known or zero nothing is said.
    """
    writer = _Writer(fit)
    lines = ['kind = "law"']
    lines += [
        f"{key} = {_toml._text(own)}"
        for key, own in (("name", name), ("title", title), ("source", source))
    ]
    for paragraph in about:
        # Lines of a table begin with a blank.
        whole = paragraph.startswith(" ")
        lines += (
            [f"#{paragraph}"]
            if whole
            else textwrap.wrap(paragraph, 118, initial_indent="# ", subsequent_indent="# ")
        )
    stored = writer.stored()
    if stored:
        lines += [
            "# What its springs store; the work of all else counts as dissipated.",
            f"stored = '{stored}'",
        ]
    lines += writer.inputs(bool(speed))
    lines += writer.states()
    lines += ["", "[parameters]"]
    if speed:
        lines.append(_parameter("omega_t", abs(speed), "rad/s", "speed of the table"))
        lines.append(_parameter("reach", REACH, "1", "share of it by which the speed may differ"))
    lines += writer.parameters
    if writer.rates:
        lines += ["", "[definitions]", *writer.definitions, "", "[rates]", *writer.rates]
    if speed:
        lines += [
            "",
            "[valid.speed]",
            "value = 'abs(abs(omega) - omega_t)/omega_t'",
            'unit = "1"',
            "max = 'reach'",
            'title = "difference of the speed from that of the table"',
            'help = "coefficients are of one speed: fit a law at that of the run, or set `reach` if they hold"',
        ]
    for row, direction in enumerate(DIRECTIONS):
        lines += [
            "",
            f"[outputs.F_{direction}]",
            'unit = "N"',
            f'title = "force on the journal, {WHERE[direction]}"',
            f"value = '{writer.force(row)}'",
        ]
    return "\n".join(lines) + "\n"


def _parameter(name: str, value: float, unit: str, title: str) -> str:
    return f'{name} = {{ value = {value:.12g}, unit = "{unit}", title = {_toml._text(title)} }}'


class _Writer:
    """Names for what a law of this fit has; what is zero is left out."""

    def __init__(self, fit: Rational):
        self.fit = fit
        self.parameters: list[str] = []
        self.definitions: list[str] = []
        self.rates: list[str] = []
        self._states: list[tuple[str, str]] = []
        # Factor, what it acts on, and where it stands in the matrix.
        self._terms: list[list[str]] = [[], []]
        self._term("k", fit.static, "N/m", "static stiffness", "e_{}")
        self._term("c", fit.damper, "N*s/m", "damping of fast motion", "e_{}_dot")
        for place, (pole, residue) in enumerate(zip(fit.poles, fit.residues)):
            number = place + 1
            if pole.imag:
                self._pair(number, pole, residue)
            else:
                self._relaxation(number, pole.real, residue.real)

    def _term(self, letter: str, matrix: np.ndarray, unit: str, title: str, acts: str) -> None:
        for entry, value in zip(ENTRIES, matrix.ravel()):
            if value != 0:
                name = f"{letter}_{entry}"
                self.parameters.append(_parameter(name, value, unit, f"{title}, {entry}"))
                row = DIRECTIONS.index(entry[0])
                self._terms[row].append(f"{name}*{acts.format(entry[1])}")

    def _relaxation(self, number: int, pole: float, residue: np.ndarray) -> None:
        """s/(s + p) e = e - w with w' = p (e - w)."""
        title = "rate of relaxation"
        self.parameters.append(_parameter(f"p{number}", pole, "1/s", f"{title} {number}"))
        self._term(
            f"r{number}", residue, "N/m", f"stiffness that relaxes at p{number}", f"d{number}_{{}}"
        )
        for own in self._moving(residue):
            state = f"w{number}_{own}"
            self._states.append(
                (state, f"displacement that relaxation {number} follows, {WHERE[own]}")
            )
            self.definitions.append(f"d{number}_{own} = 'e_{own} - {state}'")
            self.rates.append(f"{state} = 'p{number}*(e_{own} - {state})'")

    def _pair(self, number: int, pole: complex, residue: np.ndarray) -> None:
        """s (A s + B)/(s² + 2 ζ ω s + ω²) e = A (e - u - 2 ζ v) + B/ω v with u' = ω v, v' = ω (e - u - 2 ζ v)."""
        size = abs(pole)
        straight, across = 2.0 * residue.real, 2.0 * (residue * pole.conjugate()).real / size
        self.parameters += [
            _parameter(f"w{number}", size, "1/s", f"angular frequency of resonance {number}"),
            _parameter(f"z{number}", pole.real / size, "1", f"damping ratio of resonance {number}"),
        ]
        title = f"stiffness of resonance {number}"
        self._term(f"a{number}", straight, "N/m", f"{title}, in phase", f"d{number}_{{}}")
        self._term(f"b{number}", across, "N/m", f"{title}, a quarter behind", f"v{number}_{{}}")
        for own in self._moving(np.abs(straight) + np.abs(across)):
            u, v, d = (f"{letter}{number}_{own}" for letter in "uvd")
            self._states.append((u, f"displacement within resonance {number}, {WHERE[own]}"))
            self._states.append((v, f"its rate over the frequency, {WHERE[own]}"))
            self.definitions.append(f"{d} = 'e_{own} - {u} - 2*z{number}*{v}'")
            self.rates.append(f"{u} = 'w{number}*{v}'")
            self.rates.append(f"{v} = 'w{number}*{d}'")

    @staticmethod
    def _moving(matrix: np.ndarray) -> list[str]:
        """Directions whose motion has any effect."""
        return [own for column, own in enumerate(DIRECTIONS) if (matrix[:, column] != 0).any()]

    def inputs(self, speed: bool) -> list[str]:
        """Tables of inputs, of those alone that are used."""
        every = " ".join(["\n".join(self._terms[0] + self._terms[1]), *self.definitions])
        lines = []
        for own in DIRECTIONS:
            for name, unit, end in ((f"e_{own}", "mm", 0.1), (f"e_{own}_dot", "mm/s", 20)):
                parts = every.replace("*", " ").replace("'", " ").split()
                if name in parts:
                    lines += [
                        "",
                        f"[inputs.{name}]",
                        f'unit = "{unit}"',
                        f"range = [{-end}, {end}]",
                    ]
        if speed:
            lines += ["", "[inputs.omega]", 'unit = "rad/s"', "range = [0, 2000]"]
        return lines

    def states(self) -> list[str]:
        """Tables of states, which begin at rest with the motion."""
        lines = []
        for name, title in self._states:
            lines += [
                "",
                f"[states.{name}]",
                'unit = "mm"',
                'start = "rest"',
                "range = [-0.1, 0.1]",
            ]
            lines.append(f'title = "{title}"')
        return lines

    def force(self, row: int) -> str:
        """The formula of a force."""
        terms = self._terms[row]
        return f"-({' + '.join(terms)})" if terms else "0"

    def stored(self) -> str:
        """Half of what K₀ and relaxing stiffness that is positive, their symmetric parts, do to displacements."""
        parts = []
        springs = [("k", self.fit.static, "e_{}")]
        for place, (pole, residue) in enumerate(zip(self.fit.poles, self.fit.residues)):
            least = np.linalg.eigvalsh(residue.real + residue.real.T)[0]
            if not pole.imag and least >= -1e-9 * np.abs(residue).max():
                springs.append((f"r{place + 1}", residue.real, f"d{place + 1}_{{}}"))
        for letter, matrix, acts in springs:
            x, y = acts.format("x"), acts.format("y")
            (xx, xy), (yx, yy) = matrix
            across = [f"{letter}_{own}" for own, value in (("xy", xy), ("yx", yx)) if value != 0]
            if xx != 0:
                parts.append(f"{letter}_xx*{x}^2")
            # Of a circulatory stiffness nothing is stored.
            if xy + yx != 0:
                parts.append(f"({' + '.join(across)})*{x}*{y}")
            if yy != 0:
                parts.append(f"{letter}_yy*{y}^2")
        return f"({' + '.join(parts)})/2" if parts else ""
