//! Every card states where its effect shows; drives of the paper's robots on three wheels and on four, without the effect
//! and with it, say the same.

use std::path::Path;
use std::sync::LazyLock;

use model_core::effects::EffectKind;
use model_core::effects::card::Card;
use model_core::effects::shows::{Channel, Order, Regime, Shows};
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{WhereShown, where_shown};

const ROBOTS: [&str; 2] =
    [include_str!("../../examples/feup-3w/robot.toml"), include_str!("../../examples/feup-4w/robot.toml")];

/// An effect, and where it shows on each robot, with the robot's gear ratio.
type Derived = (&'static Card, [(WhereShown, f64); 2]);

static DERIVED: LazyLock<Vec<Derived>> = LazyLock::new(|| {
    let files = ROBOTS.map(|text| RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).expect("sound"));
    let all = EffectKind::ALL.iter().map(|kind| kind.card());
    all.map(|card| (card, files.each_ref().map(|file| (where_shown(file, card), file.motor.gear_ratio)))).collect()
});

/// Of two regimes, by how much one explains better that explains nearly as well [1]
const NEARLY: f64 = 0.01;

/// What a statement and the drives of an effect do not agree on.
fn refused(stated: &Shows, (card, robots): &Derived) -> Vec<String> {
    let mut found = Vec::new();
    // robots differ in which of two channels shows an effect most: the sum over them decides
    let share = |channel: Channel| robots.iter().map(|(on, _)| on.shares[channel as usize]).sum::<f64>();
    let most = Channel::ALL.into_iter().max_by(|a, b| share(*a).total_cmp(&share(*b)));
    if stated.channels.first().copied() != most {
        found.push(format!("{}: shows most in {:?}, not in {most:?}", card.id, stated.channels.first()));
    }
    // and of two regimes that explain nearly as well, which explains better
    let explains = |regime: Regime| robots.iter().map(|(on, _)| on.regimes[regime as usize]).sum::<f64>();
    let best = Regime::ALL.into_iter().max_by(|a, b| explains(*a).total_cmp(&explains(*b)));
    if best != Some(stated.regime) {
        found.push(format!("{}: regime stated {:?}, both robots {best:?}", card.id, stated.regime));
    }
    let param = |at: usize| card.params.get(at).map_or(f64::NAN, |p| p.typical);
    for (wheels, (on, gear_ratio)) in [3, 4].into_iter().zip(robots) {
        let mut differs = |what: &str, stated: String, derived: String| {
            if stated != derived {
                found.push(format!("{}, {wheels} wheels: {what} stated {stated}, derived {derived}: {on:?}", card.id));
            }
        };
        let in_order = |mut channels: Vec<Channel>| {
            channels.sort_by_key(|channel| *channel as usize);
            format!("{channels:?}")
        };
        differs("channels", in_order(stated.channels.to_vec()), in_order(on.channels()));
        let behind = on.regimes[on.regime() as usize] - on.regimes[stated.regime as usize];
        if behind > NEARLY {
            differs("regime", format!("{:?}", stated.regime), format!("{:?}", on.regime()));
        }
        differs("parity", format!("{:?}", stated.parity), format!("{:?}", on.parity()));
        let order = stated.order.map(|order| match order {
            Order::Fixed(times) => f64::from(times),
            Order::OfWheel(at) => param(at),
            Order::OfRotor(at) => gear_ratio * param(at),
        });
        differs("order", format!("{order:?}"), format!("{:?}", on.order.map(f64::from)));
    }
    found
}

#[test]
fn every_effect_shows_where_its_card_states() {
    let found: Vec<String> = DERIVED.iter().flat_map(|derived| refused(&derived.0.shows, derived)).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_statement_of_one_effect_is_refused_for_another() {
    let (mut pairs, mut told_apart) = (0, 0);
    for derived in DERIVED.iter() {
        for (other, _) in DERIVED.iter().filter(|(other, _)| other.shows != derived.0.shows) {
            pairs += 1;
            told_apart += usize::from(!refused(&other.shows, derived).is_empty());
        }
    }
    assert!(pairs > 2000, "only {pairs} pairs of cards state different things");
    assert_eq!(told_apart, pairs, "statements that fit a drive of another effect");
}

#[test]
fn each_part_of_a_statement_can_be_refused() {
    let derived = DERIVED.iter().find(|(card, _)| card.id == "roller_ripple").expect("it is in the catalogue");
    let stated = derived.0.shows;
    assert!(refused(&stated, derived).is_empty());
    let parity = DERIVED.iter().map(|(card, _)| card.shows.parity).find(|parity| *parity != stated.parity);
    let wrong = [
        Shows { channels: &[Channel::Current, Channel::WheelSpeed], ..stated },
        Shows { channels: &[], ..stated },
        Shows { regime: Regime::Always, ..stated },
        Shows { parity: parity.expect("cards differ"), ..stated },
        Shows { order: None, ..stated },
        Shows { order: Some(Order::Fixed(14)), ..stated },
        Shows { order: Some(Order::OfRotor(2)), ..stated },
    ];
    for wrong in wrong {
        assert!(!refused(&wrong, derived).is_empty(), "{wrong:?}");
    }
}

#[test]
fn the_best_regime_is_not_best_by_chance() {
    for (card, robots) in DERIVED.iter() {
        for (on, _) in robots {
            let mut regimes = on.regimes;
            regimes.sort_by(f64::total_cmp);
            let [.., second, best] = regimes;
            assert!(best > 0.5 && best - second > 1e-3, "{}: {second} and {best}", card.id);
        }
    }
}
