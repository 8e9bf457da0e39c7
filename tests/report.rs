//! Does the report say everything it was told, in a page that needs nothing but itself?

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use contract::{Camera, Image, MISS, Size};
use sha2::{Digest, Sha256};
use std::collections::HashSet;
use std::error::Error;
use verify::judge::outside::{Adjudicated, Hearing};
use verify::picture::{canvas, panels, zoom};
use verify::report::{
    Absent, Claim, Counter, Environment, Evidence, Judge, Part, Report, ReportError, SCHEMA_VERSION,
    ScenePictures, SceneReport, SubjectReport, TEXT_WIDTH, TRUTH, html, json, overall, sanitized, text, word,
    write,
};
use verify::verdict::{Comparison, UlpSummary, Verdict};

type Outcome = Result<(), Box<dyn Error>>;

const VERDICTS: [Verdict; 5] =
    [Verdict::Equal, Verdict::WithinBound, Verdict::Undecidable, Verdict::Wrong, Verdict::NotJudged];
/// A name that would break out of text, attribute, terminal and folder.
const HOSTILE: &str = "../<script>alert('x')</script>\" onload=\"y\u{1b}[31m";

fn truth() -> Result<Image, Box<dyn Error>> {
    let mut image = Image::new(Size::new(64, 48)?, [9, 9, 20])?;
    image.ids[100..900].fill(3);
    image.t[100..900].fill(4.25);
    image.rgba[100..900].fill([200, 120, 40, 255]);
    Ok(image)
}

fn subject(name: &str, verdict: Verdict) -> SubjectReport {
    let wrong = u64::from(verdict == Verdict::Wrong);
    let comparison = Comparison {
        pixels: 3072,
        hits: 800,
        wrong_ids: wrong,
        missing: wrong,
        t_ulp: UlpSummary { count: 800 - wrong, median: 0, p99: 0, max: 0 },
        wrong_color: wrong,
        first_wrong: (wrong > 0).then_some([58, 1]),
        ..Comparison::default()
    };
    SubjectReport {
        name: name.to_owned(),
        description: format!("{name} & its description"),
        promise: format!("promise of {name}"),
        known_fault: false,
        verdict,
        because: format!("reason for {name}"),
        comparison: (verdict != Verdict::NotJudged).then_some(comparison),
        seconds: Some(0.5),
        rays_per_second: Some(123_456_789.0),
        picture: None,
        first_wrong: (wrong > 0).then(|| "pixel (58, 1) <replay>".to_owned()),
    }
}

/// One that agrees, and one that does not.
fn hearings() -> Vec<Hearing> {
    let inside = Adjudicated { reference: 4321, ..Adjudicated::default() };
    let mut t_ulp = [0; 12];
    t_ulp[3] = 7654;
    let sound = Hearing {
        witness: "Tracer <of others> 1.2".to_owned(),
        mode: "plain, 4 wide".to_owned(),
        rays: 3072,
        inside,
        t_ulp,
        ..Hearing::default()
    };
    let wrong = Hearing {
        mode: "odd, 1 wide".to_owned(),
        outside: 2,
        first: Some("<here>".to_owned()),
        ..sound.clone()
    };
    vec![sound, wrong]
}

fn scene(name: &str, subjects: Vec<SubjectReport>) -> Result<SceneReport, Box<dyn Error>> {
    let camera = Camera::new(
        [0.0, 0.1, -5.0],
        [-1.0, -1.0, 1.0],
        [0.1, 0.0, 0.0],
        [0.0, 0.1, 0.0],
        Size::new(64, 48)?,
    )?;
    Ok(SceneReport {
        name: name.to_owned(),
        description: "a bar of one sphere".to_owned(),
        provenance: "made by hand".to_owned(),
        spheres: 4,
        frame: 0,
        frames: 1,
        width: 64,
        height: 48,
        camera: (&camera).into(),
        warnings: vec!["line 3 <is> empty".to_owned()],
        judge: Judge {
            name: "exact".to_owned(),
            counters: vec![Counter { name: "decided by integers".to_owned(), value: 1_234_567 }],
        },
        hits: 800,
        picture: None,
        subjects,
        outside: hearings(),
    })
}

/// Two scenes, a subject for each verdict, a claim for each kind of evidence but one.
fn report() -> Result<Report, Box<dyn Error>> {
    let subjects =
        || VERDICTS.map(|verdict| subject(&format!("subject {}", word(verdict)), verdict)).to_vec();
    let claims = Evidence::ALL[..6].iter().map(|kind| Claim {
        statement: format!("this & that is {}", kind.word()),
        evidence: *kind,
        figure: format!("figure of {}", kind.word()),
        how: format!("cgt show <{}>", kind.word()),
    });
    let scenes = vec![scene("bar", subjects())?, scene(HOSTILE, subjects())?];
    Ok(Report {
        schema_version: SCHEMA_VERSION,
        title: "A <title>".to_owned(),
        verdict: overall(&scenes, &[], &[]),
        environment: Environment {
            program: "cgt 0.0".to_owned(),
            target: "made-up".to_owned(),
            cpu: None,
            simd: "none".to_owned(),
            rustc: "rustc".to_owned(),
            threads: 3,
            date: "2026-01-02T03:04:05Z".to_owned(),
            command_line: "cgt judge <all>".to_owned(),
            seed: Some(u64::MAX),
        },
        scenes,
        claims: claims.collect(),
        broken: Vec::new(),
        absent: vec![Absent { judge: "Embree".to_owned(), why: "it is not here ".repeat(20), needed: false }],
    })
}

/// For each scene: a picture for every subject but the last; the wrong one misses a pixel.
fn pictures(report: &Report) -> Result<Vec<ScenePictures>, Box<dyn Error>> {
    let truth = truth()?;
    let mut wrong = truth.clone();
    wrong.ids[122] = MISS;
    let mut sets = Vec::new();
    for scene in &report.scenes {
        let mut set = ScenePictures::new(&truth)?;
        for subject in &scene.subjects {
            match subject.verdict {
                Verdict::NotJudged => set.skip(),
                Verdict::Wrong => set.add((TRUTH, &truth), &wrong, Some([58, 1]))?,
                _ => set.add((TRUTH, &truth), &truth, None)?,
            }
        }
        sets.push(set);
    }
    Ok(sets)
}

/// Three frames under one hostile name, each with a right subject and a wrong one that is shown as a known fault.
fn film() -> Result<Report, Box<dyn Error>> {
    let frame = |number: usize| -> Result<SceneReport, Box<dyn Error>> {
        let fault = SubjectReport { known_fault: true, ..subject("a fault", Verdict::Wrong) };
        let subjects = vec![subject("right", Verdict::Equal), fault];
        Ok(SceneReport { frame: number, frames: 9, outside: Vec::new(), ..scene(HOSTILE, subjects)? })
    };
    let scenes = vec![frame(2)?, frame(3)?, frame(4)?];
    Ok(Report { verdict: overall(&scenes, &[], &[]), scenes, ..report()? })
}

/// The script turns the frames, the policy lets in that script alone, and without it the first frame is seen.
#[test]
fn frames_of_one_scene_are_a_film() -> Outcome {
    let mut report = film()?;
    report.scenes.push(scene("bar", vec![subject("right", Verdict::Equal)])?);
    let page = html(&report, &pictures(&report)?, &[])?;
    let script = page.split("<script>").nth(1).and_then(|rest| rest.split("</script>").next());
    let script = script.ok_or("a film has a script")?;
    assert_eq!(page.matches("<script").count(), 1);
    let hash = BASE64_STANDARD.encode(Sha256::digest(script));
    assert!(page.contains(&format!("script-src 'sha256-{hash}'\"")), "the policy does not know its script");
    let hidden: Vec<bool> = page
        .split("data-frame=\"")
        .skip(1)
        .map(|rest| rest.split('>').next().unwrap_or("").contains("hidden"))
        .collect();
    assert_eq!(hidden, [false, true, true]);
    assert!(
        page.contains("<a href=\"#scene-1\">") && !page.contains("href=\"#scene-2\""),
        "one row for a film"
    );
    assert!(!page.contains("alert('x')"), "its name is text");
    // A single frame is no film, and has no script.
    let single = Report { scenes: report.scenes[..1].to_vec(), ..report.clone() };
    let page = html(&single, &pictures(&single)?, &[])?;
    assert!(!page.contains("script-src") && !page.contains("data-reel>"));
    let told = text(&report, false);
    assert_eq!(told.lines().filter(|line| line.contains("#2-4")).count(), 2, "{told}");
    Ok(())
}

/// A film of which one frame is wrong is wrong, and its speed is that of all its pixels in all its time.
#[test]
fn a_film_is_its_worst_frame_and_its_whole_time() -> Outcome {
    let frame = |number: usize, verdict: Verdict, seconds: f64| -> Result<SceneReport, Box<dyn Error>> {
        let one = SubjectReport { seconds: Some(seconds), ..subject("one", verdict) };
        Ok(SceneReport { frame: number, frames: 9, outside: Vec::new(), ..scene("reel", vec![one])? })
    };
    let mut scenes = vec![
        frame(2, Verdict::Equal, 0.000_5)?,
        frame(3, Verdict::Wrong, 0.001)?,
        frame(4, Verdict::WithinBound, 0.001_5)?,
    ];
    if let Some(comparison) = &mut scenes[2].subjects[0].comparison {
        (comparison.wrong_t, comparison.wrong_color) = (17, 29);
    }
    scenes.push(scene("bar", vec![subject("one", Verdict::Equal)])?);
    let report = Report { verdict: overall(&scenes, &[], &[]), scenes, ..report()? };
    let told = text(&report, false);
    let line = told.lines().find(|line| line.contains("#2-4")).ok_or("a film has a line")?;
    let words: Vec<&str> = line.split_whitespace().collect();
    // 3 · 3072 pixels in 3 ms.
    assert_eq!(words, ["reel", "#2-4", "one", "≠", "wrong", "1", "17", "30", "0", "3.07"], "{told}");
    let page = html(&report, &pictures(&report)?, &[])?;
    let row = page.split_once("<a href=\"#scene-1\">").and_then(|(_, rest)| rest.split("</tr>").next());
    let row = row.ok_or("a film has a row in the overview")?;
    assert!(
        row.contains("reel, 3 frames") && row.contains("seal wrong") && !row.contains("seal equal"),
        "{row}"
    );
    // Every frame has its verdict, and its own three counts.
    let every = page.split("Every frame</summary>").nth(1).and_then(|rest| rest.split("</table>").next());
    let rows: Vec<&str> =
        every.ok_or("all frames are told")?.split("<tr><th scope=\"row\">").skip(1).collect();
    for (row, (class, counts)) in
        rows.iter().zip([("equal", [0, 0, 0]), ("wrong", [1, 0, 1]), ("within", [0, 17, 29])])
    {
        let counts = counts.map(|count| format!("<td>{count}</td>")).concat();
        assert!(row.contains(&format!("seal {class}")) && row.contains(&counts), "{row}");
    }
    assert_eq!(rows.len(), 3);
    assert!(page.contains("one: within bound, 0 wrong ids, 17 wrong t"), "it is told below its picture");
    Ok(())
}

/// Frames of one name by other tracers, of another size or out of order are told by themselves: a row is of one list of tracers.
#[test]
fn frames_by_other_tracers_are_another_film() -> Outcome {
    let frame = |number: usize, subjects: &[(&str, Verdict)]| -> Result<SceneReport, Box<dyn Error>> {
        let subjects = subjects.iter().map(|(name, verdict)| subject(name, *verdict)).collect();
        Ok(SceneReport { frame: number, frames: 9, outside: Vec::new(), ..scene("reel", subjects)? })
    };
    let (right, liar) = (("right", Verdict::Equal), ("liar", Verdict::Wrong));
    let alone = frame(0, &[("other", Verdict::WithinBound), right])?;
    let small = SceneReport { width: 32, ..frame(1, &[right, liar])? };
    for (scenes, items) in [
        (
            vec![alone.clone(), frame(0, &[right, liar])?, frame(1, &[right, liar])?],
            ["reel, frame 0", "reel, 2 frames"],
        ),
        (vec![frame(0, &[right, liar])?, frame(1, &[liar, right])?], ["reel, frame 0", "reel, frame 1"]),
        (vec![frame(0, &[right, liar])?, small], ["reel, frame 0", "reel, frame 1"]),
        (vec![frame(1, &[right, liar])?, frame(1, &[right, liar])?], ["reel, frame 1", "reel, frame 1"]),
        (vec![frame(2, &[right, liar])?, frame(1, &[right, liar])?], ["reel, frame 2", "reel, frame 1"]),
    ] {
        let report = Report { scenes, ..report()? };
        let page = html(&report, &[], &[])?;
        let overview =
            page.split("<table class=\"matrix\">").nth(1).and_then(|rest| rest.split("</table>").next());
        let overview = overview.ok_or("there is an overview")?;
        let columns: Vec<&str> = overview.split("<th scope=\"col\">").skip(2).collect();
        let rows: Vec<&str> = overview.split("<tr><th scope=\"row\">").skip(1).collect();
        let names: Vec<&str> = rows.iter().filter_map(|row| row.split(['>', '<']).nth(2)).collect();
        assert_eq!(names, items);
        for row in rows {
            for (column, cell) in columns.iter().zip(row.split("<td>").skip(1)) {
                for (name, class) in [("right", "equal"), ("liar", "wrong"), ("other", "within")] {
                    let other = column.starts_with(name) && cell.contains("seal") && !cell.contains(class);
                    assert!(!other, "{items:?}: under {name}: {cell}");
                }
            }
        }
        let told = text(&report, false);
        assert_eq!(told.lines().any(|line| line.contains("#0-1")), items[1].contains("2 frames"), "{told}");
    }
    Ok(())
}

/// Of a film, too, the page says why each frame has its verdict, what was promised, where it is wrong first, what was warned of, and what
/// was said from outside, and in which frame.
#[test]
fn a_film_says_all_it_was_told() -> Outcome {
    let heard = |frame: usize| Hearing {
        outside: u64::from(frame == 3),
        first: (frame == 3).then(|| "<there>".to_owned()),
        ..hearings()[0].clone()
    };
    let frame = |number: usize, verdict: Verdict| -> Result<SceneReport, Box<dyn Error>> {
        let one = SubjectReport {
            because: format!("<why> in {number}."),
            first_wrong: (verdict != Verdict::Equal).then(|| format!("pixel <of {number}>")),
            ..subject("one", verdict)
        };
        let mut warnings = vec!["always <so>".to_owned()];
        warnings.extend((number != 3).then(|| "at times".to_owned()));
        let outside = if number == 5 { Vec::new() } else { vec![heard(number)] };
        Ok(SceneReport { frame: number, frames: 9, warnings, outside, ..scene("reel", vec![one])? })
    };
    let verdicts =
        [(2, Verdict::WithinBound), (3, Verdict::Equal), (4, Verdict::NotJudged), (5, Verdict::NotJudged)];
    let scenes = verdicts.iter().map(|(n, verdict)| frame(*n, *verdict)).collect::<Result<Vec<_>, _>>()?;
    let report = Report { verdict: overall(&scenes, &[], &[]), scenes, ..report()? };
    let page = html(&report, &pictures(&report)?, &[])?;
    let told = |text: &str| page.contains(&escaped(text));
    for (number, _) in verdicts {
        assert!(told(&format!("<why> in {number}.")), "frame {number} has no reason");
    }
    assert!(told("promise of one") && told("one & its description"));
    assert!(
        page.contains(&format!("<i>Verdict of frame 4:</i> {}", escaped("<why> in 4."))),
        "the worst one's"
    );
    assert!(told("pixel <of 4>") && page.contains("The first wrong pixel of frame 4:"));
    assert!(!told("pixel <of 2>"), "an account of a frame that is less bad");
    assert!(page.contains(&format!("<li>{}</li>", escaped("always <so>"))), "of every frame");
    assert!(page.contains("<li>at times (of frame 2, 4, 5)</li>"));
    // Three of four frames were heard, and one answer in one of them cannot be explained.
    let row = row(&page, &escaped("Tracer <of others> 1.2, plain, 4 wide"))?;
    assert_below(&row, &[("verdict", "≠ wrong"), ("rays", "9\u{202f}216"), ("failures", "1")]);
    let said = "Tracer <of others> 1.2 on reel, 4 frames: wrong. Asked in 1 ways (plain), 9\u{202f}216 rays:";
    assert!(told(said) && told("1 answers cannot be explained, the first: in frame 3: <there>."));
    let text = text(&report, false).split_whitespace().collect::<Vec<_>>().join(" ");
    // There, too, the narrow space is one.
    let said = said.replace('\u{202f}', " ");
    assert!(text.contains(&said) && text.contains("the first: in frame 3: <there>."), "{text}");
    assert!(text.contains("one on reel, frame 4: <why> in 4."), "{text}");
    let every = page.split("Every frame</summary>").nth(1).and_then(|rest| rest.split("</table>").next());
    let rows: Vec<&str> =
        every.ok_or("all frames are told")?.split("<tr><th scope=\"row\">").skip(1).collect();
    let seals = |row: &str| row.matches("class=\"seal ").count();
    assert_eq!(rows.iter().map(|row| seals(row)).collect::<Vec<_>>(), [2, 2, 2, 1], "5 was not heard");
    assert!(
        rows[0].contains("seal within") && rows[1].contains("seal equal") && rows[1].contains("seal wrong")
    );
    // A witness that is silent on one frame has not judged that, whatever it said of others.
    let mut scenes = report.scenes.clone();
    scenes.truncate(2);
    scenes[1].outside = vec![Hearing { not_stated: [3072, 0], ..hearings()[0].clone() }];
    let silent = Report { scenes, ..report };
    let page = html(&silent, &pictures(&silent)?, &[])?;
    assert_below(&self::row(&page, &escaped("Tracer <of others>"))?, &[("verdict", "– not judged")]);
    Ok(())
}

/// The sentence below the verdict says whose it is.
#[test]
fn the_lead_is_true_of_who_has_the_verdict() -> Outcome {
    use Verdict::{Equal, NotJudged, Undecidable, WithinBound, Wrong};
    let unstated = Hearing { not_stated: [1, 0], ..hearings()[0].clone() };
    let near = &hearings()[..1];
    for (verdict, outside, broken, lead) in [
        (Equal, &[][..], false, "Every picture has the bits of the exact one."),
        (Equal, near, false, "where an outside judge differs, its rounding cannot decide."),
        (Equal, &[unstated], false, "outside what an outside judge states"),
        (Equal, &hearings(), false, "An outside judge and the exact picture differ"),
        (WithinBound, &hearings(), false, "An outside judge and the exact picture differ"),
        (WithinBound, near, false, "where the subject's stated arithmetic cannot decide"),
        (Undecidable, near, false, "Some pixels lie outside what a subject states"),
        (Wrong, near, false, "At least one pixel is wrong"),
        (Wrong, &hearings(), false, "At least one pixel is wrong"),
        (Equal, near, true, "A promise is broken"),
        (NotJudged, near, false, "Something here was not compared."),
    ] {
        let fault = SubjectReport { known_fault: true, ..subject("a fault", Wrong) };
        let one = scene("a", vec![subject("one", verdict), fault])?;
        let scenes = vec![SceneReport { outside: outside.to_vec(), ..one }];
        let broken = vec!["somewhere".to_owned(); usize::from(broken)];
        let report = Report { verdict: overall(&scenes, &broken, &[]), scenes, broken, ..report()? };
        let page = html(&report, &[], &[])?;
        let told = page.split("<p class=\"lead\">").nth(1).and_then(|rest| rest.split("</p>").next());
        let told = told.ok_or("there is a sentence")?;
        assert!(told.contains(&escaped(lead)), "{verdict:?}, {outside:?}, {:?}: {told}", report.broken);
    }
    Ok(())
}

/// A number of wrong pixels that is a power of ten stands on the tick that says so, one half-way between two in their middle, zero by
/// itself; speed is told as a part of the fastest.
#[test]
fn marks_stand_where_their_axis_says() -> Outcome {
    let compared = |wrong_ids, wrong_t, wrong_color, rays| {
        let pixels = 1_000_000;
        let comparison = Comparison { pixels, wrong_ids, wrong_t, wrong_color, ..Comparison::default() };
        let comparison = Some(comparison);
        SubjectReport { comparison, rays_per_second: rays, ..subject("one", Verdict::WithinBound) }
    };
    let subjects = vec![
        compared(1, 1000, 1_000_000, Some(2e8)),
        compared(0, 31_623, 100, Some(5e7)),
        compared(10, 0, 10_000, None),
    ];
    let report = Report { scenes: vec![scene("bar", subjects)?], ..report()? };
    let page = html(&report, &[], &[])?;
    let numbers = |text: &str, begins: &str| -> Vec<f64> {
        let values = text.split(begins).skip(1).filter_map(|rest| rest.split('%').next());
        values.filter_map(|value| value.parse().ok()).collect()
    };
    let labels = page.split("<svg class=\"labels\">").nth(1).and_then(|rest| rest.split("</svg>").next());
    let labels = labels.ok_or("the axis is labelled")?;
    let named: Vec<&str> =
        labels.split("y=\"12\">").skip(1).filter_map(|rest| rest.split('<').next()).collect();
    let ticks = numbers(labels, "<text x=\"");
    assert_eq!(named, ["0", "1", "10", "10²", "10³", "10⁴", "10⁵", "10⁶"]);
    assert_eq!(ticks.len(), named.len());
    let at = |label: &str| ticks[named.iter().position(|name| *name == label).expect("a tick")];
    let step = (at("10⁶") - at("1")) / 6.0;
    assert!(ticks[1..].windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 0.02), "{ticks:?}");
    assert!(at("0") >= 0.0 && at("0") + step / 2.0 < at("1") && at("10⁶") <= 100.0, "{ticks:?}");

    let strips: Vec<&str> = page.split("<svg class=\"strip\"").skip(1).collect();
    assert_eq!(strips.len(), 3);
    for (strip, [ids, t, color]) in strips.iter().zip([
        [at("1"), at("10³"), at("10⁶")],
        [at("0"), (at("10⁴") + at("10⁵")) / 2.0, at("10²")],
        [at("10"), at("0"), at("10⁴")],
    ]) {
        let strip = strip.split("</svg>").next().unwrap_or_default();
        let near = |found: Vec<f64>, due: &[f64], what: &str| {
            let same = found.len() == due.len() && found.iter().zip(due).all(|(x, y)| (x - y).abs() < 0.02);
            assert!(same, "{what} at {found:?}, not at {due:?}: {strip}");
        };
        near(numbers(strip, "class=\"ids\" cx=\""), &[ids], "ids");
        near(numbers(strip, "class=\"t\" cx=\""), &[t], "t");
        near(numbers(strip, "class=\"color\" x1=\""), &[color], "colours");
        near(numbers(strip, "class=\"base\" x1=\""), &[at("1")], "the line's beginning");
        let base = strip.split("class=\"base\"").nth(1).and_then(|rest| rest.split("/>").next());
        near(numbers(base.unwrap_or_default(), "x2=\""), &[at("10⁶")], "the line's end");
        near(numbers(strip, "<line x1=\""), &ticks, "ticks");
    }
    assert_eq!(numbers(&page, "<rect width=\""), [100.0, 25.0], "a bar for each that was timed");
    Ok(())
}

/// What other chapters found broken makes the whole wrong and is told wherever the verdict is.
#[test]
fn what_other_chapters_found_broken_is_told() -> Outcome {
    let scenes =
        vec![SceneReport { outside: Vec::new(), ..scene("bar", vec![subject("s", Verdict::Equal)])? }];
    let broken = vec!["<exact> at 100 radii".to_owned()];
    assert_eq!(overall(&scenes, &[], &[]), Verdict::Equal);
    let report = Report { verdict: overall(&scenes, &broken, &[]), scenes, broken, ..report()? };
    assert_eq!(report.verdict, Verdict::Wrong);
    let page = html(&report, &pictures(&report)?, &[])?;
    assert!(page.contains("&#60;exact&#62; at 100 radii") && page.contains("A promise is broken"));
    assert!(!page.contains("At least one pixel is wrong"), "no pixel of these pictures is");
    let told = text(&report, false);
    assert!(told.contains("<exact> at 100 radii") && told.trim_end().ends_with("≠ wrong"), "{told}");
    assert!(json(&report)?.contains("<exact> at 100 radii"));
    Ok(())
}

#[test]
fn a_known_fault_is_shown_and_not_counted() -> Outcome {
    let report = film()?;
    assert_eq!(report.verdict, Verdict::Equal);
    let page = html(&report, &pictures(&report)?, &[])?;
    assert!(page.contains("<b>3</b> equal</li>") && page.contains("<b>0</b> wrong</li>"));
    assert!(page.contains("<b>a fault</b> is shown as a known fault"));
    let mut faults = report.scenes;
    faults.iter_mut().for_each(|scene| drop(scene.subjects.remove(0)));
    assert_eq!(overall(&faults, &[], &[]), Verdict::NotJudged, "known faults alone are no run");
    Ok(())
}

#[test]
fn chapters_follow_the_scenes() -> Outcome {
    let report = report()?;
    let part = Part { anchor: "own", title: "A <chapter>".to_owned(), body: "<p>its body</p>".to_owned() };
    let page = html(&report, &pictures(&report)?, &[part])?;
    let at = |text: &str| page.find(text).ok_or_else(|| format!("{text} is not on the page"));
    assert!(at("id=\"scene-2\"")? < at("<p>its body</p>")? && at("<p>its body</p>")? < at("id=\"claims\"")?);
    assert!(page.contains("<a href=\"#own\">A &#60;chapter&#62;</a>"));
    Ok(())
}

fn page() -> Result<String, Box<dyn Error>> {
    let report = report()?;
    Ok(html(&report, &pictures(&report)?, &[])?)
}

/// As HTML escapes it, in the form this page uses.
fn escaped(text: &str) -> String {
    let signs = [('&', "&#38;"), ('<', "&#60;"), ('>', "&#62;"), ('"', "&#34;"), ('\'', "&#39;")];
    signs.iter().fold(text.to_owned(), |text, (sign, code)| match sign {
        '&' => text.replace('&', code),
        sign => text.replace(*sign, code),
    })
}

#[test]
fn page_needs_nothing_but_itself() -> Outcome {
    let page = page()?;
    for foreign in ["http://", "https://", "<script", "<link", "<iframe", "@import", "url(", "//cdn"] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    let values = |attribute: &str| {
        page.split(attribute)
            .skip(1)
            .map(|rest| rest.split('"').next().unwrap_or_default())
            .collect::<Vec<_>>()
    };
    let sources = values(" src=\"");
    assert!(sources.iter().all(|source| source.starts_with("data:image/png;base64,iVBOR")));
    // Each scene: the truth once, and for its one wrong subject three panels and three magnified ones.
    assert_eq!(sources.len(), 2 * 7);
    let ids: HashSet<_> = values(" id=\"").into_iter().collect();
    assert_eq!(ids.len(), values(" id=\"").len(), "an id stands twice");
    for link in values(" href=\"") {
        assert!(link.strip_prefix('#').is_some_and(|id| ids.contains(id)), "{link} leads nowhere");
    }
    Ok(())
}

#[test]
fn page_shows_text_as_text() -> Outcome {
    let page = page()?;
    assert!(!page.contains("<script>") && !page.contains("\" onload="));
    assert!(page.contains(&escaped(HOSTILE)));
    for told in ["A <title>", "line 3 <is> empty", "pixel (58, 1) <replay>", "cgt judge <all>"] {
        assert!(page.contains(&escaped(told)) && !page.contains(told), "{told}");
    }
    Ok(())
}

#[test]
fn page_says_all_it_was_told() -> Outcome {
    let (page, report) = (page()?, report()?);
    for scene in &report.scenes {
        for subject in &scene.subjects {
            for told in [&subject.name, &subject.description, &subject.promise, &subject.because] {
                let times = page.matches(&escaped(told)).count();
                assert!(times >= report.scenes.len(), "{told}: {times}");
            }
        }
    }
    assert!(page.contains("Nothing in this table was computed for this page."));
    for claim in &report.claims {
        for told in [&claim.statement, &claim.figure, &claim.how] {
            assert!(page.contains(&escaped(told)), "{told}");
        }
    }
    for kind in Evidence::ALL {
        let number = u8::from(kind != Evidence::NotShown);
        assert!(page.contains(&format!("<b>{number}</b> {}</li>", kind.word())), "{kind:?}, zeros included");
    }
    for verdict in VERDICTS {
        assert!(page.contains(&format!("<b>2</b> {}</li>", word(verdict))), "{verdict:?}");
    }
    let bits = format!("0x{:08x}", 0.1_f32.to_bits());
    let seed = u64::MAX.to_string();
    for told in [
        "4\u{202f}321",
        "7\u{202f}654",
        "Tracer &#60;of others&#62; 1.2, plain, 4 wide",
        "Embree",
        "1\u{202f}234\u{202f}567",
        "58, 1",
        "<td>123</td>",
        "wrong per million: ids 326, t 0, colours 326",
        &bits,
        &seed,
        "2026-01-02T03:04:05Z",
    ] {
        assert!(page.contains(told), "{told}");
    }
    Ok(())
}

#[test]
fn every_picture_on_the_page_has_words() -> Outcome {
    let page = page()?;
    for tag in page.split("<img ").skip(1).map(|rest| rest.split('>').next().unwrap_or_default()) {
        let alt = tag.split(" alt=\"").nth(1).unwrap_or_default();
        assert!(alt.len() > 10, "no words for a picture");
    }
    Ok(())
}

/// The pictures on a page in their order, by their words.
fn seen(page: &str) -> Result<Vec<(String, image::RgbaImage)>, Box<dyn Error>> {
    let tag = |tag: &str| -> Result<_, Box<dyn Error>> {
        let part =
            |name: &str| tag.split(name).nth(1).and_then(|rest| rest.split('"').next()).unwrap_or_default();
        let data = part("src=\"").strip_prefix("data:image/png;base64,").ok_or("no PNG")?;
        Ok((part("alt=\"").to_owned(), image::load_from_memory(&BASE64_STANDARD.decode(data)?)?.to_rgba8()))
    };
    page.split("<img ").skip(1).map(tag).collect()
}

/// What a page shows of a wrong subject is what was promised, what was given and where they differ, in this order and under these names,
/// whole and magnified; a film's frame shows the truth, what was given and where they differ.
#[test]
fn pictures_are_what_their_words_say() -> Outcome {
    let truth = truth()?;
    let mut given = truth.clone();
    (given.ids[122], given.rgba[122]) = (MISS, [1, 250, 3, 255]);
    let (place, names) = ([58, 1], ["truth", "subject", "difference"]);
    let (whole, near) = (panels(&truth, &given, Some(place))?, zoom(&truth, &given, place, 21, 16)?);
    let pictures = || -> Result<_, Box<dyn Error>> {
        let mut set = ScenePictures::new(&truth)?;
        set.add((TRUTH, &truth), &given, Some(place))?;
        Ok(set)
    };
    let frame = |number| -> Result<_, Box<dyn Error>> {
        let scene = scene("bar", vec![subject("one", Verdict::Wrong)])?;
        Ok(SceneReport { frame: number, frames: 9, outside: Vec::new(), ..scene })
    };
    let single = Report { scenes: vec![frame(2)?], ..report()? };
    let found = seen(&html(&single, &[pictures()?], &[])?)?;
    let panels: Vec<_> = whole.iter().chain(&near).zip(names.iter().cycle()).collect();
    assert_eq!(found.len(), 1 + panels.len());
    for ((words, shown), (made, name)) in found[1..].iter().zip(panels) {
        assert!(words.contains(&format!("one on bar: {name},")), "{words}: {name} is due");
        assert!(shown == made, "{words}: other pixels");
    }
    assert!(whole[0] != whole[1] && whole[1] != whole[2] && near[0] != near[1], "nothing could be mistaken");

    let film = Report { scenes: vec![frame(2)?, frame(3)?], ..report()? };
    let found = seen(&html(&film, &[pictures()?, pictures()?], &[])?)?;
    // At its head, as at a single one's, the truth alone.
    assert_eq!(found.len(), 7);
    let made = [&canvas(&truth)?, &whole[1], &whole[2]];
    assert!(found[0].1 == *made[0], "{}: other pixels", found[0].0);
    for (k, (words, shown)) in found[1..].iter().enumerate() {
        assert!(shown == made[k % 3], "{words}: other pixels");
    }
    Ok(())
}

/// Cells of the row of a page's table that begins so, by the table's headings.
fn row(page: &str, begins: &str) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let cells = |row: &str| -> Vec<String> {
        let cell = |part: &str| {
            let text = part.split_once('>').map_or("", |(_, rest)| rest);
            let text = text.split("</t").next().unwrap_or_default();
            text.split('<').map(|part| part.rsplit('>').next().unwrap_or_default()).collect::<String>()
        };
        row.split("<t").skip(1).filter(|part| part.starts_with(['h', 'd'])).map(cell).collect()
    };
    let table = |table: &&str| {
        table.split("<tr>").any(|row| cells(row).first().is_some_and(|c| c.starts_with(begins)))
    };
    let table = page.split("<table").find(table).ok_or(begins)?;
    let mut rows = table.split("<tr>").skip(1).map(cells);
    let headings = rows.next().ok_or("no headings")?;
    let row = rows.find(|row| row.first().is_some_and(|cell| cell.starts_with(begins))).ok_or(begins)?;
    Ok(headings.into_iter().zip(row).collect())
}

/// On the page, too, each number of a comparison and of a hearing stands below its own heading.
#[test]
fn numbers_stand_in_their_columns_on_the_page() -> Outcome {
    let mut report = report()?;
    let comparison = report.scenes[0].subjects[0].comparison.as_mut().ok_or("compared")?;
    *comparison = Comparison {
        wrong_ids: 11,
        missing: 12,
        extra: 13,
        swapped: 14,
        wrong_t: 15,
        t_ulp: UlpSummary { count: 9, median: 16, p99: 17, max: 18 },
        wrong_color: 19,
        color_max: 20,
        first_wrong: Some([21, 22]),
        ..*comparison
    };
    report.scenes[0].outside = vec![Hearing {
        witness: "Somebody".to_owned(),
        rays: 31,
        hits: 32,
        not_stated: [33, 34],
        in_band: 35,
        inside: Adjudicated { reference: 36, ties: 37, ..Adjudicated::default() },
        outside: 38,
        wrong_t: 39,
        t_ulp_max: 40,
        ..Hearing::default()
    }];
    let page = html(&report, &pictures(&report)?, &[])?;
    let due = [
        ("wrong ids", "11"),
        ("missing", "12"),
        ("extra", "13"),
        ("swapped", "14"),
        ("wrong t", "15"),
        ("ulp of t, median", "16"),
        ("ulp of t, 99\u{a0}%", "17"),
        ("ulp of t, most", "18"),
        ("wrong colours", "19"),
        ("by at most", "20"),
        ("first wrong", "21, 22"),
    ];
    assert_below(&row(&page, &report.scenes[0].subjects[0].name)?, &due);
    let due = [
        ("rays", "31"),
        ("seen by both", "32"),
        ("not stated", "33"),
        ("of these different", "34"),
        ("in the band", "35"),
        ("decided for the reference", "36"),
        ("ties", "37"),
        ("failures", "77"),
        ("ulp of t, most", "40"),
    ];
    assert_below(&row(&page, "Somebody")?, &due);
    Ok(())
}

fn assert_below(row: &[(String, String)], due: &[(&str, &str)]) {
    for (heading, number) in due {
        let found: Vec<_> = row.iter().filter(|(name, _)| name == heading).map(|(_, cell)| cell).collect();
        assert_eq!(found, [number], "{heading}: {row:?}");
    }
}

/// A run of nothing is no pass, and its page and table stand.
#[test]
fn an_empty_report_is_not_judged() -> Outcome {
    let empty = Report { scenes: Vec::new(), claims: Vec::new(), absent: Vec::new(), ..report()? };
    assert_eq!(overall(&empty.scenes, &[], &[]), Verdict::NotJudged);
    assert!(html(&empty, &[], &[])?.contains("</html>"));
    assert!(text(&empty, false).contains("subject"));
    Ok(())
}

#[test]
fn the_worst_verdict_is_the_verdict() -> Outcome {
    use Verdict::{Equal, NotJudged, Undecidable, WithinBound, Wrong};
    let run = |verdicts: &[Verdict]| -> Result<Verdict, Box<dyn Error>> {
        let subjects = verdicts.iter().map(|verdict| subject("s", *verdict)).collect();
        let quiet = |scene: SceneReport| SceneReport { outside: Vec::new(), ..scene };
        Ok(overall(&[quiet(scene("a", subjects)?), quiet(scene("b", vec![subject("s", Equal)])?)], &[], &[]))
    };
    assert_eq!(run(&[])?, Equal);
    assert_eq!(run(&[Equal, WithinBound])?, WithinBound);
    assert_eq!(run(&[Undecidable, WithinBound])?, Undecidable);
    assert_eq!(run(&[Undecidable, NotJudged])?, NotJudged);
    assert_eq!(run(&[Wrong, NotJudged])?, Wrong);
    let with = |outside: &[Hearing], needed: bool| -> Result<Verdict, Box<dyn Error>> {
        let scene = SceneReport { outside: outside.to_vec(), ..scene("a", vec![subject("s", Equal)])? };
        let absent = Absent { judge: "j".to_owned(), why: String::new(), needed };
        Ok(overall(&[scene], &[], &[absent]))
    };
    assert_eq!(with(&[], false)?, Equal);
    assert_eq!(with(&[], true)?, NotJudged, "a judge that was asked for is absent");
    assert_eq!(with(&hearings()[..1], false)?, WithinBound);
    assert_eq!(with(&hearings(), false)?, Wrong, "a witness does not agree");
    let unstated = Hearing { not_stated: [1, 0], ..hearings()[0].clone() };
    assert_eq!(with(std::slice::from_ref(&unstated), false)?, Undecidable);
    let silent = Hearing { not_stated: [unstated.rays, 0], ..unstated };
    assert_eq!(with(&[silent], false)?, NotJudged, "a witness that states nothing has not judged");
    Ok(())
}

#[test]
fn json_begins_with_its_schema_and_holds_the_data() -> Outcome {
    let text = json(&report()?)?;
    assert!(text.starts_with("{\n  \"schema_version\": 4,"));
    let data: serde_json::Value = serde_json::from_str(&text)?;
    assert_eq!(data["verdict"], "Wrong");
    assert_eq!(data["scenes"][1]["name"], HOSTILE);
    assert_eq!(data["scenes"][0]["camera"]["du"]["bits"][0], "0x3dcccccd");
    assert_eq!(data["scenes"][0]["camera"]["du"]["decimal"][0].to_string(), "0.1");
    assert_eq!(data["scenes"][0]["subjects"][3]["comparison"]["missing"], 1);
    assert_eq!(data["scenes"][0]["subjects"][4]["comparison"], serde_json::Value::Null);
    assert_eq!(data["environment"]["seed"], u64::MAX);
    assert_eq!(data["claims"][5]["evidence"], "Refuted");
    Ok(())
}

#[test]
fn text_fits_and_is_aligned() -> Outcome {
    let mut report = report()?;
    report.scenes[0].name = "球".repeat(30);
    report.scenes[0].frames = 20_000;
    report.scenes[0].frame = 12_345;
    if let Some(comparison) = &mut report.scenes[0].subjects[0].comparison {
        *comparison = Comparison {
            wrong_ids: u64::MAX,
            wrong_t: 999_999,
            wrong_color: 134_217_728,
            t_ulp: UlpSummary { max: 4_000_000_000, ..UlpSummary::default() },
            ..*comparison
        };
    }
    let table = text(&report, false);
    let lines: Vec<_> = table.lines().collect();
    for line in &lines {
        let width = textwrap::core::display_width(line);
        assert!(width <= TEXT_WIDTH, "{width} columns: {line}");
        assert!(!line.contains(char::is_control), "{line:?}");
    }
    let rows = &lines[1..11];
    let ends: HashSet<_> = rows.iter().map(|line| textwrap::core::display_width(line)).collect();
    assert_eq!(ends.len(), 1, "the last column is ragged:\n{table}");
    for (row, verdict) in rows.iter().zip(VERDICTS.iter().cycle()) {
        assert!(row.contains(word(*verdict)), "{row}");
    }
    assert!(rows[0].contains("#12345") && rows[0].contains("1.3e8"), "{}", rows[0]);
    assert_eq!(lines.last(), Some(&"≠ wrong"));
    Ok(())
}

#[test]
fn color_changes_nothing_but_color() -> Outcome {
    let report = report()?;
    let colored = text(&report, true);
    let plain: String = colored
        .split('\u{1b}')
        .enumerate()
        .map(|(k, part)| if k == 0 { part } else { after_m(part) })
        .collect();
    assert_ne!(colored, plain);
    assert_eq!(plain, text(&report, false));
    Ok(())
}

fn after_m(part: &str) -> &str {
    part.split_once('m').map_or("", |(_, rest)| rest)
}

#[test]
fn folder_holds_page_data_and_pictures() -> Outcome {
    let report = report()?;
    let home = tempfile::tempdir()?;
    let folder = home.path().join("made").join("anew");
    let paths = write(&folder, &report, &pictures(&report)?, &[])?;
    let mut files: Vec<_> = std::fs::read_dir(&folder)?
        .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
        .collect::<std::io::Result<_>>()?;
    files.sort();
    assert_eq!(files.len(), 2 + 2 * (1 + 4));
    assert_eq!(paths.pictures.len(), 10);
    assert!(files.contains(&"bar-truth.png".to_owned()), "{files:?}");
    assert!(files.contains(&"bar-subject-wrong-triptych.png".to_owned()), "{files:?}");
    assert!(files.contains(&"script-alert-x-script-onload-y-31m-truth.png".to_owned()), "{files:?}");
    let data: serde_json::Value = serde_json::from_slice(&std::fs::read(&paths.json)?)?;
    assert_eq!(data["scenes"][0]["picture"], "bar-truth.png");
    assert_eq!(data["scenes"][0]["subjects"][3]["picture"], "bar-subject-wrong-triptych.png");
    assert_eq!(data["scenes"][0]["subjects"][4]["picture"], serde_json::Value::Null);
    assert!(std::fs::read_to_string(&paths.html)?.ends_with("</html>"));
    for picture in &paths.pictures {
        image::load_from_memory(&std::fs::read(picture)?)?;
    }
    Ok(())
}

/// Names that become the same file name do not overwrite each other.
#[test]
fn every_picture_has_a_file_of_its_own() -> Outcome {
    let mut report = report()?;
    report.scenes[0].name = "A b".to_owned();
    report.scenes[1].name = "a/B".to_owned();
    report.scenes.iter_mut().flat_map(|scene| &mut scene.subjects).for_each(|s| s.name = "é".to_owned());
    let folder = tempfile::tempdir()?;
    let paths = write(folder.path(), &report, &pictures(&report)?, &[])?;
    let different: HashSet<_> = paths.pictures.iter().collect();
    assert_eq!(different.len(), 10);
    assert!(different.contains(&folder.path().join("a-b-truth-2.png")), "{different:?}");
    Ok(())
}

#[test]
fn file_names_are_tame() {
    for (name, expected) in [
        ("../../etc/passwd", "etc-passwd"),
        ("  Two  Words ", "two-words"),
        ("..", "unnamed"),
        ("", "unnamed"),
        ("球", "unnamed"),
        ("a\0b\\c:d", "a-b-c-d"),
    ] {
        assert_eq!(sanitized(name), expected, "{name:?}");
    }
    assert!(sanitized(&"long ".repeat(1000)).len() <= 60);
}

#[test]
fn pictures_that_do_not_match_are_refused() -> Outcome {
    let report = report()?;
    let folder = tempfile::tempdir()?;
    let refused = write(folder.path(), &report, &[], &[]);
    assert!(matches!(refused, Err(ReportError::Scenes { scenes: 2, pictures: 0 })));
    let mut sets = pictures(&report)?;
    sets[1].skip();
    let refused = write(folder.path(), &report, &sets, &[]);
    assert!(matches!(refused, Err(ReportError::Subjects { subjects: 5, pictures: 6, .. })));
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 0);
    Ok(())
}

/// Where a file cannot be written, there is no page that would pass for the finished report.
#[test]
fn a_failed_report_has_no_page() -> Outcome {
    let report = report()?;
    let folder = tempfile::tempdir()?;
    std::fs::create_dir_all(folder.path().join("report.json").join("x"))?;
    let failed = write(folder.path(), &report, &pictures(&report)?, &[]);
    assert!(matches!(failed, Err(ReportError::Write(_))));
    assert!(!folder.path().join("report.html").exists());
    let below_a_file = folder.path().join("bar-truth.png").join("deeper");
    assert!(matches!(
        write(&below_a_file, &report, &pictures(&report)?, &[]),
        Err(ReportError::Folder { .. })
    ));
    Ok(())
}

/// Who is heard and whom nobody is judged by is no run.
#[test]
fn witnesses_alone_are_no_run() -> Outcome {
    let scene = scene("a", Vec::new())?;
    assert!(!scene.outside.is_empty());
    assert_eq!(
        overall(&[SceneReport { outside: hearings()[..1].to_vec(), ..scene }], &[], &[]),
        Verdict::NotJudged
    );
    Ok(())
}

/// Each number of a comparison stands below its own heading.
#[test]
fn numbers_stand_in_their_columns() -> Outcome {
    let mut report = report()?;
    if let Some(comparison) = &mut report.scenes[0].subjects[0].comparison {
        *comparison = Comparison {
            wrong_ids: 11,
            wrong_t: 222,
            wrong_color: 33,
            t_ulp: UlpSummary { median: 5, p99: 66, max: 777, ..UlpSummary::default() },
            ..*comparison
        };
    }
    let table = text(&report, false);
    let lines: Vec<&str> = table.lines().collect();
    let ends = |line: &str, word: &str| {
        let at = line.find(word).unwrap_or_else(|| panic!("no {word} in {line:?}")) + word.len();
        textwrap::core::display_width(&line[..at])
    };
    for (heading, number) in [(" ids", " 11"), (" t", " 222"), ("colour", " 33"), ("ulp max", " 777")] {
        assert_eq!(ends(lines[0], heading), ends(lines[1], number), "{heading}:\n{}\n{}", lines[0], lines[1]);
    }
    Ok(())
}
