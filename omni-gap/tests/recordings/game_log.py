"""Writes game logs of the small size league, with Google's own protobuf: what `make.py` makes of one run.

Two cameras see the robot `yellow/3`; others drive there too, and between the detections stands what else such logs hold.
"""

import gzip
import math
import struct

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

BLANK, REFEREE, VISION, INDEX = 0, 3, 4, 6

Field = descriptor_pb2.FieldDescriptorProto
REQUIRED, OPTIONAL, REPEATED = Field.LABEL_REQUIRED, Field.LABEL_OPTIONAL, Field.LABEL_REPEATED
FLOAT, DOUBLE, UINT32, MESSAGE = Field.TYPE_FLOAT, Field.TYPE_DOUBLE, Field.TYPE_UINT32, Field.TYPE_MESSAGE

# field: (number, label, type); a message's own type stands in place of the latter
MESSAGES = {
    "SSL_DetectionBall": {
        "confidence": (1, REQUIRED, FLOAT), "area": (2, OPTIONAL, UINT32), "x": (3, REQUIRED, FLOAT),
        "y": (4, REQUIRED, FLOAT), "z": (5, OPTIONAL, FLOAT), "pixel_x": (6, REQUIRED, FLOAT),
        "pixel_y": (7, REQUIRED, FLOAT)},
    "SSL_DetectionRobot": {
        "confidence": (1, REQUIRED, FLOAT), "robot_id": (2, OPTIONAL, UINT32), "x": (3, REQUIRED, FLOAT),
        "y": (4, REQUIRED, FLOAT), "orientation": (5, OPTIONAL, FLOAT), "pixel_x": (6, REQUIRED, FLOAT),
        "pixel_y": (7, REQUIRED, FLOAT), "height": (8, OPTIONAL, FLOAT)},
    "SSL_DetectionFrame": {
        "frame_number": (1, REQUIRED, UINT32), "t_capture": (2, REQUIRED, DOUBLE), "t_sent": (3, REQUIRED, DOUBLE),
        "camera_id": (4, REQUIRED, UINT32), "balls": (5, REPEATED, "SSL_DetectionBall"),
        "robots_yellow": (6, REPEATED, "SSL_DetectionRobot"), "robots_blue": (7, REPEATED, "SSL_DetectionRobot"),
        "t_capture_camera": (8, OPTIONAL, DOUBLE)},
    "SSL_GeometryFieldSize": {
        "field_length": (1, REQUIRED, UINT32), "field_width": (2, REQUIRED, UINT32)},
    "SSL_GeometryData": {"field": (1, REQUIRED, "SSL_GeometryFieldSize")},
    "SSL_WrapperPacket": {
        "detection": (1, OPTIONAL, "SSL_DetectionFrame"), "geometry": (2, OPTIONAL, "SSL_GeometryData"),
        "source": (3, OPTIONAL, UINT32)},
}


def packet_class():
    file = descriptor_pb2.FileDescriptorProto(name="ssl_vision.proto", syntax="proto2")
    for name, fields in MESSAGES.items():
        message = file.message_type.add(name=name)
        for field, (number, label, kind) in fields.items():
            added = message.field.add(name=field, number=number, label=label)
            added.type = MESSAGE if isinstance(kind, str) else kind
            if isinstance(kind, str):
                added.type_name = "." + kind
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    return message_factory.GetMessageClass(pool.FindMessageTypeByName("SSL_WrapperPacket"))


def robot(robot_id, place, confidence=0.9):
    x, y, theta = place
    return dict(confidence=confidence, robot_id=robot_id, x=1e3 * x, y=1e3 * y, pixel_x=100.0, pixel_y=200.0,
                orientation=math.atan2(math.sin(theta), math.cos(theta)), height=140.0)


def frames(start_ns, camera_ns, pose):
    """(received ns, frame) as a recorder gets them: camera 0 is looked at later than camera 1."""
    seen = []
    for number, ns in enumerate(camera_ns):
        overlap = number >= len(camera_ns) // 2
        for camera, later_ns, looked_at_ns in [(0, 0, 9_000_000), (1, 3_000_000, 2_000_000)]:
            at_ns = ns + later_ns
            t = at_ns * 1e-9
            yellow = [robot(0, (0.5, 0.5, 0.0))]
            if camera == 0 or overlap:
                yellow.append(robot(3, pose(t)))
            if camera == 0 and number == 4:
                # a marker that was taken for it; it stands first in the frame
                yellow.insert(0, robot(3, (2.0, 2.0, 1.0), confidence=0.4))
            nameless = dict(robot(0, (1.0, 1.0, 0.0)))
            del nameless["robot_id"]
            t_capture = (start_ns + at_ns) * 1e-9
            frame = dict(
                frame_number=number, t_capture=t_capture, t_sent=t_capture + (looked_at_ns - 1_000_000) * 1e-9,
                camera_id=camera, t_capture_camera=7.0 + t, robots_yellow=yellow,
                robots_blue=[robot(11, (-1.0, t, t)), nameless],
                balls=[dict(confidence=1.0, area=80, x=10.0, y=20.0, pixel_x=1.0, pixel_y=2.0)])
            seen.append((start_ns + at_ns + looked_at_ns, frame))
            if camera == 1 and overlap and number % 3 == 0:
                # a recorder with two network cards hears it twice
                seen.append((start_ns + at_ns + looked_at_ns + 50_000, frame))
    return sorted(seen, key=lambda one: one[0])


def game_log(start_ns, camera_ns, pose):
    """The bytes of a game log."""
    packet = packet_class()
    out, offsets = [b"SSL_LOG_FILE" + struct.pack(">i", 1)], []

    def record(ns, kind, message):
        offsets.append(sum(map(len, out)))
        out.append(struct.pack(">qii", ns, kind, len(message)) + message)

    record(start_ns, REFEREE, bytes(range(40)))
    record(start_ns, BLANK, b"")
    record(start_ns, VISION, packet(geometry=dict(field=dict(field_length=9000, field_width=6000))).SerializeToString())
    # another program that sends to the same address
    record(start_ns, VISION, b"\xff\xff\xff not of SSL-Vision")
    for ns, frame in frames(start_ns, camera_ns, pose):
        record(ns, VISION, packet(detection=frame, source=2).SerializeToString())
    places = b"".join(struct.pack(">q", offset) for offset in offsets)
    message_size = len(places) + 16 + 8 + 7
    record(0, INDEX, places + struct.pack(">q", message_size) + b"INDEXED")
    return b"".join(out)


def rows(camera_ns, pose):
    """What has to be read of `yellow/3`: (ns, x, y, theta) by time, of both cameras, each once."""
    first = [ns for ns in camera_ns]
    second = [ns + 3_000_000 for ns in camera_ns[len(camera_ns) // 2:]]
    return [(ns, *pose(ns * 1e-9)) for ns in sorted(first + second)]


def write(folder, start_ns, camera_ns, pose):
    folder.mkdir(parents=True, exist_ok=True)
    log = game_log(start_ns, camera_ns, pose)
    (folder / "game.log").write_bytes(log)
    (folder / "game.log.gz").write_bytes(gzip.compress(log, mtime=0))
