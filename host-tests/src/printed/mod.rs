//! # What the paper prints, and what comes out when it is computed
//!
//! The printed figures are typed once, in [`tables`]. Each room computes one section of `golden/paper.md`, which
//! [`page()`] puts together: [`averages`] (Tables 1 to 3), [`kinematics`] (eq. 2–9), [`dynamics`] (eq. 32–37) and
//! [`terms`] (section 5.4). The matrices of the core come from [`mod@core`].

pub mod averages;
pub mod core;
pub mod dynamics;
pub mod kinematics;
pub mod page;
pub mod tables;
pub mod terms;

pub use self::core::of_the_core;
pub use self::page::page;
