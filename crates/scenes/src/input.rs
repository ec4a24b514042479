//! Reading within bounds: an input without an end, or without line breaks, is refused before it fills the memory.

use std::fs::{self, File};
use std::io::{self, BufRead, Read};
use std::path::Path;

/// The longest line of a table that is read line by line, in bytes.
pub const LONGEST_LINE: u64 = 16 << 20;

/// Reads all bytes, at most `most`.
///
/// # Errors
/// [`io::ErrorKind::FileTooLarge`] if there are more, and the errors of the reader.
pub fn read_at_most(from: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > most {
        true => Err(io::ErrorKind::FileTooLarge.into()),
        false => Ok(bytes),
    }
}

/// Reads the next line with its line break, which the last line may lack; `None` at the end.
///
/// # Errors
/// [`io::ErrorKind::InvalidData`] if the line is longer than [`LONGEST_LINE`] or is not UTF-8, and the errors of the reader.
pub fn read_line(from: &mut impl BufRead) -> io::Result<Option<String>> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidData, problem);
    let mut bytes = Vec::new();
    from.take(LONGEST_LINE + 1).read_until(b'\n', &mut bytes)?;
    if bytes.len() as u64 > LONGEST_LINE {
        return Err(invalid(format!(
            "a line has more than {} MB; no table has such a line",
            LONGEST_LINE >> 20
        )));
    }
    let line = String::from_utf8(bytes).map_err(|_| invalid("a line is not UTF-8".to_owned()))?;
    Ok((!line.is_empty()).then_some(line))
}

/// Returns the lines without their line breaks, as [`BufRead::lines`] does, each read by [`read_line`].
pub fn lines(mut from: impl BufRead) -> impl Iterator<Item = io::Result<String>> {
    let without_break = |line: String| match line.strip_suffix('\n') {
        Some(text) => text.strip_suffix('\r').unwrap_or(text).to_owned(),
        None => line,
    };
    std::iter::from_fn(move || Some(read_line(&mut from).transpose()?.map(without_break)))
}

/// Opens a file, but no pipe or device, which might never end, and cannot be read more than once.
///
/// # Errors
/// [`io::ErrorKind::InvalidInput`] if it is not a regular file, and the errors of the system.
pub fn open_regular(path: &Path) -> io::Result<File> {
    // looked at before it is opened: to open a pipe waits for its writer
    let kind = fs::metadata(path)?.file_type();
    match (kind.is_file(), kind.is_dir()) {
        (true, _) => File::open(path),
        (_, true) => Err(io::ErrorKind::IsADirectory.into()),
        _ => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is not a regular file; write it to a file first",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_whole_or_refused() {
        let mut text = &b"one\r\ntwo\n\nlast"[..];
        assert_eq!(read_line(&mut text).unwrap().as_deref(), Some("one\r\n"));
        let rest: io::Result<Vec<String>> = lines(text).collect();
        assert_eq!(rest.unwrap(), ["two", "", "last"]);
        let mut endless = io::BufReader::new(io::repeat(0));
        assert_eq!(read_line(&mut endless).unwrap_err().kind(), io::ErrorKind::InvalidData);
        let most = vec![b'x'; LONGEST_LINE as usize];
        assert!(read_line(&mut &most[..]).unwrap().is_some());
        assert!(read_line(&mut &[most, vec![b'x']].concat()[..]).is_err());
        assert!(
            read_line(&mut &b"\xff\n"[..])
                .unwrap_err()
                .to_string()
                .contains("UTF-8")
        );
    }

    #[test]
    fn no_more_is_read_than_the_bound() {
        assert_eq!(read_at_most(&b"four"[..], 4).unwrap(), b"four");
        for error in [read_at_most(&b"fives"[..], 4), read_at_most(io::repeat(0), 4)].map(Result::unwrap_err) {
            assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
        }
        assert!(open_regular(&std::env::temp_dir()).is_err());
    }
}
