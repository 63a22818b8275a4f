//! Where an effect shows, as its card states it, in words.

use model_core::effects::card::Card;
use model_core::effects::shows::Order;

/// In which channels an effect shows, when, which way round, and how often in a turn of its wheel.
pub fn shown_in(card: &Card) -> String {
    let shows = &card.shows;
    let names: Vec<&str> = shows.channels.iter().map(|channel| channel.name()).collect();
    let channels = match names.as_slice() {
        [most, others @ ..] if !others.is_empty() => format!("{most} most, {} too", others.join(", ")),
        one => one.concat(),
    };
    let mut words = format!("{channels}; {}; {}", shows.regime.words(), shows.parity.words());
    let symbol = |param: usize| card.params.get(param).map_or("", |p| p.symbol);
    match shows.order {
        None => {}
        Some(Order::Fixed(1)) => words += "; once a turn of the wheel",
        Some(Order::Fixed(times)) => words += &format!("; {times} times a turn of the wheel"),
        Some(Order::OfWheel(param)) => words += &format!("; {} times a turn of the wheel", symbol(param)),
        Some(Order::OfRotor(param)) => {
            words +=
                &format!("; {} times a turn of the rotor: times the gear ratio in one of the wheel", symbol(param));
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::effects::EffectKind;

    fn words(id: &str) -> String {
        shown_in(EffectKind::find(id).unwrap().card())
    }

    #[test]
    fn one_channel_stands_alone_and_of_several_the_first_shows_most() {
        assert!(words("encoder_scale").starts_with("wheel speed; more, the faster"), "{}", words("encoder_scale"));
        assert!(words("supply_sag").starts_with("bus voltage most, current too;"), "{}", words("supply_sag"));
    }

    #[test]
    fn a_ripple_says_how_often_it_comes() {
        assert!(words("wheel_eccentricity").ends_with("once a turn of the wheel"));
        assert!(words("roller_ripple").ends_with("; n times a turn of the wheel"));
        assert!(words("cogging").ends_with("; N times a turn of the rotor: times the gear ratio in one of the wheel"));
    }
}
