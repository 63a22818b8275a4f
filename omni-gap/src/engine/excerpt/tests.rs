use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::choose::choose;
use super::*;
use crate::log::{Channel, Group};

/// A run at 100 rows a second whose wheel stands still, but for what `moves` says of each row.
fn standing(rows: usize, moves: impl Fn(usize) -> f64) -> Run {
    let wheel = Channel::from_values((0..rows).map(moves));
    let still = Channel::from_values(vec![0.0; rows]);
    Run {
        name: "drive".into(),
        t_s: (0..rows).map(|row| 0.01 * row as f64).collect(),
        w: Some(Group::new(vec![wheel, still.clone(), still])),
        first_line: Some(2),
        ..Run::default()
    }
}

#[test]
fn what_is_short_enough_is_left_as_it_is() {
    let runs = [standing(10_000, |_| 0.0)];
    let (same, told) = excerpt(&runs, 10_000, &ExcerptKnobs::default());
    assert!(matches!(same, Cow::Borrowed(_)) && told.is_none());
}

#[test]
fn what_the_robot_does_once_is_among_the_pieces() {
    // two seconds of driving, 70 s after the start
    let runs = [standing(10_000, |row| if (7_000..7_200).contains(&row) { 20.0 } else { 0.0 })];
    let knobs = ExcerptKnobs { pieces: 5, ..ExcerptKnobs::default() };
    let (pieces, told) = excerpt(&runs, 1_000, &knobs);
    assert_eq!(pieces.iter().map(Run::rows).sum::<usize>(), 1_000);
    let moving: usize =
        pieces.iter().map(|run| run.w.as_ref().unwrap().channels[0].present().filter(|(_, w)| *w > 0.0).count()).sum();
    assert_eq!(moving, 200);
    let driving = pieces.iter().find(|run| run.name == "drive from 70.0 s").expect("that piece");
    assert_eq!((driving.t_s[0], driving.first_line), (70.0, Some(7_002)));
    assert!(pieces.is_sorted_by(|a, b| a.t_s[0] < b.t_s[0]));
    let told = told.expect("a sentence");
    assert!(
        told.starts_with("10000 rows are more than an answer needs: 5 pieces of them, 1000 rows, stand for all"),
        "{told}"
    );
}

#[test]
fn a_heading_counts_within_its_turn() {
    let spin = Channel::from_values((0..10_000).map(|row| 0.02 * row as f64));
    let still = Channel::from_values(vec![0.0; 10_000]);
    let run = Run { pose: Some(Group::new(vec![still.clone(), still, spin])), ..standing(10_000, |_| 0.0) };
    let knobs = ExcerptKnobs { pieces: 2, ..ExcerptKnobs::default() };
    let runs = [run];
    let situations = Situations::of(&runs, &knobs);
    // each of the eight levels in any one turn of 3.14 s
    let looks = situations.looks(&Piece { run: 0, rows: 5_000..5_400 });
    let headings = looks.chunks(knobs.levels + 2).nth(2 * 5).expect("the last signal's levels");
    assert!(headings[1..=knobs.levels].iter().all(|n| *n >= 5), "{headings:?}");
}

#[test]
fn the_choice_reaches_what_is_promised_of_the_best_one() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for _ in 0..50 {
        let looks: Vec<Vec<u32>> = (0..8)
            .map(|_| (0..12).map(|_| if random.random_bool(0.3) { random.random_range(1..200) } else { 0 }).collect())
            .collect();
        let worth = |pieces: &[usize]| -> f64 {
            (0..12).map(|b| f64::from(pieces.iter().map(|piece| looks[*piece][b]).sum::<u32>()).sqrt()).sum()
        };
        let threes = (0..8).flat_map(|a| (0..a).flat_map(move |b| (0..b).map(move |c| [a, b, c])));
        let best = threes.map(|three| worth(&three)).fold(0.0, f64::max);
        let taken = choose(&looks, &[10; 8], 39);
        assert_eq!(taken.len(), 3);
        assert!(worth(&taken) >= (1.0 - (-1.0_f64).exp()) * best);
    }
}
