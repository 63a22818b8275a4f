"""MuJoCo's side of the comparison: one request a line on standard input, one answer a line on standard output.

Both are JSON. A mistake ends the program with its traceback.
"""

import json
import platform
import sys

import mujoco
import numpy
import scipy
from drive import Drive
from fit import Recordings
from model import Robot


class Worker:
    """What was asked before and is needed again."""

    def __init__(self):
        self.driven = self.recordings = None

    def versions(self, _):
        """What this runs on."""
        return {
            "Python": platform.python_version(),
            "MuJoCo": mujoco.__version__,
            "NumPy": numpy.__version__,
            "SciPy": scipy.__version__,
        }

    def drive(self, asked):
        """Where these voltages bring a robot, from rest."""
        self.driven = Drive(Robot.of(asked["robot"]), asked["volts"], asked["step"])
        return {
            "pose": self.driven.pose.tolist(),
            "twist": self.driven.twist.tolist(),
            "looped_per_s": self.driven.looped_per_s,
        }

    def steps(self, asked):
        """Steps a second of the motion driven last."""
        return {"per_s": self.driven.steps_per_s(asked["options"], asked["seconds"])}

    def recorded(self, asked):
        """Takes the recordings to fit."""
        self.recordings = Recordings(Robot.of(asked["robot"]), asked)
        return {}

    def fit(self, _):
        """One fit."""
        return self.recordings.fit()


def main():
    """Answers until nothing more is asked."""
    worker = Worker()
    for line in sys.stdin:
        asked = json.loads(line)
        print(json.dumps(getattr(worker, asked["ask"])(asked)), flush=True)


if __name__ == "__main__":
    main()
