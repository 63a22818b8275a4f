"""What a careful user does today: re-fit every candidate and compare by BIC.

The forward model is the product's simulator, through its command line: free runs restarted every 2 s. Nuisance numbers are
the nominal ones, each with its stated uncertainty as prior. First they alone are fitted; then every cause of the catalogue is
screened linearly, by one difference at its typical size with the nuisance numbers projected out (`linear.py`); then the best
five are fitted in full with SciPy's trust-region least squares (Branch, Coleman, Li, SIAM Journal on Scientific Computing 21,
1999) and compared:

    BIC = |r|² + |z|² + k ln n;   probability of a model exp(-BIC/2) over the sum

Schwarz, Annals of Statistics 6, 1978. A number of the robot file that is let go pays for its wider prior instead.

`unknown` is a model that leaves a chi-square of 1.5 for every number: it wins where the best fit leaves more.
"""

import sys

from peers.command import one_thread, run

one_thread()

from peers.candidate import candidates  # noqa: E402
from peers.catalogue import catalogue  # noqa: E402
from peers.clock import Clock  # noqa: E402
from peers.fit import fitted, nominal  # noqa: E402
from peers.linear import shares  # noqa: E402
from peers.problem import Problem  # noqa: E402
from peers.report import Answer  # noqa: E402
from peers.screen import screened  # noqa: E402

NAME = "bic"
HORIZON = 2.0

# Rows that one evaluation predicts at most, causes that are fitted in full, and seconds for all of it.
ROWS = 7500
FITTED = 5
SECONDS = 100.0

# The chi-square for every number above which no model is believed.
BELIEVED = 1.5

# Options of the command.
OPTIONS = [("--seconds", {"type": float, "default": SECONDS, "help": "time for the whole answer [s]"})]


def compared(robot, without, fits, numbers):
    """The entries of `which`: no gap, each fit, and unknown."""
    criteria = [without, *(criterion(robot, one, numbers) for one in fits), BELIEVED * numbers]
    names = [("no_gap", None), *((one.candidate.cause, one.candidate.wheel) for one in fits), ("unknown", None)]
    return [(*name, float(p)) for name, p in zip(names, shares(criteria), strict=True)]


def criterion(robot, one, numbers):
    """BIC of a fit."""
    return one.square + one.candidate.price(robot, numbers)


def answer(session, tool, asked):
    """The answer for a session."""
    clock = Clock(asked.seconds)
    problem = Problem.of(tool, session, HORIZON, ROWS)
    base = nominal(problem, clock.part(0.15))
    ranking = screened(problem, base, candidates(catalogue(tool), session), clock.part(0.6))
    fits = fitted(problem, base, ranking[:FITTED], clock)
    numbers = problem.numbers()
    notes = {
        "chi_square": {"numbers": numbers, "nominal": base.square / numbers}
        | {one.name(): one.square / numbers for one in fits},
        "screened": [(one.name(), one.square / numbers) for one in ranking[:15]],
        "simulations": problem.calls,
    }
    best = min(fits, key=lambda one: criterion(session.robot, one, numbers), default=None)
    return Answer(compared(session.robot, base.square, fits, numbers), robot=best and best.robot(session.robot), notes=notes)


if __name__ == "__main__":
    sys.exit(run(NAME, answer, OPTIONS))
