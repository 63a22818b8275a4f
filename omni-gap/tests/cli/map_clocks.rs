//! Foreign logs whose clocks are dates, or are two.

use crate::bench::{Bench, table};
use crate::foreign::{Foreign, foreign, same};

/// A time of the run as a date, UTC.
fn date(t_s: f64) -> String {
    format!("2026-03-01T12:00:{t_s:09.6}Z")
}

#[test]
fn a_log_whose_clock_is_dates_is_mapped_and_read() {
    let bench = Bench::with_session();
    let columns: [Foreign<'_>; 8] = [
        ("t_s", "Timestamp", date),
        ("w0_rad_s", "Wheel 1", same),
        ("w1_rad_s", "Wheel 2", same),
        ("w2_rad_s", "Wheel 3", same),
        ("w3_rad_s", "Wheel 4", same),
        ("x_m", "X [mm]", |x| (1000.0 * x).to_string()),
        ("y_m", "Y [mm]", |y| (1000.0 * y).to_string()),
        ("theta_rad", "Heading [deg]", |theta| theta.to_degrees().to_string()),
    ];
    bench.write("fahrt.txt", &foreign(&bench, &columns, "\t"));
    let said = bench.done(&["map", "fahrt.txt", "--robot", "session/robot.toml", "--out", "columns.toml"]).out;
    assert!(said.lines().any(|line| line.starts_with("sure") && line.contains("Timestamp")), "{said}");
    bench.done(&["convert", "session/robot.toml", "fahrt.txt", "--columns", "columns.toml", "--out", "back.csv"]);
    let (own, back) = (bench.read("session/runs/run01.csv"), bench.read("back.csv"));
    let ((names, own), (back_names, back)) = (table(&own), table(&back));
    for column in ["w0_rad_s", "w3_rad_s", "x_m", "y_m"] {
        let of = |names: &[&str], rows: &[Vec<&str>]| -> Vec<Option<f64>> {
            let place = names.iter().position(|name| *name == column).unwrap_or_else(|| panic!("{column}: {said}"));
            rows.iter().map(|row| row[place].parse().ok()).collect()
        };
        for (own, back) in of(&names, &own).into_iter().zip(of(&back_names, &back)) {
            assert!(
                own.zip(back).is_some_and(|(a, b)| (a - b).abs() < 1e-9) || own == back,
                "{column} {own:?} {back:?}"
            );
        }
    }
    let step = |rows: &[Vec<&str>]| rows[1][0].parse::<f64>().unwrap() - rows[0][0].parse::<f64>().unwrap();
    assert!((step(&own) - step(&back)).abs() < 1e-5, "{} {}", step(&own), step(&back));
}

#[test]
fn a_camera_with_a_clock_and_a_file_of_its_own_is_mapped() {
    let bench = Bench::with_session();
    let motors: [Foreign<'_>; 5] = [
        ("t_s", "time_s", same),
        ("w0_rad_s", "speed_0", same),
        ("w1_rad_s", "speed_1", same),
        ("w2_rad_s", "speed_2", same),
        ("w3_rad_s", "speed_3", same),
    ];
    // the camera's computer counts milliseconds since 1970
    let camera: [Foreign<'_>; 4] = [
        ("t_s", "stamp_ms", |t| (1.7723664e12 + 1000.0 * t).to_string()),
        ("x_m", "x", same),
        ("y_m", "y", same),
        ("theta_rad", "theta", same),
    ];
    let seen: String = foreign(&bench, &camera, ";")
        .lines()
        .filter(|line| !line.ends_with(';'))
        .map(|line| format!("{line}\n"))
        .collect();
    bench.write("logs/drive/motors.csv", &foreign(&bench, &motors, ","));
    bench.write("logs/drive/camera.csv", &seen);
    let said = bench.done(&["map", "logs/drive", "--robot", "session/robot.toml", "--out", "columns.toml"]).out;
    let mapping = bench.read("columns.toml");
    for part in ["motors.csv", "camera.csv", "unit = \"ms\"", "offset_s"] {
        assert!(mapping.contains(part), "{part}: {mapping}");
    }
    for column in ["w0_rad_s", "w1_rad_s", "w2_rad_s", "w3_rad_s"] {
        let place = column.trim_end_matches("_rad_s").trim_start_matches('w');
        let told = said.lines().find(|line| line.contains(column)).unwrap_or_else(|| panic!("{column}: {said}"));
        assert!(told.contains(&format!("speed_{place}")) && !told.starts_with("guess"), "{told}");
    }
    bench.done(&["convert", "session/robot.toml", "logs/drive", "--columns", "columns.toml", "--out", "back.csv"]);
    let back = bench.read("back.csv");
    assert!(table(&back).0.contains(&"theta_rad"), "{back}");
}
