"""Residuals are in sigmas, headings go round, and a series' memory is measured."""

import numpy as np
import pytest

from peers.residuals import correlation_time, difference, group, sigma, wheel
from peers.tests.made import FOUR


def test_columns_know_their_group_and_wheel():
    names = ["i0_A", "w3_rad_s", "x_m", "y_m", "theta_rad", "gyro_rad_s", "vbat_V"]
    assert [group(name) for name in names] == ["i", "w", "pose", "pose", "pose", "gyro", "vbat"]
    assert [wheel(name) for name in names] == [0, 3, None, None, None, None, None]


def test_headings_differ_by_less_than_half_a_turn():
    off = difference("theta_rad", np.array([3.1, 0.2]), np.array([-3.1, 0.1]))
    assert off == pytest.approx([6.2 - 2 * np.pi, 0.1])
    assert difference("x_m", np.array([6.2]), np.array([0.0])) == pytest.approx([6.2])


def test_a_silent_file_leaves_the_noise_to_the_log():
    drawn = np.random.default_rng(1).normal(0, 0.02, 20000) + np.linspace(0, 5, 20000)
    assert sigma(FOUR, "gyro_rad_s", drawn) == pytest.approx(0.02, rel=0.05)
    assert sigma(FOUR, "i2_A", drawn) == 0.02


@pytest.mark.parametrize("a", [0.0, 0.5, 0.9])
def test_the_memory_of_an_autoregression_is_its_closed_form(a):
    chance = np.random.default_rng(2).standard_normal(40000)
    series = np.empty_like(chance)
    series[0] = chance[0]
    for k in range(1, series.size):
        series[k] = a * series[k - 1] + chance[k]
    assert correlation_time(series) == pytest.approx((1 + a) / (1 - a), rel=0.2)
