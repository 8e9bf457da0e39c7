//! The project's own format, `cgt-scene` version 1: JSON that keeps every number as a decimal for people and as its
//! bits for machines, `{"dec": 1.5, "bits": "3fc00000"}`. Out comes the animation that was written
//! ([`super::super::write`]), bit for bit. Refused are numbers whose two forms disagree, unknown or missing
//! fields, other versions, and what the contract refuses; the message has line and column.

use super::frames::{Frames, Input, budget};
use super::text::Lines;
use super::{Format, Loaded, Place, ReadError};
use contract::{Camera, Rgb, Size, Sphere};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

/// What the field `format` says.
pub(in crate::scenes) const FORMAT: &str = "cgt-scene";
/// What the field `version` says.
pub(in crate::scenes) const VERSION: u32 = 1;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(deserialize_with = "our_format")]
    #[allow(dead_code, reason = "it is checked while it is read")]
    format: (),
    #[serde(deserialize_with = "our_version")]
    #[allow(dead_code, reason = "it is checked while it is read")]
    version: (),
    frames: Vec<FrameText>,
    #[serde(default)]
    camera: Option<Given>,
}

/// A camera that the contract accepts.
#[derive(Deserialize)]
#[serde(try_from = "CameraText")]
struct Given(Camera);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrameText {
    background: Rgb,
    light: [Number; 3],
    spheres: Vec<SphereText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereText {
    center: [Number; 3],
    #[serde(deserialize_with = "radius")]
    radius: f32,
    color: Rgb,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraText {
    eye: [Number; 3],
    corner: [Number; 3],
    du: [Number; 3],
    dv: [Number; 3],
    size: [u32; 2],
}

impl TryFrom<CameraText> for Given {
    type Error = String;

    fn try_from(text: CameraText) -> Result<Self, String> {
        let [width, height] = text.size;
        let size = Size::new(width, height).map_err(|e| format!("camera: {e}"))?;
        let [eye, corner, du, dv] = [text.eye, text.corner, text.du, text.dv].map(|v| plain(&v));
        Camera::new(eye, corner, du, dv, size).map(Self).map_err(|e| e.to_string())
    }
}

/// A finite f32 in both forms.
struct Number(f32);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NumberText<'a> {
    #[serde(borrow)]
    dec: &'a RawValue,
    #[serde(borrow)]
    bits: &'a RawValue,
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let text = NumberText::deserialize(from)?;
        let (dec, bits) = (text.dec.get(), text.bits.get());
        let hex = bits.strip_prefix('"').and_then(|b| b.strip_suffix('"')).unwrap_or("");
        let eight = hex.len() == 8 && hex.bytes().all(|b| b.is_ascii_hexdigit());
        let value = u32::from_str_radix(hex, 16).ok().filter(|_| eight).map(f32::from_bits);
        let value =
            value.ok_or_else(|| D::Error::custom(format!("bits {bits:.40} are not eight hex digits")))?;
        if !value.is_finite() {
            return Err(D::Error::custom(format!(
                "bits {bits} are {value:?}; a finite number must stand here"
            )));
        }
        let decimal: f32 =
            dec.parse().map_err(|_| D::Error::custom(format!("dec {dec:.40} is no number")))?;
        if decimal.to_bits() != value.to_bits() {
            let have = decimal.to_bits();
            let text = format!("dec {dec:.40} (bits {have:08x}) and bits {bits} ({value:?}) disagree");
            return Err(D::Error::custom(text));
        }
        Ok(Self(value))
    }
}

fn our_format<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
    let format = String::deserialize(from)?;
    if format == FORMAT {
        Ok(())
    } else {
        let start: String = format.chars().take(40).collect();
        Err(D::Error::custom(format!("format {start:?}; {FORMAT:?} is read")))
    }
}

fn our_version<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
    let version = u64::deserialize(from)?;
    let known = version == u64::from(VERSION);
    if known {
        Ok(())
    } else {
        Err(D::Error::custom(format!("version {version}; version {VERSION} is read")))
    }
}

fn radius<'de, D: Deserializer<'de>>(from: D) -> Result<f32, D::Error> {
    let Number(radius) = Number::deserialize(from)?;
    if radius > 0.0 { Ok(radius) } else { Err(D::Error::custom(format!("radius {radius:?} is not above 0"))) }
}

pub(super) fn read(input: Input<'_>) -> Result<Loaded, ReadError> {
    let Input { file, bytes, .. } = input;
    Lines::new(file, "cgt-scene JSON", bytes)?;
    // What is parsed takes up to twice its text before it is frames, of which account is kept.
    if let Some(packed) = input.packed
        && 3 * bytes.len() as u64 > budget(packed)
    {
        return Err(ReadError::GzipLimit { file: file.into(), packed, limit: budget(packed) / 3 });
    }
    let parsed: File = serde_json::from_slice(bytes).map_err(|e| {
        let text = e.to_string();
        let detail = text.rsplit_once(" at line ").map_or(text.as_str(), |(detail, _)| detail);
        let place = Place { file: file.into(), line: e.line(), column: e.column() };
        ReadError::Json { place, detail: detail.into() }
    })?;
    let mut frames = Frames::new(input);
    for frame in parsed.frames {
        (frames.background, frames.light) = (frame.background, plain(&frame.light));
        let mut spheres = frames.room(frame.spheres.len())?;
        spheres.extend(frame.spheres.into_iter().map(|s| Sphere {
            center: plain(&s.center),
            radius: s.radius,
            color: s.color,
        }));
        frames.push(spheres)?;
    }
    let mut loaded = frames.finish(Format::Json, "its list of frames is empty")?;
    loaded.camera = parsed.camera.map(|given| given.0);
    Ok(loaded)
}

fn plain(numbers: &[Number; 3]) -> [f32; 3] {
    std::array::from_fn(|i| numbers[i].0)
}
