"""Transient dynamics of rotating flexible shafts in flexible supports with bearing clearances.

>>> import whirl
>>> results = whirl.Case("hu2003-5").run()
>>> results.verdict.sound
True
>>> results["EX1_um"].max()          # a NumPy array, in the unit that the column's name ends with
>>> results.to_xarray()              # with units and meanings as attributes
"""

from importlib.metadata import version as _version

from .bodies import Bodies, forget_bodies, keep_bodies, shared_bodies
from .case import Case, cases
from .errors import (
    CaseError,
    Diagnostic,
    FitError,
    MissingExtra,
    RunError,
    WhirlError,
    WhirlWarning,
)
from .fit import FittedLaw, fit_law
from .history import Column, History
from .law import Curve, Law, LawInput, LawOutput, Parameter, explain
from .linear import (
    Analyses,
    Analysis,
    Campbell,
    Coefficients,
    Criticals,
    Excited,
    JointCoefficients,
    Matrices,
    Modes,
    Response,
    Stability,
    Table,
    Thresholds,
)
from .results import Finding, Results, Summary, Verdict
from .ross import from_ross
from .sweep import Sweep, SweepPoint, sweep

__all__ = [
    "Analyses",
    "Analysis",
    "Bodies",
    "Campbell",
    "Case",
    "CaseError",
    "Coefficients",
    "Column",
    "Criticals",
    "Curve",
    "Diagnostic",
    "Excited",
    "Finding",
    "FitError",
    "FittedLaw",
    "History",
    "JointCoefficients",
    "Law",
    "LawInput",
    "LawOutput",
    "Matrices",
    "MissingExtra",
    "Modes",
    "Parameter",
    "Response",
    "Results",
    "RunError",
    "Stability",
    "Summary",
    "Sweep",
    "SweepPoint",
    "Table",
    "Thresholds",
    "Verdict",
    "WhirlError",
    "WhirlWarning",
    "cases",
    "explain",
    "fit_law",
    "forget_bodies",
    "from_ross",
    "keep_bodies",
    "shared_bodies",
    "sweep",
]

__version__ = _version("whirl")
