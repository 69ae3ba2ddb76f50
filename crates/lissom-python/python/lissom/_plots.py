"""Pictures with matplotlib, which only these calls need."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._analyses import Response
    from ._result import Result
    from ._sweep import SweepTable


def figure_of(rows: int, width: float = 8.0, height: float = 2.6) -> tuple[Any, Any]:
    try:
        import matplotlib.pyplot as pyplot
    except ImportError:
        raise ImportError("plots need matplotlib: pip install matplotlib") from None
    figure, axes = pyplot.subplots(
        rows, 1, sharex=True, squeeze=False, figsize=(width, height * rows + 0.6), layout="constrained"
    )
    return figure, axes[:, 0]


def result_figure(result: Result, names: Sequence[str], label: str) -> Any:
    """Columns over time, one picture for each output, or for each name that is given."""
    groups: dict[str, list[str]] = {}
    for column in result.names:
        groups.setdefault(column.rsplit(".", 1)[0], []).append(column)
    chosen: list[tuple[str, list[str]]] = []
    for name in names or groups:
        if name in groups:
            chosen.append((name, groups[name]))
        else:
            chosen.append((name, [result._name(name)]))
    if not chosen:
        raise ValueError("there is nothing to plot: the model records no outputs")
    figure, axes = figure_of(len(chosen))
    for ax, (group, columns) in zip(axes, chosen):
        for column in columns:
            ax.plot(result.time, result[column], label=column.rsplit(".", 1)[-1])
        units = list(dict.fromkeys(result.units[column] for column in columns))
        ax.set_ylabel(f"{group} [{', '.join(units)}]" if any(units) else group)
        if len(columns) > 1:
            ax.legend(loc="upper right", fontsize="small")
        ax.grid(True, alpha=0.3)
    axes[-1].set_xlabel(label)
    title = result.summary.get("title")
    if title:
        figure.suptitle(title)
    return figure


def bode_figure(response: Response) -> Any:
    """Magnitudes and phases over frequency."""
    figure, (above, below) = figure_of(2)
    for name in response:
        amplitudes = response[name]
        unit = response.units[name]
        above.loglog(response.frequencies, np.abs(amplitudes), label=f"{name} [{unit}]" if unit else name)
        below.semilogx(response.frequencies, np.degrees(np.angle(amplitudes)), label=name)
    above.set_ylabel("magnitude")
    below.set_ylabel("phase [°]")
    below.set_xlabel("frequency [Hz]")
    above.legend(fontsize="small")
    for ax in (above, below):
        ax.grid(True, which="both", alpha=0.3)
    return figure


def _solved(table: SweepTable) -> dict[str, tuple[Any, list[str]]]:
    """Numbers of the solved members by column; words are numbered in the order of their occurrence, and listed."""
    solved = table["state"] == "solved"
    if not solved.any():
        raise ValueError("there is nothing to plot: no member is solved")
    columns: dict[str, tuple[Any, list[str]]] = {}
    for name in [*table.varied, *table.collected]:
        values = table[name][solved]
        if values.dtype == object:
            words = list(dict.fromkeys(values))
            columns[name] = (np.array([words.index(word) for word in values], dtype=np.float64), words)
        else:
            columns[name] = (values, [])
    return columns


def sweep_figure(table: SweepTable) -> Any:
    """A panel for each pair of a varied and a collected column."""
    columns = _solved(table)
    try:
        import matplotlib.pyplot as pyplot
    except ImportError:
        raise ImportError("plots need matplotlib: pip install matplotlib") from None
    shape = (len(table.collected), len(table.varied))
    size = (3.2 * shape[1] + 0.8, 2.4 * shape[0] + 0.6)
    figure, axes = pyplot.subplots(*shape, sharex="col", sharey="row", squeeze=False, figsize=size, layout="constrained")
    for row, above in enumerate(table.collected):
        for column, below in enumerate(table.varied):
            ax = axes[row, column]
            (x, words), (y, _) = columns[below], columns[above]
            ax.plot(x, y, ".", markersize=3, color=f"C{row}")
            if words:
                ax.set_xticks(range(len(words)), words)
            ax.grid(True, alpha=0.3)
            if row == shape[0] - 1:
                ax.set_xlabel(below)
            if column == 0:
                ax.set_ylabel(above)
    return figure


def parallel_figure(table: SweepTable) -> Any:
    """A line per member across one axis per column, each from its minimum to its maximum."""
    columns = _solved(table)
    figure, (ax,) = figure_of(1, width=max(6.0, 1.6 * len(columns)), height=4.0)
    heights = []
    for number, (name, (values, words)) in enumerate(columns.items()):
        low, high = float(values.min()), float(values.max())
        heights.append((values - low) / (high - low) if high > low else np.full(len(values), 0.5))
        ax.axvline(number, color="k", linewidth=0.8)
        for height, value in ((0.0, low), (1.0, high)):
            text = words[int(value)] if words else f"{value:.4g}"
            ax.annotate(text, (number, height), xytext=(3, 3), textcoords="offset points", fontsize="small")
    import matplotlib

    lines = np.array(heights).T
    colours = matplotlib.colormaps["viridis"](lines[:, -1])
    for line, colour in zip(lines, colours):
        ax.plot(range(len(columns)), line, color=colour, linewidth=0.8, alpha=0.5)
    ax.set_xticks(range(len(columns)), list(columns), rotation=15)
    ax.set_yticks([])
    return figure
