//! How well recordings could tell the numbers of their robot file, for a person at a terminal.

use model_core::effects::nominal::{self, Table};

use super::number::{NBSP, percent};
use super::terminal::Page;
use crate::identify::{EffectProspect, Informativity, NumberProspect, Prospect};
use crate::log::Chain;
use crate::simulate::NominalKey;

/// A number that is stated to better than this is weighed or measured, and need not be told by recordings [1].
const ROUGH: f64 = 0.1;
/// Two numbers that correlate more than this are a pair [1]; else a number goes together with several.
const PAIR: f64 = 0.8;
/// Above this share of what is stated nothing was gained [1].
const NOTHING_GAINED: f64 = 0.99;

/// Whether it is of a wheel: what wheels that turn as they were told still tell.
fn is_geometry(number: &NumberProspect) -> bool {
    NominalKey::of(number.key).is_some_and(|key| key.table == Table::Wheel.name())
}

fn by_speeds(chain: Chain) -> bool {
    matches!(chain, Chain::WheelSpeed | Chain::SetSpeed)
}

fn no_forces(chain: Chain) -> String {
    format!(
        "{} drive the model here: what motors, masses and friction are is no matter then. To tell them, log the voltages of \
         all wheels",
        chain.said()
    )
}

/// A table of all numbers, then sentences on those that should be told and cannot.
pub fn informativity_terminal(told: &Informativity) -> String {
    let mut page = Page(
        "How well these recordings can tell the robot file's numbers at best (one sigma; noise as stated, nothing \
         missing\nin the model):\n"
            .into(),
    );
    table(&mut page.0, &told.numbers);
    let rough = |number: &&NumberProspect| number.stated_relative >= ROUGH;
    let of_forces = |number: &&NumberProspect| !is_geometry(number);
    let traceless = |number: &&NumberProspect| number.prospect == Prospect::NoTrace;
    if by_speeds(told.driven_by) && told.numbers.iter().filter(of_forces).all(|number| traceless(&number)) {
        page.line("no trace", &no_forces(told.driven_by));
    } else {
        let traceless: Vec<&NumberProspect> = told.numbers.iter().filter(rough).filter(traceless).collect();
        advices(&traceless).iter().for_each(|advice| page.line("no trace", advice));
    }
    for number in told.numbers.iter().filter(rough) {
        if let Some((other, correlation)) = number.beside.filter(|(_, correlation)| correlation.abs() > PAIR) {
            page.line("together", &together(number.key, other, correlation));
        }
    }
    for effect in told.effects.iter().filter(|effect| !effect.told) {
        page.line("no trace", &of_effect(effect));
    }
    page.0.replace(NBSP, " ")
}

fn table(page: &mut String, numbers: &[NumberProspect]) {
    let wide = numbers.iter().map(|number| number.key.len()).max().unwrap_or(0);
    page.push_str(&format!("{:wide$}  {:>7}  {:>7}\n", "", "stated", "at best"));
    for number in numbers {
        let stated = percent(number.stated_relative);
        let best = if number.relative_std > NOTHING_GAINED * number.stated_relative {
            stated.clone()
        } else {
            percent(number.relative_std)
        };
        let remark = match number.prospect {
            Prospect::NoTrace => "  no trace",
            // what is weighed or measured need not be told
            _ if number.stated_relative < ROUGH => "",
            Prospect::Told => "",
            Prospect::NoSurerThanStated => "  no surer than stated",
            Prospect::OnlyTogether => "  only together with others",
        };
        page.push_str(&format!("{:wide$}  {stated:>7}  {best:>7}{remark}\n", number.key));
    }
}

/// One sentence for all numbers of a kind, with how that kind is measured.
fn advices(traceless: &[&NumberProspect]) -> Vec<String> {
    let of_card = |card: &nominal::NominalCard| {
        let of_kind = |number: &&&NumberProspect| card.numbers.iter().any(|own| own.key == number.key);
        let keys: Vec<&str> = traceless.iter().filter(of_kind).map(|number| number.key).collect();
        let each = if keys.len() == 1 { "it" } else { "each" };
        let told = || {
            format!(
                "{}: {each} could be half or double, and these recordings would hardly differ. {}",
                keys.join(", "),
                card.measured_by,
            )
        };
        (!keys.is_empty()).then(told)
    };
    nominal::NOMINAL.into_iter().filter_map(of_card).collect()
}

fn together(key: &str, other: &str, correlation: f64) -> String {
    let how = if correlation > 0.0 { "grow together" } else { "make up for each other" };
    format!(
        "{key} and {other} {how} (correlation {correlation:.2}): measure one of them apart and state in [uncertainty] how well, \
         or log one more signal"
    )
    .replace('-', "−")
}

fn of_effect(effect: &EffectProspect) -> String {
    let wheel = effect.wheel.map_or(String::new(), |wheel| format!(" on wheel {}", wheel + 1));
    format!(
        "{} of {}{wheel}: all that is allowed of it moves what is predicted by less than the noise. `omni-gap explain {}` \
         says what shows it",
        effect.key, effect.effect, effect.effect
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(key: &'static str, stated: f64, best: f64, prospect: Prospect) -> NumberProspect {
        let beside = (prospect == Prospect::OnlyTogether).then_some(("resistance_ohm", -0.97));
        NumberProspect { key, stated_relative: stated, relative_std: best, prospect, beside }
    }

    #[test]
    fn what_should_be_told_and_cannot_is_said_with_what_to_do() {
        let numbers = vec![
            number("resistance_ohm", 0.1, 0.004, Prospect::Told),
            number("emf_constant_V_s", 0.1, 0.095, Prospect::OnlyTogether),
            number("mass_kg", 0.02, 0.02, Prospect::NoSurerThanStated),
            number("viscous_vn_N_s_per_m", 0.2, 0.2, Prospect::NoTrace),
            number("viscous_w_Nm_s", 0.2, 0.2, Prospect::NoTrace),
        ];
        let effects = vec![
            EffectProspect { effect: "supply_sag", wheel: None, key: "resistance_ohm", told: false },
            EffectProspect { effect: "wheel_friction", wheel: Some(1), key: "torque_Nm", told: true },
        ];
        let page = informativity_terminal(&Informativity { driven_by: Chain::Voltage, numbers, effects });
        for part in [
            "resistance_ohm           10 %    0.4 %\n",
            "viscous_vn_N_s_per_m     20 %     20 %  no trace\n",
            "viscous_vn_N_s_per_m, viscous_w_Nm_s: each could be half or double",
            "emf_constant_V_s and resistance_ohm make up for each other (correlation −0.97)",
            "resistance_ohm of supply_sag:",
        ] {
            assert!(page.contains(part), "{part}\n{page}");
        }
        let kinematic =
            vec![number("radius_m", 0.05, 0.001, Prospect::Told), number("mass_kg", 0.2, 0.2, Prospect::NoTrace)];
        let driven_by = Chain::SetSpeed;
        let by_speeds = informativity_terminal(&Informativity { driven_by, numbers: kinematic, effects: Vec::new() });
        assert!(by_speeds.contains("the commanded wheel speeds drive the model here"), "{by_speeds}");
        assert!(!page.contains("torque_Nm") && page.matches("together   ").count() == 1, "{page}");
        assert!(page.lines().all(|line| line.chars().count() <= 120), "{page}");
    }
}
