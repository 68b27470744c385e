"""Python values as the text of a case file."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

from .errors import WhirlError

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


class CaseValueError(WhirlError, TypeError):
    """A value of a dict that no case file can have."""


def dumps(case: Mapping[str, Any]) -> str:
    """The text of a case; tables come after the keys of the table that they are in."""
    lines: list[str] = []
    _table(_plain(case, ()), (), lines)
    return "\n".join(lines) + "\n"


def line(key: str, value: Any) -> str:
    """A line for a key with its tables, and its value."""
    return f"{'.'.join(_key(own) for own in key.split('.'))} = {_value(_plain(value, (key,)))}\n"


def _plain(value: Any, path: tuple[str, ...]) -> Any:
    """The value with NumPy's scalars and arrays, paths and laws as what TOML has."""
    from .law import Law

    if isinstance(value, Law):
        raise _wrong(path, value, "a law stands under a key `law`, in a case that whirl.Case reads")
    if isinstance(value, bool) or isinstance(value, str) and type(value) is str:
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, str):
        return str(value)
    if isinstance(value, Mapping):
        plain = {}
        for key, own in value.items():
            if not isinstance(key, str):
                raise _wrong((*path, repr(key)), key, "keys of a case are texts")
            if own is not None:
                plain[key] = _plain(own, (*path, key))
        return plain
    if hasattr(value, "tolist") and hasattr(value, "dtype"):
        return _plain(value.tolist(), path)
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise _wrong(path, value, "numbers of a case are finite")
        return float(value)
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return [_plain(own, (*path, str(place))) for place, own in enumerate(value)]
    raise _wrong(path, value, "a case has numbers, texts, truth values, lists and tables")


def _wrong(path: tuple[str, ...], value: Any, help: str) -> CaseValueError:
    where = ".".join(path) or "the case"
    return CaseValueError(f"`{where}` is of the type {type(value).__name__} ({value!r}): {help}")


def _table(table: Mapping[str, Any], path: tuple[str, ...], lines: list[str]) -> None:
    tables = {}
    for key, value in table.items():
        listed = isinstance(value, list) and value and all(isinstance(own, dict) for own in value)
        if isinstance(value, dict) or listed:
            tables[key] = value
        else:
            lines.append(f"{_key(key)} = {_value(value)}")
    for key, value in tables.items():
        inner = (*path, key)
        name = ".".join(_key(own) for own in inner)
        for own in value if isinstance(value, list) else [value]:
            if lines:
                lines.append("")
            lines.append(f"[[{name}]]" if isinstance(value, list) else f"[{name}]")
            _table(own, inner, lines)


def _key(key: str) -> str:
    return key if _BARE.match(key) else _text(key)


def _text(text: str) -> str:
    escaped = "".join(_ESCAPES.get(own, own) for own in text)
    return '"' + "".join(_control(own) for own in escaped) + '"'


def _control(letter: str) -> str:
    return f"\\u{ord(letter):04X}" if ord(letter) < 32 or ord(letter) == 127 else letter


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, list):
        return "[" + ", ".join(_value(own) for own in value) + "]"
    inner = ", ".join(f"{_key(key)} = {_value(own)}" for key, own in value.items())
    return "{ " + inner + " }" if inner else "{}"
