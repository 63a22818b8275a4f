//! # What the seams can carry
//!
//! Each ability of the plant beyond what most of the catalogue uses, shown by an effect that stands only here, against a
//! reference that shares nothing with the core: a closed form, or equations integrated for themselves.

#[path = "support/blank_card.rs"]
mod blank_card;

#[path = "abilities/effects.rs"]
mod effects;

#[path = "abilities/backlash.rs"]
mod backlash;
#[path = "abilities/context.rs"]
mod context;
#[path = "abilities/elastic_shaft.rs"]
mod elastic_shaft;
#[path = "abilities/off_centre.rs"]
mod off_centre;
#[path = "abilities/roller_friction.rs"]
mod roller_friction;
#[path = "abilities/room.rs"]
mod room;
