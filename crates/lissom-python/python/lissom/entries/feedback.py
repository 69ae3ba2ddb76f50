# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""First-order states, events, and units of other programs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Number, Table


@dataclass(kw_only=True, slots=True)
class State(Entry):
    """First-order states: numbers whose time derivative is an expression.

    Args:
        derivative: time derivative [1/s]; an expression of signals.
        algebraic: whether the value makes `derivative` zero at all times, as that of an infinitely fast state; `start` is a first guess; default `false`; `true` or `false`, or nothing.
        start: value at the start; default 0; a number, or nothing.
        magnitude: typical magnitude, relative to which errors are measured unless its value is larger; default 1; a number > 0, or nothing.
    """

    _table: ClassVar[str] = "states"

    derivative: Number
    algebraic: bool | None = None
    start: Number | None = None
    magnitude: Number | None = None


@dataclass(kw_only=True, slots=True)
class Event(Entry):
    """Actions when expressions cross zero.

    Args:
        zero_of: the event occurs when this expression crosses zero; an expression of signals.
        direction: direction of the crossing; default `"both"`; `"both"`, `"rising"`, `"falling"`, or nothing.
        stop: whether the run ends at the event; default `false`; `true` or `false`, or nothing.
        set: inputs to be changed by the event, with expressions of their new values; a table, or nothing.
    """

    _table: ClassVar[str] = "events"

    zero_of: Number
    direction: Literal["both", "rising", "falling"] | None = None
    stop: bool | None = None
    set: Table | None = None


@dataclass(kw_only=True, slots=True)
class Unit(Entry):
    """Units (FMI) of other programs: advanced from sample to sample, or with equations that are solved with those of the model.

    Args:
        file: the unit, a file `.fmu`; path relative to this file; a text.
        sample: for co-simulation, required: time from sample to sample, over which inputs and outputs are constant [s]; a number > 0, or nothing.
        mode: for units that support both: steps of its own, or equations solved with those of the model; default the first; `"co_simulation"`, `"model_exchange"`, or nothing.
        inputs: input variables of the unit, with expressions of their values; a table, or nothing.
        outputs: output variables of the unit: `y = "VARIABLE"` is `unit.y` in expressions; a table, or nothing.
        parameters: start values of variables of the unit, numbers; a table, or nothing.
        timeout: real time after which a unit that does not answer has failed; default 60 [s]; a number > 0, or nothing.
    """

    _table: ClassVar[str] = "units"

    file: str
    sample: Number | None = None
    mode: Literal["co_simulation", "model_exchange"] | None = None
    inputs: Table | None = None
    outputs: Table | None = None
    parameters: Table | None = None
    timeout: Number | None = None
