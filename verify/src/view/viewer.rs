//! A view without a window: commands go in, a canvas comes out. A frame is traced when something of it has changed, and only what is shown is
//! computed.

use super::canvas::Canvas;
use super::clock::{Limit, Run, Split};
use super::command::{Command, Overlay, help};
use super::orbit::{Move, Orbit};
use super::overlay::heat::{self, Quantity};
use super::overlay::wrong::Marked;
use super::overlay::{blocks, fallback, times, wrong};
use super::player::Player;
use super::state::State;
use super::tally::tally;
use super::text::{Corner, Line, panel};
use crate::bench::ours::chosen;
use crate::scenes::frame::{FramingError, middle};
use crate::subject::NamedPlan;
use contract::{Animation, Camera, Scene, Size};
use optimized::frame::Rendering;
use optimized::plan::Arithmetic;
use optimized::{Level, Plan, RenderError, Session, Tracer};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Why nothing can be shown.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ViewError {
    /// The tracer refuses.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// There is no such camera.
    #[error(transparent)]
    Framing(#[from] FramingError),
}

/// What of a view a frame depends on; the same again need not be traced again.
#[derive(Clone, Debug, PartialEq)]
struct Shown {
    frame: usize,
    camera: Camera,
    plan: Plan,
    level: &'static str,
    threads: usize,
    overlays: Vec<Overlay>,
    /// The column of the wipe.
    column: Option<u32>,
}

/// A scene as it plays.
pub struct Viewer {
    name: String,
    animation: Animation,
    /// Which frame.
    pub player: Player,
    /// From where.
    pub orbit: Orbit,
    /// By which plan, and with which overlays.
    pub state: State,
    tracers: Tracers,
    base: Canvas,
    screen: Canvas,
    shown: Option<Shown>,
    split: Split,
    /// What writing the words of [`Viewer::write`] took.
    words: Duration,
    wrong: Option<wrong::Wrong>,
    /// Of the last frames that were shown, when each was finished.
    finished: Vec<Instant>,
}

/// Whoever traces, each kept while nothing about it changes.
#[derive(Default)]
struct Tracers {
    shown: Kept,
    paper: Kept,
    exact: Kept,
}

#[derive(Default)]
struct Kept(Option<Session>);

impl Kept {
    fn render(
        &mut self,
        plan: Plan,
        (level, workers): (Level, usize),
        scene: &Scene,
        camera: &Camera,
    ) -> Result<&Rendering, RenderError> {
        let same = |kept: &&Session| {
            (kept.plan(), kept.level().name(), kept.workers()) == (plan, level.name(), workers)
        };
        if self.0.as_ref().filter(same).is_none() {
            self.0 = Some(Tracer::new(plan, level).workers(workers).session()?);
        }
        self.0.as_mut().expect("it was just made").render(scene, camera)
    }
}

impl Viewer {
    /// A view of an animation that begins with a camera and, if it is not what is up in that camera's picture, the axis that is up.
    #[must_use]
    pub fn new(
        name: &str,
        animation: Animation,
        camera: Camera,
        up: Option<[f64; 3]>,
        player: Player,
        state: State,
    ) -> Self {
        let middle = middle(animation.frames().iter().flat_map(Scene::spheres));
        Self {
            name: name.into(),
            player,
            animation,
            orbit: Orbit::new(camera, middle, up),
            state,
            tracers: Tracers::default(),
            base: Canvas::new(camera.size()),
            screen: Canvas::new(camera.size()),
            shown: None,
            split: Split::default(),
            words: Duration::ZERO,
            wrong: None,
            finished: Vec::new(),
        }
    }

    /// Does what is asked; whether that is not to end.
    pub fn command(&mut self, command: Command) -> bool {
        match command {
            Command::Pause => self.player.playing = !self.player.playing,
            Command::Step(by) => self.player.step(by),
            Command::Faster(by) => self.player.faster(by),
            Command::Camera(by) => _ = self.orbit.go(by),
            Command::Plan => self.state.next_plan(),
            Command::Arithmetic => self.state.next_arithmetic(),
            Command::Level => self.state.next_level(),
            Command::Threads(by) => self.state.more_threads(by),
            Command::Overlay(overlay) => self.state.toggle(overlay),
            Command::Wipe => self.state.wiped = !self.state.wiped,
            Command::MoveWipe(by) => self.state.move_line(self.state.line() + by / 100.0),
            Command::Quit => return false,
        }
        true
    }

    /// The mouse was dragged by so many pixels, with the left button or else the right one, beginning at a column.
    pub fn drag(&mut self, by: [f64; 2], left: bool, on_line: bool) {
        let width = f64::from(self.size().width());
        let [x, y] = by;
        if left && on_line {
            self.state.move_line(self.state.line() + x / width);
        } else if left {
            // Half a turn from edge to edge.
            _ = self.orbit.go(Move::Orbit([-180.0 * x / width, 180.0 * y / width]));
        } else {
            _ = self.orbit.go(Move::Pan([x, y]));
        }
    }

    /// The wheel was turned by so many steps, away from who turns it: the scene comes nearer.
    pub fn wheel(&mut self, steps: f64) {
        _ = self.orbit.go(Move::Zoom(steps.clamp(-8.0, 8.0)));
    }

    /// Whether a column is so near to the line of the wipe that a drag moves it.
    #[must_use]
    pub fn on_line(&self, x: f64) -> bool {
        let line = self.state.line() * f64::from(self.size().width());
        self.state.wiped && (x - line).abs() <= 12.0
    }

    /// Pixels of what is shown.
    #[must_use]
    pub fn size(&self) -> Size {
        self.orbit.size()
    }

    /// The plan that the frame in view is traced by.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.state.plan_for(self.scene())
    }

    /// The frame in view.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.animation.frames()[self.player.frame()]
    }

    /// Who traced what was drawn last: of the wipe the exact plan's and the paper's, else the plan's.
    #[must_use]
    pub fn sessions(&self) -> Vec<&Session> {
        let Tracers { shown, paper, exact } = &self.tracers;
        let wiped = self.shown.as_ref().is_some_and(|shown| shown.column.is_some());
        let traced = if wiped { vec![exact, paper] } else { vec![shown] };
        traced.into_iter().filter_map(|kept| kept.0.as_ref()).collect()
    }

    /// Where the time of the last frame went.
    #[must_use]
    pub fn split(&self) -> Split {
        Split { overlay: self.split.overlay + self.words, ..self.split }
    }

    /// How many pixels of the last frame differed from the exact ones, if that was asked.
    #[must_use]
    pub fn wrong(&self) -> Option<wrong::Wrong> {
        self.wrong
    }

    /// The window took so long with what was drawn last.
    pub fn presented(&mut self, window: Duration) {
        self.split.window = window;
        if self.finished.len() == 32 {
            self.finished.remove(0);
        }
        self.finished.push(Instant::now());
    }

    /// Frames a second, of the last ones that were shown.
    #[must_use]
    pub fn fps(&self) -> f64 {
        match (self.finished.first(), self.finished.last()) {
            (Some(first), Some(last)) if last > first => {
                (self.finished.len() - 1) as f64 / last.duration_since(*first).as_secs_f64()
            }
            _ => 0.0,
        }
    }

    /// What a window is called: scene, plan, level, threads, frames a second.
    #[must_use]
    pub fn title(&self) -> String {
        let State { threads, .. } = self.state;
        let plan = if self.state.wiped { "paper | exact".into() } else { self.state.words() };
        format!(
            "{} | {plan} | {} | {threads} threads | {:.0} fps | H: keys",
            self.name,
            self.state.level(),
            self.fps()
        )
    }

    /// What the next frame would depend on.
    fn wanted(&self) -> Result<Shown, ViewError> {
        let camera = self.orbit.camera()?;
        Ok(Shown {
            frame: self.player.frame(),
            camera,
            plan: self.plan(),
            level: self.state.level().name(),
            threads: self.state.threads,
            overlays: self.state.overlays.iter().copied().collect(),
            column: self.state.wiped.then(|| self.state.column(camera.size().width())),
        })
    }

    /// Draws what is to be seen now, if it is not what was drawn last; whether anything was drawn.
    ///
    /// # Errors
    /// [`ViewError`] if there is no picture.
    pub fn draw(&mut self) -> Result<bool, ViewError> {
        let wanted = self.wanted()?;
        if self.shown.as_ref() == Some(&wanted) {
            return Ok(false);
        }
        self.shown = None;
        self.trace(&wanted)?;
        self.shown = Some(wanted);
        Ok(true)
    }

    /// What is to be shown.
    #[must_use]
    pub fn canvas(&self) -> &Canvas {
        if self.has_words() { &self.screen } else { &self.base }
    }

    fn has_words(&self) -> bool {
        [Overlay::Times, Overlay::Help].into_iter().any(|overlay| self.state.shows(overlay))
    }

    fn trace(&mut self, wanted: &Shown) -> Result<(), ViewError> {
        let Shown { camera, plan, threads, .. } = wanted;
        let scene = &self.animation.frames()[wanted.frame];
        let how = (self.state.level(), *threads);
        let exact = chosen(NamedPlan::Fast, scene).plan;
        let mut split = Split::default();
        let width = camera.size().width();
        let mut lines = Vec::new();
        self.wrong = None;
        if let Some(column) = wanted.column {
            let truth = self.tracers.exact.render(exact, how, scene, camera)?;
            let paper = self.tracers.paper.render(Plan::paper(), how, scene, camera)?;
            split.build = truth.times.build + paper.times.build;
            split.trace = truth.times.trace + paper.times.trace;
            let start = Instant::now();
            self.base.take(&paper.image, 0..column);
            self.base.take(&truth.image, column..width);
            split.copy = start.elapsed();
            let start = Instant::now();
            // The paper's t is rounded almost everywhere; that would leave nothing of its picture.
            let marked = if self.state.shows(Overlay::Wrong) { Marked::All } else { Marked::Spheres };
            let wrong = wrong::draw(&mut self.base, &truth.image, &paper.image, column, marked);
            lines.extend(wrong::words(&wrong, "the paper's plan (left)", camera.size().pixels(), marked));
            self.wrong = Some(wrong);
            line(&mut self.base, column);
            split.overlay += start.elapsed();
        } else {
            let shown = self.tracers.shown.render(*plan, how, scene, camera)?;
            (split.build, split.trace) = (shown.times.build, shown.times.trace);
            let start = Instant::now();
            self.base.take(&shown.image, 0..width);
            split.copy = start.elapsed();
        }
        let start = Instant::now();
        self.packets(wanted, &mut lines)?;
        if self.state.shows(Overlay::Wrong) && wanted.column.is_none() {
            let scene = &self.animation.frames()[wanted.frame];
            let shown = self.tracers.shown.render(*plan, how, scene, camera)?;
            let truth = self.tracers.exact.render(exact, how, scene, camera)?;
            let wrong = wrong::draw(&mut self.base, &truth.image, &shown.image, width, Marked::All);
            lines.extend(wrong::words(&wrong, &self.state.words(), camera.size().pixels(), Marked::All));
            if plan.arithmetic == Arithmetic::Certified && plan.packet == exact.packet {
                lines.push(Line::from("(this is the exact plan itself; P shows others)".to_owned()));
            }
            self.wrong = Some(wrong);
        }
        if !lines.is_empty() {
            panel(&mut self.base, Corner::BottomLeft, &lines);
        }
        split.overlay += start.elapsed();
        self.split = Split { window: self.split.window, ..split };
        Ok(())
    }

    /// The overlays that are of packets: of the plan shown, of the wipe of none.
    fn packets(&mut self, wanted: &Shown, lines: &mut Vec<Line>) -> Result<(), ViewError> {
        if wanted.column.is_some() {
            return Ok(());
        }
        let scene = &self.animation.frames()[wanted.frame];
        let plan = &wanted.plan;
        let inside = [Overlay::Cells, Overlay::Culling, Overlay::Lanes];
        if inside.into_iter().any(|overlay| self.state.shows(overlay)) {
            let tally = tally(*plan, wanted.threads, scene, &wanted.camera)?;
            for (overlay, quantity) in
                [(Overlay::Cells, Quantity::Cells), (Overlay::Culling, Quantity::Culled)]
            {
                if self.state.shows(overlay) {
                    lines.extend(heat::draw(&mut self.base, &tally, quantity, plan));
                }
            }
            if self.state.shows(Overlay::Lanes) {
                lines.extend(fallback::draw(&mut self.base, &tally, plan));
            }
        }
        if self.state.shows(Overlay::Blocks) {
            lines.extend(blocks::draw(&mut self.base, plan, wanted.threads));
        }
        Ok(())
    }

    /// Writes times and keys over what was drawn, if they are shown, and whether they are; they change though nothing else does.
    pub fn write(&mut self) -> bool {
        if !self.has_words() {
            self.words = Duration::ZERO;
            return false;
        }
        let start = Instant::now();
        self.screen.copy(&self.base);
        if self.state.shows(Overlay::Times) {
            let frame = format!("frame {} of {}", self.player.frame(), self.player.frames());
            let speed =
                if self.player.playing { format!("x{}", self.player.speed()) } else { "paused".into() };
            let plan = if self.state.wiped { "paper | exact".into() } else { self.state.words() };
            let spheres = self.scene().spheres().len();
            let head = vec![
                format!("{}, {frame}, {speed}, {spheres} spheres", self.name),
                format!("{plan}, {}, {} threads", self.state.level(), self.state.threads),
                format!("{:.0} frames a second shown", self.fps()),
            ];
            let split = self.split();
            times::draw(&mut self.screen, head, &split);
        }
        if self.state.shows(Overlay::Help) {
            let lines: Vec<Line> = help().into_iter().map(Line::from).collect();
            panel(&mut self.screen, Corner::Middle, &lines);
        }
        self.words = start.elapsed();
        true
    }

    /// Plays frame after frame, each once, without a window, as fast as it can; `tick` is called after each.
    ///
    /// # Errors
    /// [`ViewError`] if a frame cannot be had.
    pub fn run(&mut self, limit: Limit, tick: &dyn Fn()) -> Result<Run, ViewError> {
        let (mut run, start) = (Run::default(), Instant::now());
        while !limit.reached(run.splits.len(), start.elapsed()) {
            self.next(&mut run, |_| Ok::<_, ViewError>(()))?;
            tick();
        }
        run.wall = start.elapsed();
        Ok(run)
    }

    /// Draws the next frame of a run and shows it.
    ///
    /// # Errors
    /// [`ViewError`] if it cannot be had, and whatever showing it says.
    pub fn next<E: From<ViewError>>(
        &mut self,
        run: &mut Run,
        show: impl FnOnce(&Self) -> Result<(), E>,
    ) -> Result<(), E> {
        if !run.splits.is_empty() {
            self.player.turn(1);
        }
        // A scene of one frame is traced anew as well.
        self.shown = None;
        self.draw()?;
        self.write();
        let start = Instant::now();
        show(self)?;
        self.presented(start.elapsed());
        run.splits.push(self.split());
        Ok(())
    }
}

/// The line of the wipe.
fn line(canvas: &mut Canvas, column: u32) {
    for y in 0..canvas.size().height() {
        canvas.put(column, y, [0xFF; 3]);
        for side in [column.checked_sub(1), column.checked_add(1)].into_iter().flatten() {
            canvas.put(side, y, [0; 3]);
        }
    }
}
