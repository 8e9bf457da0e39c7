//! `cgt view`: a scene in a window or a terminal while it plays, or measured without one.

use super::verify::{load, warn};
use crate::args::Viewer as Args;
use crate::{Failure, progress, say};
use optimized::Level;
use std::process::ExitCode;
use std::time::Duration;
use verify::subject::NamedPlan;
use verify::view::clock::Limit;
use verify::view::player::Player;
use verify::view::state::State;
use verify::view::terminal::{self, Way};
use verify::view::viewer::Viewer;
use verify::view::window;

pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let limit = match (args.frames, args.seconds) {
        (Some(frames), _) => Limit::Frames(frames),
        (None, Some(seconds)) => Limit::Time(Duration::from_secs_f64(seconds)),
        (None, None) => Limit::Open,
    };
    let mut viewer = viewer(args)?;
    let run = match args.terminal.as_deref() {
        Some("blocks") => terminal::show(&mut viewer, limit, Way::Blocks)?,
        Some(_) => terminal::show(&mut viewer, limit, Way::Best)?,
        None if args.no_window => {
            // Time is told in tenths of a second.
            let marks = match limit {
                Limit::Frames(frames) => u32::try_from(frames).unwrap_or(u32::MAX),
                _ => (args.seconds.unwrap_or(0.0) * 10.0) as u32,
            };
            let (bar, begin) = (progress::bar(&args.scene, "frames", marks), std::time::Instant::now());
            let told = std::cell::Cell::new(0);
            viewer.run(limit, &|| {
                let now =
                    if args.frames.is_some() { told.get() + 1 } else { begin.elapsed().as_millis() / 100 };
                (told.get()..now.min(marks.into())).for_each(|_| bar());
                told.set(now);
            })?
        }
        None => window::show(&mut viewer, limit)?,
    };
    if limit != Limit::Open {
        let size = viewer.size();
        say(&format!(
            "{}, {}x{}, {}, {}, {} threads: {}\n",
            args.scene,
            size.width(),
            size.height(),
            viewer.state.words(),
            viewer.state.level(),
            viewer.state.threads,
            run.words()
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn viewer(args: &Args) -> Result<Viewer, Failure> {
    let level = args.level.as_deref().map_or_else(Level::best, Level::named)?;
    let (loaded, _) = load(&args.scene, args.view.frame)?;
    warn(&loaded);
    let wish = args.view.framing();
    let camera = loaded.camera(&wish)?;
    // A file's own camera knows what is up; where one is chosen, something was wished for, or +y.
    let own = loaded.camera.is_some() && wish.is_size();
    let up = wish.or(&loaded.framing.unwrap_or_default()).up.unwrap_or([0.0, 1.0, 0.0]);
    let plan = NamedPlan::ALL.into_iter().find(|plan| plan.name() == args.plan).unwrap_or(NamedPlan::Fast);
    let mut state = State::new(plan, level, args.view.threads());
    for &overlay in &args.overlay {
        if !state.shows(overlay) {
            state.toggle(overlay);
        }
    }
    state.wiped = args.wipe;
    let mut player = Player::new(loaded.animation.frames().len(), args.view.frame, args.fps);
    player.playing = !args.paused;
    Ok(Viewer::new(&args.scene, loaded.animation, camera, (!own).then_some(up), player, state))
}
