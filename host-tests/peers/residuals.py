"""Residuals of free runs, measured minus predicted, in units of each sensor's stated sigma.

    r = (y - y_model) / sigma,  headings modulo 2 pi

and how large they are where there is no gap: the nominal robot is simulated over the same inputs and predicted by itself
(a parametric bootstrap: Efron, Tibshirani, An Introduction to the Bootstrap, 1993, ch. 6). Windows are restarted from a
smoothed measurement, so that even a perfect model leaves more than the sensor's noise.
"""

from dataclasses import dataclass

import numpy as np

from peers.robot_file import moved, uncertain
from peers.session import Run

# The noise of a column by the letters that it begins with.
NOISE = (
    ("i", "current_noise_A"),
    ("w", "wheel_speed_noise_rad_s"),
    ("theta", "heading_noise_rad"),
    ("x_", "position_noise_m"),
    ("y_", "position_noise_m"),
    ("gyro", "gyro_noise_rad_s"),
    ("vbat", "battery_noise_V"),
)


def group(column):
    """The signal group of a column: i, w, pose, gyro or vbat."""
    if column in ("x_m", "y_m", "theta_rad"):
        return "pose"
    return column.split("_")[0].rstrip("0123456789")


def wheel(column):
    """The wheel of a column, or None."""
    digits = column.split("_")[0].lstrip("iw")
    return int(digits) if group(column) in ("i", "w") else None


def sigma(robot, column, measured):
    """The stated noise of a column; where the file is silent, the white part of the log's own.

    Differences of neighbours have sqrt(2) the noise; 1.4826 times the median of their sizes is their sigma (Huber, 1981).
    """
    key = next(key for start, key in NOISE if column.startswith(start))
    stated = robot["sensors"].get(key, 0.0)
    if stated > 0:
        return stated
    steps = np.abs(np.diff(measured[np.isfinite(measured)]))
    return max(1.4826 * np.median(steps) / np.sqrt(2), 1e-9) if steps.size else 1.0


def difference(column, measured, predicted):
    """Measured minus predicted; headings modulo 2 pi."""
    off = measured - predicted
    return np.mod(off + np.pi, 2 * np.pi) - np.pi if column == "theta_rad" else off


def residuals(tool, robot, run, horizon, sensors=None):
    """The residuals of a run by column [sigma], not-a-number where nothing was measured."""
    predicted = tool.predict(robot, run.path, horizon)
    stated = sensors or robot
    return {
        column: difference(column, run.columns[column], values) / sigma(stated, column, run.columns[column])
        for column, values in predicted.items()
        if column != "t_s" and len(values) == len(run.time)
    }


def rms(values):
    """The root mean square of what is there; 0 where nothing is."""
    values = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def by_column(parts):
    """Residuals of several runs, column by column, in one piece."""
    names = dict.fromkeys(name for part in parts for name in part)
    return {name: np.concatenate([part[name] for part in parts if name in part]) for name in names}


def correlation_time(values):
    """Rows after which a series is new: 1 + 2 times the sum of its autocorrelation up to its first zero (Geyer 1992)."""
    values = values[np.isfinite(values)]
    if values.size < 8:
        return 1.0
    values = values - values.mean()
    power = np.abs(np.fft.rfft(values, 2 * values.size)) ** 2
    correlation = np.fft.irfft(power)[: values.size]
    if correlation[0] <= 0:
        return 1.0
    correlation = correlation / correlation[0]
    negative = np.flatnonzero(correlation < 0)
    end = negative[0] if negative.size else values.size
    return float(max(1.0, 1 + 2 * correlation[1:end].sum()))


@dataclass(frozen=True)
class Floor:
    """What residuals are without a gap, by column: root mean square [sigma] and correlation time [rows]."""

    size: dict
    rows: dict

    @classmethod
    def replayed(cls, tool, session, horizon, runs=None):
        """Of the nominal robot, predicted by itself."""
        parts = [replay(tool, session.robot, session.robot, run, horizon, k) for k, run in enumerate(runs or session.runs)]
        together = by_column(parts)
        longest = {name: max(correlation_time(part[name]) for part in parts if name in part) for name in together}
        return cls({name: max(rms(values), 0.1) for name, values in together.items()}, longest)


def replay(tool, real, nominal, run, horizon, seed):
    """Residuals of the nominal robot against a recording that another robot made of the same inputs."""
    again = Run.read(tool.simulate(real, run.path, seed, tool.folder / "replay.csv"))
    return residuals(tool, nominal, again, horizon)


def drawn_sizes(tool, session, horizon, draws, seed):
    """Root mean squares by column where only noise and the numbers' stated uncertainty act: one dictionary a draw."""
    chance = np.random.default_rng(seed)
    known = len(uncertain(session.robot))
    sizes = []
    for draw in range(draws):
        real = moved(session.robot, chance.standard_normal(known))
        parts = [replay(tool, real, session.robot, run, horizon, 1000 * draw + k) for k, run in enumerate(session.runs)]
        sizes.append({name: rms(values) for name, values in by_column(parts).items()})
    return sizes
