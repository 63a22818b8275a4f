//! Every pair of effects at one seam: a model asks them in the order of the catalogue, in whichever order a file or a
//! diagnosis names them; which of them would not commute otherwise stands on a page.

use std::fmt::Write;
use std::path::Path;

use host_tests::catalogue::sessions::truth;
use host_tests::excitation::SeededRng;
use model_core::effects::active::Effects;
use model_core::effects::card::Seam;
use model_core::effects::seams::{
    Body, Bridge, Contact, EffectContext, Gear, Sense, Shaft, SpeedDrive, Supply, Winding,
};
use model_core::effects::telegram::Command;
use model_core::effects::{Effect, EffectKind, EffectSet, EffectState};
use model_core::plant::Plant;
use omni_gap::known_effects;
use omni_gap::log::RobotFile;
use omni_gap::simulate::{EffectInstance, Model};

use crate::bounds::stays_finite;
use crate::fixture::{four, typical, usual_placement};
use crate::golden;
use crate::seams::{Described, LOST, NOW, at, remembered};

/// Every pair at a seam, in the order of the catalogue.
fn pairs(seam: Seam) -> Vec<[EffectKind; 2]> {
    let there: Vec<EffectKind> =
        EffectKind::ALL.into_iter().filter(|effect| effect.card().seams.contains(&seam)).collect();
    let with_later = |k: usize| there[k + 1..].iter().map(|later| [there[k], *later]).collect::<Vec<_>>();
    (0..there.len()).flat_map(with_later).collect()
}

#[test]
fn a_model_has_them_in_the_order_of_the_catalogue_whichever_is_named_first() {
    let file = RobotFile::parse(truth(4), Path::new("robot.toml"), &known_effects()).expect("a sound example");
    let with = |pair: [EffectKind; 2]| {
        let mut model = Model::<4>::nominal(&file, 12.0);
        for effect in pair {
            model.add_effect(EffectInstance::typical(effect.card(), usual_placement(effect.card())));
        }
        model
    };
    for seam in Seam::ALL {
        for [a, b] in pairs(seam) {
            let model = with([a, b]);
            assert_eq!(model.effects, with([b, a]).effects);
            let seated = model.plant().effects().iter().map(|active| active.effect.card().id).collect::<Vec<_>>();
            assert_eq!(seated, [a.id(), b.id()]);
        }
    }
}

#[test]
fn a_pair_at_one_seam_leaves_everything_finite() {
    for seam in Seam::ALL {
        for [a, b] in pairs(seam) {
            let mut effects = Effects::default();
            for effect in [a, b] {
                effects.add(effect, usual_placement(effect.card()), &typical(effect.card())).expect("room for two");
            }
            let plant: Plant<4, f64> = Plant::new(four(), effects);
            assert!(stays_finite(plant, 9), "{} and {}", a.id(), b.id());
        }
    }
}

/// An effect with what it remembers.
type Asked = (Effect<f64>, Vec<EffectState<f64>>);

/// True if two hooks leave more than rounding between their two orders, in any of 50 random descriptions.
fn parts<D: Described>(hook: impl Fn(&Asked, &EffectContext<f64>, &mut D), [a, b]: [&Asked; 2]) -> bool {
    let mut rng = SeededRng::new(5);
    (0..50).any(|_| {
        let at = EffectContext { time: NOW, ..at(&mut rng) };
        let mut one = D::random(&mut rng);
        let mut other = one.clone();
        hook(a, &at, &mut one);
        hook(b, &at, &mut one);
        hook(b, &at, &mut other);
        hook(a, &at, &mut other);
        let apart = |(x, y): (f64, f64)| (x - y).abs() > 1e-9 * (x.abs() + y.abs());
        one.numbers().into_iter().zip(other.numbers()).any(apart)
    })
}

fn commutes(seam: Seam, pair: [EffectKind; 2]) -> bool {
    let [a, b] = pair.map(|effect| {
        let effect = effect.with(&typical(effect.card())).expect("as many as on the card");
        let s = remembered(&effect, &mut SeededRng::new(3));
        (effect, s)
    });
    let pair = [&a, &b];
    !match seam {
        Seam::Command => parts::<Command<f64>>(|(e, s), _, x| e.command(&mut s.clone(), LOST, x), pair),
        Seam::SpeedDrive => parts::<SpeedDrive<f64>>(|(e, s), at, x| e.speed_drive(s, at, x), pair),
        Seam::Supply => parts::<Supply<f64>>(|(e, s), at, x| e.supply(s, at, x), pair),
        Seam::Bridge => parts::<Bridge<f64>>(|(e, s), at, x| e.bridge(s, at, x), pair),
        Seam::Winding => parts::<Winding<f64>>(|(e, s), at, x| e.winding(s, at, x), pair),
        Seam::Shaft => parts::<Shaft<f64>>(|(e, s), at, x| e.shaft(s, at, x), pair),
        Seam::Gear => parts::<Gear<f64>>(|(e, s), at, x| e.gear(s, at, x), pair),
        Seam::Contact => parts::<Contact<f64>>(|(e, s), at, x| e.contact(s, at, x), pair),
        Seam::Body => parts::<Body<f64>>(|(e, s), at, x| e.body(s, at, x), pair),
        Seam::Sense => parts::<Sense<f64>>(|(e, s), at, x| e.sense(s, at, x), pair),
    }
}

#[test]
fn pairs_whose_order_matters_are_those_of_the_page() {
    let mut page = String::from("# Pairs of effects whose order matters\n\n");
    page += "Effects at one seam are asked in the order of the catalogue, which is that of the signal, whatever the order in\n";
    page += "which a robot file or a diagnosis names them. Most pairs would do the same in the other order. Of those that would not,\n";
    page += "the first is asked first. `host-tests/tests/proof/pairs.rs` makes this page.\n";
    for seam in Seam::ALL {
        let all = pairs(seam);
        let matter: Vec<_> = all.iter().filter(|pair| !commutes(seam, **pair)).collect();
        let _ = writeln!(page, "\n## {seam:?}: {} of {} pairs\n", matter.len(), all.len());
        for [first, second] in matter {
            let _ = writeln!(page, "- `{}`, then `{}`", first.id(), second.id());
        }
    }
    golden::holds("pairs.md", &page);
}
