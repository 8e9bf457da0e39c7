//! Does the contract refuse what no tracer can answer for, and name it? Does it let everything else in?

use contract::{
    AMBIENT, Animation, AnimationError, Camera, CameraError, DEFAULT_LIGHT, DIFFUSE, Image, MAX_PIXELS,
    MAX_SIDE, MAX_SPHERES, MISS, Scene, SceneError, Size, SizeError, Sphere,
};

const BALL: Sphere = Sphere { center: [0.0; 3], radius: 1.0, color: [9, 8, 7] };
const NOT_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

fn scene(spheres: Vec<Sphere>) -> Result<Scene, SceneError> {
    Scene::new(spheres, [0; 3], DEFAULT_LIGHT)
}

#[test]
fn a_bad_sphere_is_refused_by_id_and_value() {
    for bad in NOT_FINITE {
        for axis in 0..3 {
            let mut sphere = BALL;
            sphere.center[axis] = bad;
            let error = scene(vec![BALL, sphere]).expect_err("not finite");
            assert!(matches!(error, SceneError::Center { sphere: 1, .. }), "{error:?}");
            assert!(error.to_string().contains(&format!("{bad:?}")), "{error}");
        }
        let error = scene(vec![Sphere { radius: bad, ..BALL }]).expect_err("not finite");
        assert!(matches!(error, SceneError::Radius { sphere: 0, .. }), "{error:?}");
        for axis in 0..3 {
            let mut light = DEFAULT_LIGHT;
            light[axis] = bad;
            let error = Scene::new(vec![], [0; 3], light).expect_err("not finite");
            assert!(matches!(error, SceneError::Light { .. }), "{error:?}");
        }
    }
    for radius in [0.0, -0.0, -1.0, -f32::MIN_POSITIVE] {
        let error = scene(vec![BALL, BALL, Sphere { radius, ..BALL }]).expect_err("not above zero");
        assert_eq!(error, SceneError::Radius { sphere: 2, radius });
        assert!(error.to_string().contains(&format!("sphere 2: radius is {radius:?}")), "{error}");
    }
}

/// Of several things the first is told: the light, then the spheres in their order, of each its centre.
#[test]
fn the_first_thing_that_is_wrong_is_told() {
    let flat = |radius| Sphere { radius, ..BALL };
    let lost = Sphere { center: [0.0, f32::INFINITY, 0.0], radius: -2.0, ..BALL };
    let error = scene(vec![BALL, flat(0.0), BALL, flat(-1.0), lost]).expect_err("two radii");
    assert_eq!(error, SceneError::Radius { sphere: 1, radius: 0.0 });
    let error = scene(vec![BALL, lost, flat(-1.0)]).expect_err("a centre and two radii");
    assert_eq!(error, SceneError::Center { sphere: 1, center: lost.center });
    let light = [0.0, f32::INFINITY, 1.0];
    let error = Scene::new(vec![flat(0.0)], [0; 3], light).expect_err("a light and a radius");
    assert_eq!(error, SceneError::Light { light });
}

/// Each refusal names its place and value, each where it belongs.
#[test]
fn refusals_are_said_with_their_numbers() {
    let texts = [
        (
            SceneError::Center { sphere: 17, center: [1.5, f32::NAN, -2.5] }.to_string(),
            "sphere 17: centre is [1.5, NaN, -2.5]; every coordinate must be finite",
        ),
        (
            SceneError::Radius { sphere: 19, radius: -3.5 }.to_string(),
            "sphere 19: radius is -3.5; it must be finite and above 0",
        ),
        (
            SceneError::Light { light: [1.5, -2.5, f32::INFINITY] }.to_string(),
            "light is [1.5, -2.5, inf]; every component must be finite",
        ),
        (
            SceneError::TooManySpheres { count: 200_000_003 }.to_string(),
            "200000003 spheres; the limit is 134217728",
        ),
        (
            CameraError::NotFinite { field: "corner", value: [f32::INFINITY, 4.5, 5.5] }.to_string(),
            "camera corner is [inf, 4.5, 5.5]; every component must be finite",
        ),
        (
            CameraError::Degenerate { du: [1.5, 2.5, 3.5], dv: [3.0, 5.0, 7.0] }.to_string(),
            "camera du [1.5, 2.5, 3.5] and dv [3.0, 5.0, 7.0] are parallel or zero: the picture has no area",
        ),
        (
            CameraError::Overflow { x: 23, y: 29, direction: [1.5, f32::INFINITY, 2.5] }.to_string(),
            "camera: the direction of pixel (23, 29) is [1.5, inf, 2.5], beyond f32",
        ),
        (SizeError::Zero { width: 0, height: 31 }.to_string(), "an image of 0x31 pixels has no pixel"),
        (
            SizeError::TooLarge { width: 20_011, height: 37 }.to_string(),
            "an image of 20011x37 pixels is too large; a side may have 16384, the whole 134217728",
        ),
        (
            SizeError::NoMemory { width: 41, height: 43, bytes: 47 }.to_string(),
            "no memory for an image of 41x43 pixels (47 bytes)",
        ),
        (AnimationError::NoFrames.to_string(), "an animation needs at least one frame"),
    ];
    for (said, words) in texts {
        assert_eq!(said, words);
    }
}

#[test]
fn extreme_but_finite_scenes_are_let_in() {
    let least = f32::from_bits(1);
    let sphere = Sphere { center: [f32::MAX, f32::MIN, least], radius: least, ..BALL };
    assert_eq!(scene(vec![sphere]).expect("all finite").spheres(), [sphere]);
    assert!(scene(vec![]).expect("empty is valid").spheres().is_empty());
    assert!(scene(vec![Sphere { radius: f32::MAX, ..BALL }]).is_ok());
}

#[test]
fn too_many_spheres_are_refused() {
    assert!(MAX_SPHERES < MISS as usize, "an id must never be the mark of a miss");
    assert_eq!(Scene::check_count(MAX_SPHERES), Ok(()));
    for count in [MAX_SPHERES + 1, usize::MAX] {
        assert_eq!(Scene::check_count(count), Err(SceneError::TooManySpheres { count }));
    }
}

#[test]
fn sizes_have_limits() {
    let zero = |width, height| Err(SizeError::Zero { width, height });
    let large = |width, height| Err(SizeError::TooLarge { width, height });
    assert_eq!(Size::new(0, 720), zero(0, 720));
    assert_eq!(Size::new(1280, 0), zero(1280, 0));
    assert_eq!(Size::new(100_000, 100_000), large(100_000, 100_000));
    assert_eq!(Size::new(u32::MAX, u32::MAX), large(u32::MAX, u32::MAX));
    assert_eq!(Size::new(MAX_SIDE + 1, 1), large(MAX_SIDE + 1, 1));
    assert_eq!(Size::new(1, MAX_SIDE + 1), large(1, MAX_SIDE + 1));
    assert_eq!(Size::new(MAX_SIDE, MAX_SIDE), large(MAX_SIDE, MAX_SIDE));
    assert_eq!([MAX_SIDE as usize, MAX_PIXELS], [16_384, 16_384 * 8192]);
    for (width, height) in [(MAX_SIDE, 8193), (8193, MAX_SIDE)] {
        assert_eq!(Size::new(width, height), large(width, height), "a row or column too many");
    }
    for (width, height) in
        [(1, 1), (3, 5), (1280, 720), (7680, 4320), (MAX_SIDE, 1), (1, MAX_SIDE), (MAX_SIDE, 8192)]
    {
        let size = Size::new(width, height).expect("within limits");
        assert_eq!([size.width(), size.height()], [width, height]);
        assert_eq!(size.pixels(), width as usize * height as usize);
    }
}

/// The variable that says that the test below is run with little memory.
const LITTLE_MEMORY: &str = "CGT_LITTLE_MEMORY";

/// Asks for the largest image; run by the next test with less memory than it needs.
#[test]
fn the_largest_image_is_asked_for() {
    if std::env::var_os(LITTLE_MEMORY).is_some() {
        let size = Size::new(16_384, 8192).expect("within limits");
        let error = Image::new(size, [0; 3]).expect_err("more than there is");
        eprintln!("asked for {size:?}: {error}");
    }
}

/// An image for which there is no memory is refused with its size and all that it needs.
#[test]
#[cfg(target_os = "linux")]
fn an_image_that_memory_does_not_hold_is_refused() {
    let script = "ulimit -v 524288 && exec \"$0\" --exact the_largest_image_is_asked_for --nocapture";
    let mut child = std::process::Command::new("sh");
    child.args(["-c", script]).arg(std::env::current_exe().expect("this program")).env(LITTLE_MEMORY, "1");
    let output = child.output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    // Twelve bytes a pixel.
    let refused = "no memory for an image of 16384x8192 pixels (1610612736 bytes)";
    assert!(output.status.success() && said.contains(refused), "{said}");
}

#[test]
fn a_new_image_is_all_miss() {
    let image = Image::new(Size::new(3, 2).expect("small"), [1, 2, 3]).expect("small");
    assert_eq!(image.ids, [MISS; 6]);
    assert_eq!(image.t, [f32::INFINITY; 6]);
    assert_eq!(image.rgba, [[1, 2, 3, 255]; 6]);
}

#[test]
fn a_camera_without_a_picture_is_refused() {
    let size = Size::new(4, 4).expect("small");
    let (eye, corner, du, dv) = ([0.0; 3], [-2.0, 2.0, -4.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
    assert!(Camera::new(eye, corner, du, dv, size).is_ok());
    for [du, dv] in [[[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]] {
        assert!(Camera::new(eye, corner, du, dv, size).is_ok(), "{du:?}, {dv:?}");
    }
    for (bad, axis) in NOT_FINITE.into_iter().flat_map(|bad| [0, 1, 2].map(|axis| (bad, axis))) {
        // Finite, it would be one that neither vector is parallel to.
        let mut v = [5.0, 7.0, 11.0];
        v[axis] = bad;
        let camera = [
            ("eye", Camera::new(v, corner, du, dv, size)),
            ("corner", Camera::new(eye, v, du, dv, size)),
            ("du", Camera::new(eye, corner, v, dv, size)),
            ("dv", Camera::new(eye, corner, du, v, size)),
        ];
        for (name, camera) in camera {
            let error = camera.expect_err("not finite");
            assert!(matches!(error, CameraError::NotFinite { field, .. } if field == name), "{error:?}");
        }
    }
    for (du, dv) in
        [([0.0; 3], dv), (du, [0.0; 3]), (du, [-3.0, 0.0, 0.0]), ([1e-30, 1e-30, 0.0], [1e30, 1e30, 0.0])]
    {
        assert_eq!(Camera::new(eye, corner, du, dv, size), Err(CameraError::Degenerate { du, dv }));
    }
    let error =
        Camera::new(eye, corner, [f32::MAX, 0.0, 0.0], dv, size).expect_err("3.5 times the largest f32");
    assert!(matches!(error, CameraError::Overflow { x: 3, y: 0, .. }), "{error:?}");
    let error = Camera::new(eye, corner, du, [0.0, f32::MAX, 0.0], size).expect_err("likewise");
    assert!(matches!(error, CameraError::Overflow { x: 0, y: 3, .. }), "{error:?}");
}

/// The directions of the outermost pixels are those of rule 1, sums in its order and signs as it has them: what they overflow is refused, and
/// nothing else.
#[test]
fn what_overflows_is_what_rule_1_overflows() {
    let camera = |corner: [f32; 3], du: [f32; 3], dv: [f32; 3], width, height| {
        Camera::new([0.0; 3], corner, du, dv, Size::new(width, height).expect("small"))
    };
    let (right, down) = ([1e38, 0.0, 0.0], [0.0, 1e38, 0.0]);
    let infinite = |x, y, direction| Err(CameraError::Overflow { x, y, direction });
    let rest = |sum: f32| sum + 0.5 * 1e38;
    // 2.5 and 0.5 pixels from the corner; neither part alone is too large.
    assert_eq!(
        camera([2e38, 3.0, 4.0], right, [0.0, 2.0, 0.0], 3, 1),
        infinite(2, 0, [f32::INFINITY, 4.0, 4.0])
    );
    assert_eq!(
        camera([3e38, 3.0, 4.0], right, [0.0, 2.0, 0.0], 1, 1),
        infinite(0, 0, [f32::INFINITY, 4.0, 4.0])
    );
    assert_eq!(
        camera([3.0, 2e38, 4.0], [2.0, 0.0, 0.0], down, 1, 3),
        infinite(0, 2, [4.0, f32::INFINITY, 4.0])
    );
    assert_eq!(
        camera([3.0, 3e38, 4.0], [2.0, 0.0, 0.0], down, 1, 1),
        infinite(0, 0, [4.0, f32::INFINITY, 4.0])
    );
    assert_eq!(
        camera([-3e38, -3e38, 4.0], right.map(|x| -x), down, 2, 1),
        infinite(0, 0, [f32::NEG_INFINITY, rest(-3e38), 4.0])
    );
    // The column's part first: what it overflows the row's does not bring back.
    let both = camera([3e38, 0.0, 4.0], right, [-1e38, 1.0, 0.0], 1, 1);
    assert!(matches!(both, Err(CameraError::Overflow { x: 0, y: 0, .. })), "{both:?}");
    for sign in [1.0, -1.0] {
        let toward = |v: [f32; 3]| v.map(|x| sign * x);
        let corner = toward([-3e38, -3e38, 4.0]);
        assert!(camera(corner, toward(right), toward(down), 3, 3).is_ok(), "from {corner:?} inwards");
    }
}

/// Nothing is too nearly parallel: products that are one number in f32 differ.
#[test]
fn nearly_parallel_is_not_parallel() {
    let (size, ulp) = (Size::new(2, 2).expect("small"), f32::EPSILON);
    for turn in 0..3 {
        let turned = |[x, y, z]: [f32; 3]| std::array::from_fn(|i| [x, y, z][(i + turn) % 3]);
        let (du, dv) = (turned([1.0 + ulp, 1.0, 0.0]), turned([1.0 + 2.0 * ulp, 1.0 + ulp, 0.0]));
        assert!(Camera::new([0.0; 3], [1.0; 3], du, dv, size).is_ok(), "{du:?}, {dv:?}");
        let twice = du.map(|x| 2.0 * x);
        assert_eq!(
            Camera::new([0.0; 3], [1.0; 3], du, twice, size),
            Err(CameraError::Degenerate { du, dv: twice })
        );
    }
}

/// What is checked is kept as it was given, each part in its place, and the constants are those that the contract writes.
#[test]
fn what_goes_in_comes_out() {
    let size = Size::new(5, 3).expect("small");
    let [eye, corner, du, dv] = [0.0f32, 3.0, 6.0, 9.0].map(|x| [x + 1.0, -x - 2.0, x * x + 3.5]);
    let camera = Camera::new(eye, corner, du, dv, size).expect("a camera");
    assert_eq!([camera.eye(), camera.corner(), camera.du(), camera.dv()], [eye, corner, du, dv]);
    assert_eq!([camera.size().width(), camera.size().height()], [5, 3]);
    let balls = [1.0, 2.0, 3.0].map(|x| Sphere { center: [x, -x, 4.0 * x], radius: x, color: [1, 2, 3] });
    let scene = Scene::new(balls.to_vec(), [4, 5, 6], [0.5, -0.25, 2.0]).expect("valid");
    assert_eq!(
        (scene.spheres(), scene.background(), scene.light()),
        (balls.as_slice(), [4, 5, 6], [0.5, -0.25, 2.0])
    );
    assert_eq!(Animation::from(scene.clone()).frames(), [scene]);
    assert_eq!([AMBIENT, DIFFUSE], [9.0 / 16.0, 7.0 / 16.0]);
    assert_eq!(DEFAULT_LIGHT.map(|x| x * 7.0), [2.0, 3.0, 6.0]);
    assert_eq!(MAX_SPHERES, 134_217_728);
}

#[test]
fn an_animation_has_frames_of_any_count() {
    assert_eq!(Animation::new(vec![]), Err(AnimationError::NoFrames));
    let frames = vec![scene(vec![]).expect("empty"), scene(vec![BALL; 3]).expect("three")];
    let animation = Animation::new(frames).expect("two frames");
    assert_eq!(animation.frames().iter().map(|f| f.spheres().len()).collect::<Vec<_>>(), [0, 3]);
}
