"""Full fits: the nominal numbers with their prior, and the parameters of one candidate within their bounds.

The sensitivities to the nominal numbers are taken anew at the start of each fit, and kept while it runs: a Gauss-Newton
iteration with an inexact Jacobian (Dembo, Eisenstat, Steihaug, SIAM Journal on Numerical Analysis 19, 1982) that costs few
simulations. What is compared are sums of squares, which are exact.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from peers.candidate import Candidate
from peers.robot_file import moved

ITERATIONS = 8
SETTLED = 1e-4

# Differences by a cause's parameters, as a share of their scale.
STEP = 0.02


@dataclass(frozen=True)
class Nominal:
    """The nominal robot with its numbers re-fitted within their uncertainty."""

    z: np.ndarray
    robot: dict
    residual: np.ndarray
    nuisance: np.ndarray

    @property
    def square(self):
        """The sum of squares, prior included."""
        return float(self.residual @ self.residual + self.z @ self.z)


@dataclass(frozen=True)
class Fit:
    """A fitted candidate."""

    candidate: Candidate
    square: float
    z: np.ndarray
    numbers: dict

    def robot(self, nominal_robot):
        """The robot with the fitted numbers and the cause."""
        return self.candidate.put(moved(nominal_robot, self.z), self.numbers)

    def name(self):
        """The cause and its wheel."""
        wheel = self.candidate.wheel
        return self.candidate.cause.id + ("" if wheel is None else f" on wheel {wheel}")


class TimeOver(Exception):
    """No time is left for one more simulation."""


def nominal(problem, clock):
    """Gauss-Newton steps of the nominal numbers alone, halved where they do not help."""
    z = np.zeros(problem.known)
    residual = problem.residual(problem.robot)
    nuisance = problem.nuisance(z, residual)
    for _ in range(ITERATIONS):
        if clock.over():
            break
        step = -np.linalg.lstsq(
            np.vstack([nuisance, np.eye(z.size)]), np.concatenate([residual, z]), rcond=None
        )[0]
        before, found = residual @ residual + z @ z, None
        for share in (1.0, 0.5, 0.25):
            tried = problem.residual(moved(problem.robot, z + share * step))
            if tried @ tried + (z + share * step) @ (z + share * step) < before:
                found = (z + share * step, tried)
                break
        if found is None:
            break
        z, residual = found
        after = residual @ residual + z @ z
        nuisance = problem.nuisance(z, residual)
        if before - after < 1e-3 * before:
            break
    return Nominal(z, moved(problem.robot, z), residual, nuisance)


def fitted(problem, base, ranking, clock):
    """Full fits of the candidates, each with its share of the time that is left."""
    fits = []
    for k, one in enumerate(ranking):
        if clock.over():
            break
        fits.append(Fitting(problem, base, one, clock.part(1 / (len(ranking) - k))).done())
    return fits


class Fitting:
    """One fit: x holds the nominal numbers' z, then the candidate's parameters over their scales."""

    def __init__(self, problem, base, screened, clock):
        self.problem, self.base, self.clock = problem, base, clock
        self.candidate = screened.candidate
        self.free = self.candidate.free
        self.scale = np.array([scale(one) for one in self.free])
        self.start = screened.start
        self.best = (np.inf, None)
        self.nuisance = None

    def numbers(self, x):
        """The candidate's parameters."""
        values = x[self.problem.known :] * self.scale
        return {one.key: float(value) for one, value in zip(self.free, values, strict=True)}

    def residual(self, x):
        """Whitened residuals, and the prior's below."""
        if self.clock.over() and self.best[1] is not None:
            raise TimeOver
        z = x[: self.problem.known]
        robot = self.candidate.put(moved(self.problem.robot, z), self.numbers(x))
        whole = np.concatenate([self.problem.residual(robot), z])
        square = float(whole @ whole)
        if square < self.best[0]:
            self.best = (square, np.array(x))
        return whole

    def jacobian(self, x):
        """The differences by the parameters, and the kept ones by the nominal numbers."""
        known = self.problem.known
        here = self.residual(x)
        if self.nuisance is None:
            numbers = self.numbers(x)
            rows = self.problem.nuisance(x[:known], here[:-known], lambda robot: self.candidate.put(robot, numbers))
            self.nuisance = np.vstack([rows, np.eye(known)])
        columns = []
        for k in range(known, x.size):
            inward = STEP if x[k] + STEP <= self.bounds()[1][k] else -STEP
            beside = np.array(x)
            beside[k] += inward
            columns.append((self.residual(beside) - here) / inward)
        return np.column_stack([self.nuisance, *columns])

    def bounds(self):
        """Bounds of x."""
        known = self.problem.known
        low = np.array([one.low for one in self.free]) / self.scale
        high = np.array([one.high for one in self.free]) / self.scale
        return np.concatenate([np.full(known, -8.0), low]), np.concatenate([np.full(known, 8.0), high])

    def begun(self):
        """Where it begins: at the screening's amplitudes, or at the typical size where that is better."""
        low, high = self.bounds()
        inside = 1e-3 * (high - low)
        begins = []
        for size in ({}, {one.key: one.typical for one in self.candidate.sizes}):
            numbers = {one.key: one.typical for one in self.free} | self.start | size
            x = np.concatenate([self.base.z, np.array([numbers[one.key] for one in self.free]) / self.scale])
            begins.append(np.clip(x, low + inside, high - inside))
        squares = [float(np.sum(self.residual(x) ** 2)) for x in begins]
        return begins[int(np.argmin(squares))]

    def done(self):
        """The fit, as far as the time allows."""
        try:
            options = {"bounds": self.bounds(), "ftol": SETTLED, "xtol": SETTLED, "max_nfev": ITERATIONS}
            begun = self.begun()
            least_squares(self.residual, begun, self.jacobian, x_scale="jac", **options)
            self.nuisance = None
            least_squares(self.residual, self.best[1], self.jacobian, x_scale="jac", **options)
        except TimeOver:
            pass
        square, x = self.best
        return Fit(self.candidate, square, x[: self.problem.known], self.numbers(x))


def scale(one):
    """The scale of a parameter: how far typical is from absent, or a tenth of its range."""
    return abs(one.typical - one.absent) or 0.1 * (one.high - one.low)
