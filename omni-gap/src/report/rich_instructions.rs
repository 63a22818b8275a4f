//! What a person needs to know to record a rich excitation: one page of plain text.

use std::fmt::Write;

use super::instructions::{begin, floor_in_words};
use super::number::{NBSP, num};
use crate::simulate::Floor;

/// A rich excitation, as its page tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct RichInstructions {
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
    /// Side of the free floor that was counted on [m]
    pub field: f64,
    /// Name and length [s] of each script, and where it takes the robot.
    pub scripts: Vec<(String, f64, Floor)>,
    /// True where the session is there already, played by a robot that is just what its file says.
    pub rehearsed: bool,
}

/// The page, in Markdown that reads well as it is.
pub fn rich_instructions(say: &RichInstructions) -> String {
    let mut page = format!("# Recordings of {} that show what can be shown\n\n", say.robot);
    if say.rehearsed {
        page += "The recordings are there already: `session/runs` was played by a robot that is just what its file says.\n\
                 What follows is what to do with the real one.\n\n";
    }
    let seconds: Vec<f64> = say.scripts.iter().map(|(_, seconds, _)| *seconds).collect();
    begin(&mut page, say.voltage, &seconds, &say.notes);
    play(&mut page, say);
    record(&mut page, say);
    let session = format!("{}/session", say.folder.trim_end_matches('/'));
    let _ = writeln!(
        page,
        "## Then\n\n    omni-gap check {session}\n    omni-gap diagnose {session} --out report\n\n\
         The first looks for mistakes in the recordings and says how to mend them, the second says where robot and\n\
         simulator differ, and why."
    );
    page.replace(NBSP, " ")
}

fn play(page: &mut String, say: &RichInstructions) {
    let _ = writeln!(
        page,
        "## Play\n\n\
         `scripts/<name>.csv` is what to put on the motors: at `t_s` seconds after the start, `u0_V` to `u{}_V` volts on\n\
         motors 0 to {}, held until the next row ({} rows a second); `enable` is 1 throughout. All three axes are asked at once:\n\
         jumps, reversals, rests and slow creeping.\n\n\
         Begin each script at rest in the middle of a free floor of {} m by {} m, and let go of the robot until the script has\n\
         ended. It is not led back: carry it to the middle again before the next one. Nothing holds the robot on its way but\n\
         the scripts themselves, and a robot that is not just what its file says goes another way, the further off the longer\n\
         it drives. Stop it before it leaves the floor; what was recorded until then is of use.\n\n\
         Free floor that a robot needs which is just what its file says, from its centre and the way it looks at the start:\n",
        say.wheels - 1,
        say.wheels - 1,
        num(say.rate).trim_end_matches(".0"),
        num(say.field),
        num(say.field),
    );
    for (name, seconds, floor) in &say.scripts {
        let _ = writeln!(page, "- `{name}`, {seconds:.0} s: {}", floor_in_words(*floor));
    }
    page.push('\n');
}

fn record(page: &mut String, say: &RichInstructions) {
    let last = say.wheels - 1;
    let _ = writeln!(
        page,
        "## Record\n\n\
         Save one file a script, as `session/runs/<name>.csv`. The first line names the columns, units stand in the names; a\n\
         field without a measurement stays empty.\n\n\
         - `t_s`: time in seconds, 100 rows a second or more\n\
         - `u0_V` to `u{last}_V`: the voltages that were put on the motors\n\
         - `i0_A` to `i{last}_A`: motor currents\n\
         - `w0_rad_s` to `w{last}_rad_s`: wheel speeds\n\
         - `x_m`, `y_m`, `theta_rad`: where a camera sees the robot\n\
         - `gyro_rad_s`, `vbat_V`: yaw rate and battery voltage, if there are sensors for them\n\n\
         The more of these are logged, the more causes can be told apart; what recordings with these sensors could show is\n\
         said beforehand by\n\n\
         \u{20}   omni-gap selftest {folder}/session/robot.toml --script {folder}/scripts/*.csv --sensors i,w,pose --camera-rate 60\n\n\
         A log in another form is read through `session/columns.toml`.\n",
        folder = say.folder.trim_end_matches('/'),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_says_what_to_play_to_record_and_to_do_next() {
        let floor = Floor { ahead: 1.0, left: 0.5, ..Floor::default() };
        let page = rich_instructions(&RichInstructions {
            robot: "r".into(),
            wheels: 3,
            folder: "rich/".into(),
            voltage: 8.0,
            notes: vec!["A note.".into()],
            rate: 100.0,
            field: 3.0,
            scripts: vec![("rich-1".into(), 10.0, floor)],
            rehearsed: false,
        });
        for part in [
            "wheels off the ground",
            "`u0_V` to `u2_V`",
            "3.00 m by 3.00 m",
            "- `rich-1`, 10 s: 1.3 m ahead, 0.3 m behind, 0.8 m left, 0.3 m right",
            "`session/runs/<name>.csv`",
            "omni-gap diagnose rich/session --out report",
            "selftest rich/session/robot.toml --script rich/scripts/*.csv",
            "A note.",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(page.lines().all(|l| l.chars().count() <= 125), "{page}");
    }
}
