"""The amortised contestant: gradient boosting on residual features, trained on recordings of the product's own plant.

Same physics, no hand-written logic (Radev and others, Amortized Bayesian model comparison, IEEE TNNLS 34, 2023; here trees in
place of nets). Train it first: python -m peers.train --out MODEL. `learned.py` says how it abstains. A model's file is a
pickle: load only one that you trained.
"""

import sys
from pathlib import Path

from peers.command import one_thread, run

one_thread()

import joblib  # noqa: E402

from peers.catalogue import catalogue  # noqa: E402
from peers.design import Design  # noqa: E402
from peers.features import features  # noqa: E402
from peers.learned import VERSION, Learned  # noqa: E402
from peers.mistakes import Mistake  # noqa: E402
from peers.report import PSEUDO, Answer  # noqa: E402
from peers.robot_file import carries  # noqa: E402

NAME = "classifier"
TRAINED = Path(__file__).resolve().parents[2] / "target" / "peers-classifier.joblib"
OPTIONS = [("--model", {"type": Path, "default": TRAINED, "help": "what peers.train left"})]


def loaded(path):
    """A trained model."""
    if not path.is_file():
        raise Mistake(f"{path}: no model there; train one with python -m peers.train --out {path}")
    try:
        model = joblib.load(path)
    except Exception as why:
        raise Mistake(f"{path}: not a model of this program ({type(why).__name__}); train it again") from why
    if not isinstance(model, Learned) or model.version != VERSION:
        raise Mistake(f"{path}: not a model of this version; train it again")
    return model


def answer(session, tool, asked):
    """The answer for a session."""
    model = loaded(asked.model)
    causes = {cause.id: cause for cause in catalogue(tool)}
    found = features(Design.of(tool, session), session.robot)
    which = []
    for label, weight in model.probabilities(found.vector(model.names)).items():
        if label in PSEUDO:
            which.append((label, None, weight))
        elif label in causes and not carries(session.robot, causes[label]):
            wheel = found.wheels.get(label) if causes[label].one_wheel else None
            which.append((causes[label], wheel, weight))
    return Answer(which, notes={"trained_on": model.sessions, "threshold": model.threshold})


if __name__ == "__main__":
    sys.exit(run(NAME, answer, OPTIONS))
