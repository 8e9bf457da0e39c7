//! Do pictures say what the images hold, and do files appear whole or not at all?

use contract::{Image, MISS, Size};
use std::error::Error;
use std::io::Cursor;
use verify::judge::compare::{Fault, compare};
use verify::picture::{
    GAP, MARK, PALETTE, PictureError, RgbaImage, WriteError, bold_difference, canvas, difference, exr,
    fault_color, png, ring_radius, square_side, triptych, write_atomically, zoom,
};

type Outcome = Result<(), Box<dyn Error>>;

/// Where they differ first, as the judge says it.
fn first(truth: &Image, subject: &Image) -> Option<[u32; 2]> {
    compare(truth, subject).ok()?.first_wrong
}

/// A picture whose every pixel differs from its neighbours: hits, misses, and t at the ends of f32.
fn varied(width: u32, height: u32) -> Result<Image, Box<dyn Error>> {
    let mut image = Image::new(Size::new(width, height)?, [3, 5, 9])?;
    for index in 0..image.size.pixels() {
        let n = u32::try_from(index)?;
        let [a, b, c, _] = n.wrapping_mul(2_654_435_761).to_le_bytes();
        if n % 3 != 0 {
            image.ids[index] = n.wrapping_mul(40_503);
            image.t[index] = f32::from_bits(n.wrapping_mul(7919) % 0x7f80_0000);
            image.rgba[index] = [a, b, c, 255];
        }
    }
    image.ids[1] = MISS - 1;
    image.t[1] = f32::INFINITY;
    image.t[2] = f32::from_bits(1);
    image.t[4] = f32::MAX;
    image.t[5] = 0.0;
    Ok(image)
}

fn plain(width: u32, height: u32) -> Result<Image, Box<dyn Error>> {
    let mut image = Image::new(Size::new(width, height)?, [40, 50, 60])?;
    image.ids.fill(7);
    image.t.fill(2.5);
    Ok(image)
}

fn index(image: &Image, [x, y]: [u32; 2]) -> usize {
    y as usize * image.size.width() as usize + x as usize
}

#[test]
fn png_decodes_to_the_colors_it_was_made_of() -> Outcome {
    let image = varied(37, 23)?;
    let decoded = image::load_from_memory(&png(&canvas(&image)?)?)?;
    assert_eq!(decoded.color(), image::ColorType::Rgba8);
    let decoded = decoded.into_rgba8();
    assert_eq!(decoded.dimensions(), (37, 23));
    assert_eq!(decoded.as_raw().as_chunks::<4>().0, image.rgba);
    Ok(())
}

#[test]
fn exr_decodes_to_the_bits_it_was_made_of() -> Outcome {
    use ::exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
    let image = varied(37, 23)?;
    let bytes = exr(&image)?;
    let decoded = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))?;
    let mut found = Vec::new();
    for layer in &decoded.layer_data {
        assert_eq!((layer.size.0, layer.size.1), (37, 23));
        let name = layer.attributes.layer_name.as_ref().map(ToString::to_string).unwrap_or_default();
        for channel in &layer.channel_data.list {
            let level = match &channel.sample_data {
                FlatSamples::U32(ids) => ids.clone(),
                FlatSamples::F32(values) => values.iter().map(|x| x.to_bits()).collect(),
                FlatSamples::F16(_) => return Err("half precision loses bits".into()),
            };
            let is_integer = matches!(channel.sample_data, FlatSamples::U32(_));
            found.push((name.clone(), channel.name.to_string(), is_integer, level));
        }
    }
    let level = |k: usize| image.rgba.iter().map(|c| (f32::from(c[k]) / 255.0).to_bits()).collect();
    let text = |layer: &str, name: &str| (layer.to_owned(), name.to_owned());
    let expected: [((String, String), bool, Vec<u32>); 5] = [
        (text("color", "B"), false, level(2)),
        (text("color", "G"), false, level(1)),
        (text("color", "R"), false, level(0)),
        (text("id", "id"), true, image.ids.clone()),
        (text("t", "t"), false, image.t.iter().map(|t| t.to_bits()).collect()),
    ];
    let expected = expected.map(|((layer, name), integer, level)| (layer, name, integer, level));
    assert_eq!(found, expected);
    Ok(())
}

/// Every fault has its colour in the difference, and what is right is grey.
#[test]
fn difference_shows_each_fault_in_its_color() -> Outcome {
    let mut truth = plain(6, 1)?;
    let mut subject = truth.clone();
    subject.ids[0] = MISS;
    truth.ids[1] = MISS;
    subject.ids[2] = 8;
    subject.t[3] = f32::from_bits(subject.t[3].to_bits() + 1);
    subject.rgba[4][1] ^= 1;
    let panel = difference(&truth, &subject)?;
    for (x, (fault, color, _)) in (0..).zip(PALETTE) {
        assert_eq!(panel.get_pixel(x, 0).0[..3], color, "{fault:?}");
        assert_eq!(fault_color(fault), color, "{fault:?}");
    }
    let [r, g, b, alpha] = panel.get_pixel(5, 0).0;
    assert!(r == g && g == b && r < 96 && alpha == 255);
    Ok(())
}

/// One wrong pixel among 921 600: in its colour, enlarged, and ringed in all three panels.
#[test]
fn triptych_marks_a_single_wrong_pixel() -> Outcome {
    let truth = plain(1280, 720)?;
    let mut subject = truth.clone();
    let [x, y] = [901, 333];
    let wrong = index(&truth, [x, y]);
    subject.ids[wrong] = MISS;
    let whole = triptych(&truth, &subject, first(&truth, &subject))?;
    assert_eq!(whole.dimensions(), (3 * 1280 + 2 * GAP, 720));
    for panel in 0..3 {
        let left = panel * (1280 + GAP);
        let radius = ring_radius(1280);
        for (column, row) in [(x + radius, y), (x - radius, y), (x, y + radius), (x, y - radius)] {
            assert_eq!(whole.get_pixel(left + column, row).0, MARK, "panel {panel}");
        }
        let half = square_side(1280) / 2;
        assert!(half >= 2 && half < radius / 2);
        let expected = if panel == 2 { opaque(Fault::Missing) } else { [40, 50, 60, 255] };
        for (column, row) in [(x, y), (x - half, y - half), (x + half, y + half)] {
            assert_eq!(whole.get_pixel(left + column, row).0, expected, "panel {panel}");
        }
        assert_ne!(whole.get_pixel(left + x + half + 1, y).0, opaque(Fault::Missing), "panel {panel}");
    }
    assert!((0..GAP).all(|gap| whole.get_pixel(1280 + gap, 0).0[3] == 0));
    Ok(())
}

#[test]
fn triptych_of_equal_pictures_bears_no_mark() -> Outcome {
    let truth = plain(640, 8)?;
    let whole = triptych(&truth, &truth, None)?;
    assert!(whole.pixels().all(|pixel| pixel.0 != MARK));
    Ok(())
}

/// A ring at every border: nothing may be drawn outside, nothing may panic.
#[test]
fn marks_fit_at_the_corners_and_in_one_pixel() -> Outcome {
    for (width, height) in [(1, 1), (2, 700), (700, 2), (64, 48)] {
        let truth = plain(width, height)?;
        for place in [[0, 0], [width - 1, 0], [0, height - 1], [width - 1, height - 1]] {
            let mut subject = truth.clone();
            let wrong = index(&truth, place);
            subject.ids[wrong] = MISS;
            let whole = triptych(&truth, &subject, first(&truth, &subject))?;
            let left = 2 * (width + GAP);
            assert_eq!(whole.get_pixel(left + place[0], place[1]).0, opaque(Fault::Missing));
        }
    }
    Ok(())
}

/// A common fault keeps its exact pixels, a rare one beside it grows, the graver one on top.
#[test]
fn only_rare_faults_are_enlarged() -> Outcome {
    let truth = plain(1280, 100)?;
    let mut subject = truth.clone();
    subject.t[..2000].fill(9.0);
    let wrong = index(&truth, [50, 50]);
    subject.ids[wrong] = 8;
    subject.rgba[wrong + 2] = [0; 4];
    let panel = bold_difference(&truth, &subject)?;
    let count = |fault| panel.pixels().filter(|pixel| pixel.0 == opaque(fault)).count();
    assert_eq!(count(Fault::T), 2000);
    assert_eq!(count(Fault::Swapped), 9 * 9);
    assert_eq!(count(Fault::Color), 9 * 2);
    Ok(())
}

#[test]
fn zoom_magnifies_the_wrong_pixel_in_the_middle() -> Outcome {
    let mut truth = varied(40, 30)?;
    truth.rgba.fill([10, 20, 30, 255]);
    let mut subject = truth.clone();
    let wrong = index(&truth, [0, 12]);
    subject.ids[wrong] = truth.ids[wrong].wrapping_add(1);
    subject.rgba[wrong] = [200, 100, 50, 255];
    let place = first(&truth, &subject).ok_or("nothing differs")?;
    let [a, b, c] = zoom(&truth, &subject, place, 9, 8)?;
    let fault = opaque(if truth.ids[wrong] == MISS { Fault::Extra } else { Fault::Swapped });
    for (panel, expected) in [(a, [10, 20, 30, 255]), (b, [200, 100, 50, 255]), (c, fault)] {
        assert_eq!(panel.dimensions(), (72, 72));
        let inside = |panel: &RgbaImage, at| panel.get_pixel(at, at).0;
        assert_eq!([32, 35, 39].map(|at| inside(&panel, at)), [expected; 3]);
        assert_eq!([31, 40].map(|at| inside(&panel, at)), [MARK; 2], "the frame stands outside");
        assert_eq!(panel.get_pixel(3, 36).0[3], 0, "left of the image is nothing");
    }
    Ok(())
}

#[test]
fn images_that_do_not_fit_are_refused() -> Outcome {
    let truth = plain(4, 3)?;
    let narrow = plain(3, 4)?;
    assert!(matches!(
        triptych(&truth, &narrow, None),
        Err(PictureError::Sizes { truth: [4, 3], subject: [3, 4] })
    ));
    let mut short = truth.clone();
    short.t.pop();
    for outcome in [canvas(&short).err(), exr(&short).err(), difference(&truth, &short).err()] {
        assert!(matches!(outcome, Some(PictureError::Layer { layer: "t", entries: 11, pixels: 12 })));
    }
    Ok(())
}

#[test]
fn files_are_replaced_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("a.png");
    write_atomically(&path, b"first")?;
    write_atomically(&path, b"second")?;
    assert_eq!(std::fs::read(&path)?, b"second");
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 1);
    Ok(())
}

/// Through a link its file is written; a pipe is written into; a private file stays private, and a new one is as open as any.
#[cfg(unix)]
#[test]
fn links_pipes_and_permissions_stay_what_they_are() -> Outcome {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let folder = tempfile::tempdir()?;
    let at = |name: &str| folder.path().join(name);
    let mode = |name: &str| -> std::io::Result<u32> {
        Ok(std::fs::metadata(at(name))?.permissions().mode() & 0o777)
    };
    std::fs::write(at("plain"), b"before")?;
    write_atomically(&at("new"), b"now")?;
    assert_eq!(mode("new")?, mode("plain")?, "the umask's");

    std::fs::create_dir(at("elsewhere"))?;
    std::fs::write(at("elsewhere/file"), b"before")?;
    symlink(at("elsewhere/file"), at("link"))?;
    write_atomically(&at("link"), b"through")?;
    assert!(at("link").is_symlink() && std::fs::read(at("elsewhere/file"))? == b"through");

    std::fs::set_permissions(at("plain"), std::fs::Permissions::from_mode(0o600))?;
    write_atomically(&at("plain"), b"after")?;
    assert_eq!((std::fs::read(at("plain"))?.as_slice(), mode("plain")?), (b"after".as_slice(), 0o600));

    assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status()?.success());
    let pipe = at("pipe");
    let reader = std::thread::spawn(move || std::fs::read(pipe));
    write_atomically(&at("pipe"), b"into")?;
    assert!(std::fs::symlink_metadata(at("pipe"))?.file_type().is_fifo(), "a file in its place");
    assert_eq!(reader.join().map_err(|_| "it fell over")??, b"into");
    let names = std::fs::read_dir(folder.path())?.count();
    assert_eq!(names, 5, "a temporary file was left");
    Ok(())
}

#[test]
fn a_failed_write_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let taken = folder.path().join("taken");
    std::fs::create_dir(&taken)?;
    std::fs::write(taken.join("keep"), b"kept")?;
    let place = write_atomically(&taken, b"bytes");
    assert!(matches!(&place, Err(WriteError::Place { path, .. }) if *path == taken), "{place:?}");

    let below_a_file = taken.join("keep").join("a.png");
    let no_folder = write_atomically(&below_a_file, b"bytes");
    assert!(
        matches!(&no_folder, Err(WriteError::Folder { path, .. }) if *path == below_a_file),
        "{no_folder:?}"
    );
    let message = no_folder.err().map(|error| error.to_string()).unwrap_or_default();
    assert!(message.contains("keep") && message.contains("a.png"), "{message}");

    assert!(matches!(write_atomically("..".as_ref(), b""), Err(WriteError::NoName { .. })));
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 1, "a temporary file was left");
    assert_eq!(std::fs::read(taken.join("keep"))?, b"kept");
    Ok(())
}

fn opaque(fault: Fault) -> [u8; 4] {
    let [r, g, b] = fault_color(fault);
    [r, g, b, 255]
}

/// The first panel is the truth, the second the subject: with other colours everywhere neither can be taken for the other.
#[test]
fn each_panel_shows_its_own_picture() -> Outcome {
    let truth = plain(640, 40)?;
    let mut subject = truth.clone();
    subject.rgba.fill([1, 2, 3, 255]);
    let whole = triptych(&truth, &subject, first(&truth, &subject))?;
    // Far from the mark of the first wrong pixel.
    let at = |panel: u32| whole.get_pixel(panel * (640 + GAP) + 600, 30).0;
    assert_eq!([at(0), at(1), at(2)], [[40, 50, 60, 255], [1, 2, 3, 255], opaque(Fault::Color)]);
    Ok(())
}
