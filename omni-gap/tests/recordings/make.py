"""Writes one small run in every format that a robot's recording comes in, by the formats' own libraries.

    pip install -r requirements.txt && python make.py

The run is three tenths of a second of formulas: no robot drove it, and nothing of this project wrote it. `drive.csv` and
`camera.csv` hold the same numbers as text, and `vision/yellow3.csv` what two cameras of a game log saw of it.
"""

import math
import shutil
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from mcap.writer import CompressionType, Writer
from mcap_protobuf.writer import Writer as ProtobufWriter
from mcap_ros2.writer import Writer as Ros2Writer
from rosbags.rosbag1 import Writer as Bag1
from rosbags.rosbag2 import StoragePlugin, Writer as Bag2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

import game_log

HERE = Path(__file__).parent
START_NS = 1_700_000_000_000_000_000
WHEELS = ["front", "left", "right"]

# 200 rows a second of the drive; 60 frames a second of a camera, its clock the same
DRIVE_NS = [k * 5_000_000 for k in range(60)]
CAMERA_NS = [1_000_000 + k * 16_666_667 for k in range(18)]


def drive(t):
    """Volts, rad/s, rad/s about the vertical, volts of the battery."""
    u = [6.0 * math.sin(7.0 * t + j) for j in range(3)]
    w = [20.0 * math.sin(7.0 * t + j - 0.3) for j in range(3)]
    return u, w, 1.5 * math.cos(5.0 * t), 12.0 - 0.2 * math.sin(3.0 * t)


def pose(t):
    """Metres and radians; the heading goes over a half turn."""
    return 0.4 * math.sin(2.0 * t), 0.3 * math.cos(2.0 * t), 3.0 + 1.2 * t


def wrapped(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def quaternion(angle):
    return dict(x=0.0, y=0.0, z=math.sin(0.5 * angle), w=math.cos(0.5 * angle))


def stamp(ns):
    return dict(sec=(START_NS + ns) // 10**9, nanosec=(START_NS + ns) % 10**9)


def seconds(ns):
    return f"{(START_NS + ns) // 10**9}.{(START_NS + ns) % 10**9:09d}"


def csv():
    with open(fresh("csv/drive.csv"), "w") as out:
        out.write("t_s,u0_V,u1_V,u2_V,w0_rad_s,w1_rad_s,w2_rad_s,vbat_V,gyro_rad_s\n")
        for ns in DRIVE_NS:
            u, w, gyro, vbat = drive(ns * 1e-9)
            out.write(",".join([seconds(ns)] + [repr(number) for number in u + w + [vbat, gyro]]) + "\n")
    with open(fresh("csv/camera.csv"), "w") as out:
        out.write("t_s,x_m,y_m,theta_rad\n")
        for ns in CAMERA_NS:
            x, y, theta = pose(ns * 1e-9)
            out.write(",".join([seconds(ns), repr(x), repr(y), repr(wrapped(theta))]) + "\n")


def vision():
    """A game log of the camera's frames, and of a second camera's between some of them."""
    game_log.write(HERE / "vision", START_NS, CAMERA_NS, pose)
    with open(fresh("vision/yellow3.csv"), "w") as out:
        out.write("t_s,x_m,y_m,theta_rad\n")
        for ns, x, y, theta in game_log.rows(CAMERA_NS, pose):
            out.write(f"{seconds(ns)},{x!r},{y!r},{wrapped(theta)!r}\n")


def fresh(name):
    path = HERE / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    return path


def messages():
    """All messages as (topic, type, nanoseconds, fields), in the order of their times."""
    all_messages = []
    for ns in DRIVE_NS:
        u, w, gyro, vbat = drive(ns * 1e-9)
        head = dict(stamp=stamp(ns), frame_id="base")
        # recorded 2 ms after it was measured; the joints are not in the wheels' order
        order = [2, 0, 1]
        all_messages += [
            ("/joint_states", "sensor_msgs/msg/JointState", ns + 2_000_000, dict(
                header=head, name=[WHEELS[j] for j in order], position=[], velocity=[w[j] for j in order], effort=[])),
            ("/voltages", "std_msgs/msg/Float64MultiArray", ns, dict(layout=dict(dim=[], data_offset=0), data=u)),
            ("/imu", "sensor_msgs/msg/Imu", ns + 1_000_000, dict(
                header=head, orientation=quaternion(0.0), orientation_covariance=[0.0] * 9,
                angular_velocity=dict(x=0.0, y=0.0, z=gyro), angular_velocity_covariance=[0.0] * 9,
                linear_acceleration=dict(x=0.0, y=0.0, z=9.81), linear_acceleration_covariance=[0.0] * 9)),
            ("/battery", "sensor_msgs/msg/BatteryState", ns + 1_000_000, dict(
                header=head, voltage=vbat, temperature=math.nan, current=math.nan, charge=math.nan, capacity=math.nan,
                design_capacity=math.nan, percentage=0.9, power_supply_status=2, power_supply_health=1,
                power_supply_technology=3, present=True, cell_voltage=[vbat / 3] * 3, cell_temperature=[],
                location="", serial_number="")),
        ]
    for ns in CAMERA_NS:
        x, y, theta = pose(ns * 1e-9)
        head = dict(stamp=stamp(ns), frame_id="map")
        rotation = quaternion(theta)
        place = dict(x=x, y=y, z=0.0)
        all_messages += [
            ("/pose", "geometry_msgs/msg/PoseStamped", ns + 9_000_000, dict(
                header=head, pose=dict(position=place, orientation=rotation))),
            ("/odom", "nav_msgs/msg/Odometry", ns + 9_000_000, dict(
                header=head, child_frame_id="base",
                pose=dict(pose=dict(position=place, orientation=rotation), covariance=[0.0] * 36),
                twist=dict(twist=dict(linear=dict(x=0.0, y=0.0, z=0.0), angular=dict(x=0.0, y=0.0, z=0.0)),
                           covariance=[0.0] * 36))),
            ("/tf", "tf2_msgs/msg/TFMessage", ns, dict(transforms=[
                dict(header=head, child_frame_id=frame, transform=dict(translation=where, rotation=rotation))
                for frame, where in [("arm", dict(x=9.0, y=9.0, z=9.0)), ("base", place)]])),
        ]
    return sorted(all_messages, key=lambda message: message[2])


def ros2_mcap(name, compression):
    store = get_typestore(Stores.ROS2_HUMBLE)
    with open(fresh(name), "wb") as out:
        writer = Ros2Writer(out, compression=compression)
        schemas = {}
        for topic, kind, ns, fields in messages():
            if kind not in schemas:
                text, _ = store.generate_msgdef(kind, ros_version=2)
                schemas[kind] = writer.register_msgdef(kind, text)
            at = START_NS + ns
            writer.write_message(topic=topic, schema=schemas[kind], message=fields, log_time=at, publish_time=at)
        writer.finish()


def build(store, kind, fields):
    """A message of the library `rosbags`, of nested dictionaries."""
    members = {}
    for name, (node, detail) in store.fielddefs[kind][1]:
        value = fields[name]
        if node == 2 and not isinstance(value, str):
            members[name] = build(store, detail, value)
        elif node in (3, 4):
            inner, what = detail[0]
            if inner == 2:
                members[name] = [build(store, what, one) for one in value]
            elif what[0] == "string":
                members[name] = list(value)
            else:
                members[name] = np.array(value, dtype=what[0])
        else:
            members[name] = value
    return store.types[kind](**members)


def prepared(store):
    """Field definitions by name, as `build` wants them."""
    for topic, kind, ns, fields in messages():
        if "seq" in dict(store.fielddefs.get("std_msgs/msg/Header", ((), ()))[1]):
            fields = with_sequence(fields)
        yield topic, kind, ns, build(store, kind, fields)


def with_sequence(fields):
    """ROS 1 numbers its headers."""
    if isinstance(fields, list):
        return [with_sequence(one) for one in fields]
    if not isinstance(fields, dict):
        return fields
    changed = {name: with_sequence(value) for name, value in fields.items()}
    return dict(seq=0, **changed) if set(changed) == {"stamp", "frame_id"} else changed


def ros2_bag(name, keep_definitions):
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    store = get_typestore(Stores.ROS2_HUMBLE)
    with Bag2(folder, version=9, storage_plugin=StoragePlugin.SQLITE3) as bag:
        connections = {}
        for topic, kind, ns, message in prepared(store):
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, kind, typestore=store)
            bag.write(connections[topic], START_NS + ns, store.serialize_cdr(message, kind))
    if not keep_definitions:
        import sqlite3

        with sqlite3.connect(next(folder.glob("*.db3"))) as database:
            database.execute("DROP TABLE message_definitions")
        database.execute("VACUUM")
        database.close()


def ros2_split(name):
    """One recording in two files, as rosbag2 lays it out: its library writes no splits, so each half is a recording of it."""
    folder = HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    store = get_typestore(Stores.ROS2_HUMBLE)
    everything = list(prepared(store))
    half = len(everything) // 2
    files = [f"{name}_{k}.mcap" for k in range(2)]
    for file, part in zip(files, [everything[:half], everything[half:]]):
        own = folder / "part"
        with Bag2(own, version=9, storage_plugin=StoragePlugin.MCAP) as bag:
            connections = {}
            for topic, kind, ns, message in part:
                if topic not in connections:
                    connections[topic] = bag.add_connection(topic, kind, typestore=store)
                bag.write(connections[topic], START_NS + ns, store.serialize_cdr(message, kind))
        (own / "part.mcap").rename(folder / file)
        text = (own / "metadata.yaml").read_text()
        shutil.rmtree(own)
    listed = "".join(f"  - {file}\n" for file in files)
    (folder / "metadata.yaml").write_text(text.replace("  - part.mcap\n", listed))


def ros1_bag(name, compression):
    store = get_typestore(Stores.ROS1_NOETIC)
    store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
    bag = Bag1(fresh(name))
    if compression:
        bag.set_compression(compression)
    with bag:
        connections = {}
        for topic, kind, ns, message in prepared(store):
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, kind, typestore=store)
            bag.write(connections[topic], START_NS + ns, store.serialize_ros1(message, kind))


def json_mcap(name):
    import json

    with open(fresh(name), "wb") as out:
        writer = Writer(out, compression=CompressionType.NONE)
        writer.start()
        channels = {}
        for topic, kind, ns, fields in messages():
            if topic not in channels:
                schema = writer.register_schema(name=kind, encoding="jsonschema", data=b'{"type": "object"}')
                channels[topic] = writer.register_channel(topic=topic, message_encoding="json", schema_id=schema)
            text = json.dumps(fields).replace("NaN", "null").encode()
            at = START_NS + ns
            writer.add_message(channels[topic], log_time=at, publish_time=at, data=text)
        writer.add_attachment(create_time=0, log_time=0, name="notes.txt", media_type="text/plain", data=b"carpet")
        writer.finish()


def protobuf_mcap(name):
    """One topic of the team's own, as small-size teams write them."""
    file = descriptor_pb2.FileDescriptorProto(name="robot.proto", package="team", syntax="proto3")
    file.dependency.append("google/protobuf/timestamp.proto")
    state = file.message_type.add(name="RobotState")
    field = descriptor_pb2.FieldDescriptorProto
    state.field.add(name="stamp", number=1, type=field.TYPE_MESSAGE, type_name=".google.protobuf.Timestamp",
                    label=field.LABEL_OPTIONAL)
    for number, name_of in [(2, "voltage"), (3, "wheel_speed")]:
        state.field.add(name=name_of, number=number, type=field.TYPE_DOUBLE, label=field.LABEL_REPEATED)
    for number, name_of in [(4, "battery"), (5, "gyro")]:
        state.field.add(name=name_of, number=number, type=field.TYPE_DOUBLE, label=field.LABEL_OPTIONAL)
    pool = descriptor_pool.Default()
    from google.protobuf import timestamp_pb2  # noqa: F401, its file has to be in the pool

    pool.Add(file)
    message_class = message_factory.GetMessageClass(pool.FindMessageTypeByName("team.RobotState"))
    with open(fresh(name), "wb") as out, ProtobufWriter(out) as writer:
        for ns in DRIVE_NS:
            u, w, gyro, vbat = drive(ns * 1e-9)
            message = message_class(voltage=u, wheel_speed=w, battery=vbat, gyro=gyro)
            message.stamp.FromNanoseconds(START_NS + ns)
            at = START_NS + ns
            writer.write_message(topic="/robot", message=message, log_time=at, publish_time=at)


def parquet(name, compression, unit):
    """One table; the pose is a struct that is null where the camera gave no frame."""
    frames = {ns: pose(ns * 1e-9) for ns in CAMERA_NS}
    instants = sorted({*DRIVE_NS, *CAMERA_NS})
    rows = [drive(ns * 1e-9) if ns in set(DRIVE_NS) else None for ns in instants]
    columns = {"time": pa.array([(START_NS + ns) // unit[1] for ns in instants], pa.timestamp(unit[0]))}
    for j in range(3):
        columns[f"volts_{j}"] = pa.array([row and row[0][j] for row in rows], pa.float64())
        columns[f"speed_{j}"] = pa.array([row and row[1][j] for row in rows], pa.float64())
    columns["gyro"] = pa.array([row and row[2] for row in rows], pa.float64())
    columns["battery"] = pa.array([row and row[3] for row in rows], pa.float64())
    kind = pa.struct([("x", pa.float64()), ("y", pa.float64()), ("heading", pa.float64())])
    columns["pose"] = pa.array([
        dict(x=frames[ns][0], y=frames[ns][1], heading=wrapped(frames[ns][2])) if ns in frames else None
        for ns in instants], kind)
    columns["note"] = pa.array(["carpet"] * len(instants))
    pq.write_table(pa.table(columns), fresh(name), compression=compression, row_group_size=64)


if __name__ == "__main__":
    csv()
    vision()
    for compression in (CompressionType.NONE, CompressionType.LZ4, CompressionType.ZSTD):
        ros2_mcap(f"ros2-{compression.name.lower()}.mcap", compression)
    ros2_bag("ros2-sqlite", keep_definitions=True)
    ros2_bag("ros2-sqlite-foxy", keep_definitions=False)
    ros2_split("ros2-split")
    ros1_bag("ros1-none.bag", None)
    ros1_bag("ros1-bz2.bag", Bag1.CompressionFormat.BZ2)
    ros1_bag("ros1-lz4.bag", Bag1.CompressionFormat.LZ4)
    json_mcap("json.mcap")
    protobuf_mcap("protobuf.mcap")
    for compression in ("none", "snappy", "gzip", "brotli", "lz4", "zstd"):
        parquet(f"table-{compression}.parquet", compression, ("ns", 1))
    parquet("table-us.parquet", "snappy", ("us", 1_000))
