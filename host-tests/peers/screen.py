"""The linear screening: what each candidate would take of the residual that re-fitted nominal numbers leave."""

from dataclasses import dataclass

import numpy as np

from peers.candidate import Candidate, on_each_wheel
from peers.linear import Projection, amplitudes

# How many of the best are looked at wheel by wheel.
CLOSER = 3


@dataclass(frozen=True)
class Screened:
    """A candidate, what it would leave, and where a fit of it begins."""

    candidate: Candidate
    square: float
    start: dict

    def name(self):
        """The cause and its wheel."""
        wheel = self.candidate.wheel
        return self.candidate.cause.id + ("" if wheel is None else f" on wheel {wheel}")


def screened(problem, base, offered, clock):
    """The candidates, the most promising first; a cause that may sit on several wheels stands there once."""
    projection = Projection(base.nuisance)
    left = projection.out(base.residual, base.z)
    numbers = problem.numbers()

    def criterion(one):
        return one.square + one.candidate.price(problem.robot, numbers)

    def looked_at(some):
        found = []
        for candidate in some:
            if clock.over():
                break
            looks = [look(problem, base, projection, left, candidate, start) for start in candidate.starts()]
            found.append(min(looks, key=lambda one: one.square))
        return found

    ranking = sorted(looked_at(offered), key=criterion)
    for one in ranking[:CLOSER]:
        ranking += looked_at(on_each_wheel(one.candidate, len(problem.robot["wheel"])))
    once = {}
    for one in sorted(ranking, key=criterion):
        once.setdefault(one.candidate.cause.id, one)
    return list(once.values())


def look(problem, base, projection, left, candidate, shapes):
    """One candidate: a difference for each parameter that sizes it, or for all of it where none does."""
    sizes = candidate.sizes
    changes, low, high = [], [], []
    for one in sizes:
        span = one.typical - one.absent
        numbers = shapes | {other.key: other.absent for other in sizes} | {one.key: one.typical}
        changes.append(problem.residual(candidate.put(base.robot, numbers)) - base.residual)
        low.append(min((one.low - one.absent) / span, (one.high - one.absent) / span))
        high.append(max((one.low - one.absent) / span, (one.high - one.absent) / span))
    if not sizes:
        whole = projection.out(problem.residual(candidate.put(base.robot, {})) - base.residual)
        return Screened(candidate, float((left + whole) @ (left + whole)), dict(shapes))
    columns = projection.out(np.column_stack(changes))
    norms = np.linalg.norm(columns, axis=0)
    if norms.max() < 1e-6:
        return Screened(candidate, float(left @ left), shapes | {one.key: one.typical for one in sizes})
    found, taken = amplitudes(left, columns, np.array(low) - 1e-9, np.array(high) + 1e-9)
    start = {one.key: one.absent + a * (one.typical - one.absent) for one, a in zip(sizes, found, strict=True)}
    return Screened(candidate, float(left @ left) - taken, shapes | start)
