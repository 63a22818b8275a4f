//! The angles as a picture: a row a cause, a column a rival, the darker the nearer.

use std::fmt::Write;

use omni_gap::api::Confusion;

use super::page::{LEAST_SIGMA, written};

/// Side of a cell, room for the names to the left and above, room for the key below (px).
const CELL: usize = 11;
const LEFT: usize = 190;
const ABOVE: usize = 150;
const BELOW: usize = 44;
const RIGHT: usize = 12;

/// Up to which angle [°] a cell has which colour; beyond the last it has none.
const COLOURS: [(f64, &str); 5] =
    [(2.0, "#4a0010"), (5.0, "#a50f15"), (15.0, "#ef3b2c"), (30.0, "#fc9272"), (60.0, "#fde0d2")];
/// The cause itself, and a row of a cause that is not seen.
const OWN: &str = "#9a9a9a";
const UNSEEN: &str = "#eeeeee";

/// The whole picture, as SVG.
pub fn picture(title: &str, confusion: &Confusion) -> String {
    let causes = &confusion.causes;
    let mut ids: Vec<&str> = causes.iter().map(|cause| cause.cause).collect();
    ids.dedup();
    let (width, height) = (CELL * ids.len(), CELL * causes.len());
    let (whole, tall) = (LEFT + width + RIGHT, ABOVE + height + BELOW);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {whole} {tall}\" width=\"{whole}\" height=\"{tall}\" \
         font-family=\"sans-serif\" font-size=\"9\">\n<title>{title}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let _ = writeln!(svg, "<text x=\"8\" y=\"18\" font-size=\"13\">{title}</text>");
    let _ = writeln!(svg, "<text x=\"8\" y=\"34\">row: the hidden cause; column: what</text>");
    let _ = writeln!(svg, "<text x=\"8\" y=\"46\">it would be taken for</text>");
    names(&mut svg, confusion, &ids);
    let _ = writeln!(svg, "<g transform=\"translate({LEFT} {ABOVE}) scale({CELL})\">");
    let mut rest: Vec<(&str, String)> = COLOURS.iter().map(|(_, colour)| (*colour, String::new())).collect();
    let (mut own, mut unseen) = (String::new(), String::new());
    for (row, cause) in causes.iter().enumerate() {
        if !cause.seen {
            let _ = write!(unseen, "M0 {row}h{}v1H0z", ids.len());
        }
        for (column, id) in ids.iter().enumerate() {
            let cell = format!("M{column} {row}h1v1h-1z");
            let other = cause.others.iter().find(|other| cause.sigma >= LEAST_SIGMA && other.cause == *id);
            match other.map(|other| other.angle_rad.to_degrees()) {
                _ if *id == cause.cause => own += &cell,
                Some(angle) => {
                    if let Some(k) = COLOURS.iter().position(|(to, _)| angle < *to) {
                        rest[k].1 += &cell;
                    }
                }
                None => {}
            }
        }
    }
    for (colour, cells) in [(UNSEEN, unseen), (OWN, own)].into_iter().chain(rest) {
        let _ = writeln!(svg, "<path fill=\"{colour}\" d=\"{cells}\"/>");
    }
    let lines: String = (0..=causes.len())
        .map(|row| format!("M0 {row}h{}", ids.len()))
        .chain((0..=ids.len()).map(|column| format!("M{column} 0v{}", causes.len())))
        .collect();
    let _ = writeln!(svg, "<path stroke=\"#ccc\" stroke-width=\".05\" fill=\"none\" d=\"{lines}\"/>\n</g>");
    key(&mut svg, ABOVE + height + 18);
    svg + "</svg>\n"
}

fn names(svg: &mut String, confusion: &Confusion, ids: &[&str]) {
    for (row, cause) in confusion.causes.iter().enumerate() {
        let colour = if cause.seen { "#000" } else { "#999" };
        let name = written(cause).replace('`', "");
        let (x, y) = (LEFT - 5, ABOVE + CELL * row + 9);
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" fill=\"{colour}\">{name}</text>");
    }
    for (column, id) in ids.iter().enumerate() {
        let (x, y) = (LEFT + CELL * column + 9, ABOVE - 5);
        let _ = writeln!(svg, "<text transform=\"translate({x} {y}) rotate(-90)\">{id}</text>");
    }
}

fn key(svg: &mut String, y: usize) {
    let below = |(to, colour): &(f64, &'static str)| (*colour, format!("below {to}°"));
    let others = [(UNSEEN, "not seen at its typical size".to_owned()), (OWN, "itself".to_owned())];
    let mut x = LEFT;
    for (colour, what) in COLOURS.iter().map(below).chain(others) {
        let _ = writeln!(svg, "<rect x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\" fill=\"{colour}\"/>");
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">{what}</text>", x + CELL + 4, y + 9);
        x += CELL + 28 + 5 * what.chars().count();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use omni_gap::engine::findings::{ConfusedCause, Rival};
    use omni_gap::report::Kind;

    #[test]
    fn a_cell_has_the_colour_of_its_angle() {
        let cause = |cause: &'static str, rival: &'static str, degrees: f64| ConfusedCause {
            cause,
            kind: Kind::Effect,
            wheel: None,
            axis: None,
            sigma: 9.0,
            seen: true,
            others: vec![Rival { cause: rival, axis: None, angle_rad: degrees.to_radians(), told_times: None }],
        };
        let causes = vec![cause("a", "b", 4.0), cause("b", "a", 61.0)];
        let svg = picture("t", &Confusion { robot: String::new(), logged: Vec::new(), numbers: 1, causes });
        assert!(svg.contains("fill=\"#a50f15\" d=\"M1 0h1v1h-1z\""), "{svg}");
        assert!(svg.contains(&format!("fill=\"{OWN}\" d=\"M0 0h1v1h-1zM1 1h1v1h-1z\"")), "{svg}");
        assert_eq!(svg.matches("M0 1h1v1h-1z").count(), 0, "{svg}");
    }
}
