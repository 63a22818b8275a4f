//! The golden page of the faults: what a person judges, and what it must keep.

use model_core::link::block::{BlockErrorKind, ControlMode};
use model_core::link::command::CommandError;
use model_core::link::framing::FrameKind;

use super::Results;
use super::case::{FaultCase, FaultCause, is_timed};
use super::crash::{CrashOutcome, title};
use super::run_case::{FaultOutcome, near};
use super::test_robot::ACCELERATION;
use super::unfound::{Unfound, UnfoundOutcome};
use super::wheel_loss::{LEGS, WheelLoss, WheelLossOutcome};

/// How far from what it is told a robot with three wheels may be [m/s, and rad/s over ten].
const ASTRAY: f64 = 0.06;

/// Turns from the one that sees a fault to the one that drops the enables, at most: within one period.
const DROPPED: u32 = 1;

/// Periods after which an unfed watchdog fires.
const WATCHDOG_PERIODS: u32 = 400;

/// The page.
pub fn page(results: &Results) -> String {
    let mut page = String::from(HEAD);
    for (case, played) in &results.cases {
        page += &row(case, played);
    }
    page += BETWEEN;
    for (loss, gone) in &results.wheel_losses {
        page += &leg_row(loss, gone);
    }
    page += UNFOUND;
    for (unfound, went) in &results.unfound {
        page += &unfound_row(unfound, went);
    }
    let watchdog = &results.watchdog;
    page += &format!(
        "{WATCHDOG}- {} after the first motion turn that does not end the bridges are open: `TurnOverrun`, the next turn \
         was due.\n- {} after it the dog has bitten; it waits for {}.\n- Bridges closed after that, though \
         CLEAR and commands came: {} periods.\n",
        watchdog.overrun.map_or("Never".into(), time),
        watchdog.fired.map_or("Never".into(), time),
        time(WATCHDOG_PERIODS),
        watchdog.closed_after,
    );
    page += CRASHES;
    for (by, came) in &results.crashes {
        page += &crash_row(title(*by), came);
    }
    page + LEVELS
}

const HEAD: &str = "\
# Faults, injected

Made by `cargo run --release -p host-tests --bin faults -- IMAGE` with the emulated image in QEMU; `BLESS=1` rewrites it.

The robot drives along v with 0.5 m/s, commands come every 10 ms, and something goes wrong. A period is 50 µs. Each time \
is counted in whole periods from the one in whose codes or bytes the event is whole for the first time:

- **seen**: until the turn that latches the fault (known from the same library called on the host beside the image, which \
asks the same of every period, bit for bit, in every row with a time here);
- **enables dropped**: *same turn*, or *next turn* where a motion turn finds it, which comes to an end between two \
current turns. Both are within one current period;
- **safe**: until the first period that the board lives through with the bridges open. The emulated board takes the \
enables over with the compare registers at the end of the period; pins drop in the turn itself;
- **latched**: with the cause gone and commands coming for 100 ms the bridges stay open, and the records name the code;
- **cleared while it lasts**: periods with bridges closed after CLEAR, commands coming, until it is seen again;
- **cleared after**: CLEAR alone closes nothing for 100 ms; the next fresh command drives, and 1 s later so fast.

*opens* tells which bridges: all, or that of one wheel while the robot drives on with three.

| what goes wrong | code | robot | opens | seen | enables dropped | safe | latched | cleared while it lasts | cleared after |
|---|---|---|---|---|---|---|---|---|---|
";

const BETWEEN: &str = "
## Four wheels go on with three

One wheel is out of use, its bridge open, and nothing is cleared: the robot is told to go forward, to the left, back and \
to the right, and to turn, 1.5 s each. What it does in the last 0.3 s, and the largest acceleration of its reference along v.

| wheel lost | v 0.5 m/s | vn 0.5 m/s | v −0.3, vn −0.3 m/s | ω 3 rad/s | largest acceleration |
|---|---|---|---|---|---|
";

const UNFOUND: &str = "
## What is not found

The robot with four wheels drives on for 2 s; its speed in the last half second, and the largest departure from it.

| what goes wrong | speed | ripple | why it is not found |
|---|---|---|---|
";

const WATCHDOG: &str = "
## Watchdog

Motion turns are made so long that none ends: nothing below them runs, nobody feeds the dog. The dog here is the emulated \
board's own, which counts exchanges and restarts the machine; the chip's, which counts its own oscillator, is for a board to \
show.

";

const CRASHES: &str = "
## A program that fails

While the robot drives, its program comes to an end in a current turn. The board's own way then opens the bridges and waits \
for the watchdog; the records of the start that follows name `Watchdog` (code 12) alone until CLEAR. *after*: with its block \
sent again, the speed after 1 s of commands.

| it comes to | bridges open | restarted after | named, open until CLEAR | after |
|---|---|---|---|---|
";

const LEVELS: &str = "
## At which level

Every row is played on the image in QEMU; converters, hall lines, fault line, supply and link are the virtual board's. \
What has no part there: the registers that the chip's board writes when its program fails (they are read off its linked \
image, page `image.md`) and those that say what a reset came from; the gate drivers' own reaction; a brown-out of the processor itself, which is a \
start like any other: bridges open, no fault named.
";

/// Periods as a time.
fn time(periods: u32) -> String {
    match periods {
        0 => "at once".into(),
        few if few < 100 => format!("{} µs", few * 50),
        many => format!("{:.2} ms", f64::from(many) * 0.05),
    }
}

fn row(case: &FaultCase, played: &FaultOutcome) -> String {
    let mode = if case.mode == ControlMode::Voltage { ", by voltage" } else { "" };
    let opens = case.costs.map_or("all".into(), |motor| format!("wheel {motor}"));
    let dropped = match played.dropped {
        Some(0) => "same turn".into(),
        Some(1) => "next turn".into(),
        Some(turns) => format!("{turns} turns later"),
        // the moment of a detection by time is not known to a period
        None => "–".into(),
    };
    let safe = match (case.cause, played.safe) {
        (FaultCause::FromTheStart(_), Some(0)) => "never closed".into(),
        (_, Some(periods)) => time(periods),
        (_, None) => "**never**".into(),
    };
    let seen = match (played.seen, case.cause) {
        (Some(periods), _) => time(periods),
        (None, FaultCause::LongTurn(_)) => "at its end".into(),
        (None, FaultCause::LongMotion(_)) => "when the next is due".into(),
        (None, _) => "**never**".into(),
    };
    let latched = match (played.named, played.closed_after) {
        (true, 0) => "yes".into(),
        (false, 0) => "**not named**".into(),
        (_, periods) => format!("**closed for {periods}**"),
    };
    let lasting = played.closed_by_clear.map_or("–".into(), |periods| match periods {
        0 => "stays open".into(),
        1 => "1 period".into(),
        few if few < 100 => format!("{few} periods"),
        many => time(many),
    });
    let after = match (played.cleared, played.closed_waiting) {
        (true, 0) => format!("{:.2} m/s", played.speed),
        (false, _) => "**not cleared**".into(),
        (_, periods) => format!("**closed for {periods} before a command**"),
    };
    let said = played.refused.map_or(String::new(), |reply| format!(" (answer: {})", reason(reply.to, reply.reason)));
    format!(
        "| {}{said} | {} `{:?}` | {} wheels{mode} | {opens} | {seen} | {dropped} | {safe} | {latched} | {lasting} | {after} |\n",
        case.title,
        case.fault.code(),
        case.fault,
        case.wheels,
    )
}

fn crash_row(title: &str, came: &CrashOutcome) -> String {
    let told = |periods: Option<u32>| periods.map_or("**never**".into(), time);
    let named = match (came.named, came.closed_after) {
        (true, 0) => "yes".into(),
        (false, 0) => "**not named**".into(),
        (_, periods) => format!("**closed for {periods}**"),
    };
    format!("| {title} | {} | {} | {named} | {:.2} m/s |\n", told(came.open), told(came.restarted), came.speed)
}

fn reason(to: u8, code: u8) -> String {
    let words = if to == FrameKind::Commit.code() {
        BlockErrorKind::from_code(code).map(BlockErrorKind::text)
    } else {
        CommandError::ALL.into_iter().find(|reason| reason.code() == code).map(CommandError::text)
    };
    words.unwrap_or("**no reason that is known**").into()
}

fn unfound_row(unfound: &Unfound, went: &UnfoundOutcome) -> String {
    let found = if went.found.is_empty() && went.closed { "" } else { " **(it is found)**" };
    format!("| {}{found} | {:.2} m/s | {:.2} m/s | {} |\n", unfound.title, went.speed, went.ripple, unfound.why)
}

fn leg_row(loss: &WheelLoss, gone: &WheelLossOutcome) -> String {
    let [ahead, left, back, turned] = gone.went;
    let held = if gone.without { "" } else { " **(not as it should be)**" };
    format!(
        "| {}{held} | {:.2} | {:.2} | {:.2}, {:.2} | {:.2} | {:.2} m/s² |\n",
        loss.title, ahead.v, left.vn, back.v, back.vn, turned.w, gone.acceleration,
    )
    .replace('-', "−")
}

/// What the results do not keep of what is promised; empty where they keep all.
pub fn broken_promises(results: &Results) -> Vec<String> {
    let mut broken = Vec::new();
    for (case, played) in &results.cases {
        let mut must = |kept: bool, what: &str| {
            if !kept {
                broken.push(format!("{}, {} wheels, {:?}: {what}: {played:?}", case.title, case.wheels, case.mode));
            }
        };
        let timed = is_timed(&case.cause);
        must(played.seen.is_some_and(|seen| seen <= case.seen_within) || timed, "seen in time");
        must(played.dropped.is_some_and(|turns| turns <= DROPPED) || timed, "open within one period");
        // seen, dropped, and the period that it holds from
        must(played.safe.is_some_and(|safe| safe <= case.seen_within + DROPPED + 1), "safe in time");
        must(played.named && played.closed_after == 0, "latched");
        must(played.cleared && played.closed_waiting == 0 && played.drives(), "cleared, and driving again");
        must(played.same_block, "the first block is still in use");
        must(played.diverged_at.is_none(), "the twins ask the same");
        let answer = match case.cause {
            FaultCause::Block(spoilt) => Some((FrameKind::Commit, spoilt.reason().code())),
            FaultCause::Command(v) => Some((
                FrameKind::Drive,
                if v.is_finite() { CommandError::TooFast } else { CommandError::NotFinite }.code(),
            )),
            _ => None,
        };
        must(played.refused.map(|r| (r.to, r.reason)) == answer.map(|(to, code)| (to.code(), code)), "answered");
    }
    for (loss, gone) in &results.wheel_losses {
        let near = |k: usize| {
            let (is, want) = (gone.went[k], LEGS[k]);
            (is.v - want.v).abs() < ASTRAY && (is.vn - want.vn).abs() < ASTRAY && (is.w - want.w).abs() < 10.0 * ASTRAY
        };
        let reduced = loss.motor >= 4 || gone.acceleration < 0.9 * f64::from(ACCELERATION[0]);
        if !((0..4).all(near) && reduced && gone.without) {
            broken.push(format!("wheel lost: {}: {gone:?}", loss.title));
        }
    }
    for (unfound, went) in &results.unfound {
        if !(went.found.is_empty() && went.closed) {
            broken.push(format!("it is found: {}: {went:?}", unfound.title));
        }
    }
    for (by, came) in &results.crashes {
        let soon = came.open.is_some_and(|k| k <= 1) && came.restarted.is_some_and(|k| k <= WATCHDOG_PERIODS);
        if !(soon && came.named && came.closed_after == 0 && near(came.speed)) {
            broken.push(format!("{}: {came:?}", title(*by)));
        }
    }
    let watchdog = &results.watchdog;
    if !(watchdog.overrun.is_some_and(|k| k <= 42)
        && watchdog.fired.is_some_and(|k| k <= WATCHDOG_PERIODS + 20)
        && watchdog.closed_after == 0)
    {
        broken.push(format!("the watchdog: {watchdog:?}"));
    }
    broken
}
