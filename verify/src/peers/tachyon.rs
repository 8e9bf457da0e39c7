//! Tachyon (J. E. Stone's ray tracer, of 1994 and since) as a witness of images: it gives no ids and no t, so each sphere is
//! given a flat colour that is its id, and the picture is read back.
//!
//! Its rays, as its pictures show: at distance 1 in front of the eye lies a plane of height 1, square pixels, column i from
//! the left at i + 1 − width/2 to the right, row j from the top at height/2 − j upward; right is up × view. [`View::camera`]
//! is that camera in the contract's terms, but for rounding. In: a scene and a view. Out: an id for each pixel, [`MISS`]
//! for none. Refused: more spheres than 24 bits count.

use crate::subject::SubjectError;
use contract::{Camera, CameraError, MISS, Scene, Size};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The program's names, in the order in which they are looked for.
const NAMES: [&str; 2] = ["tachyon-nox", "tachyon"];

/// The program, if it is installed: what `TACHYON` names, else the first of its names in `PATH`.
#[must_use]
pub fn find() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("TACHYON") {
        return Some(named.into());
    }
    let folders: Vec<_> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    NAMES.iter().find_map(|name| folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file()))
}

/// Where Tachyon stands and looks.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The eye.
    pub eye: [f32; 3],
    /// What it looks at; not straight above or below the eye.
    pub target: [f32; 3],
    /// Height of the plane at distance 1: 1 / zoom.
    pub height: f64,
    /// Pixels.
    pub size: Size,
}

impl View {
    /// Right, up and forward, of length 1.
    fn frame(&self) -> [[f64; 3]; 3] {
        let cross = |u: [f64; 3], v: [f64; 3]| {
            [0, 1, 2].map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3])
        };
        let unit = |v: [f64; 3]| v.map(|x| x / v.iter().map(|x| x * x).sum::<f64>().sqrt());
        let forward = unit([0, 1, 2].map(|i| f64::from(self.target[i]) - f64::from(self.eye[i])));
        let right = unit(cross([0.0, 1.0, 0.0], forward));
        [right, cross(forward, right), forward]
    }

    /// The same rays as the contract's camera.
    ///
    /// # Errors
    /// [`CameraError`] if these numbers make none.
    #[allow(clippy::cast_possible_truncation, reason = "a camera is of f32")]
    pub fn camera(&self) -> Result<Camera, CameraError> {
        let [right, up, forward] = self.frame();
        let (width, rows) = (f64::from(self.size.width()), f64::from(self.size.height()));
        let pixel = self.height / rows;
        let vector =
            |r: f64, u: f64, f: f64| [0, 1, 2].map(|i| (r * right[i] + u * up[i] + f * forward[i]) as f32);
        let corner = vector(pixel * (0.5 - width / 2.0), pixel * (0.5 + rows / 2.0), 1.0);
        Camera::new(self.eye, corner, vector(pixel, 0.0, 0.0), vector(0.0, -pixel, 0.0), self.size)
    }
}

/// The ids that Tachyon shows.
///
/// # Errors
/// If it cannot be run, fails, or writes another picture than was asked for.
pub fn render(program: &Path, scene: &Scene, view: &View) -> Result<Vec<u32>, SubjectError> {
    let desk = tempfile::tempdir()?;
    let (model, picture) = (desk.path().join("scene.dat"), desk.path().join("picture.ppm"));
    std::fs::write(&model, text(scene, view)?)?;
    let mut command = Command::new(program);
    command.arg(&model).args(["-format", "PPM", "-o"]).arg(&picture).stdout(Stdio::null());
    let status = command.status()?;
    if !status.success() {
        return Err(format!("Tachyon failed: {status}").into());
    }
    ids(&std::fs::read(&picture)?, view.size)
}

/// A scene in Tachyon's own format.
fn text(scene: &Scene, view: &View) -> Result<String, SubjectError> {
    if scene.spheres().len() >= 1 << 24 {
        return Err(format!("{} spheres are more than colours", scene.spheres().len()).into());
    }
    let [_, up, forward] = view.frame();
    let vector = |v: [f64; 3]| v.map(|x| format!("{x:.9}")).join(" ");
    let [x, y, z] = view.eye;
    let mut text = format!(
        "BEGIN_SCENE\nRESOLUTION {} {}\nCAMERA\nZOOM {:.9}\nASPECTRATIO 1\nANTIALIASING 0\nRAYDEPTH 1\nCENTER {x:?} {y:?} {z:?}\n\
         VIEWDIR {}\nUPDIR {}\nEND_CAMERA\nBACKGROUND 0 0 0\n",
        view.size.width(),
        view.size.height(),
        1.0 / view.height,
        vector(forward),
        vector(up),
    );
    for (id, sphere) in (1_u32..).zip(scene.spheres()) {
        // Tachyon cuts off what a channel has beyond a whole number.
        let [_, r, g, b] = id.to_be_bytes().map(|byte| format!("{:.9}", (f64::from(byte) + 0.5) / 255.0));
        let ([x, y, z], radius) = (sphere.center, sphere.radius);
        writeln!(
            text,
            "SPHERE CENTER {x:?} {y:?} {z:?} RAD {radius:?} TEXTURE AMBIENT 1 DIFFUSE 0 SPECULAR 0 OPACITY 1 COLOR {r} {g} {b} TEXFUNC 0"
        )?;
    }
    text += "END_SCENE\n";
    Ok(text)
}

/// Reads a portable pixmap whose colours are ids, counted from 1.
fn ids(ppm: &[u8], size: Size) -> Result<Vec<u32>, SubjectError> {
    let head = format!("P6\n{} {}\n255\n", size.width(), size.height());
    let pixels = ppm.strip_prefix(head.as_bytes()).ok_or("Tachyon wrote another kind of picture")?;
    let (pixels, rest) = pixels.as_chunks::<3>();
    if pixels.len() != size.pixels() || !rest.is_empty() {
        return Err(format!("Tachyon wrote {} pixels", pixels.len()).into());
    }
    // 0 less 1 is a miss.
    Ok(pixels.iter().map(|&[r, g, b]| u32::from_be_bytes([0, r, g, b]).wrapping_sub(1)).collect())
}

const _: () = assert!(0_u32.wrapping_sub(1) == MISS);
