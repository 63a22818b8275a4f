"""All sessions on the cores of this machine."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import Optional, Union

from .._omni_gap import OmniGapError
from ._answer import Answer, answer
from ._find import find
from ._places import Place, PlaceLike
from ._store import Store

Progress = Callable[["Tally"], None]
"""Called after every session with what was done so far."""


@dataclass
class Tally:
    """What was done."""

    sessions: int
    """Sessions below the source."""
    done: int = 0
    """Answered now."""
    kept: int = 0
    """Answered before, and nothing of them changed since."""
    failed: int = 0
    """Of those done now, sessions without an answer: their rows say why."""

    def count(self, found: Optional[Answer]) -> None:
        """Counts a session."""
        self.kept += found is None
        self.done += found is not None
        self.failed += found is not None and found.row["verdict"] is None


def diagnose(
    source: Union[PlaceLike, Iterable[PlaceLike]],
    store: PlaceLike,
    *,
    jobs: Optional[int] = None,
    reports: bool = True,
    progress: Optional[Progress] = None,
) -> Tally:
    """Diagnoses the sessions below ``source`` that ``store`` does not hold as they are now.

    Killed at any time, asked again it goes on with what is left. The same tables as ``omni-gap fleet``, byte for byte.

    Args:
        source: A folder with sessions below it, or several.
        store: Where the tables are, made if need be.
        jobs: Sessions worked at at a time; one for each core unless said.
        reports: Whether the report of each session is kept in the store.
        progress: Called after every session.

    Raises:
        OmniGapError: Where the source has no session, or the store cannot be written.
    """
    if jobs is not None and jobs < 1:
        raise OmniGapError(f"jobs: found {jobs}, expected at least 1. Name more, or leave it out")
    sessions = find(source)
    tally = Tally(len(sessions))
    kept = Place.of(store) if reports else None
    jobs = jobs or os.cpu_count() or 1
    with Store(store) as tables, ThreadPoolExecutor(jobs) as pool:
        working: set[Future[Optional[Answer]]] = set()
        for session in sessions:
            working.add(pool.submit(answer, session, tables.key(session.name), kept))
            if len(working) >= 2 * jobs:
                working = _take_up(working, tables, tally, progress)
        while working:
            working = _take_up(working, tables, tally, progress)
    return tally


def _take_up(
    working: set[Future[Optional[Answer]]], tables: Store, tally: Tally, progress: Optional[Progress]
) -> set[Future[Optional[Answer]]]:
    """Waits for answers, and puts them into the tables; those that are still worked at."""
    done, rest = wait(working, return_when=FIRST_COMPLETED)
    for future in done:
        found = future.result()
        tally.count(found)
        if found is not None:
            tables.put(found)
        if progress is not None:
            progress(tally)
    return rest
