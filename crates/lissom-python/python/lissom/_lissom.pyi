"""The compiled part of the package."""

import os
from typing import Any, Callable, Literal, Mapping, Optional, Sequence, Union, final, overload

import numpy as np
import numpy.typing as npt

from ._linear import LinearModel
from ._tables import Files
from ._types import Array, Outcome, Parts

#: Numbers in an array, a list or alone.
_Numbers = Union[float, Sequence[float], Sequence[Sequence[float]], npt.NDArray[Any]]
_JointValues = Union[Mapping[str, _Numbers], _Numbers]
_View = Literal["chosen", "oblique", "front", "side", "top"]
_Progress = Optional[Callable[[float, float], object]]

__version__: str

class LissomError(Exception):
    """Base class of the exceptions of this package.

    The text is that of the command line. `code` identifies the failure, as in `lissom explain`; `values` has its numbers and
    names, in SI units. `time`, `part` and `remedy` are parts of the text. They are None if absent.
    """

    code: Optional[str]
    """Code in the catalogue of failures, such as `not-converged`."""
    values: Mapping[str, Union[float, int, bool, str]]
    """Values by name, without the time."""
    time: Optional[float]
    """Time of the failure [s]."""
    part: Optional[str]
    """Part concerned: a table of the model file, such as `joints.hinge`, or a name."""
    remedy: Optional[str]
    """Remedy."""

class ModelError(LissomError):
    """A model, a sweep or a request is invalid. The text underlines every error, with a remedy.

    `problems` has them as `lissom check --json` does: dictionaries of `severity`, `message`, `help` and, if known, `part`,
    `file`, `line`, `column`. `part` and `remedy` are those of the first.
    """

    problems: tuple[dict[str, Any], ...]

class SolutionError(LissomError):
    """A model has no solution. The text states the time, the part, the cause and a remedy."""

    result: Any
    """The `lissom.Result` of a run up to its failure; None otherwise."""

@final
class NativeModel:
    def __new__(
        cls, text: str, name: str, overrides: list[tuple[str, str]], known: dict[str, str] = ...
    ) -> NativeModel: ...
    @staticmethod
    def read(path: str, overrides: list[tuple[str, str]]) -> NativeModel: ...
    def __getnewargs__(self) -> tuple[str, str, list[tuple[str, str]], dict[str, str]]: ...
    @property
    def name(self) -> str: ...
    @property
    def overrides(self) -> list[tuple[str, str]]: ...
    def replace(self, overrides: list[tuple[str, str]]) -> NativeModel: ...
    def to_toml(self) -> str: ...
    def check(self) -> dict[str, Any]: ...
    def run(self, progress: _Progress, threads: Optional[int]) -> tuple[Parts, Optional[SolutionError]]: ...
    def simulation(self) -> Simulation: ...
    def restored(self, snapshot: bytes, coordinates: Optional[Sequence[str]]) -> Simulation: ...
    def simulations(self, count: int) -> Batch: ...

@final
class Simulation:
    """A model on its way, made by `Model.simulation()`.

    `sim["arm.angle"]` is the present value of a column, in SI units. The interpreter lock is released while stepping.
    """

    def step(self) -> None:
        """Takes one step: the next planned one, or one that is as long as its error allows. On failure the simulation
        stays where it was.

        Raises `SolutionError` if the step has no solution, `ValueError` at the end of the model's analysis.
        """
    def step_to(self, time: float) -> None:
        """Goes on to `time` [s], which is met exactly; beyond the end of the model's analysis, too. Stands still before it
        at an event that ends the run, which `stopped_by` names.

        Raises `SolutionError` if a step has no solution: the simulation is then at the end of the last successful step.
        Raises `ValueError` if `time` is before the present time or not finite.
        """
    @property
    def time(self) -> float:
        """Present time [s]."""
    @property
    def end(self) -> float:
        """End of the model's analysis [s]."""
    @property
    def is_finished(self) -> bool:
        """Whether that end is reached."""
    @property
    def stopped_by(self) -> Optional[str]:
        """Name of the event at which the simulation stands, if that is to end the run."""
    @property
    def events(self) -> list[tuple[str, float]]:
        """Names and times [s] of the events that have happened."""
    @property
    def warnings(self) -> list[str]:
        """Warnings about the results so far, as in `summary.json`. Each is also issued once as a `ModelWarning`."""
    @property
    def names(self) -> list[str]:
        """Names of the columns, in the order of `values`."""
    @property
    def units(self) -> list[str]:
        """Units of the columns, in the order of `values`."""
    def values(self) -> Array:
        """Present values of all columns: an array of shape (number of columns,), in SI units."""
    @overload
    def __getitem__(self, names: str, /) -> float: ...  # type: ignore[overload-overlap]
    @overload
    def __getitem__(self, names: Sequence[str], /) -> Array:
        """Present value of a column, a signal, an input or a state, in SI units; with a list of names an array of their values."""
    @property
    def inputs(self) -> list[str]:
        """Names of the inputs, in the order of the model file."""
    @overload
    def set(self, inputs: str, values: float) -> None: ...
    @overload
    def set(self, inputs: Mapping[str, float], values: None = None) -> None: ...
    @overload
    def set(self, inputs: Sequence[str], values: Union[Sequence[float], Array]) -> None:
        """Sets inputs of the model from now on, until they are set again: `set("torque", 0.5)`, `set({"torque": 0.5, "brake": 1})`,
        or `set(names, values)` with a list of names and a list or array of as many values. Several inputs that are set at once
        cost as much as one.

        Raises `ValueError` if the model has no such input or a value is not finite, `SolutionError` if there is no
        consistent start with them; then none is set.
        """
    def coordinates(self, names: Optional[Sequence[str]] = None) -> list[str]:
        """Names of the independent joint coordinates, such as `["shoulder.angle", "elbow.angle"]`; with `names` these are chosen,
        as many as degrees of freedom of the parts that joints connect with them; other parts, such as free bodies, move apart. By
        default they are those of joints with a `joint_torque` or `joint_force`, or otherwise those of all joints with one
        coordinate, in the order of the joints in the model file. A robot that floats has one more name at the beginning: that of
        its base, a free body, which stands for seven values and six rates.

        Raises `ValueError` if a name is unknown, or they are not as many as those degrees of freedom.
        """
    def joint_state(self) -> tuple[Array, Array]:
        """Values [rad, m] and rates [rad/s, m/s] of the joint coordinates, two arrays in the order of `coordinates()`. A base has its
        position x, y, z and quaternion q0 … q3 in global axes, and its velocity and angular velocity in its own axes.
        """
    def mass_matrix(self) -> Array:
        """Mass matrix H of `H q̈ + h = τ`, the equations of motion in the joint coordinates q, in the order of `coordinates()`; τ are the
        forces of `joint_torque` and `joint_force` loads on them. An array of shape (number of rates, number of rates): a base has the
        first six, its velocity and angular velocity in its own axes.

        Raises `ValueError` if there are no joint coordinates, `SolutionError` if they depend on each other in this position.
        """
    def bias(self) -> Array:
        """h of `H q̈ + h = τ`: all forces on the joint coordinates that are not τ, with the opposite sign, such as those of gravity,
        velocities, springs, friction and other loads [N m, N]. Friction that depends on normal forces is that of the present ones.

        Raises as `mass_matrix`.
        """
    def inverse_dynamics(self, accelerations: Union[Sequence[float], npt.NDArray[Any]]) -> Array:
        """Forces of `joint_torque` and `joint_force` loads at which the joint coordinates have these accelerations [rad/s², m/s²]:
        `mass_matrix() @ accelerations + bias()` [N m, N].

        Raises as `mass_matrix`; `ValueError` if their number is not that of the coordinates.
        """
    def jacobian(self, output: str) -> Array:
        """Jacobian of an output with respect to the joint coordinates, of one of velocities with respect to their rates: an array of
        shape (number of components, number of coordinates). Outputs of the position and of the velocity of a point have the same one.

        Raises as `mass_matrix`; `ValueError` if there is no such output, or it depends on accelerations or forces.
        """
    def reset(self, q: Optional[_JointValues] = None, v: Optional[_JointValues] = None) -> None:
        """Starts again at the start time, with these values `q` of joint coordinates [rad, m] and rates `v` [rad/s, m/s]: dictionaries, or
        arrays in the order of `coordinates()`; a base is given by a list of seven values or six rates. Parts are moved such that all
        joints close, and a base that is not named stays where it was. Coordinates that are not named stay where
        they were at the model's start if they can, and rates that are not named are zero. Inputs are those of the model. Without
        arguments this is the start of the model, with its velocities.

        Raises `SolutionError` if the joints do not close with these values, or coordinates are not independent there; `ValueError`
        if a name is unknown or a value not finite. The simulation is then as it was.
        """
    def linearize(self, inputs: Union[str, Sequence[str]] = ..., outputs: Union[str, Sequence[str]] = ...) -> LinearModel:
        """The model linearised where the simulation stands, a `lissom.LinearModel`: what `model.linearize` gives about this
        time. `inputs` name inputs, loads and prescribed motions, `outputs` outputs or columns of them.

        Raises `ModelError` if there is no such input or output, `SolutionError` if the model is at rest without being in
        equilibrium.
        """
    def picture(
        self,
        size: Sequence[int] = ...,
        view: _View = ...,
        center: Optional[Sequence[float]] = None,
        extent: Optional[float] = None,
    ) -> npt.NDArray[np.uint8]:
        """Picture of the present state as `lissom snapshot` draws it, without title and forces: red, green and blue, an array of
        shape (height, width, 3) and type uint8. `size` is (width, height), `view` is `"chosen"`, `"oblique"`, `"front"`, `"side"` or
        `"top"`. `center` [m] is the position in the middle, `extent` [m] the length of the shorter side; by default they show the
        model at its start. The frame does not depend on the motion.

        Raises `ValueError` if there is no such view, or a size is not positive or too large.
        """
    def snapshot(self) -> bytes:
        """Where the simulation stands, as bytes that can be kept, sent and pickled."""
    def __reduce__(self) -> tuple[Any, ...]: ...
    def restore(self, snapshot: bytes) -> None:
        """Goes back, or on, to where a snapshot of the same model was taken; from there to the same results, bit by bit.

        Raises `ValueError` if the bytes are no snapshot of this model and version; the simulation is then as it was.
        """

@final
class Batch:
    """Simulations of one model that advance together, made by `Model.simulations(count)`.

    All processors work on them, with the interpreter lock released. A simulation without a solution stays where it was, with NaN
    as its values, until it is reset; the others continue. `failed` and `errors` report it, and a `SolutionWarning` is issued.
    """

    def __len__(self) -> int: ...
    @overload
    def set(self, inputs: Union[Mapping[str, _Numbers], _Numbers], values: None = None) -> None: ...
    @overload
    def set(self, inputs: Union[str, Sequence[str]], values: _Numbers) -> None:
        """Sets inputs of all simulations from now on, until they are set again: `set(array)` with an array of shape (count, number of
        inputs), in the order of `inputs`; `set(names, array)` with some of them; `set("torque", values)` and `set({"torque": values})`
        with one value per simulation. Arrays of fewer dimensions, and single numbers, are the same for all.

        Raises `ValueError` if the model has no such input, a shape does not fit or a value is not finite; then none is set.
        """
    def step(self) -> None:
        """Performs one step of every simulation: the next planned one, or one whose size is limited by its error.

        Raises `ValueError` if a simulation is at the end of the model's analysis or at an event that ends the run; then none is
        advanced.
        """
    def step_to(self, time: _Numbers) -> None:
        """Advances all simulations to `time` [s] exactly, one time for all or one for each: `step_to(batch.time + 0.01)`. A simulation
        stops before it at an event that ends its run, which `stopped_by` names.

        Raises `ValueError` if a time is before the present time of its simulation or not finite; then none is advanced.
        """
    def coordinates(self, names: Optional[Sequence[str]] = None) -> list[str]:
        """Names of the independent joint coordinates, in the order of the model file; with `names` these are chosen, as
        `Simulation.coordinates` does.
        """
    def reset(
        self,
        members: Union[None, Sequence[int], npt.NDArray[np.bool_], npt.NDArray[np.integer[Any]]] = None,
        q: Optional[_JointValues] = None,
        v: Optional[_JointValues] = None,
    ) -> None:
        """Starts simulations again, with the inputs of the model: all, or those that a mask or a list of indices selects. This is also
        how a simulation without a solution continues. With values `q` of joint coordinates and rates `v`, arrays of shape (number of
        selected simulations, number of `coordinates()`) or dictionaries of arrays, as `Simulation.reset` does; arrays of fewer
        dimensions, and single numbers, are the same for all.

        Raises `ValueError` if a name is unknown or a shape does not fit.
        """
    @property
    def time(self) -> Array:
        """Present times [s], of shape (count,)."""
    @property
    def is_finished(self) -> npt.NDArray[np.bool_]:
        """Which simulations are at the end of the model's analysis, or at an event that ends the run; of shape (count,)."""
    @property
    def stopped_by(self) -> list[Optional[str]]:
        """Name of the event at which each simulation is, if that is to end the run."""
    @property
    def failed(self) -> npt.NDArray[np.bool_]:
        """Which simulations have no solution, of shape (count,)."""
    @property
    def errors(self) -> dict[int, SolutionError]:
        """A `SolutionError` for each of these, by the index of the simulation."""
    @property
    def warnings(self) -> list[list[str]]:
        """Warnings so far of each simulation. Each code is reported once by a `ModelWarning`, for the first simulation concerned."""
    @property
    def inputs(self) -> list[str]:
        """Names of the inputs in the order of the model file, which is that of `set(array)`."""
    @property
    def names(self) -> list[str]:
        """Names of the columns, in the order of `values`."""
    @property
    def units(self) -> list[str]:
        """Units of the columns, in the order of `values`."""
    def values(self) -> Array:
        """Present values of all columns: an array of shape (count, number of columns), in SI units."""
    def __getitem__(self, names: Union[str, Sequence[str]], /) -> Array:
        """Present values of a column, a signal, an input or a state, in SI units: of shape (count,); with a list of names of shape
        (count, number of names).
        """
    def picture(
        self,
        index: int,
        size: Sequence[int] = ...,
        view: _View = ...,
        center: Optional[Sequence[float]] = None,
        extent: Optional[float] = None,
    ) -> npt.NDArray[np.uint8]:
        """Picture of one simulation, as `Simulation.picture`. A simulation without a solution is drawn where it was.

        Raises `IndexError` if there is no such simulation; `ValueError` as `Simulation.picture`.
        """

@final
class NativeSweep:
    def __new__(cls, model: NativeModel, text: str, name: str) -> NativeSweep: ...
    def __len__(self) -> int: ...
    def definition(self) -> str: ...
    def paths(self) -> list[str]: ...
    def collected(self) -> list[str]: ...
    def values(self, member: int) -> list[Any]: ...
    def solve(self, members: list[int], workers: Optional[int], progress: _Progress) -> list[Outcome]: ...
    def solve_in_folder(
        self, folder: str, restart: bool, workers: Optional[int], progress: _Progress
    ) -> list[Outcome]: ...

def analyse(model: NativeModel, name: str, request: str) -> Files: ...
def path(model: NativeModel) -> tuple[Parts, Optional[SolutionError]]: ...
def animation(model: NativeModel, threads: Optional[int]) -> str: ...
def modes_animation(model: NativeModel, request: str) -> str: ...
def folder_animation(folder: str) -> str: ...
def column_position(names: list[str], name: str) -> Optional[int]: ...
def read_folder(folder: str) -> Parts: ...
def statistics() -> tuple[dict[str, str], dict[str, str]]: ...

def serve_unit() -> None: ...
def set_unit_host(program: str | os.PathLike[str], arguments: Sequence[str]) -> None: ...
