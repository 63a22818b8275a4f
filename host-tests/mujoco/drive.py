"""A robot driven by motor voltages: step by step from Python, then the same steps in one call of MuJoCo's own loop."""

import time

import mujoco
import numpy as np
from model import FORCES, OPTIONS, at_rest, turned
from mujoco import rollout

# How far apart the same steps may end, taken one by one and in one call; other solvers end a little elsewhere.
APART = 1e-4


class Drive:
    """One motion of a robot, and the forces at the joints that make it."""

    def __init__(self, robot, volts, step):
        self.models = {options: robot.compiled(step, options) for options in OPTIONS}
        model = self.models["fastest"]
        data = mujoco.MjData(model)
        push = robot.push(volts)
        self.forces = np.empty_like(push)
        begun = time.perf_counter()
        for k, force in enumerate(push):
            self.forces[k] = turned(force, data.qpos[2])
            data.qfrc_applied[:] = self.forces[k]
            mujoco.mj_step(model, data)
        self.looped_per_s = len(push) / (time.perf_counter() - begun)
        self.pose = data.qpos.copy()
        self.twist = turned(data.qvel, -self.pose[2])
        start = at_rest(model)
        self.call = {
            "initial_state": start[None],
            "control": self.forces[None],
            "control_spec": FORCES,
            "state": np.empty((1, len(push), len(start))),
        }

    def steps_per_s(self, options, seconds):
        """How many steps a second MuJoCo takes on one thread, over at least so many seconds."""
        model = self.models[options]
        data = mujoco.MjData(model)
        begun, steps = time.perf_counter(), 0
        with rollout.Rollout(nthread=0) as loop:
            while time.perf_counter() - begun < seconds:
                state, _ = loop.rollout(model, data, **self.call)
                steps += len(self.forces)
        took = time.perf_counter() - begun
        if not np.allclose(state[0, -1, 1:4], self.pose, rtol=0, atol=APART):
            raise ValueError("the timed steps do not end where the same steps ended one by one")
        return steps / took
