//! Identify: the best numbers of a robot file, those of the effects that it carries among them, and how sure they are.

use std::borrow::Cow;

use model_core::effects::card::Role;
use schemars::JsonSchema;
use serde::Serialize;

use crate::check::checked;
use crate::error::{Error, InputKind, Result};
use crate::identify::{
    Fit, FitSettings, Free, Prior, Shots, WINDOW_S, Windows, effect_free, fit_with_dispersion, nominal_free, told,
};
use crate::log::{RobotFile, Session, corrected};
use crate::simulate::{AlignedRun, EffectInstance, Model, NOMINAL_KEYS, NominalKey, Slot, find_losses, supply_seen};

/// A fit with a larger error per sample leaves something unexplained [σ]
const MORE_THAN_NOISE: f64 = 1.2;
/// A number that moved further than this many of its stated sigmas is plainly wrong
const FAR_BEYOND: f64 = 3.0;
/// A number that the recordings know no better than this share of what was stated was not told by them
const NO_SURER: f64 = 0.9;

/// How many times as many steps as a diagnosis takes: one fit has the time, and what swings within milliseconds, as a play in
/// the gears, is otherwise some per cent off where the noise would allow one.
const FINER: u16 = 2;

/// What became of a number in a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FitRemark {
    /// It is known better than the file stated.
    Fitted,
    /// It ended at a bound: the recordings cannot tell it.
    AtBound,
    /// It lies far beyond what the file states of its uncertainty.
    FarBeyondStated,
    /// The recordings tell no more of it than the file does.
    NoSurerThanStated,
    /// The recordings tell nothing of it: the file's value stands.
    NotTold,
}

/// A fitted number of the robot file.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct FittedNumber {
    /// Its key in the robot file.
    pub key: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The file's value, in that unit; of a wheel's key, the first wheel's.
    pub nominal: f64,
    /// What the file states of its relative uncertainty, one sigma.
    pub stated_relative: f64,
    /// Fitted over nominal.
    pub factor: f64,
    /// The fitted value, in that unit.
    pub fitted: f64,
    /// Its relative uncertainty after the fit, one sigma, correlations included.
    pub relative_std: f64,
    /// What became of it.
    pub remark: FitRemark,
}

/// A fitted number of an effect that the robot file carries. Nothing is stated of its uncertainty: it is fitted within the
/// bounds of the effect's card.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct FittedEffectNumber {
    /// The effect's id.
    pub effect: &'static str,
    /// The wheel that it sits on alone, counted from 0.
    pub wheel: Option<usize>,
    /// The number's key.
    pub key: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The file's value.
    pub nominal: f64,
    /// The fitted value; the file's where the recordings tell nothing of it.
    pub fitted: f64,
    /// One sigma of it, correlations included; none where it was not fitted.
    pub std: Option<f64>,
    /// What became of it.
    pub remark: FitRemark,
}

/// A robot file's numbers, fitted to recordings within their stated uncertainty.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize)]
pub struct Identification {
    /// All nominal numbers, in the order of the file.
    pub numbers: Vec<FittedNumber>,
    /// The sizes and shapes of the effects that the file carries, in its order of the catalogue.
    pub effects: Vec<FittedEffectNumber>,
    /// Root mean square of what is left [σ]
    pub error_sigma: f64,
    /// How many numbers were compared.
    pub samples: usize,
    /// How many runs were fitted to.
    pub runs: usize,
    /// True where what is left is more than noise: the model lacks something.
    pub lacks_something: bool,
    /// The text of the robot file with the fitted numbers in it.
    #[serde(skip)]
    pub robot_text: String,
}

/// Fits the nominal numbers of a session's robot file, and those of the effects that it carries, to its runs.
///
/// # Errors
/// [`Error::Faulty`] where the recordings have a fault that spoils any fit, [`Error::Input`] where nothing in them can
/// drive the model.
pub fn identify(session: &Session) -> Result<Identification> {
    let session = &*sound(session)?;
    match session.robot.wheel.len() {
        3 => identified::<3>(session),
        _ => identified::<4>(session),
    }
}

/// The session as it is to be used; recordings with a fault that spoils any fit are refused.
pub(super) fn sound(session: &Session) -> Result<Cow<'_, Session>> {
    let (faults, session) = checked(session);
    let Some(fault) = faults.into_iter().find(|fault| fault.fatal) else { return Ok(session) };
    let problem = format!("{}: {}", fault.lines_in_words(), fault.sentence);
    Err(Error::Faulty { code: fault.code, file: fault.file, problem, fix: fault.fix })
}

fn identified<const N: usize>(session: &Session) -> Result<Identification> {
    let mut runs: Vec<AlignedRun<N>> = session.runs.iter().filter_map(|r| AlignedRun::new(r, &session.robot)).collect();
    find_losses(&mut runs, &session.robot);
    runs.iter_mut().for_each(|run| run.finer = FINER);
    if runs.is_empty() {
        let problem =
            "no run has a voltage, a signed current, a wheel speed or a commanded speed to drive the model with";
        let place = session.runs.first().map_or(std::path::Path::new("runs"), |run| run.place());
        return Err(Error::input(place, problem, "Log at least one of u, i, w or wset for every wheel")
            .of_kind(InputKind::Missing));
    }
    let model = Model::<N>::nominal(&session.robot, supply_seen(&runs));
    let windows: Vec<Windows> = runs.iter().map(|r| Windows::new(r, WINDOW_S)).collect();
    let runs: Vec<&AlignedRun<N>> = runs.iter().collect();
    let (settings, prior) = (FitSettings::default(), Prior::stated(&session.robot));
    let shots = Shots { runs: &runs, windows: &windows };
    let given = model.effects.clone();
    let of_effects = told(&model, shots, effect_free(&model));
    let free: Vec<Free> = nominal_free(&settings).into_iter().chain(of_effects).collect();
    let fit = fit_with_dispersion(model, shots, None, &free, &prior, &settings);
    let error_sigma = (fit.cost / fit.samples.max(1) as f64).sqrt();
    Ok(Identification {
        numbers: NOMINAL_KEYS.iter().map(|key| fitted_number(&fit, key, &session.robot)).collect(),
        effects: fitted_effects(&fit, &given),
        error_sigma,
        samples: fit.samples,
        runs: runs.len(),
        lacks_something: error_sigma > MORE_THAN_NOISE,
        robot_text: corrected(&session.robot_text, &[fit.model.changes(), session.identified()].concat())?,
    })
}

fn fitted_number<const N: usize>(fit: &Fit<N>, key: &NominalKey, robot: &RobotFile) -> FittedNumber {
    let (nominal, factor) = (key.value(robot), key.factor(&fit.model.factor));
    let stated = robot.relative_uncertainty(key.key).unwrap_or(0.0);
    let relative_std = fit.relative_std(key).unwrap_or(0.0);
    let ended_at = |slot: Slot| fit.free.iter().any(|free| free.slot == slot && fit.at_bound(free));
    let remark = if key.factors.iter().any(|p| ended_at(Slot::Nominal(*p))) {
        FitRemark::AtBound
    } else if stated > 0.0 && factor.ln().abs() > FAR_BEYOND * stated {
        FitRemark::FarBeyondStated
    } else if stated > 0.0 && relative_std > NO_SURER * stated {
        FitRemark::NoSurerThanStated
    } else {
        FitRemark::Fitted
    };
    FittedNumber {
        key: key.key,
        unit: key.unit,
        nominal,
        stated_relative: stated,
        factor,
        fitted: nominal * factor,
        relative_std,
        remark,
    }
}

fn fitted_effects<const N: usize>(fit: &Fit<N>, given: &[EffectInstance]) -> Vec<FittedEffectNumber> {
    let mut numbers = Vec::new();
    for (at, (found, given)) in fit.model.effects.iter().zip(given).enumerate() {
        for (p, param) in found.card().params.iter().enumerate().filter(|(_, param)| param.role != Role::Fixed) {
            let free = fit.free.iter().find(|free| free.slot == Slot::Param(at, p));
            numbers.push(FittedEffectNumber {
                effect: found.id,
                wheel: found.wheel,
                key: param.key,
                unit: param.unit,
                nominal: given.params[p],
                fitted: found.params[p],
                std: fit.std(Slot::Param(at, p)),
                remark: match free {
                    None => FitRemark::NotTold,
                    Some(free) if fit.at_bound(free) => FitRemark::AtBound,
                    Some(_) => FitRemark::Fitted,
                },
            });
        }
    }
    numbers
}
