//! Does the page work in a browser: on a phone's width and on a desk's, in the dark, with its script and nothing else? Judged by a
//! headless Chromium, where there is one (`CGT_CHROMIUM` or `chromium` on the path).

mod browser;

use browser::chromium;
use contract::{Image, MISS, Size};
use optimized::Level;
use std::error::Error;
use std::path::Path;
use verify::chart::{Asked, Chart, Distance, measure};
use verify::methods::charted;
use verify::report::{
    CameraRecord, Environment, Judge, Part, Report, SCHEMA_VERSION, ScenePictures, SceneReport,
    SubjectReport, TRUTH, html,
};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::stability::data::{Count, Curve, Line, Stability};
use verify::verdict::{Comparison, Verdict};

/// How long a page may take, of its own time.
const WAITS: &str = "--virtual-time-budget=8000";

type Made<T> = Result<T, Box<dyn Error>>;

fn environment() -> Environment {
    Environment {
        program: "cgt".into(),
        target: "any".into(),
        cpu: None,
        simd: "best".into(),
        rustc: "rustc".into(),
        threads: 1,
        date: "2026-01-01".into(),
        command_line: "cgt report --with a-long-command-line --that never --ends and-goes-on".into(),
        seed: Some(1),
    }
}

/// A chapter of each kind: scatters, lines, tables, heat maps.
fn parts() -> Made<Vec<Part>> {
    let loaded = Source::parse("uniform:60:1")?.load()?;
    let framing = Framing { size: Some(Size::new(40, 30)?), ..Framing::default() };
    let (level, mut absent) = (Level::best()?, Vec::new());
    let methods = charted(level, 1, &mut absent);
    let scene = &loaded.animation.frames()[0];
    let asked =
        Asked { name: "uniform:60:1", frame: 0, scene, methods: &methods, rounds: 1, every: 4, seed: 1 };
    let view = |times| -> Made<_> {
        let at = Distance::new(&loaded.animation, &framing, times)?;
        Ok(measure(&asked, &at, &|_, _| Box::new(|| ()))?)
    };
    let views = vec![view(1.0)?, view(100.0)?];
    let chart = Chart { schema_version: 1, kind: "chart", environment: environment(), absent, views };
    let counts = |wrong| Count { rays: 1000, hits: 500, wrong, wrong_t: None, t_ulp_p99: None, refused: 0 };
    let line = |name: &str, family, each: u64| Line {
        method: name.into(),
        family,
        exact: false,
        counts: (0..24).map(|k| counts(k * each)).collect(),
        breakdown: verify::stability::breakdown::Breakdown::default(),
    };
    let lines = charted(level, 1, &mut Vec::new());
    let curve = Curve {
        name: "distance".into(),
        title: "Distance".into(),
        axis: "distance by radius".into(),
        what: "Something is turned up.".into(),
        by_truth: true,
        easy: 1.0,
        values: (0..24).map(|k| 2f64.powi(k)).collect(),
        marks: vec![(4096.0, "a mark with quite some words".into())],
        lines: lines.iter().zip(0..).map(|(method, k)| line(&method.name, method.family, k)).collect(),
    };
    let stability = Stability {
        schema_version: 1,
        kind: "stability",
        environment: environment(),
        absent: Vec::new(),
        rays: 1000,
        curves: vec![curve],
        maps: Vec::new(),
    };
    Ok(vec![
        Part {
            anchor: "chart",
            title: "Speed against accuracy".into(),
            body: verify::chart::page::part(&chart)?,
        },
        Part {
            anchor: "stability",
            title: "Where methods break".into(),
            body: verify::stability::page::part(&stability)?,
        },
    ])
}

/// A page with a film of three frames and chapters.
fn page() -> Made<String> {
    let mut truth = Image::new(Size::new(64, 36)?, [9, 9, 20])?;
    truth.ids[100..900].fill(3);
    truth.t[100..900].fill(4.25);
    truth.rgba[100..900].fill([200, 120, 40, 255]);
    let mut wrong = truth.clone();
    wrong.ids[122] = MISS;
    let camera =
        contract::Camera::new([0.0; 3], [-1.0, -1.0, 1.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], truth.size)?;
    let frame = |number| SceneReport {
        name: "film".into(),
        description: "three frames".into(),
        provenance: "made".into(),
        spheres: 4,
        frame: number,
        frames: 3,
        width: 64,
        height: 36,
        camera: CameraRecord::from(&camera),
        warnings: Vec::new(),
        judge: Judge { name: "none".into(), counters: Vec::new() },
        hits: 800,
        picture: None,
        subjects: vec![SubjectReport {
            name: "a-subject-with-a-name-that-is-long".into(),
            description: "wrong in one pixel".into(),
            promise: "none".into(),
            known_fault: false,
            verdict: Verdict::Wrong,
            because: "One pixel.".into(),
            comparison: Some(Comparison { pixels: 2304, wrong_ids: 1, ..Comparison::default() }),
            seconds: None,
            rays_per_second: None,
            picture: None,
            first_wrong: None,
        }],
        outside: Vec::new(),
    };
    let scenes: Vec<SceneReport> = (0..3).map(frame).collect();
    let mut pictures = Vec::new();
    for _ in &scenes {
        let mut set = ScenePictures::new(&truth)?;
        set.add((TRUTH, &truth), &wrong, Some([58, 1]))?;
        pictures.push(set);
    }
    let report = Report {
        schema_version: SCHEMA_VERSION,
        title: "A page".into(),
        verdict: Verdict::Wrong,
        environment: environment(),
        scenes,
        claims: verify::claims::claims(),
        broken: Vec::new(),
        absent: Vec::new(),
    };
    Ok(html(&report, &pictures, &parts()?)?)
}

/// A page about the page: it is opened in a frame of some width, its film is turned, and what came of it becomes the title.
fn about(page: &str, width: u32) -> String {
    let text = serde_json::to_string(page).expect("text").replace("</", "<\\/");
    format!(
        "<!DOCTYPE html><title>nothing</title><iframe id=f style=\"width:{width}px;height:900px;border:0\"></iframe><script>\n\
         const f = document.getElementById('f');\n\
         f.onload = () => setTimeout(() => {{\n\
           const d = f.contentDocument, reel = d.querySelector('[data-reel]'), range = reel.querySelector('input[type=range]');\n\
           const shown = () => [...reel.querySelectorAll('[data-frame]')].filter(x => !x.hidden).map(x => x.dataset.frame).join();\n\
           const before = shown(); range.value = 2; range.dispatchEvent(new Event('input'));\n\
           const wide = [...d.querySelectorAll('main *')].filter(x => x.getBoundingClientRect().right > {width} + 1 &&\n\
             !x.closest('.scroll') && !x.closest('svg') && !x.closest('.columns') && getComputedStyle(x).position !== 'absolute');\n\
           const small = [...d.querySelectorAll('svg.plot text')].map(x => x.getBoundingClientRect().height).filter(h => h > 0);\n\
           document.title = JSON.stringify({{ overflow: d.documentElement.scrollWidth - d.documentElement.clientWidth,\n\
             ready: reel.dataset.reel, before, after: shown(), told: reel.querySelector('output').textContent,\n\
             wide: wide.slice(0, 3).map(x => x.tagName + '.' + x.className), least: Math.min(...small) }});\n\
         }}, 300);\n\
         f.srcdoc = {text};\n</script>"
    )
}

#[test]
fn the_page_works_in_a_browser() -> Made<()> {
    let page = page()?;
    let folder = tempfile::tempdir()?;
    let address = |path: &Path| format!("file://{}", path.display());
    for width in [390, 1280] {
        let file = folder.path().join(format!("about-{width}.html"));
        std::fs::write(&file, about(&page, width))?;
        let Some(said) = chromium(&[WAITS, "--dump-dom", "--window-size=1400,1000", &address(&file)]) else {
            eprintln!("not judged: the page in a browser: there is no chromium");
            return Ok(());
        };
        let said = String::from_utf8_lossy(&said).into_owned();
        let title =
            said.split("<title>").nth(1).and_then(|rest| rest.split("</title>").next()).unwrap_or_default();
        let found: serde_json::Value =
            serde_json::from_str(title).map_err(|error| format!("{width}: {error}: `{title}`"))?;
        assert_eq!(found["overflow"], 0, "{width} pixels wide: the page moves sideways: {found}");
        assert_eq!(found["wide"], serde_json::json!([]), "{width} pixels wide: {found}");
        assert_eq!((&found["ready"], &found["before"]), (&"ready".into(), &"0".into()), "{found}");
        assert_eq!(
            (&found["after"], &found["told"]),
            (&"2".into(), &"2".into()),
            "the slider turns nothing: {found}"
        );
        assert!(
            found["least"].as_f64().is_some_and(|height| height >= 8.0),
            "{width}: words too small: {found}"
        );
    }
    // What is drawn is seen, in the light and in the dark.
    let file = folder.path().join("page.html");
    std::fs::write(&file, &page)?;
    let mut corners = Vec::new();
    for (name, dark) in [
        ("light", "--blink-settings=preferredColorScheme=1"),
        ("dark", "--blink-settings=preferredColorScheme=0"),
    ] {
        let picture = folder.path().join(format!("{name}.png"));
        let shot = format!("--screenshot={}", picture.display());
        chromium(&[WAITS, dark, "--window-size=800,3000", &shot, &address(&file)])
            .ok_or("it was there before")?;
        let pixels = image::open(&picture)?.to_rgb8();
        let colors: std::collections::HashSet<_> = pixels.pixels().map(|pixel| pixel.0).collect();
        assert!(colors.len() > 50, "{name}: hardly anything is drawn");
        corners.push(pixels.get_pixel(2, 2).0.iter().map(|c| u32::from(*c)).sum::<u32>());
    }
    assert!(corners[0] > 600 && corners[1] < 150, "light and dark are {corners:?}");
    eprintln!("judged by Chromium: two widths, light and dark");
    Ok(())
}
