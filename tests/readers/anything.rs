//! Random numbers round-trip, and random damage makes no reader panic. Seeds are fresh and printed; `CGT_SEED` sets them.

use crate::samples::*;
use contract::{Animation, DEFAULT_LIGHT, Scene, Sphere};
use rand::Rng;
use verify::scenes::catalogue;
use verify::scenes::frame::Framing;
use verify::scenes::read::read_bytes;
use verify::scenes::write;
use verify::seed::{generator, seed};

fn bits(animation: &Animation) -> Vec<u32> {
    let all = animation.frames().iter().flat_map(|f| {
        let spheres = f.spheres().iter().flat_map(|s| [s.center[0], s.center[1], s.center[2], s.radius]);
        spheres.chain(f.light())
    });
    all.map(f32::to_bits).collect()
}

#[test]
fn json_round_trip_is_bit_for_bit() {
    let first = ok("a.json", json_sample().as_bytes());
    let again = ok("b.json", write::json(&first.animation, first.camera.as_ref()).as_bytes());
    assert_eq!(bits(&first.animation), bits(&again.animation), "a zero keeps its sign");
    assert_eq!((&first.animation, first.camera), (&again.animation, again.camera));
    assert_eq!(first.animation.frames()[0].spheres()[0].center[1].to_bits(), 0x8000_0000);
    assert_eq!(first.camera.map(|c| c.size()), Some(size(100, 99)));
    assert_eq!(first.camera(&Default::default()).ok(), first.camera, "a file's camera is used as it is");
    // Of another size it is the same view in pixels of the same shape, as high as before and as wide as the picture.
    let of = |width, height| {
        let wish = Framing { size: Some(size(width, height)), ..Framing::default() };
        first
            .camera(&wish)
            .map(|camera| (camera.eye(), camera.corner(), camera.du(), camera.dv(), camera.size()))
    };
    let (du, dv) = ([3.0 * 0.02, 0.0, 0.0], [0.0, 3.0 * -0.02, 0.0]);
    // 300 and 60 of its own columns of 100, in the middle.
    let left = |columns: f64| [(-1.0 + columns * f64::from(0.02_f32)) as f32, 1.0, -2.0];
    assert_eq!(of(100, 33).expect("a camera"), ([0.1; 3], left(-100.0), du, dv, size(100, 33)));
    assert_eq!(of(20, 33).expect("a camera"), ([0.1; 3], left(20.0), du, dv, size(20, 33)));
    let wish = Framing { size: Some(size(100, 33)), ..Framing::default() };
    // Whoever wishes for another view gets that.
    let eye = Framing { eye: Some([0.0, 0.0, 50.0]), ..wish };
    assert_eq!(first.camera(&eye).map(|camera| camera.eye()).ok(), Some([0.0, 0.0, 50.0]));
    let mut random = seeded("json_round_trip_is_bit_for_bit");
    let mut any = || loop {
        let x = f32::from_bits(random.next_u32());
        if x.is_finite() {
            return x;
        }
    };
    let spheres = (0..20_000).map(|_| Sphere {
        center: [any(), any(), any()],
        radius: any().abs().max(f32::from_bits(1)),
        color: [1, 2, 3],
    });
    let scene = Scene::new(spheres.collect(), [1, 2, 3], DEFAULT_LIGHT).expect("valid");
    let animation = Animation::from(scene);
    let read_back = ok("a.json", write::json(&animation, None).as_bytes());
    assert_eq!(bits(&animation), bits(&read_back.animation));
}

fn seeded(test: &str) -> impl Rng {
    let seed = seed();
    eprintln!("{test}: CGT_SEED={seed}");
    generator(seed, 0)
}

/// Flips, cuts, doubles and overwrites.
fn mutated(random: &mut impl Rng, bytes: &[u8]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let mut below = |n: usize| (random.next_u64() % n.max(1) as u64) as usize;
    for _ in 0..1 + below(4) {
        if out.is_empty() {
            break;
        }
        let at = below(out.len());
        match below(6) {
            0 => out[at] ^= 1 << below(8),
            1 => out[at] = b"\0\x01\x7f\x80\xff0 9-.eni\n"[below(14)],
            2 => out.truncate(at),
            3 => {
                let end = at + below(out.len() - at);
                let piece = out[at..end].to_vec();
                out.splice(at..at, piece);
            }
            4 => {
                out.drain(at..at + below(out.len() - at));
            }
            _ => {
                let big: &[u8] =
                    [&b"99999999999"[..], b"-1", b"nan", &[0x7f, 0xff, 0xff, 0xff], &[0xff; 4]][below(5)];
                let end = (at + big.len()).min(out.len());
                out.splice(at..end, big.iter().copied());
            }
        }
    }
    out
}

#[test]
fn nothing_makes_a_reader_panic() {
    let mut random = seeded("nothing_makes_a_reader_panic");
    let (mut read, mut refused) = (0_u32, 0_u32);
    for (name, bytes) in samples() {
        for round in 0..4_000 {
            let broken = mutated(&mut random, &bytes);
            let result = std::panic::catch_unwind(|| read_bytes(name, &broken, None));
            match result {
                Ok(Ok(_)) => read += 1,
                Ok(Err(_)) => refused += 1,
                Err(_) => panic!("{name}, round {round}: panicked on {broken:02x?}"),
            }
        }
    }
    eprintln!("{read} read, {refused} refused");
    assert!(read > 1_000 && refused > 10_000, "mutations must both spare and break files: {read}, {refused}");
}

/// The decoder of XTC trusts its stream; the real file's streams, broken at random, must not get through to it.
#[test]
fn broken_xtc_streams_do_not_reach_the_decoder() {
    let path = catalogue::folder().join("adk_oplsaa.xtc");
    let Ok(whole) = std::fs::read(path) else {
        not_judged("adk_oplsaa.xtc");
        return;
    };
    let mut random = seeded("broken_xtc_streams_do_not_reach_the_decoder");
    let length = i32::from_be_bytes([whole[88], whole[89], whole[90], whole[91]]);
    let frame = 92 + usize::try_from(length).expect("positive").next_multiple_of(4);
    let (mut read, mut refused) = (0, 0);
    for round in 0..200_u64 {
        let mut broken = whole[..frame].to_vec();
        // Every fourth time in the header, else in the stream.
        let (start, end) = if round.is_multiple_of(4) { (0, 92) } else { (92, frame as u64) };
        for _ in 0..1 + random.next_u64() % 3 {
            let at = (start + random.next_u64() % (end - start)) as usize;
            broken[at] ^= 1 << (random.next_u64() % 8);
        }
        match std::panic::catch_unwind(|| read_bytes("a.xtc", &broken, None).map(|_| ())) {
            Ok(Ok(())) => read += 1,
            Ok(Err(_)) => refused += 1,
            Err(_) => panic!("round {round} panicked"),
        }
    }
    eprintln!("{read} read, {refused} refused");
    assert!(read > 10 && refused > 10, "some must reach the decoder and some not: {read}, {refused}");
}

/// Streams of random bits behind random headers: what the walk lets through, the decoder must decode.
#[test]
fn random_xtc_streams_do_not_make_the_decoder_panic() {
    let mut random = seeded("random_xtc_streams_do_not_make_the_decoder_panic");
    let (mut read, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut below = |n: u64| random.next_u64() % n;
        let low = (below(2 << 28) as i32 - (1 << 28)) >> below(29);
        let high = low.saturating_add(((below(1 << 30) as i32) >> below(30)).max(0));
        let (width, atoms) = (9 + below(64) as i32, 10 + below(30) as i32);
        // Mostly clear bits make short runs.
        let sparse = below(3);
        let stream: Vec<u8> =
            (0..below(1_200)).map(|_| (0..sparse).fold(255, |b, _| b & below(256) as u8)).collect();
        let bytes = packed_xtc(&stream, low, high, width, atoms);
        match std::panic::catch_unwind(|| read_bytes("a.xtc", &bytes, None).map(|_| ())) {
            Ok(Ok(())) => read += 1,
            Ok(Err(_)) => refused += 1,
            Err(_) => panic!("low {low}, high {high}, width {width}, {atoms} atoms, stream {stream:02x?}"),
        }
    }
    eprintln!("{read} read, {refused} refused");
    assert!(read > 1_000 && refused > 1_000, "{read} read, {refused} refused");
}
