"""What is learned: gradient boosting on residual features, and from what confidence on it is believed.

Histogram gradient boosting (Ke and others, LightGBM, NIPS 2017; Friedman, Annals of Statistics 29, 2001) gives a probability
for every cause that it was trained on. That it was trained on another is told by low confidence (Hendrycks, Gimpel, A baseline
for detecting misclassified and out-of-distribution examples, ICLR 2017): a second model is trained without some of the causes,
and on sessions that neither has seen the threshold is set where withheld and known causes are told apart best.

    probability of unknown = 1 / (1 + exp(slope·(logit(p_max) - logit(threshold))))
"""

import warnings
from dataclasses import dataclass

import numpy as np
from sklearn.ensemble import HistGradientBoostingClassifier

VERSION = 1

# Of the sessions, kept for the threshold; of the causes, withheld for it.
HELD_OUT, WITHHELD = 0.25, 0.25

# How steeply unknown takes over.
SLOPE = 2.0


@dataclass(frozen=True)
class Learned:
    """A trained contestant, as it is kept in a file."""

    version: int
    names: list
    model: object
    threshold: float
    sessions: int

    def probabilities(self, vector):
        """The probability of every label, `unknown` among them."""
        known = self.model.predict_proba(vector[None, :])[0]
        unknown = doubt(known.max(), self.threshold)
        return {"unknown": unknown} | {
            str(label): float(p) * (1 - unknown) for label, p in zip(self.model.classes_, known, strict=True)
        }


def doubt(confidence, threshold):
    """The probability of unknown at a confidence."""
    return float(1 / (1 + np.exp(SLOPE * (logit(confidence) - logit(threshold)))))


def logit(p):
    """The logarithm of the odds."""
    p = np.clip(p, 1e-6, 1 - 1e-6)
    return np.log(p / (1 - p))


def boosted(table, labels, seed):
    """A trained model."""
    model = HistGradientBoostingClassifier(
        max_iter=60, learning_rate=0.1, max_leaf_nodes=15, min_samples_leaf=4, l2_regularization=1.0, random_state=seed
    )
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "The number of unique classes", UserWarning)
        return model.fit(table, labels)


def best_threshold(known, withheld):
    """The confidence that tells known from withheld causes best: the mean of both rates of being right is largest."""
    if not known.size or not withheld.size:
        return 0.2
    offered = np.unique(np.concatenate([known, withheld]))
    between = (offered[1:] + offered[:-1]) / 2 if offered.size > 1 else offered
    right = [np.mean(known >= one) + np.mean(withheld < one) for one in between]
    return float(np.clip(between[int(np.argmax(right))], 0.05, 0.95))


def learned(table, labels, names, seed):
    """The whole: a threshold on sessions held out, then a model of all sessions."""
    chance = np.random.default_rng(seed)
    labels = np.asarray(labels)
    causes = np.setdiff1d(np.unique(labels), ["no_gap"])
    withheld = chance.choice(causes, max(1, round(WITHHELD * causes.size)), replace=False)
    out = chance.random(labels.size) < HELD_OUT
    strange = np.isin(labels, withheld)
    some = boosted(table[~out & ~strange], labels[~out & ~strange], seed)
    trained = np.isin(labels, some.classes_)

    def confidence(rows):
        return some.predict_proba(table[rows]).max(axis=1) if rows.any() else np.empty(0)

    threshold = best_threshold(confidence(out & trained), confidence(out & strange))
    return Learned(VERSION, names, boosted(table, labels, seed), threshold, labels.size)
