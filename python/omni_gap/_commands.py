"""What the commands do, over files and over what is in memory."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Optional, Union

from . import _inputs, _omni_gap
from ._inputs import PathLike, RobotLike, RunLike, SessionLike, is_path
from ._omni_gap import OmniGapError
from ._results import Check, Comparison, Design, Diagnosis, Identification, Run, SelfTest

Columns = Union[PathLike, Mapping[str, Any], None]


def diagnose(
    session: SessionLike,
    robot: Optional[RobotLike] = None,
    *,
    columns: Columns = None,
    also: Iterable[SessionLike] = (),
    horizon_s: float = 0.5,
    without: Sequence[str] = (),
    max_rows: Optional[int] = None,
    name: Optional[str] = None,
) -> Diagnosis:
    """Says where the gap lies, which cause it has, and how far it shrinks once the cause is in the model.

    The same bits as ``omni-gap diagnose``. Recordings that cannot be used are no error but the verdict ``unfit_data``.

    Args:
        session: A session folder; else, with ``robot``, recordings: paths of run logs or of folders of them, or columns in memory
            (a dictionary of arrays of shape ``(rows,)``, a frame, a table of Arrow), a list of these, or a dictionary of these by
            name. Columns are in SI units at the wheel's shaft: ``t_s`` (s), ``u0_V`` (V), ``i0_A`` (A), ``w0_rad_s`` (rad/s), ``x_m``
            and ``y_m`` (m), ``theta_rad`` (rad).
        robot: The robot file: its path, or a dictionary in its form.
        columns: A mapping from another log layout: the path of a ``columns.toml``, or a dictionary in its form.
        also: Further sessions of the same robot, judged together with these.
        horizon_s: Time between restarts of the free runs that measure the gap (s).
        without: Causes to leave out, as if the catalogue did not have them.
        max_rows: Rows that the answer rests on at the most; at least 1000, 60000 unless said.
        name: What the report calls the session; a folder's name unless said.

    Raises:
        OmniGapError: Where an input cannot be read or used.
    """
    _above_zero("horizon_s", horizon_s, "seconds")
    if max_rows is not None and max_rows < 1000:
        raise OmniGapError(f"max_rows: found {max_rows}, expected at least 1000. Name more rows")
    made = _inputs.session(session, robot, columns, name)
    more = _inputs.beside(also, _robot_of(session, robot), columns)
    how = {"horizon_s": float(horizon_s), "without": _causes(without), "max_rows": max_rows}
    return Diagnosis(_omni_gap.diagnose(made, more, how))


def identify(
    session: SessionLike,
    robot: Optional[RobotLike] = None,
    *,
    columns: Columns = None,
    experiment: Optional[str] = None,
) -> Identification:
    """Fits the robot file's numbers, and those of the effects in it, to recordings.

    Args:
        session: As for :func:`diagnose`.
        robot: As for :func:`diagnose`.
        columns: As for :func:`diagnose`.
        experiment: One of the paper's experiments, ``1`` (or ``spin``), ``2`` (or ``coast``), ``motor``, ``3`` (or ``step``), or ``all``;
            a fit to all runs together unless said.

    Raises:
        OmniGapError: Where an input cannot be read, has a fault that spoils any fit, or nothing in it can drive the model.
    """
    return Identification(_omni_gap.identify(_inputs.session(session, robot, columns), experiment))


def predict(robot: RobotLike, run: RunLike, *, horizon_s: float = 0.5, columns: Columns = None) -> Run:
    """Predicts the measured columns of a run by free runs that restart every ``horizon_s`` (s) from the smoothed measurement.

    Args:
        robot: The robot file: its path, or a dictionary in its form.
        run: The recording: its path, or columns of shape ``(rows,)`` in memory.
        horizon_s: Time between restarts (s).
        columns: As for :func:`diagnose`.

    Returns:
        The run's measured columns, predicted: arrays of shape ``(rows,)``, filled on every row.

    Raises:
        OmniGapError: Where an input cannot be read, or nothing in the run can drive the model.
    """
    _above_zero("horizon_s", horizon_s, "seconds")
    of = _inputs.robot(robot)
    return Run(_omni_gap.predict(of, _inputs.run(run, of, columns), float(horizon_s)))


def simulate(
    robot: RobotLike, run: RunLike, *, seed: Optional[int] = None, noise: bool = True, columns: Columns = None
) -> Run:
    """Records what a robot file's model does with a run's inputs, at rest in the origin at first.

    Args:
        robot: The robot file: its path, or a dictionary in its form.
        run: The recording whose inputs and clock to take; poses are seen on the rows where it has one.
        seed: Seed of the noise; the same seed gives the same run.
        noise: Whether to add the noise that ``[sensors]`` states; with it a seed is needed.
        columns: As for :func:`diagnose`.

    Returns:
        Columns of shape ``(rows,)``: the inputs, currents (A), wheel speeds (rad/s), poses (m, m, rad).

    Raises:
        OmniGapError: Where an input cannot be read, nothing in the run can drive the model, or noise lacks a seed.
    """
    if noise and seed is None:
        raise OmniGapError("noise is drawn from a seed, and none is given. Name one with seed=1, or go without: noise=False")
    of = _inputs.robot(robot)
    return Run(_omni_gap.simulate(of, _inputs.run(run, of, columns), seed if noise else None))


def selftest(
    robot: RobotLike,
    *,
    scripts: Sequence[RunLike] = (),
    columns: Columns = None,
    sensors: Optional[Sequence[str]] = None,
    runs: int = 6,
    duration_s: float = 10.0,
    rate_hz: float = 200.0,
    camera_hz: Optional[float] = None,
    voltage_V: Optional[float] = None,  # noqa: N803
    verify: bool = False,
) -> SelfTest:
    """Says what recordings of a robot could show: which causes, from what size on, mistaken for which others.

    Args:
        robot: The robot file: its path, or a dictionary in its form.
        scripts: Recordings or scripts whose inputs are to be played, in place of random motion.
        columns: As for :func:`diagnose`, for the scripts.
        sensors: What is logged: some of ``i``, ``w``, ``pose``, ``gyro``, ``vbat``; the first three unless said.
        runs: How many random runs.
        duration_s: Length of each (s).
        rate_hz: Rows a second (1/s).
        camera_hz: Camera frames a second (1/s); 60 unless said, of scripts what they have.
        voltage_V: Largest voltage on any motor (V).
        verify: Also find each size in simulated recordings; this takes minutes.

    Raises:
        OmniGapError: Where an input cannot be read, or nothing in a script can drive the model.
    """
    of = _inputs.robot(robot)
    if is_path(scripts):
        scripts = [scripts]
    played = [_inputs.run(script, of, columns) for script in scripts]
    if not 1 <= runs <= 100:
        raise OmniGapError(f"runs: found {runs}, expected from 1 to 100. Name another number")
    _above_zero("duration_s", duration_s, "seconds")
    for what, rate in [("rate_hz", rate_hz), ("camera_hz", camera_hz)]:
        if rate is not None and not 1 <= rate <= 10_000:
            raise OmniGapError(f"{what}: found {rate}, expected from 1 to 10000 a second. Name another rate")
    if not 2 <= duration_s * rate_hz <= 100_000:
        raise OmniGapError(
            "duration_s times rate_hz: a run has from 2 to 100000 rows. Choose both so that their product is within"
        )
    if voltage_V is not None:
        _above_zero("voltage_V", voltage_V, "volts")
    plan = {
        "runs": runs,
        "duration_s": float(duration_s),
        "rate_hz": float(rate_hz),
        "camera_hz": camera_hz,
        "voltage_V": voltage_V,
        "sensors": None if sensors is None else list(sensors),
        "verify": verify,
    }
    return SelfTest(_omni_gap.selftest(of, played, plan))


def next(  # noqa: A001
    session: SessionLike,
    robot: Optional[RobotLike] = None,
    *,
    columns: Columns = None,
    also: Iterable[SessionLike] = (),
    duration_s: float = 10.0,
    voltage_V: Optional[float] = None,  # noqa: N803
    field_m: Optional[float] = None,
    without: Sequence[str] = (),
    name: Optional[str] = None,
) -> Design:
    """Says what to record or measure next, so that what a diagnosis leaves open is settled.

    Args:
        session: As for :func:`diagnose`.
        robot: As for :func:`diagnose`.
        columns: As for :func:`diagnose`.
        also: As for :func:`diagnose`.
        duration_s: Length of the script (s), from 5 to 120.
        voltage_V: Largest voltage on a motor (V); no more than the recordings have seen unless said.
        field_m: Side of the free floor (m); that of ``[limits]``, or 3 m, unless said.
        without: As for :func:`diagnose`.
        name: As for :func:`diagnose`.

    Raises:
        OmniGapError: Where an input cannot be read or used.
    """
    if not 5 <= duration_s <= 120:
        raise OmniGapError(f"duration_s: found {duration_s}, expected from 5 to 120 s. Choose another length")
    for what, value, unit in [("voltage_V", voltage_V, "volts"), ("field_m", field_m, "metres")]:
        if value is not None:
            _above_zero(what, value, unit)
    made = _inputs.session(session, robot, columns, name)
    more = _inputs.beside(also, _robot_of(session, robot), columns)
    wish = {
        "duration_s": float(duration_s),
        "voltage_V": voltage_V,
        "field_m": field_m,
        "without": _causes(without),
    }
    return Design(_omni_gap.next(made, more, wish))


def compare(
    a: SessionLike,
    b: SessionLike,
    robot: Optional[RobotLike] = None,
    *,
    columns: Columns = None,
    simulator: bool = False,
    a_columns: Columns = None,
    without: Sequence[str] = (),
) -> Comparison:
    """Says which cause explains the difference between two sessions, or what a simulator's log leaves out.

    Args:
        a: The first session, whose model is the yardstick: a session folder, a run log or a folder of them, or recordings in memory.
        b: The second session.
        robot: The robot file of sessions that have none; unless said, a session without one is of the other's robot.
        columns: A mapping from another log layout, as for :func:`diagnose`.
        simulator: Whether ``a`` is what a simulator says of the inputs of ``b`` (``omni-gap compare B --sim A``).
        a_columns: The mapping of a simulator's log.
        without: As for :func:`diagnose`.

    Raises:
        OmniGapError: Where an input cannot be read, or the robots have not as many wheels each.
    """
    first = _side(a, b, robot, a_columns if simulator else columns, 0)
    second = _side(b, a, robot, columns, 1)
    return Comparison(_omni_gap.compare(first, second, simulator, _causes(without)))


def check(session: SessionLike, robot: Optional[RobotLike] = None, *, columns: Columns = None) -> Check:
    """Looks for faults of the recordings, says how to mend them, and what the recordings can tell at best.

    Args:
        session: As for :func:`diagnose`.
        robot: As for :func:`diagnose`.
        columns: As for :func:`diagnose`.

    Raises:
        OmniGapError: Where an input cannot be read.
    """
    return Check(_omni_gap.check(_inputs.session(session, robot, columns)))


def _side(
    given: SessionLike, other: SessionLike, robot: Optional[RobotLike], columns: Columns, at: int
) -> _omni_gap.Session:
    """One side of a comparison."""
    if robot is None:
        own = [os.path.join(os.fspath(side), "robot.toml") for side in (given, other) if is_path(side)]
        found = [path for path in own if os.path.isfile(path)]
        if not found:
            place = os.fspath(given) if is_path(given) else "robot"
            raise OmniGapError(
                f"{place}: there is no robot.toml, neither here nor on the other side. "
                'Put one into the session, or name one with robot="robot.toml"'
            )
        robot = found[0]
    if is_path(given):
        path, columns = os.fspath(given), _inputs.path_of(columns)
        if os.path.join(path, "robot.toml") == robot and os.path.isdir(os.path.join(path, "runs")):
            return _omni_gap.Session.load(path, columns)
        side = _omni_gap.Session(_inputs.robot(robot), os.path.basename(os.path.realpath(path)))
        side.add_any(path, columns)
        return side
    side = _omni_gap.Session(_inputs.robot(robot), "ab"[at])
    _inputs.add_runs(side, given, columns)
    return side


def _robot_of(session: SessionLike, robot: Optional[RobotLike]) -> RobotLike:
    """The robot of a session that was read, for others of the same."""
    return os.path.join(os.fspath(session), "robot.toml") if robot is None else robot


def _causes(names: Sequence[str]) -> list[str]:
    """Names of causes, each one of the catalogue's."""
    return _omni_gap.causes([names] if isinstance(names, str) else list(names))


def _above_zero(what: str, value: float, unit: str) -> None:
    if not 0 < value < float("inf"):
        raise OmniGapError(f"{what}: found {value}, expected a number of {unit} above zero. Name one, such as 0.5")
