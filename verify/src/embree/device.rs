//! The library, loaded at one instruction set and checked: its version is known, it does what it was told, and spheres
//! that are plainly there are found.

use super::canary;
use super::error::EmbreeError;
use super::fault::Fault;
use super::ffi::RawDevice;
use embree4_sys::RTCDeviceProperty as Property;
use std::fmt;
use std::sync::Arc;

/// Versions whose structures are known: 4.2 has those of the headers, 4.3 and 4.4 one field more in a hit.
const KNOWN: [(isize, isize); 3] = [(4, 2), (4, 3), (4, 4)];

/// A version of the library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Version {
    major: isize,
    minor: isize,
    patch: isize,
}

impl Version {
    /// Whether the layout of its structures is known.
    pub(super) fn is_known(self) -> bool {
        KNOWN.contains(&(self.major, self.minor))
    }

    /// Whether its hits have the field that 4.3 added.
    pub(super) fn has_grown(self) -> bool {
        (self.major, self.minor) >= (4, 3)
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}.{}", self.major, self.minor, self.patch)
    }
}

/// An instruction set that Embree has code for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Isa {
    Sse2,
    Sse42,
    Avx,
    Avx2,
    Avx512,
}

impl Isa {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Sse2, Self::Sse42, Self::Avx, Self::Avx2, Self::Avx512];

    /// Its name, which is also Embree's.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sse2 => "sse2",
            Self::Sse42 => "sse4.2",
            Self::Avx => "avx",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Whether this processor has it.
    #[must_use]
    pub fn is_available(self) -> bool {
        match self {
            Self::Sse2 => true,
            Self::Sse42 => is_x86_feature_detected!("sse4.2"),
            Self::Avx => is_x86_feature_detected!("avx"),
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            Self::Avx512 => has_avx512(),
        }
    }

    /// Those that this processor has.
    #[must_use]
    pub fn available() -> Vec<Self> {
        Self::ALL.into_iter().filter(|isa| isa.is_available()).collect()
    }

    /// Whether packets of 8 and of 16 rays fill its registers.
    fn native(self) -> [bool; 2] {
        match self {
            Self::Sse2 | Self::Sse42 => [false, false],
            Self::Avx | Self::Avx2 => [true, false],
            Self::Avx512 => [true, true],
        }
    }
}

/// The parts of AVX-512 that Embree needs.
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512cd")
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512vl")
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Embree at one instruction set, checked.
#[derive(Clone, Debug)]
pub struct Device {
    pub(super) raw: Arc<RawDevice>,
    version: Version,
    isa: Isa,
}

impl Device {
    /// Loads the library and checks it. `threads` build scenes; 0 means one a core.
    ///
    /// # Errors
    /// [`EmbreeError`] for whatever makes its answers worthless.
    pub fn new(isa: Isa, threads: usize) -> Result<Self, EmbreeError> {
        Self::with_fault(isa, threads, Fault::None)
    }

    /// The same with a fault in the checks' own rays.
    ///
    /// # Errors
    /// As [`Device::new`]; with a fault that touches the checks, that they found it.
    pub fn with_fault(isa: Isa, threads: usize, fault: Fault) -> Result<Self, EmbreeError> {
        if !isa.is_available() {
            return Err(EmbreeError::NoIsa(isa));
        }
        let config = format!("isa={isa},threads={threads}");
        let raw = RawDevice::new(&config).map_err(|code| EmbreeError::Call { call: "rtcNewDevice", code })?;
        let part = |property| raw.property(property);
        let version = Version {
            major: part(Property::VERSION_MAJOR),
            minor: part(Property::VERSION_MINOR),
            patch: part(Property::VERSION_PATCH),
        };
        if !version.is_known() {
            return Err(EmbreeError::UnknownVersion(version));
        }
        if part(Property::POINT_GEOMETRY_SUPPORTED) == 0 {
            return Err(EmbreeError::NoSpheres);
        }
        let native =
            [Property::NATIVE_RAY8_SUPPORTED, Property::NATIVE_RAY16_SUPPORTED].map(|p| part(p) != 0);
        let expected = isa.native();
        if native != expected {
            return Err(EmbreeError::IsaIgnored { isa, native, expected });
        }
        let device = Self { raw: Arc::new(raw), version, isa };
        canary::check(&device, fault)?;
        Ok(device)
    }

    /// The library's version, as it says itself.
    #[must_use]
    pub fn version(&self) -> Version {
        self.version
    }

    /// The instruction set it was told to use.
    #[must_use]
    pub fn isa(&self) -> Isa {
        self.isa
    }

    /// Whether this build of the library looks at the masks of rays.
    #[must_use]
    pub fn sees_masks(&self) -> bool {
        self.raw.property(Property::RAY_MASK_SUPPORTED) != 0
    }
}
