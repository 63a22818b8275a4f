//! # Pooling: what many robots tell that one robot does not
//!
//! A weak effect on thirty robots shows on none of them alone. Each session keeps the linear equations of every effect and of every
//! number of the robot file ([`SessionEquations`](crate::engine::findings::SessionEquations)); here they are added up under a
//! hierarchical model: robots of one kind share their numbers up to a spread, which is estimated (`population`).
//!
//! ```text
//! x_r = u + ζ_r        ζ_r ~ N(0, S)        S = diag(τ², (1 − ρ)·Λ⁻¹)
//! u = (μ; δ)           δ ~ N(0, ρ·Λ⁻¹)      Λ: what the robot file states of its numbers
//! ```
//!
//! x_r are what is so of robot r: how much of an effect it has, and the logarithms of the factors on its numbers. Of that follow
//! the causes that all share (`common`), the robots that stand out from their kind (`robots`), changes over time (`changes`)
//! and between two labels, such as firmware versions or floors (`contrasts`).

mod answer;
mod changes;
mod common;
mod contrasts;
mod evidence;
mod knobs;
mod place;
mod pool;
mod pooled_number;
mod population;
mod quadratic;
mod robots;
mod steps;
#[cfg(test)]
mod tests;

pub use answer::{ChangePoint, CommonCause, Contrast, CourseDay, Pooled, RobotEstimate};
pub use evidence::SessionEvidence;
pub use knobs::PoolingKnobs;
pub use pool::pooled;
pub use pooled_number::PooledNumber;
