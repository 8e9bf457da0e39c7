//! Recipes of cases: what proptest draws and makes simpler. A recipe says in words of geometry what shall lie close (a sphere that touches a
//! plane of the grid within 2 ulp on two axes, one whose silhouette a pixel's ray grazes, a twin, a crowd in one cell ...); how it
//! becomes numbers stands in [`super::place`].
//!
//! Two moods: *certain*, integers where every answer is known without any tracer ([`super::lattice::Lattice`]), and *anything*.

use crate::case::Asked;
use crate::subject::NAIVE_ALL;
use optimized::Level;
use optimized::Plan;
use optimized::plan::{
    Arithmetic, Cells, Culling, Loop, Margins, OnEvent, Packet, Resolution, Sharing, Voxelizer,
};
use optimized::sphere::Form;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

/// How a sphere comes to be. Lengths are in sizes of the scene, places from 0 to 1 in its cube.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "each says what its numbers are")]
pub enum Ball {
    /// Anywhere in the scene's cube, so large.
    Anywhere { at: [f32; 3], radius: f32 },
    /// So that it touches planes of the grid, on the first `axes` of three from `turn` on, on their upper or lower side, but for some ulp.
    Touching {
        at: [f32; 3],
        radius: f32,
        axes: u8,
        turn: u8,
        planes: [u8; 3],
        upper: [bool; 3],
        ulps: [i8; 3],
    },
    /// The same as an earlier one.
    Twin { of: u8 },
    /// An earlier one mirrored in the plane through the eye at right angles to an axis: rays within that plane hit both at once.
    Mirrored { of: u8, axis: u8 },
    /// Around the same centre as an earlier one, larger or smaller.
    Around { of: u8, factor: f32 },
    /// Touching an earlier one from outside, along an axis.
    Beside { of: u8, axis: u8, upper: bool },
    /// Around the eye.
    AroundEye { off: [f32; 3], radius: f32 },
    /// With the eye on its surface, but for some ulp, along an axis.
    OnEye { radius: f32, axis: u8, upper: bool, ulps: i8 },
    /// Behind the eye.
    Behind { distance: f32, radius: f32 },
    /// So many in one cell.
    Crowd { count: u8, at: [f32; 3], radius: f32 },
    /// So many small ones all over, as a molecule has: more than a tile takes in one round.
    Swarm { count: u16, seed: u32 },
    /// Grazed by a pixel's ray, but for some ulp of the radius.
    Grazed { pixel: [u8; 2], along: f32, radius: f32, turn: u8, ulps: i8 },
    /// Hit by a pixel's ray where an earlier one is, but for some ulp.
    SameHit { of: u8, pixel: [u8; 2], radius: f32, inside: bool },
    /// Any finite numbers.
    Wild { center: [u32; 3], radius: u32 },
}

/// How a camera comes to be.
#[derive(Clone, Debug)]
pub struct View {
    /// Major axis and sense, 0 to 5.
    pub heading: u8,
    /// How far away, in sizes of the scene, as a power of ten.
    pub distance: f32,
    /// How far off the axis, in sizes of the scene; none at all if `straight`.
    pub off: [f32; 2],
    /// Exactly along the axis.
    pub straight: bool,
    /// Width of the picture where the scene is, in sizes of the scene.
    pub width: f32,
    /// Which sphere is looked at; none if there are fewer.
    pub target: u8,
    /// Width and height in pixels.
    pub size: [u8; 2],
    /// Columns run to the left.
    pub mirrored: bool,
}

/// What a case is made of.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// Size of the scene's cube, as a power of ten.
    pub size: f32,
    /// Where it stands, in its sizes from the origin.
    pub offset: f32,
    /// What is in it.
    pub balls: Vec<Ball>,
    /// From where it is seen.
    pub view: View,
    /// By whom.
    pub asked: Asked,
    /// If there is a second frame, which sphere is elsewhere in it, and by how much of the scene's size.
    pub moved: Option<(u8, [f32; 3])>,
}

fn unit() -> impl Strategy<Value = f32> {
    (0u16..=1000).prop_map(|n| f32::from(n) / 1000.0)
}

fn place() -> impl Strategy<Value = [f32; 3]> {
    [unit(), unit(), unit()]
}

/// In sizes of the scene.
fn radius() -> impl Strategy<Value = f32> {
    prop_oneof![4 => (1u16..=40).prop_map(|n| f32::from(n) / 400.0), 1 => (1u16..=60).prop_map(|n| f32::from(n) / 100.0)]
}

fn pixel() -> impl Strategy<Value = [u8; 2]> {
    [any::<u8>(), any::<u8>()]
}

/// One ball.
pub fn ball() -> impl Strategy<Value = Ball> {
    let few = -2i8..=2;
    prop_oneof![
        6 => (place(), radius()).prop_map(|(at, radius)| Ball::Anywhere { at, radius }),
        6 => (place(), radius(), 1u8..=3, 0u8..3, any::<[u8; 3]>(), any::<[bool; 3]>(), [few.clone(), few.clone(), few.clone()])
            .prop_map(|(at, radius, axes, turn, planes, upper, ulps)| Ball::Touching {
                at, radius, axes, turn, planes, upper, ulps
            }),
        1 => any::<u8>().prop_map(|of| Ball::Twin { of }),
        2 => (any::<u8>(), 0u8..3).prop_map(|(of, axis)| Ball::Mirrored { of, axis }),
        1 => (any::<u8>(), 1u16..=30).prop_map(|(of, f)| Ball::Around { of, factor: f32::from(f) / 10.0 }),
        1 => (any::<u8>(), 0u8..3, any::<bool>()).prop_map(|(of, axis, upper)| Ball::Beside { of, axis, upper }),
        1 => (place(), radius()).prop_map(|(off, radius)| Ball::AroundEye { off, radius }),
        1 => (radius(), 0u8..3, any::<bool>(), few.clone())
            .prop_map(|(radius, axis, upper, ulps)| Ball::OnEye { radius, axis, upper, ulps }),
        1 => (unit(), radius()).prop_map(|(distance, radius)| Ball::Behind { distance, radius }),
        1 => (5u8..=24, place(), radius()).prop_map(|(count, at, radius)| Ball::Crowd { count, at, radius }),
        4 => (pixel(), unit(), radius(), any::<u8>(), few.clone())
            .prop_map(|(pixel, along, radius, turn, ulps)| Ball::Grazed { pixel, along, radius, turn, ulps }),
        2 => (any::<u8>(), pixel(), radius(), any::<bool>())
            .prop_map(|(of, pixel, radius, inside)| Ball::SameHit { of, pixel, radius, inside }),
    ]
}

/// What so many scenes of a hundred have besides: hundreds of small spheres.
fn swarm(percent: u8) -> impl Strategy<Value = Option<Ball>> {
    (0u8..100, 200u16..=900, any::<u32>())
        .prop_map(move |(n, count, seed)| (n < percent).then_some(Ball::Swarm { count, seed }))
}

/// One ball of any finite numbers.
pub fn wild() -> impl Strategy<Value = Ball> {
    (any::<[u32; 3]>(), any::<u32>()).prop_map(|(center, radius)| Ball::Wild { center, radius })
}

fn view() -> impl Strategy<Value = View> {
    let distance = prop_oneof![
        2 => (-20i16..=0).prop_map(|n| f32::from(n) / 10.0),
        4 => (0i16..=10).prop_map(|n| f32::from(n) / 10.0),
        1 => (10i16..=40).prop_map(|n| f32::from(n) / 10.0),
    ];
    let width = prop_oneof![3 => (1u16..=30).prop_map(|n| f32::from(n) / 10.0), 1 => (1u16..=100).prop_map(|n| f32::from(n) / 1e4)];
    let off = (-100i16..=100).prop_map(|n| f32::from(n) / 100.0);
    let side = prop_oneof![1u8..=20, Just(4), Just(8), Just(1)];
    (
        0u8..6,
        distance,
        [off.clone(), off],
        prop::bool::weighted(0.2),
        width,
        any::<u8>(),
        [side.clone(), side],
        any::<bool>(),
    )
        .prop_map(|(heading, distance, off, straight, width, target, size, mirrored)| View {
            heading,
            distance,
            off,
            straight,
            width,
            target,
            size,
            mirrored,
        })
}

/// Every arithmetic.
pub const ARITHMETICS: [Arithmetic; 5] = [
    Arithmetic::Certified,
    Arithmetic::Rounded(Form::Perpendicular),
    Arithmetic::Rounded(Form::Textbook),
    Arithmetic::Spu(Form::Perpendicular),
    Arithmetic::Spu(Form::Textbook),
];

/// Any plan that promises its picture, of these arithmetics.
pub fn plan(arithmetics: &'static [Arithmetic]) -> impl Strategy<Value = Plan> {
    let voxelizer =
        select(vec![Voxelizer::BoxRange, Voxelizer::ByCenter, Voxelizer::Overlap, Voxelizer::EightCorners]);
    let cells = select(vec![Cells::Lists, Cells::Queue]);
    let walk = select(vec![Loop::Nested, Loop::Flattened]);
    let culling = select(vec![Culling::Planes, Culling::None]);
    let resolution = prop_oneof![
        (1u8..=20).prop_map(Resolution::Fixed),
        (1u8..=240).prop_map(Resolution::UpTo),
        Just(Resolution::Fixed(16)),
    ];
    let on_event = prop_oneof![9 => Just(OnEvent::FallBack), 1 => Just(OnEvent::Refuse)];
    let sharing = select(vec![Sharing::Shared, Sharing::Mirrored]);
    let blocks =
        (voxelizer, cells, walk, culling.clone(), resolution.clone(), on_event, sharing, select(arithmetics))
            .prop_map(|(voxelizer, cells, walk, culling, resolution, on_event, sharing, arithmetic)| Plan {
                voxelizer,
                cells,
                walk,
                packet: Packet::Block,
                culling,
                margins: Margins::Derived,
                arithmetic,
                resolution,
                on_event,
                sharing,
            });
    let tiles = (1u8..=6, culling, resolution).prop_map(|(side, culling, resolution)| Plan {
        packet: Packet::Tile { side },
        culling,
        resolution,
        ..Plan::fast()
    });
    let fast = Just(Plan::fast());
    if arithmetics.contains(&Arithmetic::Certified) {
        prop_oneof![3 => blocks, 2 => tiles, 1 => fast].boxed()
    } else {
        blocks.boxed()
    }
}

/// The grid tracer in any way, or a naive tracer.
pub fn asked(arithmetics: &'static [Arithmetic]) -> impl Strategy<Value = Asked> {
    let level = select(Level::available());
    let grid = (plan(arithmetics), level, 1u8..=3).prop_map(|(plan, level, workers)| Asked::Grid {
        plan,
        level,
        workers,
    });
    let naive = select(NAIVE_ALL.to_vec()).prop_map(Asked::Naive);
    if arithmetics.len() == ARITHMETICS.len() {
        prop_oneof![9 => grid, 1 => naive].boxed()
    } else {
        grid.boxed()
    }
}

/// Recipes of balls of a kind, at most so many of them, `swarms` in a hundred with a swarm besides.
pub fn recipe(
    balls: impl Strategy<Value = Ball>,
    most: usize,
    swarms: u8,
    arithmetics: &'static [Arithmetic],
) -> impl Strategy<Value = Recipe> {
    let size = prop_oneof![3 => Just(0.0f32), 1 => (-30i16..=60).prop_map(|n| f32::from(n) / 10.0)];
    let offset = prop_oneof![2 => Just(0.0f32), 1 => (-1000i16..=1000).prop_map(|n| f32::from(n) / 10.0)];
    let moved = prop::option::weighted(0.2, (any::<u8>(), place()));
    (size, offset, vec(balls, 0..=most), swarm(swarms), view(), asked(arithmetics), moved).prop_map(
        |(size, offset, mut balls, swarm, view, asked, moved)| {
            balls.extend(swarm);
            Recipe { size, offset, balls, view, asked, moved }
        },
    )
}
