//! What noise the recordings show beside what is stated of it, from what the best model leaves over.
//!
//! A search weighs errors by the stated noise first. Where what its model leaves over is of another size, or remembers itself,
//! all is searched once more with the noise that is seen; but no noise is believed to be larger than sensors are usually
//! misjudged, or to remember itself longer: what goes beyond is a gap.

use super::scored::Data;
use crate::engine::evidence::Runs;
use crate::engine::findings::ChannelNoise;
use crate::identify::{Fit, Noise, noise_where_quiet};
use crate::simulate::{AlignedRun, SignalGroup};

/// Noise that a model's left-overs show.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenNoise {
    /// Within what is believed of sensors.
    pub noise: Noise,
    /// True if one of them shows more than is believed.
    pub beyond_belief: bool,
}

/// The noise that a model's left-overs show; none where it is what is stated.
pub(super) fn noise_seen<const N: usize>(fit: &Fit<N>, data: &Data<'_, N>) -> Option<SeenNoise> {
    let (screen, knobs) = (&data.knobs.screen, &data.knobs.noise);
    let few = data.to_fit().beginning(screen.runs, screen.least_s).shortened(screen.most_s, screen.most_rows);
    let most: [f64; 6] = sensors::<N>().map(|(_, _, channel)| match AlignedRun::<N>::channels().group(channel) {
        SignalGroup::WheelSpeed => knobs.most_of_speeds,
        _ => knobs.most,
    });
    let everywhere = noise_where_quiet(fit, few.shots(), 1.0);
    let beyond_belief = everywhere.scale.iter().zip(&most).any(|(scale, most)| scale > most);
    // noise is the same everywhere; what a model lacks is not
    let mut noise = if beyond_belief { noise_where_quiet(fit, few.shots(), knobs.quiet) } else { everywhere };
    let mut as_stated = true;
    for (sensor, (scale, memory)) in noise.scale.iter_mut().zip(&mut noise.correlation_time).enumerate() {
        *scale = scale.clamp(knobs.least, most[sensor]);
        *memory = memory.min(knobs.longest_s);
        let step = median_step(&data.fit, sensor);
        if *memory < knobs.shortest_rows * step {
            *memory = 0.0;
        }
        if *memory == 0.0 && (*scale).max(1.0 / *scale) < knobs.as_stated {
            *scale = 1.0;
        }
        as_stated &= *scale == 1.0 && *memory == 0.0;
    }
    (!as_stated).then_some(SeenNoise { noise, beyond_belief })
}

/// The sensors in the order of [`Noise`], and a channel of each.
fn sensors<const N: usize>() -> [(&'static str, &'static str, usize); 6] {
    let channels = AlignedRun::<N>::channels();
    [
        ("current", "A", channels.current(0)),
        ("wheel_speed", "rad/s", channels.wheel_speed(0)),
        ("position", "m", channels.pose()[0]),
        ("heading", "rad", channels.heading()),
        ("gyro", "rad/s", channels.gyro()),
        ("battery", "V", channels.battery()),
    ]
}

/// The middle time from one sample of a sensor to the next [s]; zero where there are none.
fn median_step<const N: usize>(runs: &[&AlignedRun<N>], sensor: usize) -> f64 {
    let channel = sensors::<N>()[sensor].2;
    let mut steps: Vec<f64> = runs
        .iter()
        .take(1)
        .flat_map(|run| {
            let times: Vec<f64> = (0..run.rows()).filter(|row| run.saw(*row, channel)).map(|row| run.t[row]).collect();
            times.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>()
        })
        .collect();
    let middle = steps.len() / 2;
    if steps.is_empty() { 0.0 } else { *steps.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

impl<const N: usize> Runs<N> {
    /// The same recordings with this noise in place of what is stated.
    pub(super) fn with_noise(&self, noise: &Noise) -> Self {
        let applied = |runs: &[AlignedRun<N>]| runs.iter().map(|run| noise.applied(run)).collect();
        Self { fit: applied(&self.fit), held: applied(&self.held) }
    }
}

/// What is stated of each sensor that was compared, and what was believed in its place.
pub(super) fn told<const N: usize>(data: &Data<'_, N>) -> Vec<ChannelNoise> {
    let runs = || data.fit.iter().chain(&data.held);
    let of = |(sensor, unit, channel): (&str, &str, usize)| {
        let run = runs().find(|run| (0..run.rows()).any(|row| run.saw(row, channel)))?;
        Some(ChannelNoise {
            sensor: sensor.to_owned(),
            group: AlignedRun::<N>::channels().group(channel).name().to_owned(),
            unit: unit.to_owned(),
            stated: run.stated[channel],
            found: run.sigma[channel],
            correlation_time_s: run.correlation_time[channel],
        })
    };
    sensors::<N>().into_iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensors_stand_in_the_order_of_their_groups() {
        let groups = sensors::<4>().map(|(_, _, channel)| AlignedRun::<4>::channels().group(channel));
        let pose = SignalGroup::Pose;
        let expected = [SignalGroup::Current, SignalGroup::WheelSpeed, pose, pose, SignalGroup::Gyro];
        assert_eq!((&groups[..5], groups[5]), (&expected[..], SignalGroup::Battery));
    }
}
