"""Runs an exported model in MuJoCo beside the recording that `omni-gap simulate` made of the same robot file and input.

    python exported.py MODEL.xml SIMULATED.csv MOST

Both start at rest in the origin and hold each row's voltages until the next. Prints by how much they differ, as a share of how
much each signal moves, and ends with 1 where that is more than MOST.
"""

import csv
import sys

import mujoco
import numpy as np


def table(path):
    """The columns of a run."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    columns = zip(*rows[1:], strict=True)
    return {name: np.array([float(x) if x else np.nan for x in column]) for name, column in zip(rows[0], columns, strict=True)}


def played(model, run, wheels):
    """Wheel speeds and pose on the run's rows."""
    data = mujoco.MjData(model)
    sensors = [model.sensor(name).adr[0] for name in [f"w{j}" for j in range(wheels)] + ["pose_x", "pose_y", "pose_heading"]]
    seen = np.empty((len(run["t_s"]), len(sensors)))
    volts = np.column_stack([run[f"u{j}_V"] for j in range(wheels)])
    for row, time in enumerate(run["t_s"]):
        while data.time < time - run["t_s"][0] - 0.5 * model.opt.timestep:
            mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        seen[row] = data.sensordata[sensors]
        data.ctrl[:wheels] = volts[row]
    return seen


def main(model_path, run_path, most):
    """The largest difference of all signals, against what is allowed."""
    model, run = mujoco.MjModel.from_xml_path(model_path), table(run_path)
    wheels = sum(name.startswith("u") for name in run)
    seen = played(model, run, wheels)
    names = [f"w{j}_rad_s" for j in range(wheels)] + ["x_m", "y_m", "theta_rad"]
    worst = 0.0
    for name, values in zip(names, seen.T, strict=True):
        there = ~np.isnan(run[name])
        apart = np.sqrt(np.mean((values - run[name])[there] ** 2)) / np.std(run[name][there])
        worst = max(worst, apart)
        print(f"{name:10} {100 * apart:8.3f} %")
    print(f"{model_path}: at most {100 * worst:.3f} % apart, {100 * most:g} % allowed")
    return 0 if worst <= most else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], float(sys.argv[3])))
