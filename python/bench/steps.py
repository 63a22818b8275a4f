"""A million steps of a hundred robots from Python, beside as many of MuJoCo's rollout, in one run; prints the page.

    python steps.py MODEL.xml PAGE.md

MODEL.xml is the robot of examples/feup-4w as `omni-gap export` writes it for MuJoCo; PAGE.md is written.
"""

import os
import platform
import statistics
import sys
import time
from pathlib import Path

import mujoco
import numpy as np
from mujoco import rollout

import omni_gap

TOP = Path(__file__).parents[2]
sys.path.insert(0, str(TOP / "host-tests" / "mujoco"))
from model import FORCES, Robot, at_rest  # noqa: E402

ROBOT = TOP / "examples" / "feup-4w" / "robot.toml"
ROBOTS, CALLS, STEP_S = 100, 10_000, 1e-3
TURNS = 5
REVERSES_S = 0.3


def volts():
    """Voltages that reverse, other ones for each robot: shape (calls, robots, wheels)."""
    sign = np.where((np.arange(CALLS) * STEP_S / REVERSES_S).astype(int) % 2 == 0, 1.0, -1.0)
    along = np.array([6.0, 0.0, -6.0, 0.0])
    return sign[:, None, None] * along * np.linspace(0.5, 1.0, ROBOTS)[:, None]


def stepped(plant, held):
    """All of it through `step`, a call a millisecond of the robots' time: the seconds that it takes."""
    plant.reset()
    begun = time.perf_counter()
    for row in held:
        plant.step(row, STEP_S)
    return time.perf_counter() - begun


class Rollout:
    """As many steps of MuJoCo in one call, on so many threads."""

    def __init__(self, model, control, spec, threads):
        self.model, self.threads = model, threads
        self.data = [mujoco.MjData(model) for _ in range(max(1, threads))]
        start = at_rest(model)
        self.state = np.empty((ROBOTS, CALLS, len(start)))
        self.call = {"initial_state": np.tile(start, (ROBOTS, 1)), "control": control, "control_spec": spec}

    def run(self):
        """The seconds that it takes."""
        with rollout.Rollout(nthread=self.threads if self.threads > 1 else 0) as loop:
            begun = time.perf_counter()
            loop.rollout(self.model, self.data, state=self.state, **self.call)
            return time.perf_counter() - begun

    def ends(self):
        """Where the robots end: shape (robots, 2), x and y."""
        return self.state[:, -1, 1:3]


def robot():
    """The robot in the numbers of host-tests/mujoco."""
    import tomllib

    file = tomllib.loads(ROBOT.read_text(encoding="utf-8"))
    motor, body, friction, wheels = (file[key] for key in ("motor", "body", "friction", "wheel"))
    angles = np.radians([wheel["drive_angle_deg"] for wheel in wheels])
    distances = np.array([wheel["distance_m"] for wheel in wheels])
    gear = motor["gear_ratio"]
    return Robot(
        mass=body["mass_kg"],
        inertia=body["inertia_kg_m2"],
        resistance=motor["resistance_ohm"],
        emf_constant=gear * motor["emf_constant_V_s"],
        torque_constant=gear * motor["torque_constant_Nm_per_A"],
        radius=wheels[0]["radius_m"],
        rows=np.column_stack([np.cos(angles), np.sin(angles), distances]),
        viscous=np.array([friction[f"viscous_{axis}"] for axis in ("v_N_s_per_m", "vn_N_s_per_m", "w_Nm_s")]),
        coulomb=np.array([friction[f"coulomb_{axis}"] for axis in ("v_N", "vn_N", "w_Nm")]),
    )


def processor():
    """What this machine calls its processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def main(model_path, page_path):
    held = volts()
    plain = omni_gap.Plant(ROBOT, n=ROBOTS)
    light = omni_gap.Plant(ROBOT, {"coriolis": {}}, n=ROBOTS)
    exported = mujoco.MjModel.from_xml_path(model_path)
    exported.opt.timestep = STEP_S
    control = np.ascontiguousarray(held.transpose(1, 0, 2))
    padded = np.zeros((ROBOTS, CALLS, exported.nu))
    padded[..., : control.shape[-1]] = control
    # along the body's axes; it does not turn here, and so they are the world's
    forces = robot().push(control)
    fastest = robot().compiled(STEP_S)
    threads = os.cpu_count() or 1
    cases = {
        "`Plant(robot, n=100).step`, 10,000 calls": lambda: stepped(plain, held),
        "the same with Coriolis terms": lambda: stepped(light, held),
    }
    rollouts = {}
    for count in sorted({1, threads}):
        told = "one thread" if count == 1 else f"{count} threads"
        rollouts[f"`mujoco.rollout`, model as exported, {told}"] = Rollout(
            exported, padded, int(mujoco.mjtState.mjSTATE_CTRL), count
        )
        rollouts[f"`mujoco.rollout`, smallest and fastest model, {told}"] = Rollout(fastest, forces, FORCES, count)
    cases |= {name: one.run for name, one in rollouts.items()}
    took = {name: [] for name in cases}
    for _ in range(TURNS):
        for name, case in cases.items():
            took[name].append(case())
    ends = plain.state[:, :2]
    for name, one in rollouts.items():
        apart = np.abs(one.ends() - ends).max()
        moved = np.abs(np.diff(one.state[:, :, 1:3], axis=1)).sum(axis=1).max()
        if not apart < 0.02 * moved:
            sys.exit(f"{name}: ends {apart} m from where the plant ends, of {moved} m driven: not the same robot")
    own = took["`Plant(robot, n=100).step`, 10,000 calls"]
    steps = ROBOTS * CALLS
    rows = []
    for name, times in took.items():
        ratio = statistics.median(other / mine for other, mine in zip(times, own))
        rows.append(f"| {name} | {statistics.median(times):.3f} s | {steps / statistics.median(times) / 1e6:.2f} million | {ratio:.2f} |")
    slower = [name for name in rollouts if statistics.median(o / m for o, m in zip(took[name], own)) <= 1]
    table = "\n".join(rows)
    Path(page_path).write_text(
        f"""# A million steps from Python

omni_gap {omni_gap.__version__}, MuJoCo {mujoco.__version__}, NumPy {np.__version__}, Python {platform.python_version()}. On \
{threads} cores of {processor()}, {sys.platform}.

A hundred robots of `examples/feup-4w/robot.toml`, each with voltages of its own that reverse every {REVERSES_S} s, go through 10,000
steps of 1 ms, in the same run, {TURNS} turns one after the other; median of the turns, ratio the median of the turns' ratios.

| what | takes | steps a second | times as long as the first |
|---|---|---|---|
{table}

`step` is called for every millisecond from a Python loop that could decide on the voltages by the state that it returned; a rollout gets
all voltages beforehand and takes all steps in one call. Its smallest and fastest model (`host-tests/mujoco/robot.xml`) has one
body, neither motors nor wheels; its forces were worked out beforehand, and that time is not counted. The model as exported is what
`omni-gap export robot.toml --out robot.xml` writes. Robots of all rows end where the plain plant's end, within 2 % of the way that they go.
""",
        encoding="utf-8",
    )
    print(Path(page_path).read_text(encoding="utf-8"))
    if slower:
        sys.exit(f"slower than {', '.join(slower)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
