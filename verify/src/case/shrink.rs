//! Makes a failing case small: first the scene, then the picture down to one ray, then its numbers rounder.
//!
//! In: a case and a question that it answers with yes, "does it still fail?". Out: a case that does, in which, as far as the budget of
//! questions went, no frame, sphere or pixel can be left out and no number made rounder without its failing to fail. Greedy and without
//! chance: the same case shrinks the same way.

use super::{Asked, Case};
use contract::{Animation, Camera, Scene, Size, Sphere};
use optimized::Level;

/// A case in parts that need not be valid.
#[derive(Clone, Debug)]
struct Parts {
    frames: Vec<Vec<Sphere>>,
    background: [u8; 3],
    light: [f32; 3],
    /// Eye, corner, du, dv.
    camera: [[f32; 3]; 4],
    size: [u32; 2],
    asked: Asked,
}

impl Parts {
    fn of(case: &Case) -> Self {
        let (scenes, camera) = (case.frames.frames(), case.camera);
        Self {
            frames: scenes.iter().map(|scene| scene.spheres().to_vec()).collect(),
            background: scenes[0].background(),
            light: scenes[0].light(),
            camera: [camera.eye(), camera.corner(), camera.du(), camera.dv()],
            size: [camera.size().width(), camera.size().height()],
            asked: case.asked.clone(),
        }
    }

    /// The case, if the contract accepts it.
    fn case(&self, like: &Case) -> Option<Case> {
        let scene = |spheres: &Vec<Sphere>| Scene::new(spheres.clone(), self.background, self.light).ok();
        let frames = self.frames.iter().map(scene).collect::<Option<Vec<_>>>()?;
        let [eye, corner, du, dv] = self.camera;
        let size = Size::new(self.size[0], self.size[1]).ok()?;
        Some(Case {
            frames: Animation::new(frames).ok()?,
            camera: Camera::new(eye, corner, du, dv, size).ok()?,
            asked: self.asked.clone(),
            pixel: None,
            ..like.clone()
        })
    }

    /// The numbers of camera and spheres.
    fn numbers(&mut self) -> Vec<&mut f32> {
        let spheres = self.frames.iter_mut().flatten();
        let spheres = spheres.flat_map(|s| s.center.iter_mut().chain([&mut s.radius]));
        self.camera.iter_mut().flatten().chain(spheres).collect()
    }
}

struct Shrinking<'a> {
    original: &'a Case,
    best: Parts,
    fails: &'a dyn Fn(&Case) -> bool,
    left: u32,
}

/// A smaller case for which `fails` still says yes, after at most so many questions.
#[must_use]
pub fn shrink(case: &Case, budget: u32, fails: &dyn Fn(&Case) -> bool) -> Case {
    let mut shrinking = Shrinking { original: case, best: Parts::of(case), fails, left: budget };
    loop {
        let before = shrinking.left;
        let changed = [
            shrinking.frames(),
            shrinking.spheres(),
            shrinking.tracer(),
            shrinking.picture(),
            shrinking.numbers(),
        ];
        if changed == [false; 5] || before == shrinking.left || shrinking.left == 0 {
            break;
        }
    }
    // Nothing was found smaller than the case: it is given as it came.
    shrinking.best.case(case).filter(|small| fails(small)).unwrap_or_else(|| case.clone())
}

impl Shrinking<'_> {
    /// Takes a change if the case still fails with it.
    fn try_with(&mut self, change: impl FnOnce(&mut Parts)) -> bool {
        if self.left == 0 {
            return false;
        }
        let mut parts = self.best.clone();
        change(&mut parts);
        let Some(case) = parts.case(self.original) else { return false };
        self.left -= 1;
        let fails = (self.fails)(&case);
        if fails {
            self.best = parts;
        }
        fails
    }

    fn frames(&mut self) -> bool {
        let (mut changed, mut i) = (false, 0);
        while self.best.frames.len() > 1 && i < self.best.frames.len() {
            if self.try_with(|parts| drop(parts.frames.remove(i))) {
                changed = true;
            } else {
                i += 1;
            }
        }
        changed
    }

    /// Leaves out halves, quarters, … of the ids, in all frames.
    fn spheres(&mut self) -> bool {
        let longest = |parts: &Parts| parts.frames.iter().map(Vec::len).max().unwrap_or(0);
        let (mut changed, mut run) = (false, longest(&self.best).div_ceil(2));
        while run > 0 {
            let mut from = 0;
            while from < longest(&self.best) {
                let cut = |parts: &mut Parts| {
                    for frame in &mut parts.frames {
                        let to = (from + run).min(frame.len());
                        frame.drain(from.min(to)..to);
                    }
                };
                if self.try_with(cut) {
                    changed = true;
                } else {
                    from += run;
                }
            }
            run /= 2;
        }
        changed
    }

    /// One worker, plain lanes.
    fn tracer(&mut self) -> bool {
        let Asked::Grid { plan, level, workers } = self.best.asked else { return false };
        let alone =
            workers > 1 && self.try_with(|parts| parts.asked = Asked::Grid { plan, level, workers: 1 });
        let Asked::Grid { workers, .. } = self.best.asked else { return alone };
        let plain = level.name() != Level::SCALAR.name()
            && self.try_with(|parts| parts.asked = Asked::Grid { plan, level: Level::SCALAR, workers });
        alone || plain
    }

    /// Cuts away columns and rows, from the right and below without touching a number, from the left and above by moving the corner.
    fn picture(&mut self) -> bool {
        let mut changed = false;
        for axis in 0..2 {
            let mut step = self.best.size[axis] / 2;
            while step > 0 {
                let shorter = |parts: &mut Parts| parts.size[axis] -= step;
                let moved = |parts: &mut Parts| {
                    parts.size[axis] -= step;
                    let along = parts.camera[2 + axis];
                    for (corner, d) in parts.camera[1].iter_mut().zip(along) {
                        *corner += step as f32 * d;
                    }
                };
                if self.best.size[axis] > step && (self.try_with(shorter) || self.try_with(moved)) {
                    changed = true;
                } else {
                    step /= 2;
                }
            }
        }
        changed
    }

    /// Makes numbers rounder: 0, ±1, whole, then with as few bits as can be.
    fn numbers(&mut self) -> bool {
        let (mut changed, count) = (false, self.best.numbers().len());
        for i in 0..count {
            let now = *self.best.numbers()[i];
            for rounder in rounder(now) {
                if self.try_with(|parts| *parts.numbers()[i] = rounder) {
                    changed = true;
                    break;
                }
            }
        }
        changed
    }
}

/// Rounder numbers than x, the roundest first.
fn rounder(x: f32) -> Vec<f32> {
    let bits = |keep: u32| f32::from_bits(x.to_bits() >> (23 - keep) << (23 - keep));
    let candidates =
        [0.0, 1f32.copysign(x), bits(0), bits(1), x.trunc(), bits(3), bits(6), bits(10), bits(15), bits(19)];
    let cost = |x: f32| {
        if x == 0.0 { 0 } else { 1 + u32::from(x.abs() != 1.0) + 24 - x.to_bits().trailing_zeros().min(23) }
    };
    candidates.into_iter().filter(|y| cost(*y) < cost(x)).collect()
}
