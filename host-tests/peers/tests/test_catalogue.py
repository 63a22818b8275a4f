"""The catalogue is read from what the program says of itself."""

from peers.catalogue import catalogue, effect, parameter_cause
from peers.robot_file import moved, uncertain, with_cause
from peers.tests.made import FOUR

DRIVE_GAIN = """drive_gain: Gain of one bridge (electrical stage)

Parameters
  gain_error: g, sizes the effect
      absent 0, typical −0.0500, from −0.500 to 0.500
  offset_V: o [V], shapes the effect
      0 unless the file says otherwise, from −1.00 to 1.00

To have it in a robot file (typical sizes)
  [[effects.drive_gain]]
  wheel = 0
  gain_error = -0.05
  offset_V = 0.0
"""
FRICTION = """viscous_friction: Viscous friction of the body (a parameter of the robot file)

In the robot file
  [friction] viscous_v_N_s_per_m [N·s/m]
  [friction] viscous_w_Nm_s [N·m·s]

How to measure it
"""


def test_an_effect_is_read_with_its_bounds():
    read = effect(DRIVE_GAIN)
    assert (read.id, read.stage, read.one_wheel, read.any_wheel) == ("drive_gain", "electrical", True, False)
    gain, offset = read.parameters
    assert (gain.role, gain.absent, gain.typical, gain.low, gain.high) == ("sizes", 0, -0.05, -0.5, 0.5)
    assert (offset.role, offset.typical) == ("shapes", 0)


def test_causes_are_put_into_a_robot():
    gain = effect(DRIVE_GAIN)
    changed = with_cause(FOUR, gain, {"gain_error": 0.1}, wheel=2)
    assert changed["effects"] == {"drive_gain": [{"wheel": 2, "gain_error": 0.1, "offset_V": 0.0}]}
    assert "effects" not in FOUR
    friction = parameter_cause(FRICTION)
    numbers = {"viscous_v_N_s_per_m": 2.0, "viscous_w_Nm_s": 3.0}
    changed = with_cause(FOUR, friction, numbers)["friction"]
    assert changed["viscous_v_N_s_per_m"] == 2 * 0.4978 and changed["viscous_w_Nm_s"] == 3 * 0.0141


def test_numbers_move_by_their_stated_sigma():
    robot = FOUR | {"uncertainty": {"mass_kg": 0.5}}
    z = [1.0 if where == ("body", "mass_kg") else 0.0 for where, _ in uncertain(robot)]
    assert moved(robot, z)["body"] == {"mass_kg": 2.34 * 1.5, "inertia_kg_m2": 0.0228}


def test_the_whole_catalogue_is_read(tool):
    causes = catalogue(tool)
    assert len({cause.id for cause in causes}) == len(causes) > 50
    assert {cause.kind for cause in causes} == {"effect", "parameter"}
    for cause in causes:
        assert cause.parameters and all(one.low <= one.typical <= one.high for one in cause.parameters), cause
