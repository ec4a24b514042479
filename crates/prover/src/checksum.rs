//! A sum over what was written, which tells when it was changed.

use std::fmt;
use std::io::{self, Write};

/// FNV-1a, which is the same on every machine and in every version: it tells of accidents and of careless edits, not of
/// forgery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checksum(u64);

impl Default for Checksum {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Checksum {
    /// The letters of its text.
    pub const LETTERS: usize = 16;

    /// Takes in what is written.
    pub fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Takes in a line, with its end.
    pub fn add_line(&mut self, line: &str) {
        self.add(line.as_bytes());
        self.add(b"\n");
    }
}

impl fmt::Display for Checksum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Writes on, and takes a sum over what it writes.
pub struct Summed<'a> {
    /// Where it is written.
    pub to: &'a mut dyn Write,
    /// Of what was written.
    pub sum: Checksum,
}

impl<'a> Summed<'a> {
    /// Of nothing yet.
    pub fn new(to: &'a mut dyn Write) -> Self {
        let sum = Checksum::default();
        Self { to, sum }
    }
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.sum.add(bytes.get(..written).unwrap_or_default());
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Writes lines, each with the sum over all lines up to it behind a blank; a line that is not ended is kept back.
pub struct SummedLines<'a> {
    to: &'a mut dyn Write,
    line: Vec<u8>,
    sum: Checksum,
}

impl<'a> SummedLines<'a> {
    /// Behind lines of this sum.
    pub fn behind(to: &'a mut dyn Write, sum: Checksum) -> Self {
        let line = Vec::new();
        Self { to, line, sum }
    }

    /// Reads a line that was written behind lines of this sum, which becomes that of it too; none where it was not.
    pub fn read<'b>(line: &'b str, sum: &mut Checksum) -> Option<&'b str> {
        let (line, told) = line.rsplit_once(' ')?;
        sum.add_line(line);
        (told == sum.to_string()).then_some(line)
    }
}

impl Write for SummedLines<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        for part in bytes.split_inclusive(|byte| *byte == b'\n') {
            self.line.extend(part);
            if self.line.pop_if(|last| *last == b'\n').is_some() {
                self.sum.add(&self.line);
                self.sum.add(b"\n");
                self.to.write_all(&self.line)?;
                writeln!(self.to, " {}", self.sum)?;
                self.line.clear();
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_as_they_were_written_and_no_others_are() {
        let mut written = Vec::new();
        let mut lines = SummedLines::behind(&mut written, Checksum::default());
        lines.write_all(b"a,1\nb c,").unwrap();
        lines.write_all(b"2\n3\nnot en").unwrap();
        let text = String::from_utf8(written).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let read = |lines: &[&str]| {
            let mut sum = Checksum::default();
            let read = lines
                .iter()
                .map(|line| SummedLines::read(line, &mut sum).map(str::to_owned));
            read.collect::<Option<Vec<String>>>()
        };
        assert_eq!(
            read(&lines),
            Some(vec!["a,1".to_owned(), "b c,2".to_owned(), "3".to_owned()])
        );
        assert!(read(&lines[1..]).is_none() && read(&[lines[0], lines[2]]).is_none());
        assert!(read(&[lines[1], lines[0], lines[2]]).is_none() && read(&["hello"]).is_none());
        assert!(read(&[&lines[0].replace('1', "7")]).is_none());
    }

    #[test]
    fn the_sum_of_parts_is_that_of_the_whole() {
        let (mut whole, mut parts) = (Checksum::default(), Vec::new());
        whole.add_line("one line");
        let mut summed = Summed::new(&mut parts);
        summed.write_all(b"one ").unwrap();
        summed.write_all(b"line\n").unwrap();
        assert_eq!(summed.sum, whole);
        assert_eq!(Checksum::default().to_string().len(), Checksum::LETTERS);
    }
}
