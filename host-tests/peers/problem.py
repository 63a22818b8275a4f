"""A session as a least-squares problem: whitened residuals of free runs as a function of a robot.

A column's residuals are divided by what they are without a gap, and by the square root of the rows that one independent
number takes there, so that the sum of squares counts independent numbers of unit variance.
"""

import csv
from dataclasses import dataclass

import numpy as np

from peers.mistakes import Refused
from peers.residuals import Floor, residuals
from peers.robot_file import moved, uncertain
from peers.session import Run

# Steps of the differences by the nuisance numbers [their sigmas].
STEP = 0.2


@dataclass
class Problem:
    """What is fitted: the nominal robot, recordings, horizon [s] and the floor."""

    tool: object
    robot: dict
    runs: list
    horizon: float
    floor: Floor
    calls: int = 0

    @classmethod
    def of(cls, tool, session, horizon, rows):
        """The session's problem, with as many of its rows as one may predict at a time."""
        runs = shortened(session.runs, rows, tool.folder)
        return cls(tool, session.robot, runs, horizon, Floor.replayed(tool, session, horizon, runs))

    @property
    def known(self):
        """How many nominal numbers may be off."""
        return len(uncertain(self.robot))

    def numbers(self):
        """How many independent numbers were measured."""
        return sum(
            np.isfinite(run.columns[name]).sum() / rows
            for run in self.runs
            for name, rows in self.floor.rows.items()
            if name in run.columns
        )

    def residual(self, robot):
        """The whitened residuals of a robot; large ones where the program will not simulate it."""
        self.calls += 1
        parts = []
        for run in self.runs:
            try:
                found = residuals(self.tool, robot, run, self.horizon, self.robot)
            except Refused:
                found = {name: np.full(len(run.time), 1e3) for name in self.floor.size}
            for name, size in self.floor.size.items():
                if name in run.columns:
                    there = np.isfinite(run.columns[name])
                    parts.append(found[name][there] / (size * np.sqrt(self.floor.rows[name])))
        whole = np.concatenate(parts)
        return np.where(np.isfinite(whole), np.clip(whole, -1e3, 1e3), 1e3)

    def nuisance(self, z, residual, put=lambda robot: robot):
        """The changes of the residuals by the nominal numbers, a column each, at z and with a cause put in."""
        columns = []
        for k in range(self.known):
            beside = np.array(z, dtype=float)
            beside[k] += STEP
            columns.append((self.residual(put(moved(self.robot, beside))) - residual) / STEP)
        return np.column_stack(columns)


def shortened(runs, rows, folder):
    """Runs with at most so many rows together: each keeps its beginning."""
    total = sum(len(run.time) for run in runs)
    if total <= rows:
        return runs
    return [beginning(run, max(2, len(run.time) * rows // total), folder / f"short{k}.csv") for k, run in enumerate(runs)]


def beginning(run, rows, path):
    """The first rows of a run, as a file of its own."""
    with run.path.open(encoding="utf-8", newline="") as whole, path.open("w", encoding="utf-8", newline="") as file:
        written = csv.writer(file)
        for _, row in zip(range(rows + 1), (row for row in csv.reader(whole) if row), strict=False):
            written.writerow(row)
    return Run.read(path)
