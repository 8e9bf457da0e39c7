//! How often each method is wrong at each value: shots are drawn, the exact picture is made of each, and every method's is held against it.
//!
//! Values share the processor's cores; a method has one thread. What is drawn depends on the seed, the sweep, the value and the number of
//! the shot alone, so that a run is the same whatever the number of cores.

use super::breakdown::breakdown;
use super::data::{Count, Curve, Line, Map};
use super::relation::{RELATIONS, Relation};
use super::scenes::{SIDE, Shot};
use super::sweep::{CROWDS, RATIOS, SWEEPS, Sweep, crowded};
use crate::judge::compare::ulps_apart;
use crate::methods::{Family, Method, with_cells};
use crate::seed::generator;
use contract::{Camera, Image, MISS, Scene};
use optimized::plan::Packet;
use optimized::tile::MAX_SIDE;
use optimized::{Form, Level, Plan};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use reference::{Arithmetic, Tracer};

/// A scene of which whole pictures are judged.
#[derive(Clone, Debug)]
pub struct Named {
    /// What to call it.
    pub name: String,
    /// Its spheres.
    pub scene: Scene,
    /// Its camera.
    pub camera: Camera,
}

/// What is measured.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// Makes the methods, with so many cells on each axis of their grids where that is given.
    pub methods: &'a (dyn Fn(Option<u8>) -> Vec<Method> + Sync),
    /// Level of the grid tracer.
    pub level: Level,
    /// Rays at each value.
    pub rays: u64,
    /// Of what is drawn.
    pub seed: u64,
    /// Scenes on which grid and packet are turned up.
    pub scenes: &'a [Named],
    /// Curves and maps by their names; all if none is named.
    pub only: &'a [String],
}

impl Asked<'_> {
    fn wants(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only == name)
    }
}

/// Maps by their names.
const MAPS: [&str; 3] = ["assumptions", "grids", "packets"];

/// Names of all curves and maps.
#[must_use]
pub fn names() -> Vec<String> {
    let curves = SWEEPS.iter().map(|sweep| sweep.name).chain(RELATIONS.iter().map(|relation| relation.name));
    curves.chain(MAPS).map(str::to_owned).collect()
}

/// Cells on each axis of the plans in the map over grids.
pub const GRIDS: [u8; 12] = [2, 4, 6, 8, 10, 12, 16, 20, 24, 32, 48, 64];
/// Blocks on a side of a tile in the map over packets.
const SIDES: [u8; 7] = [1, 2, 4, 8, 16, 32, MAX_SIDE];

/// Steps that [`stability`] ticks.
#[must_use]
pub fn steps(asked: &Asked<'_>) -> u32 {
    let sweeps = SWEEPS.iter().map(|sweep| (sweep.name, (sweep.values)().len()));
    let relations = RELATIONS.iter().map(|relation| (relation.name, (relation.values)().len()));
    let maps = MAPS.into_iter().zip([RATIOS.len(), asked.scenes.len(), asked.scenes.len()]);
    let all = sweeps.chain(relations).chain(maps).filter(|(name, _)| asked.wants(name));
    u32::try_from(all.map(|(_, steps)| steps).sum::<usize>()).unwrap_or(u32::MAX)
}

/// What makes a map.
type Mapping = fn(&Asked<'_>, &(dyn Fn() + Sync)) -> Map;

/// All curves and maps; `tick` is called [`steps`] times.
#[must_use]
pub fn stability(asked: &Asked<'_>, tick: &(dyn Fn() + Sync)) -> (Vec<Curve>, Vec<Map>) {
    let sweeps = SWEEPS.iter().zip(0..).filter(|(sweep, _)| asked.wants(sweep.name));
    let relations = RELATIONS.iter().zip(100..).filter(|(relation, _)| asked.wants(relation.name));
    let curves = sweeps
        .map(|(sweep, k)| curve(asked, sweep, k, tick))
        .chain(relations.map(|(relation, k)| related(asked, relation, k, tick)))
        .collect();
    let map: [Mapping; 3] = [assumptions, grids, packets];
    let maps = MAPS.into_iter().zip(map).filter(|(name, _)| asked.wants(name));
    (curves, maps.map(|(_, map)| map(asked, tick)).collect())
}

/// The generator of a shot.
fn drawn(asked: &Asked<'_>, sweep: u64, value: u64, shot: u64) -> Pcg64Mcg {
    generator(asked.seed, (sweep << 48) ^ (value << 32) ^ shot)
}

/// What a method answered, if it did.
fn answer(method: &Method, shot: &Shot) -> Option<(Vec<u32>, Vec<f32>)> {
    let mut contestant = method.contestant(&shot.scene, &shot.camera).ok()?;
    let frame = contestant.frame(&shot.scene, &shot.camera).ok()?;
    Some((frame.layers.ids.to_vec(), frame.layers.t.to_vec()))
}

/// Counts of one method at one value, and the errors of t so far.
#[derive(Default)]
struct Tally(Count, Vec<u64>);

impl Tally {
    /// Counts a picture; of t only if there is one to compare with.
    fn add(&mut self, ids: &[u32], t: Option<&[f32]>, given: Option<(Vec<u32>, Vec<f32>)>) {
        let Self(count, ulps) = self;
        let Some(given) = given else {
            count.refused += 1;
            return;
        };
        count.rays += ids.len() as u64;
        for (i, id) in ids.iter().enumerate() {
            let came = given.0.get(i).copied();
            count.hits += u64::from(*id != MISS);
            count.wrong += u64::from(came != Some(*id));
            if let Some(t) = t.filter(|_| *id != MISS && came == Some(*id)) {
                let own = given.1.get(i).copied();
                *count.wrong_t.get_or_insert(0) += u64::from(own.map(f32::to_bits) != Some(t[i].to_bits()));
                ulps.push(own.map_or(u64::MAX, |own| ulps_apart(t[i], own)));
            }
        }
    }

    fn against(&mut self, truth: &Image, given: Option<(Vec<u32>, Vec<f32>)>) {
        self.add(&truth.ids, Some(&truth.t), given);
    }

    fn done(self) -> Count {
        let Self(count, mut ulps) = self;
        ulps.sort_unstable();
        let p99 = ulps.get((ulps.len().max(1) - 1) * 99 / 100).copied();
        Count { t_ulp_p99: p99, ..count }
    }
}

fn truth(shot: &Shot) -> Option<Image> {
    Some(Tracer::new(Arithmetic::Exact).threads(1).render(&shot.scene, &shot.camera).ok()?.image)
}

fn curve(asked: &Asked<'_>, sweep: &Sweep, number: u64, tick: &(dyn Fn() + Sync)) -> Curve {
    let values = (sweep.values)();
    let methods = (asked.methods)(sweep.cells);
    // A shot of one ray costs as much as one of many.
    let shots = if sweep.rays == 1 { asked.rays.div_ceil(64) } else { asked.rays.div_ceil(sweep.rays) };
    let columns: Vec<Vec<Count>> = values
        .par_iter()
        .enumerate()
        .map(|(k, value)| {
            let mut tallies: Vec<Tally> = methods.iter().map(|_| Tally::default()).collect();
            for shot in 0..shots {
                let Some(shot) = (sweep.shot)(*value, &mut drawn(asked, number, k as u64, shot)) else {
                    continue;
                };
                let Some(truth) = truth(&shot) else { continue };
                // Of a single ray it is the sphere at stake alone that counts; of a picture all.
                for (method, tally) in methods.iter().zip(&mut tallies) {
                    tally.against(&truth, answer(method, &shot));
                }
            }
            tick();
            tallies.into_iter().map(Tally::done).collect()
        })
        .collect();
    let marks = sweep.marks.iter().map(|(at, what)| (*at, (*what).to_owned())).collect();
    Curve {
        name: sweep.name.into(),
        title: sweep.title.into(),
        axis: sweep.axis.into(),
        what: sweep.what.into(),
        by_truth: true,
        easy: sweep.easy,
        lines: lines(&methods, &values, &columns, sweep.easy),
        values,
        marks,
    }
}

fn related(asked: &Asked<'_>, relation: &Relation, number: u64, tick: &(dyn Fn() + Sync)) -> Curve {
    let values = (relation.values)();
    let methods = (asked.methods)(None);
    let shots = asked.rays.div_ceil(2 * u64::from(SIDE * SIDE));
    let columns: Vec<Vec<Count>> = values
        .par_iter()
        .enumerate()
        .map(|(k, value)| {
            let mut tallies: Vec<Tally> = methods.iter().map(|_| Tally::default()).collect();
            for shot in 0..shots {
                let mut rng = drawn(asked, number, k as u64, shot);
                let Some([before, after]) = (relation.pair)(*value, &mut rng) else { continue };
                for (method, tally) in methods.iter().zip(&mut tallies) {
                    // Of t nothing is said: what scales a scene scales t.
                    match answer(method, &before) {
                        Some((old, _)) => tally.add(&old, None, answer(method, &after)),
                        None => tally.add(&[], None, None),
                    }
                }
            }
            tick();
            tallies.into_iter().map(Tally::done).collect()
        })
        .collect();
    Curve {
        name: relation.name.into(),
        title: relation.title.into(),
        axis: relation.axis.into(),
        what: relation.what.into(),
        by_truth: false,
        easy: relation.easy,
        lines: lines(&methods, &values, &columns, relation.easy),
        values,
        marks: Vec::new(),
    }
}

fn lines(methods: &[Method], values: &[f64], columns: &[Vec<Count>], easy: f64) -> Vec<Line> {
    let line = |(k, method): (usize, &Method)| {
        let counts: Vec<Count> = columns.iter().map(|column| column[k]).collect();
        let rates: Vec<Option<f64>> = counts.iter().map(Count::rate).collect();
        Line {
            method: method.name.clone(),
            family: method.family,
            exact: method.exact,
            breakdown: breakdown(values, &rates, easy),
            counts,
        }
    };
    methods.iter().enumerate().map(line).collect()
}

/// The paper's plan over both of its assumptions, against one loop over all balls in the same form: what rounding does is not shown.
fn assumptions(asked: &Asked<'_>, tick: &(dyn Fn() + Sync)) -> Map {
    let level = asked.level;
    let paper = Method::grid("paper", Family::Paper, |_| Plan::paper(), level, 1);
    let shots = asked.rays.div_ceil(u64::from(SIDE * SIDE));
    let row = |(k, ratio): (usize, &f64)| {
        let of = |(j, count): (usize, &usize)| {
            let mut tally = Tally::default();
            for shot in 0..shots {
                let mut rng = drawn(asked, 200 + j as u64, k as u64, shot);
                let Some(shot) = crowded(*count, *ratio, &mut rng) else { continue };
                let naive = Tracer::new(Arithmetic::F32Textbook).threads(1).render(&shot.scene, &shot.camera);
                let Ok(naive) = naive else { continue };
                tally.against(&naive.image, answer(&paper, &shot));
            }
            tally.done()
        };
        let row: Vec<Count> = CROWDS.iter().enumerate().map(of).collect();
        tick();
        row
    };
    Map {
        name: "assumptions".into(),
        title: "Both assumptions of the paper".into(),
        what: "The paper's plan on balls about the middle of one cell of its 16 on an axis, against one loop over all balls in the same form: how wide they are, and how many. Below the line they are wider than a cell, right of the other there are more than sixteen."
            .into(),
        axis: "balls about one cell".into(),
        columns: CROWDS.iter().map(ToString::to_string).collect(),
        rows: RATIOS.iter().map(|ratio| format!("{ratio} cells wide")).collect(),
        exact: vec![false; RATIOS.len()],
        counts: RATIOS.par_iter().enumerate().map(row).collect(),
        marks: CROWDS.iter().position(|count| *count > 16).map(|k| (k, "more than 16 slots".to_owned())).into_iter().collect(),
        row_marks: RATIOS.iter().position(|ratio| *ratio > 1.0).into_iter().collect(),
    }
}

/// Whole pictures of named scenes by plans with growing grids.
fn grids(asked: &Asked<'_>, tick: &(dyn Fn() + Sync)) -> Map {
    let textbook = Plan { arithmetic: Form::Textbook.into(), ..Plan::safe() };
    let plans = [
        ("paper", Family::Paper, Plan::paper()),
        ("safe, same form", Family::Textbook, textbook),
        ("exact", Family::Exact, Plan::fast()),
    ];
    let (mut rows, mut exact, mut counts) = (Vec::new(), Vec::new(), Vec::new());
    for named in asked.scenes {
        let shot = Shot { scene: named.scene.clone(), camera: named.camera };
        let truth = Tracer::new(Arithmetic::Exact).render(&shot.scene, &shot.camera);
        for (name, family, plan) in plans {
            let at = |cells: &u8| {
                let plan = with_cells(plan, *cells);
                let method = Method::grid(name, family, move |_| plan, asked.level, 1);
                let mut tally = Tally::default();
                if let Ok(truth) = &truth {
                    tally.against(&truth.image, answer(&method, &shot));
                }
                tally.done()
            };
            rows.push(format!("{}, {name}", named.name));
            exact.push(family == Family::Exact);
            counts.push(GRIDS.iter().map(at).collect());
        }
        tick();
    }
    Map {
        name: "grids".into(),
        title: "Cells of the grid".into(),
        what: "Whole pictures by three plans, with so many cells on each axis: all pixels, background too, against the exact one.".into(),
        axis: "cells on each axis".into(),
        columns: GRIDS.iter().map(ToString::to_string).collect(),
        rows,
        exact,
        counts,
        marks: GRIDS.iter().position(|n| *n == 16).map(|k| (k, "the paper's 16".to_owned())).into_iter().collect(),
        row_marks: Vec::new(),
    }
}

/// Whole pictures of named scenes by the exact plan with growing packets.
fn packets(asked: &Asked<'_>, tick: &(dyn Fn() + Sync)) -> Map {
    let packets = std::iter::once(Packet::Block).chain(SIDES.map(|side| Packet::Tile { side }));
    let packets: Vec<Packet> = packets.collect();
    let (mut rows, mut counts) = (Vec::new(), Vec::new());
    for named in asked.scenes {
        let shot = Shot { scene: named.scene.clone(), camera: named.camera };
        let truth = Tracer::new(Arithmetic::Exact).render(&shot.scene, &shot.camera);
        let at = |packet: &Packet| {
            let plan = Plan { packet: *packet, ..Plan::fast() };
            let method = Method::grid("exact", Family::Exact, move |_| plan, asked.level, 1);
            let mut tally = Tally::default();
            if let Ok(truth) = &truth {
                tally.against(&truth.image, answer(&method, &shot));
            }
            tally.done()
        };
        rows.push(named.name.clone());
        counts.push(packets.iter().map(at).collect());
        tick();
    }
    let word = |packet: &Packet| match packet {
        Packet::Block => "4x4".to_owned(),
        Packet::Tile { side } => format!("{0}x{0}", 4 * u32::from(*side)),
    };
    Map {
        name: "packets".into(),
        title: "Size of a packet".into(),
        what: "Whole pictures by the exact plan with packets of so many rays, from the paper's 4x4 to tiles of blocks.".into(),
        axis: "rays of a packet".into(),
        columns: packets.iter().map(word).collect(),
        exact: vec![true; rows.len()],
        rows,
        counts,
        marks: Vec::new(),
        row_marks: Vec::new(),
    }
}
