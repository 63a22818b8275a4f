"""Sessions to learn from: robots, hidden causes and drives by chance, recorded by the product's own plant.

Nothing here looks at the benchmark's sessions: layouts are those of the paper, numbers are its own times a lognormal draw,
causes are drawn evenly from the catalogue at 0.4 to 2.5 times their typical size, a wrong number is off by 3 to 8 of its
stated sigmas, and every other number is off by a normal draw of its own.
"""

import copy
import csv
from dataclasses import dataclass

import numpy as np

from peers.candidate import NEEDS
from peers.robot_file import moved, scaled, uncertain, with_cause
from peers.session import Run, Session

LAYOUTS = ((90.0, 180.0, 270.0, 0.0), (45.0, 135.0, 225.0, 315.0), (150.0, 270.0, 30.0))
RUNS, SECONDS, RATE, EVERY = 3, 6.0, 200.0, 3

# Out of so many sessions one has nothing hidden.
NOTHING = 8

# The paper's robot on four wheels (Oliveira, Sousa, Moreira, Costa, ICINCO 2008, Table 3).
PAPER = {
    "motor": {
        "gear_ratio": 5.0,
        "resistance_ohm": 4.3111,
        "emf_constant_V_s": 0.0259,
        "torque_constant_Nm_per_A": 0.0259,
    },
    "body": {"mass_kg": 2.34, "inertia_kg_m2": 0.0228},
    "friction": {
        "viscous_v_N_s_per_m": 0.4978,
        "viscous_vn_N_s_per_m": 0.6763,
        "viscous_w_Nm_s": 0.0141,
        "coulomb_v_N": 1.8738,
        "coulomb_vn_N": 2.2198,
        "coulomb_w_Nm": 0.1385,
    },
    "sensors": {
        "current_noise_A": 0.02,
        "wheel_speed_noise_rad_s": 0.15,
        "position_noise_m": 0.003,
        "heading_noise_rad": 0.01,
    },
    "supply": {"voltage_V": 12.0},
}


@dataclass(frozen=True)
class Drawn:
    """A session and what is hidden in it: the cause's id, or no_gap."""

    session: Session
    label: str


def learnable(causes):
    """The causes that such drives can show: there are voltages, currents, wheel speeds and poses."""
    return [cause for cause in causes if NEEDS.get(cause.id) not in ("wset", "gyro")]


def robot(chance):
    """A nominal robot."""
    made = copy.deepcopy(PAPER)
    layout = LAYOUTS[chance.integers(len(LAYOUTS))]
    made["wheel"] = [{"drive_angle_deg": angle, "distance_m": 0.089, "radius_m": 0.0325} for angle in layout]
    spread = {where: float(np.exp(0.15 * chance.standard_normal())) for where, _ in uncertain(made)}
    spread["motor", "torque_constant_Nm_per_A"] = spread["motor", "emf_constant_V_s"]
    return scaled(made, spread)


def sized(cause, nominal, chance):
    """The numbers of a cause."""
    if cause.kind == "parameter":
        stated = dict(uncertain(nominal))
        off = chance.uniform(3, 8) * max(stated[where] for where in cause.keys)
        factor = float(1 + off if chance.random() < 0.5 else 1 / (1 + off))
        return {one.key: factor for one in cause.parameters}
    times = float(np.clip(np.exp(0.45 * chance.standard_normal()), 0.4, 2.5))
    either = all(one.low == -one.high for one in cause.role("sizes")) and chance.random() < 0.5
    numbers = {}
    for one in cause.role("sizes"):
        value = one.absent + (-times if either else times) * (one.typical - one.absent)
        numbers[one.key] = float(np.clip(value, one.low, one.high))
    for one in cause.role("shapes"):
        if one.low < 0 and (one.key.endswith(("_x_m", "_y_m")) or one.key == "direction_rad"):
            numbers[one.key] = float(chance.uniform(max(one.low, -3.0), min(one.high, 3.0)))
    return numbers


def drive(nominal, chance):
    """Voltages of all wheels: steps along all axes at once, with rests and reversals."""
    rows = int(SECONDS * RATE)
    angle = np.radians([wheel["drive_angle_deg"] for wheel in nominal["wheel"]])
    shares = np.column_stack([np.cos(angle), np.sin(angle), np.ones(angle.size)])
    wanted, row = np.zeros((rows, 3)), int(0.2 * RATE)
    while row < rows:
        length = int(chance.uniform(0.1, 0.8) * RATE)
        rest = chance.random() < 0.15
        wanted[row : row + length] = 0.0 if rest else chance.uniform(-1, 1, 3) * [5.0, 5.0, 3.5]
        row += length
    return np.clip(wanted @ shares.T, -8.0, 8.0)


def inputs(path, nominal, chance):
    """A table of voltages, with the other columns for the plant to fill."""
    volts = drive(nominal, chance)
    wheels = range(volts.shape[1])
    names = [f"u{j}_V" for j in wheels] + [f"i{j}_A" for j in wheels] + [f"w{j}_rad_s" for j in wheels]
    with path.open("w", encoding="utf-8", newline="") as file:
        written = csv.writer(file)
        written.writerow(["t_s", *names, "x_m", "y_m", "theta_rad"])
        for row, u in enumerate(volts):
            pose = [0, 0, 0] if row % EVERY == 0 else ["", "", ""]
            written.writerow([row / RATE, *u, *[0] * 2 * volts.shape[1], *pose])
    return path


def drawn(tool, causes, seed):
    """One session."""
    chance = np.random.default_rng(seed)
    nominal = robot(chance)
    real = moved(nominal, chance.standard_normal(len(uncertain(nominal))))
    label = "no_gap"
    if chance.integers(NOTHING) > 0:
        cause = causes[chance.integers(len(causes))]
        wheel = int(chance.integers(len(nominal["wheel"]))) if cause.one_wheel else None
        real, label = with_cause(real, cause, sized(cause, nominal, chance), wheel), cause.id
    runs = []
    for k in range(RUNS):
        driven = inputs(tool.folder / "driven.csv", nominal, chance)
        seeds = int(chance.integers(2**31))
        runs.append(Run.read(tool.simulate(real, driven, seeds, tool.folder / f"drawn{k}.csv")))
    return Drawn(Session(tool.folder, nominal, runs, []), label)
