//! The page: how many numbers are found, which are not, then every number of every robot.

use std::fmt::Write;

use omni_gap::api::{FitRemark, FittedEffectNumber, Identification};
use omni_gap::error::Result;
use omni_gap::report::num;

use super::cases::{CarriedCase, OFF};

/// A number is found where it lies within this many of its own sigmas of the truth [1].
pub const SIGMAS: f64 = 3.0;
/// Where a size's departure from absent is this many of its sigmas [1], starts and all other numbers free, …
pub const PLAIN: f64 = 60.0;
/// … it is found within this share of that departure [1].
pub const SHARE: f64 = 0.05;

/// A number of an effect that a file carries, beside the truth.
#[derive(Clone, Debug)]
pub struct CarriedNumber {
    /// Wheels of the robot.
    pub wheels: usize,
    /// What was found.
    pub found: FittedEffectNumber,
    /// The true value.
    pub truth: f64,
    /// The value at which the effect is absent.
    pub absent: f64,
    /// True if it sizes the effect.
    pub size: bool,
    /// By how much the phase of a ripple is uncertain at the end of a run [rad]; none where there is none.
    pub phase_lost: Option<f64>,
}

impl CarriedNumber {
    /// The numbers of a case's own effect among those that were found.
    ///
    /// # Errors
    /// Where the robot file that was found is not sound.
    pub fn of(case: &CarriedCase, found: Identification) -> Result<Vec<Self>> {
        let phase_lost = case.phase_lost(&case.written(&found)?);
        let own = found.effects.into_iter().filter(|number| number.effect == case.effect.id);
        let beside_truth = |found: FittedEffectNumber| {
            let (truth, absent, size) = case.truth(found.key)?;
            Some(Self { wheels: case.wheels(), found, truth, absent, size, phase_lost })
        };
        Ok(own.filter_map(beside_truth).collect())
    }

    /// How many of its own sigmas it lies from the truth [1]; none where it was not fitted.
    pub fn off_sigmas(&self) -> Option<f64> {
        Some((self.found.fitted - self.truth).abs() / self.found.std?)
    }

    /// By which share of the true departure from absent it is off [1]; none where that is nothing.
    pub fn off_share(&self) -> Option<f64> {
        let departure = self.truth - self.absent;
        (departure != 0.0).then(|| ((self.found.fitted - self.truth) / departure).abs())
    }

    /// The true departure from absent over its own sigma [1]; none where it was not fitted.
    fn signal(&self) -> Option<f64> {
        Some((self.truth - self.absent).abs() / self.found.std?)
    }

    /// True if the recordings told something of it.
    pub fn is_told(&self) -> bool {
        self.found.std.is_some()
    }

    /// True if it has to be found within [`SHARE`].
    pub fn is_plain(&self) -> bool {
        self.size && self.signal().is_some_and(|signal| signal >= PLAIN)
    }

    /// True if it lies within [`SIGMAS`].
    pub fn is_sure(&self) -> bool {
        self.off_sigmas().is_none_or(|off| off <= SIGMAS)
    }

    /// True if it is found within [`SHARE`], where it has to be.
    pub fn is_close(&self) -> bool {
        !self.is_plain() || self.off_share().is_none_or(|off| off <= SHARE)
    }

    fn place(&self) -> String {
        let wheel = self.found.wheel.map_or(String::new(), |wheel| format!(" (wheel {wheel})"));
        format!("`{}`{wheel}", self.found.effect)
    }
}

/// The whole page.
pub fn page(numbers: &[CarriedNumber]) -> String {
    let mut text = opening();
    text += &counts(numbers);
    text += &misses(numbers);
    text += &format!("\n## Every number\n\n{HEADS} |\n|---|---|---|---|---|---|---|---|\n");
    numbers.iter().for_each(|number| text += &format!("{} |\n", cells(number)));
    text
}

fn opening() -> String {
    format!(
        "# Numbers of effects that a robot file carries, as `identify` finds them\n\n\
         A robot of the paper has an effect of typical size; its file has the same effect with {:.0} % of that size, and every\n\
         number of the robot off by a Gaussian draw of what the file states of it. `identify` is given that file and 8 runs of\n\
         3 s of random motion on all axes at 200 rows a second, with currents, wheel speeds and a camera of 60 frames a second,\n\
         all with the noise of the file's sensors; with gyro and battery where nothing else shows the effect, with set speeds\n\
         where the drives' own answer is the effect, beside wheel slip where it does not show without. The robot that is recorded\n\
         takes ten steps a row. What recordings tell nothing of keeps the file's value, and `identify` says so.\n\n\
         A number is to lie within {SIGMAS} of its own sigmas of the truth, and a size within {:.0} % of its departure from\n\
         absent where that is {PLAIN} of its sigmas or more, starts and all other numbers free.\n\n\
         `cargo xtask carried` makes this page again and compares it with this one; BLESS=1 rewrites it.\n\n",
        100.0 * OFF,
        100.0 * SHARE,
    )
}

fn counts(numbers: &[CarriedNumber]) -> String {
    let count = |is: &dyn Fn(&CarriedNumber) -> bool| numbers.iter().filter(|number| is(number)).count();
    let told = count(&CarriedNumber::is_told);
    let plain = count(&CarriedNumber::is_plain);
    format!(
        "| | numbers | of |\n|---|---|---|\n\
         | within {SIGMAS} of their own sigmas of the truth | {} | {told} |\n\
         | within {:.0} %, of sizes that are {PLAIN} of their sigmas | {} | {plain} |\n\
         | not told by such recordings, and said so | {} | {} |\n",
        count(&|n| n.is_told() && n.is_sure()),
        100.0 * SHARE,
        count(&|n| n.is_plain() && n.is_close()),
        count(&|n| n.found.remark == FitRemark::NotTold),
        numbers.len(),
    )
}

/// The numbers that are not found so.
fn misses(numbers: &[CarriedNumber]) -> String {
    let mut text = String::from(
        "\n## Where a number is not found so\n\n\
         `phase lost`: by how much the angle of a ripple is uncertain at the end of a run, since it is summed from speeds that\n\
         were measured with noise. Beyond one or two radians the two parts of a ripple are found with any sign, and their sigmas,\n\
         which take the angle for known, are too small: log speeds with less noise, at a higher rate, or in shorter runs.\n\n",
    );
    text += &format!("{HEADS} | phase lost |\n|---|---|---|---|---|---|---|---|---|\n");
    for number in numbers.iter().filter(|n| !(n.is_sure() && n.is_close())) {
        let lost = number.phase_lost.map_or("–".to_owned(), |lost| format!("{} rad", num(lost)));
        let _ = writeln!(text, "{} | {lost} |", cells(number));
    }
    text
}

/// What heads a table's columns.
const HEADS: &str = "| wheels | effect | number | true | in the file | found | off | off";

fn cells(number: &CarriedNumber) -> String {
    let found = match number.found.std {
        Some(std) => format!("{} ± {}", num(number.found.fitted), num(std)),
        None => "not told".to_owned(),
    };
    let marked = |text: String, well: bool| if well { text } else { format!("**{text}**") };
    let sigmas = number.off_sigmas().map_or("–".to_owned(), |off| marked(format!("{off:.1} σ"), number.is_sure()));
    let share = match (number.is_told(), number.off_share()) {
        (true, Some(off)) => marked(format!("{:.1} %", 100.0 * off), number.is_close()),
        _ => "–".to_owned(),
    };
    format!(
        "| {} | {} | `{}` | {} | {} | {found} | {sigmas} | {share}",
        number.wheels,
        number.place(),
        number.found.key,
        num(number.truth),
        num(number.found.nominal),
    )
}

/// A line of the table of all numbers that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadNumber {
    /// Wheels of the robot.
    pub wheels: usize,
    /// The effect's id.
    pub effect: String,
    /// The number's key.
    pub number: String,
    /// How far it lies from the truth [its own σ]; none where it was not told.
    pub off_sigmas: Option<f64>,
    /// True if that is marked as too far.
    pub unsure: bool,
}

/// The table of every number, as it stands on a page.
pub fn read_table(page: &str) -> Vec<ReadNumber> {
    let section = page.lines().skip_while(|line| *line != "## Every number").skip(1);
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [wheels, effect, number, _, _, _, sigmas, _] = cells[..] else { return None };
        let key = |cell: &str| cell.split('`').nth(1).map(str::to_owned);
        Some(ReadNumber {
            wheels: wheels.parse().ok()?,
            effect: key(effect)?,
            number: key(number)?,
            off_sigmas: sigmas.trim_matches('*').trim_end_matches(" σ").parse().ok(),
            unsure: sigmas.starts_with('*'),
        })
    };
    section.filter_map(row).collect()
}

/// The counts that a page begins with: numbers, and of how many.
pub fn read_counts(page: &str) -> Vec<(usize, usize)> {
    let rows = page.lines().take_while(|line| !line.starts_with("## "));
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [_, count, of] = cells[..] else { return None };
        Some((count.parse().ok()?, of.parse().ok()?))
    };
    rows.filter_map(row).collect()
}
