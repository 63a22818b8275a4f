//! # Excerpt: rows that stand for recordings that are too long to be weighed whole
//!
//! A long recording says the same again and again. It is cut into pieces, and pieces are taken one after the other, each the
//! one that adds most to the situations that were met so far ([`choose`]). A situation ([`situations`]) is a level of a signal,
//! how fast it changes, or a part of the time. By the same choice the first of many runs are those that meet most.

mod choose;
mod looked;
mod piece;
mod situations;

use std::borrow::Cow;

use super::knobs::ExcerptKnobs;
use crate::log::Run;
use crate::simulate::AlignedRun;
use piece::{Piece, cut};
use situations::Situations;

/// The runs, or pieces that stand for them where they have more than `most_rows` rows; then a sentence says what was left out.
pub(super) fn excerpt<'a>(runs: &'a [Run], most_rows: usize, knobs: &ExcerptKnobs) -> (Cow<'a, [Run]>, Option<String>) {
    let rows: usize = runs.iter().map(Run::rows).sum();
    if rows <= most_rows {
        return (Cow::Borrowed(runs), None);
    }
    let pieces = cut(runs, (most_rows / knobs.pieces).max(2));
    let situations = Situations::of(runs, knobs);
    let looks = situations.looks_of(&pieces);
    let lengths: Vec<usize> = pieces.iter().map(|piece| piece.rows.len()).collect();
    let mut taken = choose::choose(&looks, &lengths, most_rows);
    taken.sort_unstable();
    let from_the_start = choose::first(&lengths, most_rows);

    let met = |of: &[usize]| situations.met(of.iter().map(|piece| &*looks[*piece]));
    let all: Vec<usize> = (0..pieces.len()).collect();
    let told = format!(
        "{rows} rows are more than an answer needs: {} pieces of them, {} rows, stand for all. They meet {} of the {} situations \
         that the recordings meet (a level of a signal, how fast it changes, a part of the time); as many rows from the start \
         meet {}. What builds up over longer than a piece is not seen",
        taken.len(),
        taken.iter().map(|piece| lengths[*piece]).sum::<usize>(),
        met(&taken),
        met(&all),
        met(&from_the_start),
    );
    let part = |piece: &usize| {
        let Piece { run, rows } = &pieces[*piece];
        runs[*run].part(rows.clone())
    };
    (taken.iter().map(part).collect(), Some(told))
}

/// Many runs in the order in which they should be looked at: each the one that adds most to what those before it meet. Few are
/// looked at anyway.
pub(super) fn telling_first<const N: usize>(runs: Vec<AlignedRun<N>>, knobs: &ExcerptKnobs) -> Vec<AlignedRun<N>> {
    if runs.len() <= knobs.few_runs {
        return runs;
    }
    let whole = |(run, laid): (usize, &AlignedRun<N>)| Piece { run, rows: 0..laid.rows() };
    let pieces: Vec<Piece> = runs.iter().enumerate().map(whole).collect();
    let looks = Situations::of(&runs, knobs).looks_of(&pieces);
    let order = choose::choose(&looks, &vec![0; runs.len()], 0);
    let mut runs: Vec<Option<AlignedRun<N>>> = runs.into_iter().map(Some).collect();
    order.into_iter().filter_map(|run| runs[run].take()).collect()
}

#[cfg(test)]
mod tests;
