use omni_gap::{simulate::*, stage::*, known_effects, rank::*, identify::*};
fn main() {
  let id = std::env::args().nth(1).unwrap();
  let e = model_core::effects::find::<f64>(&id).unwrap();
  let t4 = include_str!("../../examples/feup-4w/robot.toml");
  let session = stage(t4, &Stage { hidden: vec![Carried::typical(e.card(), None)], seed: 3, ..Stage::default() }, &known_effects()).unwrap();
  let rec: Vec<Recorded<4>> = session.runs.iter().map(|r| Recorded::new(r, &session.robot).unwrap()).collect();
  let f: Vec<&Recorded<4>> = rec.iter().enumerate().filter(|(k,_)| k%3!=2).map(|x| x.1).collect();
  let h: Vec<&Recorded<4>> = rec.iter().enumerate().filter(|(k,_)| k%3==2).map(|x| x.1).collect();
  let data = Data { fit_windows: f.iter().map(|r| Windows::new(r, 0.5)).collect(), held_windows: h.iter().map(|r| Windows::new(r, 0.5)).collect(), fit: f, held: h, prior: Prior::stated(&session.robot) };
  let t = std::time::Instant::now();
  let base = data.judge(Model::nominal(&session.robot, 8.0), None, &data.prior, 0);
  println!("base held/n {:.2} fit/n {:.2} stated {:.1} temper {:.1} {:?} {:.1}s", base.held()/base.freedom, base.fit.cost/base.fit.samples as f64, base.stated, base.fit.temper, base.fit.model.factor.map(|x| (x*100.).round()/100.), t.elapsed().as_secs_f64());
  // oracle
  let mut m = Model::nominal(&session.robot, 8.0); m.carry(Carried::typical(e.card(), None));
  let o = data.judge(m, None, &data.prior, 0);
  println!("oracle held/n {:.3} fit/n {:.3} stated {:.1} temper {:.1} {:?} {:?}", o.held()/o.freedom, o.fit.cost/o.fit.samples as f64, o.stated, o.fit.temper, o.fit.model.effects, o.fit.model.factor.map(|x| (x*100.).round()/100.));
  let r = explain(&data, base, &data.prior);
  for s in r.screened.iter().take(12) { println!("screen {} {:?} {:.0} vis {:.0} {:?}", s.candidate.card.id, s.candidate.wheel, s.gain, s.visible, s.from.params); }
  for x in &r.ranked { println!("{} {:?} held/n {:.3} stated {:.1} {:?}", x.cause.id(), x.cause.wheel(), x.scored.held()/x.scored.freedom, x.scored.stated, x.scored.fit.model.effects); }
  println!("{:.1}s", t.elapsed().as_secs_f64());
}
