"""A session's stage residuals and regressors as one regression, y = X c, rows in units of what they are without a gap.

Each stage's channel is divided by its robust size in replays of the nominal robot: 1.4826 times the median of |y| (Huber,
Robust Statistics, 1981). Rows beyond a limit are drawn in to it together with their regressors, as an M-estimator weighs them.
"""

from dataclasses import dataclass

import numpy as np

from peers.library import Library
from peers.session import Run
from peers.stages import Motion

# Rows of the regression at most, and the residual from which on a row counts less.
ROWS, LIMIT = 12000, 20.0


@dataclass(frozen=True)
class Design:
    """A regression: `named` has (cause, wheel) of each column of `terms`, `stage` the stage of each row."""

    y: np.ndarray
    terms: np.ndarray
    named: list
    stage: np.ndarray

    @classmethod
    def of(cls, tool, session):
        """The session's regression."""
        scales = sizes([Motion(session.robot, run) for run in replays(tool, session)])
        parts = [assembled(Motion(session.robot, run), scales) for run in session.runs]
        y, terms, stage = (np.concatenate([part[k] for part in parts]) for k in range(3))
        step = max(1, -(-y.size // ROWS))
        return cls(y[::step], terms[::step], parts[0][3], stage[::step])


def replays(tool, session):
    """What the nominal robot records over the same inputs."""
    for k, run in enumerate(session.runs):
        yield Run.read(tool.simulate(session.robot, run.path, k, tool.folder / "replay.csv"))


def sizes(motions):
    """The robust size of each stage's channels."""
    pooled = {}
    for motion in motions:
        for stage, values in motion.residuals().items():
            pooled.setdefault(stage, []).append(values)
    whole = {stage: np.concatenate(values) for stage, values in pooled.items()}
    return {stage: robust(values) for stage, values in whole.items()}


def robust(values):
    """1.4826 times the median of the sizes, by column; never 0."""
    found = np.zeros(values.shape[1])
    for k, column in enumerate(values.T):
        there = column[np.isfinite(column)]
        found[k] = 1.4826 * np.median(np.abs(there)) if there.size else 1.0
    return np.maximum(found, 1e-6)


def assembled(motion, scales):
    """y, X and stages of a run, and the names of the columns."""
    columns = Library(motion).columns()
    measured = {stage: values for stage, values in motion.residuals().items() if stage in scales}
    ys, terms, stages = [], [], []
    for stage, values in measured.items():
        y = values / scales[stage]
        there = np.isfinite(y)
        rows = np.zeros((y[there].size, len(columns)))
        for k, column in enumerate(columns):
            if stage in column.adds:
                rows[:, k] = (column.adds[stage] / scales[stage])[there]
        weight = np.minimum(1.0, LIMIT / np.maximum(np.abs(y[there]), 1e-9))
        ys.append(y[there] * weight)
        terms.append(np.nan_to_num(rows) * weight[:, None])
        stages.append(np.full(y[there].size, stage))
    return np.concatenate(ys), np.vstack(terms), np.concatenate(stages), [(c.cause, c.wheel) for c in columns]
