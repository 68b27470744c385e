"""Bearing laws: what they are, their values, their plots."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _whirl
from .errors import extra
from .history import _absent

__all__ = ["Curve", "Law", "LawInput", "LawOutput", "Parameter", "explain"]


@dataclass(frozen=True)
class LawInput:
    """An input of a law: name, unit, title, and the range (in that unit) over which the law is looked at."""

    name: str
    unit: str
    title: str
    range: tuple[float, float]


@dataclass(frozen=True)
class LawOutput:
    """An output of a law: name, unit, title."""

    name: str
    unit: str
    title: str


@dataclass(frozen=True)
class Parameter:
    """A constant of a law: name, value, unit, title."""

    name: str
    value: float
    unit: str
    title: str


@dataclass(frozen=True)
class Curve:
    """An output of a law, or one of its derivatives, over one of its inputs.

    Attributes
    ----------
    x_name, x_unit, y_name, y_unit : str
        What is shown over what.
    held : str
        Values of the other inputs, such as ``h_dot = 0 mm/s``.
    x, y : numpy.ndarray
        Shape ``(points,)``, in these units.
    """

    x_name: str
    x_unit: str
    y_name: str
    y_unit: str
    held: str
    x: np.ndarray
    y: np.ndarray


class Law:
    """A bearing law.

    Parameters
    ----------
    source : str or path
        The name of a built-in law, the path of a law file, or the text of one (a str with a line break).
    name : str, optional
        What messages call a text, ``law`` if none is given.

    Examples
    --------
    >>> law = whirl.Law("hertz-cylinder")
    >>> force = law(h=np.linspace(-0.01, 0.01, 201))   # in the unit of the law's file, see law.inputs
    >>> law.plot()
    """

    def __init__(self, source: str | os.PathLike[str], *, name: str | None = None):
        text = _text_of(source, "law")
        if text is None:
            self._inner = _whirl.Law.named(os.fspath(source))
        else:
            self._inner = _whirl.Law.of_text(f"{name or 'law'}.toml", text)

    def __reduce__(self):
        return _law_of, (str(self._inner.path), self.text)

    def __repr__(self) -> str:
        return f"<whirl.Law {self.name}: {self.title}>"

    @property
    def name(self) -> str:
        """Its name, as its file says it."""
        return self._inner.name

    @property
    def title(self) -> str:
        """One line."""
        return self._inner.title

    @property
    def text(self) -> str:
        """The text of its file."""
        return self._inner.text

    @property
    def inputs(self) -> tuple[LawInput, ...]:
        """Its inputs, in the order of its file."""
        return tuple(LawInput(*own) for own in self._inner.inputs)

    @property
    def outputs(self) -> tuple[LawOutput, ...]:
        """Its outputs, in the order of its file."""
        return tuple(LawOutput(*own) for own in self._inner.outputs)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Its constants, in the order of its file. Those of a bearing hold in a case, in place of the file's."""
        return tuple(Parameter(*own) for own in self._inner.parameters)

    def __call__(self, **inputs: Any) -> Any:
        """Values of the law, with the arithmetic of a run.

        Parameters
        ----------
        **inputs : float or array_like
            In the units of the law's file (:attr:`inputs`), broadcast against each other; those left out are 0.

        Returns
        -------
        numpy.ndarray or dict of str to numpy.ndarray
            In the units of the file (:attr:`outputs`), of the broadcast shape: of the only output, or by name.
        """
        values, shape = self._evaluate(inputs)
        found = [own[0].reshape(shape)[()] for own in values]
        if len(found) == 1:
            return found[0]
        return {own.name: value for own, value in zip(self.outputs, found)}

    def derivative(self, output: str, by: str, **inputs: Any) -> Any:
        """The derivative of an output by an input, as a run uses it.

        Parameters
        ----------
        output, by : str
            Names of an output and of an input.
        **inputs : float or array_like
            As of a call.

        Returns
        -------
        numpy.ndarray
            In the unit of the output over that of the input, of the broadcast shape.
        """
        outputs = [own.name for own in self.outputs]
        names = [own.name for own in self.inputs]
        if output not in outputs:
            raise KeyError(_absent(f"output of the law {self.name}", output, outputs))
        if by not in names:
            raise KeyError(_absent(f"input of the law {self.name}", by, names))
        values, shape = self._evaluate(inputs)
        return values[outputs.index(output), 1 + names.index(by)].reshape(shape)[()]

    def _evaluate(self, inputs: Mapping[str, Any]) -> tuple[np.ndarray, tuple[int, ...]]:
        names = [own.name for own in self.inputs]
        for name in inputs:
            if name not in names:
                raise TypeError(_absent(f"input of the law {self.name}", name, names))
        given = []
        for own in self.inputs:
            value = inputs.get(own.name, 0.0)
            if value is None or np.asarray(value).dtype.kind in "SUb":
                raise TypeError(f"`{own.name}` takes numbers in {own.unit}, not {value!r}")
            try:
                given.append(np.asarray(value, dtype=np.float64))
            except (TypeError, ValueError) as error:
                message = f"`{own.name}` takes numbers in {own.unit}, not {value!r}"
                raise TypeError(message) from error
        try:
            arrays = np.broadcast_arrays(*given)
        except ValueError as error:
            shapes = ", ".join(f"{name} {own.shape}" for name, own in zip(names, given))
            raise ValueError(f"inputs of these shapes do not broadcast: {shapes}") from error
        shape = arrays[0].shape
        return self._inner.evaluate(np.stack([own.ravel() for own in arrays])), shape

    def curves(self) -> tuple[Curve, ...]:
        """Every output over every input on which it depends, in the order in which :meth:`plot` shows them."""
        curves = []
        for (x_name, x_unit), (y_name, y_unit), held, points in self._inner.curves():
            x, y = np.array(points, dtype=np.float64).reshape(-1, 2).T
            curves.append(Curve(x_name, x_unit, y_name, y_unit, held, x, y))
        return tuple(curves)

    def explain(self) -> str:
        """Equations, derivatives, a plot and the code of the law, as ``whirl explain`` prints them."""
        path = str(self._inner.path)
        return _whirl.explain(path, self.text)

    def plot(self, axes: Any = None) -> Any:
        """Plots every curve of the law.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, or a sequence of as many as there are curves, optional
            One shows the first curve; new ones are made if none are given.

        Returns
        -------
        numpy.ndarray of matplotlib.axes.Axes
        """
        curves = self.curves()
        if axes is None:
            pyplot = extra("plots", "matplotlib.pyplot", "Law.plot()")
            columns = min(len(curves), 2)
            rows = -(-len(curves) // columns)
            _, axes = pyplot.subplots(
                rows,
                columns,
                squeeze=False,
                layout="constrained",
                figsize=(5 * columns, 3.4 * rows),
            )
            for spare in axes.ravel()[len(curves) :]:
                spare.set_visible(False)
        all_axes = np.atleast_1d(np.asarray(axes, dtype=object)).ravel()
        for own, curve in zip(all_axes, curves):
            own.plot(curve.x, curve.y)
            own.set_xlabel(f"{curve.x_name} ({curve.x_unit})")
            own.set_ylabel(f"{curve.y_name} ({curve.y_unit})")
            own.set_title(curve.held, fontsize="small")
            own.grid(True, alpha=0.3)
        return all_axes


def _law_of(path: str, text: str) -> Law:
    law = Law.__new__(Law)
    law._inner = _whirl.Law.of_text(path, text)
    return law


def _text_of(source: Any, what: str) -> str | None:
    """The source if it is a text, none if it is a name or path."""
    if isinstance(source, os.PathLike):
        return None
    if not isinstance(source, str):
        raise TypeError(
            f"a {what} is a name, a path or a text, not {type(source).__name__} ({source!r})"
        )
    return source if "\n" in source else None


def explain(spec: str | os.PathLike[str] | Law) -> str:
    """What a law, an element or another spec defines and what follows from it, as ``whirl explain`` prints it.

    Parameters
    ----------
    spec : str, path or Law
        The name of a built-in spec, the path of a file, or the text of one (a str with a line break).
    """
    if isinstance(spec, Law):
        return spec.explain()
    text = _text_of(spec, "spec")
    if text is None:
        return _whirl.explain(os.fspath(spec))
    return _whirl.explain("text.toml", text)
