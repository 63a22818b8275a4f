//! Bridge: the current that a voltage drives through a winding, against what is lost on the way.
//!
//! ```text
//! u − l·K_v·ω = R·i + u_drop·sat(i/i₀)      sat(x) = x held within ±1
//! u_drop      = drop + min(braking drop, l·K_v·|ω|) where i brakes, drop where it drives
//! |i| ≤ i_max
//! ```
//!
//! The right side rises with i, so there is one current, and it lies on one of three straight pieces.

use crate::effects::seams::{Bridge, Winding};
use crate::number::scalar::Real;

/// All currents.
pub(super) fn anywhere<P: Real>() -> [P; 2] {
    [P::lit(f64::NEG_INFINITY), P::lit(f64::INFINITY)]
}

/// What bridge and winding say at a current.
#[derive(Clone, Copy)]
pub(super) struct Look<T> {
    pub bridge: Bridge<T>,
    pub winding: Winding<T>,
    /// 1/R [1/Ω]
    pub per_resistance: T,
}

/// A current on one of the straight pieces of its line over the voltage.
pub(super) struct Piece<T: Real> {
    /// [A]
    pub current: T,
    /// −∂i/∂(back-EMF) [1/Ω]
    pub per_emf: T,
    /// The piece [A]; none where the current is no straight line over the rotor's speed
    pub within: Option<[T::Plain; 2]>,
}

impl<T: Real> Look<T> {
    /// l·K_v·ω [V]
    #[inline]
    fn emf(&self) -> T {
        self.winding.emf_constant * self.winding.speed
    }

    /// The current that a voltage drives, or that the bridge lets flow.
    #[inline]
    pub fn current(&self, voltage: T) -> Piece<T> {
        let (piece, limit) = (self.driven(voltage), self.bridge.current_limit);
        if limit <= T::zero() {
            return piece;
        }
        if piece.current.abs() > limit {
            // i = ±i_max, whatever the speed
            return Piece { current: limit.copysign(piece.current), per_emf: T::zero(), within: None };
        }
        let most = limit.plain();
        Piece { within: piece.within.map(|[low, high]| [low.max(-most), high.min(most)]), ..piece }
    }

    /// The current that a voltage drives.
    #[inline]
    fn driven(&self, voltage: T) -> Piece<T> {
        let (driving, ripple) = (voltage - self.emf(), self.bridge.drop_current);
        let per_resistance = self.per_resistance;
        if ripple <= T::zero() {
            // i = (u − l·K_v·ω)/R
            return Piece { current: driving * per_resistance, per_emf: per_resistance, within: Some(anywhere()) };
        }
        if !self.bridge.braking_drop.is_nothing() {
            return self.braking(driving);
        }
        // u − l·K_v·ω = R·i + u_drop·sat(i/i₀): three straight pieces, which rise
        let [i, least, most] = [ripple.plain(), anywhere()[0], anywhere()[1]];
        let (drop, per_emf) = (self.bridge.drop, per_resistance);
        match self.reach(driving, drop) {
            Reach::Within(per_emf) => Piece { current: driving * per_emf, per_emf, within: Some([-i, i]) },
            Reach::Above => Piece { current: (driving - drop) * per_resistance, per_emf, within: Some([i, most]) },
            Reach::Below => Piece { current: (driving + drop) * per_resistance, per_emf, within: Some([least, -i]) },
        }
    }

    /// The same where a current that brakes loses more: on that side of zero, and no more than the back-EMF.
    fn braking(&self, driving: T) -> Piece<T> {
        let (emf, per_resistance, one) = (self.emf(), self.per_resistance, T::one());
        let brakes = driving * emf < T::zero();
        let fades = brakes && emf.abs() < self.bridge.braking_drop;
        let more = if !brakes {
            T::zero()
        } else if fades {
            emf.abs()
        } else {
            self.bridge.braking_drop
        };
        let drop = self.bridge.drop + more;
        // where it fades, u − l·K_v·ω + u_drop(ω)·sat(i/i₀) loses with the speed what the back-EMF gives
        let left = |saturated: T| if fades { one - saturated } else { one };
        let (current, per_emf) = match self.reach(driving, drop) {
            Reach::Within(per_emf) => {
                let current = driving * per_emf;
                (current, per_emf * left(current.abs() / self.bridge.drop_current))
            }
            Reach::Above => ((driving - drop) * per_resistance, per_resistance * left(one)),
            Reach::Below => ((driving + drop) * per_resistance, per_resistance * left(one)),
        };
        Piece { current, per_emf, within: None }
    }

    /// On which piece a voltage beyond the back-EMF drives the current, when so much is lost against it.
    #[inline]
    fn reach(&self, driving: T, drop: T) -> Reach<T> {
        let (ripple, per_resistance) = (self.bridge.drop_current, self.per_resistance);
        let [u, u_drop, i, g] = [driving, drop, ripple, per_resistance].map(T::plain);
        if u.abs() * g <= i + u_drop * g {
            Reach::Within(per_resistance / (T::one() + drop / ripple * per_resistance))
        } else if driving > T::zero() {
            Reach::Above
        } else {
            Reach::Below
        }
    }
}

/// Where a current lies against the one from which all of the bridge's drop is lost.
enum Reach<T> {
    /// Below it, either way; current over voltage [1/Ω]
    Within(T),
    Above,
    Below,
}
