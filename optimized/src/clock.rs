//! How long something took, where the system has a clock. WebAssembly by itself (`wasm32-unknown-unknown`) has none, and asking for it
//! would end the program: there all times are zero, and who runs the module takes them.

use std::time::{Duration, Instant};

const THERE_IS_ONE: bool = !cfg!(all(target_family = "wasm", target_os = "unknown"));

/// A moment from which time is counted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock(Option<Instant>);

impl Clock {
    /// Now.
    pub(crate) fn start() -> Self {
        Self(THERE_IS_ONE.then(Instant::now))
    }

    /// From then to now; zero without a clock.
    pub(crate) fn elapsed(self) -> Duration {
        self.0.map_or(Duration::ZERO, |start| start.elapsed())
    }
}
