"""Ensemble-SINDy: the sparse combination of the catalogue's regressors that gives the stage residuals, many times over.

    y = X c + noise,  c sparse

Sequentially thresholded least squares (Brunton, Proctor, Kutz, PNAS 113, 2016) on bags of rows (Fasel, Kutz, Brunton, Brunton,
Ensemble-SINDy, Proceedings of the Royal Society A 478, 2022), by `pysindy`. How often a term is in is its inclusion frequency.
First what the nominal numbers explain within twice their stated sigma is taken out; what they explain beyond is a parameter
cause.

Frequencies do not exclude each other; probabilities of causes have to. A cause weighs its frequency times its share of the
residual, which is what it explains in the median model. The share that the median model leaves beyond noise goes to
`unknown`; how often a model is empty, as far as nothing is left either, to `no_gap`.
"""

import sys

from peers.command import one_thread, run

one_thread()

import warnings  # noqa: E402

import numpy as np  # noqa: E402

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import pysindy  # noqa: E402

from peers.catalogue import catalogue  # noqa: E402
from peers.design import Design  # noqa: E402
from peers.nominal_terms import beyond_nominal  # noqa: E402
from peers.report import STAGES, Answer  # noqa: E402
from peers.robot_file import carries  # noqa: E402

NAME = "sindy"
MODELS = 40
SEED = 1

# A term stays in a model if it carries at least this share of what the residual's norm has beyond noise, and this many sigmas.
SHARE, SIGMAS = 0.15, 12.0

# Ridge of the least squares, for terms of norm 1: several of the catalogue's terms are nearly alike.
RIDGE = 0.3

# The mean square of what is left, over that of noise, up to which nothing is missing.
BELIEVED = 2.5


def ensemble(y, terms, threshold, models=MODELS, seed=SEED):
    """The coefficients of the models, a row each, of terms of norm 1."""
    np.random.seed(seed)  # pysindy draws its bags from NumPy's global state
    sparse = pysindy.STLSQ(threshold=threshold, alpha=RIDGE, max_iter=20)
    bags = pysindy.EnsembleOptimizer(sparse, bagging=True, n_models=models, n_subset=len(y))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        bags.fit(terms, y[:, None])
    return np.array([np.ravel(one) for one in bags.coef_list])


def weights(design, robot, models=MODELS):
    """Weights by (cause, wheel), of unknown and of no gap; the share of the residual's norm that is explained."""
    left, columns = beyond_nominal(design, robot), design.terms
    norms = np.linalg.norm(columns, axis=0)
    seen = np.flatnonzero(norms > 1e-3 * max(norms.max(), 1e-9))
    unit = columns[:, seen] / norms[seen]
    size = float(np.linalg.norm(left))
    noise = np.sqrt(len(design.y))
    excess = np.sqrt(max(size**2 - noise**2, 0.0))
    found = ensemble(left, unit, max(SHARE * excess, SIGMAS), models)
    inside = np.abs(found) > 0
    median = np.median(found, axis=0)
    by = {}
    for k, column in enumerate(seen):
        share = median[k] ** 2 / max(size**2, 1e-9)
        by[design.named[column]] = by.get(design.named[column], 0.0) + inside[:, k].mean() * share
    explained = 1 - float(np.sum((left - unit @ median) ** 2)) / max(size**2, 1e-9)
    beyond = max(size**2 * (1 - explained) - noise**2 * BELIEVED, 0.0) / max(size**2, 1e-9)
    empty = float(np.mean(~inside.any(axis=1)))
    return by, {"unknown": beyond, "no_gap": empty * (1 - beyond)}, explained


def answer(session, tool, _):
    """The answer for a session."""
    causes = {cause.id: cause for cause in catalogue(tool)}
    design = Design.of(tool, session)
    by, pseudo, explained = weights(design, session.robot)
    which = [(causes[name], wheel, w) for (name, wheel), w in by.items() if w > 0 and not carries(session.robot, causes[name])]
    which += [(name, None, weight + 1e-6) for name, weight in pseudo.items()]
    stage = {"camera": "sensing", "gyro": "sensing", "parity": "contact", "loop": "electrical", "supply": "electrical"}
    stages = dict.fromkeys(STAGES, 1e-9)
    for name in np.unique(design.stage):
        stages[stage.get(str(name), str(name))] += float(np.sum(design.y[design.stage == name] ** 2))
    return Answer(which, stages, notes={"explained": explained})


if __name__ == "__main__":
    sys.exit(run(NAME, answer))
