//! Explanations.

use std::path::Path;

use model_core::effects::EffectKind;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;

use crate::bench::{Bench, ROBOT};

#[test]
fn every_effect_is_listed_and_explained_and_its_table_can_be_pasted() {
    let bench = Bench::empty();
    let list = bench.done(&["explain"]).out;
    for effect in &EffectKind::ALL {
        let card = effect.card();
        assert!(list.contains(&format!("  {} ", card.id)) && list.contains(card.title), "{}", card.id);
        let page = bench.done(&["explain", card.id]).out;
        for part in [card.title, card.equation, card.stage().name()] {
            assert!(page.contains(part), "{}: {part}", card.id);
        }
        assert!(card.params.iter().all(|p| page.contains(p.key)), "{page}");
        assert!(card.look_alikes.iter().all(|l| page.contains(l.with)), "{page}");
        let toml = page.split("To have it in a robot file").nth(1).expect("a table");
        let lines = toml.lines().skip(1).map(str::trim).filter(|line| !line.starts_with('('));
        let text = lines.fold(ROBOT.to_owned(), |text, line| text + "\n" + line);
        let robot = RobotFile::parse(&text, Path::new("robot.toml"), &known_effects());
        assert_eq!(robot.unwrap_or_else(|why| panic!("{}: {why}", card.id)).effects[0].id, card.id);
    }
}

#[test]
fn parameters_are_explained_too() {
    let bench = Bench::empty();
    let page = bench.done(&["explain", "torque_constant"]).out;
    for part in ["[motor] torque_constant_Nm_per_A", "emf_constant_V_s", "How to measure it"] {
        assert!(page.contains(part), "{page}");
    }
}

#[test]
fn forms_of_files_are_explained_too() {
    let bench = Bench::empty();
    let list = bench.done(&["explain"]).out;
    for (name, part) in [("robot", "drive_angle_deg"), ("runs", "wset0_rad_s"), ("columns", "pose.orientation.yaw")] {
        assert!(list.contains(&format!("  {name} ")), "{list}");
        let page = bench.done(&["explain", name]).out;
        assert!(page.starts_with("# ") && page.contains(part), "{page}");
    }
}

#[test]
fn the_robot_of_the_page_can_be_read_and_has_every_key() {
    let page = Bench::empty().done(&["explain", "robot"]).out;
    let toml = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a robot");
    let robot = RobotFile::parse(toml, Path::new("robot.toml"), &known_effects()).unwrap();
    assert_eq!((robot.wheel.len(), robot.effects.len(), robot.commissioned.len()), (3, 2, 1));
    let (sensors, limits) = (robot.sensors, robot.limits.expect("limits"));
    let optional =
        [sensors.gyro_noise_rad_s, sensors.battery_noise_v, limits.current_a, limits.speed_m_s, limits.field_m];
    assert!(optional.iter().all(Option::is_some), "{optional:?}");
    assert!(robot.supply.is_some() && robot.identified.is_some_and(|from| from.rate_hz.is_some()));
}

#[test]
fn an_unknown_name_gets_the_nearest_one() {
    let bench = Bench::empty();
    for (name, near) in [
        ("weel_slip", "`wheel_slip`"),
        ("masse", "`mass`"),
        ("colums", "`columns`"),
        ("xyzzyxyzzyxyzzy", "omni-gap explain"),
    ] {
        let said = bench.run(&["explain", name]);
        assert_eq!((said.code, said.out.as_str()), (2, ""));
        assert!(said.err.contains(name) && said.err.contains(near), "{}", said.err);
    }
}

#[test]
fn an_effect_is_drawn_of_the_papers_robot_and_of_ones_own() {
    let bench = Bench::empty();
    let said = bench.done(&["explain", "coriolis", "--out", "coriolis.svg"]).out;
    assert!(said.contains("written to coriolis.svg"), "{said}");
    let four = bench.read("coriolis.svg");
    assert!(four.starts_with("<svg xmlns=") && four.contains("at its typical size, on feup-4w"), "{four}");
    bench.write(
        "mine.toml",
        &ROBOT.replace("name = \"feup-4w\"", "name = \"mine\"").replace("mass_kg = 2.34", "mass_kg = 4.5"),
    );
    bench.done(&["explain", "coriolis", "--out", "mine.svg", "--robot", "mine.toml"]);
    let mine = bench.read("mine.svg");
    let lines = |svg: &str| svg.lines().flat_map(|l| l.split("<path")).filter(|p| p.contains("class=\"line")).count();
    assert!(mine.contains("at its typical size, on mine") && lines(&mine) == lines(&four), "{mine}");
    assert_ne!(mine, four.replace("feup-4w", "mine"));
}

#[test]
fn what_cannot_be_drawn_is_told_and_nothing_is_written() {
    let bench = Bench::empty();
    bench.write("mine.toml", ROBOT);
    for (args, told) in [
        (&["explain", "mass", "--out", "mass.svg"][..], "name an effect"),
        (&["explain", "--out", "all.svg"], "<NAME>"),
        (&["explain", "creep", "--robot", "mine.toml"], "--out"),
        (&["explain", "creep", "--robot", "mine.toml", "--out", "mine.toml"], "it is an input"),
        (&["explain", "creep", "--out", "nowhere/creep.svg"], "there is no folder"),
        (&["explain", "creep", "--out", "creep.svg", "--robot", "none.toml"], "none.toml"),
    ] {
        let said = bench.run(args);
        assert_eq!((said.code, said.out.as_str()), (2, ""), "{args:?}");
        assert!(said.err.contains(told), "{args:?}: {}", said.err);
    }
    assert_eq!(bench.all().len(), 1);
    assert_eq!(bench.read("mine.toml"), ROBOT);
}
