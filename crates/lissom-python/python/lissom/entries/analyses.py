# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""What is computed, and how."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Count, Entry, Number


class Analysis(Entry):
    """What is computed, and how."""

    __slots__ = ()
    _table: ClassVar[str] = "analysis"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Dynamics(Analysis):
    """Motion in time.

    Args:
        start: first time, default 0 [s]; a number, or nothing.
        scaling: scale of the equations, default physical; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: rows and columns of the scaled tangent brought to one size, default true; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term, default true; `true` or `false`, or nothing.
        penalty: factor of the augmented term, default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"skyline"`, `"pivoting"`, `"dense"`, or nothing.
        tolerance: of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`; a number > 0, or nothing.
        max_iterations: of Newton's iteration, default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be switched off, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, or nothing.
        output_every: steps from record to record, default 1; a whole number from 1 to 1000000000, or nothing.
        frames_per_second: of the motion that `lissom view` shows, per simulated second; default at most 600 over the run [1/s]; a number > 0, or nothing.
        scheme: time integration scheme; `"generalized-alpha"`, `"hht"`, `"radau-iia"`, `"radau-iia-5"`, `"energy-decaying"`, or nothing.
        end: last time [s]; a number.
        step: time step; with `relative_tolerance` the first one [s]; a number > 0, or nothing.
        relative_tolerance: error allowed per step, relative to the motion: steps are chosen to keep it; default 1e-5 without `step`; a number from 0.0000 to 0.1, or nothing.
        max_step: longest step that is chosen, default a twentieth of the whole [s]; a number > 0, or nothing.
        output_step: time from record to record where steps are chosen; default every step [s]; a number > 0, or nothing.
        energy_check: whether a run with much more energy than anything put in fails, default true; `true` or `false`, or nothing.
        spectral_radius: Spectral radius at infinite frequency, 0 … 1; default 0.8; a number from 0.0000 to 1, or nothing.
        alpha: Numerical damping, -1/3 … 0; default -0.1; a number from -0.3333 to 0, or nothing.
    """

    _form: ClassVar[str] = "dynamics"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "skyline", "pivoting", "dense"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts"]] | None = None
    output_every: Count | None = None
    frames_per_second: Number | None = None
    scheme: Literal["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"] | None = None
    end: Number
    step: Number | None = None
    relative_tolerance: Number | None = None
    max_step: Number | None = None
    output_step: Number | None = None
    energy_check: bool | None = None
    spectral_radius: Number | None = None
    alpha: Number | None = None


@dataclass(kw_only=True, slots=True)
class Statics(Analysis):
    """Equilibrium in load steps.

    Args:
        start: first time, default 0 [s]; a number, or nothing.
        scaling: scale of the equations, default physical; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: rows and columns of the scaled tangent brought to one size, default true; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term, default true; `true` or `false`, or nothing.
        penalty: factor of the augmented term, default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"skyline"`, `"pivoting"`, `"dense"`, or nothing.
        tolerance: of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`; a number > 0, or nothing.
        max_iterations: of Newton's iteration, default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be switched off, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, or nothing.
        output_every: steps from record to record, default 1; a whole number from 1 to 1000000000, or nothing.
        frames_per_second: of the motion that `lissom view` shows, per simulated second; default at most 600 over the run [1/s]; a number > 0, or nothing.
        end: last time, default 1 [s]; a number, or nothing.
        steps: number of load steps; without it they are chosen by contraction and error; a whole number from 1 to 1000000, or nothing.
        relative_tolerance: part of its work that a load step of chosen size may leave unexplained, default 0.01; a number > 0, or nothing.
        ramp: whether gravity and loads that are constant grow from nothing over the load steps, default true; `true` or `false`, or nothing.
    """

    _form: ClassVar[str] = "statics"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "skyline", "pivoting", "dense"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts"]] | None = None
    output_every: Count | None = None
    frames_per_second: Number | None = None
    end: Number | None = None
    steps: Count | None = None
    relative_tolerance: Number | None = None
    ramp: bool | None = None


@dataclass(kw_only=True, slots=True)
class Path(Analysis):
    """Equilibria under loads times a load factor, or along a number of the model, through limit points, by arc length.

    Args:
        start: first time, default 0 [s]; a number, or nothing.
        scaling: scale of the equations, default physical; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: rows and columns of the scaled tangent brought to one size, default true; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term, default true; `true` or `false`, or nothing.
        penalty: factor of the augmented term, default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"skyline"`, `"pivoting"`, `"dense"`, or nothing.
        tolerance: of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`; a number > 0, or nothing.
        max_iterations: of Newton's iteration, default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be switched off, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, or nothing.
        end: load factor at which the path ends, default 1; with `vary` the value at which it ends, which must be given; a number, or nothing.
        step: first step of the load factor or of the number, default a fiftieth of the way to `end`; a number > 0, or nothing.
        steps: most steps, default 1000; a whole number from 1 to 1000000, or nothing.
        vary: number of the model file along which the path goes, such as `parameters.height`, from the value that it has there; default: the load factor; a text, or nothing.
        branch: bifurcation at which the path goes over to its branch, counted from 1; negative for the other sense of the branch; default 0, none; a number from -1000.0000 to 1000, or nothing.
    """

    _form: ClassVar[str] = "path"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "skyline", "pivoting", "dense"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts"]] | None = None
    end: Number | None = None
    step: Number | None = None
    steps: Count | None = None
    vary: str | None = None
    branch: Number | None = None


@dataclass(kw_only=True, slots=True)
class Buckling(Analysis):
    """Load factors of buckling, by a linear estimate.

    Args:
        start: first time, default 0 [s]; a number, or nothing.
        scaling: scale of the equations, default physical; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: rows and columns of the scaled tangent brought to one size, default true; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term, default true; `true` or `false`, or nothing.
        penalty: factor of the augmented term, default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"skyline"`, `"pivoting"`, `"dense"`, or nothing.
        tolerance: of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`; a number > 0, or nothing.
        max_iterations: of Newton's iteration, default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be switched off, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, or nothing.
        count: number of load factors, default 5; a whole number from 1 to 10000, or nothing.
    """

    _form: ClassVar[str] = "buckling"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "skyline", "pivoting", "dense"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts"]] | None = None
    count: Count | None = None


@dataclass(kw_only=True, slots=True)
class Modes(Analysis):
    """Natural modes about a state at rest.

    Args:
        start: first time, default 0 [s]; a number, or nothing.
        scaling: scale of the equations, default physical; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: rows and columns of the scaled tangent brought to one size, default true; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term, default true; `true` or `false`, or nothing.
        penalty: factor of the augmented term, default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"skyline"`, `"pivoting"`, `"dense"`, or nothing.
        tolerance: of Newton's iteration, in scaled units, default 1e-8; with chosen steps `relative_tolerance`/100; 1e-12 for `energy-decaying`; a number > 0, or nothing.
        max_iterations: of Newton's iteration, default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be switched off, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, or nothing.
        count: number of modes, default 20; a whole number from 1 to 100000, or nothing.
        about: about static equilibrium under the loads of the time `start` (default), or about the positions of the file without loads and gravity; `"static"`, `"undeformed"`, or nothing.
        shift: frequency near which modes are sought; default: the lowest ones [Hz]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "modes"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "skyline", "pivoting", "dense"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts"]] | None = None
    count: Count | None = None
    about: Literal["static", "undeformed"] | None = None
    shift: Number | None = None
