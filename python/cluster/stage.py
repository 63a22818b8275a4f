"""Short sessions of simulated robots, and what a store holds."""

import csv
from pathlib import Path

import numpy as np

import omni_gap

ROBOT = Path(__file__).parents[2] / "examples/feup-4w/robot.toml"
ROWS = 200
RUNS = 3
DAYS = 20
TABLES = ("sessions", "causes", "equations")


def stage(logs, sessions):
    """So many sessions of three runs of two seconds, at 100 rows a second; every other robot's bridge has a dead time."""
    text = ROBOT.read_text(encoding="utf-8")
    logs.mkdir(parents=True)
    with_dead_time = logs.parent / "dead_time.toml"
    with_dead_time.write_text(f"{text}\n[effects.dead_time]\nvoltage_loss_V = 0.3\n", encoding="utf-8")
    t_s = np.arange(ROWS) / 100
    for number in range(sessions):
        robot, day = divmod(number, DAYS)
        session = logs / f"r{robot:03}/2026-11-{day + 1:02}"
        (session / "runs").mkdir(parents=True)
        (session / "robot.toml").write_text(text, encoding="utf-8")
        random = np.random.default_rng(number)
        for run in range(RUNS):
            held = random.uniform(-6, 6, (4, ROWS // 20))
            driven = {"t_s": t_s, **{f"u{wheel}_V": np.repeat(held[wheel], 20) for wheel in range(4)}}
            true = with_dead_time if robot % 2 else ROBOT
            recorded = omni_gap.simulate(true, driven, seed=RUNS * number + run)
            with open(session / f"runs/run{run:02}.csv", "w", encoding="utf-8", newline="") as file:
                written = csv.writer(file)
                written.writerow(recorded)
                written.writerows(zip(*(recorded[column].tolist() for column in recorded)))


def tables(store):
    """The bytes of every table's file, by name."""
    paths = [path for table in TABLES for path in sorted((Path(store) / table).rglob("*.parquet"))]
    return {path.relative_to(store).as_posix(): path.read_bytes() for path in paths}
