"""The fixed triage table: where a residual is largest, and what a person would look for first there.

Derived from "where it shows" of the cards (host-tests/golden/effects.md): of the effects whose card names the signal first
and that are common on robots, the one whose regime is the widest. A wheel that stands out is a fault of that wheel.

| signal | all wheels alike | one wheel |
|---|---|---|
| current | dead_time: while a current flows, however large | motor_mismatch: the faster it moves |
| wheel speed | coriolis: the faster it turns while it drives | wheel_friction: while it moves |
| position | camera_scale: the farther from where it began | |
| heading | camera_latency: heading most, the faster it moves | |
| yaw rate | gyro_bias: at all times, at rest too | |
| bus voltage | supply_sag: bus voltage most | |
"""

ALL = {
    "i": "dead_time",
    "w": "coriolis",
    "position": "camera_scale",
    "heading": "camera_latency",
    "gyro": "gyro_bias",
    "vbat": "supply_sag",
}
ONE = {"i": "motor_mismatch", "w": "wheel_friction"}

# A wheel stands out where its signal is this many times the median of all wheels.
STANDS_OUT = 1.5
