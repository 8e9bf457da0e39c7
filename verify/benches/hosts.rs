//! Does building the host's machines on a library cost anything? The sphere kernel, 1,024 spheres against one block of
//! sixteen rays, in both forms: on the library's AVX2 and AVX-512, and on machines written by hand with `std::arch`.
//! Results are checked to be equal first, then timed; the ratio is of one interleaved run.

#[cfg(not(target_arch = "x86_64"))]
fn main() {
    eprintln!("not measured: there is a machine written by hand for x86-64 only");
}

#[cfg(target_arch = "x86_64")]
fn main() {
    bench::main();
}

#[cfg(target_arch = "x86_64")]
mod by_hand;

#[cfg(target_arch = "x86_64")]
mod bench {
    use crate::by_hand::{Avx2, Avx512};
    use criterion::{BenchmarkId, Criterion};
    use optimized::camera::Block;
    use optimized::host::{Level, Work};
    use optimized::machine::{LANES, Machine};
    use optimized::sphere::{Form, Nearest, Prepared};
    use rand::RngExt;
    use std::hint::black_box;
    use std::time::Instant;

    const SPHERES: usize = 1024;
    /// Runs that a median is made of, each of all subjects in turn.
    const ROUNDS: usize = 301;
    /// Calls of the kernel in a run.
    const CALLS: usize = 20;
    /// What a library may cost.
    const ALLOWED: f64 = 1.05;

    type Hits = ([u32; LANES], [i32; LANES]);

    struct Input {
        spheres: Vec<Prepared>,
        dir: [[f32; LANES]; 3],
    }

    impl Input {
        /// A block that looks along −z at spheres of which about one in eight is hit by one of its rays at least.
        fn new() -> Self {
            let mut rng = verify::seed::generator(7, 0);
            let mut sphere = || {
                let mut at = |scale: f32| scale * (rng.random::<f32>() - 0.5);
                let center = [at(6.0), at(6.0), at(20.0) - 20.0];
                Prepared::new([0.0; 3], &contract::Sphere { center, radius: 1.0, color: [0; 3] })
            };
            let spheres = (0..SPHERES).map(|_| sphere()).collect();
            let mut dir = [[0.0; LANES], [0.0; LANES], [-1.0; LANES]];
            for (lane, at) in (0u8..).zip(0..LANES) {
                dir[0][at] = f32::from(lane % 4) * 0.002;
                dir[1][at] = f32::from(lane / 4) * 0.002;
            }
            Self { spheres, dir }
        }

        /// Spheres for which the kernel goes on past its branch.
        fn met(&self) -> usize {
            let met = |sphere: &&Prepared| {
                let one = Self { spheres: vec![**sphere], dir: self.dir };
                meet(optimized::host::Scalar, Form::Perpendicular, &one).1.contains(&0)
            };
            self.spheres.iter().filter(met).count()
        }
    }

    fn meet<M: Machine>(m: M, form: Form, input: &Input) -> Hits {
        m.within(
            #[inline(always)]
            || {
                let [x, y, z] = input.dir;
                let block = Block::new(m, [m.lanes(x), m.lanes(y), m.lanes(z)]);
                let mut nearest = Nearest::none(m);
                for (sphere, id) in input.spheres.iter().zip(0..) {
                    nearest = nearest.meet(m, form, &block, sphere, id);
                }
                (m.to_array(nearest.t).map(f32::to_bits), m.to_array_i(nearest.id))
            },
        )
    }

    struct Meet<'a>(Form, &'a Input);

    impl Work for Meet<'_> {
        type Output = Hits;

        fn on<M: Machine + Send + Sync>(self, m: M) -> Hits {
            meet(m, self.0, self.1)
        }
    }

    /// What is measured.
    #[derive(Clone, Copy)]
    enum Subject {
        Library(Level),
        Avx2(Avx2),
        Avx512(Avx512),
    }

    impl Subject {
        fn name(self) -> String {
            match self {
                Self::Library(level) => format!("{level}, library"),
                Self::Avx2(_) => "avx2, by hand".into(),
                Self::Avx512(_) => "avx512, by hand".into(),
            }
        }

        fn meet(self, form: Form, input: &Input) -> Hits {
            match self {
                Self::Library(level) => level.run(Meet(form, input)),
                Self::Avx2(m) => meet(m, form, input),
                Self::Avx512(m) => meet(m, form, input),
            }
        }
    }

    /// Library and by hand, for each instruction set that both have here.
    fn pairs() -> Vec<[Subject; 2]> {
        let by_hand =
            [("avx2", Avx2::detect().map(Subject::Avx2)), ("avx512", Avx512::detect().map(Subject::Avx512))];
        let pair = |(name, by_hand): (&str, Option<Subject>)| match (Level::named(name), by_hand) {
            (Ok(level), Some(by_hand)) => Some([Subject::Library(level), by_hand]),
            _ => {
                eprintln!("not measured: this processor has no {name}");
                None
            }
        };
        by_hand.into_iter().filter_map(pair).collect()
    }

    fn nanoseconds(subject: Subject, form: Form, input: &Input) -> f64 {
        let start = Instant::now();
        for _ in 0..CALLS {
            black_box(subject.meet(form, black_box(input)));
        }
        start.elapsed().as_secs_f64() * 1e9 / (CALLS * SPHERES) as f64
    }

    fn median(mut x: Vec<f64>) -> f64 {
        x.sort_by(f64::total_cmp);
        x[x.len() / 2]
    }

    fn ratios(input: &Input, pairs: &[[Subject; 2]]) {
        for form in [Form::Textbook, Form::Perpendicular] {
            let rounds: Vec<Vec<[f64; 2]>> = (0..ROUNDS)
                .map(|_| pairs.iter().map(|pair| pair.map(|s| nanoseconds(s, form, input))).collect())
                .collect();
            for (i, pair) in pairs.iter().enumerate() {
                let [library, by_hand] = [0, 1].map(|j| median(rounds.iter().map(|r| r[i][j]).collect()));
                let ratio = library / by_hand;
                let [name, _] = pair.map(Subject::name);
                eprintln!(
                    "{form:?}: {name} {library:.3} ns a sphere, by hand {by_hand:.3}, ratio {ratio:.3}"
                );
                if ratio > ALLOWED {
                    eprintln!("{form:?}: {name} MISSED: at most {ALLOWED} is allowed");
                }
            }
        }
    }

    pub(crate) fn main() {
        let (input, pairs) = (Input::new(), pairs());
        eprintln!("{} of {SPHERES} spheres are met", input.met());
        for form in [Form::Textbook, Form::Perpendicular] {
            let expected = meet(optimized::host::Scalar, form, &input);
            for subject in pairs.iter().flatten() {
                assert_eq!(subject.meet(form, &input), expected, "{form:?}, {}", subject.name());
            }
        }
        ratios(&input, &pairs);
        let mut criterion = Criterion::default().configure_from_args();
        for form in [Form::Textbook, Form::Perpendicular] {
            let mut group = criterion.benchmark_group(format!("{SPHERES} spheres, {form:?}"));
            for subject in pairs.iter().flatten() {
                let id = BenchmarkId::from_parameter(subject.name());
                group.bench_function(id, |b| b.iter(|| subject.meet(form, black_box(&input))));
            }
            group.finish();
        }
        criterion.final_summary();
    }
}
