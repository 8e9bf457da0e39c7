//! The contract: the data every tracer of this suite takes and gives, and the rules that fix what it must answer.
//!
//! This crate holds data and its validation; it computes nothing. What computes is written twice, in
//! `reference` and in `optimized`, which know this crate and not each other. The rules below are meant to be
//! enough for two people who never meet to write tracers whose pictures are equal bit for bit.
//!
//! All arithmetic written in `code` below is IEEE 754 binary32, each operation rounded once to nearest, ties
//! to even, in the order of the parentheses; nothing is fused, nothing is estimated, subnormal numbers count.
//!
//! # Input
//!
//! A [`Scene`] is spheres with ids 0, 1, 2, … in their order, a background colour and a direction `light`.
//! A [`Camera`] is `eye`, `corner`, `du`, `dv` and a [`Size`] in pixels. Every number is a finite f32, every
//! radius is above zero (it may be subnormal): a value of these types that exists has been checked.
//!
//! # 1. The ray of a pixel
//!
//! Pixel (x, y) counts from 0, x to the right along `du`, y along `dv` from the first row written. For each
//! component i
//!
//! ```text
//! X = x as f32 + 0.5        (exact)
//! Y = y as f32 + 0.5        (exact)
//! d[i] = (corner[i] + X * du[i]) + Y * dv[i]
//! ```
//!
//! The direction d is not normalised. Its ray starts at `eye`. From here on a ray is exact data: six f32
//! numbers. [`Camera::new`] makes sure that no d is infinite (each `d[i]` is monotone in x and in y, since
//! rounding is monotone, so the four extreme pixels tell). A d whose three components are all zero may occur;
//! by rule 2 it hits nothing.
//!
//! # 2. The hit
//!
//! In real arithmetic on those numbers: sphere (c, r) is hit at the smallest real root t > 0 of
//! |eye + t d − c|² = r², if there is one. Hence:
//!
//! - a tangent ray hits (a double root is a root);
//! - an eye inside a sphere sees its far side;
//! - an eye exactly on a surface does not see t = 0, but does see the far side if d points inward;
//! - d = 0 hits nothing (no root, or every t is one and none is smallest).
//!
//! The pixel shows the sphere with the smallest such root over all spheres. Where roots of several spheres
//! are equal as real numbers, the lowest id has it.
//!
//! # 3. The answer
//!
//! - `id` of a pixel is that sphere's, exactly; [`MISS`] if no sphere is hit.
//! - `t` is that root correctly rounded to f32: nearest, ties to even. A root of (2 − 2⁻²⁴) 2¹²⁷ or more gives
//!   +∞, a root of 2⁻¹⁵⁰ or less gives +0; the id stands in both cases. `t` of a miss is +∞.
//!
//! # 4. The colour
//!
//! From the *rounded* t, the ray, and the sphere (c, r, colour), in this order:
//!
//! ```text
//! p[i] = eye[i] + t * d[i]                      hit point
//! n[i] = p[i] - c[i]                            normal, of length about r
//! m    = (n[0]*light[0] + n[1]*light[1]) + n[2]*light[2]
//! s    = AMBIENT + DIFFUSE * (m / r)
//! s    = if s > 0 { s } else { 0 }              a NaN becomes 0
//! s    = if s < 1 { s } else { 1 }
//! out[k] = trunc(colour[k] as f32 * s + 0.5)    k = red, green, blue; 0 to 255
//! ```
//!
//! with [`AMBIENT`] = 0.5625 and [`DIFFUSE`] = 0.4375, both exact. The side away from the light is
//! darker, never flat. The fourth byte is 255. A miss shows the background with 255.
//!
//! # 5. The approximate forms
//!
//! Three more arithmetics are fixed to the bit, so that a fast tracer can be compared with a naive one of the
//! same form. They replace rules 2 and 3; rules 1 and 4 stay. `dot(u, v)` is
//! `(u[0]*v[0] + u[1]*v[1]) + u[2]*v[2]`. All three share this ending:
//!
//! ```text
//! t = if near > 0 { near } else { far }
//! the sphere is hit if D >= 0 and t > 0          (a NaN on the way is a miss)
//! ```
//!
//! and the pixel shows the smallest t, the lowest id among equal t.
//!
//! **Textbook** (b² − a q; any textbook): in f32, or in f64 from the f32 input with t rounded to f32 once, at
//! the end, after the nearest sphere was chosen by its f64 t.
//!
//! ```text
//! a = dot(d, d)
//! f[i] = eye[i] - c[i];  b = dot(f, d);  q = dot(f, f) - r*r
//! D = b*b - a*q;  s = sqrt(D);  near = (-b - s) / a;  far = (-b + s) / a
//! ```
//!
//! **Perpendicular** (Ray Tracing Gems, chapter 7: the distance of the centre from the ray, free of the
//! cancellation of |f|² against r²), in f32:
//!
//! ```text
//! w = 1 / dot(d, d)
//! f[i] = eye[i] - c[i];  h = dot(f, d) * w;  l[i] = f[i] - h * d[i]
//! D = r*r - dot(l, l);   s = sqrt(D * w);  near = -h - s;  far = -h + s
//! ```
//!
//! # 6. The arithmetic of the SPU
//!
//! Both forms of rule 5 also in the single precision of the Cell's SPU, whose numbers are 32 bits that are read otherwise. With sign s,
//! exponent e (8 bits) and fraction f (23 bits) a pattern is zero if e = 0, whatever f, and else (−1)^s 1.f 2^(e − 127), up to e = 255: there
//! is no infinity, no NaN and no subnormal number. In place of IEEE 754:
//!
//! - `add`, `sub`, `mul`, `fma(x, y, z)` = xy + z and `fnms(x, y, z)` = z − xy are the real result of their operands, cut off towards zero to
//!   24 bits, once. A result below 2⁻¹²⁶ in magnitude is +0, as zero is; one of 2¹²⁹ or more is the largest number, 0x7fffffff, with the
//!   result's sign. Negation flips the sign bit. Comparison is that of the numbers, both zeros being equal.
//! - `frest(x)` has the sign of x, the exponent 253 − e, or 0 if that is below 0, and the entry of [`spu::FREST`] at the five upper bits of f as fraction; of a
//!   zero it is 0x7fffffff with the sign of x.
//! - `frsqest(x)`, of |x|, has the sign 0, the exponent 190 − ⌊(e + 1) / 2⌋, and the entry of [`spu::FRSQEST`] at the lowest bit of e and the five upper
//!   bits of f, as one number of six bits, as fraction; of a zero it is 0x7fffffff.
//! - `fi(x, y)` has the sign and the exponent of y. With B the upper 13 and S the lower 10 bits of y's fraction, and Y the lower 19 bits of x, its
//!   fraction is that of 1 + 2⁻¹³ B − 2⁻³² S Y, cut off to 23 bits. (It never goes below 1.)
//! - `div(x, y)`: `w = fi(y, frest(y)); q = mul(x, w); fma(fnms(q, y, x), w, q)`.
//! - `sqrt(x)`: `w = fi(x, frsqest(x)); g = mul(x, w); fma(fnms(g, g, x), mul(w, 0.5), g)`.
//!
//! Of the ending of rule 5 t is a hit only if it is 2¹²⁸ (the pattern of +∞) or less as such a number. A direction whose three
//! components are zeros as such numbers hits nothing. The eye, centres, radii and
//! directions are taken as patterns; t is one too. Rules 1 and 4 stay in IEEE 754.
//!
//! # What is refused
//!
//! [`SceneError`], [`CameraError`] and [`SizeError`] name the sphere, field or side and its value. An empty
//! scene is valid: it is all background.

mod camera;
mod image;
mod scene;
pub mod spu;

pub use camera::{Camera, CameraError};
pub use image::{Image, MAX_PIXELS, MAX_SIDE, MISS, Size, SizeError};
pub use scene::{
    AMBIENT, Animation, AnimationError, DEFAULT_LIGHT, DIFFUSE, MAX_SPHERES, Rgb, Scene, SceneError, Sphere,
};
