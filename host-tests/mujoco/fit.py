"""Seven numbers of a robot fitted to recordings: SciPy's least squares around MuJoCo's rollouts, both cores.

Every recording starts at rest where the world begins and goes along one axis, so that forces need no turning.
"""

import time

import mujoco
import numpy as np
from model import FORCES, at_rest
from mujoco import rollout
from scipy.optimize import least_squares

# Step of the finite differences, as a share of the number.
DIFFERENCE = 1e-4


class Recordings:
    """What was measured, and what a robot file states of the numbers that are free."""

    def __init__(self, robot, asked):
        self.robot = robot
        self.step = asked["step"]
        self.volts = np.array(asked["volts"], dtype=float)  # run, row, wheel
        self.measured = np.array(asked["measured"], dtype=float)  # run, row, channel; NaN where nothing was
        self.sigma = np.array(asked["sigma"])
        self.free = [tuple(key) for key in asked["free"]]
        self.stated = np.array(asked["stated"])
        self.within = asked["within"]
        self.tolerance = asked["tolerance"]
        self.threads = asked["threads"]
        self.seen = ~np.isnan(self.measured)
        self.calls = 0

    def predicted(self, robot, loop):
        """Currents, wheel speeds and pose at the beginning of every row."""
        model = robot.compiled(self.step)
        data = [mujoco.MjData(model) for _ in range(self.threads)]
        runs, rows, _ = self.volts.shape
        start = at_rest(model)
        states, _ = loop.rollout(
            [model] * runs, data, np.tile(start, (runs, 1)), robot.push(self.volts), control_spec=FORCES
        )
        states = np.concatenate([np.zeros((runs, 1, len(start))), states[:, : rows - 1]], axis=1)
        pose, twist = states[..., 1:4], states[..., 4:7]
        wheel_speed = twist @ robot.rows.T / robot.radius
        return np.concatenate([robot.currents(self.volts, wheel_speed), wheel_speed, pose], axis=-1)

    def errors(self, factors, loop):
        """Measured minus predicted in sigma, and how far the numbers are from what is stated."""
        self.calls += 1
        robot = self.robot.scaled(dict(zip(self.free, factors, strict=True)))
        error = self.measured - self.predicted(robot, loop)
        error[..., -1] -= 2 * np.pi * np.round(error[..., -1] / (2 * np.pi))
        return np.concatenate([(error / self.sigma)[self.seen], np.log(factors) / self.stated])

    def fit(self):
        """The best factors on the free numbers, from one each, and how long it took."""
        self.calls = 0
        begun = time.perf_counter()
        with rollout.Rollout(nthread=self.threads) as loop:
            found = least_squares(
                self.errors,
                np.ones(len(self.free)),
                args=(loop,),
                bounds=self.within,
                diff_step=DIFFERENCE,
                ftol=self.tolerance,
                xtol=None,
                gtol=None,
            )
        return {
            "seconds": time.perf_counter() - begun,
            "factors": found.x.tolist(),
            "error": 2 * found.cost / int(self.seen.sum()),
            "rollouts": self.calls,
        }
