"""Writes a run (CSV in SI units) as a ROS 2 recording: python to_bag.py RUN.csv RUN.mcap

    pip install mcap-ros2-support
"""

import csv
import math
import sys

from mcap_ros2.writer import Writer

ARRAY = """MultiArrayLayout layout
float64[] data
================================================================================
MSG: std_msgs/MultiArrayLayout
MultiArrayDimension[] dim
uint32 data_offset
================================================================================
MSG: std_msgs/MultiArrayDimension
string label
uint32 size
uint32 stride
"""
HEADER = """================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
JOINTS = """std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
""" + HEADER
POSE = """std_msgs/Header header
Pose pose
================================================================================
MSG: geometry_msgs/Pose
Point position
Quaternion orientation
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
""" + HEADER

START_NS = 1_700_000_000_000_000_000
WHEELS = ["front", "left", "rear", "right"]

with open(sys.argv[1]) as table, open(sys.argv[2], "wb") as out:
    writer = Writer(out)
    array = writer.register_msgdef("std_msgs/msg/Float64MultiArray", ARRAY)
    joints = writer.register_msgdef("sensor_msgs/msg/JointState", JOINTS)
    pose = writer.register_msgdef("geometry_msgs/msg/PoseStamped", POSE)
    for row in csv.DictReader(table):
        at = START_NS + round(float(row["t_s"]) * 1e9)
        header = dict(stamp=dict(sec=at // 10**9, nanosec=at % 10**9), frame_id="base")

        def put(topic, schema, message):
            writer.write_message(topic=topic, schema=schema, message=message, log_time=at, publish_time=at)

        def wheels(name):
            return [float(row[name.format(j)]) for j in range(4)]

        layout = dict(dim=[], data_offset=0)
        put("/motor_voltages", array, dict(layout=layout, data=wheels("u{}_V")))
        put("/motor_currents", array, dict(layout=layout, data=wheels("i{}_A")))
        put("/joint_states", joints,
            dict(header=header, name=WHEELS, position=[], velocity=wheels("w{}_rad_s"), effort=[]))
        if row["x_m"]:
            half = 0.5 * float(row["theta_rad"])
            put("/pose", pose, dict(header=dict(header, frame_id="map"), pose=dict(
                position=dict(x=float(row["x_m"]), y=float(row["y_m"]), z=0.0),
                orientation=dict(x=0.0, y=0.0, z=math.sin(half), w=math.cos(half)))))
    writer.finish()
