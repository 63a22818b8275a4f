"""Peers: what others would enter in the benchmark of the diagnosis, each a command that leaves a report.

    python -m peers.NAME SESSION_FOLDER --out DIR [--omni-gap PATH]

run from the folder above this one. README.md beside this file tells the contestants apart.
"""
