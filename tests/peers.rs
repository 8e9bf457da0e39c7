//! Do tracers of other people agree? The crates `bvh` and `parry3d` on every scene and view, judged as any subject is.

use contract::{MISS, Size};
use rayon::prelude::*;
use reference::{Arithmetic, Tracer};
use std::collections::BTreeSet;
use std::io::Write;
use verify::judge::judge;
use verify::matrix::Matrix;
use verify::peers::tachyon::{View, find, render};
use verify::peers::{BvhCrate, Parry};
use verify::scenes::catalogue::Source;
use verify::subject::Subject;
use verify::verdict::Verdict;

/// Scenes that leave the range of f32, where a form in f32 promises nothing.
const OUT_OF_RANGE: [&str; 2] = ["huge", "tiny"];

#[test]
fn peers_see_the_truth_within_their_rounding() {
    let matrix = Matrix::new().expect("what is there can be read");
    for name in &matrix.absent {
        _ = writeln!(std::io::stderr(), "not judged: {name}: data absent (run tests/fetch-data)");
    }
    let judged = matrix.cases.par_iter().map(|case| {
        let truth = Tracer::new(Arithmetic::Exact).threads(1).render(&case.scene, &case.camera);
        let truth = truth.expect("small").image;
        let peers: [&dyn Subject; 2] = [&BvhCrate, &Parry];
        peers.map(|peer| {
            let image = peer.render(&case.scene, &case.camera, 1, &|| ()).expect("small").image;
            let judgement = judge(&case.scene, &case.camera, &truth, &image, peer.promise(), None);
            let scene = case.name.split(',').next().unwrap_or_default();
            let stated = peer.name() == "bvh" || !OUT_OF_RANGE.contains(&scene);
            assert_ne!(judgement.verdict, Verdict::Wrong, "{}: {}: {judgement:?}", peer.name(), case.name);
            assert!(judgement.verdict != Verdict::Undecidable || !stated, "{}: {}", peer.name(), case.name);
            let unstated = (judgement.verdict == Verdict::Undecidable).then(|| scene.to_owned());
            let compared = judgement.comparison.expect("compared");
            (compared.hits, compared.wrong_ids, compared.wrong_t, unstated)
        })
    });
    let judged: Vec<_> = judged.collect();
    // In f32 the textbook form sees 9 % of rays wrong at 2,000 radii (tests/forms.rs), and parry3d takes any of equal roots.
    for (i, (name, one_in)) in [("bvh", 10_000), ("parry3d", 10)].into_iter().enumerate() {
        let sum = judged.iter().fold([0; 3], |sum, all| {
            let (hits, ids, t, _) = &all[i];
            [sum[0] + hits, sum[1] + ids, sum[2] + t]
        });
        let unstated: BTreeSet<_> = judged.iter().filter_map(|all| all[i].3.clone()).collect();
        eprintln!(
            "{name}: {} hits, {} ids and {} t are not the exact ones, nothing stated: {unstated:?}",
            sum[0], sum[1], sum[2]
        );
        assert!(sum[0] > 100_000, "hardly a hit");
        assert!(sum[1] < sum[0] / one_in, "{name}: too many wrong ids to be rounding");
    }
    assert!(judged.iter().any(|all| all[1].1 > 0), "f32 never saw a wrong sphere: nothing was at stake");
}

/// Where all pixels around one show the same sphere, Tachyon shows it too; elsewhere it may not only where its rays are not ours
/// to the last bit, which is rare.
#[test]
fn tachyon_shows_the_same_spheres() {
    let Some(program) = find() else {
        _ = writeln!(
            std::io::stderr(),
            "not judged: Tachyon: not installed (apt-get install tachyon-bin-nox)"
        );
        return;
    };
    for (word, eye, height) in [
        ("1hvr", [-9.0, 17.0, 130.0], 0.6),
        ("1hvr", [70.0, 60.0, -40.0], 0.7),
        ("sphereflake:3", [2.1, 1.3, 1.7], 0.8),
        ("uniform:500:1", [0.4, 0.3, -2.0], 1.0),
    ] {
        let loaded = Source::parse(word).and_then(|source| source.load()).expect("bundled or generated");
        let scene = &loaded.animation.frames()[0];
        let size = Size::new(301, 200).expect("small");
        let target = if word == "1hvr" { [-9.0, 17.0, 28.0] } else { [0.0; 3] };
        let view = View { eye, target, height, size };
        let camera = view.camera().expect("not degenerate");
        let truth = Tracer::new(Arithmetic::Exact).render(scene, &camera).expect("small").image.ids;
        let seen = render(&program, scene, &view).expect("Tachyon renders");
        let width = size.width() as usize;
        let (mut plain, mut edge, mut differ) = (0, 0, 0);
        for i in 0..truth.len() {
            let (x, y) = (i % width, i / width);
            let inner = x > 0 && y > 0 && x + 1 < width && i + width < truth.len();
            let around = [0, 1, 2].map(|dy| (dy * width).wrapping_sub(width + 1));
            let same = |start: usize| (0..3).all(|dx| truth[i.wrapping_add(start) + dx] == truth[i]);
            if inner && around.into_iter().all(same) {
                plain += usize::from(truth[i] != MISS);
                assert_eq!(
                    seen[i], truth[i],
                    "{word} from {eye:?}, pixel ({x}, {y}), far from every silhouette"
                );
            } else {
                edge += 1;
                differ += usize::from(seen[i] != truth[i]);
            }
        }
        eprintln!("{word}: {plain} plain hits agree, {differ} of {edge} pixels at silhouettes differ");
        assert!(plain > 1000, "{word}: hardly a hit");
        assert!(differ * 200 <= edge, "{word}: {differ} of {edge} pixels at silhouettes differ");
    }
    _ = writeln!(std::io::stderr(), "judged by Tachyon, at the level of images");
}
