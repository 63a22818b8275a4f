//! What noise the recordings show beside what is stated of it, from what the best model leaves over.
//!
//! A search weighs errors by the stated noise first. Where what its model leaves over is of another size, or remembers itself,
//! all is searched once more with the noise that is seen; but no noise is believed to be larger than sensors are usually
//! misjudged, or to remember itself longer: what goes beyond is a gap.

use super::scored::Data;
use crate::engine::evidence::Runs;
use crate::engine::findings::ChannelNoise;
use crate::identify::{Fit, LeftOver, Noise, SENSORS};
use crate::log::median_step;
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
    let most: [f64; SENSORS] = sensors::<N>().map(|(_, _, channel)| match AlignedRun::<N>::channels().group(channel) {
        SignalGroup::WheelSpeed => knobs.most_of_speeds,
        _ => knobs.most,
    });
    let left = LeftOver::of(fit, few.shots());
    let everywhere = left.noise();
    let beyond_belief = (0..SENSORS).any(|sensor| everywhere.scale[sensor] > most[sensor]);
    let mut noise = everywhere;
    if beyond_belief {
        noise = quieter(everywhere, left.noise_where_quiet(knobs.quiet), most);
    }
    let mut as_stated = true;
    for (sensor, (scale, memory)) in noise.scale.iter_mut().zip(&mut noise.correlation_time).enumerate() {
        *scale = scale.clamp(knobs.least, most[sensor]);
        *memory = memory.min(knobs.longest_s);
        let step = first_median_step(&data.fit, sensor);
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

/// The noise everywhere, but of sensors that show more than the most that is believed: of these where it is quiet, since noise
/// is the same everywhere and what a model lacks is not. Where even there more is left than is believed, it is a gap, whose
/// memory says nothing of the sensor.
fn quieter(everywhere: Noise, where_quiet: Noise, most: [f64; SENSORS]) -> Noise {
    let mut noise = everywhere;
    for sensor in (0..SENSORS).filter(|sensor| everywhere.scale[*sensor] > most[*sensor]) {
        let is_noise = where_quiet.scale[sensor] <= most[sensor];
        noise.scale[sensor] = where_quiet.scale[sensor];
        noise.correlation_time[sensor] = if is_noise { where_quiet.correlation_time[sensor] } else { 0.0 };
    }
    noise
}

/// The sensors in the order of [`Noise`], and a channel of each.
fn sensors<const N: usize>() -> [(&'static str, &'static str, usize); SENSORS] {
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

/// The middle time from one sample of a sensor to the next, in the first recording [s]; zero where there are none.
fn first_median_step<const N: usize>(runs: &[&AlignedRun<N>], sensor: usize) -> f64 {
    let channel = sensors::<N>()[sensor].2;
    let step =
        |run: &&AlignedRun<N>| median_step((0..run.rows()).filter(|row| run.saw(*row, channel)).map(|row| run.t[row]));
    runs.first().and_then(step).unwrap_or_default()
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
    fn only_a_sensor_beyond_belief_is_told_by_where_it_is_quiet() {
        let everywhere = Noise { scale: [6.0, 2.0, 9.0, 1.0, 1.0, 1.0], correlation_time: [0.02; SENSORS] };
        let where_quiet = Noise { scale: [1.2, 0.5, 5.0, 0.5, 0.5, 0.5], correlation_time: [0.01; SENSORS] };
        let noise = quieter(everywhere, where_quiet, [3.0; SENSORS]);
        assert_eq!(noise.scale, [1.2, 2.0, 5.0, 1.0, 1.0, 1.0]);
        assert_eq!(noise.correlation_time, [0.01, 0.02, 0.0, 0.02, 0.02, 0.02]);
    }

    #[test]
    fn sensors_stand_in_the_order_of_their_groups() {
        let groups = sensors::<4>().map(|(_, _, channel)| AlignedRun::<4>::channels().group(channel));
        let pose = SignalGroup::Pose;
        let expected = [SignalGroup::Current, SignalGroup::WheelSpeed, pose, pose, SignalGroup::Gyro];
        assert_eq!((&groups[..5], groups[5]), (&expected[..], SignalGroup::Battery));
    }
}
