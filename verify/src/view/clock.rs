//! Where time went: of a frame its parts, of a run how many frames in how long, and the median of each part.

use std::time::Duration;

/// A frame's parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Split {
    /// Until the grid stood.
    pub build: Duration,
    /// From there to the picture; of two pictures side by side the sum, as of what was built.
    pub trace: Duration,
    /// Onto the canvas.
    pub copy: Duration,
    /// Whatever overlays need beside the frame itself, and drawing them.
    pub overlay: Duration,
    /// Until the window had it.
    pub window: Duration,
}

impl Split {
    /// Each part with its name.
    #[must_use]
    pub fn parts(&self) -> [(&'static str, Duration); 5] {
        [
            ("build", self.build),
            ("trace", self.trace),
            ("copy", self.copy),
            ("overlay", self.overlay),
            ("window", self.window),
        ]
    }

    /// All of it.
    #[must_use]
    pub fn sum(&self) -> Duration {
        self.parts().into_iter().map(|(_, part)| part).sum()
    }
}

/// A run of frames.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Run {
    /// Each frame's parts.
    pub splits: Vec<Split>,
    /// From the beginning of the first to the end of the last.
    pub wall: Duration,
}

impl Run {
    /// Frames in a second.
    #[must_use]
    pub fn fps(&self) -> f64 {
        self.splits.len() as f64 / self.wall.as_secs_f64().max(1e-9)
    }

    /// The median of each part, by itself.
    #[must_use]
    pub fn medians(&self) -> Split {
        let median = |of: fn(&Split) -> Duration| {
            let mut all: Vec<Duration> = self.splits.iter().map(of).collect();
            all.sort_unstable();
            all.get(all.len() / 2).copied().unwrap_or_default()
        };
        Split {
            build: median(|s| s.build),
            trace: median(|s| s.trace),
            copy: median(|s| s.copy),
            overlay: median(|s| s.overlay),
            window: median(|s| s.window),
        }
    }

    /// In words: frames, how many a second, and the medians.
    #[must_use]
    pub fn words(&self) -> String {
        let parts =
            self.medians().parts().map(|(name, part)| format!("{name} {:.3}", part.as_secs_f64() * 1e3));
        format!(
            "{} frames in {:.2} s, {:.1} frames a second; medians in ms: {}",
            self.splits.len(),
            self.wall.as_secs_f64(),
            self.fps(),
            parts.join(", ")
        )
    }
}

/// When a run ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// When whoever looks at it ends it.
    Open,
    /// After so many frames.
    Frames(u64),
    /// After so much time.
    Time(Duration),
}

impl Limit {
    /// Whether a run is over.
    #[must_use]
    pub fn reached(&self, frames: usize, wall: Duration) -> bool {
        match *self {
            Self::Open => false,
            Self::Frames(most) => frames as u64 >= most,
            Self::Time(most) => wall >= most,
        }
    }
}
