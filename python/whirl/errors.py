"""What whirl raises, and what it warns of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .results import Results

__all__ = [
    "CaseError",
    "Diagnostic",
    "FitError",
    "MissingExtra",
    "RunError",
    "WhirlError",
    "WhirlWarning",
]


@dataclass(frozen=True)
class Diagnostic:
    """One thing that is wrong with a file.

    Attributes
    ----------
    message : str
        What is wrong, in the names that the file uses.
    file : str
        The file, or the name that a text was given.
    line, column : int or None
        Where in it, both from 1; None where it is about the file as a whole.
    help : str or None
        How to fix it.
    code : str or None
        A stable code, see docs/errors.md.
    text : str
        The message with the line and a caret under the place.
    """

    message: str
    file: str
    line: int | None
    column: int | None
    help: str | None
    code: str | None
    text: str

    def __str__(self) -> str:
        return self.text.rstrip()


class WhirlError(Exception):
    """Everything that whirl raises is one."""


class CaseError(WhirlError, ValueError):
    """A case, a law or a file that they name is wrong; nothing was run.

    Attributes
    ----------
    diagnostics : tuple of Diagnostic
        Everything that is wrong, not only the first.
    """

    def __init__(self, diagnostics):
        self.diagnostics: tuple[Diagnostic, ...] = tuple(diagnostics)
        super().__init__(self.diagnostics)

    def __str__(self) -> str:
        return "\n\n".join(str(own) for own in self.diagnostics)


class FitError(WhirlError, ValueError):
    """A table to which no law can be fitted as was asked."""


class RunError(WhirlError, RuntimeError):
    """A run that has begun and did not come to its end, such as for a step that does not converge.

    Attributes
    ----------
    reason : str
        Why.
    results : Results or None
        What was computed before.
    """

    def __init__(self, reason: str, results: Results | None = None):
        super().__init__(reason, results)
        self.reason = reason
        self.results = results

    def __str__(self) -> str:
        return self.reason


class MissingExtra(WhirlError, ImportError):
    """A package that whirl needs for what was asked, and does without otherwise."""


class WhirlWarning(UserWarning):
    """Something about a case or a run that may be wrong."""


def extra(name: str, package: str, what: str):
    """The module ``package``, which ``what`` needs and the extra ``name`` installs."""
    import importlib

    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise MissingExtra(
            f"{what} needs `{package}`: install it with `pip install 'whirl[{name}]'`"
        ) from error
