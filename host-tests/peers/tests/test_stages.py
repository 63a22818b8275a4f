"""Stage residuals vanish for a robot that is what its file says, and regressors are what effects do at their typical size."""

import numpy as np
import pytest

from peers.catalogue import catalogue
from peers.design import assembled, sizes
from peers.robot_file import with_cause
from peers.session import Run
from peers.stages import Motion, Numbers, averaged, lines, slopes
from peers.tests.made import FOUR, table


def test_a_slope_is_the_mean_of_the_steps_under_the_parabola():
    values = np.random.default_rng(6).standard_normal(60).cumsum()
    steps = np.append(np.diff(values), 0.0) / 0.01
    assert slopes(values, 5, 0.01)[5:-5] == pytest.approx(averaged(steps, 5)[5:-5])


def test_straight_lines_are_found_through_gaps():
    time = np.arange(100) / 50
    seen = np.where(np.arange(100) % 3 == 0, 2.0 - 0.7 * time, np.nan)
    value, slope = lines(time, seen, time, 0.2)
    assert value == pytest.approx(2.0 - 0.7 * time) and slope == pytest.approx(np.full(100, -0.7))


def steady(path, twist, heading):
    """A recording of steady motion under the nominal model: forces that balance friction, voltages that drive them."""
    n, time = Numbers.of(FOUR), np.arange(200) / 200
    loads = n.viscous * twist + n.coulomb * np.sign(twist)
    force = n.rows @ np.linalg.solve(n.rows.T @ n.rows, loads)
    w, i = n.rows @ twist / n.radius, force * n.radius / n.torque
    u = n.resistance * i + n.emf * w
    cos, sin = np.cos(heading), np.sin(heading)
    world = [cos * twist[0] - sin * twist[1], sin * twist[0] + cos * twist[1]]
    columns = {"t_s": time}
    for name, values in (("u{}_V", u), ("i{}_A", i), ("w{}_rad_s", w)):
        columns |= {name.format(j): np.full(time.size, value) for j, value in enumerate(values)}
    columns |= {"x_m": world[0] * time, "y_m": world[1] * time, "theta_rad": np.full(time.size, heading)}
    table(path, columns)
    return Run.read(path)


def test_the_nominal_robot_leaves_nothing(tmp_path):
    found = Motion(FOUR, steady(tmp_path / "run.csv", np.array([0.5, -0.3, 0.0]), 0.8)).residuals()
    assert set(found) == {"electrical", "body", "camera", "parity"}
    for stage, values in found.items():
        inside = values[30:-30]
        assert np.isfinite(inside).any(), stage
        assert np.nanmax(np.abs(inside)) < 1e-9, stage


def inputs(path):
    """Voltages that drive all axes, with reversals."""
    chance, time = np.random.default_rng(7), np.arange(1600) / 200
    wanted = np.repeat(chance.uniform(-1, 1, (20, 3)) * [5.0, 5.0, 30.0], 80, axis=0)
    u = wanted @ Numbers.of(FOUR).rows.T
    columns = {"t_s": time} | {f"u{j}_V": u[:, j] for j in range(4)}
    zeros = np.zeros(time.size)
    columns |= {f"{kind}{j}{unit}": zeros for kind, unit in (("i", "_A"), ("w", "_rad_s")) for j in range(4)}
    table(path, columns | {"x_m": zeros, "y_m": zeros, "theta_rad": zeros})
    return path


@pytest.mark.parametrize(
    ("name", "wheel"),
    [
        ("dead_time", None),
        ("regeneration_asymmetry", None),
        ("supply_sag", None),
        ("drive_gain", 2),
        ("motor_mismatch", 1),
        ("gear_efficiency", None),
        ("wheel_friction", 0),
        ("coriolis", None),
        ("camera_latency", None),
        ("camera_scale", None),
        ("encoder_lag", None),
        ("encoder_scale", 3),
        ("wheel_radius_error", 1),
        ("wheel_misalignment", 1),
        ("creep", None),
        ("current_sensor_gain", None),
        ("friction_warmup", None),
    ],
)
def test_a_regressor_has_its_effects_typical_size(tool, tmp_path, name, wheel):
    cause = next(one for one in catalogue(tool) if one.id == name)
    real = with_cause(FOUR, cause, {}, wheel)
    driven = inputs(tmp_path / "inputs.csv")
    run = Run.read(tool.simulate(real, driven, 1, tmp_path / "real.csv"))
    plain = Run.read(tool.simulate(FOUR, driven, 1, tmp_path / "plain.csv"))
    y, terms, _, named = assembled(Motion(FOUR, run), sizes([Motion(FOUR, plain)]))
    column = terms[:, named.index((name, wheel))]
    assert column @ y / (column @ column) == pytest.approx(1, abs=0.25)
