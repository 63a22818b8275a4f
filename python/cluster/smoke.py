"""Sessions in an object store, on a cluster of one node: the same tables as on the cores of this machine.

    python smoke.py
"""

import faulthandler
import sys
import tempfile
from pathlib import Path

from bucket import bucket, download, upload
from nodes import cluster
from stage import stage, tables

import omni_gap.fleet.ray
from omni_gap import fleet

SESSIONS = 3
PORT = 5573
PATIENCE_S = 300


def main():
    faulthandler.dump_traceback_later(PATIENCE_S, exit=True)  # a cluster that hangs says where
    with tempfile.TemporaryDirectory() as folder, bucket(PORT) as s3:
        logs = Path(folder, "logs")
        stage(logs, SESSIONS)
        upload(logs, s3, "robots/logs")
        with cluster(nodes=1):
            tally = omni_gap.fleet.ray.diagnose((s3, "robots/logs"), (s3, "robots/on-ray"))
        here = fleet.diagnose((s3, "robots/logs"), (s3, "robots/here"))
        found = []
        for store in ("on-ray", "here"):
            download(s3, f"robots/{store}", Path(folder, store))
            found.append(tables(Path(folder, store)))
        if not (tally.done == here.done == SESSIONS and found[0] == found[1] and len(found[0]) == 3 * SESSIONS):
            sys.exit(f"{tally} on Ray, {here} here; {sorted(found[0])} and {sorted(found[1])}")
        print(f"{SESSIONS} sessions in an object store: the same tables from Ray and from threads, byte for byte.")


if __name__ == "__main__":
    main()
