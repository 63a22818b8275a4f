"""A cluster of Ray's own test kit: several nodes, each with processes of its own, on this machine."""

import os
from contextlib import contextmanager

os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # before Ray is imported: nothing is sent to its makers

import ray
from ray.cluster_utils import Cluster

STORE_BYTES = 150 * 2**20


@contextmanager
def cluster(nodes, cores=1):
    """Nodes with so many cores each, and a head that works at nothing; the cluster and its nodes."""
    made = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False})
    try:
        added = [made.add_node(num_cpus=cores, object_store_memory=STORE_BYTES) for _ in range(nodes)]
        ray.init(address=made.address, log_to_driver=False, logging_level="ERROR")
        yield made, added
    finally:
        ray.shutdown()
        made.shutdown()


def kill_after_a_third(made, node):
    """What a fleet is to call after every session: it kills a node once a third is done; and a list that then has that many."""
    killed = []

    def progress(tally):
        if tally.done >= tally.sessions // 3 and not killed:
            killed.append(tally.done)
            made.remove_node(node, allow_graceful=False)

    return progress, killed
