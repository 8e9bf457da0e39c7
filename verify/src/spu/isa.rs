//! The SPU's instructions: on which of its two pipes each is issued, and after how many cycles its result can be used.
//!
//! Figures are those of IBM's SDK 3.0 tutorial and of GCC's machine description, class by class. Left out are instructions
//! that the tracer's kernels do not need: double precision (which halts all issue for 6 cycles), multiplication of integers,
//! and operations on bytes.

/// Where an instruction is issued.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pipe {
    /// Arithmetic.
    Even,
    /// Memory, shuffles, branches.
    Odd,
}

/// Instructions that share pipe and latency.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// Single precision.
    Float,
    /// Conversion between single precision and integers, and interpolation.
    Convert,
    /// Integers, logic, compares, selection.
    Fixed,
    /// Shifts and rotations of words.
    Shift,
    /// Loads and stores of quadwords.
    Memory,
    /// Shuffles and rotations of quadwords, gathering of bits, estimates.
    Shuffle,
    /// Branches.
    Branch,
    /// Hints for branches.
    Hint,
    /// Channels, by which transfers are started.
    Channel,
}

impl Class {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Float,
        Self::Convert,
        Self::Fixed,
        Self::Shift,
        Self::Memory,
        Self::Shuffle,
        Self::Branch,
        Self::Hint,
        Self::Channel,
    ];

    /// Its pipe.
    #[must_use]
    pub const fn pipe(self) -> Pipe {
        match self {
            Self::Float | Self::Convert | Self::Fixed | Self::Shift => Pipe::Even,
            Self::Memory | Self::Shuffle | Self::Branch | Self::Hint | Self::Channel => Pipe::Odd,
        }
    }

    /// Cycles from issue until the result can be used.
    #[must_use]
    pub const fn latency(self) -> u64 {
        match self {
            Self::Fixed => 2,
            Self::Shift | Self::Shuffle | Self::Branch => 4,
            Self::Float | Self::Memory | Self::Channel => 6,
            Self::Convert => 7,
            Self::Hint => 15,
        }
    }
}

/// An instruction by its mnemonic. Forms that differ in where an operand comes from (`a`, `ai`) are one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the mnemonics are IBM's")]
pub enum Op {
    Fa,
    Fs,
    Fm,
    Fma,
    Fnms,
    Fi,
    Cflts,
    Csflt,
    A,
    And,
    Or,
    Nor,
    Xor,
    Selb,
    Ceq,
    Cgt,
    Fcgt,
    Shl,
    Rotm,
    Lqx,
    Stqx,
    Shufb,
    Rotqby,
    Gb,
    Frest,
    Frsqest,
    Brnz,
    Hbr,
    Wrch,
}

impl Op {
    /// The class it belongs to.
    #[must_use]
    pub const fn class(self) -> Class {
        match self {
            Self::Fa | Self::Fs | Self::Fm | Self::Fma | Self::Fnms => Class::Float,
            Self::Fi | Self::Cflts | Self::Csflt => Class::Convert,
            Self::A
            | Self::And
            | Self::Or
            | Self::Nor
            | Self::Xor
            | Self::Selb
            | Self::Ceq
            | Self::Cgt
            | Self::Fcgt => Class::Fixed,
            Self::Shl | Self::Rotm => Class::Shift,
            Self::Lqx | Self::Stqx => Class::Memory,
            Self::Shufb | Self::Rotqby | Self::Gb | Self::Frest | Self::Frsqest => Class::Shuffle,
            Self::Brnz => Class::Branch,
            Self::Hbr => Class::Hint,
            Self::Wrch => Class::Channel,
        }
    }
}
