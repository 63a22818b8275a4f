//! # The core keeps its promises
//!
//! In reading order: the core against the independent reference, the laws that any robot obeys, the edges, the size of
//! the step's error, then the effects: what each may touch, that it can be absent, what the mechanism carries, what
//! each does to a drive, and the page that is made from the cards.

#[path = "support/blank_card.rs"]
mod blank_card;
#[path = "proof/fixture.rs"]
mod fixture;
#[path = "proof/golden.rs"]
mod golden;

#[path = "proof/geometry.rs"]
mod geometry;
#[path = "proof/paper_core.rs"]
mod paper_core;
#[path = "proof/paper_robots.rs"]
mod paper_robots;
#[path = "proof/second_simulator.rs"]
mod second_simulator;
#[path = "proof/second_simulator_effects.rs"]
mod second_simulator_effects;

#[path = "proof/bounds.rs"]
mod bounds;
#[path = "proof/edges.rs"]
mod edges;
#[path = "proof/energy.rs"]
mod energy;
#[path = "proof/feedforward.rs"]
mod feedforward;
#[path = "proof/integration.rs"]
mod integration;
#[path = "proof/open_bridge.rs"]
mod open_bridge;
#[path = "proof/symmetry.rs"]
mod symmetry;

#[path = "proof/block.rs"]
mod block;
#[path = "proof/derivatives.rs"]
mod derivatives;
#[path = "proof/docs.rs"]
mod docs;
#[path = "proof/identity.rs"]
mod identity;
#[path = "proof/invented.rs"]
mod invented;
#[path = "proof/mechanism.rs"]
mod mechanism;
#[path = "proof/pairs.rs"]
mod pairs;
#[path = "proof/registry.rs"]
mod registry;
#[path = "proof/seams.rs"]
mod seams;
#[path = "proof/shown.rs"]
mod shown;
