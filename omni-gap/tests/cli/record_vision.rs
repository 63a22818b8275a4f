//! A robot that is recorded beside the cameras that see it: `record --vision`, with a robot and a SSL-Vision of this test.

use std::f64::consts::TAU;
use std::io::Write;
use std::net::{TcpListener, UdpSocket};
use std::time::{Duration, Instant};

use crate::bench::{Bench, ROBOT, refused, table};
use crate::frames::frames;
use model_core::link::record::TelemetryRecord;

/// How long it turns [s]
const LENGTH_S: f64 = 5.0;

/// What the cameras' clock shows when the robot's shows 0 [s]
const CAMERAS_START_S: f64 = 1000.0;

/// Frames of a camera in a second [1/s]
const FRAME_RATE_HZ: f64 = 60.0;

/// Looks at the halls in a second [1/s], and looks from one record to the next
const LOOKS_HZ: f64 = 20_000.0;
const LOOKS_A_RECORD: u32 = 20;

/// Hall edges in a turn of the wheel: six for each of 8 pole pairs, behind a gear of 5
const EDGES: f64 = 240.0;

/// How far all wheels have turned [rad]
fn wheel_rad(t_s: f64) -> f64 {
    10.0 / 3.0 * (1.0 - (3.0 * t_s).cos()) + 6.0 / 7.3 * (1.0 - (7.3 * t_s).cos())
}

/// How far the robot has turned on the spot [rad]: all wheels run 32.5 mm from their axles, 89 mm from the centre
fn heading_rad(t_s: f64) -> f64 {
    0.0325 / 0.089 * wheel_rad(t_s)
}

/// What the robot sends.
fn sent() -> Vec<u8> {
    let mut records = Vec::new();
    let (mut edge, mut since, mut interval) = (0, 0u16, 0u16);
    for look in 0..(LENGTH_S * LOOKS_HZ) as u32 {
        let now = (wheel_rad(f64::from(look) / LOOKS_HZ) * EDGES / TAU).floor() as i16;
        since = since.saturating_add(1);
        if now != edge {
            (edge, interval, since) = (now, since, 0);
        }
        if look % LOOKS_A_RECORD == 0 {
            records.push(TelemetryRecord {
                sequence: look / LOOKS_A_RECORD,
                time: look,
                edges: [edge; 4],
                since_edge: [since; 4],
                interval: [interval; 4],
                ..TelemetryRecord::default()
            });
        }
    }
    frames(records)
}

/// A packet of SSL-Vision with one yellow robot, by hand: tags, and what they hold.
fn packet(robot: u8, t_s: f64) -> Vec<u8> {
    let float = |tag: u8, value: f64| [&[tag][..], &(value as f32).to_le_bytes()].concat();
    let double = |tag: u8, value: f64| [&[tag][..], &value.to_le_bytes()].concat();
    let inside = |tag: u8, bytes: Vec<u8>| [vec![tag, u8::try_from(bytes.len()).unwrap()], bytes].concat();
    let (sin, cos) = heading_rad(t_s).sin_cos();
    let seen = [
        float(0x0d, 0.9),
        vec![0x10, robot],
        float(0x1d, 500.0),
        float(0x25, -250.0),
        float(0x2d, sin.atan2(cos)),
        float(0x35, 1.0),
        float(0x3d, 2.0),
    ];
    let t_capture_s = CAMERAS_START_S + t_s;
    let frame = [
        vec![0x08, 7],
        double(0x11, t_capture_s),
        double(0x19, t_capture_s + 0.005),
        vec![0x20, 1],
        inside(0x32, seen.concat()),
    ];
    inside(0x0a, frame.concat())
}

/// An address of this computer that nobody listens at.
fn free_address() -> String {
    UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string()
}

/// The robot waits in the cameras' sight until it is listened to, then turns, and its frames come when it is done.
fn play(robot: &TcpListener, vision: &str) {
    let cameras = UdpSocket::bind("127.0.0.1:0").unwrap();
    let send = |t_s| cameras.send_to(&packet(3, t_s), vision).map(drop);
    robot.set_nonblocking(true).unwrap();
    let began = Instant::now();
    let mut stream = loop {
        if let Ok((stream, _)) = robot.accept() {
            break stream;
        }
        assert!(began.elapsed() < Duration::from_secs(20), "nobody listens to the robot");
        // before anybody listens there is nobody to send to
        let _ = send(0.0);
        std::thread::sleep(Duration::from_millis(5));
    };
    for k in 0..(LENGTH_S * FRAME_RATE_HZ) as u32 {
        send(f64::from(k) / FRAME_RATE_HZ).unwrap();
        cameras.send_to(&packet(4, 0.0), vision).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
    std::thread::sleep(Duration::from_millis(200));
    stream.set_nonblocking(false).unwrap();
    stream.write_all(&sent()).unwrap();
}

#[test]
fn a_robot_and_what_the_cameras_see_of_it_become_one_run_on_one_clock() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    let robot = TcpListener::bind("127.0.0.1:0").unwrap();
    let (from, vision) = (format!("tcp:{}", robot.local_addr().unwrap()), free_address());
    let record = ["record", "--from", &from, "--robot", "robot.toml", "--out", "s", "--name", "turn"];
    let cameras = ["--vision", &vision, "--vision-robot", "yellow/3"];
    let said = std::thread::scope(|scope| {
        scope.spawn(|| play(&robot, &vision));
        bench.done(&[&record[..], &cameras].concat())
    });
    assert!(said.out.contains("packets of SSL-Vision show robot yellow/3"), "{}", said.out);
    for file in ["s/robot.toml", "s/columns.toml", "s/runs/turn/robot.rec", "s/runs/turn/vision.log.gz"] {
        assert!(bench.at(file).is_file(), "{file} is not there: {:?}", bench.all());
    }
    assert!(bench.read("s/columns.toml").contains("offset_s = \"estimate\""));

    let said = bench.run(&["check", "s"]);
    assert!(said.out.contains("1 run(s) checked"), "{}{}", said.out, said.err);
    let told = said.out.replace("\n  ", " ");
    let offset_s = told.split("clock offset ").nth(1).and_then(|rest| rest.split(' ').next()).expect("an offset");
    let offset_s: f64 = offset_s.replace('−', "-").parse().unwrap();
    assert!((offset_s + CAMERAS_START_S).abs() < 0.01, "{offset_s}: {told}");

    bench.done(&["convert", "robot.toml", "s/runs/turn", "--columns", "s/columns.toml", "--out", "turn.csv"]);
    let text = bench.read("turn.csv");
    let (names, rows) = table(&text);
    let place = |name: &str| names.iter().position(|other| *other == name).unwrap();
    let (x, y) = (place("x_m"), place("y_m"));
    let poses: Vec<_> = rows.iter().filter(|row| !row[x].is_empty()).map(|row| (row[x], row[y])).collect();
    assert!(poses.len() > 280 && poses.iter().all(|pose| *pose == ("0.5", "-0.25")), "{} {:?}", poses.len(), poses[0]);

    refused(&bench, &[&record[..], &cameras].concat(), &["a run of this name is there"]);
    refused(&bench, &record, &["a run of this name is there"]);
    let other = ["--vision", &vision, "--vision-robot", "blue/1"];
    let second = ["record", "--from", &from, "--robot", "robot.toml", "--out", "s", "--name", "second"];
    refused(&bench, &[&second[..], &other].concat(), &["s/columns.toml: ", "the session holds another file"]);
}

#[test]
fn cameras_that_do_not_see_the_robot_are_told_before_anything_is_recorded() {
    let bench = Bench::empty();
    bench.write("robot.toml", ROBOT);
    bench.write("frames.bin", "");
    let vision = free_address();
    let record = |from, robot| {
        let args = ["record", "--robot", "robot.toml", "--out", "s", "--from", from, "--vision", &vision];
        [&args[..], &["--vision-robot", robot]].concat()
    };
    let place = format!("udp:{vision}: ");
    refused(&bench, &record("tcp:127.0.0.1:1", "yellow/3"), &[&place, "no packet came within 3 s", "Start SSL-Vision"]);
    refused(&bench, &record("frames.bin", "yellow/3"), &["frames.bin: these frames were recorded before"]);

    let cameras = UdpSocket::bind("127.0.0.1:0").unwrap();
    let is_done = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !is_done.load(std::sync::atomic::Ordering::Relaxed) {
                let _ = cameras.send_to(&packet(4, 0.0), &vision);
                std::thread::sleep(Duration::from_millis(10));
            }
        });
        let said = bench.run(&record("tcp:127.0.0.1:1", "yellow/3"));
        is_done.store(true, std::sync::atomic::Ordering::Relaxed);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{}", said.err);
        assert!(said.err.contains("robot `yellow/3` was not seen within 3 s; seen were `yellow/4`"), "{}", said.err);
    });
    assert!(!bench.at("s").exists());

    for (args, says) in [
        (["--vision", "vision:10006", "--vision-robot", "yellow/3"].as_slice(), "expected GROUP:PORT"),
        (&["--vision", "--vision-robot", "green/3"], "such as yellow/3 or blue/0"),
        (&["--vision"], "--vision-robot"),
        (&["--vision-robot", "yellow/3"], "--vision"),
    ] {
        let robot = ["record", "--robot", "robot.toml", "--out", "s", "--from", "frames.bin"];
        let said = bench.run(&[&robot[..], args].concat());
        assert!(said.code == 2 && said.err.contains(says), "{args:?}: {}", said.err);
    }
}
