//! Each wheel's own motor: volts against speed and current, u = a·w + b·i with a ≈ Kv·l and b ≈ R, both above zero.
//!
//! a and b are fitted, so wrong parameters, a weak motor or a dead zone do not matter; what cannot be is a negative one, a
//! fit that only another wheel's channel makes, or a factor of 1000. Set speeds stand for volts where the drive controls
//! speed (a ≈ 1).

use super::Fault;
use super::body::row_of;
use super::order::{self, Order};
use super::units::{self, WrongUnit};
use crate::log::{Group, RobotFile, Run, Sampled};

/// Sums of products over the rows in which every group is there.
struct Moments {
    rows: usize,
    uu: Vec<f64>,
    uw: Vec<Vec<f64>>,
    ww: Vec<f64>,
    ui: Vec<Vec<f64>>,
    wi: Vec<Vec<f64>>,
    ii: Vec<f64>,
}

/// u ≈ a·w + b·i, neither negative, and the squares that remain.
#[derive(Clone, Copy)]
struct Fit {
    a: f64,
    b: f64,
    rest: f64,
}

impl Moments {
    fn new(run: &Run, drive: &Group, speed: &Group, current: Option<&Group>) -> Moments {
        let n = drive.channels.len();
        let square = || vec![vec![0.0; n]; n];
        let line = || vec![0.0; n];
        let mut m = Moments { rows: 0, uu: line(), uw: square(), ww: line(), ui: square(), wi: square(), ii: line() };
        let lag = usize::from(current.is_some() && run.currents_sampled == Sampled::Before);
        for row in lag..run.rows() {
            let (Some(u), Some(w)) = (row_of(drive, row - lag), row_of(speed, row)) else {
                continue;
            };
            let i = match current {
                None => vec![0.0; n],
                Some(group) => match row_of(group, row) {
                    Some(i) => i,
                    None => continue,
                },
            };
            m.rows += 1;
            for j in 0..n {
                m.uu[j] += u[j] * u[j];
                m.ww[j] += w[j] * w[j];
                m.ii[j] += i[j] * i[j];
                for k in 0..n {
                    m.uw[j][k] += u[j] * w[k];
                    m.ui[j][k] += u[j] * i[k];
                    m.wi[j][k] += w[j] * i[k];
                }
            }
        }
        m
    }

    /// The fit of u[j] on s·w[k] and z·i[l].
    fn fit(&self, j: usize, (k, s): (usize, f64), (l, z): (usize, f64)) -> Fit {
        let (uu, ww, ii) = (self.uu[j], self.ww[k], self.ii[l]);
        let (uw, ui, wi) = (s * self.uw[j][k], z * self.ui[j][l], s * z * self.wi[k][l]);
        let rest =
            |a: f64, b: f64| (uu - 2.0 * (a * uw + b * ui) + a * a * ww + 2.0 * a * b * wi + b * b * ii).max(0.0);
        let made = |a: f64, b: f64| Fit { a, b, rest: rest(a, b) };
        let determinant = ww * ii - wi * wi;
        if determinant > 1e-9 * ww * ii {
            let (a, b) = ((uw * ii - ui * wi) / determinant, (ui * ww - uw * wi) / determinant);
            if a >= 0.0 && b >= 0.0 {
                return made(a, b);
            }
        }
        let alone = |product: f64, square: f64| if square > 0.0 { (product / square).max(0.0) } else { 0.0 };
        let (by_speed, by_current) = (made(alone(uw, ww), 0.0), made(0.0, alone(ui, ii)));
        if by_speed.rest <= by_current.rest { by_speed } else { by_current }
    }
}

/// Which group a guess blames.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Blame {
    Speed,
    Current,
    Drive,
}

impl Moments {
    fn wheel_fit(&self, blame: Blame, order: &Order, j: usize) -> Fit {
        let (there, sign) = (order.place[j], order.sign[j]);
        match blame {
            Blame::Speed => self.fit(j, (there, sign), (j, 1.0)),
            Blame::Current => self.fit(j, (j, 1.0), (there, sign)),
            Blame::Drive => self.fit(there, (j, sign), (j, sign)),
        }
    }

    fn rest(&self, blame: Blame, order: &Order) -> f64 {
        (0..order.place.len()).map(|j| self.wheel_fit(blame, order, j).rest).sum()
    }
}

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let Some(speed) = run.w.as_ref().filter(|group| !group.unsigned) else {
        return stall(run, robot);
    };
    let (name, drive, per_speed) = match (&run.u, &run.wset) {
        (Some(u), _) if !u.unsigned => ("u", u, robot.volts_per_wheel_speed()),
        (None, Some(set)) if !set.unsigned => ("wset", set, 1.0),
        _ => return stall(run, robot),
    };
    let current = run.i.as_ref().filter(|group| !group.unsigned && name == "u");
    let moments = Moments::new(run, drive, speed, current);
    let driven: f64 = moments.uu.iter().sum();
    if moments.rows < 20 || driven <= 0.0 || moments.ww.iter().all(|ww| *ww <= 0.0) {
        return Vec::new();
    }
    let mut faults: Vec<Fault> = wrong_order(run, &moments, name, current.is_some()).into_iter().collect();
    if faults.is_empty() {
        faults.extend(wrong_unit(run, robot, &moments, (name, per_speed), current.is_some()));
    }
    if current.is_none() {
        faults.extend(stall(run, robot));
    }
    faults
}

/// Channels that fit their wheels only in another order or with another sign.
fn wrong_order(run: &Run, moments: &Moments, drive: &str, currents: bool) -> Option<Fault> {
    let orders = order::all(moments.uu.len());
    let given = orders[0].clone();
    let blames: &[Blame] = if currents { &[Blame::Speed, Blame::Current, Blame::Drive] } else { &[Blame::Speed] };
    let guess = |blame: Blame, order: &Order| {
        ((blame, order.clone()), order.changes(), order.moved(), moments.rest(blame, order))
    };
    let guesses: Vec<_> =
        blames.iter().flat_map(|&blame| orders.iter().map(move |order| guess(blame, order))).collect();
    let driven: f64 = moments.uu.iter().sum();
    let ((blame, order), _) = order::best(&guesses, 0.005 * driven)?;
    if order.is_as_given() {
        return None;
    }
    // only the wheels that the guess changes are compared
    let changed: Vec<usize> = (0..order.place.len()).filter(|&j| order.changed(j)).collect();
    let over = |order: &Order| changed.iter().map(|&j| moments.wheel_fit(blame, order, j).rest).sum::<f64>();
    let (as_given, otherwise) = (over(&given), over(&order));
    let moved: f64 = changed.iter().map(|&j| moments.uu[j]).sum();
    let (times, share) = if currents { (4.0, 0.15) } else { (2.5, 0.4) };
    if as_given < times * otherwise || otherwise > share * moved || as_given < 0.02 * moved {
        return None;
    }
    let (stem, with) = match blame {
        Blame::Speed if currents => ("w", "voltages and currents".to_string()),
        Blame::Speed => ("w", if drive == "u" { "voltages".into() } else { "set speeds".to_string() }),
        Blame::Current => ("i", "voltages and wheel speeds".to_string()),
        Blame::Drive => ("u", "wheel speeds and currents".to_string()),
    };
    let better = (as_given / otherwise.max(1e-6 * moved)).sqrt();
    let code = if order.moved() { "swapped_wheels" } else { "wrong_sign" };
    let fault = Fault::of(run, code, stem, true);
    let told = format!("{}: the `{stem}` columns fit the {with} {better:.0} times better so.", order.words(stem));
    let mend = if order.moved() {
        "Put the columns into wheel order, or change `from` in columns.toml."
    } else {
        "Turn the sign, or set sign = -1 in columns.toml."
    };
    Some(fault.says(told, mend))
}

/// A factor between groups that only a wrong unit makes.
fn wrong_unit(run: &Run, robot: &RobotFile, moments: &Moments, drive: (&str, f64), currents: bool) -> Option<Fault> {
    let (name, per_speed) = drive;
    let largest = moments.uu.iter().copied().fold(0.0, f64::max);
    let as_given = &order::all(moments.uu.len())[0];
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for j in (0..moments.uu.len()).filter(|&j| moments.uu[j] > 0.05 * largest) {
        let fit = moments.wheel_fit(Blame::Speed, as_given, j);
        if fit.rest > 0.4 * moments.uu[j] {
            continue;
        }
        // a part counts where leaving it out would show
        let without = |a: f64, b: f64| a * a * moments.ww[j] + b * b * moments.ii[j] > 0.02 * moments.uu[j];
        a.extend(without(fit.a, 0.0).then_some(fit.a / per_speed));
        b.extend((currents && without(0.0, fit.b)).then_some(fit.b / robot.motor.resistance_ohm));
    }
    let a = middle(&mut a);
    let b = middle(&mut b);
    let fault = |signal: &str, unit: WrongUnit, than: &str| {
        let sentence = format!(
            "The `{signal}` columns look like {}: against the {than} they are {:.0} times too large.",
            unit.name, unit.per_unit
        );
        let mend = "Convert the columns to SI units, or state `unit` in columns.toml.";
        Some(Fault::of(run, "wrong_unit", signal, true).says(sentence, mend))
    };
    if let (Some(a), false, "u") = (a, currents, name) {
        let volts = units::explains_without_current(&units::VOLTS, a, true);
        let speeds = units::explains_without_current(&units::SPEEDS, 1.0 / a, false);
        return volts
            .and_then(|unit| fault("u", unit, "wheel speeds"))
            .or_else(|| speeds.and_then(|unit| fault("w", unit, "voltages")));
    }
    match (a, b) {
        (Some(a), b) => {
            let with_b = |fits: bool| b.is_none_or(|b| (b > 100.0) == fits);
            if let Some(unit) = units::explains(&units::VOLTS, a).filter(|_| name == "u" && with_b(true)) {
                return fault("u", unit, "wheel speeds");
            }
            if let Some(unit) = units::explains(&units::SPEEDS, 1.0 / a).filter(|_| with_b(false)) {
                return fault("w", unit, if name == "u" { "voltages" } else { "set speeds" });
            }
            if let Some(unit) = units::explains(&units::SPEEDS, a).filter(|_| name == "wset") {
                return fault("wset", unit, "measured wheel speeds");
            }
            b.and_then(|b| units::explains(&units::AMPERES, 1.0 / b)).and_then(|unit| fault("i", unit, "voltages"))
        }
        (None, Some(b)) => {
            if let Some(unit) = units::explains(&units::VOLTS, b) {
                return fault("u", unit, "currents");
            }
            units::explains(&units::AMPERES, 1.0 / b).and_then(|unit| fault("i", unit, "voltages"))
        }
        (None, None) => None,
    }
}

fn middle(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Currents far above what the supply could drive through a motor held still.
fn stall(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let (Some(group), Some(supply)) = (&run.i, run.supply_v(robot)) else {
        return Vec::new();
    };
    let stall_a = 2.0 * supply / robot.motor.resistance_ohm;
    let mut all: Vec<f64> = group.channels.iter().flat_map(|c| c.present()).map(|(_, i)| i.abs()).collect();
    all.sort_by(f64::total_cmp);
    let high = all.get(all.len() * 9 / 10).copied().unwrap_or(0.0);
    if high < 10.0 * stall_a {
        return Vec::new();
    }
    let sentence = format!(
        "The `i` columns look like milliamperes: a tenth of them exceed {high:.0} A, a stalled motor draws {:.1} A.",
        stall_a / 2.0
    );
    vec![
        Fault::of(run, "wrong_unit", "i", true)
            .says(sentence, "Convert the columns to amperes, or state `unit` in columns.toml."),
    ]
}
