//! # Halls: where the rotor is and how fast it turns, from three switches
//!
//! ```text
//! sector k:  θ in k·60° − 30° ..< k·60° + 30°     codes 1, 3, 2, 6, 4, 5 (a = 1, b = 2, c = 4)
//! ω_e = s·(2π/6)·n/Σ t                            mean over the last n ≤ 6 sectors, in rad a period
//! |ω_e| ≤ 1¼·(2π/6)/t₀                            while the next edge is late
//! θ = edge + s·min(ω_e·(t₀ + ½ − ε), 60°)         within the sector
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | k | [`HallDecoder::sector`] | 1 | 0 ..= 5; forward counts up |
//! | θ | [`HallDecoder::angle`] | rad | electrical angle of the rotor's flux, from phase a |
//! | s | | 1 | sense in which the last edge was crossed |
//! | t | | periods | what each of the last sectors took |
//! | t₀ | [`HallDecoder::since_edge`] | periods | since the last edge |
//! | ε | `before` | periods | how long before the reading θ is wanted: where the currents were sampled |
//! | n | | 1 | sectors looked at |
//!
//! The switches are read once a period, so that an edge is known to a period: ±½ on average, hence the ½ in the angle.
//! Switches and magnet stand up to some 5° off their places; six sectors in a row are a whole electrical turn whatever
//! the places are, so that this drops out of the mean of six. A sector that took a fifth longer or shorter than the
//! mean is no error of place but an acceleration: the older ones are forgotten, and the mean begins anew with it.
//!
//! A switch that the magnet's field is just enough for chatters: it crosses its edge back and forth, a few times or many, while the
//! rotor passes. An edge crossed back within a quarter of what a sector takes is not believed until it has lasted that
//! long; a rotor that truly turned back has by then left it as far behind as it was beyond. The first crossing counts,
//! and angle, speed and edges are those of switches without chatter.
//!
//! An edge that was truly crossed back says nothing of the speed; so do the first edge and one after 50 ms of rest. The angle is then
//! the middle of the sector, off by 30° at most. The speed is 0 until two edges have followed each other.
//!
//! Neglects: the acceleration over the sectors looked at: the speed told is that of half a turn ago, too low by the share
//! π·(dω_e/dt)/ω_e² of it, up to some 30 % just after a start; the angle is off by up to a sector in the moment of a
//! reversal. Fails when: the rotor passes a sector in less than a period (3,333 electrical turns a second at 20 kHz).
//!
//! How to measure the order of the codes and the places: turn the motor with another drive at constant speed and record
//! codes and the back-EMF between two terminals; u_b − u_c has its crest in the middle of sector 0.
//!
//! Source: definitions; the sectors are those of three switches 120° apart that each are on for half a turn.

use core::f64::consts::TAU;

use crate::number::scalar::Real;

/// What three hall switches read: a = 1, b = 2, c = 4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HallCode(pub u8);

/// What hall switches must not do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HallFault {
    /// All on or all off: no place of the rotor does that
    Illegal,
    /// A sector was not seen between two codes
    Skipped,
}

/// Periods without an edge after which the rotor is taken to rest: 50 ms at 20 kHz.
pub const REST: u16 = 1000;

/// Parts of a period, in which it is told how long before the reading an angle is wanted.
pub const HALL_PARTS: u32 = 256;

/// A sixth of a turn, where a turn is 2³²; six of them just fit.
const SIXTH: u32 = 715_827_882;

/// No such sector.
const NONE: u8 = 0xff;

/// The sector of every code.
const SECTORS: [u8; 8] = [NONE, 0, 2, 1, 4, 5, 3, NONE];

/// The code of every sector.
const CODES: [u8; 6] = [1, 3, 2, 6, 4, 5];

/// The hall switches of one motor, followed from period to period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HallDecoder {
    code: HallCode,
    sector: u8,
    /// s: true where the last edge was crossed backwards
    backwards: bool,
    /// n, 0 where the speed is not known
    looked_at: u8,
    /// t₀ [periods]
    since_edge: u16,
    /// What each sector took when it was last left [periods]; 0 where that is not looked at
    took: [u16; 6],
    /// Σ t [periods]
    sum: u16,
    /// |ω_e| [2⁻³² turns a period]
    step: u32,
    edges: i32,
}

impl HallCode {
    /// The sector that the code stands for; none where no place of the rotor gives it.
    #[inline]
    pub fn sector(self) -> Option<u8> {
        SECTORS.get(usize::from(self.0)).copied().filter(|sector| *sector != NONE)
    }

    /// The code that the switches give in a sector, counted on around the turn.
    #[inline]
    pub fn of_sector(sector: u8) -> Self {
        Self(CODES.get(usize::from(sector % 6)).copied().unwrap_or_default())
    }

    /// The code that switches in their places give at an electrical angle [rad].
    pub fn of_angle<T: Real>(angle: T) -> Self {
        // k = ⌊θ/60° + ½⌋ mod 6
        let (sin, cos) = angle.sin_cos();
        let turned = sin.atan2(cos) / T::lit(TAU / 6.0) + T::lit(6.5);
        Self::of_sector(u8::try_from(turned.index() % 6).unwrap_or_default())
    }
}

impl HallDecoder {
    /// A rotor at rest, by the first code read.
    pub fn new(code: HallCode) -> Result<Self, HallFault> {
        let sector = code.sector().ok_or(HallFault::Illegal)?;
        Ok(Self {
            code,
            sector,
            backwards: false,
            looked_at: 0,
            since_edge: REST,
            took: [0; 6],
            sum: 0,
            step: 0,
            edges: 0,
        })
    }

    /// Once a period: the code read now.
    ///
    /// An illegal code is not believed: the rotor is taken to be where it was. A skipped sector is: the place is that of
    /// the code, the edges are counted the shorter way (not at all across half a turn), and the speed is unknown.
    #[inline]
    pub fn update(&mut self, code: HallCode) -> Result<(), HallFault> {
        if code == self.code {
            self.wait();
            return Ok(());
        }
        self.edge(code)
    }

    /// A period without an edge.
    #[inline]
    fn wait(&mut self) {
        self.since_edge = self.since_edge.saturating_add(1);
        if self.since_edge == REST {
            self.forget();
        }
    }

    /// Another code.
    fn edge(&mut self, code: HallCode) -> Result<(), HallFault> {
        let Some(sector) = code.sector() else {
            self.wait();
            return Err(HallFault::Illegal);
        };
        let took = self.since_edge.saturating_add(1);
        let (left, ahead) =
            (self.sector, if sector >= self.sector { sector - self.sector } else { sector + 6 - self.sector });
        if self.is_chatter(ahead, took) {
            self.wait();
            return Ok(());
        }
        self.code = code;
        self.sector = sector;
        self.since_edge = 0;
        let backwards = match ahead {
            1 => false,
            5 => true,
            _ => {
                self.forget();
                self.edges = self.edges.wrapping_add(match ahead {
                    2 => 2,
                    4 => -2,
                    _ => 0,
                });
                return Err(HallFault::Skipped);
            }
        };
        self.edges = self.edges.wrapping_add(if backwards { -1 } else { 1 });
        let turned_back = backwards != self.backwards;
        self.backwards = backwards;
        if turned_back || took >= REST {
            self.forget();
        } else {
            self.learn(left, took);
        }
        Ok(())
    }

    /// True where the edge that was crossed last is crossed back, `took` periods later, sooner than a rotor could that moves so fast.
    #[inline]
    fn is_chatter(&self, ahead: u8, took: u16) -> bool {
        // t < Σ t/n/4; false where the speed is not known
        let back = if self.backwards { 1 } else { 5 };
        ahead == back && 4 * u32::from(self.looked_at) * u32::from(took) < u32::from(self.sum)
    }

    /// What a sector took [periods] that was left just now.
    fn learn(&mut self, left: u8, took: u16) {
        // |t·n − Σ t| > Σ t/5 + n: a fifth off the mean, and a period that the reading may err by
        let (sum, n) = (u32::from(self.sum), u32::from(self.looked_at));
        if 5 * (u32::from(took) * n).abs_diff(sum) > sum + 5 * n {
            self.forget();
        }
        if let Some(slot) = self.took.get_mut(usize::from(left)) {
            // the same sector a turn ago goes, this one comes
            self.looked_at += u8::from(*slot == 0);
            self.sum = self.sum - *slot + took;
            *slot = took;
        }
        // |ω_e| = 2³²/6·n/Σ t
        self.step = (SIXTH * u32::from(self.looked_at)).checked_div(u32::from(self.sum)).unwrap_or_default();
    }

    /// The speed is not known any more.
    fn forget(&mut self) {
        self.took = [0; 6];
        self.sum = 0;
        self.looked_at = 0;
        self.step = 0;
    }

    /// Edges since the beginning, forward less backward, wrapping.
    #[inline]
    pub fn edges(&self) -> i32 {
        self.edges
    }

    /// Periods since the last edge, up to 65,535; it begins at [`REST`].
    #[inline]
    pub fn since_edge(&self) -> u16 {
        self.since_edge
    }

    /// True once two edges have followed each other, so that the speed and the angle between two edges are known.
    #[inline]
    pub fn is_speed_known(&self) -> bool {
        self.looked_at != 0
    }

    /// Periods that a whole electrical turn takes by the mean of the sectors looked at; 0 where the speed is not known.
    #[inline]
    pub fn interval(&self) -> u16 {
        // 6·Σ t/n, rounded; at most 6·999
        let n = u32::from(self.looked_at);
        let turn = (6 * u32::from(self.sum) + n / 2).checked_div(n).unwrap_or_default();
        u16::try_from(turn).unwrap_or(u16::MAX)
    }

    /// The sector that the rotor is in, 0 ..= 5.
    #[inline]
    pub fn sector(&self) -> u8 {
        self.sector
    }

    /// |ω_e| [2⁻³² turns a period]; 0 where the speed is not known.
    #[inline]
    pub(super) fn step(&self) -> u32 {
        self.step
    }

    /// True where the last edge was crossed backwards.
    #[inline]
    pub(super) fn is_backwards(&self) -> bool {
        self.backwards
    }

    /// θ, electrical angle within the sector when it was read, in 2⁻¹⁶ turns.
    #[inline]
    pub fn angle_code(&self) -> u16 {
        self.angle_code_before(0)
    }

    /// θ a little before it was read, in 2⁻¹⁶ turns; `before` is ε in parts of which [`HALL_PARTS`] are a period, half of
    /// them at most.
    #[inline]
    pub fn angle_code_before(&self, before: u32) -> u16 {
        let centre = u32::from(self.sector) * SIXTH;
        if self.step == 0 {
            return high(centre);
        }
        // θ = edge + s·min(ω_e·(t₀ + ½ − ε), 60°)
        let within = self.step / HALL_PARTS * (HALL_PARTS / 2).saturating_sub(before);
        let advance = self.step.saturating_mul(u32::from(self.since_edge)).saturating_add(within).min(SIXTH);
        let beyond = advance.wrapping_sub(SIXTH / 2);
        high(if self.backwards { centre.wrapping_sub(beyond) } else { centre.wrapping_add(beyond) })
    }

    /// θ, electrical angle within the sector [rad], in 0 ..< 2π.
    #[inline]
    pub fn angle<T: Real>(&self) -> T {
        angle_of_code(self.angle_code())
    }

    /// How far the angle goes on in a period [rad], signed; 0 where the speed is not known.
    ///
    /// It is the speed that [`HallDecoder::angle`] interpolates with: cheap, and without a look at whether the next
    /// edge is late.
    #[inline]
    pub fn ahead<T: Real>(&self) -> T {
        let ahead: T = angle_of_code(high(self.step));
        if self.backwards { -ahead } else { ahead }
    }

    /// ω_e [rad a period], signed; 0 where it is not known.
    #[inline]
    pub fn electrical_speed<T: Real>(&self) -> T {
        if !self.is_speed_known() {
            return T::zero();
        }
        // |ω_e| = (2π/6)/max(Σ t/n, t₀/1¼)
        let mean = T::count(self.sum) / T::count(u16::from(self.looked_at));
        let late = T::lit(0.8) * T::count(self.since_edge);
        let speed = T::lit(TAU / 6.0) / mean.max(late);
        if self.backwards { -speed } else { speed }
    }
}

/// An angle [rad] in 0 ..< 2π of one in 2⁻¹⁶ turns.
#[inline]
pub fn angle_of_code<T: Real>(code: u16) -> T {
    T::count(code) * T::lit(TAU / 65_536.0)
}

/// An angle in 2⁻³² turns, rounded to 2⁻¹⁶ turns.
#[inline]
fn high(angle: u32) -> u16 {
    (angle.wrapping_add(1 << 15) >> 16) as u16
}

#[cfg(test)]
mod tests;
