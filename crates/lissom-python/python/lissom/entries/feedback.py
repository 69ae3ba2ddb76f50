# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""First-order states and events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Number, Table


@dataclass(kw_only=True, slots=True)
class State(Entry):
    """First-order states: numbers whose time derivative is an expression.

    Args:
        derivative: time derivative [1/s]; an expression of signals.
        start: value at the start; default 0; a number, or nothing.
        magnitude: typical magnitude, relative to which errors are measured unless its value is larger; default 1; a number > 0, or nothing.
    """

    _table: ClassVar[str] = "states"

    derivative: Number
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
