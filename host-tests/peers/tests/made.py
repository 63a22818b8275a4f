"""Small sessions and robots that tests are made of."""

import csv

import numpy as np
import tomli_w

from peers.catalogue import Cause, Parameter

FOUR = {
    "name": "four",
    "wheel": [{"drive_angle_deg": angle, "distance_m": 0.089, "radius_m": 0.0325} for angle in (90.0, 180.0, 270.0, 0.0)],
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
