//! The loop over all spheres, eight of them side by side: nearly every ray misses all eight, and then no root is needed.

use contract::Sphere;

/// So many at once: a register of AVX2 in f32, two of them in f64.
const TRIED: u32 = 8;

/// Calls `meet` with each sphere that `may_hit`, and its id; in the order of ids.
#[inline(always)]
pub(crate) fn each(
    spheres: &[Sphere],
    may_hit: impl Fn(&Sphere) -> bool,
    mut meet: impl FnMut(u32, &Sphere),
) {
    let mut try_all = |first: u32, some: &[Sphere]| {
        (first..).zip(some).filter(|(_, sphere)| may_hit(sphere)).for_each(|(id, sphere)| meet(id, sphere));
    };
    let (eights, rest) = spheres.as_chunks::<{ TRIED as usize }>();
    let mut first = 0;
    for eight in eights {
        if eight.iter().fold(false, |any, sphere| any | may_hit(sphere)) {
            try_all(first, eight);
        }
        first += TRIED;
    }
    try_all(first, rest);
}
