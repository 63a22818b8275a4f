"""The ensemble finds a hidden term, is empty where there is only noise, and owns up to what it cannot explain."""

import numpy as np
import pytest

from peers.design import Design
from peers.sindy import weights
from peers.tests.made import FOUR

NAMES = [("dead_time", None), ("stribeck", None), ("drive_gain", 0), ("drive_gain", 1), ("resistance", None)]


def design(coefficients, strange=0.0):
    """Noise of 1 and terms of a size that shows."""
    chance = np.random.default_rng(8)
    terms = 3 * chance.standard_normal((1500, len(NAMES)))
    odd = strange * np.sign(np.sin(np.arange(1500)))
    return Design(terms @ coefficients + chance.standard_normal(1500) + odd, terms, NAMES, np.full(1500, "electrical"))


def first(made):
    by, pseudo, _ = weights(made, FOUR, models=8)
    whole = by | {(name, None): weight for name, weight in pseudo.items()}
    return max(whole, key=whole.get)


@pytest.mark.parametrize("k", range(4))
def test_the_hidden_term_is_found(k):
    assert first(design(np.eye(5)[k])) == NAMES[k]


def test_noise_is_no_gap():
    assert first(design(np.zeros(5))) == ("no_gap", None)


def test_a_number_within_its_uncertainty_is_no_gap_and_one_beyond_is_named():
    one_sigma = 0.1 / 0.2
    assert first(design([0, 0, 0, 0, one_sigma])) == ("no_gap", None)
    assert first(design([0, 0, 0, 0, 8 * one_sigma])) == ("resistance", None)


def test_what_no_term_explains_is_unknown():
    assert first(design(0.4 * np.eye(5)[0], strange=6.0)) == ("unknown", None)
