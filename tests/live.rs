//! Are frames from WebAssembly those of a program, bit for bit, and does a page's live view show them? The module is built as
//! `verify/live/build` builds it and runs in a headless Chromium (`CGT_CHROMIUM` or `chromium` on the path); where there is none, or no
//! library of Rust for WebAssembly, only what a program can say of the same code is judged.

mod browser;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use browser::chromium;
use contract::{Camera, CameraError, Image, Scene, SceneError, Size, Sphere};
use live::wire::{self, WireError};
use live::{Refusal, View, hash};
use optimized::seen::Counts;
use optimized::{Level, Plan, Rendering, Tracer};
use rand::RngExt;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use verify::case::Case;
use verify::matrix::{self, Matrix};
use verify::scenes::catalogue::Source;
use verify::scenes::frame::Framing;
use verify::seed::{count, generator, seed};

type Made<T> = Result<T, Box<dyn Error>>;

/// A scene and a camera, with a name.
struct Picture {
    name: String,
    scene: Scene,
    camera: Camera,
}

fn picture(word: &str, framing: &Framing) -> Made<Picture> {
    let loaded = Source::parse(word)?.load()?;
    let camera = framing.camera(&loaded.animation)?;
    let size = camera.size();
    let name = format!("{word} from {:?}, {}x{}", camera.eye(), size.width(), size.height());
    Ok(Picture { name, scene: loaded.animation.frames()[0].clone(), camera })
}

/// Pictures of the matrix, drawn afresh, all cases that were ever kept, and those in which something certain is at stake.
fn pictures(seed: u64) -> Made<Vec<Picture>> {
    let sized = |width, height| -> Made<_> {
        Ok(Framing { size: Some(Size::new(width, height)?), ..Framing::default() })
    };
    let mut pictures = vec![picture("1hvr", &sized(320, 180)?)?, picture("1hvr", &sized(161, 93)?)?];
    // 40,000 radii away.
    let atom = pictures[0].scene.spheres()[0];
    let target = atom.center.map(f64::from);
    let away = 40_000.0 * f64::from(atom.radius);
    let eye = [target[0] + 0.48 * away, target[1] + 0.6 * away, target[2] + 0.64 * away];
    let far = Framing { eye: Some(eye), target: Some(target), fov: Some(0.03), ..sized(161, 93)? };
    pictures.push(picture("1hvr", &far)?);
    let mut rng = generator(seed, 1);
    for kind in ["uniform", "clump"] {
        let word = format!("{kind}:{}:{}", rng.random_range(1..3000), rng.random_range(0..1_000_000));
        pictures.push(picture(&word, &sized(rng.random_range(1..200), rng.random_range(1..120))?)?);
    }
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/cases");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(cases)?.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    files.sort();
    for file in files {
        let Case { frames, camera, .. } = Case::from_json(&std::fs::read(&file)?)?;
        for scene in frames.frames() {
            pictures.push(Picture { name: file.display().to_string(), scene: scene.clone(), camera });
        }
    }
    let mut cases = Matrix::new()?.cases;
    for _ in 0..count("CGT_LIVE_PICTURES", 60).min(cases.len() as u64) {
        let matrix::Case { name, scene, camera } = cases.swap_remove(rng.random_range(0..cases.len()));
        // What is refused is told by another test.
        if scene.spheres().len() <= live::MAX_SPHERES {
            pictures.push(Picture { name, scene, camera });
        }
    }
    Ok(pictures)
}

fn counts(c: &Counts) -> [u64; 8] {
    [
        c.cells,
        c.candidates,
        c.culled,
        c.split_blocks,
        c.lanes,
        c.asked_f64,
        c.asked_integers,
        c.rounded_by_integers,
    ]
}

// ---- what a program can say ----

#[test]
fn bytes_carry_every_scene_and_camera() -> Made<()> {
    let pictures = pictures(seed())?;
    for Picture { name, scene, camera } in &pictures {
        let (bytes, view) = (wire::scene_bytes(scene), wire::camera_bytes(camera));
        assert_eq!(bytes.len(), wire::HEAD + wire::EACH * scene.spheres().len(), "{name}");
        assert_eq!((&wire::scene(&bytes)?, wire::camera(&view)?), (scene, *camera), "{name}");
        // Zeros have signs, which no comparison of numbers sees.
        assert_eq!(
            (wire::scene_bytes(&wire::scene(&bytes)?), wire::camera_bytes(&wire::camera(&view)?)),
            (bytes, view)
        );
    }
    // As the page reads and writes them.
    let sphere = Sphere { center: [1.0, -2.0, 0.5], radius: 0.25, color: [1, 2, 3] };
    let bytes = wire::scene_bytes(&Scene::new(vec![sphere], [7, 8, 9], [0.0, 1.0, 2.0])?);
    let words: Vec<u32> = bytes.chunks(4).map(|b| u32::from_le_bytes(b.try_into().expect("four"))).collect();
    let light = [0x0000_0000, 0x3f80_0000, 0x4000_0000, 0x0009_0807];
    assert_eq!(
        words,
        [&light[..], &[0x3f80_0000, 0xc000_0000, 0x3f00_0000, 0x3e80_0000, 0x0003_0201]].concat()
    );
    Ok(())
}

/// A scene of one sphere and a camera that sees it.
fn small() -> Made<(Vec<u8>, Vec<u8>)> {
    let Picture { scene, camera, .. } =
        picture("uniform:1:7", &Framing { size: Some(Size::new(9, 5)?), ..Framing::default() })?;
    Ok((wire::scene_bytes(&scene), wire::camera_bytes(&camera)))
}

fn give(view: &mut View, bytes: &[u8]) -> Result<(), Refusal> {
    view.inbox(bytes.len())?.copy_from_slice(bytes);
    Ok(())
}

/// What is done to a view with which bytes or number, and what it must say; nothing if it must obey.
type Step = (&'static str, Vec<u8>, usize, String);

/// The same is said in a browser.
fn refusals() -> Made<Vec<Step>> {
    let (scene, camera) = small()?;
    let with = |bytes: &[u8], at: usize, value: u32| {
        let mut bytes = bytes.to_vec();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let nan = f32::NAN.to_bits();
    let sphere = match wire::scene(&with(&scene, wire::HEAD + 4, nan)) {
        Err(WireError::Scene(error @ SceneError::Center { sphere: 0, .. })) => error.to_string(),
        other => return Err(format!("{other:?}").into()),
    };
    let eye = match wire::camera(&with(&camera, 8, f32::INFINITY.to_bits())) {
        Err(WireError::Camera(error @ CameraError::NotFinite { field: "eye", .. })) => error.to_string(),
        other => return Err(format!("{other:?}").into()),
    };
    let too_many = wire::HEAD + wire::EACH * (live::MAX_SPHERES + 1);
    let said = |text: &str| text.to_owned();
    Ok(vec![
        ("render", Vec::new(), 0, said("there is no scene yet")),
        ("scene", vec![0; 15], 0, said("15 bytes are no scene: that has 16, and 20 for each sphere")),
        ("scene", vec![0; 37], 0, said("37 bytes are no scene: that has 16, and 20 for each sphere")),
        ("scene", with(&scene, wire::HEAD + 4, nan), 0, sphere),
        (
            "scene",
            with(&scene, wire::HEAD + 12, 0),
            0,
            said("sphere 0: radius is 0.0; it must be finite and above 0"),
        ),
        (
            "inbox",
            Vec::new(),
            too_many,
            format!("no place for {too_many} bytes; a scene here has 83886096 at most"),
        ),
        (
            "inbox",
            Vec::new(),
            0xffff_ffff,
            said("no place for 4294967295 bytes; a scene here has 83886096 at most"),
        ),
        ("scene", scene.clone(), 0, String::new()),
        ("render", Vec::new(), 0, said("there is no camera yet")),
        ("camera", vec![0; 55], 0, said("55 bytes are no camera: that has 56")),
        ("camera", with(&camera, 8, f32::INFINITY.to_bits()), 0, eye),
        ("camera", with(&camera, 48, 0), 0, said("an image of 0x5 pixels has no pixel")),
        (
            "camera",
            with(&with(&camera, 48, 16_384), 52, 4096),
            0,
            said("a picture of 67108864 pixels; the limit here is 33554432"),
        ),
        ("render", Vec::new(), 1, said("there is no camera yet")),
        ("camera", camera, 0, String::new()),
        ("render", Vec::new(), 1, String::new()),
        ("scene", vec![1], 0, said("1 bytes are no scene: that has 16, and 20 for each sphere")),
        ("render", Vec::new(), 1, said("there is no scene yet")),
        ("scene", scene, 0, String::new()),
        ("render", Vec::new(), 0, String::new()),
    ])
}

#[test]
fn what_is_wrong_is_refused_in_a_sentence_and_forgotten() -> Made<()> {
    let mut view = View::new();
    for (i, (what, bytes, number, expected)) in refusals()?.into_iter().enumerate() {
        let said = match what {
            "scene" => give(&mut view, &bytes).and_then(|()| view.set_scene()),
            "camera" => give(&mut view, &bytes).and_then(|()| view.set_camera()),
            "inbox" => view.inbox(number).map(drop),
            _ => view.render(number).map(drop),
        };
        assert_eq!(
            said.map_or_else(|error| error.to_string(), |()| String::new()),
            expected,
            "step {i}, {what}"
        );
        // A frame is one of what is there now.
        assert_eq!(view.frame().is_some(), what == "render" && expected.is_empty(), "step {i}, {what}");
    }
    let levels = Level::available().len();
    assert_eq!(view.render(levels).err(), Some(Refusal::Level { level: levels, levels }));
    Ok(())
}

#[test]
fn a_view_traces_what_a_program_does() -> Made<()> {
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    let (mut view, levels) = (View::new(), Level::available());
    for (i, Picture { name, scene, camera }) in pictures(seed)?.iter().enumerate().take(20) {
        let expected = Tracer::new(Plan::fast(), levels[0]).render(scene, camera)?;
        give(&mut view, &wire::scene_bytes(scene))?;
        view.set_scene()?;
        give(&mut view, &wire::camera_bytes(camera))?;
        view.set_camera()?;
        let given = view.render(i % levels.len())?;
        assert_eq!(first_wrong(&expected.image, &layers(&given.image)), None, "{name}");
        assert_eq!(view.hash(), Some(own_hash(&expected.image)), "{name}");
    }
    Ok(())
}

/// The picture's hash as the documentation has it.
fn own_hash(image: &Image) -> [u8; 32] {
    let size = [image.size.width(), image.size.height()].map(u32::to_le_bytes).concat();
    Sha256::digest([size, layers(image)].concat()).into()
}

#[test]
fn the_hash_is_of_every_id_t_and_colour() -> Made<()> {
    let Picture { scene, camera, .. } =
        picture("1hvr", &Framing { size: Some(Size::new(40, 23)?), ..Framing::default() })?;
    let image = Tracer::new(Plan::fast(), Level::best()?).render(&scene, &camera)?.image;
    let mut hashes = vec![hash(&image)];
    for pixel in [0, image.ids.len() / 2, image.ids.len() - 1] {
        let (mut id, mut t, mut red, mut blue) = (image.clone(), image.clone(), image.clone(), image.clone());
        id.ids[pixel] ^= 1;
        t.t[pixel] = f32::from_bits(t.t[pixel].to_bits() ^ 1);
        red.rgba[pixel][0] ^= 1;
        blue.rgba[pixel][2] ^= 1;
        hashes.extend([id, t, red, blue].iter().map(hash));
    }
    hashes.push(hash(&Image { size: Size::new(23, 40)?, ..image }));
    let all = hashes.len();
    hashes.sort_unstable();
    hashes.dedup();
    assert_eq!(hashes.len(), all, "two different pictures have one hash");
    Ok(())
}

// ---- in a browser ----

/// The module, or why there is none.
fn module() -> &'static Result<Vec<u8>, String> {
    static MODULE: OnceLock<Result<Vec<u8>, String>> = OnceLock::new();
    MODULE.get_or_init(|| {
        let build = Path::new(env!("CARGO_MANIFEST_DIR")).join("live/build");
        let output = Command::new(build).arg("--offline").output().map_err(|error| error.to_string())?;
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        match output.status.code() {
            Some(0) => {
                let path = String::from_utf8_lossy(&output.stdout).trim().to_owned();
                std::fs::read(&path).map_err(|error| format!("{path}: {error}"))
            }
            Some(3) => Err(told.trim().to_owned()),
            _ => panic!("the module does not compile: {told}"),
        }
    })
}

/// The module, if it and a browser are there; else it is said what is missing.
fn judged_in_a_browser() -> Option<&'static Vec<u8>> {
    match module() {
        Err(why) => {
            let why = why.strip_prefix("not judged: ").unwrap_or(why);
            eprintln!("not judged: {why}");
            None
        }
        Ok(module) if chromium(&["--version"]).is_some() => Some(module),
        Ok(_) => {
            eprintln!("not judged: WebAssembly in a browser: there is no chromium");
            None
        }
    }
}

/// Opens a page that leaves its word in its title.
fn title(page: &str, words: &[&str]) -> Made<Value> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("page.html");
    std::fs::write(&file, page)?;
    let address = format!("file://{}", file.display());
    let said = chromium(&[words, &["--dump-dom", "--window-size=1400,1000", &address]].concat())
        .ok_or("it was there before")?;
    let said = String::from_utf8(said)?;
    let title =
        said.split("<title>").nth(1).and_then(|rest| rest.split("</title>").next()).unwrap_or_default();
    let start: String = title.chars().take(300).collect();
    serde_json::from_str(&title.replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))
        .map_err(|error| format!("{error}: `{start}`").into())
}

/// JSON that may stand in a script.
fn script(value: &Value) -> String {
    value.to_string().replace("</", "<\\/")
}

/// A page that does to the module what `steps` say and has for each what came of it: `no` with the reason, `stopped` if the
/// module did, and for a frame all its data. All of it is done before the page is loaded.
fn harness(module: &[u8], steps: &Value, timed: &Value) -> String {
    let module = BASE64_STANDARD.encode(module);
    format!(
        "<!DOCTYPE html><title>nothing</title><script>\n\
         const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));\n\
         const text = bytes => {{ let s = ''; for (let i = 0; i < bytes.length; i += 32768) s += String.fromCharCode(...bytes.subarray(i, i + 32768)); return btoa(s); }};\n\
         const api = new WebAssembly.Instance(new WebAssembly.Module(bytes('{module}'))).exports;\n\
         const memory = (at, length) => new Uint8Array(api.memory.buffer, at, length);\n\
         const message = () => new TextDecoder().decode(memory(api.message(), api.message_bytes()));\n\
         const put = (what, take) => {{ const at = api.inbox(what.length); if (!at) return 0; memory(at, what.length).set(what); return take(); }};\n\
         const step = ({{ what, bytes: data, number }}) => {{\n\
           const does = {{ scene: () => put(bytes(data), api.set_scene), camera: () => put(bytes(data), api.set_camera),\n\
             inbox: () => api.inbox(number), render: () => api.render(number) }};\n\
           if (!does[what]()) return {{ no: message() }};\n\
           if (what !== 'render') return {{}};\n\
           const n = 4 * api.pixels();\n\
           return {{ ids: text(memory(api.ids(), n)), t: text(memory(api.t(), n)), rgba: text(memory(api.rgba(), n)),\n\
             counts: text(memory(api.counts(), 64)), hash: text(memory(api.hash(), 32)) }};\n\
         }};\n\
         const levels = []; for (let i = 0; i < api.levels(); i++) {{ api.name_level(i); levels.push(message()); }}\n\
         const results = {steps}.map(one => {{ try {{ return step(one); }} catch (error) {{ return {{ stopped: String(error) }}; }} }});\n\
         {timed}.forEach(step);\n\
         const times = levels.map((_, level) => {{\n\
           const all = []; for (let i = 0; i < 9; i++) {{ const t = performance.now(); api.render(level); all.push(performance.now() - t); }}\n\
           return all.sort((a, b) => a - b)[all.length >> 1] * 1e6 / api.pixels();\n\
         }});\n\
         document.title = JSON.stringify({{ levels, results, times }});\n</script>",
        steps = script(steps),
        timed = script(timed),
    )
}

fn step(what: &str, bytes: &[u8], number: usize) -> Value {
    json!({ "what": what, "bytes": BASE64_STANDARD.encode(bytes), "number": number })
}

fn decoded(value: &Value) -> Made<Vec<u8>> {
    Ok(BASE64_STANDARD.decode(value.as_str().ok_or_else(|| format!("no frame: {value}"))?)?)
}

/// All layers of a picture, as the module has them: ids, then t, then colours.
fn layers(image: &Image) -> Vec<u8> {
    let ids = image.ids.iter().flat_map(|id| id.to_le_bytes());
    let t = image.t.iter().flat_map(|t| t.to_bits().to_le_bytes());
    ids.chain(t).chain(image.rgba.iter().flatten().copied()).collect()
}

/// The first pixel of which layers differ from a picture's, with both values.
fn first_wrong(image: &Image, given: &[u8]) -> Option<String> {
    let (expected, pixels) = (layers(image), image.ids.len());
    if given.len() != expected.len() {
        return Some(format!("{} bytes in place of {}", given.len(), expected.len()));
    }
    let word = |bytes: &[u8], layer: usize, pixel: usize| {
        let at = 4 * (layer * pixels + pixel);
        u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
    };
    let all = |bytes: &[u8], pixel| [0, 1, 2].map(|layer| word(bytes, layer, pixel));
    let wrong = (0..pixels).find(|pixel| all(given, *pixel) != all(&expected, *pixel))?;
    let width = image.size.width() as usize;
    let told = |[id, t, rgba]: [u32; 3]| {
        format!("id {id}, t {:?} (0x{t:08x}), colour 0x{rgba:08x}", f32::from_bits(t))
    };
    let [native, here] = [&expected[..], given].map(|bytes| told(all(bytes, wrong)));
    Some(format!("pixel ({}, {}): natively {native}; here {here}", wrong % width, wrong / width))
}

/// Every pixel of every picture at both levels, with what tracing cost and the hash; `CGT_LIVE_PICTURES` of the matrix, 60 every day.
#[test]
fn frames_from_webassembly_are_the_native_ones() -> Made<()> {
    let Some(module) = judged_in_a_browser() else { return Ok(()) };
    let seed = seed();
    eprintln!("CGT_SEED={seed}");
    let pictures = pictures(seed)?;
    let (scene, camera) = small()?;
    let mut steps: Vec<Value> =
        refusals()?.iter().map(|(what, bytes, number, _)| step(what, bytes, *number)).collect();
    steps.extend([step("render", &[], 2), step("scene", &scene, 0), step("camera", &camera, 0)]);
    let before = steps.len();
    for Picture { scene, camera, .. } in &pictures {
        steps.extend([
            step("scene", &wire::scene_bytes(scene), 0),
            step("camera", &wire::camera_bytes(camera), 0),
        ]);
        steps.extend([step("render", &[], 0), step("render", &[], 1)]);
    }
    let timed = picture("1hvr", &Framing::default())?;
    let timed = [
        step("scene", &wire::scene_bytes(&timed.scene), 0),
        step("camera", &wire::camera_bytes(&timed.camera), 0),
    ];
    let said = title(&harness(module, &steps.into(), &json!(timed)), &[])?;
    assert_eq!(said["levels"], json!(["scalar", "simd128"]));
    let results = said["results"].as_array().ok_or("no results")?;
    assert_eq!(results.len(), before + 4 * pictures.len());

    // What is refused natively is refused here in the same words, and ends nothing.
    for (i, (what, _, _, expected)) in refusals()?.iter().enumerate() {
        let no = results[i].get("no").and_then(Value::as_str).unwrap_or_default();
        assert!(results[i].get("stopped").is_none(), "step {i}, {what}: {}", results[i]);
        assert_eq!(no, expected, "step {i}, {what}");
    }
    assert_eq!(results[before - 3], json!({ "no": "no level 2; there are 2, from 0" }));

    let (mut pixels, mut at_stake) = (0, Counts::default());
    for (Picture { name, scene, camera }, results) in pictures.iter().zip(results[before..].chunks(4)) {
        let native = Tracer::new(Plan::fast(), Level::best()?).render(scene, camera)?;
        for (result, level) in results[2..].iter().zip(["scalar", "simd128"]) {
            assert_same(&native, result)
                .map_err(|wrong| format!("{name}, {level}, CGT_SEED={seed}: {wrong}"))?;
            pixels += native.image.ids.len();
        }
        at_stake = at_stake + native.counts;
    }
    let Counts { lanes, asked_f64, asked_integers, rounded_by_integers, .. } = at_stake;
    assert!(
        asked_f64 > 0 && asked_integers > 0 && rounded_by_integers > 0,
        "a stage was not reached: {at_stake:?}"
    );
    let time = |level: usize| said["times"][level].as_f64().expect("a time");
    eprintln!(
        "judged by Chromium: {pixels} pixels of {} pictures from WebAssembly at two levels",
        pictures.len()
    );
    eprintln!(
        "of {lanes} rays {asked_f64} asked f64, {asked_integers} integers, and {rounded_by_integers} were rounded by these"
    );
    eprintln!(
        "1hvr at 1280x720, ns a ray, median of 9 frames: scalar {:.2}, simd128 {:.2}",
        time(0),
        time(1)
    );
    Ok(())
}

fn assert_same(native: &Rendering, result: &Value) -> Made<()> {
    if result.get("ids").is_none() {
        return Err(format!("no frame: {result}").into());
    }
    let given = [decoded(&result["ids"])?, decoded(&result["t"])?, decoded(&result["rgba"])?].concat();
    if let Some(wrong) = first_wrong(&native.image, &given) {
        return Err(wrong.into());
    }
    let cost: Vec<u64> = decoded(&result["counts"])?
        .chunks(8)
        .map(|b| u64::from_le_bytes(b.try_into().expect("eight")))
        .collect();
    if cost != counts(&native.counts) {
        return Err(format!("it cost {cost:?}, natively {:?}", counts(&native.counts)).into());
    }
    if decoded(&result["hash"])? != own_hash(&native.image) {
        return Err("another hash".into());
    }
    Ok(())
}

/// A page about pages with a live view: each is opened in a frame of some width, waited for, moved by key, wheel, pointer and button,
/// and what came of it becomes the title. The page counts as loaded when a document in it that was left open is closed, so that all of this
/// has its time, and that is the true one.
fn about(pages: &[(&str, u32)]) -> String {
    let pages =
        json!(pages.iter().map(|(page, width)| json!({ "page": page, "width": width })).collect::<Vec<_>>());
    format!(
        "<!DOCTYPE html><title>nothing</title><body><script>\n\
         const open = document.createElement('iframe');\n\
         open.hidden = true; document.body.append(open); open.contentDocument.open();\n\
         const wait = ms => new Promise(done => setTimeout(done, ms));\n\
         const look = async ({{ page, width }}) => {{\n\
           const f = document.createElement('iframe');\n\
           f.style = `width:${{width}}px;height:900px;border:0`;\n\
           document.body.append(f);\n\
           await new Promise(done => {{ f.onload = done; f.srcdoc = page; }});\n\
           const d = f.contentDocument, w = f.contentWindow, live = d.querySelector('[data-live]'), part = name => live.querySelector(`[data-part=${{name}}]`);\n\
           for (let i = 0; i < 2000 && live.dataset.live === ''; i++) await wait(10);\n\
           const drawn = () => new Promise(done => w.requestAnimationFrame(() => w.requestAnimationFrame(() => w.requestAnimationFrame(done))));\n\
           const canvas = part('canvas'), seen = x => x !== null && x.getBoundingClientRect().height > 0;\n\
           const pixels = () => {{ const a = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data; let s = ''; for (const x of a) s += String.fromCharCode(x); return btoa(s); }};\n\
           const found = {{ state: live.dataset.live, told: part('told').textContent, canvas: seen(canvas), still: seen(live.querySelector('.large img')),\n\
             controls: seen(part('controls')), equal: seen(part('equal')), differs: seen(part('differs')), hint: seen(live.querySelector('.hint')),\n\
             overflow: d.documentElement.scrollWidth - d.documentElement.clientWidth, levels: [...part('level').options].map(x => x.textContent).join() }};\n\
           if (found.canvas) {{\n\
             const first = found.pixels = pixels(), moved = async act => {{ act(); await drawn(); return pixels() !== first; }};\n\
             const key = (key, more) => () => canvas.dispatchEvent(new w.KeyboardEvent('keydown', {{ key, bubbles: true, cancelable: true, ...more }}));\n\
             const back = async () => {{ key('0')(); await drawn(); return pixels() === first; }};\n\
             const point = (type, x, y, id) => canvas.dispatchEvent(new w.PointerEvent(type, {{ pointerId: id ?? 1, clientX: x, clientY: y, bubbles: true }}));\n\
             found.moves = {{}};\n\
             for (const name of ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', '+', '-']) found.moves[name] = await moved(key(name)) && await back();\n\
             found.moves.pointer = await moved(() => {{ point('pointerdown', 50, 50); point('pointermove', 90, 60); point('pointerup', 90, 60); }}) && await back();\n\
             found.moves.pinch = await moved(() => {{ point('pointerdown', 50, 50, 1); point('pointerdown', 90, 50, 2); point('pointermove', 130, 50, 2); point('pointerup', 130, 50, 2); point('pointerup', 50, 50, 1); }}) && await back();\n\
             const wheel = () => canvas.dispatchEvent(new w.WheelEvent('wheel', {{ deltaY: 200, cancelable: true }}));\n\
             found.unchosen = await moved(wheel);\n\
             canvas.focus(); found.focus = d.activeElement === canvas;\n\
             found.moves.wheel = await moved(wheel) && await back();\n\
             found.moves.turn = await moved(() => part('turn').click()) && part('turn').textContent === 'Stop';\n\
             part('back').click(); await drawn();\n\
             found.moves.returns = pixels() === first && part('turn').textContent === 'Turn';\n\
             found.other = await moved(key('a')) || await moved(key('ArrowLeft', {{ ctrlKey: true }}));\n\
             part('level').value = 0; part('level').dispatchEvent(new w.Event('change')); await drawn();\n\
             found.scalar = pixels() === first; found.speed = part('speed').textContent;\n\
           }}\n\
           f.remove();\n\
           return found;\n\
         }};\n\
         (async () => {{ const all = []; for (const page of {pages}) all.push(await look(page)); return JSON.stringify(all); }})()\n\
           .catch(String).then(said => {{ document.title = said; open.contentDocument.close(); }});\n\
         </script>",
        pages = script(&pages),
    )
}

/// Runs `cgt`, which must succeed, and gives its page.
fn page(folder: &Path, words: &[&str]) -> Made<String> {
    let out = folder.join("report");
    let output = Command::new(env!("CARGO_BIN_EXE_cgt")).args(words).arg("--out").arg(&out).output()?;
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    Ok(std::fs::read_to_string(out.join("report.html"))?)
}

const JUDGED: [&str; 6] = ["verify", "1hvr", "--plan", "fast", "--size", "160x90"];

#[test]
fn a_page_carries_what_it_was_given_and_lets_nothing_else_run() -> Made<()> {
    let folder = tempfile::tempdir()?;
    // What begins as a module does; no browser runs it here.
    let stub = [b"\0asm\x01\0\0\0".as_slice(), &[0, 1, 2, 3]].concat();
    let file = folder.path().join("stub.wasm");
    std::fs::write(&file, &stub)?;
    let plain = page(folder.path(), &JUDGED)?;
    for word in ["wasm-unsafe-eval", "data-live", "<script", "<canvas", "<template", ".live"] {
        assert!(!plain.contains(word), "a page without a live view has {word}");
    }
    let live = page(folder.path(), &[&JUDGED[..], &["--live", file.to_str().ok_or("UTF-8")?]].concat())?;
    let part = |name: &str| -> Made<Vec<u8>> {
        let text = live
            .split(&format!("<template data-part=\"{name}\">"))
            .nth(1)
            .and_then(|rest| rest.split('<').next());
        Ok(BASE64_STANDARD.decode(text.ok_or_else(|| format!("no {name}"))?)?)
    };
    let unpacked = |bytes: Vec<u8>| -> Made<Vec<u8>> {
        let mut out = Vec::new();
        std::io::Read::read_to_end(&mut flate2::read::GzDecoder::new(&bytes[..]), &mut out)?;
        Ok(out)
    };
    let Picture { scene, camera, .. } =
        picture("1hvr", &Framing { size: Some(Size::new(160, 90)?), ..Framing::default() })?;
    assert_eq!(unpacked(part("module")?)?, stub);
    assert_eq!(wire::scene(&unpacked(part("scene")?)?)?, scene);
    assert_eq!(wire::camera(&part("camera")?)?, camera);
    let image = Tracer::new(Plan::fast(), Level::SCALAR).render(&scene, &camera)?.image;
    let digits: String = own_hash(&image).iter().map(|byte| format!("{byte:02x}")).collect();
    assert!(live.contains(&format!("data-hash=\"{digits}\"")), "the page waits for another hash");
    let code =
        live.split("<script>").nth(1).and_then(|rest| rest.split("</script>").next()).ok_or("no script")?;
    let allowed = format!(
        "; script-src 'sha256-{}' 'wasm-unsafe-eval'\">",
        BASE64_STANDARD.encode(Sha256::digest(code))
    );
    assert_eq!(
        (live.matches("<script").count(), live.matches(&allowed).count()),
        (1, 1),
        "the policy is another"
    );
    Ok(())
}

#[test]
fn what_is_no_module_is_refused_before_anything_is_rendered() -> Made<()> {
    let folder = tempfile::tempdir()?;
    let text = folder.path().join("text.wasm");
    std::fs::write(&text, "no module")?;
    let large = folder.path().join("large.wasm");
    std::fs::write(&large, [b"\0asm\x01\0\0\0".as_slice(), &vec![0; 8 << 20]].concat())?;
    let absent = folder.path().join("absent.wasm");
    let out = folder.path().join("report");
    for (command, file, expected) in [
        ("verify", &text, "is no WebAssembly module"),
        ("report", &text, "is no WebAssembly module"),
        ("verify", &large, "has more than 8388608 bytes"),
        ("verify", &absent, "No such file"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_cgt"))
            .args([command, "1hvr", "--live"])
            .arg(file)
            .arg("--out")
            .arg(&out)
            .output()?;
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{command}: {told}");
        assert!(told.contains(expected) && told.contains(file.to_str().ok_or("UTF-8")?), "{command}: {told}");
        assert!(!out.exists(), "{command} left something");
    }
    Ok(())
}

#[test]
fn the_live_view_works_in_a_browser() -> Made<()> {
    let Some(module) = judged_in_a_browser() else { return Ok(()) };
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("live.wasm");
    std::fs::write(&file, module)?;
    let live = page(folder.path(), &[&JUDGED[..], &["--live", file.to_str().ok_or("UTF-8")?]].concat())?;
    assert!(live.len() < 1_000_000, "the page has {} bytes", live.len());
    let other = live.replacen("data-hash=\"", "data-hash=\"0", 1);
    let broken =
        live.replacen("<template data-part=\"module\">H4sI", "<template data-part=\"module\">AAAA", 1);
    assert_ne!(broken, live);
    let mut found = title(&about(&[(&live, 1280), (&live, 390), (&other, 390), (&broken, 390)]), &[])?;
    let Picture { scene, camera, .. } =
        picture("1hvr", &Framing { size: Some(Size::new(160, 90)?), ..Framing::default() })?;
    let image = Tracer::new(Plan::fast(), Level::best()?).render(&scene, &camera)?.image;
    for (i, state) in ["equal", "equal", "differs", "failed"].into_iter().enumerate() {
        // Taken out, since it is too long to be told.
        let (pixels, found) = (found[i]["pixels"].take(), &found[i]);
        assert_eq!(found["state"], state, "{i}: {found}");
        assert_eq!(found["overflow"], 0, "{i}: the page moves sideways: {found}");
        let shown = state != "failed";
        for name in ["canvas", "controls", "hint"] {
            assert_eq!(found[name], shown, "{i}: {name}: {found}");
        }
        assert_eq!(found["still"], !shown, "{i}: {found}");
        assert_eq!(
            (&found["equal"], &found["differs"]),
            (&json!(state == "equal"), &json!(state == "differs")),
            "{i}: {found}"
        );
        if !shown {
            assert!(found["told"].as_str().is_some_and(|told| told.contains("has failed")), "{found}");
            continue;
        }
        assert_eq!(decoded(&pixels)?, image.rgba.concat(), "{i}: other colours are shown");
        let moves = found["moves"].as_object().ok_or("no moves")?;
        assert!(moves.len() == 11 && moves.values().all(|moved| moved == true), "{i}: {moves:?}");
        assert_eq!(
            (&found["unchosen"], &found["other"], &found["focus"]),
            (&json!(false), &json!(false), &json!(true)),
            "{i}"
        );
        assert_eq!((&found["levels"], &found["scalar"]), (&json!("scalar,simd128"), &json!(true)), "{i}");
        assert!(found["speed"].as_str().is_some_and(|speed| speed.contains("ms a frame")), "{found}");
    }
    let mut without = title(&about(&[(&live, 390)]), &["--js-flags=--jitless"])?;
    without[0]["pixels"].take();
    assert_eq!((&without[0]["state"], &without[0]["still"]), (&json!("absent"), &json!(true)), "{without}");
    assert!(without[0]["told"].as_str().is_some_and(|told| told.contains("no WebAssembly")), "{without}");
    eprintln!(
        "judged by Chromium: the live view at two widths, moved in eleven ways, with another hash, a broken module, and no WebAssembly"
    );
    Ok(())
}
