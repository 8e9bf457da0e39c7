//! The SPU's operations by `optimized`, by way of f64 and by AVX-512 where the processor has it, against the integers of the
//! reference.

use super::bytes::Bytes;
use optimized::Level;
use optimized::host::Work;
use optimized::machine::{LANES, Machine};
use reference::spu::Spu;

/// Sixteen pairs of patterns.
type Pairs = [[u32; LANES]; 2];

/// Every operation on sixteen pairs of any bits, at the plain level and at the best there is. Results are judged, lane by lane.
///
/// # Panics
/// If one differs from the reference's.
pub fn spu(bytes: &[u8]) -> u64 {
    let mut from = Bytes(bytes);
    let mut pairs = [[0; LANES]; 2];
    let [xs, ys] = &mut pairs;
    for (first, second) in xs.iter_mut().zip(ys) {
        let x = pattern(&mut from);
        let (kind, off) = (from.byte(), i32::from(from.whole() % 4).cast_unsigned());
        *first = x;
        *second = match kind % 8 {
            // Nearly the same, of either sign: sums that cancel.
            0 => x.wrapping_add(off),
            1 => x.wrapping_add(off) ^ (1 << 31),
            _ => pattern(&mut from),
        };
    }
    let levels = Level::available();
    let best = levels.last().copied().unwrap_or(Level::SCALAR);
    [Level::SCALAR, best].into_iter().map(|level| level.run(Judge { level, pairs })).sum()
}

/// Of any bits; of moderate size; of few bits; or at the ends of the range.
fn pattern(from: &mut Bytes<'_>) -> u32 {
    let (kind, word) = (from.byte(), from.word());
    let sign = word & 1 << 31;
    match kind % 4 {
        0 => word,
        1 => (word & 0x807f_ffff) | ((119 + (word >> 23 & 15)) << 23),
        2 => sign | (word >> 23 & 0xff) << 23 | (1 << (word % 23)),
        _ => sign | [0, 1, 2, 3, 126, 127, 253, 254, 255][word as usize % 9] << 23 | (word >> 8 & 0x7f_ffff),
    }
}

struct Judge {
    level: Level,
    pairs: Pairs,
}

/// What an operation gives, by name, in each lane, and what it must give.
type Results = Vec<(&'static str, [u32; LANES], [u32; LANES])>;

impl Work for Judge {
    type Output = u64;

    fn on<M: Machine + Send + Sync>(self, m: M) -> u64 {
        let [x, y] = self.pairs;
        let results = m.within(
            #[inline(always)]
            || results(m.spu(), self.pairs),
        );
        for (name, is, want) in &results {
            for lane in 0..LANES {
                assert!(
                    is[lane] == want[lane],
                    "{name} of {:#010x} (as f32 {:?}) and {:#010x} ({:?}) is {:#010x}, not {:#010x}; lane {lane}, {}",
                    x[lane],
                    f32::from_bits(x[lane]),
                    y[lane],
                    f32::from_bits(y[lane]),
                    is[lane],
                    want[lane],
                    self.level
                );
            }
        }
        (results.len() * LANES) as u64
    }
}

#[inline(always)]
fn results<S: Machine>(s: S, [x, y]: Pairs) -> Results {
    let lanes = |x: [u32; LANES]| s.lanes(x.map(f32::from_bits));
    let out = |x: S::F| s.to_array(x).map(f32::to_bits);
    let whole = |x: S::I| s.to_array_i(x).map(i32::cast_unsigned);
    let yes = |x: S::B| std::array::from_fn(|lane| s.to_bits(x) >> lane & 1);
    let two = |f: fn(Spu, Spu) -> u32| std::array::from_fn(|i| f(Spu(x[i]), Spu(y[i])));
    let (a, b) = (lanes(x), lanes(y));
    let choose = s.lt(a, b);
    vec![
        ("the way in and out", out(a), x),
        ("add", out(s.add(a, b)), two(|x, y| (x + y).0)),
        ("sub", out(s.sub(a, b)), two(|x, y| (x - y).0)),
        ("mul", out(s.mul(a, b)), two(|x, y| (x * y).0)),
        ("div", out(s.div(a, b)), two(|x, y| (x / y).0)),
        ("sqrt", out(s.sqrt(a)), two(|x, _| x.sqrt().0)),
        ("neg", out(s.neg(a)), two(|x, _| (-x).0)),
        ("lt", yes(choose), two(|x, y| x.less(y).into())),
        ("le", yes(s.le(a, b)), two(|x, y| x.less_equal(y).into())),
        ("min", out(s.min(a, b)), two(|x, y| if x.less(y) { x.0 } else { y.0 })),
        ("max", out(s.max(a, b)), two(|x, y| if y.less(x) { x.0 } else { y.0 })),
        ("select", out(s.select(choose, a, b)), two(|x, y| if x.less(y) { x.0 } else { y.0 })),
        ("floor", whole(s.floor(a)), two(|x, _| integer(x, true).cast_unsigned())),
        ("truncate", whole(s.truncate(a)), two(|x, _| integer(x, false).cast_unsigned())),
        ("smallest", ends(out(s.smallest(a)), x, Spu::less), [1; LANES]),
        ("largest", ends(out(s.largest(a)), x, |x, y| y.less(x)), [1; LANES]),
        ("splat", out(s.splat(f32::from_bits(x[0]))), [x[0]; LANES]),
    ]
}

/// 1 for a lane that is one of the given numbers before which no other comes.
fn ends(is: [u32; LANES], given: [u32; LANES], before: impl Fn(Spu, Spu) -> bool) -> [u32; LANES] {
    is.map(|is| {
        let alike = |x: u32| !before(Spu(x), Spu(is)) && !before(Spu(is), Spu(x));
        let first = !given.iter().any(|&x| before(Spu(x), Spu(is)));
        u32::from(first && given.iter().any(|&x| x == is || alike(x)))
    })
}

/// The integer below or at a number, or the one towards zero, saturated: by integers alone.
fn integer(Spu(x): Spu, floor: bool) -> i32 {
    let (exponent, fraction) = ((x >> 23 & 0xff).cast_signed(), i64::from(x & 0x7f_ffff | 0x80_0000));
    let signed = if x >> 31 == 0 { fraction } else { -fraction };
    let shift = exponent - 150;
    let whole = match shift {
        _ if exponent == 0 => 0,
        0.. => signed << shift.min(24),
        _ if floor => signed >> (-shift).min(40),
        _ => signed / (1 << (-shift).min(40)),
    };
    i32::try_from(whole).unwrap_or(if whole < 0 { i32::MIN } else { i32::MAX })
}
