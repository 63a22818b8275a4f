//! Names of causes, as a command line has them.

use model_core::effects::EffectKind;
use model_core::effects::card::Card;
use model_core::effects::nominal::NOMINAL;
use omni_gap::log::nearest;

use super::cli_error::CliError;

/// The cards of all effects.
pub fn cards() -> impl Iterator<Item = &'static Card> {
    EffectKind::ALL.iter().map(|effect| effect.card())
}

/// The ids of all causes, effects and parameters.
fn ids() -> impl Iterator<Item = &'static str> {
    cards().map(|card| card.id).chain(NOMINAL.iter().map(|parameter| parameter.id))
}

/// Refuses what is no cause.
///
/// # Errors
/// The first name that is none, and which one may be meant.
pub fn all_known(names: &[String]) -> Result<(), CliError> {
    names.iter().find(|name| !ids().any(|id| id == name.as_str())).map_or(Ok(()), |name| Err(unknown(name, [])))
}

/// A name that is no cause's, and none of what else could have been meant.
pub fn unknown(name: &str, others: impl IntoIterator<Item = &'static str>) -> CliError {
    let fix = match nearest(name, ids().chain(others)) {
        Some(near) => format!("Did you mean `{near}`?"),
        None => "`omni-gap explain` lists all names".to_owned(),
    };
    CliError::UnknownName { name: name.to_owned(), fix }
}
