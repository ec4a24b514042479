//! Elements and text, written so that no text becomes an element: the one writer of HTML and MathML, and the one place
//! where XML is escaped.

use std::borrow::Cow;
use std::fmt::{self, Write};

/// A piece of a page. Names of elements and attributes stand in the source; all else is escaped when it is written.
#[derive(Clone, Debug, PartialEq)]
pub enum Markup {
    /// Somebody's text.
    Text(String),
    /// An element.
    Element(Element),
    /// Markup that stands in the source: a style, a script.
    Source(&'static str),
    /// What a writer of XML has written and escaped already.
    Written(Written),
}

/// An element with its attributes and what stands in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, Cow<'static, str>)>,
    children: Vec<Markup>,
}

/// XML that another writer of this crate has escaped: a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Written(String);

impl Written {
    /// Takes what was written: `xml` must come from a writer that escapes what it is given.
    pub const fn by_our_writer(xml: String) -> Self {
        Self(xml)
    }
}

/// Elements without content, which HTML closes at once.
const VOID: [&str; 4] = ["br", "col", "input", "meta"];

/// An element without attributes that holds these.
pub fn element(name: &'static str, children: impl IntoIterator<Item = impl Into<Markup>>) -> Element {
    Element {
        name,
        attributes: Vec::new(),
        children: children.into_iter().map(Into::into).collect(),
    }
}

/// An element that holds a text.
pub fn text_in(name: &'static str, text: impl Into<String>) -> Element {
    element(name, [Markup::Text(text.into())])
}

/// An element that holds nothing.
pub fn empty(name: &'static str) -> Element {
    element(name, Vec::<Markup>::new())
}

impl Element {
    /// The element with another attribute.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: impl Into<Cow<'static, str>>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// The element with more in it.
    #[must_use]
    pub fn and(mut self, children: impl IntoIterator<Item = impl Into<Markup>>) -> Self {
        self.children.extend(children.into_iter().map(Into::into));
        self
    }
}

impl Markup {
    /// Whether an element of one of these names stands in it.
    pub fn holds(&self, names: &[&str]) -> bool {
        match self {
            Self::Element(own) => names.contains(&own.name) || own.children.iter().any(|child| child.holds(names)),
            _ => false,
        }
    }
}

impl From<Element> for Markup {
    fn from(element: Element) -> Self {
        Self::Element(element)
    }
}

impl From<&str> for Markup {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Markup {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<Written> for Markup {
    fn from(written: Written) -> Self {
        Self::Written(written)
    }
}

impl fmt::Display for Markup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => escape(text, f),
            Self::Element(element) => element.fmt(f),
            Self::Source(text) => f.write_str(text),
            Self::Written(Written(xml)) => f.write_str(xml),
        }
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(f, " {name}=\"")?;
            escape(value, f)?;
            f.write_char('"')?;
        }
        if VOID.contains(&self.name) {
            return f.write_str("/>");
        }
        f.write_char('>')?;
        self.children.iter().try_for_each(|child| child.fmt(f))?;
        write!(f, "</{}>", self.name)
    }
}

/// Whether a character of somebody's text does something to a reader: a control character, or a bidirectional mark, which
/// turns the rest of a line round.
pub fn acts(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Writes a text as XML has it, within an element or an attribute. What XML has no way to say becomes U+FFFD.
///
/// # Errors
/// Those of the writer.
pub fn escape(text: &str, to: &mut impl Write) -> fmt::Result {
    text.chars().try_for_each(|c| match c {
        '&' => to.write_str("&amp;"),
        '<' => to.write_str("&lt;"),
        '>' => to.write_str("&gt;"),
        '"' => to.write_str("&quot;"),
        '\n' | '\t' => to.write_char(c),
        '\u{fffe}' | '\u{ffff}' => to.write_char('\u{fffd}'),
        c if acts(c) => to.write_char('\u{fffd}'),
        c => to.write_char(c),
    })
}

/// A text as XML has it on one line.
pub fn escaped_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    // writing to a String does not fail
    let _ = escape(&text.replace(['\n', '\t', '\r'], " "), &mut line);
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_xml_reserves_is_escaped_in_text_and_attributes() {
        let shown = text_in("p", "a<b & \"c\">\u{1}é\u{202e}")
            .with("title", "\"><script>")
            .to_string();
        let wanted = "<p title=\"&quot;&gt;&lt;script&gt;\">a&lt;b &amp; &quot;c&quot;&gt;\u{fffd}é\u{fffd}</p>";
        assert_eq!(shown, wanted);
        assert_eq!(escaped_line("a\n\tb"), "a  b");
    }

    #[test]
    fn what_holds_nothing_is_closed_as_html_wants_it() {
        assert_eq!(empty("br").to_string(), "<br/>");
        assert_eq!(empty("td").to_string(), "<td></td>");
    }

    proptest! {
        #[test]
        fn a_text_reads_back_and_is_no_element(text in any::<String>()) {
            let written = element("a", [text_in("b", text.clone()).with("c", text.clone())]).to_string();
            let document = roxmltree::Document::parse(&written).unwrap();
            let inner = document.root_element().first_child().unwrap();
            prop_assert_eq!(document.descendants().filter(roxmltree::Node::is_element).count(), 2);
            let shown: String = text.chars().map(|c| match c {
                '\n' | '\t' => c,
                '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
                c if acts(c) => '\u{fffd}',
                c => c,
            }).collect();
            prop_assert_eq!(inner.text().unwrap_or_default(), shown.as_str());
        }
    }
}
