//! Laws that hold between operations of a [`Machine`], whatever each of them gives: commutation, order, select, masks, conversions. Drawn by
//! quickcheck over every class of bit patterns, held in every lane. They need no oracle and so catch what an oracle misread; that each
//! operation for itself gives what the trait says is another test's business (`tests/machine.rs`).

use optimized::host::Work;
use optimized::machine::{LANES, Machine, Site};
use optimized::{Level, host::Scalar};
use quickcheck::{Arbitrary, Gen, QuickCheck, TestResult, Testable};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// Sixteen bit patterns.
type Bits = [u32; LANES];

/// A class of bit patterns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// ±0.
    Zero,
    /// Below the least normal number.
    Subnormal,
    /// Normal, of no other class.
    Normal,
    /// Whole and below 2²⁴.
    Whole,
    /// Within a few ulp of ±2³¹, where conversions saturate.
    AtLimit,
    /// Near the largest.
    Huge,
    /// ±∞.
    Infinite,
    /// Not a number.
    Nan,
}

/// All classes.
pub const CLASSES: [Class; 8] = [
    Class::Zero,
    Class::Subnormal,
    Class::Normal,
    Class::Whole,
    Class::AtLimit,
    Class::Huge,
    Class::Infinite,
    Class::Nan,
];

impl Class {
    fn draw(self, g: &mut Gen) -> u32 {
        let (word, sign) = (u32::arbitrary(g), u32::from(bool::arbitrary(g)) << 31);
        let magnitude = match self {
            Self::Zero => 0,
            Self::Subnormal => word % 0x7f_ffff + 1,
            Self::Normal => (word % (0xfe - 0x40) + 0x20) << 23 | u32::arbitrary(g) & 0x7f_ffff,
            #[allow(clippy::cast_precision_loss, reason = "below 2^24")]
            Self::Whole => ((word % (1 << 24)) as f32).to_bits(),
            Self::AtLimit => 2f32.powi(31).to_bits() - 3 + word % 7,
            Self::Huge => f32::MAX.to_bits() - word % 64,
            Self::Infinite => f32::INFINITY.to_bits(),
            Self::Nan => f32::INFINITY.to_bits() + 1 + word % 0x7f_ffff,
        };
        magnitude | sign
    }

    /// The class of a pattern.
    #[must_use]
    pub fn of(bits: u32) -> Self {
        let x = f32::from_bits(bits & 0x7fff_ffff);
        if x.is_nan() {
            Self::Nan
        } else if x.is_infinite() {
            Self::Infinite
        } else if x == 0.0 {
            Self::Zero
        } else if x.is_subnormal() {
            Self::Subnormal
        } else if x.to_bits().abs_diff(2f32.powi(31).to_bits()) < 8 {
            Self::AtLimit
        } else if x > f32::MAX / 2.0 {
            Self::Huge
        } else if x.fract() == 0.0 {
            Self::Whole
        } else {
            Self::Normal
        }
    }
}

/// What the laws are held of: three numbers, two integers, three masks, all of sixteen lanes.
#[derive(Clone, Debug)]
struct Drawn {
    numbers: [Bits; 3],
    integers: [Bits; 2],
    masks: [u32; 3],
}

impl Arbitrary for Drawn {
    fn arbitrary(g: &mut Gen) -> Self {
        let mut number = || {
            std::array::from_fn(|_| {
                let class = *g.choose(&CLASSES).unwrap_or(&Class::Normal);
                class.draw(g)
            })
        };
        let mut numbers = [number(), number(), number()];
        // Equal ones and opposite ones would hardly be drawn.
        let [first, second, _] = &mut numbers;
        for (x, y) in first.iter().zip(second) {
            match u32::arbitrary(g) % 5 {
                0 => *y = *x,
                1 => *y = *x ^ 1 << 31,
                _ => {}
            }
        }
        // Of all sizes, and near both ends, where sums wrap.
        let mut integer = || {
            std::array::from_fn(|_| match u32::arbitrary(g) % 8 {
                0 => 0x7fff_ffff - u32::arbitrary(g) % 4,
                1 => 0x8000_0000 + u32::arbitrary(g) % 4,
                _ => u32::arbitrary(g) >> (u32::arbitrary(g) % 32),
            })
        };
        let integers = [integer(), integer()];
        Self { numbers, integers, masks: std::array::from_fn(|_| u32::arbitrary(g) & 0xffff) }
    }

    /// All lanes become the first; then numbers become rounder.
    fn shrink(&self) -> Box<dyn Iterator<Item = Self>> {
        let mut simpler = Vec::new();
        for lane in 0..LANES {
            let alike = Self {
                numbers: self.numbers.map(|bits| [bits[lane]; LANES]),
                integers: self.integers.map(|bits| [bits[lane]; LANES]),
                masks: self.masks.map(|mask| if mask >> lane & 1 == 1 { 0xffff } else { 0 }),
            };
            if format!("{alike:?}") != format!("{self:?}") {
                simpler.push(alike);
            }
        }
        Box::new(simpler.into_iter())
    }
}

/// Which laws are broken, by a level's machine or by that for the SPU's numbers.
struct Laws<'a>(&'a Drawn, bool);

impl Work for Laws<'_> {
    type Output = Vec<&'static str>;

    fn on<M: Machine + Send + Sync>(self, m: M) -> Self::Output {
        if self.1 { broken(m.spu(), &tame(self.0), false) } else { broken(m, self.0, true) }
    }
}

/// The laws that are broken. `ieee`: the machine has all f32, NaN, infinities, zeros of both signs and subnormal numbers.
fn broken<M: Machine>(m: M, drawn: &Drawn, ieee: bool) -> Vec<&'static str> {
    let [x, y, z] = drawn.numbers.map(|bits| m.lanes(bits.map(f32::from_bits)));
    let [i, j] = drawn.integers.map(|bits| m.lanes_i(bits.map(u32::cast_signed)));
    let zero = m.splat_i(0);
    let mask =
        |bits: u32| m.lt_i(zero, m.lanes_i(std::array::from_fn(|lane| (bits >> lane & 1).cast_signed())));
    let [a, b, c] = drawn.masks.map(mask);
    let bits = |x: M::F| m.to_array(x).map(f32::to_bits);
    let number = |x: M::F| bits(x).map(|x| if f32::from_bits(x).is_nan() { u32::MAX } else { x });
    let whole = |x: M::I| m.to_array_i(x);
    let is = |x: M::B| m.to_bits(x);
    let nan = is(m.not(m.le(x, x))) | is(m.not(m.le(y, y)));
    let all = 0xffff;
    let mut laws = vec![
        ("x + y = y + x", number(m.add(x, y)) == number(m.add(y, x))),
        ("x y = y x", number(m.mul(x, y)) == number(m.mul(y, x))),
        ("x - y = -(y - x), zeros aside", {
            let (one, other) = (m.to_array(m.sub(x, y)), m.to_array(m.neg(m.sub(y, x))));
            (0..LANES).all(|n| one[n] == other[n] || (one[n].is_nan() && other[n].is_nan()))
        }),
        ("(-x) y = -(x y), zeros aside", {
            let (one, other) = (m.to_array(m.mul(m.neg(x), y)), m.to_array(m.neg(m.mul(x, y))));
            (0..LANES).all(|n| one[n] == other[n] || (one[n].is_nan() && other[n].is_nan()))
        }),
        ("x < y excludes y <= x", is(m.and(m.lt(x, y), m.le(y, x))) == 0),
        ("x < y or y <= x, but for NaN", is(m.or(m.lt(x, y), m.le(y, x))) | nan == all),
        ("x <= y is x < y or both ways", {
            let both = m.and(m.le(x, y), m.le(y, x));
            is(m.le(x, y)) == is(m.or(m.lt(x, y), both))
        }),
        ("x < y and y < z give x < z", is(m.and(m.and(m.lt(x, y), m.lt(y, z)), m.not(m.lt(x, z)))) == 0),
        ("the lesser is one of both", {
            let (x, y, least) = (bits(x), bits(y), bits(m.min(x, y)));
            (0..LANES).all(|n| least[n] == x[n] || least[n] == y[n])
        }),
        ("the lesser is not above the greater", is(m.lt(m.max(x, y), m.min(x, y))) == 0),
        ("select of twice the same", bits(m.select(a, x, x)) == bits(x)),
        ("select by the opposite", bits(m.select(m.not(a), x, y)) == bits(m.select(a, y, x))),
        ("select within select", {
            let inner = m.select(b, x, y);
            bits(m.select(a, inner, y)) == bits(m.select(m.and(a, b), x, y))
        }),
        ("select moves bits", {
            let (x, y, chosen) = (bits(x), bits(y), bits(m.select(a, x, y)));
            (0..LANES).all(|n| chosen[n] == if drawn.masks[0] >> n & 1 == 1 { x[n] } else { y[n] })
        }),
        ("integer select by the opposite", whole(m.select_i(m.not(a), i, j)) == whole(m.select_i(a, j, i))),
        ("a mask comes out as it went in", [is(a), is(b), is(c)] == drawn.masks),
        ("not not", is(m.not(m.not(a))) == is(a)),
        ("not (a and b) = not a or not b", is(m.not(m.and(a, b))) == is(m.or(m.not(a), m.not(b)))),
        (
            "a and (b or c) = a and b or a and c",
            is(m.and(a, m.or(b, c))) == is(m.or(m.and(a, b), m.and(a, c))),
        ),
        ("a and not a", is(m.and(a, m.not(a))) == 0),
        (
            "any",
            m.any(a, Site::Sphere) == (drawn.masks[0] != 0)
                && m.again(a, Site::NextCell) == (drawn.masks[0] != 0),
        ),
        ("i + 0 = i", whole(m.add_i(i, zero)) == whole(i)),
        ("i + j = j + i", whole(m.add_i(i, j)) == whole(m.add_i(j, i))),
        ("i + j + 1 = i + (j + 1)", {
            let one = m.splat_i(1);
            whole(m.add_i(m.add_i(i, j), one)) == whole(m.add_i(i, m.add_i(j, one)))
        }),
        ("i or j = j or i", whole(m.or_i(i, j)) == whole(m.or_i(j, i))),
        ("i or i", whole(m.or_i(i, i)) == whole(i)),
        ("halves put together", {
            let high = m.shl_16(m.shr_16(i));
            let low = m.shr_16(m.shl_16(i));
            whole(m.or_i(high, low)) == whole(i)
        }),
        ("i < j excludes j < i", is(m.and(m.lt_i(i, j), m.lt_i(j, i))) == 0),
        ("floor keeps order", {
            let (x, y, low) = (whole(m.floor(x)), whole(m.floor(y)), is(m.le(x, y)));
            (0..LANES).all(|n| low >> n & 1 == 0 || x[n] <= y[n])
        }),
        ("truncation keeps order", {
            let (x, y, low) = (whole(m.truncate(x)), whole(m.truncate(y)), is(m.le(x, y)));
            (0..LANES).all(|n| low >> n & 1 == 0 || x[n] <= y[n])
        }),
        ("floor is truncation from zero up, and at most one below it elsewhere", {
            let (floor, cut, negative) = (whole(m.floor(x)), whole(m.truncate(x)), is(m.lt(x, m.splat(0.0))));
            (0..LANES).all(|n| {
                let below = i64::from(cut[n]) - i64::from(floor[n]);
                below == 0 || (negative >> n & 1 == 1 && below == 1)
            })
        }),
        ("the smallest is not above any, the largest not below, wherever they stand", {
            let tame = m.select(m.le(x, x), x, m.splat(1.0));
            let (least, most) = (m.smallest(tame), m.largest(tame));
            let mut turned = m.to_array(tame);
            turned.rotate_left(5);
            let turned = m.lanes(turned);
            let same = |p: M::F, q: M::F| is(m.and(m.le(p, q), m.le(q, p))) == all;
            is(m.lt(tame, least)) == 0
                && is(m.lt(most, tame)) == 0
                && same(m.smallest(turned), least)
                && same(m.largest(turned), most)
        }),
        ("four numbers are lanes of four", {
            let four: [f32; 4] = std::array::from_fn(|n| m.to_array(x)[n]);
            bits(m.lanes_of_four(four)) == std::array::from_fn(|n| bits(x)[n % 4])
        }),
        ("first is first", m.first(x).to_bits() == bits(x)[0] && m.first_i(i) == whole(i)[0]),
    ];
    if ieee {
        laws.extend([
            ("x 1 = x", number(m.mul(x, m.splat(1.0))) == number(x)),
            ("x / 1 = x", number(m.div(x, m.splat(1.0))) == number(x)),
            ("x + -0 = x", number(m.add(x, m.splat(-0.0))) == number(x)),
            ("x + x = 2 x", number(m.add(x, x)) == number(m.mul(x, m.splat(2.0)))),
            ("(-x) y = -(x y)", number(m.mul(m.neg(x), y)) == number(m.neg(m.mul(x, y)))),
            ("- - x", number(m.neg(m.neg(x))) == number(x)),
            ("-x has the other sign", {
                let (x, opposite) = (bits(x), bits(m.neg(x)));
                (0..LANES).all(|n| f32::from_bits(x[n]).is_nan() || opposite[n] == x[n] ^ 1 << 31)
            }),
            ("a root's square is near", {
                let (x, root) = (m.to_array(x), m.to_array(m.sqrt(x)));
                (0..LANES).all(|n| {
                    let (x, root) = (f64::from(x[n]), f64::from(root[n]));
                    if x.is_nan() || x < 0.0 {
                        root.is_nan()
                    } else {
                        x.is_infinite() || (root * root - x).abs() <= x * 2f64.powi(-22)
                    }
                })
            }),
        ]);
    }
    laws.into_iter().filter(|(_, holds)| !holds).map(|(law, _)| law).collect()
}

/// The machines that laws are held of: of each level its own, and that for the SPU's numbers, where levels differ in it.
fn machines() -> Vec<(String, Level, bool)> {
    let own = Level::available().into_iter().map(|level| (level.name().to_string(), level, false));
    let spu = [Some(Level::SCALAR), Level::available().pop()].into_iter().flatten();
    own.chain(spu.map(|level| (format!("spu at {level}"), level, true))).collect()
}

/// Lanes by their class, of all that was drawn.
pub type Drawings = BTreeMap<Class, u64>;

/// A law on a machine, and what was drawn.
struct Held {
    level: Level,
    spu: bool,
    drawings: Arc<Mutex<Drawings>>,
}

impl Testable for Held {
    fn result(&self, g: &mut Gen) -> TestResult {
        let drawn = Drawn::arbitrary(g);
        if let Ok(mut drawings) = self.drawings.lock() {
            for bits in drawn.numbers.iter().flatten() {
                *drawings.entry(Class::of(*bits)).or_default() += 1;
            }
        }
        let broken = |drawn: &Drawn| self.level.run(Laws(drawn, self.spu));
        if broken(&drawn).is_empty() {
            return TestResult::passed();
        }
        let small = drawn.shrink().find(|simpler| !broken(simpler).is_empty()).unwrap_or(drawn);
        TestResult::error(format!("{:?} of {small:x?}", broken(&small)))
    }
}

/// On the SPU there is no NaN, infinity or subnormal number, and zero has one sign: what has no meaning there is brought to its numbers
/// first, as its own arithmetic does.
fn tame(drawn: &Drawn) -> Drawn {
    let tame = |bits: u32| match Class::of(bits) {
        Class::Zero | Class::Subnormal => 0,
        Class::Nan | Class::Infinite | Class::Huge => bits & 0x8000_0000 | 0x7e00_0000 | bits & 0xffff,
        Class::Normal | Class::Whole | Class::AtLimit => bits,
    };
    Drawn { numbers: drawn.numbers.map(|lanes| lanes.map(tame)), ..drawn.clone() }
}

/// Holds every machine to the laws, so many drawings each; what was drawn, and the names of the machines.
///
/// # Errors
/// A machine, the law it breaks, and for what.
///
/// # Panics
/// If a machine panics.
pub fn laws(seed: u64, tests: u64) -> Result<(Drawings, Vec<String>), String> {
    let drawings = Arc::new(Mutex::new(Drawings::new()));
    let mut names = Vec::new();
    for (name, level, spu) in machines() {
        let held = Held { level, spu, drawings: Arc::clone(&drawings) };
        let mut quickcheck =
            QuickCheck::new().tests(tests).max_tests(tests).rng(Gen::from_size_and_seed(64, seed));
        quickcheck.quicktest(held).map_err(|failed| format!("{name}: {failed:?}"))?;
        names.push(name);
    }
    let drawings = drawings.lock().map(|drawings| drawings.clone()).unwrap_or_default();
    Ok((drawings, names))
}

/// The laws on a machine that has one operation wrong: each must be missed.
///
/// # Errors
/// The operation that no law misses.
pub fn laws_miss(seed: u64, tests: u64) -> Result<usize, String> {
    let mut rng = Gen::from_size_and_seed(64, seed);
    let drawings: Vec<Drawn> = (0..tests).map(|_| Drawn::arbitrary(&mut rng)).collect();
    for wrong in wrong::ALL {
        let told = drawings.iter().any(|drawn| !broken(wrong::Wrong(Scalar, wrong), drawn, true).is_empty());
        if !told {
            return Err(format!("{wrong:?} breaks no law"));
        }
    }
    Ok(wrong::ALL.len())
}

mod wrong {
    //! A machine with one operation wrong in one way.

    use optimized::machine::{LANES, Machine, Site};

    /// What is wrong.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Fault {
        AddLosesLane,
        SubIsAdd,
        MulTakesMagnitude,
        LtIsLe,
        LeIsLt,
        NotIsSame,
        AndIsOr,
        OrIsAnd,
        SelectSwaps,
        SelectIgnoresLane,
        FloorIsTruncate,
        TruncateIsFloor,
        ShlLosesBit,
        AddISaturates,
        SmallestIsFirst,
        LargestIsFirst,
        AnyIsAll,
        SqrtFlushes,
    }

    pub(super) const ALL: [Fault; 18] = [
        Fault::AddLosesLane,
        Fault::SubIsAdd,
        Fault::MulTakesMagnitude,
        Fault::LtIsLe,
        Fault::LeIsLt,
        Fault::NotIsSame,
        Fault::AndIsOr,
        Fault::OrIsAnd,
        Fault::SelectSwaps,
        Fault::SelectIgnoresLane,
        Fault::FloorIsTruncate,
        Fault::TruncateIsFloor,
        Fault::ShlLosesBit,
        Fault::AddISaturates,
        Fault::SmallestIsFirst,
        Fault::LargestIsFirst,
        Fault::AnyIsAll,
        Fault::SqrtFlushes,
    ];

    #[derive(Clone, Copy)]
    pub(super) struct Wrong<V>(pub(super) V, pub(super) Fault);

    fn of<V, A, R>(v: V, operands: A, wrong: impl Fn(V, A) -> R) -> R {
        wrong(v, operands)
    }

    /// Each operation; where one can be wrong, how: of the machine and its operands.
    macro_rules! operations {
        ($($name:ident($($x:ident: $of:ident),*) -> $to:ident $(, $fault:ident => $wrong:expr)?;)*) => {
            $(fn $name(self, $($x: Self::$of),*) -> Self::$to {
                let operands = ($($x,)*);
                $(if self.1 == Fault::$fault {
                    return of(self.0, operands, $wrong);
                })?
                let ($($x,)*) = operands;
                self.0.$name($($x),*)
            })*
        };
    }

    impl<V: Machine<F = [f32; LANES], I = [i32; LANES], B = [bool; LANES]>> Machine for Wrong<V> {
        type F = V::F;
        type I = V::I;
        type B = V::B;
        type Spu = V::Spu;

        fn spu(self) -> Self::Spu {
            self.0.spu()
        }
        fn lanes(self, x: [f32; LANES]) -> Self::F {
            x
        }
        fn lanes_i(self, x: [i32; LANES]) -> Self::I {
            x
        }
        fn to_array(self, x: Self::F) -> [f32; LANES] {
            x
        }
        fn to_array_i(self, x: Self::I) -> [i32; LANES] {
            x
        }
        fn to_bits(self, x: Self::B) -> u32 {
            self.0.to_bits(x)
        }
        fn splat(self, x: f32) -> Self::F {
            [x; LANES]
        }
        fn splat_i(self, x: i32) -> Self::I {
            [x; LANES]
        }
        fn any(self, x: Self::B, site: Site) -> bool {
            if self.1 == Fault::AnyIsAll { x == [true; LANES] } else { self.0.any(x, site) }
        }
        operations! {
            add(x: F, y: F) -> F, AddLosesLane => |v, (x, y)| {
                let mut sum = v.add(x, y);
                sum[11] = x[11];
                sum
            };
            sub(x: F, y: F) -> F, SubIsAdd => |v, (x, y)| v.add(x, y);
            mul(x: F, y: F) -> F, MulTakesMagnitude => |v, (x, y)| v.mul(x, y).map(f32::abs);
            div(x: F, y: F) -> F;
            sqrt(x: F) -> F, SqrtFlushes => |v, (x,)| v.sqrt(x.map(|x| if x.is_subnormal() { 0.0 } else { x }));
            lt(x: F, y: F) -> B, LtIsLe => |v, (x, y)| v.le(x, y);
            le(x: F, y: F) -> B, LeIsLt => |v, (x, y)| v.lt(x, y);
            lt_i(x: I, y: I) -> B;
            and(x: B, y: B) -> B, AndIsOr => |v, (x, y)| v.or(x, y);
            or(x: B, y: B) -> B, OrIsAnd => |v, (x, y)| v.and(x, y);
            not(x: B) -> B, NotIsSame => |_, (x,)| x;
            select(choose: B, yes: F, no: F) -> F, SelectSwaps => |v, (choose, yes, no)| v.select(choose, no, yes);
            select_i(choose: B, yes: I, no: I) -> I, SelectIgnoresLane => |v, (choose, yes, no)| {
                let mut chosen = v.select_i(choose, yes, no);
                chosen[3] = yes[3];
                chosen
            };
            add_i(x: I, y: I) -> I, AddISaturates => |_, (x, y)| std::array::from_fn(|n| x[n].saturating_add(y[n]));
            or_i(x: I, y: I) -> I;
            shl_16(x: I) -> I, ShlLosesBit => |v, (x,)| v.shl_16(x).map(|x| x & !(1 << 31));
            shr_16(x: I) -> I;
            floor(x: F) -> I, FloorIsTruncate => |v, (x,)| v.truncate(x.map(|x| x + 0.5));
            truncate(x: F) -> I, TruncateIsFloor => |v, (x,)| v.floor(x.map(|x| x + 1.0));
            smallest(x: F) -> F, SmallestIsFirst => |_, (x,)| [x[0]; LANES];
            largest(x: F) -> F, LargestIsFirst => |_, (x,)| [x[0]; LANES];
        }
    }
}
