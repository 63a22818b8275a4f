//! # Definitions of the usual messages, for recordings that carry none
//!
//! Field by field as in the packages of ROS 2 (github.com/ros2/common_interfaces, github.com/ros2/geometry2); their
//! order is what the bytes follow.

const TIME: (&str, &str) = ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec");
const HEADER: (&str, &str) = ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id");
const VECTOR3: (&str, &str) = ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z");
const POINT: (&str, &str) = ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z");
const QUATERNION: (&str, &str) = ("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w");
const POSE: (&str, &str) = ("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation");
const TWIST: (&str, &str) = ("geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular");
const POSE_COVARIANCE: (&str, &str) =
    ("geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance");
const TWIST_COVARIANCE: (&str, &str) =
    ("geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance");
const TRANSFORM: (&str, &str) =
    ("geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation");
const TRANSFORM_STAMPED: (&str, &str) = (
    "geometry_msgs/TransformStamped",
    "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform",
);
const LAYOUT: (&str, &str) = ("std_msgs/MultiArrayLayout", "std_msgs/MultiArrayDimension[] dim\nuint32 data_offset");
const DIMENSION: (&str, &str) = ("std_msgs/MultiArrayDimension", "string label\nuint32 size\nuint32 stride");

/// A message, and those inside it.
struct Usual {
    name: &'static str,
    fields: &'static str,
    inner: &'static [(&'static str, &'static str)],
}

const ALL: [Usual; 12] = [
    Usual {
        name: "sensor_msgs/msg/JointState",
        fields: "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort",
        inner: &[HEADER, TIME],
    },
    Usual {
        name: "sensor_msgs/msg/Imu",
        fields: "std_msgs/Header header\n\
                 geometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n\
                 geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n\
                 geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance",
        inner: &[HEADER, TIME, QUATERNION, VECTOR3],
    },
    Usual {
        name: "sensor_msgs/msg/BatteryState",
        fields: "std_msgs/Header header\nfloat32 voltage\nfloat32 temperature\nfloat32 current\nfloat32 charge\n\
                 float32 capacity\nfloat32 design_capacity\nfloat32 percentage\nuint8 power_supply_status\n\
                 uint8 power_supply_health\nuint8 power_supply_technology\nbool present\nfloat32[] cell_voltage\n\
                 float32[] cell_temperature\nstring location\nstring serial_number",
        inner: &[HEADER, TIME],
    },
    Usual {
        name: "nav_msgs/msg/Odometry",
        fields: "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n\
                 geometry_msgs/TwistWithCovariance twist",
        inner: &[HEADER, TIME, POSE_COVARIANCE, TWIST_COVARIANCE, POSE, TWIST, POINT, QUATERNION, VECTOR3],
    },
    Usual {
        name: "geometry_msgs/msg/PoseStamped",
        fields: "std_msgs/Header header\ngeometry_msgs/Pose pose",
        inner: &[HEADER, TIME, POSE, POINT, QUATERNION],
    },
    Usual {
        name: "geometry_msgs/msg/PoseWithCovarianceStamped",
        fields: "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose",
        inner: &[HEADER, TIME, POSE_COVARIANCE, POSE, POINT, QUATERNION],
    },
    Usual {
        name: "geometry_msgs/msg/Twist",
        fields: "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular",
        inner: &[VECTOR3],
    },
    Usual {
        name: "geometry_msgs/msg/TwistStamped",
        fields: "std_msgs/Header header\ngeometry_msgs/Twist twist",
        inner: &[HEADER, TIME, TWIST, VECTOR3],
    },
    Usual {
        name: "geometry_msgs/msg/TransformStamped",
        fields: TRANSFORM_STAMPED.1,
        inner: &[HEADER, TIME, TRANSFORM, VECTOR3, QUATERNION],
    },
    Usual {
        name: "tf2_msgs/msg/TFMessage",
        fields: "geometry_msgs/TransformStamped[] transforms",
        inner: &[TRANSFORM_STAMPED, HEADER, TIME, TRANSFORM, VECTOR3, QUATERNION],
    },
    Usual {
        name: "std_msgs/msg/Float64MultiArray",
        fields: "std_msgs/MultiArrayLayout layout\nfloat64[] data",
        inner: &[LAYOUT, DIMENSION],
    },
    Usual {
        name: "std_msgs/msg/Float32MultiArray",
        fields: "std_msgs/MultiArrayLayout layout\nfloat32[] data",
        inner: &[LAYOUT, DIMENSION],
    },
];

/// The names of all of them.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    ALL.iter().map(|usual| usual.name)
}

/// The definition of a message, in the form in which recordings carry them.
pub(super) fn definition(of_type: &str) -> Option<String> {
    let usual = ALL.iter().find(|usual| usual.name == of_type)?;
    let inner = usual.inner.iter().map(|(name, fields)| format!("\n===\nMSG: {name}\n{fields}"));
    Some(usual.fields.to_owned() + &inner.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::source::bag::ros::{Definition, Wire};

    #[test]
    fn every_definition_has_all_that_it_names() {
        for name in names() {
            let text = definition(name).unwrap();
            let definition = Definition::parse(name, &text, Wire::Cdr).unwrap();
            // a message of zeros: every list empty, every text empty
            let zeros = [&[0, 1, 0, 0][..], &[0; 1024]].concat();
            assert!(definition.decode(&zeros).is_ok(), "{name}");
        }
    }
}
