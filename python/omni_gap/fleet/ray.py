"""All sessions on the machines of a Ray cluster: ``pip install "omni-gap[ray]"`` on each of them.

::

    import ray
    from omni_gap import fleet
    import omni_gap.fleet.ray

    ray.init("auto")
    omni_gap.fleet.ray.diagnose("s3://robots/logs", "s3://robots/season")
    print(fleet.report("s3://robots/season"))

Source and store are places that every machine reaches: a shared folder, or an object store. Ray Data holds back work where the
answers that wait would take too much memory, and works anew at what a machine had that died; here one program takes the answers up
and writes the tables. They have the same bytes as those of one machine.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterable
from typing import Any, Optional, Union

import ray.data

from ._answer import Answer, answer
from ._find import FoundSession, find
from ._places import Place, PlaceLike
from ._store import Store
from ._threads import Progress, Tally

AT_A_TIME = 4
"""Sessions of a task: what is worked at anew where a machine dies."""


def dataset(sessions: Iterable[FoundSession], held: dict[str, Optional[str]], store: Optional[PlaceLike] = None) -> ray.data.Dataset:
    """The answers of sessions as a data set, a row each: what :meth:`Answer.of_tables <omni_gap.fleet.Answer.of_tables>` takes; no row
    of a session that is as it was when the answer of the key in ``held`` was made.

    Args:
        sessions: The sessions.
        held: The key of the answer that the store holds, by the session's name.
        store: Where reports are put; nowhere unless said.
    """
    rows = [{"session": pickle.dumps(session), "held": held.get(session.name)} for session in sessions]
    asked = ray.data.from_items(rows, override_num_blocks=max(1, len(rows) // AT_A_TIME))
    return asked.flat_map(_answered, fn_kwargs={"store": store}, num_cpus=1)


def _answered(row: dict[str, Any], store: Optional[PlaceLike]) -> list[dict[str, Any]]:
    found = answer(pickle.loads(row["session"]), row["held"], store)
    return [] if found is None else [dict(zip(("sessions", "causes", "equations"), found.tables()))]


def diagnose(
    source: Union[PlaceLike, Iterable[PlaceLike]],
    store: PlaceLike,
    *,
    reports: bool = True,
    progress: Optional[Progress] = None,
) -> Tally:
    """As :func:`omni_gap.fleet.diagnose`, on the cluster that Ray is connected to.

    Args:
        source: A place with sessions below it that every machine reaches, or several.
        store: Where the tables are, made if need be; written to by this program.
        reports: Whether the report of each session is kept in the store, which every machine must then reach.
        progress: Called after every session that was answered.

    Raises:
        OmniGapError: Where the source has no session, or the store cannot be written.
    """
    sessions = find(source)
    tally = Tally(len(sessions))
    with Store(store) as tables:
        held = {session.name: tables.key(session.name) for session in sessions}
        for row in dataset(sessions, held, Place.of(store) if reports else None).iter_rows():
            found = Answer.of_tables(**row)
            tally.count(found)
            tables.put(found)
            if progress is not None:
                progress(tally)
    tally.kept = tally.sessions - tally.done
    return tally
