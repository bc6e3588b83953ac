//! A picture as PNG: its light form at twice its size, the words in the one font that is built in, so that no machine's fonts
//! and settings show in it; and whether a PNG shows such a picture.

use std::io::Cursor;
use std::sync::{Arc, OnceLock};

use png::{BitDepth, ColorType, Compression, Decoder, Encoder, EncodingError, Info, Limits};
use png::{ScaledFloat, Transformations};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, Tree, fontdb};

/// DejaVu Sans; its licence lies beside it.
static FONT: &[u8] = include_bytes!("../fonts/DejaVuSans.ttf");
/// The name the font gives itself.
const FAMILY: &str = "DejaVu Sans";
/// Pixels of the picture in a pixel of the SVG.
const SCALE: f32 = 2.0;
/// The largest picture that is drawn, in pixels of the PNG.
const MOST_PIXELS: u64 = 64_000_000;

/// Why an SVG has no PNG.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PngError {
    /// It is no SVG that can be read.
    #[error("the picture cannot be read: {0}")]
    Unreadable(String),
    /// It has no pixel, or too many.
    #[error("the picture is {0} x {1} pixels, which is not drawn")]
    Size(u32, u32),
    /// The pixels cannot be written.
    #[error("the picture cannot be written: {0}")]
    Unwritable(String),
}

/// The picture that `svg` draws on a light screen, as a PNG of twice its size. The same SVG gives the same bytes. No file and no
/// address is followed, whatever the SVG names.
///
/// # Errors
/// [`PngError`], if it is no SVG, or of a size that is not drawn.
pub fn png(svg: &str) -> Result<Vec<u8>, PngError> {
    written(&drawn(svg)?).map_err(|error| PngError::Unwritable(error.to_string()))
}

/// Whether a PNG shows the picture that `svg` draws, as [`png()`] would. However it is written: what counts are the pixels, and of these no
/// more than what kinds of processors round otherwise.
///
/// # Errors
/// [`PngError`] of the SVG; a file that is no PNG shows another picture.
pub fn shows(file: &[u8], svg: &str) -> Result<bool, PngError> {
    let drawn = drawn(svg)?;
    let shown = decoded(file, drawn.width(), drawn.height());
    Ok(shown.is_some_and(|shown| is_alike(&shown, &drawn)))
}

/// The pixels of the picture that `svg` draws on a light screen; nothing shines through them.
fn drawn(svg: &str) -> Result<Pixmap, PngError> {
    let tree =
        Tree::from_str(svg, options()).map_err(|error| PngError::Unreadable(error.to_string()))?;
    let size = tree
        .size()
        .to_int_size()
        .scale_by(SCALE)
        .filter(|size| u64::from(size.width()) * u64::from(size.height()) <= MOST_PIXELS);
    let Some(size) = size else {
        let size = tree.size().to_int_size();
        return Err(PngError::Size(size.width(), size.height()));
    };
    let (width, height) = (size.width(), size.height());
    let mut pixels = Pixmap::new(width, height).ok_or(PngError::Size(width, height))?;
    let to_pixels = Transform::from_scale(
        width as f32 / tree.size().width(),
        height as f32 / tree.size().height(),
    );
    pixels.fill(Color::WHITE);
    resvg::render(&tree, to_pixels, &mut pixels.as_mut());
    Ok(pixels)
}

/// The opaque pixels of a PNG of this size; none of another size, and of one that a viewer shows otherwise than its pixels say. No more
/// is decoded than so many pixels.
fn decoded(file: &[u8], width: u32, height: u32) -> Option<Vec<[u8; 3]>> {
    // at most four channels of 16 bits each, and what a header may have besides
    let bytes = 8 * width as usize * height as usize + (1 << 20);
    let mut decoder = Decoder::new_with_limits(Cursor::new(file), Limits { bytes });
    decoder.set_transformations(Transformations::normalize_to_color8());
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info().ok()?;
    if (header.width, header.height) != (width, height) {
        return None;
    }
    let mut reader = decoder.read_info().ok()?;
    let mut samples = vec![0; reader.output_buffer_size()?];
    let frame = reader.next_frame(&mut samples).ok()?;
    reader.finish().ok()?;
    if is_shown_otherwise(reader.info()) {
        return None;
    }
    let pixels = samples.chunks_exact(frame.color_type.samples());
    let opaque = pixels.map(|pixel| match *pixel {
        [r, g, b] | [r, g, b, u8::MAX] => Some([r, g, b]),
        [grey] | [grey, u8::MAX] => Some([grey; 3]),
        _ => None,
    });
    opaque.collect()
}

/// Whether a viewer would show other pixels: a later frame, other colours, turned by what a camera says.
fn is_shown_otherwise(info: &Info<'_>) -> bool {
    // what sRGB, which screens have anyway, is written as beside its own chunk
    let is_srgb = |gamma: ScaledFloat| gamma.into_scaled() == 45_455;
    info.animation_control.is_some()
        || info.gama_chunk.is_some_and(|gamma| !is_srgb(gamma))
        || (info.chrm_chunk.is_some() && info.srgb.is_none())
        || info.icc_profile.is_some()
        || info.coding_independent_code_points.is_some()
        || info.exif_metadata.is_some()
}

/// A difference of a colour, of 255, that nobody sees: another rounding.
const ROUNDING: u8 = 4;
/// On an edge one sample more or less may lie in a shape: so much of the colour, in one of so many pixels.
const ON_EDGES: u8 = 32;
const EDGES: usize = 10_000;

/// Whether pixels are those that were drawn, up to rounding.
fn is_alike(shown: &[[u8; 3]], drawn: &Pixmap) -> bool {
    let drawn = drawn.data().chunks_exact(4);
    let differences = shown.iter().zip(drawn).map(|(shown, drawn)| {
        let channels = shown.iter().zip(drawn);
        let differences = channels.map(|(shown, drawn)| shown.abs_diff(*drawn));
        differences.max().unwrap_or(0)
    });
    let mut on_edges = 0;
    for difference in differences.filter(|difference| *difference > ROUNDING) {
        on_edges += 1;
        if difference > ON_EDGES || on_edges * EDGES > shown.len() {
            return false;
        }
    }
    true
}

/// The pixels, which nothing shines through, as a file. Fast compression: the slow one takes longer than all the drawing.
fn written(pixels: &Pixmap) -> Result<Vec<u8>, EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    let mut writer = encoder.write_header()?;
    let colours = pixels.data().chunks_exact(4);
    let opaque: Vec<u8> = colours.flat_map(|c| [c[0], c[1], c[2]]).collect();
    writer.write_image_data(&opaque)?;
    writer.finish()?;
    Ok(file)
}

/// The font, read once, and nothing else.
fn options() -> &'static usvg::Options<'static> {
    static OPTIONS: OnceLock<usvg::Options<'static>> = OnceLock::new();
    OPTIONS.get_or_init(|| {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(FONT)));
        // every family there is; one that is not there counts as serif
        fonts.set_serif_family(FAMILY);
        fonts.set_sans_serif_family(FAMILY);
        fonts.set_monospace_family(FAMILY);
        usvg::Options {
            fontdb: Arc::new(fonts),
            font_family: FAMILY.to_owned(),
            // what a picture names is not looked for: pictures inside pictures are not drawn
            image_href_resolver: usvg::ImageHrefResolver {
                resolve_data: Box::new(|_, _, _| None),
                resolve_string: Box::new(|_, _| None),
            },
            ..usvg::Options::default()
        }
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::plot::plots;
    use kinemark_grader::record::sample;

    fn pixels(png: &[u8]) -> Pixmap {
        Pixmap::decode_png(png).expect("a PNG")
    }

    fn colours(pixels: &Pixmap) -> BTreeSet<[u8; 4]> {
        let of =
            |p: &resvg::tiny_skia::PremultipliedColorU8| [p.red(), p.green(), p.blue(), p.alpha()];
        pixels.pixels().iter().map(of).collect()
    }

    /// Pixels in a part of the picture that are not white.
    fn inked(pixels: &Pixmap, x: std::ops::Range<u32>, y: std::ops::Range<u32>) -> usize {
        let places = y.flat_map(|y| x.clone().map(move |x| (x, y)));
        let inked = places.filter(|(x, y)| {
            let p = pixels.pixel(*x, *y).expect("inside");
            (p.red(), p.green(), p.blue()) != (255, 255, 255)
        });
        inked.count()
    }

    #[test]
    fn every_plot_is_the_same_picture_again_light_and_not_blank() {
        for plot in plots(&sample::task_run()) {
            let first = png(&plot.svg).expect("a picture");
            assert_eq!(first, png(&plot.svg).expect("a picture"), "{}", plot.name);
            let pixels = pixels(&first);
            assert_eq!(pixels.width(), 1280, "{}", plot.name);
            let corner = pixels.pixel(0, 0).expect("a pixel");
            let corner = [corner.red(), corner.green(), corner.blue(), corner.alpha()];
            assert_eq!(corner, [255; 4], "{}: light and opaque", plot.name);
            let colours = colours(&pixels);
            assert!(colours.len() > 30, "{}: {}", plot.name, colours.len());
            assert!(colours.iter().all(|c| c[3] == 255), "{}", plot.name);
            assert!(
                colours.contains(&[0, 108, 174, 255]),
                "{}: no line",
                plot.name
            );
            // the title, at the top left
            let title = inked(&pixels, 40..600, 30..66);
            assert!(title > 300, "{}: {title} pixels of a title", plot.name);
        }
    }

    #[test]
    fn words_are_drawn_in_the_one_font_whatever_the_picture_asks_for() {
        let with = |family: &str, text: &str| {
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"40\"><rect width=\"200\" height=\"40\" fill=\"#FFF\"/>\
                 <text x=\"10\" y=\"25\" font-size=\"16\" style=\"font-family:{family}\">{text}</text></svg>"
            )
        };
        let ours = png(&with("sans-serif", "q2 \u{2212}0.5 \u{b0}")).expect("a picture");
        assert!(inked(&pixels(&ours), 0..400, 0..80) > 200);
        for family in ["system-ui,'Segoe UI',sans-serif", "Arial", "monospace"] {
            let theirs = png(&with(family, "q2 \u{2212}0.5 \u{b0}")).expect("a picture");
            assert!(theirs == ours, "{family}");
        }
        let blank = png(&with("sans-serif", "")).expect("a picture");
        assert_eq!(inked(&pixels(&blank), 0..400, 0..80), 0);
    }

    #[test]
    fn nothing_that_a_picture_names_is_read() {
        let folder = std::env::temp_dir().join(format!("kinemark-png-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        let red = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><rect width=\"9\" height=\"9\" fill=\"#f00\"/></svg>";
        let drawn = png(red).expect("a picture");
        assert!(
            colours(&pixels(&drawn)).contains(&[255, 0, 0, 255]),
            "it would show"
        );
        for (name, bytes) in [("red.svg", red.as_bytes()), ("red.png", &drawn)] {
            let file = folder.join(name);
            std::fs::write(&file, bytes).expect("a file");
            let file = file.display();
            for address in [file.to_string(), format!("file://{file}")] {
                let svg = format!(
                    "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"20\"><image href=\"{address}\" width=\"9\" height=\"9\"/></svg>"
                );
                let drawn = png(&svg).expect("a picture");
                assert_eq!(colours(&pixels(&drawn)).len(), 1, "{address}");
            }
        }
        std::fs::remove_dir_all(&folder).expect("removed");
    }

    const SQUARE: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"150\" height=\"100\"><rect x=\"5\" y=\"5\" width=\"20\" height=\"20\" fill=\"#06a\"/></svg>";

    /// The picture's pixels written once more, changed by `change`, with the encoder set up by `with`.
    fn rewritten(
        colour: ColorType,
        change: impl Fn(&mut [u8]),
        with: impl Fn(&mut Encoder<'_, &mut Vec<u8>>),
    ) -> Vec<u8> {
        let mut pixels = drawn(SQUARE).expect("a picture");
        change(pixels.data_mut());
        let data: Vec<u8> = match colour {
            ColorType::Rgba => pixels.data().to_vec(),
            _ => {
                let colours = pixels.data().chunks_exact(4);
                colours.flat_map(|c| [c[0], c[1], c[2]]).collect()
            }
        };
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, pixels.width(), pixels.height());
        encoder.set_color(colour);
        with(&mut encoder);
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&data).expect("pixels");
        writer.finish().expect("a file");
        file
    }

    #[test]
    fn a_png_shows_a_picture_however_it_is_written_and_no_other_one() {
        let shows = |file: &[u8]| shows(file, SQUARE).expect("a picture");
        let ours = png(SQUARE).expect("a picture");
        assert!(shows(&ours));
        let same = rewritten(ColorType::Rgba, |_| {}, |_| {});
        assert!(same != ours && shows(&same), "with an alpha channel");
        let srgb = |encoder: &mut Encoder<'_, &mut Vec<u8>>| {
            encoder.set_compression(Compression::High);
            encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        };
        assert!(shows(&rewritten(ColorType::Rgb, |_| {}, srgb)));
        let changed = |of: usize, by: u8| {
            let change = move |data: &mut [u8]| {
                data.chunks_exact_mut(4).take(of).for_each(|c| c[0] ^= by);
            };
            rewritten(ColorType::Rgb, change, |_| {})
        };
        assert!(shows(&changed(60_000, ROUNDING)), "rounding everywhere");
        assert!(shows(&changed(6, ON_EDGES)), "and more on edges");
        assert!(!shows(&changed(7, ON_EDGES)));
        assert!(!shows(&changed(1, ON_EDGES + 1)));
        // what shows through
        let change = |data: &mut [u8]| data[3] = 0;
        assert!(!shows(&rewritten(ColorType::Rgba, change, |_| {})));
        // what a viewer shows otherwise
        let gamma = |encoder: &mut Encoder<'_, &mut Vec<u8>>| {
            encoder.set_source_gamma(ScaledFloat::new(0.05));
        };
        assert!(!shows(&rewritten(ColorType::Rgb, |_| {}, gamma)));
        let animated = |encoder: &mut Encoder<'_, &mut Vec<u8>>| {
            encoder.set_animated(1, 0).expect("an animation");
        };
        assert!(!shows(&rewritten(ColorType::Rgb, |_| {}, animated)));
        for other in [&b""[..], b"GIF89a", &ours[..ours.len() / 2], &ours[..60]] {
            assert!(!shows(other), "{} bytes", other.len());
        }
        let other = SQUARE.replace("width=\"150\"", "width=\"151\"");
        assert!(!shows(&png(&other).expect("a picture")), "of another size");
    }

    /// A few kilobytes that would be gigabytes of pixels.
    #[test]
    fn no_more_is_decoded_than_the_picture_has() {
        let mut bomb = Vec::new();
        let mut encoder = Encoder::new(&mut bomb, 60_000, 60_000);
        encoder.set_color(ColorType::Rgb);
        encoder.write_header().expect("a header");
        assert_eq!(shows(&bomb, SQUARE), Ok(false));
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        assert!(matches!(png("<p>"), Err(PngError::Unreadable(_))));
        let huge = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1e6\" height=\"1e6\"/>";
        assert_eq!(png(huge), Err(PngError::Size(1_000_000, 1_000_000)));
    }
}
