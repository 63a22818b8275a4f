"""Plants: the bits of `simulate`, many side by side, for SciPy and for environments in Gymnasium's form."""

import threading
import time

import numpy as np
import pytest
from conftest import EXAMPLES
from scipy.optimize import minimize_scalar

import omni_gap

FOUR = EXAMPLES / "feup-4w" / "robot.toml"
THREE = EXAMPLES / "feup-3w" / "robot.toml"
EFFECTS = {
    "dead_time": {"voltage_loss_V": 0.3},
    "coriolis": {},
    "motor_mismatch": [{"wheel": 2, "torque_constant_ratio": 0.9}],
}


def script(wheels, rows=250, dt=0.002):
    """Voltages through starts, reversals and rest: shape (rows, wheels)."""
    row, wheel = np.arange(rows)[:, None], np.arange(wheels)
    volts = np.clip(4 * np.sin(0.05 * row + wheel), -4.5, 4.5)
    volts[row[:, 0] % 90 > 70] = 0
    return np.arange(rows) * dt, volts


def simulated(robot, effects, wheels):
    """What `simulate` records of the script, through a file of the robot with the effects in it."""
    t, volts = script(wheels)
    nothing = np.zeros(len(t))
    run = {"t_s": t, **{f"u{j}_V": volts[:, j] for j in range(wheels)}}
    run |= {"x_m": nothing, "y_m": nothing, "theta_rad": nothing, "gyro_rad_s": nothing}
    import tomllib

    file = tomllib.loads(robot.read_text(encoding="utf-8"))
    if effects:
        file["effects"] = effects
    return omni_gap.simulate(file, run, noise=False)


@pytest.mark.parametrize(("robot", "wheels"), [(FOUR, 4), (THREE, 3)])
@pytest.mark.parametrize(("effects", "n"), [(None, 1), (None, 6), (EFFECTS, 1), (EFFECTS, 40)])
def test_each_robot_moves_as_one_that_is_simulated(robot, wheels, effects, n):
    expected = simulated(robot, effects, wheels)
    plant = omni_gap.Plant(robot, effects, n)
    t, volts = script(wheels)
    which = n - 1
    lengths = np.append(np.diff(t), (t[-1] - t[0]) / (len(t) - 1))
    gyro = plant.reading_columns.index("gyro_rad_s")
    for row, held in enumerate(volts):
        others = np.broadcast_to(0.1 * np.arange(n)[:, None], (n, wheels)).copy()
        others[which] = held
        plant.step(others, lengths[row], steps=10)
        found = dict(zip(plant.reading_columns, plant.reading[which], strict=True))
        for name in expected:
            if name in found and name != "gyro_rad_s":
                assert found[name] == expected[name][row], (name, row)
    assert plant.reading[which, gyro] == pytest.approx(expected["gyro_rad_s"][-1], abs=0.1)


def test_states_have_the_columns_that_they_say():
    plant = omni_gap.Plant(FOUR, n=2)
    assert plant.state_columns == ("x_m", "y_m", "theta_rad", "v_m_s", "vn_m_s", "w_rad_s")
    assert plant.reading_columns[:5] == ("i0_A", "i1_A", "i2_A", "i3_A", "w0_rad_s")
    assert (plant.n, plant.wheels, plant.state.shape, plant.reading.shape) == (2, 4, (2, 6), (2, 12))
    state = plant.reset([[1, 2, 0, 0.5, 0, 0], [0, 0, np.pi / 2, 0.5, 0, 0]])
    after = plant.step(np.zeros(4), 0.001)
    # ahead is along x, then along y
    assert after[0, 0] - 1 == pytest.approx(0.0005, rel=0.02) and after[0, 1] == 2
    assert after[1, 1] == pytest.approx(0.0005, rel=0.02) and abs(after[1, 0]) < 1e-9
    assert np.array_equal(state[:, 3], [0.5, 0.5]) and (after[:, 3] < 0.5).all()
    assert np.array_equal(plant.state, after)
    after[:] = 0  # a copy: the robots stay where they are
    assert plant.state[0, 0] > 1
    plant.reset()
    assert not plant.state.any()


def test_robots_of_their_own_step_together():
    import tomllib

    light = tomllib.loads(FOUR.read_text(encoding="utf-8"))
    heavy = {**light, "body": {**light["body"], "mass_kg": 2 * light["body"]["mass_kg"]}}
    together = omni_gap.Plant([light, heavy])
    alone = [omni_gap.Plant(light), omni_gap.Plant(heavy)]
    for held in script(4)[1]:
        state = together.step(held, 0.002)
        for k, plant in enumerate(alone):
            assert np.array_equal(plant.step(held, 0.002)[0], state[k])
    assert not np.array_equal(state[0], state[1])


def test_chance_is_the_seeds():
    lossy = omni_gap.Plant(FOUR, {"command_loss": {"share": 0.2}}, n=2)

    def end(seed):
        lossy.reset(seed=seed)
        for held in script(4)[1]:
            state = lossy.step(held, 0.002)
        return state

    assert np.array_equal(end(1), end(1))
    assert not np.array_equal(end(1), end(2))
    assert np.array_equal(end(1)[1], end(2)[0]), "robot k takes seed + k"


def test_bad_calls_are_told():
    plant = omni_gap.Plant(FOUR, n=3)
    for call, said in [
        (lambda: plant.step(np.zeros((2, 4)), 0.001), r"voltages: found shape \(2, 4\), expected \(3, 4\) or \(4,\)"),
        (lambda: plant.step(np.full(4, np.nan), 0.001), "robot 0, wheel 0: found NaN, expected a finite number"),
        (lambda: plant.step(np.zeros(4), 0.0), "expected a time above zero"),
        (lambda: plant.step(["a"] * 4, 0.001), "voltages: could not convert"),
        (lambda: plant.reset([[0] * 6, [np.inf] * 6, [0] * 6]), "state: robot 1: found a number that is not finite"),
        (lambda: plant.reset(np.zeros(5)), r"state: found shape \(5,\)"),
        (lambda: omni_gap.Plant(FOUR, n=0), "expected at least one robot"),
        (lambda: omni_gap.Plant([FOUR, THREE]), "3 wheels, where"),
        (lambda: omni_gap.Plant(FOUR, {"creeep": {}}), "robot.toml: column `creeep`: .*creep"),
        (lambda: omni_gap.Plant(FOUR, {"dead_time": 3}), "robot.toml: column `dead_time`: "),
    ]:
        with pytest.raises(omni_gap.OmniGapError, match=said):
            call()


def test_a_plant_is_what_scipy_minimises_over():
    """The voltage that brings a robot 0.2 m ahead in half a second."""
    plant = omni_gap.Plant(FOUR)
    along = np.array([1.0, 0.0, -1.0, 0.0])

    def missed(volts):
        plant.reset()
        return (np.hypot(*plant.step(volts * along, 0.5, steps=500)[0, :2]) - 0.2) ** 2

    best = minimize_scalar(missed, bounds=(0, 12), method="bounded")
    assert best.fun < 1e-9 and 0.5 < best.x < 12


def test_the_lock_is_released_while_robots_step():
    """While one thread steps for long, another one counts."""
    plant = omni_gap.Plant(FOUR, EFFECTS, n=8)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    time.sleep(0.05)
    before, begun = counted[0], time.perf_counter()
    plant.step(np.ones(4), 10.0, steps=40_000)
    took = time.perf_counter() - begun
    during = counted[0] - before
    done.set()
    other.join()
    assert took > 0.05, "the step is over too soon to tell anything"
    assert during > 5, f"{during} turns of the other thread in {took:.2f} s"
