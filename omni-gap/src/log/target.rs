//! # The columns that a run log can have

use std::fmt;

/// One column of the contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Target {
    Time,
    U(usize),
    I(usize),
    W(usize),
    Wset(usize),
    X,
    Y,
    Theta,
    Vbat,
    Gyro,
    Enable,
}

/// What a column measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    Time,
    Voltage,
    Current,
    Rate,
    Length,
    Angle,
    Switch,
}

impl Target {
    /// The column of this name, if it is one of the contract's.
    pub fn named(name: &str) -> Option<Target> {
        match name {
            "t_s" => return Some(Target::Time),
            "x_m" => return Some(Target::X),
            "y_m" => return Some(Target::Y),
            "theta_rad" => return Some(Target::Theta),
            "vbat_V" => return Some(Target::Vbat),
            "gyro_rad_s" => return Some(Target::Gyro),
            "enable" => return Some(Target::Enable),
            _ => {}
        }
        let (stem, unit) = name.split_once('_')?;
        let digit = stem.find(|letter: char| letter.is_ascii_digit())?;
        let wheel: usize = stem[digit..].parse().ok()?;
        let target = match (&stem[..digit], unit) {
            ("u", "V") => Target::U(wheel),
            ("i", "A") => Target::I(wheel),
            ("w", "rad_s") => Target::W(wheel),
            ("wset", "rad_s") => Target::Wset(wheel),
            _ => return None,
        };
        Some(target)
    }

    /// The wheel it belongs to.
    pub fn wheel(self) -> Option<usize> {
        match self {
            Target::U(wheel) | Target::I(wheel) | Target::W(wheel) | Target::Wset(wheel) => Some(wheel),
            _ => None,
        }
    }

    /// What it measures.
    pub fn quantity(self) -> Quantity {
        match self {
            Target::Time => Quantity::Time,
            Target::U(_) | Target::Vbat => Quantity::Voltage,
            Target::I(_) => Quantity::Current,
            Target::W(_) | Target::Wset(_) | Target::Gyro => Quantity::Rate,
            Target::X | Target::Y => Quantity::Length,
            Target::Theta => Quantity::Angle,
            Target::Enable => Quantity::Switch,
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Target::Time => write!(f, "t_s"),
            Target::U(wheel) => write!(f, "u{wheel}_V"),
            Target::I(wheel) => write!(f, "i{wheel}_A"),
            Target::W(wheel) => write!(f, "w{wheel}_rad_s"),
            Target::Wset(wheel) => write!(f, "wset{wheel}_rad_s"),
            Target::X => write!(f, "x_m"),
            Target::Y => write!(f, "y_m"),
            Target::Theta => write!(f, "theta_rad"),
            Target::Vbat => write!(f, "vbat_V"),
            Target::Gyro => write!(f, "gyro_rad_s"),
            Target::Enable => write!(f, "enable"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_read_as_it_is_written() {
        let others = ["vbat_V", "gyro_rad_s", "enable"];
        for name in
            ["t_s", "u0_V", "i3_A", "w2_rad_s", "wset1_rad_s", "x_m", "y_m", "theta_rad"].into_iter().chain(others)
        {
            assert_eq!(Target::named(name).map(|t| t.to_string()).as_deref(), Some(name));
        }
        for name in ["u_V", "u0_mV", "time", "", "w0", "q0_V"] {
            assert_eq!(Target::named(name), None, "{name}");
        }
    }
}
