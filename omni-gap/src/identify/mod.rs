//! # Identify: the best numbers for a model, and how sure they are
//!
//! A model is fitted to whole runs by multiple shooting: each run is cut into windows, each window starts from a state of
//! its own, and the parameters are common to all. The starts are eliminated window by window, derivatives are exact
//! (the plant is run in dual numbers), and what the robot file says of its own uncertainty enters as a [`Prior`]. Every
//! number comes with its uncertainty, which holds under errors that go on through a window.

mod answer;
mod begun;
mod block;
mod bounded_step;
mod chance;
mod common_factor;
mod disagree;
mod dispersion;
mod driven;
pub mod experiments;
mod fit;
mod free;
mod guess;
mod gyro_scale;
mod identifiability;
mod information;
mod informativity;
mod joint;
mod linear;
mod misfit;
mod noise;
mod overlap;
mod pass;
mod prior;
mod prior_row;
mod relative;
mod settings;
mod shoot;
#[cfg(test)]
mod staged;
mod starts;
mod whiten;
mod window;

pub use answer::model::{
    Answer, Apart, Asked, Counted, LeftOut, Moved, Number, Power, Product, SCHEMA, SensorNoise, Side, Together, Value,
};
pub use answer::{answer, number_key};
pub(crate) use bounded_step::stepped;
pub use disagree::{Disagreement, IndependentEstimate, disagreements};
pub use dispersion::{effect_free, fit_with_dispersion, nominal_free, told};
pub use fit::{Fit, FitOptions, fit};
pub(crate) use fit::{held_by, slopes_of};
pub use free::Free;
pub use guess::Guessed;
pub use gyro_scale::{GyroScale, HandTurned, MOST_TURNS, gyro_scale};
pub use identifiability::{Identifiability, TradeOff};
pub use informativity::{EffectProspect, Informativity, NumberProspect, Prospect, informativity};
pub use joint::{GIVEN, IDENTIFIED, Identified, Joint, Refused, joint};
pub use linear::{Linearised, Reduced, linearise};
pub use misfit::Misfit;
pub use noise::{LeftOver, Noise, SENSORS};
pub use overlap::{Overlap, Products, SeenWindow};
pub use prior::{Extent, FreedPrior, Prior};
pub use prior_row::PriorRow;
pub use relative::relative_std;
pub use settings::FitSettings;
pub use shoot::{Shots, Starts, WINDOW_S, Windows, first_starts, run_windows};
pub use starts::profile;
pub use whiten::Whitener;
pub use window::WindowLinear;
