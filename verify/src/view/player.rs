//! Which frame of an animation is shown, as time goes by. In: how many frames there are, how many a second, and what time has passed. Out: the
//! number of a frame. The last is followed by the first.

use std::time::Duration;

/// Slowest and fastest, as powers of two of the animation's own speed.
const SPEEDS: [i32; 2] = [-5, 5];

/// An animation that plays or stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Player {
    frames: usize,
    fps: f64,
    /// Where it is, in frames from the first.
    at: f64,
    /// Power of two by which it is faster than `fps`.
    speed: i32,
    /// Whether it plays.
    pub playing: bool,
}

impl Player {
    /// Of so many frames, at least one, that shows a frame and plays so many a second.
    #[must_use]
    pub fn new(frames: usize, frame: usize, fps: f64) -> Self {
        let frames = frames.max(1);
        Self { frames, fps, at: (frame % frames) as f64, speed: 0, playing: true }
    }

    /// The number of the frame that is shown.
    #[must_use]
    pub fn frame(&self) -> usize {
        // Rounding may bring a position to the very end, which is the beginning.
        (self.at as usize) % self.frames
    }

    /// How many there are.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Lets time pass; nothing happens if it stands still.
    pub fn advance(&mut self, time: Duration) {
        if self.playing {
            let moved = time.as_secs_f64() * self.fps * self.speed();
            self.at = (self.at + moved).rem_euclid(self.frames as f64);
        }
    }

    /// Goes to the next frame, or with a negative number back, and stands still there.
    pub fn step(&mut self, by: i64) {
        self.playing = false;
        self.turn(by);
    }

    /// Goes on by so many frames, playing or not.
    pub fn turn(&mut self, by: i64) {
        let frames = i64::try_from(self.frames).unwrap_or(i64::MAX);
        let frame = i64::try_from(self.frame()).unwrap_or(0);
        self.at = (frame + by % frames).rem_euclid(frames) as f64;
    }

    /// Twice as fast, or with a negative number half as fast, that many times; within a 32nd and 32 times.
    pub fn faster(&mut self, by: i32) {
        self.speed = self.speed.saturating_add(by).clamp(SPEEDS[0], SPEEDS[1]);
    }

    /// How many times as fast as its own speed.
    #[must_use]
    pub fn speed(&self) -> f64 {
        f64::from(self.speed).exp2()
    }
}
