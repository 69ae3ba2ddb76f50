# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""First-order states and events."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Number, Table


@dataclass(kw_only=True, slots=True)
class State(Entry):
    """First-order states: numbers whose derivative by time is an expression.

    Args:
        derivative: its derivative by time [1/s]; an expression of signals.
        start: value at the start, default 0; a number, or nothing.
        magnitude: how large it usually is: errors are measured by this, or by its value where that is larger; default 1; a number > 0, or nothing.
    """

    _table: ClassVar[str] = "states"

    derivative: Number
    start: Number | None = None
    magnitude: Number | None = None


@dataclass(kw_only=True, slots=True)
class Event(Entry):
    """What happens when expressions pass through zero.

    Args:
        zero_of: the event happens where this expression passes through zero; an expression of signals.
        direction: which way it passes, default `both`; `"both"`, `"rising"`, `"falling"`, or nothing.
        stop: whether the run ends there, default `false`; `true` or `false`, or nothing.
        set: inputs that change there, and expressions of what they become; a table, or nothing.
    """

    _table: ClassVar[str] = "events"

    zero_of: Number
    direction: Literal["both", "rising", "falling"] | None = None
    stop: bool | None = None
    set: Table | None = None
