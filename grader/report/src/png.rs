//! A picture as PNG: its light form at twice its size, the words in the one font that is built in, so that no machine's fonts
//! and settings show in it.

use std::sync::{Arc, OnceLock};

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError};
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
    written(&pixels).map_err(|error| PngError::Unwritable(error.to_string()))
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

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        assert!(matches!(png("<p>"), Err(PngError::Unreadable(_))));
        let huge = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1e6\" height=\"1e6\"/>";
        assert_eq!(png(huge), Err(PngError::Size(1_000_000, 1_000_000)));
    }
}
