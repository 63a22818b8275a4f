//! A line of a proposed mapping, for whoever lists them.

/// A proposed line of a mapping.
#[derive(Debug, Clone, PartialEq, schemars::JsonSchema, serde::Serialize)]
pub struct Line {
    /// The column of a run, such as `w0_rad_s`.
    pub column: String,
    /// The file or topic that it comes from.
    pub of: String,
    /// The rule, as it stands in the mapping.
    pub rule: String,
    /// How sure that is: `sure`, `likely` or `guess`.
    pub certainty: &'static str,
    /// Why it is so.
    pub reason: String,
}
