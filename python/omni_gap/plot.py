"""Charts of answers through matplotlib, for those who want their own; ``pip install omni-gap[plot]`` brings it.

Each function draws into ``axes`` where they are given, else into a new figure, and returns the figure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._omni_gap import OmniGapError
from ._results import Diagnosis, WithSignals

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MEASURED = "measured"
# Colours that differ in lightness too, and for those who see fewer of them.
COLOURS = {MEASURED: "0.35", 0: "#c1443c", 1: "#2a6fbb"}


def signals(answer: WithSignals, *, axes: Any = None) -> Figure:
    """Draws each measured signal, and what the models say of it, over time (s).

    Args:
        answer: A diagnosis or a comparison.
        axes: One a panel.
    """
    told = answer.signals
    figure, axes = _panels(told, axes)
    for panel, one in zip(told["panels"], axes):
        for name, colour in _named(panel):
            _line(one, panel["t_s"], panel["series"][name], color=colour, label=name)
        one.set_ylabel(_label(panel))
    _finish(axes, told["caption"])
    return figure


def residuals(answer: WithSignals, *, axes: Any = None) -> Figure:
    """Draws what was measured less what each model says, over time (s); a heading's difference within half a turn.

    Args:
        answer: A diagnosis or a comparison.
        axes: One a panel.
    """
    told = answer.signals
    figure, axes = _panels(told, axes)
    for panel, one in zip(told["panels"], axes):
        measured = panel["series"][MEASURED]
        for name, colour in _named(panel):
            if name == MEASURED:
                continue
            apart = measured - panel["series"][name]
            if panel["unit"] == "rad":
                apart = np.remainder(apart + np.pi, 2 * np.pi) - np.pi
            _line(one, panel["t_s"], apart, color=colour, label=f"measured − {name}")
        one.axhline(0.0, color="0.7", linewidth=0.8, zorder=0)
        one.set_ylabel(_label(panel))
    _finish(axes, told["caption"])
    return figure


def gap(diagnosis: Diagnosis, *, ax: Optional[Axes] = None) -> Figure:
    """Draws the error of the free runs by group of signals, by the nominal and the corrected model.

    In units of each sensor's noise (σ), beside the error that a perfect model would have, the noise floor.

    Args:
        diagnosis: The diagnosis; with the verdict ``unfit_data`` there is nothing to draw.
        ax: Where to draw.
    """
    groups = diagnosis.to_dict()["gap"]["signals"]
    if not groups:
        raise OmniGapError("no gap was measured: the recordings could not be used. See the diagnosis' faults")
    figure, ax = _one(ax)
    places, width = np.arange(len(groups)), 0.38
    for at, model in enumerate(["before", "after"]):
        name = ["nominal", "corrected"][at]
        ax.bar(places + (at - 0.5) * width, [group[model] for group in groups.values()], width, color=COLOURS[at], label=name)
    floors = [group["noise_floor"] for group in groups.values()]
    ax.hlines(floors, places - width, places + width, color="0.15", label="noise floor")
    ax.set_xticks(places, list(groups))
    ax.set_ylabel("error of free runs (σ)")
    ax.set_title(repr(diagnosis), loc="left", fontsize="medium")
    ax.margins(y=0.3)
    ax.legend(fontsize="small", ncols=3)
    return figure


def which(diagnosis: Diagnosis, *, most: int = 8, ax: Optional[Axes] = None) -> Figure:
    """Draws the probability of each cause that was considered.

    Args:
        diagnosis: The diagnosis.
        most: How many causes, the most probable first.
        ax: Where to draw.
    """
    found = diagnosis.findings[:most]
    if not found:
        raise OmniGapError("no cause was considered: there was no gap, or the recordings could not be used")
    figure, ax = _one(ax)
    names = [cause["cause"] for cause in found][::-1]
    ax.barh(names, [cause["probability"] for cause in found][::-1], color=COLOURS[1])
    ax.set_xlim(0, 1)
    ax.set_xlabel("probability")
    ax.set_title(repr(diagnosis), loc="left", fontsize="medium")
    return figure


def _named(panel: dict[str, Any]) -> list[tuple[str, str]]:
    """The series of a panel, what was measured first, with their colours."""
    models = [name for name in panel["series"] if name != MEASURED]
    return [(MEASURED, COLOURS[MEASURED])] + [(name, COLOURS[at % 2]) for at, name in enumerate(models)]


def _line(ax: Axes, t_s: np.ndarray, values: np.ndarray, **how: Any) -> None:
    """A line through the samples that are there: a camera has fewer frames than there are rows."""
    there = ~np.isnan(values)
    dots = "." if there.sum() < 0.75 * len(values) else ""
    ax.plot(t_s[there], values[there], linewidth=1.1, marker=dots, markersize=3, **how)


def _label(panel: dict[str, Any]) -> str:
    return f"{panel['title']}\n({panel['unit']})"


def _pyplot() -> Any:
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise OmniGapError("matplotlib is not installed. Install it: pip install omni-gap[plot]") from None
    return plt


def _figure(ax: Any) -> Any:
    return ax.figure


def _one(ax: Optional[Axes]) -> tuple[Figure, Axes]:
    if ax is not None:
        return _figure(ax), ax
    figure, ax = _pyplot().subplots(figsize=(7, 3.6), layout="constrained")
    return figure, ax


def _panels(told: dict[str, Any], axes: Any) -> tuple[Figure, list[Axes]]:
    count = len(told["panels"])
    if count == 0:
        raise OmniGapError("there are no signals to draw: the recordings could not be used. See the answer's faults")
    if axes is None:
        figure, axes = _pyplot().subplots(count, 1, sharex=True, squeeze=False, figsize=(8, 1.7 * count), layout="constrained")
    axes = list(np.ravel(axes))
    if len(axes) != count:
        raise OmniGapError(f"axes: found {len(axes)}, expected {count}, one a panel. Give as many")
    return _figure(axes[0]), axes


def _finish(axes: list[Axes], caption: str) -> None:
    axes[0].legend(loc="upper right", fontsize="small", ncols=3)
    axes[0].set_title(caption, loc="left", fontsize="small", wrap=True)
    axes[-1].set_xlabel("time (s)")

