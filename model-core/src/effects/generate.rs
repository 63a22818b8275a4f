//! What is made of the list of effects: enums whose hooks are found by `match`, so that nothing is called through a
//! pointer and what an effect does not do costs nothing.

/// Makes an enum of effects, an enum of their states, and the match that finds each one's hooks.
///
/// `pub enum Set, SetState [T: Real] [T] { Variant(Type, CARD), … }`: the parameters of the enums, the number, and for
/// each kind its type, which has [`Hooks`](crate::effects::Hooks), and its card.
#[macro_export]
macro_rules! effect_set {
    ($(#[$meta:meta])* $vis:vis enum $Set:ident, $State:ident [$($g:ident: $bound:path)?] [$n:ty]
     { $($Variant:ident($Type:ty, $card:expr)),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(missing_docs)]
        $vis enum $Set<$($g)?> { $($Variant($Type)),* }

        /// What one of these effects remembers.
        #[derive(Clone, Copy, Debug)]
        #[allow(missing_docs, clippy::large_enum_variant)]
        $vis enum $State<$($g: $bound)?> { $($Variant(<$Type as $crate::effects::Hooks<$n>>::State)),* }

        impl<$($g: $bound)?> $crate::effects::Numbers<$n> for $State<$($g)?> {
            fn for_each_mut(&mut self, visit: impl FnMut(&mut $n)) {
                match self { $($State::$Variant(s) => $crate::effects::Numbers::<$n>::for_each_mut(s, visit)),* }
            }
        }

        impl<$($g: $bound)?> $crate::effects::EffectSet<$n> for $Set<$($g)?> {
            type State = $State<$($g)?>;

            fn card(&self) -> &'static $crate::effects::card::Card {
                match self { $($Set::$Variant(_) => $card),* }
            }

            fn start(&self) -> Option<Self::State> {
                match self {
                    $($Set::$Variant(_) => {
                        (size_of::<<$Type as $crate::effects::Hooks<$n>>::State>() > 0)
                            .then(|| $State::$Variant($crate::effects::State::<$n>::start()))
                    })*
                }
            }

            fn settles_contact(&self) -> bool {
                match self { $($Set::$Variant(_) => <$Type as $crate::effects::Hooks<$n>>::SETTLES_CONTACT),* }
            }

            fn needs(&self) -> $crate::effects::Needs {
                match self { $($Set::$Variant(_) => <$Type as $crate::effects::Hooks<$n>>::NEEDS),* }
            }

            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], speed_drive, SpeedDrive);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], supply, Supply);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], bridge, Bridge);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], winding, Winding);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], shaft, Shaft);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], gear, Gear);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], contact, Contact);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], body, Body);
            $crate::effect_set!(@hook $Set, $State, [$n], [$($Variant, $Type;)*], sense, Sense);

            #[inline]
            fn invert_sensing(
                &self,
                at: &$crate::effects::seams::EffectContext<$n>,
                x: &mut $crate::effects::seams::Sense<$n>,
            ) {
                match self { $($Set::$Variant(e) => $crate::effects::Hooks::<$n>::invert_sensing(e, at, x)),* }
            }

            fn command(
                &self,
                s: &mut [Self::State],
                delivery: Option<$crate::effects::telegram::Delivery>,
                x: &mut $crate::effects::telegram::Command<$n>,
            ) {
                #[allow(unreachable_patterns)]
                match (self, s) {
                    $(($Set::$Variant(e), [$State::$Variant(s)]) => {
                        $crate::effects::Hooks::<$n>::command(e, s, delivery, x);
                    })*
                    _ => {}
                }
            }

            fn restart(&self, s: &mut [Self::State], at: &$crate::effects::seams::EffectContext<$n>) {
                #[allow(unreachable_patterns)]
                match (self, s) {
                    $(($Set::$Variant(e), [$State::$Variant(s)]) => $crate::effects::Hooks::<$n>::restart(e, s, at),)*
                    _ => {}
                }
            }

            fn advance(
                &self,
                s: &mut [Self::State],
                at: &$crate::effects::seams::EffectContext<$n>,
                done: &$crate::effects::seams::StepOutcome<$n>,
            ) {
                #[allow(unreachable_patterns)]
                match (self, s) {
                    $(($Set::$Variant(e), [$State::$Variant(s)]) => {
                        $crate::effects::Hooks::<$n>::advance(e, s, at, done);
                    })*
                    _ => {}
                }
            }
        }
    };
    (@hook $Set:ident, $State:ident, [$n:ty], [$($Variant:ident, $Type:ty;)*], $hook:ident, $Seam:ident) => {
        #[inline]
        fn $hook(
            &self,
            s: &[Self::State],
            at: &$crate::effects::seams::EffectContext<$n>,
            x: &mut $crate::effects::seams::$Seam<$n>,
        ) {
            match self {
                $($Set::$Variant(e) => {
                    let own = $crate::effects::State::<$n>::in_slot(s, |s| match s {
                        $State::$Variant(s) => Some(s),
                        #[allow(unreachable_patterns)]
                        _ => None,
                    });
                    if let Some(own) = own {
                        $crate::effects::Hooks::<$n>::$hook(e, own, at, x);
                    }
                })*
            }
        }
    };
}

/// Makes of the list of effects, in signal order: their kinds, their cards, and the effects with their parameters.
macro_rules! catalogue {
    ($($stage:ident::$file:ident::$Name:ident),* $(,)?) => {
        /// Which effect, without its parameters.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[allow(missing_docs)]
        pub enum EffectKind { $($Name),* }

        impl EffectKind {
            /// Every effect there is. Their order is that in which effects act at a seam that they share.
            pub const ALL: [EffectKind; [$(stringify!($Name)),*].len()] = [$(EffectKind::$Name),*];

            /// Its page as data.
            pub const fn card(self) -> &'static Card {
                match self { $(EffectKind::$Name => &$stage::$file::CARD),* }
            }

            /// Where it sits. Like the next ones it is here without the page, which a robot has no room for.
            pub const fn scope(self) -> Scope {
                match self { $(EffectKind::$Name => const { $stage::$file::CARD.scope }),* }
            }

            /// Its first seam.
            pub const fn home(self) -> Seam {
                match self { $(EffectKind::$Name => const { $stage::$file::CARD.seams[0] }),* }
            }

            /// True if a robot's controller undoes it: in every turn, or by a model that counts it in.
            pub const fn undone(self) -> bool {
                match self { $(EffectKind::$Name => const { $stage::$file::CARD.undone.possible() }),* }
            }

            /// Where in every turn it undoes it.
            pub const fn undone_at(self) -> Option<Place> {
                match self { $(EffectKind::$Name => <$stage::$file::$Name<f32> as Hooks<f32>>::UNDONE_AT),* }
            }

            /// The effect with these parameters, in the card's order; `None` where they are not as many.
            pub fn with<T: Real>(self, params: &[T]) -> Option<Effect<T>> {
                match self {
                    $(EffectKind::$Name => $stage::$file::$Name::of(params).map(Effect::$Name)),*
                }
            }
        }

        effect_set! {
            /// An effect with its parameters.
            pub enum Effect, EffectState [T: Real] [T] {
                $($Name($stage::$file::$Name<T>, &$stage::$file::CARD)),*
            }
        }

        impl<T: Real> Effect<T> {
            /// Which one it is.
            pub const fn kind(&self) -> EffectKind {
                match self { $(Effect::$Name(_) => EffectKind::$Name),* }
            }

            /// [`Hooks::fold_wheel`]
            pub fn fold_wheel(&self, x: &mut Contact<T>) {
                match self { $(Effect::$Name(e) => e.fold_wheel(x)),* }
            }

            /// [`Hooks::fold_mass`]
            pub fn fold_mass(&self, mass: &mut [[T; 3]; 3]) {
                match self { $(Effect::$Name(e) => e.fold_mass(mass)),* }
            }

            /// [`Hooks::fold_reading`]
            pub fn fold_reading(&self, speed: &mut T) {
                match self { $(Effect::$Name(e) => e.fold_reading(speed)),* }
            }

            /// [`Hooks::undo_body`]
            #[inline]
            pub fn undo_body(&self, motion: &BodyMotion<T>, force: &mut [T; 3]) {
                match self { $(Effect::$Name(e) => e.undo_body(motion, force)),* }
            }

            /// [`Hooks::undo_rollers`] of all wheels that it sits on.
            #[inline]
            pub fn undo_rollers<const N: usize>(&self, wheels: Wheels, speed: &[T; N], force: &mut [T; N]) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_rollers(speed[j], &mut force[j]))),* }
            }

            /// [`Hooks::undo_shaft`] of all wheels that it sits on.
            #[inline]
            pub fn undo_shaft<const N: usize>(
                &self,
                wheels: Wheels,
                motion: &[RimMotion<T>; N],
                torque: &mut [T; N],
            ) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_shaft(&motion[j], &mut torque[j]))),* }
            }

            /// [`Hooks::undo_contact`] of all wheels that it sits on.
            #[inline]
            pub fn undo_contact<const N: usize>(&self, wheels: Wheels, traction: &[T; N], slip: &mut [T; N]) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_contact(traction[j], &mut slip[j]))),* }
            }

            /// [`Hooks::undo_gear`] of all wheels that it sits on.
            #[inline]
            pub fn undo_gear<const N: usize>(
                &self,
                wheels: Wheels,
                torque: &[T; N],
                wheel_speed: &[T; N],
                ratio: &mut [T; N],
            ) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_gear(torque[j], wheel_speed[j], &mut ratio[j]))),* }
            }

            /// [`Hooks::undo_winding`] of all wheels that it sits on.
            #[inline]
            pub fn undo_winding<const N: usize>(&self, wheels: Wheels, current: &[T; N], ratio: &mut [T; N]) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_winding(current[j], &mut ratio[j]))),* }
            }

            /// [`Hooks::undo_bridge`] of all wheels that it sits on.
            #[inline]
            pub fn undo_bridge<const N: usize>(
                &self,
                wheels: Wheels,
                demand: &[BridgeDemand<T>; N],
                voltage: &mut [T; N],
            ) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_bridge(&demand[j], &mut voltage[j]))),* }
            }

            /// [`Hooks::bridge_room`]
            #[inline]
            pub fn bridge_room(&self, room: &mut BridgeRoom<T>) {
                match self { $(Effect::$Name(e) => e.bridge_room(room)),* }
            }

            /// [`Hooks::undo_reading`] of all wheels that it sits on.
            #[inline]
            pub fn undo_reading<const N: usize>(&self, wheels: Wheels, current: &mut [T; N]) {
                match self { $(Effect::$Name(e) => wheels.each::<N>(|j| e.undo_reading(&mut current[j]))),* }
            }
        }

        $(impl<T: Real> From<$stage::$file::$Name<T>> for Effect<T> {
            fn from(effect: $stage::$file::$Name<T>) -> Self {
                Effect::$Name(effect)
            }
        })*
    };
}
