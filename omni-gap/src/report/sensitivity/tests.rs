use super::*;
use crate::report::html::page::is_sound;
use crate::simulate::{CurvePoint, Terms};

/// Two axes that move and one that does not.
fn sample() -> Sensitivity {
    let influence =
        |key, speed: f64, final_speed| Influence { key, value: 1.5, speed, distance: 0.5 * speed, final_speed };
    let moving = |axis, end: Option<f64>| AxisSensitivity {
        axis,
        motors: vec![-6.0, 1e-16, 6.0],
        terms: Terms { back_emf_per_s: 2.0, viscous_per_s: 0.25, drive: 5.0, coulomb: 1.0 },
        speed: 1.25,
        distance: 0.75,
        final_speed: end,
        influences: vec![
            influence("radius_m", 0.7, end.map(|_| 0.9)),
            influence("mass_kg", -0.3, end.map(|_| 0.0)),
            influence("inertia_kg_m2", 0.0, end.map(|_| 0.0)),
        ],
        curve: (1..=10).map(|k| CurvePoint { time: 0.1 * f64::from(k), speed: 1.0, slopes: [0.1; 13] }).collect(),
    };
    let still = AxisSensitivity {
        axis: "w",
        speed: 0.0,
        distance: 0.0,
        final_speed: None,
        influences: vec![],
        curve: vec![],
        ..moving("w", None)
    };
    let effects = vec!["dead_time"];
    let axes = vec![moving("v", Some(1.5)), moving("vn", None), still];
    Sensitivity { robot: "<b>\"x\"</b>".into(), voltage: 6.0, time_s: 1.0, effects, axes }
}

#[test]
fn the_page_needs_no_network_escapes_its_text_and_closes_its_tags() {
    let page = sensitivity_html(&sample());
    is_sound("sensitivity", &page);
    assert!(!page.contains("<b>"));
    assert_eq!(page.matches("<svg").count(), 4, "two pictures for each axis that moves");
    // two bars on each of the two axes, and a dot for each final speed that there is
    assert_eq!((page.matches("<rect").count(), page.matches("<circle").count()), (4, 2));
}

#[test]
fn the_terminal_says_every_number_and_what_does_not_matter_or_move() {
    let text = sensitivity_terminal(&sample());
    for part in [
        "6 V on the motor that gets most; with dead_time",
        "v axis (ahead), motors at −6, 0, 6 V",
        "dv/dt = 5.00 − 2.00·v − 0.250·v − 1.00 m/s²",
        "1.25 m/s and 0.750 m after 1 s; 1.50 m/s in the end",
        "1.25 m/s and 0.750 m after 1 s; the speed does not settle",
        "it does not move: the drive gives 5.00 rad/s², friction holds 1.00 rad/s²",
        "no influence: inertia_kg_m2",
        "Coulomb; without the effects)",
        "+0.70",
        "−0.30",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn the_files_are_a_page_and_its_numbers() {
    let root = tempfile::tempdir().unwrap();
    let [json, html] = write_sensitivity(&root.path().join("deep/out"), &sample()).unwrap();
    let read: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    assert_eq!(read["axes"][0]["terms"]["back_emf_per_s"], 2.0);
    assert_eq!(read["axes"][1]["final_speed"], serde_json::Value::Null);
    assert_eq!(read["axes"][0]["influences"][0]["key"], "radius_m");
    assert!(std::fs::read_to_string(html).unwrap().ends_with("</html>\n"));
}
