//! The same small run in every format, written by the formats' own libraries (`recordings/make.py`), reads as the same run.

use omni_gap::error::Error;
use omni_gap::log::{Catalogue, Channel, Columns, RobotFile, Run};
use std::path::{Path, PathBuf};

/// The topics of the run as a ROS robot records it.
const TOPICS: &str = include_str!("recordings/columns/topics.toml");

const POSE: &str = include_str!("recordings/columns/pose.toml");

const ODOMETRY: &str = r#"
    [[file]]
    topic = "/odom"
    [file.columns]
    x_m = { from = "pose.pose.position.x" }
    y_m = { from = "pose.pose.position.y" }
    theta_rad = { from = "pose.pose.orientation.yaw" }
"#;

const TRANSFORM: &str = r#"
    [[file]]
    topic = "/tf"
    [file.columns]
    x_m = { from = "transforms[base].transform.translation.x" }
    y_m = { from = "transforms[base].transform.translation.y" }
    theta_rad = { from = "transforms[base].transform.rotation.yaw" }
"#;

const TABLE: &str = include_str!("recordings/columns/table.toml");

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings")
}

fn robot() -> RobotFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("robots/feup-3w/robot.toml");
    RobotFile::load(&path, &Catalogue::default()).unwrap()
}

fn opened(name: &str, columns: &str) -> Result<(Run, Vec<String>), Error> {
    let columns = Columns::parse(columns, Path::new("columns.toml"))?;
    Run::open(&folder().join(name), &robot(), Some(&columns))
}

/// The same numbers, read as text.
fn expected() -> Run {
    opened("csv", "[[file]]\nname = \"drive.csv\"\n[[file]]\nname = \"camera.csv\"").unwrap().0
}

/// Whether both runs say the same at the same instants; the battery's volts are single numbers in a ROS message.
#[track_caller]
fn assert_same(run: &Run, name: &str) {
    let expected = expected();
    let samples = |run: &Run, channel: &Channel| -> Vec<(f64, f64)> {
        channel.present().map(|(row, value)| (run.t_s[row], value)).collect()
    };
    let (ours, theirs) = (run.signals(), expected.signals());
    let names = |signals: &[(String, &Channel)]| signals.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&ours), names(&theirs), "{name}");
    for ((signal, ours), (_, theirs)) in ours.iter().zip(&theirs) {
        let (ours, theirs) = (samples(run, ours), samples(&expected, theirs));
        assert_eq!(ours.len(), theirs.len(), "{name}: {signal}");
        let tolerance = if signal == "vbat_V" { 1e-6 } else { 1e-12 };
        for (our, their) in ours.iter().zip(&theirs) {
            assert!((our.0 - their.0).abs() < 1e-6, "{name}: {signal} at {} and {}", our.0, their.0);
            assert!((our.1 - their.1).abs() < tolerance * 12.0, "{name}: {signal}, {} and {}", our.1, their.1);
        }
    }
}

#[test]
fn ros_2_in_mcap_of_every_compression() {
    for name in ["ros2-none.mcap", "ros2-lz4.mcap", "ros2-zstd.mcap"] {
        assert_same(&opened(name, &[TOPICS, POSE].concat()).unwrap().0, name);
    }
}

#[test]
fn ros_2_in_sqlite_with_definitions_and_without() {
    // as rosbag2 leaves it: a folder with metadata.yaml beside the database
    for name in ["ros2-sqlite", "ros2-sqlite-foxy"] {
        let (run, notices) = opened(name, &[TOPICS, POSE].concat()).unwrap();
        assert_same(&run, name);
        assert!(notices.iter().all(|notice| !notice.contains("metadata.yaml")), "{notices:?}");
    }
    assert_same(&opened("ros2-sqlite/ros2-sqlite.db3", &[TOPICS, POSE].concat()).unwrap().0, "the database alone");
}

#[test]
fn a_recording_of_ros_2_that_was_split_is_one() {
    // as a folder of a run with [[file]] tables, and with a pattern that fits each of its files
    assert_same(&opened("ros2-split", &[TOPICS, POSE].concat()).unwrap().0, "ros2-split");
    let by_pattern = [TOPICS, POSE].concat().replace("[[file]]", "[[file]]\nname = \"ros2-split*\"");
    let (run, notices) = opened("ros2-split", &by_pattern).unwrap();
    assert_same(&run, "by pattern");
    assert!(notices.iter().all(|notice| !notice.contains("left out")), "{notices:?}");
    // one part alone is what it is
    let part = opened("ros2-split/ros2-split_1.mcap", &[TOPICS, POSE].concat()).unwrap().0;
    assert!(part.rows() < expected().rows(), "{}", part.rows());
    let told = Run::open(&folder().join("ros2-split"), &robot(), None).unwrap_err().to_string();
    assert!(told.contains("several topics") && told.contains("`/voltages` (60, "), "{told}");
}

#[test]
fn a_split_recording_that_lacks_a_file_is_refused_with_its_name() {
    let to = tempfile::tempdir().unwrap();
    let spoiled = |metadata: &str| {
        std::fs::write(to.path().join("metadata.yaml"), metadata).unwrap();
        let columns = Columns::parse(&[TOPICS, POSE].concat(), Path::new("columns.toml")).unwrap();
        Run::open(to.path(), &robot(), Some(&columns)).unwrap_err().to_string()
    };
    let whole = std::fs::read_to_string(folder().join("ros2-split/metadata.yaml")).unwrap();
    assert!(spoiled(&whole).contains("lists `ros2-split_0.mcap`, which is not in the folder"));
    assert!(spoiled("a: [").contains("is no YAML"));
    assert!(spoiled("a: 1").contains("rosbag2_bagfile_information.relative_file_paths"));
}

#[test]
fn ros_1_of_every_compression() {
    for name in ["ros1-none.bag", "ros1-bz2.bag", "ros1-lz4.bag"] {
        assert_same(&opened(name, &[TOPICS, POSE].concat()).unwrap().0, name);
    }
}

#[test]
fn messages_in_json() {
    assert_same(&opened("json.mcap", &[TOPICS, POSE].concat()).unwrap().0, "json.mcap");
}

#[test]
fn a_pose_comes_from_odometry_and_from_transforms_too() {
    for recording in ["ros2-zstd.mcap", "ros2-sqlite", "ros2-sqlite-foxy", "ros1-lz4.bag", "json.mcap"] {
        assert_same(&opened(recording, &[TOPICS, ODOMETRY].concat()).unwrap().0, recording);
        assert_same(&opened(recording, &[TOPICS, TRANSFORM].concat()).unwrap().0, recording);
    }
}

#[test]
fn messages_in_protobuf_of_a_teams_own() {
    // one topic: no [[file]], and its time is the stamp inside
    let columns = r#"
        [columns]
        u0_V = { from = "voltage[0]" }
        u1_V = { from = "voltage[1]" }
        u2_V = { from = "voltage[2]" }
        w0_rad_s = { from = "wheel_speed[0]" }
        w1_rad_s = { from = "wheel_speed[1]" }
        w2_rad_s = { from = "wheel_speed[2]" }
        vbat_V = { from = "battery" }
        gyro_rad_s = { from = "gyro" }
    "#;
    let (run, notices) = opened("protobuf.mcap", columns).unwrap();
    assert!(notices.iter().any(|notice| notice.contains("its times are those of `stamp`")), "{notices:?}");
    let expected = opened("csv/drive.csv", "[groups]\nw = { quantum = 1e-9 }").unwrap().0;
    for ((name, ours), (_, theirs)) in run.signals().iter().zip(expected.signals()) {
        let apart = ours.present().zip(theirs.present()).map(|(ours, theirs)| (ours.1 - theirs.1).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-12, "{name}");
    }
}

#[test]
fn parquet_of_every_compression() {
    for name in ["none", "snappy", "gzip", "brotli", "lz4", "zstd", "us"].map(|name| format!("table-{name}.parquet")) {
        assert_same(&opened(&name, TABLE).unwrap().0, &name);
    }
}

#[test]
fn a_notice_says_whose_time_is_taken() {
    let notices = opened("ros2-zstd.mcap", &[TOPICS, POSE].concat()).unwrap().1;
    let told = |column: &str| notices.iter().any(|notice| notice.contains(column));
    assert!(told("`header.stamp`") && told("`log_time`"), "{notices:?}");
}

#[test]
fn the_time_of_recording_may_be_asked_for() {
    let topic = "[[file]]\ntopic = \"/joint_states\"\n[file.columns]\nt_s = { from = \"log_time\" }\n";
    let speeds = ["w0_rad_s = { from = \"velocity[front]\" }", "w1_rad_s = { from = \"velocity[left]\" }"].join("\n");
    let columns = format!("{topic}{speeds}\nw2_rad_s = {{ from = \"velocity[right]\" }}");
    let run = opened("ros2-zstd.mcap", &columns).unwrap().0;
    // recorded 2 ms after it was measured
    assert!((run.t_s[0] - 1.7e9 - 0.002).abs() < 1e-6, "{}", run.t_s[0] - 1.7e9);
}

/// What a user reads of a mistake.
fn refusal(name: &str, columns: &str) -> String {
    opened(name, columns).unwrap_err().to_string()
}

#[test]
fn a_topic_that_is_not_there_is_answered_with_those_that_are() {
    let told = refusal("ros2-zstd.mcap", "[[file]]\ntopic = \"/joint_state\"\n[file.columns]\nu0_V = { from = \"a\" }");
    assert!(told.contains("`/joint_states` (60, sensor_msgs/msg/JointState)"), "{told}");
}

#[test]
fn several_topics_without_a_mapping_are_listed() {
    let told = Run::open(&folder().join("ros1-lz4.bag"), &robot(), None).unwrap_err().to_string();
    assert!(told.contains("several topics") && told.contains("`/tf` (18, "), "{told}");
}

#[test]
fn a_number_that_a_message_lacks_is_named_with_those_that_it_has() {
    let told =
        refusal("ros2-zstd.mcap", "[[file]]\ntopic = \"/imu\"\n[file.columns]\ngyro_rad_s = { from = \"gyro\" }");
    assert!(told.contains("no column `gyro`") && told.contains("angular_velocity.z"), "{told}");
}

#[test]
fn text_in_a_table_is_refused_once_it_is_wanted() {
    let told = refusal(
        "table-zstd.parquet",
        "[columns]\nt_s = { from = \"time\" }\ngyro_rad_s = { from = \"note\" }\nu0_V = { from = \"volts_0\" }\nu1_V = { from = \"volts_1\" }\nu2_V = { from = \"volts_2\" }",
    );
    assert!(told.contains("note") && told.contains("text or bytes, expected numbers"), "{told}");
}

#[test]
fn a_topic_of_a_table_is_refused() {
    let told = refusal("csv/drive.csv", "topic = \"/a\"\n[columns]\nt_s = { from = \"t_s\" }");
    assert!(told.contains("it has no topics"), "{told}");
}

/// A copy of a recording that was cut off after `share` of its bytes.
fn cut_off(name: &str, share: f64) -> (tempfile::TempDir, PathBuf) {
    let bytes = std::fs::read(folder().join(name)).unwrap();
    let to = tempfile::tempdir().unwrap();
    let path = to.path().join(name);
    std::fs::write(&path, &bytes[..(bytes.len() as f64 * share) as usize]).unwrap();
    (to, path)
}

#[test]
fn what_stands_before_a_lost_end_is_read_and_told() {
    let (_kept, path) = cut_off("ros2-none.mcap", 0.5);
    let columns = Columns::parse(TOPICS, Path::new("columns.toml")).unwrap();
    let (run, notices) = Run::open(&path, &robot(), Some(&columns)).unwrap();
    assert!(run.rows() > 20 && run.rows() < 60, "{}", run.rows());
    assert!(notices.iter().any(|notice| notice.contains("ends in the middle of a record")), "{notices:?}");
}

#[test]
fn broken_files_are_refused_with_a_reason_and_never_with_a_panic() {
    let columns = [TOPICS, POSE].concat();
    let topics = Columns::parse(&columns, Path::new("columns.toml")).unwrap();
    let table = Columns::parse(TABLE, Path::new("columns.toml")).unwrap();
    for name in
        ["ros2-zstd.mcap", "ros1-lz4.bag", "ros1-none.bag", "json.mcap", "table-zstd.parquet", "table-none.parquet"]
    {
        let whole = std::fs::read(folder().join(name)).unwrap();
        let to = tempfile::tempdir().unwrap();
        let path = to.path().join(name);
        let columns = if name.ends_with("parquet") { &table } else { &topics };
        let mut refused = 0;
        for place in (0..whole.len()).step_by(1 + whole.len() / 300) {
            let mut spoiled = whole.clone();
            spoiled[place] ^= 0xff;
            std::fs::write(&path, &spoiled).unwrap();
            refused += usize::from(Run::open(&path, &robot(), Some(columns)).is_err());
            std::fs::write(&path, &whole[..place]).unwrap();
            refused += usize::from(Run::open(&path, &robot(), Some(columns)).is_err());
        }
        assert!(refused > 100, "{name}: {refused}");
    }
}

#[test]
fn broken_game_logs_are_read_or_refused_and_never_end_in_a_panic() {
    let columns = "[columns]\nx_m = { from = \"x\" }\ny_m = { from = \"y\" }\ntheta_rad = { from = \"orientation\" }";
    let columns = Columns::parse(&format!("topic = \"yellow/3\"\n{columns}"), Path::new("columns.toml")).unwrap();
    for name in ["game.log", "game.log.gz"] {
        let whole = std::fs::read(folder().join("vision").join(name)).unwrap();
        let to = tempfile::tempdir().unwrap();
        let path = to.path().join(name);
        let mut refused = 0;
        for place in (0..whole.len()).step_by(1 + whole.len() / 400) {
            let mut spoiled = whole.clone();
            spoiled[place] ^= 0xff;
            for bytes in [&spoiled, &whole[..place]] {
                std::fs::write(&path, bytes).unwrap();
                refused += usize::from(Run::open(&path, &robot(), Some(&columns)).is_err());
            }
        }
        assert!(refused > 10, "{name}: {refused}");
    }
}
