//! Closes the loop on the gap, effect by effect.
use host_tests::in_loop::Software;
use host_tests::in_loop::gap::{Hidden, close, robot_file};
use model_core::paper::four_wheels;

fn main() {
    let text = include_str!("../../../examples/feup-4w/robot.toml");
    let h = |id, wheel, params, by_voltage| Hidden { id, wheel, params, by_voltage };
    let all = [
        h("coriolis", None, &[1.0][..], false),
        h("stribeck", None, &[0.8, 0.08, 1.0][..], false),
        h("gear_efficiency", None, &[0.8][..], false),
        h("rotor_inertia", None, &[1.5e-4][..], false),
        h("motor_mismatch", Some(2), &[0.8, 1.0][..], false),
        h("floor_tilt", None, &[0.03, 0.6][..], false),
        h("dead_time", None, &[0.5, 0.05][..], true),
        h("creep", None, &[0.03][..], false),
        h("coriolis", None, &[1.0][..], true),
    ];
    for hidden in all {
        let dir = tempfile::tempdir().unwrap();
        let nominal = robot_file(text, hidden.by_voltage);
        let t = std::time::Instant::now();
        let c = close::<_, 4>(four_wheels(), &nominal, hidden, dir.path(), || Ok(Software::default())).unwrap();
        println!("{:16} {:?} {:?} {:?} {:.4} -> {:.4} ({:.2})  w {:.4} -> {:.4} ({:.2})  {:.1?}", hidden.id, c.verdict, c.causes, c.undone, c.error[0], c.error[1], c.error[1]/c.error[0], c.turning[0], c.turning[1], c.turning[1]/c.turning[0], t.elapsed());
    }
}
