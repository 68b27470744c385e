"""The cases of a sweep."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _toml
from .case import Case, _restored, _with_laws
from .errors import WhirlError
from .law import Law

__all__ = ["Point", "expanded"]


@dataclass(frozen=True)
class Point:
    """Values of the varied keys, and the case with them."""

    values: Mapping[str, Any]
    case: Case


def expanded(
    case: Case, vary: Mapping[str, Iterable[Any]]
) -> tuple[dict[str, list[Any]], list[Point]]:
    """All combinations of values, the last key fastest, each with its case."""
    if not isinstance(vary, Mapping) or not vary:
        raise TypeError(
            "`vary` is a dict of keys with their values, such as {'march.steps': [10, 20]}"
        )
    keys = {}
    for key, values in vary.items():
        if not isinstance(key, str) or not all(key.split(".")):
            raise TypeError(f"{key!r} is no key of a case, such as `springs.radial_clearance`")
        if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
            raise TypeError(
                f"`vary[{key!r}]` is a list of values, not {type(values).__name__} ({values!r})"
            )
        keys[key] = [_value(key, own) for own in values]
        if not keys[key]:
            raise WhirlError(f"`vary[{key!r}]` has no values")
    every = [dict(zip(keys, own)) for own in itertools.product(*keys.values())]
    return keys, [Point(values, _with(case, values)) for values in every]


def _value(key: str, value: Any) -> Any:
    """Texts of laws as laws, and NumPy's numbers as Python's."""
    if hasattr(value, "dtype") and getattr(value, "ndim", None) == 0:
        value = value.item()
    is_law = key.split(".")[-1] == "law" and isinstance(value, str) and "\n" in value
    return Law(value) if is_law else value


def _with(case: Case, values: Mapping[str, Any]) -> Case:
    """The case with these values."""
    path, text, files, before = case._inner.parts()
    texts: dict[str, str] = {}
    lines = [before] if before else []
    for key, value in values.items():
        plain = _with_laws({key.split(".")[-1]: value}, texts)
        lines.append(_toml.line(key, *plain.values()))
    beside = {str(own): text for own, text in files.items()}
    beside.update({str(Path(path).parent / own): text for own, text in texts.items()})
    return _restored(str(path), text, beside, "".join(lines))
