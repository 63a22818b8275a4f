use model_core::{plant::*, frames::*, scalar::Real};
use omni_gap::{simulate::*, log::*, known_effects};
fn main() {
  let f = RobotFile::parse(include_str!("../../examples/feup-4w/robot.toml"), std::path::Path::new("x"), &known_effects()).unwrap();
  let ids: Vec<String> = std::env::args().skip(1).collect();
  let mut m = Model::<4>::nominal(&f, 8.0);
  for id in ids { let e = model_core::effects::find::<f64>(&id).unwrap(); let w = (e.card().place==model_core::card::Place::OneWheel).then_some(2); m.carry(Carried::typical(e.card(), w)); }
  let p = m.plant();
  let mut mem = vec![0.0; p.memory_len()];
  let mut s = p.start(0.0, Pose::default(), BodyTwist::default());
  let script = excite(&m.robot().wheels, &Excitation{duration: 100.0, rate: 500.0, voltage: 8.0}, 3);
  let t = std::time::Instant::now();
  let mut n = 0; let mut sum = 0.0;
  for _ in 0..std::env::var("LOOPS").map_or(10, |x| x.parse::<usize>().unwrap()) { for u in &script { sum += p.step(&mut s, &mut mem, &Input::Voltage(*u), 1e-3).current[0]; n += 1; } }
  println!("{:.2} M/s {}", n as f64 / t.elapsed().as_secs_f64()/1e6, sum.is_finite());
  let _ = f64::zero();
}
