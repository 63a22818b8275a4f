//! The page: what pooling finds, and what it names that is not there.

use std::collections::BTreeMap;
use std::fmt::Write;

use omni_gap::report::{num, percent};

use super::trials::{FOUND, ROBOTS, Trial, median};

/// The trials of fleets with one weak effect, and of healthy ones.
#[derive(Clone, Debug)]
pub struct Trials {
    /// Standard errors by which each session shows it.
    pub errors: f64,
    /// Those with an effect.
    pub weak: Vec<Trial>,
    /// Healthy ones, each with the share of the stated uncertainty that its robots have in common.
    pub healthy: Vec<(f64, Trial)>,
}

/// The whole page.
pub fn page(trials: &Trials) -> String {
    let mut text = format!(
        "# What many robots tell together\n\n\
         {ROBOTS} robots of one kind (`examples/feup-4w`), a session each: three runs of 2 s with 100 rows a second. Their numbers are off by draws\n\
         of what the robot file states, half of it common to all. All have one effect, of a size that one session shows by {} standard\n\
         errors beyond what the numbers imitate. *Found*: named with a probability of at least {}. *Among look-alikes*: it is one of\n\
         the causes told, and it and those that its card says it can be taken for have that probability together.\n\
         *Nothing stated*: standard errors by which a session shows it where the numbers are free: what the numbers imitate but for what the\n\
         file states of them does not become surer on {ROBOTS} robots that may share the file's error. *Missed alone*: robots of {ROBOTS} whose\n\
         own diagnosis does not name it.\n\n",
        num(trials.errors),
        percent(FOUND)
    );
    text += "| effect | of its typical size | one session, nothing stated [σ] | fleets | found | among look-alikes | something else named | least probability | missed alone | estimate/truth |\n|---|---|---|---|---|---|---|---|---|---|\n";
    let mut by_id: BTreeMap<&str, Vec<&Trial>> = BTreeMap::new();
    for trial in &trials.weak {
        by_id.entry(trial.hidden.map_or("", |(id, _)| id)).or_default().push(trial);
    }
    for (id, fleets) in &by_id {
        let _ = writeln!(text, "{}", row(id, fleets));
    }
    text += &healthy(&trials.healthy);
    text
}

fn row(id: &str, fleets: &[&Trial]) -> String {
    let found = fleets.iter().filter(|trial| trial.named() == Some(id)).count();
    let alike = fleets.iter().filter(|trial| trial.probability() > 0.0 && trial.with_look_alikes() >= FOUND).count();
    let wrong = fleets.iter().filter(|trial| trial.named().is_some_and(|named| named != id)).count();
    let least = fleets.iter().map(|trial| trial.probability()).fold(1.0, f64::min);
    let missed: Vec<usize> = fleets.iter().map(|trial| ROBOTS - trial.named_alone).collect();
    let sizes: Vec<f64> = fleets.iter().filter_map(|trial| trial.hidden.map(|(_, share)| share)).collect();
    let (fewest, most) = (missed.iter().min().unwrap_or(&0), missed.iter().max().unwrap_or(&0));
    format!(
        "| `{id}` | {} | {} | {} | {found} | {alike} | {wrong} | {} | {fewest} to {most} | {} |",
        percent(median(sizes)),
        num(median(fleets.iter().map(|trial| trial.beyond_free_numbers).collect())),
        fleets.len(),
        percent(least),
        num(median(fleets.iter().filter_map(|trial| estimate_over_truth(trial)).collect()))
    )
}

/// What pooling says of the effect's size over what it is.
fn estimate_over_truth(trial: &Trial) -> Option<f64> {
    let (id, share) = trial.hidden?;
    let cause = trial.pooled.common.iter().find(|cause| cause.of.id == id && cause.of.wheel.is_none())?;
    let of = trial.pooled.estimates.iter().find(|robot| robot.of == cause.of)?;
    let card = model_core::effects::EffectKind::find(id)?.card();
    let number = card.params.iter().find(|number| number.key == cause.of.key)?;
    Some((cause.value - of.absent) / (share * (number.typical - number.absent)))
}

fn healthy(fleets: &[(f64, Trial)]) -> String {
    let mut text = format!(
        "\n## Healthy fleets\n\n{ROBOTS} robots with nothing but numbers that are off. *False*: a cause named with a probability of at least {}.\n\n\
         | of what is stated, common to all | told | fleets | false | most probable of them | robots that stand out | fleets with one |\n|---|---|---|---|---|---|---|\n",
        percent(FOUND)
    );
    let mut shares: Vec<f64> = fleets.iter().map(|(share, _)| *share).collect();
    shares.dedup();
    for share in shares {
        let own: Vec<&Trial> = fleets.iter().filter(|(own, _)| *own == share).map(|(_, trial)| trial).collect();
        let out = |trial: &Trial| trial.pooled.estimates.iter().filter(|robot| robot.stands_out).count();
        let told = median(own.iter().filter_map(|trial| trial.pooled.in_common).collect());
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} |",
            percent(share),
            percent(told),
            own.len(),
            own.iter().filter(|trial| trial.named().is_some()).count(),
            percent(own.iter().map(|trial| trial.probability()).fold(0.0, f64::max)),
            own.iter().map(|trial| out(trial)).sum::<usize>(),
            own.iter().filter(|trial| out(trial) > 0).count()
        );
    }
    text
}
