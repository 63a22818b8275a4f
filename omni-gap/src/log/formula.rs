//! # A number made of several columns of a row
//!
//! `duty * vbat`, `atan2(2*(qw*qz + qx*qy), 1 - 2*(qy^2 + qz^2))`: numbers, `+ - * / ^`, the usual functions, `PI`, and columns
//! by their names; a name that is no plain word stands in braces, `{duty [%]} / 100`. Read by the library `exmex`.

use super::channel::{Channel, Missing};
use exmex::{Express, FlatEx};

/// A formula that was read.
#[derive(Debug, Clone)]
pub(crate) struct Formula {
    text: String,
    read: FlatEx<f64>,
}

impl PartialEq for Formula {
    fn eq(&self, other: &Formula) -> bool {
        self.text == other.text
    }
}

impl Formula {
    /// Reads a formula; the error says why it is none.
    pub fn parse(text: &str) -> Result<Formula, String> {
        let read = exmex::parse::<f64>(text).map_err(|reason| reason.to_string())?;
        match read.var_names().is_empty() {
            true => Err("no column is named in it".into()),
            false => Ok(Formula { text: text.to_owned(), read }),
        }
    }

    /// The columns that it is made of.
    pub fn names(&self) -> &[String] {
        self.read.var_names()
    }

    /// Its value on each row of these columns, in the order of its names; a hole where one of them has one, and where the
    /// value is no number.
    pub fn of(&self, columns: &[Channel]) -> Channel {
        let rows = columns.iter().map(Channel::len).min().unwrap_or(0);
        let value = |row: usize| {
            let values = columns.iter().map(|column| column.get(row)).collect::<Result<Vec<f64>, Missing>>()?;
            self.read.eval(&values).map_err(|_| Missing::Lost)
        };
        (0..rows).map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_computed_and_a_hole_stays_one() {
        let formula = Formula::parse("{duty [%]} / 100 * vbat").unwrap();
        assert_eq!(formula.names(), ["duty [%]", "vbat"]);
        let mut vbat = Channel::from_values([12.0, 11.0]);
        vbat.push_missing(Missing::Blank);
        let made = formula.of(&[Channel::from_values([50.0, -100.0, 10.0]), vbat]);
        assert_eq!(made.iter().collect::<Vec<_>>(), [Ok(6.0), Ok(-11.0), Err(Missing::Blank)]);
    }

    #[test]
    fn a_quaternion_becomes_a_heading() {
        let formula = Formula::parse("atan2(2*(qw*qz + qx*qy), 1 - 2*(qy^2 + qz^2))").unwrap();
        assert_eq!(formula.names(), ["qw", "qx", "qy", "qz"]);
        let half: f64 = 0.7;
        let columns = [half.cos(), 0.0, 0.0, half.sin()].map(|value| Channel::from_values([value]));
        assert!((formula.of(&columns).get(0).unwrap() - 1.4).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_formula_is_told() {
        for text in ["duty *", "(a", "3.5", ""] {
            assert!(Formula::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_a_hole() {
        let formula = Formula::parse("a / b").unwrap();
        let made = formula.of(&[Channel::from_values([1.0]), Channel::from_values([0.0])]);
        assert_eq!(made.get(0), Err(Missing::Lost));
    }
}
