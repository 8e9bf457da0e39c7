//! Does the contract refuse what no tracer can answer for, and name it? Does it let everything else in?

use contract::{
    Animation, AnimationError, Camera, CameraError, DEFAULT_LIGHT, Image, MAX_PIXELS, MAX_SIDE, MAX_SPHERES,
    MISS, Scene, SceneError, Size, SizeError, Sphere,
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
        let error = Scene::new(vec![], [0; 3], [0.0, bad, 0.0]).expect_err("not finite");
        assert!(matches!(error, SceneError::Light { .. }), "{error:?}");
    }
    for radius in [0.0, -0.0, -1.0, -f32::MIN_POSITIVE] {
        let error = scene(vec![BALL, BALL, Sphere { radius, ..BALL }]).expect_err("not above zero");
        assert_eq!(error, SceneError::Radius { sphere: 2, radius });
        assert!(error.to_string().contains(&format!("sphere 2: radius is {radius:?}")), "{error}");
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
    for (width, height) in [(1, 1), (3, 5), (1280, 720), (7680, 4320), (MAX_SIDE, 1)] {
        let size = Size::new(width, height).expect("within limits");
        assert_eq!([size.width(), size.height()], [width, height]);
        assert!(size.pixels() <= MAX_PIXELS);
    }
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
    for bad in NOT_FINITE {
        let v = [0.0, bad, 0.0];
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

#[test]
fn an_animation_has_frames_of_any_count() {
    assert_eq!(Animation::new(vec![]), Err(AnimationError::NoFrames));
    let frames = vec![scene(vec![]).expect("empty"), scene(vec![BALL; 3]).expect("three")];
    let animation = Animation::new(frames).expect("two frames");
    assert_eq!(animation.frames().iter().map(|f| f.spheres().len()).collect::<Vec<_>>(), [0, 3]);
}
