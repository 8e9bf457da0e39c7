//! Writes an animation, and a camera if there is one, in the project's own format (`read::json` reads it). What
//! comes out is text in which every number stands as the shortest decimal that gives it and as its bits, so that
//! reading it back gives the same bits. It refuses nothing: what it is given has been checked.

use super::read::{JSON_FORMAT, JSON_VERSION};
use contract::{Animation, Camera, Scene, Sphere};
use std::fmt::Write as _;

/// The text, one line a sphere.
#[must_use]
pub fn json(animation: &Animation, camera: Option<&Camera>) -> String {
    let mut out = format!("{{\"format\": \"{JSON_FORMAT}\", \"version\": {JSON_VERSION},\n\"frames\": [\n");
    let mut separator = "";
    for scene in animation.frames() {
        out.push_str(separator);
        frame(&mut out, scene);
        separator = ",\n";
    }
    out.push_str("\n]");
    if let Some(camera) = camera {
        let vectors =
            [("eye", camera.eye()), ("corner", camera.corner()), ("du", camera.du()), ("dv", camera.dv())];
        out.push_str(",\n\"camera\": {");
        for (name, value) in vectors {
            add(&mut out, format_args!("\"{name}\": {}, ", vector(value)));
        }
        let size = camera.size();
        add(&mut out, format_args!("\"size\": [{}, {}]}}", size.width(), size.height()));
    }
    out.push_str("}\n");
    out
}

fn frame(out: &mut String, scene: &Scene) {
    let (background, light) = (scene.background(), vector(scene.light()));
    add(out, format_args!("{{\"background\": {background:?}, \"light\": {light}, \"spheres\": ["));
    let mut separator = "\n";
    for Sphere { center, radius, color } in scene.spheres() {
        let (center, radius) = (vector(*center), number(*radius));
        let line =
            format_args!("{separator}{{\"center\": {center}, \"radius\": {radius}, \"color\": {color:?}}}");
        add(out, line);
        separator = ",\n";
    }
    out.push_str("]}");
}

fn vector(v: [f32; 3]) -> String {
    let [x, y, z] = v.map(number);
    format!("[{x}, {y}, {z}]")
}

/// Rust's shortest form of a finite f32 is a JSON number too.
fn number(x: f32) -> String {
    format!("{{\"dec\": {x:?}, \"bits\": \"{:08x}\"}}", x.to_bits())
}

/// Appends; a `String` takes everything.
fn add(out: &mut String, text: std::fmt::Arguments<'_>) {
    let taken = out.write_fmt(text);
    debug_assert!(taken.is_ok());
}
