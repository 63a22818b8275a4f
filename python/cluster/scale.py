"""Many sessions on this machine, then on a cluster of three nodes of which one is killed: the page of what that came to.

    python scale.py SESSIONS PAGE
"""

import os
import sys
import tempfile
import time
from pathlib import Path

import pyarrow.parquet
import ray
from nodes import cluster, kill_after_a_third
from stage import ROWS, RUNS, stage, tables

import omni_gap.fleet.ray
from omni_gap import fleet

NODES = 3


def on_threads(logs, store):
    """The tables of this machine, and how long it took (s)."""
    begun = time.perf_counter()
    fleet.diagnose(logs, store, reports=False)
    return tables(store), time.perf_counter() - begun


def on_ray(logs, store):
    """The tables of a cluster that loses a node after a third of the sessions; when, what was done, and how long it took (s)."""
    with cluster(NODES) as (made, nodes):
        kill, killed = kill_after_a_third(made, nodes[1])
        begun = time.perf_counter()
        tally = omni_gap.fleet.ray.diagnose(logs, store, reports=False, progress=kill)
        took_s = time.perf_counter() - begun
        again = omni_gap.fleet.ray.diagnose(logs, store, reports=False)
    return tables(store), killed[0], tally, again, took_s


def main(sessions, page):
    with tempfile.TemporaryDirectory() as folder:
        logs = Path(folder, "logs")
        stage(logs, sessions)
        here, here_s = on_threads(logs, Path(folder, "here"))
        there, killed_at, tally, again, there_s = on_ray(logs, Path(folder, "there"))
        names = pyarrow.parquet.read_table(Path(folder, "there/sessions"), columns=["session"])["session"].to_pylist()
    same = here == there
    text = f"""# Many sessions on a cluster that loses a node

{sessions} sessions of {RUNS * ROWS} rows, without reports, on this machine ({os.cpu_count()} cores), then by Ray {ray.__version__} on {NODES} nodes of a core each, all on this
machine; one node is killed, with all its processes, once a third of the answers are in.

| what | |
|---|---|
| wall clock on the cores of this machine | {here_s:.0f} s |
| on {NODES} nodes, one of them killed after {killed_at} answers | {there_s:.0f} s |
| answers taken up; asked again: done, known | {tally.done}; {again.done}, {again.kept} |
| rows of sessions; different ones | {len(names)}; {len(set(names))} |
| files of tables; with the same bytes as those of this machine | {len(there)}; {sum(there.get(name) == here[name] for name in here)} |
"""
    print(text)
    Path(page).write_text(text, encoding="utf-8")
    if not (same and len(names) == len(set(names)) == tally.done == sessions and again.done == 0):
        sys.exit("the cluster's tables are not those of this machine")


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
