"""The robot of a robot file, and the MuJoCo model of it. SI units; motor constants are those of the wheel's shaft."""

from dataclasses import dataclass, replace
from pathlib import Path

import mujoco
import numpy as np

TEMPLATE = Path(__file__).with_name("robot.xml").read_text(encoding="utf-8")

# What the option element of the template gets: what is fastest for this robot, and what MuJoCo does unasked.
OPTIONS = {
    "fastest": {
        "options": 'integrator="Euler" solver="PGS"',
        "flags": " ".join(
            f'{name}="disable"'
            for name in ("contact", "gravity", "equality", "limit", "spring", "sensor", "island", "midphase")
        ),
    },
    "default": {"options": "", "flags": ""},
}

# What a rollout is driven with: a force at each joint in every step.
FORCES = int(mujoco.mjtState.mjSTATE_QFRC_APPLIED)
STATE = mujoco.mjtState.mjSTATE_FULLPHYSICS


@dataclass(frozen=True)
class Robot:
    """The plain robot: mass, inertia, motors, wheels, and friction along (v, vn, w)."""

    mass: float
    inertia: float
    resistance: float
    emf_constant: float
    torque_constant: float
    radius: float
    rows: np.ndarray  # rim speed over body twist, a row a wheel
    viscous: np.ndarray
    coulomb: np.ndarray

    @classmethod
    def of(cls, numbers):
        """The robot of a request."""
        return cls(**{key: np.array(x) if isinstance(x, list) else x for key, x in numbers.items()})

    def scaled(self, factors):
        """The same robot with some numbers multiplied; a key is a field, or a field and the axis in it."""
        changed = {}
        for (field, axis), factor in factors.items():
            value = changed.get(field, getattr(self, field))
            if axis is None:
                changed[field] = value * factor
            else:
                changed[field] = np.array([x * factor if k == axis else x for k, x in enumerate(value)])
        return replace(self, **changed)

    def push(self, volts):
        """Force along the body's axes (v, vn, w) of motors at rest: the back-EMF is damping."""
        return np.asarray(volts) @ self.rows * (self.torque_constant / self.resistance / self.radius)

    def damping(self):
        """Viscous friction and back-EMF along (v, vn, w)."""
        electric = self.rows.T @ self.rows
        if np.abs(electric - np.diag(np.diag(electric))).max() > 1e-9:
            raise ValueError("the axes of this robot are coupled by its wheels; joint damping cannot tell that")
        motors = self.torque_constant * self.emf_constant / self.resistance / self.radius**2
        return self.viscous + motors * np.diag(electric)

    def currents(self, volts, wheel_speed):
        """Motor currents [A]."""
        return (volts - self.emf_constant * wheel_speed) / self.resistance

    def compiled(self, step, options="fastest"):
        """MuJoCo's model of it."""
        numbers = OPTIONS[options] | {
            "step": step,
            "stiff": 2 * step,
            "mass": self.mass,
            "inertia": self.inertia,
            "damping": self.damping().tolist(),
            "coulomb": self.coulomb.tolist(),
        }
        return mujoco.MjModel.from_xml_string(TEMPLATE.format(**numbers))


def at_rest(model):
    """The state of a robot at rest where the world begins, as a rollout takes it."""
    return np.zeros(mujoco.mj_stateSize(model, STATE))


def turned(forces, heading):
    """What points along the body's axes, along the world's."""
    sin, cos = np.sin(heading), np.cos(heading)
    along, across, turn = forces[..., 0], forces[..., 1], forces[..., 2]
    return np.stack([cos * along - sin * across, sin * along + cos * across, turn], axis=-1)
