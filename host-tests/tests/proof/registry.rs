//! The catalogue: what is in the folder is in the list, and the cards are sound.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use model_core::effects::active::MAX_EFFECTS;
use model_core::effects::card::{Card, MAX_PARAMS, Role, Scope, Seam};
use model_core::effects::{EffectKind, causes};
use model_core::plant::robot::Nominal;

/// Units that parameters may have, and the suffix of a key that has it.
const UNITS: [(&str, &str); 30] = [
    ("1", ""),
    ("V", "_V"),
    ("A", "_A"),
    ("Ω", "_ohm"),
    ("H", "_H"),
    ("F", "_F"),
    ("s", "_s"),
    ("m", "_m"),
    ("rad", "_rad"),
    ("kg", "_kg"),
    ("N", "_N"),
    ("N·m", "_Nm"),
    ("Hz", "_Hz"),
    ("K", "_K"),
    ("1/K", "_per_K"),
    ("m/s", "_m_s"),
    ("m/s²", "_m_s2"),
    ("rad/s", "_rad_s"),
    ("kg·m²", "_kg_m2"),
    ("(m/s)/N", "_m_s_per_N"),
    ("1/(m/s)", ""),
    ("N·m·s", "_Nms"),
    ("N·s/m", "_N_s_per_m"),
    ("N·m/rad", "_Nm_per_rad"),
    ("rad/(N·m)", "_rad_per_Nm"),
    ("V/A", "_V_per_A"),
    ("1/m", "_per_m"),
    ("N·s²/m²", "_N_s2_per_m2"),
    ("K/W", "_K_per_W"),
    ("1/A²", "_per_A2"),
];

/// Most numbers that an effect may remember for one wheel: twelve effects on four wheels still fit in 48 kB of f32.
const MOST_MEMORY: usize = 256;

fn cards() -> Vec<&'static Card> {
    EffectKind::ALL.iter().map(|effect| effect.card()).collect()
}

fn effects_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../model-core/src/effects")
}

/// (folder, name) of every effect's file.
fn files() -> BTreeSet<(String, String)> {
    let mut found = BTreeSet::new();
    for folder in fs::read_dir(effects_folder()).expect("the folder of effects").flatten() {
        // the numbers of a robot file have cards, not effects
        if !folder.path().is_dir() || folder.file_name() == "nominal" {
            continue;
        }
        for file in fs::read_dir(folder.path()).expect("a stage's folder").flatten() {
            let name = file.file_name().to_string_lossy().into_owned();
            if let Some(name) = name.strip_suffix(".rs").filter(|name| *name != "mod") {
                found.insert((folder.file_name().to_string_lossy().into_owned(), name.to_string()));
            }
        }
    }
    found
}

#[test]
fn every_file_is_in_the_catalogue_and_every_entry_has_its_file() {
    let listed: BTreeSet<_> =
        cards().iter().map(|card| (card.stage().name().to_string(), card.id.to_string())).collect();
    assert_eq!(files(), listed, "files (folder = stage, name = id) against the catalogue");
}

#[test]
fn ids_are_unique_and_found() {
    let ids: BTreeSet<_> = cards().iter().map(|card| card.id).collect();
    assert_eq!(ids.len(), cards().len());
    for id in ids {
        assert!(id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_'), "{id}");
        assert_eq!(EffectKind::find(id).map(EffectKind::id), Some(id));
        assert_eq!(causes().filter(|cause| cause.id() == id).count(), 1, "{id} is a nominal parameter's name");
    }
    assert!(EffectKind::find("no_such_effect").is_none());
}

#[test]
fn an_effects_fields_are_its_cards_parameters_in_order() {
    for kind in EffectKind::ALL {
        let card = kind.card();
        let values: Vec<f64> = (1..=card.params.len()).map(|k| k as f64).collect();
        let effect = kind.with(&values).expect("as many as on the card");
        assert_eq!(effect.kind(), kind);
        // as Rust writes a struct: Name(Name { field: value, … })
        let written = format!("{effect:?}");
        let fields = written.split(['{', ',']).skip(1).map(|field| field.trim().trim_end_matches([' ', '}', ')']));
        let fields: Vec<(&str, &str)> = fields.filter_map(|field| field.split_once(": ")).collect();
        assert_eq!(fields.len(), card.params.len(), "{written}");
        for ((name, value), (p, k)) in fields.into_iter().zip(card.params.iter().zip(values)) {
            assert!(p.key.starts_with(name), "{}: field `{name}` stands where the card has `{}`", card.id, p.key);
            assert_eq!(value.parse(), Ok(k), "{}: {written}", card.id);
        }
        assert!(kind.with(&vec![0.0; card.params.len() + 1]).is_none() && kind.with::<f64>(&[]).is_none());
    }
}

#[test]
fn a_state_shows_all_its_numbers_and_starts_at_zero() {
    use model_core::effects::{EffectSet, Numbers};
    for kind in EffectKind::ALL {
        let params: Vec<f64> = crate::fixture::typical(kind.card());
        let Some(mut state) = kind.with(&params).expect("as many as on the card").start() else { continue };
        let (mut count, mut sum) = (0, 0.0);
        state.for_each_mut(|x| (count, sum) = (count + 1, sum + x.abs()));
        assert!((1..=MOST_MEMORY).contains(&count) && sum == 0.0, "{}: {count} numbers", kind.id());
    }
}

#[test]
fn bounds_hold_what_is_absent_and_what_is_typical() {
    for card in cards() {
        for p in card.params {
            let (low, high) = p.within;
            let what = format!("{}.{}", card.id, p.key);
            assert!(low < high && low.is_finite() && high.is_finite(), "{what}: {low} … {high}");
            assert!((low..=high).contains(&p.absent), "{what}: absent at {}", p.absent);
            assert!((low..=high).contains(&p.typical), "{what}: typical at {}", p.typical);
            if p.role == Role::Size {
                assert!(p.absent != p.typical, "{what} sizes the effect and is absent where it is typical");
            }
        }
        let sizes = card.params.iter().any(|p| p.role == Role::Size);
        let absent_somewhere = card.params.iter().any(|p| p.absent != p.typical);
        assert!(sizes || absent_somewhere, "{} is never absent", card.id);
    }
}

#[test]
fn keys_say_their_units() {
    for card in cards() {
        let keys: BTreeSet<_> = card.params.iter().map(|p| p.key).collect();
        assert_eq!(keys.len(), card.params.len(), "{}: a key twice", card.id);
        for p in card.params {
            let what = format!("{}.{} in {}", card.id, p.key, p.unit);
            let (_, suffix) = *UNITS
                .iter()
                .find(|(unit, _)| *unit == p.unit)
                .unwrap_or_else(|| panic!("{what}: the unit is not in the list"));
            assert!(p.key.ends_with(suffix) && p.key.len() > suffix.len(), "{what}: the key should end in {suffix}");
            // the longest suffix that fits is the unit that the key speaks of
            let said =
                UNITS.iter().filter(|(_, s)| p.key.ends_with(s)).max_by_key(|(_, s)| s.len()).expect("at least none");
            assert!(
                said.1.len() <= suffix.len() || suffix.is_empty() && !p.key.contains(char::is_uppercase),
                "{what}: the key speaks of {}",
                said.0
            );
            let start = p.key.strip_suffix(suffix).unwrap_or(p.key);
            assert!(
                start.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_'),
                "{what}: snake case"
            );
        }
    }
}

#[test]
fn cards_say_all_that_a_person_asks() {
    for card in cards() {
        let texts = [card.title, card.summary, card.equation, card.source, card.signature];
        assert!(texts.iter().all(|text| !text.trim().is_empty()), "{}: something is left blank", card.id);
        assert!(
            card.summary.ends_with('.') && !card.title.ends_with('.'),
            "{}: summary a sentence, title none",
            card.id
        );
        for p in card.params {
            assert!(!p.symbol.is_empty(), "{}.{}", card.id, p.key);
        }
    }
}

#[test]
fn cards_say_how_an_effect_is_undone_or_why_not_and_what_physics_says_of_it() {
    for card in cards() {
        let words = card.undone.words();
        assert!(words.len() > 10 && !words.ends_with('.'), "{}: {words}", card.id);
        let physics = card.physics;
        let known = |k: usize| card.params.get(k).unwrap_or_else(|| panic!("{} has no parameter {k}", card.id));
        assert!(physics.inertia.is_none_or(|k| known(k).unit == "kg·m²"), "{}: an inertia", card.id);
        assert!(physics.direction.is_none_or(|k| known(k).unit == "rad"), "{}: a direction", card.id);
        let places = physics.place.iter().chain(&physics.world_place).flatten();
        assert!(places.into_iter().all(|k| known(*k).unit == "m"), "{}: a place", card.id);
        for p in physics.mirrored.iter().map(|k| known(*k)) {
            assert_eq!(p.within.0, -p.within.1, "{}.{}: what a mirror turns round has both signs", card.id, p.key);
        }
        assert!((1e-12..1e-2).contains(&physics.apart), "{}: {:e} apart", card.id, physics.apart);
    }
}

#[test]
fn equations_name_the_symbols_that_size_them() {
    for card in cards() {
        for p in card.params.iter().filter(|p| p.role == Role::Size) {
            assert!(card.equation.contains(p.symbol), "{}: {} is not in {}", card.id, p.symbol, card.equation);
        }
    }
}

#[test]
fn look_alikes_are_mutual_and_settled_alike() {
    let causes: BTreeSet<_> = Nominal::ALL.iter().map(|nominal| nominal.cause()).collect();
    for card in cards() {
        let mut seen = BTreeSet::new();
        for like in card.look_alikes {
            assert!(like.with != card.id && seen.insert(like.with), "{} names {} twice", card.id, like.with);
            assert!(like.settled_by.len() > 20, "{} and {}: say how to tell them apart", card.id, like.with);
            if causes.contains(like.with) {
                continue;
            }
            let other = EffectKind::find(like.with)
                .unwrap_or_else(|| panic!("{} names {}: no such effect", card.id, like.with));
            let back = other.card().look_alikes.iter().find(|back| back.with == card.id);
            let back = back.unwrap_or_else(|| panic!("{} names {}, not the other way round", card.id, like.with));
            assert_eq!(back.settled_by, like.settled_by, "{} and {} are settled in two ways", card.id, like.with);
        }
    }
}

#[test]
fn parameters_and_memory_keep_their_limits() {
    for card in cards() {
        assert!((1..=MAX_PARAMS).contains(&card.params.len()), "{}: {} parameters", card.id, card.params.len());
    }
    const { assert!(MAX_EFFECTS <= 32, "a set of effects is kept as 32 bits") }
}

#[test]
fn seams_stand_in_signal_order() {
    for card in cards() {
        assert!(!card.seams.is_empty(), "{} acts nowhere", card.id);
        assert!(card.seams.windows(2).all(|pair| pair[0] < pair[1]), "{}: {:?}", card.id, card.seams);
    }
    let homes: Vec<_> = cards().iter().map(|card| card.seams[0].stage()).collect();
    assert!(homes.is_sorted(), "the catalogue goes along the signal path: {homes:?}");
}

#[test]
fn an_effect_of_the_body_or_the_battery_sits_on_the_robot() {
    for card in cards() {
        if card.seams.iter().all(|seam| [Seam::Supply, Seam::Body].contains(seam)) {
            assert_eq!(card.scope, Scope::Robot, "{}: there is one body and one battery", card.id);
        }
        if card.seams[0] == Seam::Gear {
            assert_ne!(card.scope, Scope::Robot, "{}: gears sit on wheels", card.id);
        }
    }
}

#[test]
fn a_set_of_effects_refuses_seats_that_the_card_does_not_allow() {
    use model_core::effects::active::{EffectError, Effects};
    for effect in &EffectKind::ALL {
        let card = effect.card();
        let params = crate::fixture::typical(card);
        let mut set = Effects::<3, f64>::default();
        let allowed = crate::fixture::placements(card, 3);
        for placement in [None, Some(0), Some(2), Some(3)] {
            let refused = set.add(*effect, placement, &params).err();
            assert_eq!(
                refused,
                (!allowed.contains(&placement)).then_some(EffectError::Wheel),
                "{} on {placement:?}",
                card.id
            );
        }
        assert_eq!(set.add(*effect, allowed[0], &[]), Err(EffectError::Parameters));
        for _ in set.iter().count()..MAX_EFFECTS {
            set.add(*effect, allowed[0], &params).expect("room");
        }
        assert_eq!(set.add(*effect, allowed[0], &params), Err(EffectError::Full));
        assert_eq!(set.iter().count(), MAX_EFFECTS);
    }
}
