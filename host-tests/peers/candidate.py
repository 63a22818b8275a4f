"""Candidates of the fits: a cause, the wheel that it sits on, and the sets of shapes to try before its sizes are fitted."""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from peers.catalogue import SHAPES, SIZES
from peers.robot_file import carries, uncertain, with_cause

# What has to be logged for a cause to be seen at all: u and wset say what drives.
NEEDS = {
    "command_deadband": "wset",
    "speed_loop": "wset",
    "gyro_bias": "gyro",
    "camera_latency": "pose",
    "clock_drift": "pose",
    "camera_perspective": "pose",
    "camera_scale": "pose",
    "camera_rotation": "pose",
    "marker_offset": "pose",
    "encoder_lag": "w",
    "encoder_scale": "w",
    "current_lag": "i",
    "current_sensor_gain": "i",
    "current_sensor_offset": "i",
}

# Shapes that turn where an effect points are tried all round.
QUARTERS = tuple(k * math.pi / 2 - math.pi for k in range(4))


@dataclass(frozen=True)
class Candidate:
    """A cause on a wheel, or on all."""

    cause: object
    wheel: int | None = None

    @property
    def free(self):
        """The parameters that a fit moves."""
        return self.cause.role(SIZES) + self.cause.role(SHAPES)

    @property
    def sizes(self):
        """The parameters that size it."""
        return self.cause.role(SIZES)

    def price(self, robot, numbers):
        """What a model pays for it beside its squares.

        A parameter of an effect costs ln n (BIC); what has none still is one thing more. A number of the robot file is
        fitted with this cause or without: only its prior gets wider, from its stated sigma to a factor of e, and the ratio of
        the evidences is that of the priors' widths, 2 ln(1/sigma) in units of BIC (MacKay, Information Theory, 2003, ch. 28).
        """
        if self.cause.kind != "parameter":
            return max(1, len(self.free)) * np.log(numbers)
        stated = dict(uncertain(robot))
        sigmas = [stated.get(where, 1.0) for where in self.cause.keys]
        return sum(2 * np.log(1 / min(sigma, 1.0)) for sigma in sigmas[: len(self.free)])

    def put(self, robot, numbers):
        """A robot with it."""
        return with_cause(robot, self.cause, numbers, self.wheel)

    def starts(self):
        """The sets of shapes to try, the others at their typical value."""
        choices = []
        for one in self.cause.role(SHAPES):
            if one.key == "direction_rad":
                choices.append([(one.key, angle) for angle in QUARTERS])
            elif one.key.endswith(("_x_m", "_y_m")):
                choices.append([(one.key, one.typical), (one.key, -one.typical)])
            else:
                choices.append([(one.key, one.typical)])
        return [dict(chosen) for chosen in itertools.product(*choices)]


def candidates(causes, session):
    """All causes that the session could show: on all wheels, or, where they sit on one, on each."""
    seen = [one for one in causes if not carries(session.robot, one)]
    seen = [one for one in seen if one.id not in NEEDS or session.logs(NEEDS[one.id])]
    wheels = range(session.wheels)
    return [Candidate(one, wheel) for one in seen for wheel in (wheels if one.one_wheel else [None])]


def on_each_wheel(candidate, wheels):
    """The same cause on one wheel after the other, where it may sit on one."""
    single = candidate.cause.any_wheel and candidate.wheel is None
    return [Candidate(candidate.cause, wheel) for wheel in range(wheels)] if single else []
