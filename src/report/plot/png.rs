//! A figure as PNG: its SVG drawn in fonts that the program carries, so that the same figure is the same bytes everywhere.

use super::paper::PlotError;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Node, Options, Tree};

/// The regular, bold and oblique faces of DejaVu Sans, reduced to Latin, Greek, Cyrillic and mathematical signs.
const FONTS: [&[u8]; 3] = [
    include_bytes!("fonts/DejaVuSans.ttf"),
    include_bytes!("fonts/DejaVuSans-Bold.ttf"),
    include_bytes!("fonts/DejaVuSans-Oblique.ttf"),
];

/// Pixels of the image for each pixel of the SVG: above 300 dots per inch for one column of 8.5 cm.
const SCALE: f32 = 2.5;

/// Draws an SVG of ours.
///
/// # Errors
/// Letters that the fonts lack, and an image too large for memory.
pub(super) fn png(svg: &str) -> Result<Vec<u8>, PlotError> {
    let failed = |problem: String| PlotError(format!("as PNG: {problem}; write an SVG instead"));
    let mut options = Options::default();
    for font in FONTS {
        options.fontdb_mut().load_font_data(font.to_vec());
    }
    // text whose family is not there would be left out without a word
    options.fontdb_mut().set_sans_serif_family("DejaVu Sans");
    let tree = Tree::from_str(svg, &options).map_err(|error| failed(error.to_string()))?;
    let missing = missing(tree.root());
    if !missing.is_empty() {
        return Err(failed(format!("its fonts have no {missing}")));
    }
    let size = tree.size().to_int_size().scale_by(SCALE);
    let image = size.and_then(|size| Pixmap::new(size.width(), size.height()));
    let mut image = image.ok_or_else(|| failed("too large".to_owned()))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut image.as_mut());
    image.encode_png().map_err(|error| failed(error.to_string()))
}

/// The characters that no font has a glyph for.
fn missing(group: &usvg::Group) -> String {
    let mut missing = String::new();
    for node in group.children() {
        match node {
            Node::Group(group) => missing.push_str(&self::missing(group)),
            Node::Text(text) => {
                let glyphs = text.layouted().iter().flat_map(|span| &span.positioned_glyphs);
                let empty = glyphs.filter(|glyph| glyph.id.0 == 0);
                empty.for_each(|glyph| missing.push_str(&glyph.text));
            }
            _ => {}
        }
    }
    missing
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"20\" font-family=\"Helvetica, sans-serif\">\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/><text x=\"0\" y=\"15\" font-size=\"15\">{text}</text></svg>"
        )
    }

    #[test]
    fn text_is_drawn_in_fonts_that_need_not_be_installed() {
        let ink = |svg: &str| {
            let image = Pixmap::decode_png(&png(svg).unwrap()).unwrap();
            assert_eq!((image.width(), image.height()), (150, 50));
            image.pixels().iter().filter(|pixel| pixel.red() < 128).count()
        };
        assert_eq!(ink(&text("")), 0);
        assert!(ink(&text("\u{17b} \u{3c6}")) > 100);
        // a sign behind that no symbol has leaves the symbol in italics
        let leaning = text("<tspan font-style=\"italic\">\u{3c6}</tspan>\u{b2}");
        assert!(png(&leaning) != png(&text("\u{3c6}\u{b2}")));
        assert_eq!(png(&leaning), png(&leaning));
    }

    #[test]
    fn letters_that_the_fonts_lack_are_named() {
        let error = png(&text("d \u{6f22}\u{5b57}")).unwrap_err().to_string();
        assert!(error.contains("\u{6f22}\u{5b57}") && error.contains("SVG"), "{error}");
    }
}
