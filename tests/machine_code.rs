//! Is everything below a door of SIMD code inlined into it, in wide registers, without a fused or estimated operation? And
//! is the flattened step straight-line?
//!
//! The machine code of this very program is judged, which renders a scene at every level and so holds their doors: the
//! functions of `fearless_simd` that have an instruction set enabled. A machine operation that is not inlined is a
//! function of `fearless_simd` of its own; from a door none may be reached, by however many calls; calls through values that the program computes are not followed.

#![cfg_attr(not(all(target_arch = "x86_64", target_os = "linux")), allow(unused))]

use contract::{Camera, DEFAULT_LIGHT, Scene, Size, Sphere};
use iced_x86::{
    Decoder, DecoderOptions, FlowControl, Instruction, InstructionInfoFactory, OpKind, RoundingControl,
};
use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};
use optimized::host::Work;
use optimized::machine::{LANES, Machine, Site};
use optimized::plan::{Cells, Loop, Voxelizer};
use optimized::walk::{Cursor, Rectangle, step};
use optimized::{Form, Level, Plan, Tracer};
use std::collections::{BTreeMap, BTreeSet};

/// Least number of instructions on registers of the level's own width, in the largest of its doors, which is the frame's.
/// At AVX-512 it has four times as many; a door that has lost its kernels has none.
const WIDE: usize = 500;

/// Functions of `fearless_simd` that may be reached from a door, with the reason.
const ALLOWED: [(&str, &str); 5] = [
    (
        "<optimized::host::spu::Spu as ",
        "the SPU's arithmetic by way of f64 is there to be right, and inlined it takes minutes to compile",
    ),
    ("optimized::host::spu::by_bits", "the same, where f32 has not the number"),
    ("optimized::host::truncating::by_spu", "the same, where AVX-512 has not the number"),
    ("::vectorize::", "another door: what is below it is judged there"),
    ("core::ptr::drop_in_place<", "names the machine in the type that it frees, and computes nothing"),
];

/// A function of this program.
struct Function {
    name: String,
    code: Vec<Instruction>,
}

/// The functions of this program by their address, and where the words in memory point through which it calls some.
struct Program {
    functions: BTreeMap<u64, Function>,
    pointers: BTreeMap<u64, u64>,
}

impl Program {
    fn read() -> Self {
        let path = std::env::current_exe().expect("this program");
        let bytes = std::fs::read(path).expect("it can be read");
        let file = object::File::parse(&*bytes).expect("it is an object");
        let mut functions = BTreeMap::new();
        for symbol in file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.size() > 0) {
            let section = symbol.section_index().and_then(|index| file.section_by_index(index).ok());
            let code = section.and_then(|s| s.data_range(symbol.address(), symbol.size()).ok().flatten());
            let Some(code) = code else { continue };
            let name = format!("{:#}", rustc_demangle::demangle(symbol.name().unwrap_or_default()));
            let decoder = Decoder::with_ip(64, code, symbol.address(), DecoderOptions::NONE);
            functions.insert(symbol.address(), Function { name, code: decoder.into_iter().collect() });
        }
        let relocations = file.dynamic_relocations().into_iter().flatten();
        let pointers = relocations.map(|(address, to)| (address, to.addend().cast_unsigned())).collect();
        Self { functions, pointers }
    }

    fn named<'a>(&'a self, part: &'a str) -> impl Iterator<Item = (u64, &'a Function)> {
        self.functions.iter().filter(move |(_, f)| f.name.contains(part)).map(|(address, f)| (*address, f))
    }

    /// The functions that one calls or jumps to, by their address or through a word in memory that does not change.
    fn callees(&self, function: &Function) -> BTreeSet<u64> {
        let target = |i: &Instruction| match i.flow_control() {
            FlowControl::Next | FlowControl::Return => None,
            FlowControl::IndirectCall | FlowControl::IndirectBranch if i.is_ip_rel_memory_operand() => {
                self.pointers.get(&i.ip_rel_memory_address()).copied()
            }
            _ => (i.op0_kind() == OpKind::NearBranch64).then(|| i.near_branch_target()),
        };
        let targets = function.code.iter().filter_map(target);
        targets.filter(|target| self.functions.contains_key(target)).collect()
    }

    /// What is reached from a function, each with a way to it; doors are reached but not gone through.
    fn reached(&self, from: u64) -> BTreeMap<u64, Vec<&str>> {
        let mut reached = BTreeMap::new();
        let mut open = vec![(from, Vec::new())];
        while let Some((address, way)) = open.pop() {
            let function = &self.functions[&address];
            if reached.contains_key(&address) {
                continue;
            }
            let mut longer = way.clone();
            longer.push(function.name.as_str());
            reached.insert(address, longer.clone());
            if address == from || level_of_door(&function.name).is_none() {
                open.extend(self.callees(function).into_iter().map(|callee| (callee, longer.clone())));
            }
        }
        reached.remove(&from);
        reached
    }

    fn doors(&self, level: &str) -> Vec<(u64, &Function)> {
        self.named("::vectorize::").filter(|(_, f)| level_of_door(&f.name) == Some(level)).collect()
    }
}

/// The level whose door has that name, if it is one.
fn level_of_door(name: &str) -> Option<&'static str> {
    let (_, door) = name.split_once("::vectorize::vectorize_")?;
    [("sse2", "sse2"), ("sse4_2", "sse4.2"), ("avx2", "avx2"), ("avx512", "avx512")]
        .into_iter()
        .find(|(part, _)| {
            door.strip_prefix(part).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
        })
        .map(|(_, level)| level)
}

/// Instructions on registers of the level's own width.
fn wide(function: &Function, level: &str) -> usize {
    let mut factory = InstructionInfoFactory::new();
    let mut is_wide = |instruction: &Instruction| {
        let registers = factory.info(instruction).used_registers();
        registers.iter().any(|used| match level {
            "avx512" => used.register().is_zmm(),
            "avx2" => used.register().is_ymm(),
            _ => used.register().is_xmm(),
        })
    };
    function.code.iter().filter(|instruction| is_wide(instruction)).count()
}

/// Operations whose results are not those of the two operations they stand for, or that are estimates. What itself says that it rounds
/// towards zero is the SPU's, and rule 6 of the contract has it fused.
fn is_inexact(instruction: &Instruction) -> bool {
    let name = format!("{:?}", instruction.mnemonic()).to_lowercase();
    let on_spu = instruction.rounding_control() == RoundingControl::RoundTowardZero;
    !on_spu
        && ["vfmadd", "vfmsub", "vfnmadd", "vfnmsub", "vrcp", "vrsqrt", "rcpps", "rcpss", "rsqrt"]
            .iter()
            .any(|start| name.starts_with(start))
}

/// A few spheres, in plans that between them use every kernel, at every level: so their code is in this program.
fn render_all() -> usize {
    let ball =
        |i: u8| Sphere { center: [f32::from(i % 4), f32::from(i / 4), 0.0], radius: 0.4, color: [i; 3] };
    let scene = Scene::new((0..16).map(ball).collect(), [0, 0, 0], DEFAULT_LIGHT).expect("a scene");
    let size = Size::new(9, 7).expect("a size");
    let (corner, du, dv) = ([-2.5, 2.0, -5.0], [0.55, 0.0, 0.0], [0.0, -0.55, 0.0]);
    let camera = Camera::new([1.5, 1.5, 6.0], corner, du, dv, size).expect("a camera");
    let queues = Plan { voxelizer: Voxelizer::EightCorners, cells: Cells::Queue, ..Plan::safe() };
    let plans = [
        Plan::fast(),
        Plan::safe(),
        Plan { walk: Loop::Nested, arithmetic: Form::Textbook.into(), ..queues },
        Plan::paper(),
    ];
    let render = |level: &Level, plan: Plan| {
        let image = Tracer::new(plan, *level).render(&scene, &camera).expect("a picture").image;
        image.ids.iter().filter(|&&id| id < 16).count()
    };
    Level::available().iter().flat_map(|level| plans.map(|plan| render(level, plan))).sum()
}

/// The step alone, lanes from memory and to memory.
struct Step<'a>(&'a [[i32; LANES]; 11], &'a mut [[i32; LANES]; 3]);

impl Work for Step<'_> {
    type Output = ();

    fn on<M: Machine + Send + Sync>(self, m: M) {
        step_probe(m, self.0, self.1);
    }
}

/// What this calls is the step's door.
#[inline(never)]
fn step_probe<M: Machine>(m: M, x: &[[i32; LANES]; 11], y: &mut [[i32; LANES]; 3]) {
    m.within(
        #[inline(always)]
        || {
            let [slice, j, k, first_j, first_k, last_j, last_k, then_j, then_k, end_j, end_k] = *x;
            let at = Cursor { slice: m.lanes_i(slice), j: m.lanes_i(j), k: m.lanes_i(k) };
            let here = Rectangle {
                first: [m.lanes_i(first_j), m.lanes_i(first_k)],
                last: [m.lanes_i(last_j), m.lanes_i(last_k)],
            };
            let next = Rectangle {
                first: [m.lanes_i(then_j), m.lanes_i(then_k)],
                last: [m.lanes_i(end_j), m.lanes_i(end_k)],
            };
            let next = step(m, at, &here, &next);
            *y = [m.to_array_i(next.slice), m.to_array_i(next.j), m.to_array_i(next.k)];
        },
    );
}

/// The loop of steps alone, through one slice and into the next, from one cell to the other.
struct Steps<'a>(&'a [[i32; LANES]; 4], &'a mut [[i32; LANES]; 3]);

impl Work for Steps<'_> {
    type Output = ();

    fn on<M: Machine + Send + Sync>(self, m: M) {
        loop_probe(m, self.0, self.1);
    }
}

/// What this calls is the loop's door.
#[inline(never)]
fn loop_probe<M: Machine>(m: M, x: &[[i32; LANES]; 4], y: &mut [[i32; LANES]; 3]) {
    m.within(
        #[inline(always)]
        || {
            let [first_j, first_k, last_j, last_k] = *x;
            let rectangle = Rectangle {
                first: [m.lanes_i(first_j), m.lanes_i(first_k)],
                last: [m.lanes_i(last_j), m.lanes_i(last_k)],
            };
            let mut at = Cursor { slice: m.splat_i(0), j: rectangle.first[0], k: rectangle.first[1] };
            loop {
                let next = step(m, at, &rectangle, &rectangle);
                if !m.again(m.lt_i(next.slice, m.splat_i(1)), Site::NextCell) {
                    break;
                }
                at = next;
            }
            *y = [m.to_array_i(at.slice), m.to_array_i(at.j), m.to_array_i(at.k)];
        },
    );
}

/// Levels whose doors can be told from their surroundings: SSE2 is in every x86-64 program and needs none.
fn levels_with_doors() -> Vec<&'static str> {
    if cfg!(not(all(target_arch = "x86_64", target_os = "linux"))) {
        eprintln!("not judged: machine code is judged on x86-64 Linux only");
        return Vec::new();
    }
    let available: Vec<_> = Level::available().iter().map(|level| level.name()).collect();
    let (judged, absent): (Vec<_>, Vec<_>) =
        ["sse4.2", "avx2", "avx512"].into_iter().partition(|name| available.contains(name));
    for level in absent {
        eprintln!("not judged: {level}: this processor has none, so its code is not run, though it is there");
    }
    judged
}

#[test]
fn nothing_below_a_door_is_a_call() {
    assert!(render_all() > 100, "too little was rendered");
    let levels = levels_with_doors();
    let program = Program::read();
    for level in levels {
        let doors = program.doors(level);
        let mut calls = BTreeSet::new();
        for (address, _) in &doors {
            for (_, way) in program.reached(*address) {
                let name = way.last().expect("itself");
                let operation = ["fearless_simd", "optimized::host", "core::core_arch"]
                    .iter()
                    .any(|part| name.contains(part));
                if operation && !ALLOWED.iter().any(|(part, _)| name.contains(part)) {
                    calls.insert(way.join(" -> "));
                }
            }
        }
        let widest = doors.iter().map(|(_, door)| wide(door, level)).max().unwrap_or(0);
        eprintln!("{level}: {} doors, the largest with {widest} instructions of its width", doors.len());
        let calls: Vec<_> = calls.into_iter().collect();
        assert!(calls.is_empty(), "{level}: operations that are not inlined:\n{}", calls.join("\n"));
        assert!(widest >= WIDE, "{level}: no door uses its registers");
    }
}

#[test]
fn no_operation_is_fused_or_estimated() {
    assert!(render_all() > 100, "too little was rendered");
    let levels = levels_with_doors();
    let program = Program::read();
    for level in levels {
        let mut judged = 0;
        for (address, door) in program.doors(level) {
            let inexact = door.code.iter().find(|i| is_inexact(i));
            assert!(inexact.is_none(), "{level}: the door at {address:#x} has {inexact:?}");
            judged += door.code.len();
        }
        eprintln!("{level}: {judged} instructions");
        assert!(judged > 1000, "{level}: too little was judged");
    }
}

#[test]
fn the_step_is_straight_line() {
    for level in Level::available() {
        let mut y = [[0; LANES]; 3];
        let x = [3, 0, 0, 0, 0, 1, 1, 2, 2, 3, 3].map(|lane| std::hint::black_box([lane; LANES]));
        level.run(Step(&x, &mut y));
        assert_eq!(y, [3, 0, 1].map(|lane| [lane; LANES]), "{level}: the next k");
    }
    let levels = levels_with_doors();
    let program = Program::read();
    let probes: Vec<_> = program.named("machine_code::step_probe").collect();
    for level in levels {
        let callees = probes.iter().flat_map(|(_, probe)| program.callees(probe));
        let doors: Vec<_> = callees
            .map(|callee| &program.functions[&callee])
            .filter(|f| level_of_door(&f.name) == Some(level))
            .collect();
        assert_eq!(doors.len(), 1, "{level}: the probe's door is not found");
        let branches =
            |i: &&Instruction| !matches!(i.flow_control(), FlowControl::Next | FlowControl::Return);
        let found: Vec<_> = doors[0].code.iter().filter(branches).map(Instruction::mnemonic).collect();
        let wide = wide(doors[0], level);
        eprintln!("{level}: the step has {} instructions, {wide} of its width", doors[0].code.len());
        assert!(found.is_empty(), "{level}: the step branches: {found:?}");
        assert!(wide >= 20, "{level}: the step does not use its registers");
    }
}

/// The compiler puts no branch back into the flattened loop: it has one conditional jump, and that goes backwards.
#[test]
fn the_flattened_loop_has_no_conditional_jump_but_its_own() {
    for level in Level::available() {
        let mut y = [[0; LANES]; 3];
        let x = [0, 2, 3, 6].map(|lane| std::hint::black_box([lane; LANES]));
        level.run(Steps(&x, &mut y));
        assert_eq!(y, [0, 3, 6].map(|lane| [lane; LANES]), "{level}: the last cell");
    }
    let levels = levels_with_doors();
    let program = Program::read();
    let probes: Vec<_> = program.named("machine_code::loop_probe").collect();
    for level in levels {
        let callees = probes.iter().flat_map(|(_, probe)| program.callees(probe));
        let doors: Vec<_> = callees
            .map(|callee| &program.functions[&callee])
            .filter(|f| level_of_door(&f.name) == Some(level))
            .collect();
        assert_eq!(doors.len(), 1, "{level}: the probe's door is not found");
        let branches =
            |i: &&Instruction| !matches!(i.flow_control(), FlowControl::Next | FlowControl::Return);
        let found: Vec<_> = doors[0].code.iter().filter(branches).collect();
        eprintln!("{level}: the loop has {} instructions, branches {:?}", doors[0].code.len(), found);
        let backwards = |i: &Instruction| i.near_branch_target() < i.ip();
        let own = found.len() == 1
            && found[0].flow_control() == FlowControl::ConditionalBranch
            && backwards(found[0]);
        assert!(
            own,
            "{level}: the loop branches: {:?}",
            found.iter().map(|i| i.mnemonic()).collect::<Vec<_>>()
        );
    }
}
