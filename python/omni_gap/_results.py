"""Answers, as objects that show themselves in a terminal and in a notebook."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Iterator, Mapping
from typing import Any, Optional

import numpy as np

from . import _omni_gap
from ._inputs import PathLike


class Answer:
    """What all answers can do."""

    def __init__(self, made: Any) -> None:
        self._made = made
        self._dict: Optional[dict[str, Any]] = None

    def to_json(self) -> str:
        """The answer as JSON: what the command writes or answers with ``--json``."""
        return self._made.json()

    def to_dict(self) -> dict[str, Any]:
        """The same as a dictionary, number for number; yours to change."""
        return json.loads(self.to_json())

    @property
    def _told(self) -> dict[str, Any]:
        if self._dict is None:
            self._dict = self.to_dict()
        return self._dict

    def __str__(self) -> str:
        """What the command says in a terminal."""
        return self._made.text()

    def __repr__(self) -> str:
        """The sentence that stands first in a terminal."""
        first = str(self).strip().split("\n\n")[0]
        return " ".join(first.split())


class Page(Answer):
    """An answer that has a page."""

    def to_html(self) -> str:
        """The page that the command writes: one file that needs no network."""
        return self._made.html()

    def _repr_html_(self) -> str:
        """The page within a notebook, in a frame of its own."""
        return (
            f'<iframe srcdoc="{html.escape(self.to_html(), quote=True)}" title="{html.escape(repr(self), quote=True)}" '
            'style="width:100%;height:42em;border:0"></iframe>'
        )

    def write(self, folder: PathLike) -> None:
        """Writes the files of the command into a folder, which is made where it is not there."""
        self._made.write(os.fspath(folder))


class WithSignals(Page):
    """An answer with charts of signals."""

    @property
    def signals(self) -> dict[str, Any]:
        """What the charts are drawn of.

        ``caption`` (which run, which stretch of it), ``restarts_s`` (where the predictions restart, s) and ``panels``: each with
        ``title``, ``unit``, ``t_s`` (shape ``(rows,)``, s) and ``series``, a dictionary of arrays of the same shape in the panel's
        unit, NaN where a sample is missing. A series ``measured`` and one for each model.
        """
        told = json.loads(self._made.signals())
        for panel in told["panels"]:
            panel["t_s"] = np.array(panel["t_s"], dtype=np.float64)
            panel["series"] = {name: np.array(row, dtype=np.float64) for name, row in panel["series"]}
        return told


class Diagnosis(WithSignals):
    """Where the gap lies, which cause it has, how far it shrinks once the cause is in the model."""

    @property
    def verdict(self) -> str:
        """``no_gap``, ``parameter``, ``effect``, ``unknown`` or ``unfit_data``."""
        return self._told["verdict"]

    @property
    def causes(self) -> list[str]:
        """The causes that were named, the one that explains most first."""
        return list(self._told["causes"])

    @property
    def findings(self) -> list[dict[str, Any]]:
        """Every cause that was considered, most probable first: ``cause``, ``probability`` (1) and its numbers in SI units."""
        return self.to_dict()["which"]

    @property
    def refitted_robot(self) -> Optional[str]:
        """The robot file (TOML) with its numbers re-fitted within their stated uncertainty; none where no model was fitted."""
        return self._made.refitted_robot

    @property
    def corrected_robot(self) -> Optional[str]:
        """The robot file (TOML) with the causes written in; none where none was named."""
        return self._made.corrected_robot

    @property
    def next_experiment(self) -> Optional[str]:
        """A script (CSV) that would tell apart causes that were not; none where nothing of the kind is open."""
        return self._made.next_experiment


class Comparison(WithSignals):
    """Which cause explains the difference between two sessions."""

    @property
    def verdict(self) -> str:
        """``alike``, ``different``, ``unknown`` or ``unfit_data``."""
        return self._told["verdict"]


class Design(Page):
    """What to record or measure, so that what a diagnosis leaves open is settled."""

    @property
    def verdict(self) -> str:
        """What the recordings so far are answered with, as :attr:`Diagnosis.verdict`."""
        return self._told["verdict"]

    @property
    def script(self) -> Optional[str]:
        """The run to play (CSV); none where there is nothing to play."""
        return self._made.script


class SelfTest(Page):
    """Which causes planned recordings could show, and from what size on."""

    @property
    def causes(self) -> list[dict[str, Any]]:
        """Every cause with the sizes from which on it is seen and named, in its ``unit``."""
        return self.to_dict()["causes"]


class Table(Answer):
    """An answer that a notebook shows as its words."""

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"


class Identification(Table):
    """The robot file's numbers, fitted, and how sure they are."""

    @property
    def robot_text(self) -> str:
        """The robot file (TOML) with the fitted numbers in it; feed it to ``tomllib.loads``, or write it to a file."""
        return self._made.robot_text

    @property
    def numbers(self) -> list[dict[str, Any]]:
        """Each number of the robot file: ``key``, ``unit``, ``nominal`` and ``fitted`` in that unit, ``relative_std`` (1)."""
        return self.to_dict()["numbers"]

    def __repr__(self) -> str:
        return " ".join(str(self).strip().splitlines()[-1].split())

    def _repr_html_(self) -> str:
        rows = self._told.get("numbers", [])
        if not rows or "fitted" not in rows[0]:
            return super()._repr_html_()
        cells = (
            f"<tr><td>{html.escape(row['key'])}</td><td>{row['nominal']:.6g}</td><td>{row['fitted']:.6g}</td>"
            f"<td>{100 * row['relative_std']:.2g} %</td><td>{html.escape(row['unit'])}</td></tr>"
            for row in rows
        )
        head = "<tr><th>parameter</th><th>nominal</th><th>fitted</th><th>± (one sigma)</th><th>unit</th></tr>"
        return f"<table>{head}{''.join(cells)}</table><p>{html.escape(repr(self))}</p>"


class Check(Table):
    """Faults of recordings, and what they can tell."""

    def __init__(self, made: tuple[str, str]) -> None:
        super().__init__(None)
        self._json, self._words = made

    def to_json(self) -> str:
        """What the command answers with ``--json``."""
        return self._json

    @property
    def usable(self) -> bool:
        """Whether a diagnosis can use the recordings."""
        return self._told["usable"]

    @property
    def faults(self) -> list[dict[str, Any]]:
        """What is wrong: ``code``, ``run``, ``signal``, ``lines``, ``sentence``, and how to mend it, ``fix``."""
        return self.to_dict()["faults"]

    def __repr__(self) -> str:
        found, runs = self._told["faults"], self._told["runs"]
        if not found:
            return f"{runs} run(s) checked: no fault found."
        fatal = sum(fault["fatal"] for fault in found)
        rest = f"{fatal} to be mended before a diagnosis" if fatal else "none of which forbids a diagnosis"
        return f"{runs} run(s) checked: {len(found)} fault(s), {rest}."

    def __str__(self) -> str:
        said = [f"[{fault['code']}] {fault['run']}: {fault['sentence']} {fault['fix']}" for fault in self._told["faults"]]
        return "\n".join([*said, repr(self), "", self._words]).rstrip() + "\n"


class Run(Mapping):
    """A recording: named columns, each an array of float64 of shape ``(rows,)`` in the unit that its name ends with.

    NaN marks a sample that is missing. A mapping of names to arrays, and so a recording that every function takes.
    """

    def __init__(self, made: _omni_gap.Run) -> None:
        self._made = made
        self._columns = {name: np.frombuffer(doubles) for name, doubles in made.columns()}

    @property
    def name(self) -> str:
        """What the run is called."""
        return self._made.name

    def __getitem__(self, column: str) -> np.ndarray:
        return self._columns[column]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    # arrays have no truth value, and so runs are one only where they are the same
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def to_dict(self) -> dict[str, np.ndarray]:
        """Copies of the columns by name."""
        return {name: column.copy() for name, column in self._columns.items()}

    def write(self, path: PathLike) -> None:
        """Writes the file that the command writes: ``.csv``, ``.parquet`` or ``.mcap``."""
        self._made.write(os.fspath(path))

    def __repr__(self) -> str:
        return f"run {self.name}: {len(self['t_s'])} rows of {', '.join(self)}"

    def _repr_html_(self) -> str:
        heads = "".join(f"<th>{html.escape(name)}</th>" for name in self)
        rows = ("".join(f"<td>{self[name][row]:.6g}</td>" for name in self) for row in range(min(5, len(self["t_s"]))))
        body = "".join(f"<tr>{row}</tr>" for row in rows)
        return f"<table><tr>{heads}</tr>{body}</table><p>{html.escape(repr(self))}</p>"
