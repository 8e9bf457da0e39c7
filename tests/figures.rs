//! Do the paper's figures show what the code does? Their cells are counted against the tracer's own counts, their missed cells against
//! an overlap that is decided in another way, their loops against each other, their shades against the model; and what is drawn is
//! well-formed, has a style for all it names, and can be read.

use contract::{Camera, DEFAULT_LIGHT, Scene, Size};
use optimized::camera::{CameraLanes, middles};
use optimized::crew::Crew;
use optimized::grid::{Grid, Memory};
use optimized::host::Scalar;
use optimized::plan::{Cells, Loop, Plan, Voxelizer};
use optimized::seen::{Seen, Worker};
use optimized::{Event, Events, Level, Tracer};
use roxmltree::{Document, Node};
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;
use verify::case::Case;
use verify::figures::block::{Fate, Walked, chosen, walked};
use verify::figures::corners::Cell;
use verify::figures::loops::Loops;
use verify::figures::screen::{draw, timed};
use verify::figures::{Figure, FigureError, Input, alone, corners, figures, loops, traced};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::spu::model::{Blocks, measure_nearest};
use verify::spu::predict::Policy;
use verify::visible::listed;

/// Scenes and plans, all without fetched data.
const VIEWS: [(&str, bool); 4] =
    [("1hvr", true), ("1hvr", false), ("sphereflake:3", true), ("uniform:500:1", true)];

fn view(word: &str, size: [u32; 2]) -> (Scene, Camera) {
    let loaded = Source::parse(word).and_then(|source| source.load()).expect("no data is needed");
    let size = Some(Size::new(size[0], size[1]).expect("small"));
    let camera = loaded.camera(&Framing { size, ..Framing::default() }).expect("a camera");
    (loaded.animation.frames()[0].clone(), camera)
}

fn input<'a>(name: &'a str, scene: &'a Scene, camera: &'a Camera, paper: bool) -> Input<'a> {
    let plan = if paper { Plan::paper() } else { Plan::safe() };
    Input { name, scene, camera, plan, pixel: None, level: Level::best().expect("a level") }
}

fn seen(input: &Input<'_>, plan: Plan) -> Seen {
    let (mut memory, mut events) = (Memory::default(), Events::default());
    Seen::new(Scalar, plan, input.scene, input.camera, &mut memory, &mut events, &Crew::alone())
        .expect("goes on")
}

fn named<'a>(all: &'a [Figure], name: &str) -> &'a Figure {
    all.iter().find(|figure| figure.name == name).expect("it is drawn")
}

fn classes<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = &'a str> {
    node.attribute("class").unwrap_or_default().split(' ').filter(|class| !class.is_empty())
}

/// Elements of a kind and a class.
fn count(document: &Document<'_>, tag: &str, class: &str) -> usize {
    let of = |node: &Node<'_, '_>| {
        node.has_tag_name(("http://www.w3.org/2000/svg", tag))
            && node.attribute("class").is_some_and(|all| all.split(' ').any(|one| one == class))
    };
    document.descendants().filter(of).count()
}

fn number(node: &Node<'_, '_>, name: &str) -> f64 {
    let text = node.attribute(name).unwrap_or_else(|| panic!("no {name}"));
    text.parse().unwrap_or_else(|_| panic!("{name} is {text}"))
}

/// Holds the numbers of a caption, in their order, against what they should be; of those that are not whole it has three digits.
fn tells(caption: &str, due: &[f64]) {
    let plain = caption.replace('\u{202f}', "");
    let words = plain.split(|c: char| !c.is_ascii_digit() && c != '.').map(|word| word.trim_matches('.'));
    let told: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
    let near = |(told, due): (&f64, &f64)| {
        let error = if due.fract() == 0.0 { 0.0 } else { 5e-3 * due };
        (told - due).abs() <= error
    };
    let same = told.len() == due.len() && told.iter().zip(due).all(near);
    assert!(same, "{due:?} is not what stands in: {caption}");
}

/// Whether a node is a shape of a kind and a class; if so, its numbers.
fn shape<const N: usize>(
    node: &Node<'_, '_>,
    tag: &str,
    of: &[&str],
    numbers: [&str; N],
) -> Option<[f64; N]> {
    let is = node.tag_name().name() == tag && classes(*node).any(|class| of.contains(&class));
    is.then(|| numbers.map(|name| number(node, name)))
}

const CIRCLE: [&str; 3] = ["cx", "cy", "r"];

#[test]
fn figures_are_well_formed_and_can_be_read() {
    let style = include_str!("../verify/templates/figures.css");
    let (mut drawn, mut words) = (0, 0);
    for (word, paper) in VIEWS {
        let (scene, camera) = view(word, [160, 90]);
        let all = figures(&input(word, &scene, &camera, paper), &|| ()).expect("it can be drawn");
        let names: Vec<&str> = all.iter().map(|figure| figure.name).collect();
        assert_eq!(names, ["screen", "frustum", "loops", "corners"]);
        let mut ids = BTreeSet::new();
        for Figure { name, title, caption, svg } in &all {
            for text in [svg, &alone(svg)] {
                let document =
                    Document::parse(text).unwrap_or_else(|error| panic!("{word}, {name}: {error}"));
                let root = document.root_element();
                assert!(root.has_tag_name(("http://www.w3.org/2000/svg", "svg")), "{name}");
                assert_eq!(root.attribute("role"), Some("img"));
                assert!(root.attribute("aria-label").is_some_and(|label| label.starts_with(title.as_str())));
                let styles = root.children().filter(|node| node.tag_name().name() == "style").count();
                assert_eq!(styles, usize::from(text.starts_with("<?xml")), "a file carries its style");
            }
            let document = Document::parse(svg).expect("as above");
            let area: Vec<f64> = (document.root_element().attribute("viewBox").expect("an area"))
                .split(' ')
                .map(|x| x.parse().expect("a number"))
                .collect();
            for node in document.descendants().filter(Node::is_element) {
                for class in classes(node).filter(|class| *class != "figure") {
                    assert!(style.contains(&format!(".{class}")), "{name}: nothing says how {class} looks");
                }
                for attribute in node.attributes() {
                    let value = attribute.value();
                    assert!(!value.contains("NaN") && !value.contains("inf"), "{word}, {name}: {value}");
                }
                if let Some(id) = node.attribute("id") {
                    assert!(ids.insert(id.to_owned()), "two figures of a page have {id}");
                }
            }
            // Words stand within the figure, and none on another.
            let mut boxes: Vec<([f64; 4], String)> = Vec::new();
            for node in document.descendants().filter(|node| node.tag_name().name() == "text") {
                let text = node.text().unwrap_or_default().to_owned();
                let (x, y, long) =
                    (number(&node, "x"), number(&node, "y"), 5.8 * text.chars().count() as f64);
                let left = match node.attribute("text-anchor") {
                    Some("start") => x,
                    Some("middle") => x - long / 2.0,
                    _ => x - long,
                };
                let own = [left, y - 8.0, left + long, y];
                assert!(
                    !text.is_empty() && own[0] >= -2.0 && own[2] <= area[2] + 8.0,
                    "{word}, {name}: {text} {own:?}"
                );
                assert!(own[1] >= 0.0 && own[3] <= area[3], "{word}, {name}: {text} {own:?}");
                for (other, said) in &boxes {
                    let apart =
                        own[0] >= other[2] || other[0] >= own[2] || own[1] >= other[3] || other[1] >= own[3];
                    assert!(apart, "{word}, {name}: `{text}` covers `{said}`");
                }
                boxes.push((own, text));
            }
            words += boxes.len();
            assert!(caption.len() > 60 && !caption.contains("NaN"), "{caption}");
            drawn += 1;
        }
        eprintln!("{word}: {}", named(&all, "frustum").caption);
    }
    eprintln!("{drawn} figures with {words} words");
    assert!(drawn == 16 && words > 300);
}

/// The block's cells, spheres and fates are those that the tracer itself counts, drawn once in each view.
#[test]
fn marked_cells_and_spheres_are_those_the_packet_counted() {
    let (mut cells, mut culled, mut ends) = (0, 0, 0);
    for (word, paper) in VIEWS {
        let (scene, camera) = view(word, [96, 54]);
        let input = input(word, &scene, &camera, paper);
        let Blocks { seen, blocks } = traced(&input, &|| ()).expect("a model");
        let at = chosen(&input, &blocks).expect("a block");
        let Walked { cells: visited, met, counts, slices, heading, .. } =
            walked(&seen, &scene, &camera, at).expect("it walks");
        // By the scalar machine, which nothing watches.
        let (xs, ys) = middles(Scalar, &camera, at[0], at[1]);
        let block = CameraLanes::new(Scalar, &camera).block(Scalar, xs, ys);
        let mut worker = Worker::default();
        let answers = seen.trace(Scalar, scene.spheres(), &block, None, &mut worker);
        assert_eq!(counts, worker.counts);
        assert_eq!(visited.len() as u64, worker.counts.cells);
        let times = |fate: Option<Fate>| {
            let of = met.iter().filter(|met| fate.is_none_or(|fate| met.fate == fate));
            of.map(|met| u64::from(met.times)).sum::<u64>()
        };
        assert_eq!(
            [times(None), times(Some(Fate::Culled))],
            [worker.counts.candidates, worker.counts.culled]
        );
        let owners: BTreeSet<u32> =
            answers.owners.id.iter().filter(|id| **id != i32::MAX).map(|id| id.cast_unsigned()).collect();
        let fate =
            |fate| met.iter().filter(|met| met.fate == fate).map(|met| met.id).collect::<BTreeSet<u32>>();
        assert_eq!(fate(Fate::Seen), owners);
        // Each visited cell lists what was met there, and the walk is the beginning of the whole one.
        let whole = loops::visited(input.plan.walk, &slices);
        assert!(whole.starts_with(&visited), "{visited:?} of {whole:?}");
        // Of all blocks that hit, none visits more; all of them together visit what a frame counts.
        let best = blocks.iter().find(|block| block.at == at).expect("it is one of them");
        assert!(best.hits > 0 && best.counts == counts);
        let others = blocks.iter().filter(|block| block.hits > 0 && block.counts.split_blocks == 0);
        assert!(others.clone().all(|block| block.counts.cells <= best.counts.cells) && others.count() > 10);
        let frame = Tracer::new(input.plan, Level::SCALAR).render(&scene, &camera).expect("a picture").counts;
        let sum = blocks.iter().fold(optimized::seen::Counts::default(), |sum, block| sum + block.counts);
        assert_eq!(sum, frame);

        let all = figures(&input, &|| ()).expect("it can be drawn");
        let document = Document::parse(&named(&all, "frustum").svg).expect("well-formed");
        // Twice, and once in the legend.
        assert_eq!(count(&document, "rect", "visited"), 2 * visited.len() + 1, "{word}");
        for (class, of) in [("seen", Fate::Seen), ("vain", Fate::InVain), ("culled", Fate::Culled)] {
            assert_eq!(count(&document, "circle", class), 2 * fate(of).len() + 1, "{word}: {class}");
        }
        assert_eq!(count(&document, "line", "ray"), 2 * 16 + 1);
        let distinct = |cells: &[[i32; 3]]| cells.iter().map(|cell| cell[0]).collect::<BTreeSet<_>>().len();
        let grid = seen.grid.as_ref().expect("a grid");
        tells(
            &named(&all, "frustum").caption,
            &[
                f64::from(at[0]),
                f64::from(at[1]),
                distinct(&whole) as f64,
                f64::from(grid.axes[heading.order[0]].n),
                distinct(&visited) as f64,
                worker.counts.cells as f64,
                worker.counts.candidates as f64,
                met.len() as f64,
                fate(Fate::Culled).len() as f64,
                fate(Fate::InVain).len() as f64,
                owners.len() as f64,
            ],
        );
        // Where a ray ends it meets a sphere that is seen, from both sides: not outside of its outline.
        let seen: Vec<[f64; 3]> =
            document.descendants().filter_map(|node| shape(&node, "circle", &["seen"], CIRCLE)).collect();
        for [x, y, _] in document.descendants().filter_map(|node| shape(&node, "circle", &["end"], CIRCLE)) {
            let within = |[cx, cy, r]: &[f64; 3]| (x - cx).hypot(y - cy) <= r + 0.1;
            assert!(seen.iter().any(within), "{word}: no sphere at ({x}, {y}): {seen:?}");
            ends += 1;
        }
        cells += visited.len();
        culled += fate(Fate::Culled).len();
        eprintln!("{word}: block {at:?}, {} cells, {} spheres", visited.len(), met.len());
    }
    assert!(
        cells > 20 && culled > 5 && ends > 20,
        "{cells} cells, {culled} culled, {ends} ends: too little was at stake"
    );
}

/// In every block the marked cells are as many as its packet counted, also where the walk passes slices of which it sees no cell.
#[test]
fn cells_that_are_passed_by_are_not_marked() {
    let mut passed = 0;
    for (word, paper) in VIEWS {
        let (scene, camera) = view(word, [96, 54]);
        let input = input(word, &scene, &camera, paper);
        let Blocks { seen, blocks } = traced(&input, &|| ()).expect("a model");
        for block in &blocks {
            let (cells, slices) = match walked(&seen, &scene, &camera, block.at) {
                Ok(Walked { cells, slices, .. }) => (cells, slices),
                // Its rays go one by one, or come to no cell.
                Err(FigureError::Split { .. }) => {
                    assert!(block.counts.split_blocks > 0, "{word}: block {:?}", block.at);
                    continue;
                }
                Err(FigureError::Outside { .. }) => {
                    assert_eq!(block.counts.cells, 0, "{word}: block {:?}", block.at);
                    continue;
                }
                Err(error) => panic!("{word}: block {:?}: {error}", block.at),
            };
            assert_eq!(cells.len() as u64, block.counts.cells, "{word}: block {:?}", block.at);
            // Those that the walk has come past, not those behind its end.
            let end = cells.last().map_or(0, |[slice, ..]| usize::try_from(*slice).expect("a slice"));
            passed += (0..end).filter(|slice| slices.is_empty(*slice)).count();
        }
    }
    eprintln!("{passed} slices without cells");
    assert!(passed > 100, "{passed} slices without cells: too little was at stake");
}

/// The cells that a grid of lists has a sphere in.
fn holders(grid: &Grid, id: u32) -> BTreeSet<[usize; 3]> {
    let n = grid.axes.each_ref().map(|axis| axis.n.unsigned_abs() as usize);
    let strides = grid.strides();
    let mut cells = BTreeSet::new();
    for (i, j, k) in (0..n[0]).flat_map(|i| (0..n[1]).flat_map(move |j| (0..n[2]).map(move |k| (i, j, k)))) {
        grid.for_each_id(i * strides[0] + j * strides[1] + k * strides[2], true, |listed| {
            if listed == id {
                cells.insert([i, j, k]);
            }
        });
    }
    cells
}

/// In each slice the cells that the ball meets are those whose squares its section meets. How many squares were judged.
fn sections_meet_their_cells(document: &Document<'_>) -> usize {
    let (mut squares, mut section) = (Vec::<(bool, [f64; 4])>::new(), None::<[f64; 3]>);
    let (mut border, mut judged) = (false, 0);
    for node in document.descendants().filter(Node::is_element) {
        // Words stand before each slice, and before each entry of the legend but its sign.
        if node.has_tag_name(("http://www.w3.org/2000/svg", "text")) {
            for (is_met, [x, y, width, height]) in squares.drain(..).filter(|_| border) {
                let Some([cx, cy, r]) = section else {
                    assert!(!is_met, "a square at ({x}, {y}) is met by nothing");
                    continue;
                };
                let apart =
                    |center: f64, low: f64, long: f64| (low - center).max(center - low - long).max(0.0);
                let apart = apart(cx, x, width).hypot(apart(cy, y, height));
                // Places are drawn to a hundredth of a pixel.
                let is_clear = (apart - r).abs() > 0.1;
                assert!(
                    !is_clear || is_met == (apart < r),
                    "{is_met}: ({x}, {y}) is {apart} from a disc of {r}"
                );
                judged += usize::from(is_clear);
            }
            (border, section) = (false, None);
        }
        border |= shape(&node, "rect", &["border"], []).is_some();
        let place = ["x", "y", "width", "height"];
        if !border {
            let met = shape(&node, "rect", &["right", "missed"], place).map(|square| (true, square));
            squares.extend(met.or(shape(&node, "rect", &["needless"], place).map(|square| (false, square))));
        } else if let Some(circle) = shape(&node, "circle", &["section"], CIRCLE) {
            section = Some(circle);
        }
    }
    judged
}

/// What eight corners miss is what the tracer's own overlap in f64 lists and they do not; over all spheres, what `listed` counts.
#[test]
fn missed_cells_are_the_overlap_less_what_is_listed() {
    let (mut missed, mut judged) = (BTreeMap::new(), 0);
    for (word, paper) in VIEWS {
        let (scene, camera) = view(word, [64, 36]);
        let input = input(word, &scene, &camera, paper);
        let found = corners::of(input.plan, &scene, &camera).expect("a grid");
        let as_lists = Plan { cells: Cells::Lists, ..input.plan };
        let [own, overlap] =
            [as_lists, Plan { voxelizer: Voxelizer::Overlap, ..as_lists }].map(|plan| seen(&input, plan));
        let (own, overlap) = (own.grid.expect("a grid"), overlap.grid.expect("a grid"));
        assert_eq!(found.missed, listed(&own, &scene).missing, "{word}");
        let kept = seen(&input, input.plan).grid.expect("a grid");
        let mut due = vec![scene.spheres().len() as f64];
        due.extend(kept.axes.iter().map(|axis| f64::from(axis.n)));
        for ball in [Some(&found.large), found.small.as_ref()].into_iter().flatten() {
            let [own, overlap, kept] = [&own, &overlap, &kept].map(|grid| holders(grid, ball.id));
            let cells = |so: &dyn Fn(&Cell) -> bool| {
                ball.cells.iter().filter(|(_, cell)| so(cell)).map(|(at, _)| *at).collect::<BTreeSet<_>>()
            };
            let less = |x: &BTreeSet<[usize; 3]>, y| x.difference(y).copied().collect::<BTreeSet<_>>();
            assert_eq!(cells(&Cell::is_missed), less(&overlap, &own), "{word}, sphere {}", ball.id);
            assert_eq!(cells(&Cell::is_needless), less(&own, &overlap), "{word}, sphere {}", ball.id);
            assert_eq!(cells(&Cell::is_pushed_out), less(&own, &kept), "{word}");
            assert_eq!(cells(&|cell: &Cell| cell.listed), own);
            let pushed = less(&own, &kept).len();
            let numbers = [overlap.len(), own.len(), less(&own, &overlap).len(), less(&overlap, &own).len()];
            due.extend([f64::from(ball.id), f64::from(ball.sphere.radius)]);
            due.extend(numbers.into_iter().chain((pushed > 0).then_some(pushed)).map(|n| n as f64));
        }
        due.push(found.missed as f64);
        // Told of eight corners alone, which need that there is none.
        if input.plan.voxelizer == Voxelizer::EightCorners {
            let events =
                Tracer::new(input.plan, Level::SCALAR).render(&scene, &camera).expect("it goes on").events;
            let spans = |event: &&Event| matches!(event, Event::SpansCells { .. });
            due.push(events.first().iter().filter(spans).count() as f64);
        }
        let all = figures(&input, &|| ()).expect("it can be drawn");
        let document = Document::parse(&named(&all, "corners").svg).expect("well-formed");
        let both = |so: &dyn Fn(&Cell) -> bool| {
            let balls = [Some(&found.large), found.small.as_ref()];
            balls.into_iter().flatten().map(|ball| ball.count(so)).sum::<u64>() as usize
        };
        assert_eq!(count(&document, "rect", "missed"), both(&Cell::is_missed) + 1, "{word}");
        assert_eq!(count(&document, "rect", "needless"), both(&Cell::is_needless) + 1, "{word}");
        assert_eq!(count(&document, "line", "pushed"), 2 * both(&Cell::is_pushed_out) + 1, "{word}");
        tells(&named(&all, "corners").caption, &due);
        judged += sections_meet_their_cells(&document);
        eprintln!(
            "{word}, {}: {} missed over all, {} of sphere {}",
            input.plan.voxelizer as u8,
            found.missed,
            found.large.count(Cell::is_missed),
            found.large.id
        );
        missed.insert((word, paper), found.large.count(Cell::is_missed));
    }
    assert!(missed[&("1hvr", true)] > 0, "the paper's plan misses cells of the molecule");
    assert!(missed[&("sphereflake:3", true)] > 0 && missed[&("1hvr", false)] == 0);
    assert!(judged > 100, "{judged} squares: too little was at stake");
}

/// Both loops have one path, the printed one another; and the drawing marks just that.
#[test]
fn both_loops_have_one_path_and_the_printed_one_another() {
    let mut astray = 0;
    for (word, paper) in VIEWS {
        let (scene, camera) = view(word, [96, 54]);
        let input = input(word, &scene, &camera, paper);
        let Blocks { seen, blocks } = traced(&input, &|| ()).expect("a model");
        let at = chosen(&input, &blocks).expect("a block");
        let block = walked(&seen, &scene, &camera, at).expect("it walks");
        let drawn = loops::of(&block.slices);
        let [nested, flattened, printed] = &drawn.visits;
        assert_eq!(nested, flattened, "{word}");
        assert!(nested.is_sorted() && nested.iter().all(|cell| drawn.is_within(*cell)));
        // Its slices are those of the packet, so its cells are a piece of the packet's.
        let whole = loops::visited(Loop::Nested, &block.slices);
        let shifted = |[s, j, k]: &[i32; 3]| [s + i32::try_from(drawn.from).expect("few"), *j, *k];
        let first = nested.first().map(shifted).and_then(|cell| whole.iter().position(|of| *of == cell));
        let first = first.expect("it is a cell of the packet");
        assert_eq!(nested.iter().map(shifted).collect::<Vec<_>>(), whole[first..first + nested.len()]);
        let differs = drawn.missed(2).len() + drawn.extra(2) + drawn.disordered(2);
        assert_eq!(differs > 0, nested != printed, "{word}");
        assert_eq!(drawn.missed(1).len() + drawn.extra(1) + drawn.disordered(1), 0);
        astray += usize::from(differs > 0);

        let all = figures(&input, &|| ()).expect("it can be drawn");
        let document = Document::parse(&named(&all, "loops").svg).expect("well-formed");
        let ordered = 2 * nested.len() + printed.len() - drawn.extra(2) - drawn.disordered(2);
        for (class, expected) in [
            ("ordered", ordered),
            ("disordered", drawn.disordered(2)),
            ("extra", drawn.extra(2)),
            ("missed", drawn.missed(2).len()),
        ] {
            assert_eq!(count(&document, "rect", class), expected + 1, "{word}: {class}");
        }
        let numbers =
            (document.descendants()).filter(|node| node.attribute("class") == Some("order")).count();
        assert_eq!(numbers, nested.len() + flattened.len() + printed.len());
        eprintln!("{word}: {nested:?}; as printed {printed:?}");
    }
    assert!(astray >= 3, "the printed loop goes astray in {astray} packets");
}

/// Five cells of two slices; as printed two visits of no cell, three out of order, and one cell missed.
#[test]
fn a_caption_tells_how_far_astray_a_loop_goes() {
    let (scene, camera) = view("uniform:50:1", [40, 24]);
    let nested = vec![[0, 0, 0], [0, 0, 1], [0, 1, 0], [0, 1, 1], [1, 0, 0]];
    let printed = [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 1, 0], [0, 2, 0], [0, 1, 1], [0, 0, 0]];
    let drawn = Loops {
        from: 4,
        slices: vec![[0, 1, 0, 1], [0, 0, 0, 0]],
        visits: [nested.clone(), nested, printed.to_vec()],
    };
    let caption = loops::draw(&input("by hand", &scene, &camera, true), &drawn).caption;
    tells(&caption, &[4.0, 5.0, 5.0, 5.0, 7.0, 2.0, 3.0, 1.0]);
}

/// One run of a map's path: column, row, blocks.
fn runs(path: &str) -> Vec<[usize; 3]> {
    let all = path.split('M').filter(|run| !run.is_empty());
    let parsed = all.map(|run| {
        let (place, rest) = run.split_once('h').expect("a run");
        let (x, y) = place.split_once(' ').expect("a place");
        let long = rest.split('v').next().expect("a length");
        [x, y, long].map(|number| number.parse().expect("a number"))
    });
    parsed.collect()
}

/// Every block has one shade, a block with more cycles none that is lighter; and the blocks of a frame cost what the frame does.
#[test]
fn the_screen_shows_every_block_and_stripe() {
    let (scene, camera) = view("1hvr", [90, 50]);
    let input = input("1hvr", &scene, &camera, true);
    let Blocks { blocks, .. } = traced(&input, &|| ()).expect("a model");
    assert_eq!(blocks.len(), 23 * 13);
    let frame = measure_nearest(input.plan, &scene, &camera, 1, &|| ()).expect("a model").trace.total();
    let sum = |of: fn(&verify::spu::model::BlockTally) -> u64| blocks.iter().map(of).sum::<u64>();
    assert_eq!([sum(|b| b.booked.even), sum(|b| b.booked.odd)], [frame.even, frame.odd]);
    // Of the dependence bound two neighbours may share some cycles.
    let share = sum(|b| b.booked.in_order) as f64 / frame.in_order as f64;
    eprintln!("in order all blocks take {share} of the frame's cycles");
    assert!((0.98..1.02).contains(&share), "{share}");
    for (k, policy) in [Policy::Unhinted, Policy::Hinted].into_iter().enumerate() {
        assert_eq!(
            blocks.iter().map(|b| b.booked.mispredicts[k]).sum::<u64>(),
            frame.mispredicts[k],
            "{policy:?}"
        );
    }
    let all = figures(&input, &|| ()).expect("it can be drawn");
    let document = Document::parse(&named(&all, "screen").svg).expect("well-formed");
    let mut shades = BTreeMap::new();
    for node in document.descendants().filter(|node| node.tag_name().name() == "path") {
        let shade =
            classes(node).find_map(|class| class.strip_prefix('h')?.parse::<u32>().ok()).expect("a shade");
        for [x, y, long] in runs(node.attribute("d").expect("a path")) {
            for x in x..x + long {
                assert_eq!(shades.insert((y, x), shade), None, "two shades at {x}, {y}");
            }
        }
    }
    assert_eq!(shades.len(), blocks.len());
    // In the order of the map the blocks are row by row.
    let mut by_shade: BTreeMap<u32, [u64; 2]> = BTreeMap::new();
    for (block, shade) in blocks.iter().zip(shades.values()) {
        let cycles = block.booked.dependence_bound(Policy::Hinted);
        let range = by_shade.entry(*shade).or_insert([u64::MAX, 0]);
        *range = [range[0].min(cycles), range[1].max(cycles)];
    }
    eprintln!("cycles by shade: {by_shade:?}");
    assert!(by_shade.len() >= 4, "hardly a shade");
    assert!(by_shade.values().is_sorted_by(|one, other| one[1] < other[0]));
    assert_eq!(count(&document, "rect", "bar"), 13);
    assert_eq!(count(&document, "rect", "chosen"), 1);
    let start = Instant::now();
    let times = timed(&input).expect("a picture");
    let whole = start.elapsed().as_secs_f64() * 1e6;
    assert!(times.len() == 13 && times.iter().all(|time| *time > 0.0 && time.is_finite()));
    // Of each stripe's five runs three took at least as long as is told.
    assert!(3.0 * times.iter().sum::<f64>() <= whole, "{times:?} µs, all in {whole} µs");
}

/// Bars are as long as the times that are given, and the caption has these and the cycles.
#[test]
fn bars_are_as_long_as_their_times() {
    let (scene, camera) = view("1hvr", [90, 50]);
    let input = Input { level: Level::SCALAR, ..input("a molecule", &scene, &camera, true) };
    let Blocks { blocks, .. } = traced(&input, &|| ()).expect("a model");
    let times: Vec<f64> = (1..=13).map(|k| 10.0 * f64::from(k)).collect();
    let drawn = draw(&input, &blocks, &times, [4, 8]);
    let document = Document::parse(&drawn.svg).expect("well-formed");
    let bar = |node| shape(&node, "rect", &["bar"], ["y", "width"]);
    let bars: Vec<[f64; 2]> = document.descendants().filter_map(bar).collect();
    assert!(bars.len() == 13 && bars.is_sorted_by(|one, other| one[0] < other[0]), "{bars:?}");
    for ([_, width], time) in bars.iter().zip(&times) {
        assert!((width / bars[12][1] - time / 130.0).abs() < 1e-3, "{width} for {time} µs: {bars:?}");
    }
    let cycles: Vec<u64> = blocks.iter().map(|block| block.booked.dependence_bound(Policy::Hinted)).collect();
    let most = cycles.iter().max().expect("blocks");
    // Of equals the last.
    let dearest = cycles.iter().rposition(|cycles| cycles == most).expect("it is one of them");
    let dearest = [dearest % 23 * 4, dearest / 23 * 4];
    let split = blocks.iter().filter(|block| block.counts.split_blocks > 0).count();
    let mut due = vec![23.0 * 13.0, 4.0, 4.0, 13.0];
    due.extend(cycles.iter().min().map(|least| *least as f64));
    due.extend([*most as f64, (cycles.iter().sum::<u64>() / 299) as f64]);
    due.extend(dearest.map(|pixel| pixel as f64));
    due.extend((split > 0).then_some(split as f64));
    due.extend([10.0, 130.0, 5.0]);
    tells(&drawn.caption, &due);
}

#[test]
fn a_pixel_is_looked_at_in_its_block() {
    let (scene, camera) = view("1hvr", [96, 54]);
    let input = Input { pixel: Some([50, 30]), ..input("1hvr", &scene, &camera, true) };
    let Blocks { seen, blocks } = traced(&input, &|| ()).expect("a model");
    let at = chosen(&input, &blocks).expect("a pixel");
    assert_eq!(at, [48, 28]);
    assert_eq!(walked(&seen, &scene, &camera, at).expect("it walks").at, at);
    let all = figures(&input, &|| ()).expect("it can be drawn");
    assert!(named(&all, "frustum").caption.contains("The block at pixel (48, 28)"));
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let (scene, camera) = view("uniform:50:1", [40, 24]);
    let good = input("uniform:50:1", &scene, &camera, true);
    let refused = |input: Input<'_>| figures(&input, &|| ()).expect_err("nothing can be drawn");
    assert!(matches!(refused(Input { plan: Plan::fast(), ..good }), FigureError::Plan { .. }));
    let beyond = refused(Input { pixel: Some([40, 0]), ..good });
    assert!(matches!(beyond, FigureError::Beyond { pixel: [40, 0], size: [40, 24] }), "{beyond}");
    let empty = Scene::new(Vec::new(), [0; 3], DEFAULT_LIGHT).expect("an empty scene");
    assert!(matches!(refused(Input { scene: &empty, ..good }), FigureError::NoGrid));
    let corner = refused(Input { pixel: Some([0, 0]), ..good });
    assert!(matches!(corner, FigureError::Outside { at: [0, 0] }), "{corner}");
    let split = include_bytes!("cases/block-is-split.json");
    let split = Case::from_json(split).expect("a case");
    let error = refused(Input { scene: &split.frames.frames()[0], camera: &split.camera, ..good });
    assert!(matches!(error, FigureError::Split { .. }), "{error}");
}
