"""Tells why an omnidirectional robot does not do what its simulator says.

A session is a robot file and recordings. Both may be files or in memory::

    import omni_gap

    diagnosis = omni_gap.diagnose("SESSION")
    print(diagnosis)                                  # what the command says
    diagnosis.to_dict()["which"][0]["probability"]    # report.json, number for number

    run = {"t_s": t, "u0_V": u0, "u1_V": u1, "u2_V": u2, "x_m": x, "y_m": y, "theta_rad": theta}
    omni_gap.diagnose(run, robot="robot.toml")

Every function takes recordings as paths, dictionaries of one-dimensional arrays, pandas and polars frames, structured arrays,
and anything with ``__arrow_c_stream__``. Columns have the names of a run log: ``t_s``, ``u0_V``, ``i0_A``, ``w0_rad_s``,
``x_m``, ``y_m``, ``theta_rad``, ``gyro_rad_s``, ``vbat_V`` and the rest of ``omni-gap explain runs``; NaN and null mark samples that
are missing. Robots are paths of robot files, or dictionaries in their form.

The work is done without the interpreter's lock. Input that cannot be used raises :class:`OmniGapError` with one message.
Ctrl-C ends the work where its next phase begins, at the latest where it ends, and raises ``KeyboardInterrupt``.
"""

from ._commands import check, compare, diagnose, identify, next, predict, selftest, simulate  # noqa: A004
from ._omni_gap import OmniGapError, __version__
from ._plant import Plant
from ._results import Check, Comparison, Design, Diagnosis, Identification, Run, SelfTest

__all__ = [
    "Check",
    "Comparison",
    "Design",
    "Diagnosis",
    "Identification",
    "OmniGapError",
    "Plant",
    "Run",
    "SelfTest",
    "__version__",
    "check",
    "compare",
    "diagnose",
    "identify",
    "next",
    "predict",
    "selftest",
    "simulate",
]
