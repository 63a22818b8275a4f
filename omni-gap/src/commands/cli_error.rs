//! Why a command ends before it is done.

/// One message, with how to mend it.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// A file, folder or output cannot be used.
    #[error(transparent)]
    File(#[from] omni_gap::Error),
    /// A name that is none of the catalogue's.
    #[error("`{name}` is neither an effect nor a parameter. {fix}")]
    UnknownName {
        /// What was asked for.
        name: String,
        /// What to ask for instead.
        fix: String,
    },
    /// A session that is named both ways, or not at all.
    #[error("{0}")]
    Unclear(&'static str),
}
