//! How far a long computation is, on a terminal.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

/// Between two tellings; what is over sooner is not told of at all.
const PAUSE: Duration = Duration::from_millis(200);

/// The cells of the bar.
const WIDTH: usize = 30;

/// Passes items on and draws on stderr how many of them there were, where that is a terminal and stdout is none: rows
/// and bar would run into one another.
pub struct Progress<I> {
    items: I,
    done: usize,
    total: usize,
    what: &'static str,
    told: Option<Instant>,
    is_drawn: bool,
}

impl<I> Progress<I> {
    /// `total` items, called `what`; `is_redirected` where the rows go to a file.
    pub fn over(items: I, total: usize, what: &'static str, is_redirected: bool) -> Self {
        let is_shown = io::stderr().is_terminal() && (is_redirected || !io::stdout().is_terminal());
        Self {
            items,
            done: 0,
            total,
            what,
            told: is_shown.then(Instant::now),
            is_drawn: false,
        }
    }

    fn tell(&mut self) {
        let Some(told) = self.told.as_mut().filter(|told| told.elapsed() >= PAUSE) else {
            return;
        };
        *told = Instant::now();
        self.is_drawn = true;
        // A terminal that is gone needs no telling.
        let _ = write!(io::stderr(), "\r{}", line(self.done, self.total, self.what));
    }
}

/// `[######                        ] 80 of 401 values`
fn line(done: usize, total: usize, what: &str) -> String {
    let full = done.min(total) * WIDTH / total.max(1);
    format!(
        "[{}{}] {done} of {total} {what}",
        "#".repeat(full),
        " ".repeat(WIDTH - full)
    )
}

impl<I: Iterator> Iterator for Progress<I> {
    type Item = I::Item;

    fn next(&mut self) -> Option<I::Item> {
        let item = self.items.next();
        if item.is_some() {
            self.done += 1;
            self.tell();
        }
        item
    }
}

impl<I> Drop for Progress<I> {
    fn drop(&mut self) {
        if self.is_drawn {
            // Messages that follow begin on a clean line.
            let blank = " ".repeat(line(self.done, self.total, self.what).len());
            let _ = write!(io::stderr(), "\r{blank}\r");
        }
    }
}

/// One line on stderr about a computation without a number of steps, where that is a terminal.
pub struct Status {
    told: Option<Instant>,
    /// The characters that are drawn.
    drawn: usize,
}

impl Status {
    /// Nothing is drawn yet.
    pub fn new() -> Self {
        Self {
            told: io::stderr().is_terminal().then(Instant::now),
            drawn: 0,
        }
    }

    /// Draws a line in the place of the last one, where that is long enough ago.
    pub fn show(&mut self, line: impl FnOnce() -> String) {
        let Some(told) = self.told.as_mut().filter(|told| told.elapsed() >= PAUSE) else {
            return;
        };
        *told = Instant::now();
        let line = line();
        let _ = write!(io::stderr(), "\r{line:<width$}", width = self.drawn);
        self.drawn = self.drawn.max(line.chars().count());
    }
}

impl Drop for Status {
    fn drop(&mut self) {
        if self.drawn > 0 {
            let _ = write!(io::stderr(), "\r{}\r", " ".repeat(self.drawn));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_is_full_at_the_end_and_never_wider() {
        assert_eq!(
            line(401, 401, "values"),
            format!("[{}] 401 of 401 values", "#".repeat(WIDTH))
        );
        assert!(line(0, 0, "values").starts_with("[ ") && line(9, 3, "values").len() < WIDTH + 30);
    }

    #[test]
    fn every_item_is_passed_on() {
        let told: Vec<i32> = Progress::over(0..5, 5, "values", false).collect();
        assert_eq!(told, [0, 1, 2, 3, 4]);
    }
}
