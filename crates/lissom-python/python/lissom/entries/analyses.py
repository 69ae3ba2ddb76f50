# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""Kind of analysis and its settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Count, Entry, Number


class Analysis(Entry):
    """Kind of analysis and its settings."""

    __slots__ = ()
    _table: ClassVar[str] = "analysis"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Dynamics(Analysis):
    """Motion in time.

    Args:
        start: first time; default 0 [s]; a number, or nothing.
        scaling: scale of the equations; default `"physical"`; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: equilibration of rows and columns of the scaled tangent; default `true`; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term; default `true`; `true` or `false`, or nothing.
        penalty: factor of the augmented term; default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"pivoting"`, `"strict"`, or nothing.
        tolerance: tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8; a number > 0, or nothing.
        max_iterations: maximum number of Newton iterations; default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be disabled, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, `"still-axes"`, or nothing.
        output_every: number of steps between records; default: every step, or several records in each adaptive step; a whole number from 1 to 1000000000, or nothing.
        frames_per_second: frames of the recorded motion per simulated second; default at most 600 over the run [1/s]; a number > 0, or nothing.
        statistics_window: part of the records from which statistics are computed, such as "after=0.5", "last=0.2" or "after=impact"; default all; a text, or nothing.
        scheme: time integration scheme; `"generalized-alpha"`, `"hht"`, `"radau-iia"`, `"radau-iia-5"`, `"radau-iia-9"`, `"radau-iia-13"`, `"energy-decaying"`, `"backward-euler"`, or nothing.
        contacts: how contacts of shapes are solved: as `elements` with events, or as one `set`, all touches of a step at once; default: that of the scheme; `"elements"`, `"set"`, or nothing.
        end: last time [s]; a number.
        step: time step; with `relative_tolerance` the first step [s]; a number > 0, or nothing.
        relative_tolerance: tolerance of the local error of adaptive steps, relative to the motion, if `step` is omitted; default 1e-6; a number from 1e-12 to 0.1, or nothing.
        control: errors that determine adaptive steps: those of `positions` (and velocities and states), or those of `forces` (and accelerations), too; default `"positions"`; `"positions"`, `"forces"`, or nothing.
        max_step: maximum adaptive step, default a twentieth of the whole time [s]; a number > 0, or nothing.
        output_step: interval between records of adaptive steps, interpolated within them; by default steps are sampled, up to 5000 times in all [s]; a number > 0, or nothing.
        energy_check: whether a spurious increase of energy is a failure; default `true`; `true` or `false`, or nothing.
        spectral_radius: Spectral radius at infinite frequency; default 0.8; a number from 0 to 1, or nothing.
        alpha: Numerical damping; default -0.1; a number from -0.3333 to 0, or nothing.
    """

    _form: ClassVar[str] = "dynamics"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "pivoting", "strict"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts", "still-axes"]] | None = None
    output_every: Count | None = None
    frames_per_second: Number | None = None
    statistics_window: str | None = None
    scheme: Literal["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "radau-iia-9", "radau-iia-13", "energy-decaying", "backward-euler"] | None = None
    contacts: Literal["elements", "set"] | None = None
    end: Number
    step: Number | None = None
    relative_tolerance: Number | None = None
    control: Literal["positions", "forces"] | None = None
    max_step: Number | None = None
    output_step: Number | None = None
    energy_check: bool | None = None
    spectral_radius: Number | None = None
    alpha: Number | None = None


@dataclass(kw_only=True, slots=True)
class Statics(Analysis):
    """Equilibrium in load steps.

    Args:
        start: first time; default 0 [s]; a number, or nothing.
        scaling: scale of the equations; default `"physical"`; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: equilibration of rows and columns of the scaled tangent; default `true`; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term; default `true`; `true` or `false`, or nothing.
        penalty: factor of the augmented term; default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"pivoting"`, `"strict"`, or nothing.
        tolerance: tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8; a number > 0, or nothing.
        max_iterations: maximum number of Newton iterations; default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be disabled, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, `"still-axes"`, or nothing.
        output_every: number of steps between records; default: every step, or several records in each adaptive step; a whole number from 1 to 1000000000, or nothing.
        frames_per_second: frames of the recorded motion per simulated second; default at most 600 over the run [1/s]; a number > 0, or nothing.
        statistics_window: part of the records from which statistics are computed, such as "after=0.5", "last=0.2" or "after=impact"; default all; a text, or nothing.
        end: last time; default 1 [s]; a number, or nothing.
        steps: number of load steps; default: adaptive, by contraction and error; a whole number from 1 to 1000000, or nothing.
        relative_tolerance: tolerance of the relative work error of adaptive load steps; default 0.01; a number > 0, or nothing.
        ramp: whether gravity and constant loads are ramped from zero over the load steps; default `true`; `true` or `false`, or nothing.
    """

    _form: ClassVar[str] = "statics"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "pivoting", "strict"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts", "still-axes"]] | None = None
    output_every: Count | None = None
    frames_per_second: Number | None = None
    statistics_window: str | None = None
    end: Number | None = None
    steps: Count | None = None
    relative_tolerance: Number | None = None
    ramp: bool | None = None


@dataclass(kw_only=True, slots=True)
class Path(Analysis):
    """Equilibrium path under loads times a load factor, or along a number of the model, through limit points, by arc length.

    Args:
        start: instant at which loads and drives are evaluated; default 1 [s]; a number, or nothing.
        scaling: scale of the equations; default `"physical"`; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: equilibration of rows and columns of the scaled tangent; default `true`; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term; default `true`; `true` or `false`, or nothing.
        penalty: factor of the augmented term; default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"pivoting"`, `"strict"`, or nothing.
        tolerance: tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8; a number > 0, or nothing.
        max_iterations: maximum number of Newton iterations; default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be disabled, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, `"still-axes"`, or nothing.
        end: load factor at which the path ends; with `vary` the value at which it ends, which is required then; default 1; a number, or nothing.
        step: first step of the load factor or of the number, default a fiftieth of the range; a number > 0, or nothing.
        steps: maximum number of steps; default 1000; a whole number from 1 to 1000000, or nothing.
        vary: number of the model file that is varied from its value there, such as `parameters.height`; default: the load factor; a text, or nothing.
        branch: number of the bifurcation at which the path continues on the branch, from 1; negative for the opposite direction of the branch, zero for none; default 0; a number from -1000 to 1000, or nothing.
    """

    _form: ClassVar[str] = "path"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "pivoting", "strict"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts", "still-axes"]] | None = None
    end: Number | None = None
    step: Number | None = None
    steps: Count | None = None
    vary: str | None = None
    branch: Number | None = None


@dataclass(kw_only=True, slots=True)
class Buckling(Analysis):
    """Buckling load factors, by a linear estimate.

    Args:
        start: instant at which loads and drives are evaluated; default 1 [s]; a number, or nothing.
        scaling: scale of the equations; default `"physical"`; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: equilibration of rows and columns of the scaled tangent; default `true`; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term; default `true`; `true` or `false`, or nothing.
        penalty: factor of the augmented term; default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"pivoting"`, `"strict"`, or nothing.
        tolerance: tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8; a number > 0, or nothing.
        max_iterations: maximum number of Newton iterations; default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be disabled, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, `"still-axes"`, or nothing.
        count: number of load factors; default 5; a whole number from 1 to 10000, or nothing.
    """

    _form: ClassVar[str] = "buckling"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "pivoting", "strict"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts", "still-axes"]] | None = None
    count: Count | None = None


@dataclass(kw_only=True, slots=True)
class Modes(Analysis):
    """Natural modes about a state at rest.

    Args:
        start: first time; default 0 [s]; a number, or nothing.
        scaling: scale of the equations; default `"physical"`; `"physical"`, `"unit"`, `"none"`, or nothing.
        equilibrated: equilibration of rows and columns of the scaled tangent; default `true`; `true` or `false`, or nothing.
        augmented: with the augmented Lagrangian term; default `true`; `true` or `false`, or nothing.
        penalty: factor of the augmented term; default 1e-3; a number ≥ 0, or nothing.
        solver: linear solver; `"sparse"`, `"pivoting"`, `"strict"`, or nothing.
        tolerance: tolerance of Newton's iteration, in scaled units, where it is not that of adaptive steps, a thousandth of `relative_tolerance`, or that of the scheme; default 1e-8; a number > 0, or nothing.
        max_iterations: maximum number of Newton iterations; default 40; a whole number from 1 to 10000, or nothing.
        without: optional features of the nonlinear solver to be disabled, for studies; default none; a list of `"prediction"`, `"secants"`, `"single-correction"`, `"account"`, `"back-off"`, `"start-stresses"`, `"parts"`, `"still-axes"`, or nothing.
        count: number of modes; default 20; a whole number from 1 to 100000, or nothing.
        about: static equilibrium under the loads at the time `start`, or the undeformed state without loads and gravity; default `"static"`; `"static"`, `"undeformed"`, or nothing.
        shift: frequency near which modes are computed; default: the lowest ones [Hz]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "modes"

    start: Number | None = None
    scaling: Literal["physical", "unit", "none"] | None = None
    equilibrated: bool | None = None
    augmented: bool | None = None
    penalty: Number | None = None
    solver: Literal["sparse", "pivoting", "strict"] | None = None
    tolerance: Number | None = None
    max_iterations: Count | None = None
    without: list[Literal["prediction", "secants", "single-correction", "account", "back-off", "start-stresses", "parts", "still-axes"]] | None = None
    count: Count | None = None
    about: Literal["static", "undeformed"] | None = None
    shift: Number | None = None
