"""Small sessions and robots that tests are made of."""

import csv

import numpy as np
import tomli_w

from peers.catalogue import Cause, Parameter
from peers.draw import PAPER

FOUR = {
    "name": "four",
    "wheel": [{"drive_angle_deg": angle, "distance_m": 0.089, "radius_m": 0.0325} for angle in (90.0, 180.0, 270.0, 0.0)],
    **{table: PAPER[table] for table in ("motor", "body", "friction", "sensors")},
}


def cause(name, stage="electrical", kind="effect", **more):
    """A cause with one number that sizes it."""
    return Cause(name, kind, stage, (Parameter("size", "sizes", 0.0, 0.3, 0.0, 1.5),), **more)


def table(path, columns):
    """A CSV file; not-a-number is left blank."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        written = csv.writer(file)
        written.writerow(columns)
        for row in zip(*columns.values(), strict=True):
            written.writerow(["" if np.isnan(field) else repr(float(field)) for field in row])


def session(folder, runs=1):
    """A session of a robot at rest."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "robot.toml").write_text(tomli_w.dumps(FOUR), encoding="utf-8")
    time = np.arange(50) / 100
    names = [f"u{j}_V" for j in range(4)] + [f"i{j}_A" for j in range(4)] + [f"w{j}_rad_s" for j in range(4)]
    columns = {"t_s": time, **{name: np.zeros(50) for name in [*names, "x_m", "y_m", "theta_rad"]}}
    for run in range(runs):
        table(folder / "runs" / f"run{run}.csv", columns)
    return folder
