"""The screening's algebra: nuisance is taken out exactly, amplitudes are least squares, probabilities add up."""

import numpy as np
import pytest

from peers.linear import Projection, amplitudes, shares


@pytest.fixture
def drawn():
    return np.random.default_rng(3)


def test_projection_removes_nuisance_exactly(drawn):
    nuisance = drawn.standard_normal((200, 5))
    rest = drawn.standard_normal(200)
    taken = Projection(nuisance, prior=False)
    assert np.abs(taken.out(nuisance @ [3.0, -1.0, 0.5, 7.0, -2.0])).max() < 1e-12
    assert taken.out(rest + nuisance @ np.full(5, 100.0)) == pytest.approx(taken.out(rest), abs=1e-10)


def test_a_prior_makes_nuisance_pay(drawn):
    nuisance = drawn.standard_normal((200, 3))
    residual = drawn.standard_normal(200)
    left = Projection(nuisance).out(residual)
    z = -np.linalg.solve(nuisance.T @ nuisance + np.eye(3), nuisance.T @ residual)
    whole = residual + nuisance @ z
    assert left @ left == pytest.approx(whole @ whole + z @ z)


def test_what_is_left_at_a_fit_is_the_same_as_from_the_start(drawn):
    nuisance, z = drawn.standard_normal((200, 3)), np.array([0.4, -0.2, 1.0])
    residual = drawn.standard_normal(200)
    taken = Projection(nuisance)
    assert taken.out(residual + nuisance @ z, z) == pytest.approx(taken.out(residual), abs=1e-12)


def test_amplitudes_are_found_behind_nuisance(drawn):
    nuisance, change = drawn.standard_normal((400, 4)), drawn.standard_normal((400, 2))
    change += nuisance[:, :2]
    taken = Projection(nuisance, prior=False)
    residual = taken.out(-change @ [0.7, -0.3] + nuisance @ [1.0, 2.0, 3.0, 4.0])
    found, square = amplitudes(residual, taken.out(change), [-1, -1], [1, 1])
    assert found == pytest.approx([0.7, -0.3], abs=1e-9) and square == pytest.approx(residual @ residual)
    held, less = amplitudes(residual, taken.out(change), [-1, 0], [1, 1])
    assert held[1] == pytest.approx(0, abs=1e-9) and less < square


def test_probabilities_are_those_of_their_criteria():
    first, second = shares([100.0, 100.0 + np.log(1000)])
    assert first / second == pytest.approx(np.sqrt(1000))
    assert sum(shares([1e9, 2e9, 3e9])) == pytest.approx(1)
