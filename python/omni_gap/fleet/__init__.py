"""Many recordings, each diagnosed once, and what many robots tell together.

Sessions lie below a folder as ``ROBOT/…/SESSION/{robot.toml, runs/}``; their answers go into a store, three tables as Parquet::

    from omni_gap import fleet

    fleet.diagnose("logs", "season")           # all sessions below logs/, on all cores; asked again, only what is new or changed
    print(fleet.report("season"))              # shared causes, robots that stand out, changes

It is what the command ``omni-gap fleet`` does, with the same bytes in the tables. Folder and store may also be URIs
(``s3://bucket/logs``, ``gs://…``) or pairs of a filesystem of pyarrow or fsspec and a path in it; this needs pyarrow.
:mod:`omni_gap.fleet.ray` works at the sessions on a cluster. Any other scheduler needs :func:`find`, :func:`answer` and
:class:`Store`: an answer can be pickled, and sessions may be answered anywhere, in any order, and more than once.
"""

from ._answer import Answer, answer
from ._find import FoundSession, find
from ._places import Place
from ._store import Store
from ._threads import Tally, diagnose
from ._told import FleetReport, report

__all__ = [
    "Answer",
    "FleetReport",
    "FoundSession",
    "Place",
    "Store",
    "Tally",
    "answer",
    "diagnose",
    "find",
    "report",
]
