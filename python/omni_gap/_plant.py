"""Robots that are stepped by whoever calls, many side by side."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _inputs, _omni_gap
from ._inputs import RobotLike
from ._omni_gap import OmniGapError


class Plant:
    """``n`` robots of a file, with its effects and those of ``effects``, that take their steps together in float64.

    Each moves as it would alone, and with the same bits as :func:`omni_gap.simulate` of one, without noise::

        plant = omni_gap.Plant("robot.toml", {"dead_time": {"voltage_loss_V": 0.3}}, n=100)
        state = plant.reset()
        for _ in range(1000):
            state = plant.step(policy(state), dt_s=0.001)     # volts, shape (100, wheels)

    A state is, for each robot, ``x_m``, ``y_m`` (m) and ``theta_rad`` (rad, counterclockwise) of the pose in the world, then
    ``v_m_s`` (ahead), ``vn_m_s`` (to the left) along the body's axes (m/s) and ``w_rad_s`` (rad/s).

    Steps are those of the fixed-step integrator of the model (second order in the step, with rest that is rest); dry friction and
    effects that remember have no right-hand side, so there is none for ``scipy.integrate.solve_ivp``. Within SciPy, call
    :meth:`step` from the function that is optimised; for Gymnasium, from ``step`` of an environment.

    One plant is for one thread at a time; the lock is released while it steps, so that several plants step in several threads.

    Args:
        robot: The robot file: its path, or a dictionary in its form; or a list of these, one for each robot.
        effects: Effects of the catalogue by id, each with its parameters as under ``[effects.<id>]``; for one wheel alone
            ``{"motor_mismatch": [{"wheel": 2, "torque_constant_ratio": 0.9}]}``. They take the place of those of the file.
        n: How many robots; of a list, how many of each.
        supply_V: Voltage to assume where the file states no supply (V).

    Raises:
        OmniGapError: Where a robot file cannot be read, or robots do not have as many wheels each.
    """

    #: The columns of a state.
    state_columns: tuple[str, ...] = tuple(_omni_gap.Plants.STATE)

    def __init__(
        self,
        robot: Union[RobotLike, Sequence[RobotLike]],
        effects: Optional[Mapping[str, Any]] = None,
        n: int = 1,
        *,
        supply_V: Optional[float] = None,  # noqa: N803
    ) -> None:
        if n < 1:
            raise OmniGapError(f"n: found {n}, expected at least one robot. Name another number")
        if isinstance(robot, (str, os.PathLike, Mapping)):
            robots = [_inputs.robot(robot, effects)]
        else:
            robots = [_inputs.robot(one, effects) for one in robot]
        self._plants = _omni_gap.Plants(robots, n, supply_V)
        self._shape = self._plants.shape
        self._state_shape = (self._shape[0], len(self.state_columns))
        self.reading_columns: tuple[str, ...] = tuple(self._plants.reading_columns())
        """The columns of a reading: ``i0_A`` and the other currents, ``w0_rad_s`` and the other wheel speeds, the pose, the gyro."""

    @property
    def n(self) -> int:
        """How many robots there are."""
        return self._shape[0]

    @property
    def wheels(self) -> int:
        """How many wheels each has."""
        return self._shape[1]

    @property
    def state(self) -> np.ndarray:
        """Where the robots are: shape ``(n, 6)``, in the order of :attr:`state_columns`; a copy."""
        return np.frombuffer(self._plants.state()).reshape(self._state_shape)

    @property
    def reading(self) -> np.ndarray:
        """What the sensors said when the last step began, its voltages just applied: shape ``(n, 2·wheels + 4)``.

        In the order of :attr:`reading_columns`: currents (A), wheel speeds (rad/s), pose (m, m, rad), yaw rate (rad/s). A row of
        a run log without noise; zero before the first step.
        """
        return np.frombuffer(self._plants.reading()).reshape(self.n, len(self.reading_columns))

    def reset(self, state: Any = None, *, seed: int = 0) -> np.ndarray:
        """Puts the robots where they are to begin; what effects remember is forgotten.

        Args:
            state: Shape ``(n, 6)`` or ``(6,)``, in the order of :attr:`state_columns`; at rest in the origin unless said.
            seed: Seed of what chance decides (telegrams that ``command_loss`` loses); robot k takes ``seed + k``.

        Returns:
            The state, shape ``(n, 6)``.
        """
        begun = None if state is None else self._rows(state, self._state_shape, "state")
        self._plants.reset(begun, seed)
        return self.state

    def step(self, voltages: Any, dt_s: float, steps: int = 1) -> np.ndarray:
        """Holds mean motor voltages for a time and goes through it.

        Args:
            voltages: Shape ``(n, wheels)`` or ``(wheels,)``: the voltage across each motor, duty times supply, with its sign (V).
            dt_s: The time (s). A step of the plant is to be some milliseconds at the most.
            steps: In how many equal steps of the plant.

        Returns:
            The state after it, shape ``(n, 6)``, in the order of :attr:`state_columns`.

        Raises:
            OmniGapError: Where shapes do not fit, a voltage is not finite, or the time is not above zero.
        """
        if not (0.0 < dt_s < np.inf and steps >= 1):
            raise OmniGapError(f"found dt_s = {dt_s} and steps = {steps}, expected a time above zero and at least one step")
        volts = self._rows(voltages, self._shape, "voltages")
        return np.frombuffer(self._plants.step(volts, dt_s, steps)).reshape(self._state_shape)

    @staticmethod
    def _rows(given: Any, shape: tuple[int, int], what: str) -> bytes:
        """The numbers as doubles, one row a robot."""
        try:
            rows = np.asarray(given, dtype=np.float64)
        except (TypeError, ValueError) as why:
            raise OmniGapError(f"{what}: {why}; expected numbers of shape {shape}. Give an array of numbers") from None
        if rows.shape != shape:
            if rows.shape != shape[1:]:
                raise OmniGapError(
                    f"{what}: found shape {rows.shape}, expected {shape} or {shape[1:]}. Give one row for each robot"
                )
            rows = np.broadcast_to(rows, shape)
        return rows.tobytes()

    def __repr__(self) -> str:
        return f"Plant of {self.n} robot(s) with {self.wheels} wheels"
