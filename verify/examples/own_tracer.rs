//! A tracer of your own, judged: implement [`Subject`], hand it to [`run`], print what the judge says.
//!
//! ```sh
//! cargo run --release -p verify --example own_tracer                         judged here, without a pipe
//! cargo build --release -p verify --example own_tracer
//! cgt verify --subject-cmd 'target/release/examples/own_tracer serve'        judged as a program
//! ```

use contract::{Camera, Image, Scene};
use std::io::{self, Write};
use verify::foreign::serve;
use verify::run::{Frame, run};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::subject::{Promise, Rendered, Rounding, Subject, SubjectError};

/// One loop over all spheres for each pixel, in f64.
pub struct Own;

impl Subject for Own {
    fn name(&self) -> &str {
        "own"
    }

    fn description(&self) -> &str {
        "one loop over all spheres, b² − ac in f64"
    }

    fn promise(&self) -> Promise {
        Promise::Rounded(Rounding::TextbookF64)
    }

    fn render(
        &self,
        scene: &Scene,
        camera: &Camera,
        _threads: usize,
        row_done: &(dyn Fn() + Sync),
    ) -> Result<Rendered, SubjectError> {
        let mut image = Image::new(camera.size(), scene.background())?;
        let mut i = 0;
        for y in 0..camera.size().height() {
            for x in 0..camera.size().width() {
                // Rule 1 of the contract, in f32; from here on the ray is exact data.
                let (u, v) = (x as f32 + 0.5, y as f32 + 0.5);
                let [corner, du, dv] = [camera.corner(), camera.du(), camera.dv()];
                let dir = [0, 1, 2].map(|k| f64::from((corner[k] + u * du[k]) + v * dv[k]));
                let mut nearest = f64::INFINITY;
                for (id, sphere) in (0..).zip(scene.spheres()) {
                    let from = [0, 1, 2].map(|k| f64::from(camera.eye()[k]) - f64::from(sphere.center[k]));
                    if let Some(t) = root(from, dir, f64::from(sphere.radius)).filter(|t| *t < nearest) {
                        (nearest, image.ids[i]) = (t, id);
                    }
                }
                image.t[i] = nearest as f32;
                if let Some(sphere) = scene.spheres().get(image.ids[i] as usize) {
                    image.rgba[i] = color(scene, camera, sphere, dir, image.t[i]);
                }
                i += 1;
            }
            row_done();
        }
        Ok(Rendered { image, notes: Vec::new(), took: None })
    }
}

/// The smallest root above zero.
fn root(from: [f64; 3], dir: [f64; 3], radius: f64) -> Option<f64> {
    let dot = |u: [f64; 3], v: [f64; 3]| (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2];
    let (a, b, q) = (dot(dir, dir), dot(from, dir), dot(from, from) - radius * radius);
    let root = (b * b - a * q).sqrt();
    // NaN, of no root, is not above zero.
    [(-b - root) / a, (-b + root) / a].into_iter().find(|t| *t > 0.0)
}

/// Rule 4 of the contract.
fn color(scene: &Scene, camera: &Camera, sphere: &contract::Sphere, dir: [f64; 3], t: f32) -> [u8; 4] {
    let normal = [0, 1, 2].map(|k| (camera.eye()[k] + t * dir[k] as f32) - sphere.center[k]);
    let light = scene.light();
    let m = (normal[0] * light[0] + normal[1] * light[1]) + normal[2] * light[2];
    let s = contract::AMBIENT + contract::DIFFUSE * (m / sphere.radius);
    let s = if s > 0.0 { s } else { 0.0 };
    let s = if s < 1.0 { s } else { 1.0 };
    let [r, g, b] = sphere.color.map(|c| (f32::from(c) * s + 0.5) as u8);
    [r, g, b, 255]
}

fn main() -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
    if std::env::args().nth(1).as_deref() == Some("serve") {
        return Ok(serve(&Own, 1, &mut io::stdin().lock(), &mut io::stdout().lock())?);
    }
    let word = "uniform:200:1";
    let loaded = Source::parse(word)?.load()?;
    let size = contract::Size::new(320, 180)?;
    let frame = Frame {
        name: word,
        description: "a generated scene",
        provenance: "made, the same on every machine",
        scene: &loaded.animation.frames()[0],
        camera: &loaded.camera(&Framing { size: Some(size), ..Framing::default() })?,
        frame: [0, 1],
        warnings: &[],
        replay: "",
    };
    let (report, _pictures) = run(&frame, &[&Own], &[], 1, &|_, _| Box::new(|| ()))?;
    let judged = &report.subjects[0];
    let seen = judged.comparison.as_ref();
    let differ = seen.map_or(0, |seen| seen.wrong_ids + seen.wrong_t + seen.wrong_color);
    writeln!(
        io::stdout(),
        "{} on {word}: {:?}. {} {differ} of {} pixels differ from the truth in any bit.",
        judged.name,
        judged.verdict,
        judged.because,
        size.pixels()
    )?;
    Ok(())
}
