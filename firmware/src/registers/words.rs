//! # Words: what goes into a register, field by field
//!
//! A register is an empty type, and every [`Field`] and every [`Word`] is of one register. So the compiler refuses a field in the
//! word of another register, and the board a word that is another register's. A value that is too large for its field, and a
//! field that is set twice, stop the build of a constant.
//!
//! ```compile_fail,E0308
//! use firmware::registers::words::{Field, Word};
//! enum Cr1 {}
//! enum Bdtr {}
//! const MOE: Field<Bdtr> = Field::at(15, 1);
//! const CR1: Word<Cr1> = Word::ZERO.with(MOE, 1);
//! ```
//!
//! ```compile_fail,E0080
//! use firmware::registers::words::{Field, Word};
//! enum Cr1 {}
//! const CMS: Field<Cr1> = Field::at(5, 2);
//! const CR1: Word<Cr1> = Word::ZERO.with(CMS, 4);
//! # let _ = CR1.bits();
//! ```

use core::marker::PhantomData;
use core::ops::BitOr;

/// Neighbouring bits of register `R` that mean something together.
pub struct Field<R> {
    lowest: u32,
    bits: u32,
    register: PhantomData<R>,
}

impl<R> Field<R> {
    /// So many bits from the lowest one on.
    ///
    /// # Panics
    /// Where they are not all among the register's 32; in a constant that stops the build.
    pub const fn at(lowest: u32, bits: u32) -> Self {
        assert!(bits > 0 && lowest + bits <= u32::BITS, "a field lies within its register");
        Self { lowest, bits, register: PhantomData }
    }

    const fn mask(&self) -> u32 {
        (u32::MAX >> (u32::BITS - self.bits)) << self.lowest
    }
}

/// All of register `R`.
pub struct Word<R> {
    bits: u32,
    register: PhantomData<R>,
}

impl<R> Clone for Word<R> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for Word<R> {}

impl<R> Word<R> {
    /// Every field is zero.
    pub const ZERO: Self = Self::held(0);

    /// What a register was found to hold.
    #[inline(always)]
    pub const fn held(bits: u32) -> Self {
        Self { bits, register: PhantomData }
    }

    /// This word, and a field that was zero with this value.
    ///
    /// # Panics
    /// Where the field has fewer bits than the value, or is set already; in a constant that stops the build.
    #[inline(always)]
    pub const fn with(self, field: Field<R>, value: u32) -> Self {
        assert!(value <= field.mask() >> field.lowest, "the value is larger than its field");
        assert!(self.bits & field.mask() == 0, "the field is set already");
        Self::held(self.bits | (value << field.lowest))
    }

    /// These fields filled with ones, all others zero: flags.
    ///
    /// # Panics
    /// Where two of them overlap; in a constant that stops the build.
    pub const fn ones<const N: usize>(fields: [Field<R>; N]) -> Self {
        let (mut bits, mut at) = (0, 0);
        while at < N {
            assert!(bits & fields[at].mask() == 0, "the field is set already");
            bits |= fields[at].mask();
            at += 1;
        }
        Self::held(bits)
    }

    /// This word, and a field zero.
    #[inline(always)]
    pub const fn without(self, field: Field<R>) -> Self {
        Self::held(self.bits & !field.mask())
    }

    /// True if a field is not zero.
    #[inline(always)]
    pub const fn has(self, field: Field<R>) -> bool {
        self.bits & field.mask() != 0
    }

    /// As a number.
    #[inline(always)]
    pub const fn bits(self) -> u32 {
        self.bits
    }
}

/// The ones of both. For words that come together when the program runs, where nothing panics.
impl<R> BitOr for Word<R> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self::held(self.bits | other.bits)
    }
}
