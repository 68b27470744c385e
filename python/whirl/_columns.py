"""Files of columns with units, read as the program reads them."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from . import _whirl
from .errors import CaseError, Diagnostic

__all__ = ["ANGLES", "NUMBER", "QUOTES", "TABLE", "File", "factor"]

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?\Z")
# Units with an angle do not count cycles.
ANGLES = re.compile(r"rad|rpm|deg|°")
# In no unit, and not within the text of a law.
QUOTES = re.compile(r"[\"\\\x00-\x1f]")
# Codes of docs/errors.md.
TABLE, UNIT, DIMENSION = "E033", "E020", "E021"
MOST_ERRORS = 8


@functools.cache
def factor(unit: str, example: str) -> float:
    """What one of ``unit`` is in ``example``, a unit of SI, by the program's own reading of units.

    Raises
    ------
    CaseError
        It is unknown, or measures something else.
    """
    # A law whose force per metre is the number that is wanted: units are read where laws are.
    text = f"""
kind = "law"
name = "unit"
title = "a unit"
source = "none"
inputs.e_x = {{ unit = "m", range = [-1, 1] }}
[parameters]
length = {{ value = 1, unit = "m" }}
force = {{ value = 1, unit = "N" }}
one = {{ value = 1, unit = "{example}" }}
none = {{ value = 0, unit = "{example}" }}
unit = {{ value = 1, unit = "{unit}" }}
[outputs]
F_x = {{ unit = "N", value = 'force*(e_x/length)*(unit + none)/one' }}
F_y = {{ unit = "N", value = '0' }}
"""
    law = _whirl.Law.of_text("unit.toml", text)
    return float(law.evaluate(np.ones((1, 1)))[0, 0, 0])


@dataclass(frozen=True)
class Cell:
    line: int
    start: int
    text: str


class File:
    """A file of columns, split into cells as the program splits it."""

    def __init__(self, name: str, text: str):
        self.name = name
        self.lines = text.removeprefix("\ufeff").splitlines()
        rows = [cells for cells in map(self._cells, range(len(self.lines))) if cells]
        self.heads: dict[str, Cell] = {}
        self.units: dict[str, str] = {}
        if not rows or any(NUMBER.match(own.text) for own in rows[0]):
            message = f"`{name}` has no line of names"
            help = "write names and units above the numbers, such as `frequency [Hz], k_xx [N/m]`"
            raise CaseError([self.wrong(None, TABLE, message, help)])
        self.order = []
        for cell in rows[0]:
            parts = re.match(r"(.*?)\s*(?:\[(.*?)\]|\((.*?)\)|\Z)", cell.text)
            assert parts is not None
            called = parts[1].strip()
            if called and called in self.heads:
                message = f"two columns are called `{called}`"
                help = "give each column a name of its own"
                raise CaseError([self.wrong(cell, TABLE, message, help)])
            self.order.append(called)
            self.heads[called] = cell
            unit = parts[2] if parts[2] is not None else parts[3]
            if unit is not None:
                self.units[called] = unit.strip()
        self.rows = rows[1:]
        if not self.rows:
            message = f"`{name}` has no rows of numbers"
            raise CaseError([self.wrong(None, TABLE, message, "give a row for each frequency")])
        long = [own for own in self.rows if len(own) > len(self.order)]
        if long:
            help = "write numbers with a point, as `0.5`; commas separate columns, unless `;` does"
            raise CaseError(
                [
                    self.wrong(
                        own[len(self.order)],
                        TABLE,
                        f"this line has {len(own)} values, but the line of names has "
                        f"{len(self.order)} columns",
                        help,
                    )
                    for own in long[:MOST_ERRORS]
                ]
            )

    def _cells(self, place: int) -> list[Cell]:
        line = self.lines[place]
        quoted = False
        for at, letter in enumerate(line):
            quoted ^= letter == '"'
            if letter == "#" and not quoted:
                line = line[:at]
                break
        line = line.rstrip()
        separator = next((own for own in ";\t," if own in line), None)
        if separator is None:
            # A unit in brackets belongs to the name before it.
            pieces = [own.span() for own in re.finditer(r"\S+(?:\s+[\[(]\S*)*", line)]
        else:
            ends = [at for at, letter in enumerate(line) if letter == separator]
            pieces = list(zip([0, *(own + 1 for own in ends)], [*ends, len(line)]))
            # A separator at the end of a line begins no column.
            if not line[pieces[-1][0] :].strip():
                pieces.pop()
        cells = []
        for start, end in pieces:
            text = line[start:end].strip().strip('"').strip()
            cells.append(Cell(place, line.find(text, start), text))
        return cells

    def wrong(self, cell: Cell | None, code: str, message: str, help: str) -> Diagnostic:
        """Something wrong at a cell, shown as the program shows it."""
        shown = [f"error[{code}]: {message}"]
        line = column = None
        if cell is not None:
            line, column = cell.line + 1, cell.start + 1
            blank = " " * len(str(line))
            marks = " " * cell.start + "^" * max(len(cell.text), 1)
            shown += [f"{blank}--> {self.name}:{line}:{column}", f"{blank} |"]
            shown += [f"{line} | {self.lines[cell.line]}", f"{blank} | {marks}", f"{blank} |"]
        else:
            blank = ""
            shown.append(f"--> {self.name}")
        shown.append(f"{blank} = help: {help}")
        return Diagnostic(message, self.name, line, column, help, code, "\n".join(shown) + "\n")

    def column(self, called: str, unit_like: str, needed: Iterable[str]) -> np.ndarray:
        """The numbers of a column in SI, whose unit measures the same as this one; frequencies are angular ones."""
        head = self.heads.get(called)
        example = f"{called} [{unit_like}]"
        if head is None:
            message = f"`{self.name}` has no column `{called}`"
            help = f"such as `{example}`; these are needed: {', '.join(needed)}"
            first = next(iter(self.heads.values()))
            raise CaseError([self.wrong(first, TABLE, message, help)])
        unit = self.units.get(called)
        if unit is None:
            message = f"the column `{called}` has no unit"
            help = f"write it behind the name, as in `{example}`"
            raise CaseError([self.wrong(head, TABLE, message, help)])
        times = self._factor(head, called, unit, unit_like)
        place = self.order.index(called)
        values, errors = [], []
        for row in self.rows:
            if place >= len(row):
                message = f"this line has no value in the column `{called}`"
                help = "write a value for each column, with commas between"
                errors.append(self.wrong(row[0], TABLE, message, help))
            elif not NUMBER.match(row[place].text) or not np.isfinite(float(row[place].text)):
                message = f"expected a number, found `{row[place].text}`"
                help = "write numbers with a point, such as `0.035` or `3.5e-2`"
                errors.append(self.wrong(row[place], TABLE, message, help))
            else:
                values.append(float(row[place].text) * times)
            if len(errors) == MOST_ERRORS:
                break
        if errors:
            raise CaseError(errors)
        return np.array(values)

    def _factor(self, head: Cell, called: str, unit: str, example: str) -> float:
        """What one of the unit is in SI, if it measures the same as that of the example."""
        message = f"`{unit}` is no unit of the column `{called}`"
        help = f"such as `{called} [{example}]`"
        other = self.wrong(head, DIMENSION, message, help)
        turns = bool(ANGLES.search(unit))
        if QUOTES.search(unit) or example == "rpm" and not turns:
            raise CaseError([other])
        try:
            # A frequency in Hz counts cycles.
            if example == "Hz" and not turns:
                return 2.0 * np.pi * factor(unit, "Hz")
            return factor(unit, "rad/s" if example in ("Hz", "rpm") else example)
        except CaseError as error:
            own = error.diagnostics[0]
            if own.code != UNIT:
                raise CaseError([other]) from None
            raise CaseError([self.wrong(head, UNIT, own.message, own.help or help)]) from None
