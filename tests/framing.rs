//! Is all of every scene in view, whatever its size and the picture's?

use contract::{Animation, Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use verify::scenes::frame::{Framing, FramingError, in_view};
use verify::scenes::generate::Generator;

const SIZES: [[u32; 2]; 7] = [[1, 1], [3, 7], [7, 3], [1280, 720], [7680, 4320], [1, 16_384], [16_384, 1]];

fn scene(spheres: &[([f32; 3], f32)]) -> Animation {
    let spheres =
        spheres.iter().map(|&(center, radius)| Sphere { center, radius, color: [9, 9, 9] }).collect();
    Scene::new(spheres, [0; 3], DEFAULT_LIGHT).expect("the spheres are valid").into()
}

fn scenes() -> Vec<(String, Animation)> {
    let generators = [
        Generator::Sphereflake { levels: 1 },
        Generator::Sphereflake { levels: 4 },
        Generator::Uniform { count: 2_000, seed: 1 },
        Generator::Clump { count: 2_000, seed: 1 },
        Generator::Lattice { side: 10 },
    ];
    let mut all: Vec<(String, Animation)> =
        generators.iter().map(|g| (g.to_string(), g.scene().expect("it is small").into())).collect();
    let mut add = |name: &str, spheres: &[([f32; 3], f32)]| all.push((name.into(), scene(spheres)));
    add("empty", &[]);
    add("one sphere", &[([1.0, 2.0, 3.0], 0.5)]);
    add("coincident", &[([1.0, 2.0, 3.0], 0.5); 5]);
    add("huge", &[([1e30, 0.0, 0.0], 1e29), ([-1e30, 1e30, 5e29], 3e29)]);
    add("tiny", &[([1e-30, 0.0, 0.0], 1e-31), ([-1e-30, 1e-30, 5e-31], 3e-31)]);
    add("subnormal", &[([0.0, 0.0, 0.0], 1e-45)]);
    add("far and small", &[([1e7, 1e7, 1e7], 1e-3), ([1e7, 1e7 + 1.0, 1e7], 1e-3)]);
    add("small beside huge", &[([0.0; 3], 1e20), ([1e25, 0.0, 0.0], 1e-20)]);
    add("flat", &[([0.0, 0.0, 0.0], 1e-6), ([1e6, 0.0, 0.0], 1e-6)]);
    add("deep", &[([0.0, 0.0, -1e6], 1.0), ([0.0, 0.0, 1e6], 1.0)]);
    all
}

fn framing(size: [u32; 2]) -> Framing {
    Framing { size: Some(Size::new(size[0], size[1]).expect("valid")), ..Framing::default() }
}

/// The worst slack over spheres, from the contract's ray directions of the picture's outer corners.
fn assert_in_view(name: &str, camera: &Camera, animation: &Animation) {
    for (f, frame) in animation.frames().iter().enumerate() {
        for (id, sphere) in frame.spheres().iter().enumerate() {
            assert!(
                in_view(camera, sphere),
                "{name}: frame {f}, sphere {id} {sphere:?} not in view of {camera:?}"
            );
            assert!(tangent_cone_in_picture(camera, sphere), "{name}: frame {f}, sphere {id}: {sphere:?}");
        }
    }
}

/// Pixels are squares: `du` and `dv` are equally long and at right angles.
fn assert_square_and_straight(name: &str, camera: &Camera) {
    let dot = |a: [f32; 3], b: [f32; 3]| (0..3).map(|i| f64::from(a[i]) * f64::from(b[i])).sum::<f64>();
    let (du, dv) = (camera.du(), camera.dv());
    let (width, height, lean) = (dot(du, du).sqrt(), dot(dv, dv).sqrt(), dot(du, dv));
    assert!((width / height - 1.0).abs() < 1e-5, "{name}: pixels of {width} x {height}");
    assert!(lean.abs() < 1e-5 * width * height, "{name}: {du:?} and {dv:?} lean by {lean}");
}

/// Another way to see it: the picture point of the centre, and those of eight points of the silhouette circle.
fn tangent_cone_in_picture(camera: &Camera, sphere: &Sphere) -> bool {
    let v = |x: [f32; 3]| x.map(f64::from);
    let (du, dv, corner) = (v(camera.du()), v(camera.dv()), v(camera.corner()));
    let eye = v(camera.eye());
    let scale = f64::from(sphere.radius);
    // In units of the radius, so that squares neither over- nor underflow.
    let f: [f64; 3] = std::array::from_fn(|i| (f64::from(sphere.center[i]) - eye[i]) / scale);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let length = dot(f, f).sqrt();
    if length.is_nan() || length <= 1.0 {
        return false;
    }
    // The circle of tangent points: middle f (1 - 1/length^2), radius sqrt(1 - 1/length^2).
    let ring = (1.0 - 1.0 / (length * length)).sqrt();
    let away = f.map(|x| x / length);
    let helper = if away[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let side = cross(away, helper);
    let side = side.map(|x| x / dot(side, side).sqrt());
    let other = cross(away, side);
    (0..64).all(|i| {
        let (sine, cosine) = (f64::from(i) * std::f64::consts::TAU / 64.0).sin_cos();
        let p: [f64; 3] =
            std::array::from_fn(|k| f[k] * ring * ring + ring * (cosine * side[k] + sine * other[k]));
        // p = s (corner + X du + Y dv), solved by Cramer's rule.
        let determinant = dot(corner, cross(du, dv));
        let s = dot(p, cross(du, dv)) / determinant;
        let x = dot(corner, cross(p, dv)) / determinant / s;
        let y = dot(corner, cross(du, p)) / determinant / s;
        let (width, height) = (f64::from(camera.size().width()), f64::from(camera.size().height()));
        s > 0.0 && (0.0..=width).contains(&x) && (0.0..=height).contains(&y)
    })
}

#[test]
fn every_scene_is_in_view_at_every_size() {
    for (name, animation) in scenes() {
        for size in SIZES {
            let name = format!("{name} at {size:?}");
            let camera = framing(size).camera(&animation).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_in_view(&name, &camera, &animation);
            assert_square_and_straight(&name, &camera);
        }
    }
}

/// A check that cannot fail shows nothing: half the picture's angle must lose spheres.
#[test]
fn a_narrower_picture_loses_spheres() {
    for (name, animation) in scenes().into_iter().take(5) {
        let camera = framing([1280, 720]).camera(&animation).expect("framed");
        let half = |v: [f32; 3]| v.map(|x| x * 0.5);
        let corner =
            std::array::from_fn(|i| camera.corner()[i] + 320.0 * camera.du()[i] + 180.0 * camera.dv()[i]);
        let narrow = Camera::new(camera.eye(), corner, half(camera.du()), half(camera.dv()), camera.size())
            .expect("valid");
        let lost = animation.frames()[0].spheres().iter().filter(|s| !in_view(&narrow, s)).count();
        assert!(lost > 0, "{name}: a picture of half the angle still shows all");
    }
}

/// The scene fills the picture: with 20 percent less there is something outside.
#[test]
fn no_more_room_than_needed() {
    for (name, animation) in scenes().into_iter().take(5) {
        let camera = framing([1280, 720]).camera(&animation).expect("framed");
        let k = 0.8_f32;
        let corner = std::array::from_fn(|i| {
            camera.corner()[i] + (1.0 - k) * (640.0 * camera.du()[i] + 360.0 * camera.dv()[i])
        });
        let by = |v: [f32; 3]| v.map(|x| x * k);
        let camera = Camera::new(camera.eye(), corner, by(camera.du()), by(camera.dv()), camera.size())
            .expect("valid");
        assert!(
            animation.frames()[0].spheres().iter().any(|s| !in_view(&camera, s)),
            "{name}: too much room"
        );
    }
}

#[test]
fn one_camera_frames_all_frames() {
    let frame = |x: f32| scene(&[([x, 0.0, 0.0], 1.0)]).frames()[0].clone();
    let empty = scene(&[]).frames()[0].clone();
    let animation = Animation::new(vec![empty, frame(-50.0), frame(0.0), frame(80.0)]).expect("four frames");
    let camera = Framing::default().camera(&animation).expect("framed");
    assert_in_view("moving", &camera, &animation);
}

#[test]
fn default_view_is_along_minus_z_with_y_up_and_rows_going_down() {
    let camera = Framing::default().camera(&scene(&[([1.0, 2.0, 3.0], 0.5)])).expect("framed");
    assert_eq!((camera.eye()[0], camera.eye()[1]), (1.0, 2.0));
    assert!(camera.eye()[2] > 3.5);
    assert!(camera.du()[0] > 0.0 && camera.du()[1] == 0.0 && camera.du()[2] == 0.0, "{camera:?}");
    assert!(camera.dv()[1] < 0.0 && camera.dv()[0] == 0.0 && camera.dv()[2] == 0.0, "{camera:?}");
    assert!(camera.corner()[0] < 0.0 && camera.corner()[1] > 0.0 && camera.corner()[2] < 0.0, "{camera:?}");
    assert_eq!((camera.size().width(), camera.size().height()), (1280, 720));
}

#[test]
fn wishes_are_kept() {
    let animation = scene(&[([0.0; 3], 1.0)]);
    let wish = Framing {
        eye: Some([2.1, 1.3, 1.7]),
        target: Some([0.0; 3]),
        up: Some([0.0, 0.0, 1.0]),
        fov: Some(45.0),
        size: Size::new(100, 100).ok(),
    };
    let camera = wish.camera(&animation).expect("framed");
    assert_eq!(camera.eye(), [2.1, 1.3, 1.7]);
    let middle: [f32; 3] =
        std::array::from_fn(|i| camera.corner()[i] + 50.0 * camera.du()[i] + 50.0 * camera.dv()[i]);
    let length = middle.iter().map(|x| x * x).sum::<f32>().sqrt();
    let eye_length = (2.1_f32 * 2.1 + 1.3 * 1.3 + 1.7 * 1.7).sqrt();
    for (got, eye) in middle.iter().zip(camera.eye()) {
        assert!((got / length + eye / eye_length).abs() < 1e-6, "{middle:?}");
    }
    let height = camera.dv().iter().map(|x| x * x).sum::<f32>().sqrt() * 100.0;
    assert!((height / length - 2.0 * 22.5_f32.to_radians().tan()).abs() < 1e-5, "height {height}");
}

#[test]
fn up_along_the_view_is_replaced() {
    let animation = scene(&[([0.0; 3], 1.0)]);
    for up in [[0.0, 0.0, 1.0], [0.0, 0.0, -5.0], [0.0; 3]] {
        let camera = Framing { up: Some(up), ..Framing::default() }.camera(&animation).expect("framed");
        assert_in_view("up along view", &camera, &animation);
    }
    let above = Framing { eye: Some([0.0, 9.0, 0.0]), ..Framing::default() };
    assert_in_view("from above", &above.camera(&animation).expect("framed"), &animation);
}

#[test]
fn bad_wishes_are_refused() {
    let animation = scene(&[([1.0, 2.0, 3.0], 1.0)]);
    let wish = Framing::default();
    let refusal = |wish: Framing| wish.camera(&animation).expect_err("refused");
    let at = [1.0, 2.0, 3.0];
    assert_eq!(refusal(Framing { eye: Some(at), ..wish }), FramingError::EyeIsTarget { eye: at });
    for fov in [0.0, -1.0, 180.0, f64::INFINITY] {
        assert_eq!(refusal(Framing { fov: Some(fov), ..wish }), FramingError::Angle { fov });
    }
    assert!(matches!(refusal(Framing { fov: Some(f64::NAN), ..wish }), FramingError::Angle { .. }));
    let value = [0.0, f64::INFINITY, 0.0];
    assert_eq!(refusal(Framing { up: Some(value), ..wish }), FramingError::NotFinite { field: "up", value });
    assert_eq!(
        refusal(Framing { eye: Some(value), ..wish }),
        FramingError::NotFinite { field: "eye", value }
    );
    let too_far = Framing { eye: Some([1e300, 0.0, 0.0]), ..wish };
    assert!(matches!(refusal(too_far), FramingError::Camera(_)));
    let edge = scene(&[([3e38, 3e38, 3e38], 3e38), ([-3e38, 0.0, 0.0], 3e38)]);
    assert!(matches!(wish.camera(&edge), Err(FramingError::OutOfReach { .. })));
}
