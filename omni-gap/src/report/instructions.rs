//! What a person needs to know to do the experiments with a robot: one page of plain text.

use std::fmt::Write;

use model_core::effects::seams::STANDARD_GRAVITY;

use super::number::{NBSP, figures, num};
use crate::simulate::{Experiment, Floor};

/// One script, as the page tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptSaid {
    /// Name of the run.
    pub name: String,
    /// Which experiment it is part of.
    pub experiment: Experiment,
    /// How long it takes [s]
    pub seconds: f64,
    /// Where it takes the robot.
    pub floor: Floor,
}

/// A morning of experiments.
#[derive(Clone, Debug, PartialEq)]
pub struct Instructions {
    /// The robot's name.
    pub robot: String,
    /// How many wheels it has.
    pub wheels: usize,
    /// Where the page and the scripts stand, as the person named it.
    pub folder: String,
    /// Largest voltage of the scripts [V]
    pub voltage: f64,
    /// What is to be known of the voltage, a sentence each.
    pub notes: Vec<String>,
    /// Rows of a script in a second [1/s]
    pub rate: f64,
    /// The scripts in the order in which they are done.
    pub scripts: Vec<ScriptSaid>,
    /// The torque by which each further load brakes the turning robot more [N·m]
    pub drag: f64,
    /// True where the session is there already, played by a robot that is just what its file says.
    pub rehearsed: bool,
}

/// Free floor to leave around what a script needs [m]
const MARGIN: f64 = 0.3;
/// An arm and the friction of cloth on a floor, to say what a load could be [m], [1]
const ARM: f64 = 0.15;
const CLOTH: f64 = 0.4;
/// Width of a line (characters)
const WIDTH: usize = 110;

/// The page, in Markdown that reads well as it is.
pub fn instructions(say: &Instructions) -> String {
    let mut page = String::new();
    let _ = writeln!(page, "# Experiments with {}\n", say.robot);
    if say.rehearsed {
        page += "The recordings are there already: `session/runs` was played by a robot that is just what its file says.\n\
                 What follows is what to do with the real one.\n\n";
    }
    let seconds: Vec<f64> = say.scripts.iter().map(|script| script.seconds).collect();
    begin(&mut page, say.voltage, &seconds, &say.notes);
    play(&mut page, say);
    for (n, experiment) in [Experiment::Spin, Experiment::Coast, Experiment::Motor, Experiment::Step].iter().enumerate()
    {
        let own: Vec<&ScriptSaid> = say.scripts.iter().filter(|s| s.experiment == *experiment).collect();
        if !own.is_empty() {
            experiment_said(&mut page, say, n + 1, *experiment, &own);
        }
    }
    record(&mut page, say);
    next(&mut page, say);
    page.replace(NBSP, " ")
}

/// What to know before the robot drives: scripts of up to a voltage [V], each so long [s].
pub(super) fn begin(page: &mut String, voltage: f64, seconds: &[f64], notes: &[String]) {
    *page += "## Safety\n\n\
              Do every script once with the wheels off the ground before it drives. Keep a hand at the switch that cuts\n\
              the motors' power, and people, cables and stairs out of the robot's way.\n\n";
    let minutes = (seconds.iter().sum::<f64>() / 60.0).ceil();
    let _ = writeln!(
        page,
        "The largest voltage of these scripts is {} V. All {} of them take {minutes:.0} minute(s) of driving.",
        num(voltage),
        seconds.len()
    );
    for note in notes {
        let _ = writeln!(page, "{note}");
    }
    page.push('\n');
}

fn play(page: &mut String, say: &Instructions) {
    let last = say.wheels - 1;
    let _ = writeln!(
        page,
        "## Play\n\n\
         `scripts/<name>.csv` is what to put on the motors: at `t_s` seconds after the start, `u0_V` to `u{last}_V` volts on\n\
         motors 0 to {last}, held until the next row ({} rows a second). Where `enable` is 0 and the voltages are empty, open\n\
         the bridges, so that no current can flow and the robot coasts: zero volts would brake it. Begin each script with\n\
         the robot at rest, and let go of it until the script has ended: it comes back to about where it began.\n",
        num(say.rate).trim_end_matches(".0")
    );
}

fn experiment_said(page: &mut String, say: &Instructions, n: usize, experiment: Experiment, own: &[&ScriptSaid]) {
    let _ = writeln!(page, "## {n}. {}\n", capital(experiment.title()));
    let purpose = match experiment {
        Experiment::Spin => {
            "The robot turns on the spot, faster and faster, then the other way round. At a steady speed all torque goes\n\
             into friction: this is for B_ω and C_ω."
        }
        Experiment::Coast => {
            "The robot gets up to speed along one axis (v: ahead, vn: to the left, w: turning), then the bridges open and\n\
             it coasts to rest; then the same back. Only friction slows it: this is for B_v, B_vn, C_v, C_vn, and with\n\
             experiment 1 for J."
        }
        Experiment::Motor => {
            "The robot turns on the spot at steady voltages, again and again with more to drag: this is for R and K_v.\n\
             `motor-load-0` drags nothing; what each further one drags is yours to choose and need not be known."
        }
        Experiment::Step => {
            "The robot is driven along one axis, forth and back, at several voltages: this is for R, J, B_v, B_vn, B_ω\n\
             and C_ω."
        }
    };
    let _ = writeln!(page, "{purpose}");
    if experiment == Experiment::Motor && own.len() > 1 {
        let bag = say.drag / (ARM * CLOTH * STANDARD_GRAVITY);
        let _ = writeln!(
            page,
            "About {} N·m more each time is right, for example {} kg more on a piece of cloth that an arm of {:.0} cm drags\n\
             round. Take less where the robot no longer turns evenly.",
            figures(say.drag, 2),
            format_args!("{bag:.1}"),
            100.0 * ARM
        );
    }
    let floor = own.iter().fold(Floor::default(), |all, s| all.with(s.floor));
    let _ = writeln!(page, "Free floor, from the robot's centre and the way it looks: {}.\n", floor_in_words(floor));
    let seconds: f64 = own.iter().map(|s| s.seconds).sum();
    let _ = writeln!(page, "{} script(s), {seconds:.0} s together:", own.len());
    let mut line = String::new();
    for (n, script) in own.iter().enumerate() {
        let end = if n + 1 == own.len() { "" } else { "," };
        let next = format!("`{}`{end}", script.name);
        if !line.is_empty() && line.len() + 1 + next.len() > WIDTH {
            let _ = writeln!(page, "{line}");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line += &next;
    }
    let _ = writeln!(page, "{line}\n");
}

/// "1.9 m ahead, 0.4 m behind and to both sides"
pub(super) fn floor_in_words(floor: Floor) -> String {
    let sides = [("ahead", floor.ahead), ("behind", floor.behind), ("left", floor.left), ("right", floor.right)];
    let metres = |x: f64| (10.0 * (x + MARGIN)).ceil() / 10.0;
    if sides.iter().all(|(_, x)| metres(*x) == metres(0.0)) {
        return format!("{:.1} m all around, it stays where it is", metres(0.0));
    }
    sides.map(|(side, x)| format!("{:.1} m {side}", metres(x))).join(", ")
}

fn record(page: &mut String, say: &Instructions) {
    let last = say.wheels - 1;
    let numbered = |stem: &str, unit: &str| format!("`{stem}0_{unit}` to `{stem}{last}_{unit}`");
    let _ = writeln!(
        page,
        "## Record\n\n\
         Save one file a script, as `session/runs/<name>.csv` with the script's name: the name says which experiment it is.\n\
         The first line names the columns, units stand in the names; a field without a measurement stays empty.\n\n\
         - `t_s`: time in seconds, 25 rows a second or more\n\
         - {}: the voltages that were put on the motors, empty while the bridges are open\n\
         - `enable`: 1 while the bridges are driven, 0 while they are open (needed for experiment 2)\n\
         - {}: motor currents (needed for experiment 1, the motor experiment, and to tell R from K_t)\n\
         - {}: wheel speeds, if there are sensors for them\n\
         - `x_m`, `y_m`, `theta_rad`: where a camera sees the robot; wheel speeds or a camera must be there\n\n\
         A log in another form is read through `session/columns.toml`. Weigh the robot and measure its wheels well: mass and\n\
         geometry are taken from `session/robot.toml` as they stand there.\n",
        numbered("u", "V"),
        numbered("i", "A"),
        numbered("w", "rad_s"),
    );
}

fn next(page: &mut String, say: &Instructions) {
    let wanted = |e: Experiment| say.scripts.iter().any(|s| s.experiment == e);
    let only: Vec<Experiment> = Experiment::ALL.into_iter().filter(|e| wanted(*e)).collect();
    let which = match only[..] {
        [Experiment::Spin] => "1",
        [Experiment::Coast] => "2",
        [Experiment::Motor] => "motor",
        [Experiment::Step] => "3",
        _ => "all",
    };
    let session = format!("{}/session", say.folder.trim_end_matches('/'));
    let _ = writeln!(
        page,
        "## Then\n\n    omni-gap check {session}\n    omni-gap identify {session} --experiment {which} --out identified.toml\n\n\
         The first looks for mistakes in the recordings and says how to mend them, the second says what they tell of\n\
         the robot."
    );
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(name: &str, ahead: f64) -> ScriptSaid {
        let experiment = Experiment::of(name).unwrap();
        ScriptSaid { name: name.into(), experiment, seconds: 12.0, floor: Floor { ahead, ..Floor::default() } }
    }

    fn morning(scripts: Vec<ScriptSaid>) -> Instructions {
        Instructions {
            robot: "r".into(),
            wheels: 3,
            folder: "morning/".into(),
            voltage: 8.0,
            notes: vec!["A note.".into()],
            rate: 100.0,
            scripts,
            drag: 0.5,
            rehearsed: false,
        }
    }

    #[test]
    fn the_page_says_what_to_play_to_record_and_to_do_next() {
        let page =
            instructions(&morning(vec![said("spin-left", 0.0), said("motor-load-0", 0.0), said("motor-load-1", 0.0)]));
        for part in [
            "wheels off the ground",
            "hand at the switch",
            "`u0_V` to `u2_V`",
            "## 1. Experiment 1",
            "0.3 m all around",
            "0.50 N·m more",
            "0.8 kg",
            "2 script(s), 24 s together:",
            "`motor-load-0`, `motor-load-1`",
            "`session/runs/<name>.csv`",
            "identify morning/session --experiment all",
            "A note.",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(!page.contains("Coast") && !page.contains("Step"), "{page}");
    }

    #[test]
    fn one_experiment_alone_is_asked_for_by_its_name_and_its_floor_has_a_margin() {
        let page = instructions(&morning(vec![said("step-v-50-1", 1.22)]));
        assert!(page.contains("--experiment 3 --out") && page.contains("1.6 m ahead, 0.3 m behind"), "{page}");
        assert!(page.lines().all(|l| l.chars().count() <= 120), "{page}");
    }
}
