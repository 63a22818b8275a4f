"""Numbers that tell sessions apart, whatever the robot, the number of wheels and the length of the recordings.

Of the regression y = X c of `design.py`, with what the nominal numbers explain within twice their sigma taken out:

    for every regressor x:   x·y / (|x| sqrt(n)),   its share of the residual with its sign, and x·y / |x|² (1: typical size)
    for every stage:         root mean square, fourth moment over the square of the second, correlation of neighbours

Of a regressor that sits on a wheel, the wheel where it is largest, and how far the second is behind.
"""

from dataclasses import dataclass

import numpy as np

from peers.nominal_terms import beyond_nominal


@dataclass(frozen=True)
class Features:
    """Features by name, and the wheel on which each cause would sit."""

    values: dict
    wheels: dict

    def vector(self, names):
        """Those of a list; what this session does not have is not a number."""
        return np.array([self.values.get(name, np.nan) for name in names])


def features(design, robot):
    """The features of a session's regression."""
    left = beyond_nominal(design, robot)
    values, wheels, seen, sits = {}, {}, {}, {}
    for k, (cause, wheel) in enumerate(design.named):
        turn = seen[cause, wheel] = seen.get((cause, wheel), -1) + 1
        found = of_regressor(left, design.terms[:, k])
        if wheel is None:
            values |= {f"{cause}.{turn}.{what}": value for what, value in found.items()}
        else:
            wheels.setdefault((cause, turn), {})[wheel] = found
    for (cause, turn), found in wheels.items():
        order = sorted(found, key=lambda wheel: -abs(found[wheel]["score"]))
        first, second = found[order[0]], found[order[1]]
        values |= {f"{cause}.{turn}.{what}": value for what, value in first.items()}
        values[f"{cause}.{turn}.behind"] = abs(second["score"]) / max(abs(first["score"]), 1e-9)
        sits.setdefault(cause, order[0])
    return Features(values | of_stages(left, design.stage), sits)


def of_regressor(left, column):
    """What a regressor has in common with the residual."""
    norm, size = np.linalg.norm(column), np.linalg.norm(left)
    if norm < 1e-9 or size < 1e-9:
        return {"score": 0.0, "share": 0.0, "size": 0.0}
    along = float(column @ left) / norm
    share = np.sign(along) * (along / size) ** 2
    return {"score": along / np.sqrt(left.size), "share": share, "size": float(np.clip(along / norm, -10, 10))}


def of_stages(left, stage):
    """The size and shape of each stage's residual."""
    values = {}
    for name in np.unique(stage):
        part = left[stage == name]
        square = max(float(np.mean(part**2)), 1e-12)
        values |= {
            f"{name}.rms": np.sqrt(square),
            f"{name}.tails": float(np.mean(part**4)) / square**2,
            f"{name}.neighbours": float(np.mean(part[1:] * part[:-1])) / square if part.size > 1 else 0.0,
        }
    return values
