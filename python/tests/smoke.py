"""Imports the package, diagnoses a session, and compares all of the answer with what the command wrote.

    python smoke.py SESSION REPORT.json STORE

Files and columns in memory, through NumPy alone; the test command runs it.
"""

import csv
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

import omni_gap
from omni_gap import fleet


def columns(path):
    """The columns of a run log; an empty field is NaN."""
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    cells = zip(*rows)
    return {name: np.array([float(x) if x else np.nan for x in column]) for name, column in zip(header, cells)}


def same(what, found, expected):
    """Fails where two things differ."""
    if found != expected:
        sys.exit(f"{what}: found {found!r}, expected {expected!r}")


def main(session, report, store):
    written = Path(report).read_text(encoding="utf-8")
    diagnosis = omni_gap.diagnose(session)
    same("report.json, byte for byte", diagnosis.to_json(), written)
    same("the dictionary", diagnosis.to_dict(), json.loads(written))
    same("the causes", diagnosis.causes, ["dead_time"])

    logs = sorted(Path(session, "runs").glob("*.csv"))
    in_memory = {log.stem: columns(log) for log in logs}
    robot = Path(session, "robot.toml")
    other = omni_gap.diagnose(in_memory, robot, name=Path(session).name)
    expected = json.loads(written)
    expected["inputs"] = expected["inputs"][:1]  # the robot file: the recordings are no files
    same("the diagnosis of the same columns in memory", other.to_dict(), expected)

    bad = {name: column for name, column in in_memory[logs[0].stem].items() if name != "u1_V"}
    try:
        omni_gap.diagnose(bad, robot)
    except omni_gap.OmniGapError as error:
        same("the message", str(error).split(". ")[0], "run00: column `u1_V`: the column is missing: 3 of 4 wheels have one")
    else:
        sys.exit("a recording without a wheel's voltage was taken")

    with tempfile.TemporaryDirectory() as own:
        tally = fleet.diagnose(Path(session).parent, own)
        same("the sessions of a fleet", (tally.done, tally.failed), (1, 0))
        files = sorted(path.relative_to(store) for path in Path(store).rglob("*.parquet"))
        same("the tables of a fleet", len(files), 3)
        for file in files:
            same(f"{file}, byte for byte", Path(own, file).read_bytes(), Path(store, file).read_bytes())

    run = in_memory[logs[0].stem]
    simulated = omni_gap.simulate(robot, run, noise=False)
    plant = omni_gap.Plant(robot, n=3)
    volts = np.column_stack([run[f"u{wheel}_V"] for wheel in range(plant.wheels)])
    lengths = np.diff(run["t_s"], append=run["t_s"][-1])
    lengths[-1] = (run["t_s"][-1] - run["t_s"][0]) / (len(run["t_s"]) - 1)
    for row, (held, length) in enumerate(zip(volts, lengths)):
        plant.step(held, length, steps=10)
        for name, value in zip(plant.reading_columns, plant.reading[2]):
            there = name in simulated and not np.isnan(simulated[name][row])
            if there and value != simulated[name][row]:
                sys.exit(f"{name}, row {row}: a plant that is stepped says {value}, simulate {simulated[name][row]}")
    print(f"{diagnosis!r} The same bytes as the command's, from files and from memory; {len(volts)} steps as simulated.")


if __name__ == "__main__":
    main(*sys.argv[1:])
