"""A session folder as the contestants read it: robot.toml, runs/*.csv and, if there is one, heldout/*.csv.

Only logs in the contract's own columns are read: a session with columns.toml, runs that are folders, and other formats
are refused. `omni-gap convert` writes any of them as such a table.
"""

import csv
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peers.mistakes import Mistake


@dataclass(frozen=True)
class Run:
    """One recording: a file, its columns by name, not-a-number where nothing was measured."""

    path: Path
    columns: dict

    @property
    def time(self):
        """The clock [s]."""
        return self.columns["t_s"]

    @classmethod
    def read(cls, path):
        """Reads a CSV table."""
        try:
            with path.open(encoding="utf-8", newline="") as file:
                rows = [row for row in csv.reader(file) if row]
        except (OSError, UnicodeDecodeError, csv.Error) as why:
            raise Mistake(f"{path}: cannot be read ({why}); give a CSV table with a header") from why
        if len(rows) < 3 or "t_s" not in rows[0]:
            raise Mistake(f"{path}: no table with a t_s column and at least two rows; see the contract of the run log")
        header = rows[0]
        table = np.empty((len(rows) - 1, len(header)))
        for line, row in enumerate(rows[1:], start=2):
            if len(row) != len(header):
                raise Mistake(f"{path}, line {line}: {len(row)} fields, the header has {len(header)}; mend the line")
            try:
                table[line - 2] = [float(field) if field.strip() else np.nan for field in row]
            except ValueError as why:
                raise Mistake(f"{path}, line {line}: {why}; every field is a number or blank") from why
        columns = dict(zip(header, table.T, strict=True))
        if not np.all(np.diff(columns["t_s"]) > 0):
            raise Mistake(f"{path}: t_s does not grow in every row; sort the rows, and leave out doubled ones")
        return cls(path, columns)


@dataclass(frozen=True)
class Session:
    """The nominal robot and its recordings."""

    folder: Path
    robot: dict
    runs: list
    heldout: list

    @classmethod
    def read(cls, folder):
        """Reads a folder."""
        if not folder.is_dir():
            raise Mistake(f"{folder}: no such folder; name a session folder with robot.toml and runs/")
        if (folder / "columns.toml").exists():
            raise Mistake(f"{folder}/columns.toml: peers read no mappings; write the runs with `omni-gap convert`")
        robot = read_robot(folder / "robot.toml")
        runs = recordings(folder / "runs")
        if not runs:
            raise Mistake(f"{folder}/runs: no *.csv there; put the recordings of the robot into it")
        return cls(folder, robot, runs, recordings(folder / "heldout"))

    @property
    def wheels(self):
        """How many wheels the robot has."""
        return len(self.robot["wheel"])

    def logs(self, group):
        """Whether a signal group is logged: u, wset, i, w, pose, gyro or vbat."""
        first = {"u": "u0_V", "wset": "wset0_rad_s", "i": "i0_A", "w": "w0_rad_s", "pose": "x_m"}
        name = first.get(group, {"gyro": "gyro_rad_s", "vbat": "vbat_V"}.get(group))
        return any(name in run.columns for run in self.runs)


def recordings(folder):
    """The recordings of a folder, by name."""
    if not folder.is_dir():
        return []
    others = [path for path in folder.iterdir() if path.is_dir() or path.suffix != ".csv"]
    if others:
        raise Mistake(f"{others[0]}: peers read *.csv only; write it with `omni-gap convert`")
    return [Run.read(path) for path in sorted(folder.glob("*.csv"))]


def read_robot(path):
    """A robot file as a dictionary, with the tables that every model needs."""
    try:
        robot = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as why:
        raise Mistake(f"{path}: cannot be read ({why}); give the robot file of the contract") from why
    missing = [table for table in ("wheel", "motor", "body", "friction", "sensors") if table not in robot]
    if missing:
        raise Mistake(f"{path}: no [{missing[0]}]; give the robot file of the contract")
    return robot
