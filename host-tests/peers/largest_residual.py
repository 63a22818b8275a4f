"""The rule of thumb: the channel with the largest residual decides.

Free runs of the nominal robot, restarted every 0.5 s, leave a root mean square in every channel. It is divided by what that
channel leaves where there is no gap: the largest of some draws in which only noise and the numbers' stated uncertainty act.
No channel above 1: `no_gap`. Else the fixed table of `triage.py` names a cause for the largest.

    s_c = rms_c / max over draws of rms_c;   weight of a channel's cause max(s_c - 1, 0)², of no_gap 0.1²

A rule has no probabilities; these weights rank as it does, and a tenth is left to `unknown`.
"""

import sys

from peers.command import one_thread, run

one_thread()

import numpy as np  # noqa: E402

from peers import triage  # noqa: E402
from peers.catalogue import catalogue  # noqa: E402
from peers.report import Answer  # noqa: E402
from peers.residuals import by_column, drawn_sizes, group, residuals, rms, wheel  # noqa: E402

NAME = "largest_residual"
HORIZON = 0.5
DRAWS = 6
SEED = 1

# Weights: of no gap, beside squared excesses; of what is not in the table, as a share of all.
NO_GAP = 0.1**2
UNKNOWN = 0.1

STAGE = {"i": "electrical", "w": "drivetrain", "position": "sensing", "heading": "sensing", "gyro": "body"}


def channel(column):
    """The channel of a column: its group, the pose in position and heading."""
    return {"x_m": "position", "y_m": "position", "theta_rad": "heading"}.get(column, group(column))


def scores(measured, drawn):
    """The size of each column over the largest that it has without a gap."""
    floor = {name: max(one.get(name, 0.0) for one in drawn) for name in measured}
    return {name: size / floor[name] for name, size in measured.items() if floor[name] > 0}


def triaged(scored):
    """What the table says of each channel: (cause's id, wheel, score), the largest first."""
    found = []
    for name in dict.fromkeys(map(channel, scored)):
        columns = {column: score for column, score in scored.items() if channel(column) == name}
        top = max(columns, key=columns.get)
        alone = wheel(top) is not None and columns[top] > triage.STANDS_OUT * np.median(list(columns.values()))
        found.append((triage.ONE[name], wheel(top), columns[top]) if alone else (triage.ALL[name], None, columns[top]))
    return sorted(found, key=lambda one: -one[2])


def weighed(found, causes):
    """The entries of `which` for what the table said."""
    which = [("no_gap", None, NO_GAP)]
    which += [(causes[name], where, max(score - 1, 0.0) ** 2) for name, where, score in found]
    return [*which, ("unknown", None, UNKNOWN * sum(weight for *_, weight in which))]


def answer(session, tool, _):
    """The answer for a session."""
    causes = {cause.id: cause for cause in catalogue(tool)}
    measured = by_column([residuals(tool, session.robot, run, HORIZON) for run in session.runs])
    sizes = {name: rms(values) for name, values in measured.items()}
    scored = scores(sizes, drawn_sizes(tool, session, HORIZON, DRAWS, SEED))
    stages = {stage: 0.0 for stage in STAGE.values()}
    for name, score in scored.items():
        stages[STAGE.get(channel(name), "electrical")] += score**2
    return Answer(weighed(triaged(scored), causes), stages, notes={"scores": scored})


if __name__ == "__main__":
    sys.exit(run(NAME, answer))
