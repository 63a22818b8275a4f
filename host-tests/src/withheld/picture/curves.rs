//! Curves: what is stated against what comes true, and what is wrong among the surest.

use std::fmt::Write;

use super::super::figures::BINS;
use super::super::scored::Scored;
use super::super::selective::risks;
use super::words::{FITS, escaped};

/// Room to the left of and below the square, and its side [px].
const LEFT: f64 = 44.0;
const TOP: f64 = 26.0;
const SIDE: f64 = 300.0;
const BELOW: f64 = 40.0;
const RIGHT: f64 = 26.0;

type Named = (String, Vec<Scored>);

/// Where a share of each axis stands [px].
fn at((x, y): (f64, f64)) -> (f64, f64) {
    (LEFT + SIDE * x, TOP + SIDE * (1.0 - y))
}

fn path(points: impl Iterator<Item = (f64, f64)>) -> String {
    points.enumerate().fold(String::new(), |mut path, (k, point)| {
        let (x, y) = at(point);
        write!(path, "{}{x:.1} {y:.1}", if k == 0 { "M" } else { "L" }).expect(FITS);
        path
    })
}

/// A square of shares with its grid, its title, and the names of its axes.
fn framed(title: &str, x: &str, y: &str, inside: &str) -> String {
    let (width, height) = (LEFT + SIDE + RIGHT, TOP + SIDE + BELOW);
    let mut svg = format!(
        "<svg class=\"curve\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">\n<title>{title}</title>\n\
         <text x=\"{LEFT}\" y=\"14\" font-weight=\"600\" font-size=\"12\">{title}</text>\n"
    );
    for k in 0..=4 {
        let part = f64::from(k) / 4.0;
        let ((across, _), (_, up)) = (at((part, 0.0)), at((0.0, part)));
        writeln!(svg, "<path class=\"grid\" d=\"M{across} {TOP}v{SIDE}M{LEFT} {up}h{SIDE}\"/>").expect(FITS);
        let below = TOP + SIDE + 15.0;
        let percent = 25 * k;
        writeln!(svg, "<text class=\"soft\" x=\"{across}\" y=\"{below}\" text-anchor=\"middle\">{percent} %</text>")
            .expect(FITS);
        let (beside, middle) = (LEFT - 6.0, up + 4.0);
        writeln!(svg, "<text class=\"soft\" x=\"{beside}\" y=\"{middle}\" text-anchor=\"end\">{percent} %</text>")
            .expect(FITS);
    }
    let (middle, bottom) = (LEFT + SIDE / 2.0, height - 8.0);
    writeln!(svg, "<text x=\"{middle}\" y=\"{bottom}\" text-anchor=\"middle\">{x}</text>").expect(FITS);
    let inner = LEFT + 8.0;
    writeln!(svg, "<text class=\"soft\" x=\"{inner}\" y=\"{}\">↑ {y}</text>", TOP + 14.0).expect(FITS);
    svg + inside + "</svg>\n"
}

/// Bins that state the same, to within this, are one point [1].
const SAME: f64 = 0.01;

/// What was held most likely in bins of equal numbers, how often that came true [1], and of how many.
fn bins(all: &[Scored]) -> Vec<(f64, f64, usize)> {
    let mut stated: Vec<(f64, bool)> = all.iter().filter_map(Scored::stated).collect();
    stated.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut bins: Vec<(f64, f64, usize)> = Vec::new();
    for bin in stated.chunks(stated.len().div_ceil(BINS).max(1)) {
        let (hoped, came): (f64, usize) =
            bin.iter().fold((0.0, 0), |(hoped, came), (p, so)| (hoped + p, came + usize::from(*so)));
        let now = (hoped / bin.len() as f64, came as f64 / bin.len() as f64, bin.len());
        match bins.last_mut() {
            Some(last) if now.0 - last.0 < SAME => {
                let (was, more) = (last.2 as f64, now.2 as f64);
                let mean = |a: f64, b: f64| (a * was + b * more) / (was + more);
                *last = (mean(last.0, now.0), mean(last.1, now.1), last.2 + now.2);
            }
            _ => bins.push(now),
        }
    }
    bins
}

/// What each holds most likely, in bins of equal numbers, against how often that came true.
pub fn reliability(contestants: &[Named]) -> String {
    let mut inside = format!("<path class=\"ideal\" d=\"{}\"/>\n", path([(0.0, 0.0), (1.0, 1.0)].into_iter()));
    // the first on top
    for (k, (name, all)) in contestants.iter().enumerate().rev() {
        let bins = bins(all);
        let line = path(bins.iter().map(|(p, came, _)| (*p, *came)));
        writeln!(inside, "<path class=\"line l{k}\" d=\"{line}\"/>").expect(FITS);
        for (p, came, count) in bins.iter().filter(|_| k == 0) {
            let (x, y) = at((*p, *came));
            let told = format!("held for {:.0} % likely, {:.0} % came true, of {count}", 100.0 * p, 100.0 * came);
            let name = escaped(name);
            writeln!(
                inside,
                "<circle class=\"dot l{k}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"><title>{name}: {told}</title></circle>"
            )
            .expect(FITS);
        }
    }
    framed("Reliability", "held for so likely", "came true so often", &inside)
}

/// What is wrong among the surest answers, from the surest alone to all.
pub fn risk(contestants: &[Named]) -> String {
    let mut inside = String::new();
    for (k, (name, all)) in contestants.iter().enumerate().rev() {
        let sure: Vec<(f64, bool)> = all.iter().map(Scored::sure).collect();
        let risks = risks(&sure);
        let count = risks.len() as f64;
        let line = path(risks.iter().enumerate().map(|(at, risk)| ((at + 1) as f64 / count, *risk)));
        let last = 100.0 * risks.last().copied().unwrap_or(0.0);
        let name = escaped(name);
        writeln!(
            inside,
            "<path class=\"line l{k}\" d=\"{line}\"><title>{name}: of all answers {last:.0} % are wrong</title></path>"
        )
        .expect(FITS);
    }
    framed("Risk and coverage", "of all answers, the surest", "of these are wrong", &inside)
}
