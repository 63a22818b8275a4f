//! Scripts to choose from, and what a robot as it is known so far would record of each.

use model_core::plant::Input;

use crate::engine::findings::ChosenScript;
use crate::engine::knobs::DesignKnobs;
use crate::engine::selftest::mask;
use crate::log::{Channel, Group, RobotFile, Run, SensorsFile};
use crate::simulate::{
    AlignedRun, Chain, Emphasis, Excitation, MAX_CHANNELS, Model, RichPlan, RunPlan, SensorSetup, SignalGroup,
    USUAL_FIELD, excite, rich_allowed, usual_voltage,
};

/// How a robot is recorded, as it was so far.
pub(super) struct Site {
    pub logged: Vec<SignalGroup>,
    chain: Chain,
    /// Rows a second of the recordings so far [1/s]
    logged_at: f64,
    /// Rows a second of scripts [1/s]
    rate: f64,
    camera_rate: f64,
    voltage: f64,
    field: f64,
    seed: u64,
}

/// A script, and what would be recorded of it.
pub(super) struct Candidate<const N: usize> {
    pub chosen: ChosenScript,
    /// What to play.
    pub script: Run,
    pub recorded: AlignedRun<N>,
}

/// The name of the run.
const NAME: &str = "next_experiment";

impl Site {
    /// As recordings show it: their rates, their sensors, and no more voltage than they have seen, unless more is asked for.
    pub fn of<const N: usize>(
        recorded: &[&Run],
        laid: &[AlignedRun<N>],
        file: &RobotFile,
        knobs: &DesignKnobs,
    ) -> Self {
        let seconds: f64 = recorded.iter().filter_map(|run| Some(run.t_s.last()? - run.t_s.first()?)).sum();
        let between = |samples: usize| samples.saturating_sub(1);
        let each = |count: &dyn Fn(&Run) -> usize| {
            recorded.iter().map(|run| between(count(run))).sum::<usize>() as f64 / seconds
        };
        let first = |group: &Option<Group>| group.as_ref().map_or(0, |group| group.channels[0].present().count());
        let driven = |run: &Run| [&run.u, &run.wset, &run.i, &run.w].into_iter().map(first).max().unwrap_or(0);
        let seen = laid.iter().map(|run| run.largest_voltage).fold(0.0, f64::max);
        let rows = each(&driven);
        Self {
            logged: SignalGroup::ALL.into_iter().filter(|group| laid.iter().any(|run| run.has_group(*group))).collect(),
            chain: laid[0].chain,
            logged_at: rows,
            rate: rows.clamp(knobs.rates.0, knobs.rates.1),
            camera_rate: each(&|run| first(&run.pose)),
            voltage: knobs.voltage.unwrap_or(if seen > 0.0 { seen } else { usual_voltage(file) }),
            field: knobs.field.or(file.limits.and_then(|limits| limits.field_m)).unwrap_or(USUAL_FIELD),
            seed: knobs.seed,
        }
    }

    /// The channels that are logged, as a bit mask.
    pub fn mask<const N: usize>(&self) -> u16 {
        mask::<N>(&self.logged)
    }

    /// How many samples would be recorded for each row of a script, channel by channel: frames of a camera have a rate of their own.
    pub fn samples_a_row<const N: usize>(&self) -> [f64; MAX_CHANNELS] {
        let mut times = [self.logged_at / self.rate; MAX_CHANNELS];
        AlignedRun::<N>::channels().of(SignalGroup::Pose).for_each(|channel| times[channel] = 1.0);
        times
    }

    fn how(&self, file: &RobotFile) -> SensorSetup {
        SensorSetup {
            camera_rate: self.camera_rate,
            dropouts: 0.0,
            sensors: file.sensors,
            gyro: true,
            battery: true,
            ..SensorSetup::default()
        }
    }

    /// What a robot would record of voltages: by its drives' set speeds, where those are what it is told.
    fn recorded<const N: usize>(
        &self,
        model: &Model<N>,
        file: &RobotFile,
        volts: Vec<Input<N, f64>>,
    ) -> Option<(Run, AlignedRun<N>)> {
        let plant = model.plant();
        let t = (0..volts.len()).map(|row| row as f64 / self.rate).collect();
        let mut plan = RunPlan { name: NAME.to_owned(), t, input: volts, how: self.how(file), seed: self.seed };
        if self.chain == Chain::SetSpeed {
            let sensors = SensorsFile { wheel_speed_noise_rad_s: 0.0, ..file.sensors };
            let quiet = RunPlan { how: SensorSetup { sensors, ..plan.how }, ..plan.clone() }.recorded_of(&plant);
            plan.input = set_speeds(&quiet);
        }
        let recorded = plan.recorded_of(&plant);
        let script = Run {
            name: NAME.to_owned(),
            t_s: recorded.t_s.clone(),
            u: recorded.u.clone(),
            wset: recorded.wset.clone(),
            ..Run::default()
        };
        let as_logged = match self.chain {
            Chain::Voltage | Chain::SetSpeed => recorded,
            Chain::Current => Run { u: None, ..recorded },
            Chain::WheelSpeed => Run { u: None, i: None, ..recorded },
        };
        Some((script, AlignedRun::new(&as_logged, file)?))
    }
}

/// The wheel speeds of a run as what the drives are told, row by row.
fn set_speeds<const N: usize>(run: &Run) -> Vec<Input<N, f64>> {
    let channels: Vec<&Channel> = run.w.iter().flat_map(|group| &group.channels).collect();
    let speed = |row: usize, wheel: usize| channels.get(wheel).and_then(|c| c.get(row).ok()).unwrap_or(0.0);
    (0..run.rows()).map(|row| Input::SetSpeed(std::array::from_fn(|wheel| speed(row, wheel)))).collect()
}

/// Scripts of each emphasis at each voltage, within what the robot file allows.
pub(super) fn candidates<const N: usize>(
    model: &Model<N>,
    file: &RobotFile,
    site: &Site,
    knobs: &DesignKnobs,
) -> Vec<Candidate<N>> {
    let plan = |emphasis: Emphasis, share: f64| RichPlan {
        rate: site.rate,
        voltage: share * site.voltage,
        field: site.field,
        scripts: knobs.draws,
        duration: knobs.duration,
        emphasis,
    };
    let plans =
        Emphasis::ALL.into_iter().flat_map(|emphasis| knobs.voltages.iter().map(move |share| plan(emphasis, *share)));
    let written = plans.flat_map(|plan| {
        let all = rich_allowed::<N>(file, &plan);
        all.scripts.into_iter().zip(all.floors).filter_map(move |(script, floor)| {
            let (script, recorded) = site.recorded(model, file, script.inputs().collect())?;
            let chosen = ChosenScript {
                emphasis: plan.emphasis,
                seconds: knobs.duration,
                rate: site.rate,
                voltage: all.plan.voltage,
                floor,
                set_speed: site.chain == Chain::SetSpeed,
            };
            Some(Candidate { chosen, script, recorded })
        })
    });
    written.collect()
}

/// Random motion as long, as it would be recorded.
pub(super) fn random<const N: usize>(
    model: &Model<N>,
    file: &RobotFile,
    site: &Site,
    knobs: &DesignKnobs,
) -> Vec<AlignedRun<N>> {
    let wish = Excitation { duration: knobs.duration, rate: site.rate, voltage: site.voltage };
    let drawn =
        |seed: u64| excite(&model.robot().wheels, &wish, knobs.seed + seed).into_iter().map(Input::Voltage).collect();
    (0..knobs.random as u64).filter_map(|seed| Some(site.recorded(model, file, drawn(seed))?.1)).collect()
}
