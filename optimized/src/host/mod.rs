//! The machines of the host, and which of them this processor has.
//!
//! A [`Level`] is a capability: it can only be had if the processor has it, so what runs at a level needs no further
//! check. [`Level::best`] detects once; the environment variable `CGT_LEVEL` names a lower one.

mod scalar;
mod spu;
#[cfg(target_arch = "x86_64")]
mod truncating;
mod wide;

pub use scalar::Scalar;
pub use spu::Spu;
#[cfg(target_arch = "x86_64")]
pub use truncating::Truncating;
pub use wide::Wide;

use crate::machine::Machine;
use std::fmt;
use thiserror::Error;

/// The variable that names a level.
pub const VARIABLE: &str = "CGT_LEVEL";

/// An instruction set that this processor has.
#[derive(Clone, Copy, Debug)]
pub struct Level(Option<fearless_simd::Level>);

/// What runs on a machine that is chosen at run time.
pub trait Work {
    /// What it gives.
    type Output;

    /// Does it.
    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output;
}

/// Why a level could not be had.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("`{name}` is no level of this processor; it has {}", available.join(", "))]
pub struct NoSuchLevel {
    /// As asked for.
    pub name: String,
    /// What there is.
    pub available: Vec<&'static str>,
}

impl Level {
    /// The plain arrays of [`Scalar`].
    pub const SCALAR: Self = Self(None);

    /// The level that `CGT_LEVEL` names, else the best there is.
    ///
    /// # Errors
    /// [`NoSuchLevel`] if the variable names something else.
    pub fn best() -> Result<Self, NoSuchLevel> {
        match std::env::var_os(VARIABLE) {
            Some(name) => Self::named(&name.to_string_lossy()),
            None => Ok(Self::available().last().copied().unwrap_or(Self::SCALAR)),
        }
    }

    /// All levels of this processor, from plain to wide.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let best = fearless_simd::Level::new();
        let mut levels = vec![Self::SCALAR];
        #[cfg(target_arch = "x86_64")]
        {
            let sse2 = best.as_sse2().map(fearless_simd::Simd::level);
            let sse42 = best.as_sse4_2().map(fearless_simd::Simd::level);
            let avx2 = best.as_avx2().map(fearless_simd::Simd::level);
            let avx512 = best.as_avx512().map(fearless_simd::Simd::level);
            levels.extend([sse2, sse42, avx2, avx512].into_iter().flatten().map(|level| Self(Some(level))));
        }
        #[cfg(not(target_arch = "x86_64"))]
        if !best.is_fallback() {
            levels.push(Self(Some(best)));
        }
        levels
    }

    /// The level of that name.
    ///
    /// # Errors
    /// [`NoSuchLevel`] if this processor has none.
    pub fn named(name: &str) -> Result<Self, NoSuchLevel> {
        let levels = Self::available();
        let found = levels.iter().find(|level| level.name() == name.to_ascii_lowercase());
        found.copied().ok_or_else(|| NoSuchLevel {
            name: name.into(),
            available: levels.iter().map(|level| level.name()).collect(),
        })
    }

    /// Its name: `scalar`, `sse2`, `sse4.2`, `avx2`, `avx512`, `neon` or `simd128`.
    #[must_use]
    pub fn name(self) -> &'static str {
        #[allow(unused_imports, reason = "WebAssembly without SIMD128 has no level of the library's")]
        use fearless_simd::Level as L;
        #[allow(unreachable_patterns, reason = "other targets have other levels")]
        match self.0 {
            None => "scalar",
            #[cfg(target_arch = "x86_64")]
            Some(L::Sse2(_)) => "sse2",
            #[cfg(target_arch = "x86_64")]
            Some(L::Sse4_2(_)) => "sse4.2",
            #[cfg(target_arch = "x86_64")]
            Some(L::Avx2(_)) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Some(L::Avx512(_)) => "avx512",
            #[cfg(target_arch = "aarch64")]
            Some(L::Neon(_)) => "neon",
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Some(L::WasmSimd128(_)) => "simd128",
            Some(_) => "fallback",
        }
    }

    /// Does work on this level's machine.
    pub fn run<W: Work>(self, work: W) -> W::Output {
        #[allow(unused_imports, reason = "WebAssembly without SIMD128 has no level of the library's")]
        use fearless_simd::Level as L;
        #[allow(unreachable_patterns, reason = "other targets have other levels")]
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Some(L::Sse2(simd)) => work.on(Wide(simd)),
            #[cfg(target_arch = "x86_64")]
            Some(L::Sse4_2(simd)) => work.on(Wide(simd)),
            #[cfg(target_arch = "x86_64")]
            Some(L::Avx2(simd)) => work.on(Wide(simd)),
            #[cfg(target_arch = "x86_64")]
            Some(L::Avx512(simd)) => work.on(Wide(simd)),
            #[cfg(target_arch = "aarch64")]
            Some(L::Neon(simd)) => work.on(Wide(simd)),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Some(L::WasmSimd128(simd)) => work.on(Wide(simd)),
            _ => work.on(Scalar),
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
