//! Are the paper's claims judged as they should be, and does README show what is found today? Verdicts follow answers and answers follow
//! figures; the table is made of the file that is part of the repository, of which what is quickly computed is computed again in every
//! run, and all of it with `CGT_LONG=1`.

use contract::{Camera, Scene, Size};
use optimized::Plan;
use rand::RngExt;
use rayon::prelude::*;
use roxmltree::Document;
use std::path::Path;
use std::sync::OnceLock;
use verify::paper::page::part;
use verify::paper::record::{FILE, Record, SCENES, SCHEMA_VERSION};
use verify::paper::text::text;
use verify::paper::{Answer, LEMMAS, Looked, PaperClaim, Standing, claims, in_words, look, proofs, smallest};
use verify::prove::prover::{Finding, Outcome};
use verify::prove::solver::Solver;
use verify::report::Evidence;
use verify::scenes::catalogue::{Source, SourceError};
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};
use verify::spu::cost::SPUS;
use verify::spu::predict::Policy;
use verify::spu::store::CAPACITY;
use verify::spu::survey::{Input, Survey};

/// Scenes that are looked at again every day: they need no data, and seconds.
const EVERYDAY: [&str; 2] = ["sphereflake:3", "uniform:500:1"];

fn view(word: &str, size: [u32; 2]) -> Result<(Scene, Camera), SourceError> {
    let loaded = Source::parse(word)?.load()?;
    let size = Some(Size::new(size[0], size[1]).expect("a size"));
    let camera = loaded.camera(&Framing { size, ..Framing::default() }).expect("a camera");
    Ok((loaded.animation.frames()[0].clone(), camera))
}

fn looked(word: &str, scene: &Scene, camera: &Camera, every: u32) -> Looked {
    let input = Input { name: word, frame: 0, scene, camera, plan: Plan::paper(), every, unlimited: true };
    look(&input, &|| ()).expect("it can be measured")
}

/// What solvers say in this run, if there are any.
fn said() -> &'static [Finding] {
    static SAID: OnceLock<Vec<Finding>> = OnceLock::new();
    SAID.get_or_init(|| {
        let (solvers, seed) = (Solver::all(), seed());
        if solvers.is_empty() {
            eprintln!("not judged: what is proved: no solver was found");
        }
        proofs(&solvers, seed, &|| ())
    })
}

#[test]
fn standings_follow_answers() {
    use Answer::{No, Open, Silent, Yes};
    for (answers, standing) in [
        (&[Yes, Yes][..], Standing::Confirmed),
        (&[Yes, Silent], Standing::Confirmed),
        (&[Yes, Open], Standing::Conditional),
        (&[Yes, No], Standing::Conditional),
        (&[No, Open], Standing::Refuted),
        (&[No, Silent], Standing::Refuted),
        (&[Open, Silent], Standing::NotShown),
        (&[Silent], Standing::NotShown),
        (&[], Standing::NotShown),
    ] {
        assert_eq!(Standing::of(answers), standing, "{answers:?}");
    }
}

/// Verdicts come from figures: with other figures they are others.
#[test]
fn verdicts_turn_with_the_figures() {
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    let (scene, camera) = view("uniform:300:1", [96, 54]).expect("no data is needed");
    let found = looked("uniform:300:1", &scene, &camera, 1);
    let judged = |looked: &[Looked]| claims(looked, &[], seed);
    let before = judged(std::slice::from_ref(&found));
    let mut other = found.clone();
    let better = &mut other.survey;
    better.picture.wrong = u64::from(found.survey.picture.wrong == 0);
    better.picture.wrong_as_printed = u64::from(found.survey.picture.wrong_as_printed == 0);
    better.lists.false_negatives = u64::from(found.survey.lists.false_negatives == 0);
    better.lists.spanning = u64::from(found.survey.lists.spanning == 0);
    better.lists.false_positives = found.survey.lists.ids - found.survey.lists.false_positives;
    better.lists.dropped = u64::from(found.survey.lists.dropped == 0);
    better.culling.factor =
        found.survey.culling.factor.map(|f| if (4.0..=8.0).contains(&f) { 1.0 } else { 5.0 });
    std::mem::swap(&mut better.culling.cycles_with, &mut better.culling.cycles_without);
    better.mailbox.saved = found.survey.mailbox.saved.map(|saved| -saved);
    better.store.spheres = CAPACITY;
    better.store_double.spheres = CAPACITY;
    for rate in &mut better.rates {
        rate.frames_per_second = rate.frames_per_second.map(|rate| rate / 1e6);
        rate.frame_cycles = [1.0, 1.0];
    }
    better.loops.swap(0, 1);
    for kind in &mut better.loops {
        kind.walk = if kind.walk == "nested" { "flattened" } else { "nested" };
        for policy in &mut kind.policies {
            policy.per_branch = policy.per_branch.map(|share| 1.0 - share);
        }
    }
    other.sound = if found.sound.is_empty() { vec![4] } else { Vec::new() };
    other.workers_agree = !found.workers_agree;
    let after = judged(&[other]);
    let (mut turned, mut of_scenes) = (0, 0);
    for (one, other) in before.iter().zip(&after) {
        let has = one.verdict != other.verdict;
        let word = if has { "turned" } else { "stayed" };
        eprintln!("{word} {}: {} [{}]", one.verdict.word(), one.statement, one.figure);
        // What needs no scene does not turn with one.
        assert!(!has || !one.answers.is_empty(), "{}", one.statement);
        turned += usize::from(has);
        of_scenes += usize::from(!one.answers.is_empty());
    }
    assert!(turned >= 20 && turned + 6 >= of_scenes, "{turned} of {of_scenes} verdicts depend on figures");
}

/// The number in a claim is where a scene's answer turns: a little below it and a little above, nothing else being changed.
#[test]
fn answers_turn_at_the_number_in_the_claim() {
    use Answer::{No, Yes};
    type Set = fn(&mut Survey, f64);
    const HINTED: usize = Policy::Hinted as usize;
    const UNHINTED: usize = Policy::Unhinted as usize;
    // All of a frame's work is a stage's, as a share of what six SPUs have in a frame.
    fn work(survey: &mut Survey, wanted: &str, percent: f64) {
        let rate = &mut survey.rates[HINTED];
        rate.frame_cycles = [rate.frame_cycles[0]; 2];
        let all = rate.frame_cycles.map(|cycles| SPUS as f64 * cycles * percent / 100.0);
        for stage in &mut rate.stages {
            stage.per_frame = if stage.stage == wanted { all } else { [0.0; 2] };
        }
    }
    fn nested(survey: &mut Survey, policy: usize, percent: f64) {
        for kind in survey.loops.iter_mut().filter(|kind| kind.walk == "nested") {
            kind.policies[policy].per_branch = Some(percent / 100.0);
        }
    }
    let turns: [(&str, &str, f64, Set, [Answer; 2]); 11] = [
        ("six SPUs, hinted", "30 frames", 30.0, |s, x| s.rates[HINTED].frames_per_second = [x; 2], [No, Yes]),
        ("six SPUs, hinted", "60 frames", 60.0, |s, x| s.rates[HINTED].frames_per_second = [x; 2], [No, Yes]),
        ("without a hint", "60 frames", 60.0, |s, x| s.rates[UNHINTED].frames_per_second = [x; 2], [No, Yes]),
        ("Voxelizing anew", "below 5 %", 5.0, |s, x| work(s, "voxelize", x), [Yes, No]),
        ("Stripes of four", "95 % of a frame or more", 95.0, |s, x| work(s, "voxelize", x), [No, Yes]),
        ("transfers are", "half of a frame or more", 50.0, |s, x| work(s, "DMA", x), [No, Yes]),
        (
            "False positives",
            "below 5 %",
            5.0,
            |s, x| (s.lists.ids, s.lists.false_positives) = (1_000_000, (x * 1e4) as u64),
            [Yes, No],
        ),
        ("Culling cuts", "4 to 8 times", 4.0, |s, x| s.culling.factor = Some(x), [No, Yes]),
        ("Culling cuts", "4 to 8 times", 8.0, |s, x| s.culling.factor = Some(x), [Yes, No]),
        ("Nested loops", "over 50 percent, without hints", 50.0, |s, x| nested(s, UNHINTED, x), [No, Yes]),
        ("Nested loops", "over 50 percent with a hint", 50.0, |s, x| nested(s, HINTED, x), [No, Yes]),
    ];
    let (scene, camera) = view("uniform:100:1", [64, 36]).expect("no data is needed");
    let found = looked("uniform:100:1", &scene, &camera, 1);
    let set: Vec<Looked> = turns
        .iter()
        .flat_map(|(_, _, at, set, _)| [at * 0.999, at * 1.001].map(|x| (set, x)))
        .map(|(set, x)| {
            let mut other = found.clone();
            set(&mut other.survey, x);
            other
        })
        .collect();
    let claims = claims(&set, &[], 1);
    for (k, (of, number, at, _, expected)) in turns.iter().enumerate() {
        let has = |one: &&PaperClaim| [of, number].iter().all(|part| one.statement.contains(*part));
        let such: Vec<&PaperClaim> = claims.iter().filter(has).collect();
        let [claim] = such[..] else { panic!("{of}, {number}: {} claims", such.len()) };
        let answers = [0, 1].map(|side| claim.answers[2 * k + side].answer);
        assert_eq!(
            answers,
            *expected,
            "{}, about {at}: {:?}",
            claim.statement,
            &claim.answers[2 * k..2 * k + 2]
        );
    }
}

/// What every claim owes a reader.
#[test]
fn claims_say_what_they_rest_on() {
    let claims = claims(&[], &[], 1);
    assert!(claims.len() >= 40, "{} claims", claims.len());
    let mut cases = 0;
    for PaperClaim { statement, verdict, evidence, figure, counterexample, how, answers } in &claims {
        assert!(statement.len() > 15 && !how.is_empty() && answers.is_empty(), "{statement}");
        let case = counterexample.as_ref().is_some_and(|against| against.contains("`tests/cases/"));
        cases += usize::from(case);
        if *verdict == Standing::Refuted && *evidence == Evidence::Refuted {
            assert!(counterexample.is_some(), "{statement}: by what?");
        }
        assert!(*verdict == Standing::NotShown || !figure.is_empty(), "{statement}");
    }
    // Each of the six still fails, and so is told.
    assert_eq!(cases, 6);
    // As a piece of a page it is well-formed, but for what must not stand alone, and nothing of it is left out.
    let record = Record { size: [64, 36], sample: 5, claims: claims.clone(), ..stored() };
    let page = format!("<div>{}</div>", part(&record).expect("types give no cause"));
    assert!(page.contains("frames of 64 × 36 pixels; one block of 5 was traced"), "{page}");
    let page = page.replace("<br>", "<br/>");
    let page = Document::parse(&page).expect("well-formed");
    let rows = page.descendants().filter(|node| node.has_tag_name("tr")).count();
    assert_eq!(rows, claims.len() + 1);
    let text = text(&claims);
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(text.contains("not shown") && text.contains("refuted") && text.contains("against it: "));
}

fn stored() -> Record {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(FILE);
    let text = std::fs::read_to_string(path).expect("it is part of the repository");
    Record::from_json(&text).unwrap_or_else(|error| panic!("{FILE}: {error}; `cgt claims --json` makes it"))
}

#[test]
fn readme_shows_what_is_stored() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    let text = std::fs::read_to_string(path).expect("there is a README.md");
    let (_, rest) = text.split_once("<!-- paper-claims -->\n").expect("the table's beginning is marked");
    let (table, _) = rest.split_once("<!-- /paper-claims -->").expect("and its end");
    assert_eq!(table, stored().markdown(), "replace README's table by the right one: cgt claims --markdown");
}

/// What is told as proved is what solvers have proved: it goes with each lemma that they have not, or of which something is wrong, and what rests on
/// nothing else is not shown then.
#[test]
fn claims_are_proved_by_what_solvers_say() {
    let of = |evidence| {
        move |claims: Vec<PaperClaim>| {
            let such = claims.into_iter().filter(|claim: &PaperClaim| claim.evidence == evidence);
            such.map(|claim| claim.statement).collect::<Vec<_>>()
        }
    };
    let proved = |said: &[Finding]| of(Evidence::Proved)(claims(&[], said, 1));
    let told: Vec<Finding> =
        said().iter().map(|one| Finding { outcome: Outcome::Proved, ..one.clone() }).collect();
    let all = proved(&told);
    assert_eq!((all.len(), told.len()), (LEMMAS.len(), LEMMAS.concat().len()));
    if said().iter().all(|one| one.outcome != Outcome::NotJudged) {
        assert_eq!(proved(said()), all, "solvers say otherwise");
    }
    // One of each claim's lemmas, drawn afresh, and something else with each.
    let (mut rng, confirmed) = (generator(seed(), 0), |claims: &[PaperClaim]| {
        claims.iter().filter(|claim| claim.verdict == Standing::Confirmed).count()
    });
    let before = confirmed(&claims(&[], &told, 1));
    let first = rng.random_range(0..LEMMAS.len());
    for (names, what) in
        LEMMAS.into_iter().zip((first..).map(|k| ["open", "wrong", "refuted", "refuted"][k % 4]))
    {
        let name = names[rng.random_range(0..names.len())];
        let other = |one: &Finding| match what {
            "open" => Finding { outcome: Outcome::NotShown(String::new()), ..one.clone() },
            "wrong" => Finding { wrong: vec!["something".into()], ..one.clone() },
            _ => Finding { outcome: Outcome::Refuted(Vec::new()), ..one.clone() },
        };
        let said: Vec<Finding> =
            told.iter().map(|one| if one.name == name { other(one) } else { one.clone() }).collect();
        let found = claims(&[], &said, 1);
        // What has something beside the proof is so all the same, unless the lemma is refuted.
        let less = usize::from(what == "refuted" || name.starts_with("visible"));
        assert_eq!(confirmed(&found), before - less, "{name} is {what}");
        assert_eq!(of(Evidence::Proved)(found).len(), all.len() - 1, "{name} is {what}");
    }
    assert!(proved(&[]).is_empty());
    let unshown = |said: &[Finding]| of(Evidence::NotShown)(claims(&[], said, 1));
    let mut more = unshown(&[]);
    more.retain(|statement| !unshown(&told).contains(statement));
    assert_eq!(more, ["Slices and culling lose nothing that a ray of the packet hits, but for rounding"]);
}

/// The stored file holds eight whole scenes, its verdicts follow from its answers, and what is computed again is the same.
#[test]
fn what_is_stored_is_found_again() {
    let stored = stored();
    assert_eq!((stored.schema_version, stored.kind.as_str()), (SCHEMA_VERSION, "claims"));
    assert_eq!((stored.size, stored.sample), ([1280, 720], 1));
    assert_eq!(stored.scenes, SCENES);
    let long = count("CGT_LONG", 0) > 0;
    let words: Vec<&str> = if long { SCENES.to_vec() } else { EVERYDAY.to_vec() };
    let all: Vec<Option<Looked>> = words
        .par_iter()
        .map(|word| match view(word, stored.size) {
            Ok((scene, camera)) => Some(looked(word, &scene, &camera, stored.sample)),
            Err(SourceError::DataAbsent { name, how }) => {
                eprintln!("not judged: {name}: data absent (run {how})");
                None
            }
            Err(error) => panic!("{error}"),
        })
        .collect();
    let whole = long && all.iter().all(Option::is_some);
    let fresh = claims(&all.into_iter().flatten().collect::<Vec<_>>(), said(), stored.seed);
    let statements = |claims: &[PaperClaim]| claims.iter().map(|c| c.statement.clone()).collect::<Vec<_>>();
    assert_eq!(statements(&stored.claims), statements(&fresh), "{FILE} has other claims than the program");
    let (mut alone, mut answers) = (0, 0);
    for (old, new) in stored.claims.iter().zip(&fresh) {
        if old.evidence == Evidence::Proved && said().iter().any(|one| one.outcome == Outcome::NotJudged) {
            continue;
        }
        if whole || old.answers.is_empty() {
            assert_eq!(old, new, "{FILE} is stale");
            alone += usize::from(old.answers.is_empty());
            continue;
        }
        assert_eq!((old.evidence, &old.how), (new.evidence, &new.how), "{}", old.statement);
        assert_eq!(old.answers.iter().map(|one| one.scene.as_str()).collect::<Vec<_>>(), SCENES);
        let said: Vec<Answer> = old.answers.iter().map(|one| one.answer).collect();
        assert_eq!(old.verdict, Standing::of(&said), "{}", old.statement);
        assert_eq!(old.figure, in_words(&old.answers), "{}", old.statement);
        let case = new.counterexample.clone().filter(|against| against.contains("`tests/cases/"));
        assert_eq!(old.counterexample, case.or(smallest(&old.answers)), "{}", old.statement);
        for answer in &new.answers {
            let of = old.answers.iter().find(|one| one.scene == answer.scene).expect("one of the eight");
            assert_eq!(of, answer, "{}: {FILE} is stale", old.statement);
            answers += 1;
        }
    }
    eprintln!("found again: {alone} claims without a scene, {answers} answers of scenes; all: {whole}");
    assert!(alone >= 15 && (whole || answers >= 50), "{alone}, {answers}");
}
