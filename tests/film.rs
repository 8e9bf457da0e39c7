//! Do films, pipes and numbered files hold, frame by frame, what single pictures show? The program writes both; other people's decoders read them back.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;
use verify::picture::film::y4m::{WORST, rgb, yuv};

const CGT: &str = env!("CARGO_BIN_EXE_cgt");
const SIZE: &str = "75x43";
const PIXELS: usize = 75 * 43;

struct Desk(TempDir);

impl Desk {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn cgt(&self, words: &str) -> Output {
        let mut command = Command::new(CGT);
        command.args(words.split(' ')).current_dir(self.0.path()).stdin(Stdio::null());
        command.output().expect("the program starts")
    }

    /// What a run says that must end well.
    fn done(&self, words: &str) -> Output {
        let output = self.cgt(words);
        assert!(output.status.success(), "cgt {words}: {}", String::from_utf8_lossy(&output.stderr));
        output
    }

    fn files(&self) -> BTreeSet<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("a folder");
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect()
    }

    /// The colours of single pictures, red, green and blue of each pixel.
    fn singles(&self, frames: std::ops::Range<usize>, method: &str) -> Vec<Vec<[u8; 3]>> {
        frames
            .map(|frame| {
                let name = format!("single-{frame}.png");
                self.done(&format!("render 2juy {name} --size {SIZE} --frame {frame} --method {method}"));
                let image = image::open(self.path(&name)).expect("a PNG").to_rgb8();
                std::fs::remove_file(self.path(&name)).expect("it is there");
                image.pixels().map(|pixel| pixel.0).collect()
            })
            .collect()
    }
}

fn triples(bytes: &[u8]) -> Vec<[u8; 3]> {
    bytes.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
}

/// All frames of an animated PNG, with the part of a second that each is shown.
fn apng(path: &Path) -> (Vec<Vec<[u8; 3]>>, Vec<[u16; 2]>) {
    let decoder = png::Decoder::new(BufReader::new(File::open(path).expect("a film")));
    let mut reader = decoder.read_info().expect("a PNG");
    let control = reader.info().animation_control().copied().expect("it is animated");
    assert_eq!(control.num_plays, 0, "for ever");
    let (mut frames, mut delays) = (Vec::new(), Vec::new());
    for _ in 0..control.num_frames {
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut bytes).expect("a frame");
        bytes.truncate(info.buffer_size());
        let frame = reader.info().frame_control().expect("of a film");
        delays.push([frame.delay_num, frame.delay_den]);
        frames.push(triples(&bytes));
    }
    (frames, delays)
}

#[test]
fn animated_png_is_bit_for_bit() {
    let desk = Desk::new();
    for (method, name) in [("fast", "film.apng"), ("paper", "film.png")] {
        desk.done(&format!("render 2juy {name} --frames 2..5 --fps 12 --size {SIZE} --method {method}"));
        let (frames, delays) = apng(&desk.path(name));
        assert_eq!(delays, [[1, 12]; 3]);
        assert_eq!(frames, desk.singles(2..5, method), "{method}");
        assert!(frames[0] != frames[1] && frames[1] != frames[2], "frames differ");
        eprintln!("{name}: {} frames by {method}", frames.len());
    }
    // The truth has the same frames as the tracer that promises them.
    desk.done(&format!("render 2juy exact.apng --frames 2..5 --size {SIZE}"));
    assert_eq!(apng(&desk.path("exact.apng")).0, apng(&desk.path("film.apng")).0);
}

#[test]
fn numbered_files_are_the_single_ones() {
    let desk = Desk::new();
    for (pattern, ending, names) in [
        ("a-%03d", "png", ["a-007.png", "a-008.png"]),
        ("b{frame}", "exr", ["b7.exr", "b8.exr"]),
        ("c%d", "png", ["c7.png", "c8.png"]),
    ] {
        desk.done(&format!("render 2juy {pattern}.{ending} --frames 7..9 --size {SIZE} --method safe"));
        for (frame, name) in (7..).zip(names) {
            let single = format!("single.{ending}");
            desk.done(&format!("render 2juy {single} --frame {frame} --size {SIZE} --method safe"));
            let read = |name: &str| std::fs::read(desk.path(name)).expect("a file");
            assert!(read(name) == read(&single), "{name} is not what frame {frame} is alone");
        }
    }
    assert_eq!(desk.files().len(), 8, "{:?}", desk.files());
}

/// Y, U and V by whole numbers, and whether each lies half-way between two: BT.601 in studio range, rounded to nearest.
fn by_integers(color: [u8; 3]) -> [(u8, bool); 3] {
    let [r, g, b] = color.map(i64::from);
    let y1000 = 299 * r + 587 * g + 114 * b;
    let rounded = |n: i64, d: i64, about: i64| {
        let up = (2 * n + d).div_euclid(2 * d) + about;
        (u8::try_from(up).expect("a byte"), (2 * n + d).rem_euclid(2 * d) == 0)
    };
    // U = 224 (B - Y) / 1.772, V = 224 (R - Y) / 1.402, about 128.
    [
        rounded(219 * y1000, 255_000, 16),
        rounded(224 * (1000 * b - y1000), 255 * 1772, 128),
        rounded(224 * (1000 * r - y1000), 255 * 1402, 128),
    ]
}

/// All colours: the shipped formula against whole numbers (but where these lie half-way), and how far one comes back.
#[test]
fn colours_come_back_from_yuv_within_what_is_stated() {
    let (mut worst, mut off) = (0, 0u64);
    for r in 0..=255 {
        for g in 0..=255 {
            for b in 0..=255 {
                let color = [r, g, b];
                let coded = yuv(color);
                for (coded, (whole, half_way)) in coded.into_iter().zip(by_integers(color)) {
                    if coded != whole {
                        assert!(half_way && coded.abs_diff(whole) == 1, "{color:?}: {coded}, not {whole}");
                        off += 1;
                    }
                }
                let back = rgb(coded);
                worst = (0..3).map(|i| back[i].abs_diff(color[i])).fold(worst, u8::max);
            }
        }
    }
    eprintln!("16,777,216 colours, worst {worst}; {off} channels lie half-way and go down");
    assert_eq!(worst, WORST);
    assert_eq!([yuv([0; 3]), yuv([255; 3])], [[16, 128, 128], [235, 128, 128]], "studio range");
}

#[test]
fn a_pipe_and_a_file_hold_the_rounded_frames() {
    let desk = Desk::new();
    let words = format!("--frames 20..24 --fps 25 --size {SIZE} --method fast");
    let piped = desk.done(&format!("render 2juy - {words}"));
    desk.done(&format!("render 2juy film.y4m {words}"));
    assert!(
        piped.stdout == std::fs::read(desk.path("film.y4m")).expect("a film"),
        "the pipe has other bytes"
    );
    let mut decoder = y4m::decode(&piped.stdout[..]).expect("YUV4MPEG2");
    assert_eq!((decoder.get_width(), decoder.get_height()), (75, 43));
    assert!(matches!(decoder.get_colorspace(), y4m::Colorspace::C444));
    assert_eq!((decoder.get_framerate().num, decoder.get_framerate().den), (25, 1));
    let mut worst = 0;
    for single in desk.singles(20..24, "fast") {
        let frame = decoder.read_frame().expect("a frame");
        for (i, color) in single.into_iter().enumerate() {
            let coded = [frame.get_y_plane()[i], frame.get_u_plane()[i], frame.get_v_plane()[i]];
            assert_eq!(coded, yuv(color), "pixel {i}");
            worst = (0..3).map(|k| rgb(coded)[k].abs_diff(color[k])).fold(worst, u8::max);
        }
    }
    assert!(matches!(decoder.read_frame(), Err(y4m::Error::EOF)), "four frames");
    eprintln!("4 frames of {PIXELS} pixels, off by at most {worst}");
    assert!(worst <= WORST);
}

/// A GIF's colours are chosen for a frame: few are kept as they are, many are rounded, by how much is told.
#[test]
fn gif_keeps_few_colours_and_rounds_many() {
    let desk = Desk::new();
    for (size, kept) in [("12x9", true), (SIZE, false)] {
        desk.done(&format!("render 2juy film.gif --frames 0..5 --fps 30 --size {size} --method fast"));
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder =
            options.read_info(File::open(desk.path("film.gif")).expect("a film")).expect("a GIF");
        assert_eq!(decoder.repeat(), gif::Repeat::Infinite, "for ever");
        let (mut delays, mut squares, mut worst, mut count) = (0, 0, 0, 0);
        for frame in 0..5 {
            desk.done(&format!("render 2juy single.png --frame {frame} --size {size} --method fast"));
            let single = image::open(desk.path("single.png")).expect("a PNG").to_rgb8();
            let shown = decoder.read_next_frame().expect("readable").expect("a frame");
            delays += u32::from(shown.delay);
            for (ours, [r, g, b, a]) in single.pixels().zip(shown.buffer.as_chunks().0) {
                assert_eq!(*a, 255);
                for (x, y) in ours.0.into_iter().zip([*r, *g, *b]) {
                    worst = worst.max(x.abs_diff(y));
                    squares += u64::from(x.abs_diff(y)).pow(2);
                    count += 1;
                }
            }
        }
        assert!(decoder.read_next_frame().expect("readable").is_none(), "five frames");
        assert_eq!(delays, 17, "5 frames of a 30th second end nearest to 17 hundredths");
        let mean = (squares as f64 / f64::from(count)).sqrt();
        eprintln!("{size}: off by {worst} at most, {mean:.2} in the square mean, of 255");
        assert!(if kept { worst == 0 } else { worst > 0 && mean < 8.0 }, "{size}: {worst}, {mean}");
    }
}

/// A reader that has seen enough ends it quietly.
#[test]
fn a_closed_pipe_is_no_failure() {
    let words = "render 2juy - --frames 0..24 --size 640x360 --method fast";
    let mut child = Command::new(CGT)
        .args(words.split(' '))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut begin = [0; 64];
    child.stdout.take().expect("a pipe").read_exact(&mut begin).expect("its begin");
    assert!(begin.starts_with(b"YUV4MPEG2 W640 H360 F30:1 C444"), "{}", String::from_utf8_lossy(&begin));
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{:?}", output.status);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
fn what_cannot_be_is_refused_and_leaves_nothing() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("folder.apng")).expect("a folder");
    for (words, says) in [
        ("2juy film.apng --frames 20..30", "2juy has frames 0 to 23, not 29"),
        ("1hvr film.gif --frames 0..2", "1hvr has frames 0 to 0, not 1"),
        ("2juy film.apng --frames 4..4", "4..4 has no frame"),
        ("2juy film.apng --frames 4", "expected A..B"),
        ("2juy film.exr --frames 0..2", "put {frame} or %04d into its name"),
        ("2juy film.mp4 --frames 0..2", "film.mp4"),
        ("2juy %04d.gif --frames 0..2 --size 9999999x1", "too large"),
        ("2juy a%xd.gif.txt --frames 0..2", "a%xd.gif.txt"),
        ("2juy film.apng", "films need --frames"),
        ("2juy -", "films need --frames"),
        ("2juy film.apng --frame 2 --frames 0..2", "cannot be used with"),
        ("2juy film.apng --frames 0..2 --fps 0", "1..=1000"),
        ("2juy film.png --fps 3", "--frames"),
        ("2juy no/such/film.apng --frames 0..2", "no/such"),
        ("2juy folder.apng --frames 0..2 --size 8x8", "folder.apng"),
    ] {
        let output = desk.cgt(&format!("render {words}"));
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words}: {said}");
        assert!(said.contains(says) && !said.contains("panicked"), "{words}: {said}");
        assert_eq!(String::from_utf8_lossy(&output.stdout), "", "{words}");
        assert_eq!(desk.files(), BTreeSet::from(["folder.apng".to_owned()]), "{words}");
    }
}

/// A limit on the size of files stands for a full disk: the film that was there stays, and the file is named.
#[cfg(unix)]
#[test]
fn a_disk_that_fills_up_leaves_the_old_film() {
    let desk = Desk::new();
    for name in ["film.apng", "film.gif", "film.y4m", "f{frame}.exr"] {
        let file = name.replace("{frame}", "0");
        std::fs::write(desk.path(&file), "what was there").expect("written");
        let script = format!(
            "trap '' XFSZ; ulimit -f 8 && exec \"$0\" render 2juy '{name}' --frames 0..4 --size 320x180 --method fast"
        );
        let output = Command::new("sh").args(["-c", &script, CGT]).current_dir(desk.0.path()).output();
        let output = output.expect("a shell");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains("cannot write the") && said.contains(&format!("`{file}`")), "{name}: {said}");
        assert_eq!(std::fs::read(desk.path(&file)).ok().as_deref(), Some(&b"what was there"[..]), "{name}");
        std::fs::remove_file(desk.path(&file)).expect("it is there");
        assert_eq!(desk.files().len(), 0, "{name}: {:?}", desk.files());
    }
}
