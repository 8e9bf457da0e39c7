//! Is the map from coordinates to cells monotone, and does every f32 lie in the cell whose planes hold it? For given axes, over the
//! patterns of all f32: `CGT_CELL_STEP=1` takes all 2³², every day one row of sixteen in 61, and the neighbours of every plane.

use contract::{Camera, Size};
use optimized::crew::Crew;
use optimized::event::Events;
use optimized::grid::{Axis, Memory};
use optimized::host::{Level, Scalar};
use optimized::plan::Plan;
use optimized::seen::Seen;
use verify::cells::{Swept, sweep};
use verify::scenes::catalogue::Source;
use verify::seed::count;

fn step() -> u32 {
    u32::try_from(count("CGT_CELL_STEP", 61)).expect("a step").max(1)
}

/// All patterns of numbers, and all that are none.
const ALL: [u64; 2] = [2 * 0x7f80_0001, 2 * 0x7f_ffff];

fn hold(name: &str, axis: &Axis, step: u32) -> Swept {
    let level = Level::available().into_iter().last().expect("at least the scalar one");
    let swept = sweep(level, axis, step);
    let Axis { n, planes, .. } = axis;
    eprintln!("{name}, {level}: {n} cells from {:e} to {:e}: {swept:?}", planes[0], planes[planes.len() - 1]);
    assert_eq!(swept.wrong, 0, "{name}: {:?}", swept.first);
    assert_eq!(ALL[0] + ALL[1], 1 << 32);
    if step == 1 {
        assert_eq!([swept.numbers, swept.nans], ALL, "{name}");
    } else {
        let least = ALL.map(|all| all / u64::from(step) / 2);
        assert!(swept.numbers > least[0] && swept.nans > least[1], "{name}: {swept:?}");
    }
    swept
}

#[test]
fn every_f32_lies_between_the_planes_of_its_cell_in_grids_of_scenes() {
    let size = Size::new(4, 4).expect("small");
    let camera = Camera::new([0.0, 0.0, 300.0], [-0.5, 0.5, -1.0], [0.25, 0.0, 0.0], [0.0, -0.25, 0.0], size);
    let camera = camera.expect("a camera");
    let mut axes = 0;
    for word in ["1hvr", "sphereflake:3", "2juy"] {
        let loaded = Source::parse(word).and_then(|source| source.load()).expect("bundled or generated");
        let scene = &loaded.animation.frames()[0];
        for (name, plan) in [("safe", Plan::safe()), ("fast", Plan::fast())] {
            let (mut memory, mut events) = (Memory::default(), Events::default());
            let seen = Seen::new(Scalar, plan, scene, &camera, &mut memory, &mut events, &Crew::alone());
            let grid = seen.expect("refuses nothing").grid.expect("in range");
            for (axis, letter) in grid.axes.iter().zip(["x", "y", "z"]) {
                hold(&format!("{word}, {name}, {letter}"), axis, step());
                axes += 1;
            }
        }
    }
    assert_eq!(axes, 18);
}

/// Axes that are long, short, far from the origin, on either side of it, and of one to as many cells as there can be.
fn directed() -> Vec<(&'static str, f32, f32, i32)> {
    let billion = (1u32 << 30) as f32;
    vec![
        ("of one cell", -1.0, 2.0, 1),
        ("of two cells", -1.0, 1.0, 2),
        ("of sixteen cells", 0.0, 1.6, 16),
        ("of 240 cells", -0.3, 0.7, 240),
        ("from -8", -8.0, 8.0, 16),
        ("as far as margins are derived", -billion, billion, 240),
        ("as small as a sphere may be", -1.0 / billion, 1.0 / billion, 16),
        ("of subnormal numbers", -3e-42, 5e-42, 240),
        ("from 1e30", 1e30, 1.000_01e30, 240),
        ("of nearly all f32", -1e38, 2e38, 16),
        ("of an extent beyond f32", -3e38, 3e38, 16),
        ("of ten numbers", 8.0, 8.000_009, 240),
        ("of two numbers", 1.0, 1.0f32.next_up(), 240),
        ("of one number", 5.0, 5.0, 16),
        ("below zero", -1000.0, -0.1, 7),
    ]
}

#[test]
fn every_f32_lies_between_the_planes_of_its_cell_in_directed_grids() {
    for (name, lo, hi, n) in directed() {
        let axis = Axis::new(Scalar, lo, hi, n);
        let one = lo == hi || (hi - lo).is_infinite();
        assert_eq!(axis.n, if one { 1 } else { n }, "{name}");
        assert!(axis.planes.is_sorted(), "{name}: {:?}", axis.planes);
        hold(name, &axis, step());
    }
}

/// A plane that is one f32 off must be found out.
#[test]
fn a_plane_in_the_wrong_place_is_found_out() {
    for (name, lo, hi, n) in [("of sixteen cells", 0.0, 1.6, 16), ("from -8", -8.0, 8.0, 16)] {
        for plane in 1..16 {
            let mut axis = Axis::new(Scalar, lo, hi, n);
            for moved in [axis.planes[plane].next_up(), axis.planes[plane].next_down()] {
                axis.planes[plane] = moved;
                let swept = sweep(Level::SCALAR, &axis, 1 << 20);
                assert!(swept.wrong > 0, "{name}: plane {plane} at {moved:e} is not found out");
                axis = Axis::new(Scalar, lo, hi, n);
            }
        }
    }
}

/// Cells are equally wide: each plane lies where the axis is divided, but for the roundings of the map, three of what an end is and one of
/// the plane itself.
#[test]
fn planes_divide_the_axis_evenly() {
    let mut judged = 0;
    // The others have cells of no width in f32.
    for (name, lo, hi, n) in directed() {
        let axis = Axis::new(Scalar, lo, hi, n);
        if axis.n == 1 || !axis.inverse.is_normal() {
            continue;
        }
        let [from, to] = [lo, hi].map(f64::from);
        let slack = 4.0 * (from.abs() + to.abs()) / f64::from(1u32 << 23);
        for (i, plane) in (0..).zip(&axis.planes) {
            let even = from + (to - from) * f64::from(i) / f64::from(n);
            let off = (f64::from(*plane) - even).abs();
            assert!(off <= slack, "{name}: plane {i} at {plane:e} is {off:e} from {even:e}");
            judged += 1;
        }
    }
    eprintln!("{judged} planes");
    assert!(judged > 800, "too little was at stake");
}
