//! Names of causes, as a command line has them.

use model_core::effects::EffectKind;
use model_core::effects::card::Card;
use omni_gap::cause_ids;
use omni_gap::log::nearest;

use super::cli_error::CliError;

/// The cards of all effects.
pub fn cards() -> impl Iterator<Item = &'static Card> {
    EffectKind::ALL.iter().map(|effect| effect.card())
}

/// Refuses what is no cause.
///
/// # Errors
/// The first name that is none, and which one may be meant.
pub fn all_known(names: &[String]) -> Result<(), CliError> {
    names.iter().find(|name| !cause_ids().any(|id| id == name.as_str())).map_or(Ok(()), |name| Err(unknown(name, [])))
}

/// A name that is no cause's, and none of what else could have been meant.
pub fn unknown(name: &str, others: impl IntoIterator<Item = &'static str>) -> CliError {
    let fix = match nearest(name, cause_ids().chain(others)) {
        Some(near) => format!("Did you mean `{near}`?"),
        None => "`omni-gap explain` lists all names".to_owned(),
    };
    CliError::UnknownName { name: name.to_owned(), fix }
}
