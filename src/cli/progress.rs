//! Progress of a long computation, on a terminal or for a program that asks.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::{Cell, RefCell};
use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The time before anything is drawn: a short computation shows nothing.
const PAUSE: Duration = Duration::from_millis(200);

thread_local! {
    /// True while a bar exists: a computation within another draws none.
    static IS_TAKEN: Cell<bool> = const { Cell::new(false) };
    /// Receives the steps of the next bar of this thread.
    static WATCH: RefCell<Option<Arc<Watch>>> = const { RefCell::new(None) };
}

/// The steps of a bar, counted for another thread.
#[derive(Debug, Default)]
pub struct Watch {
    done: AtomicU64,
    total: AtomicU64,
}

impl Watch {
    /// Returns the steps that are done and their total, once a bar exists.
    pub fn seen(&self) -> Option<(u64, u64)> {
        let total = self.total.load(Ordering::Relaxed);
        (total > 0).then(|| (self.done.load(Ordering::Relaxed).min(total), total))
    }

    /// Runs `work`; the first bar that it makes counts here.
    pub fn during<R>(self: &Arc<Self>, work: impl FnOnce() -> R) -> R {
        /// Removes the watch, after a panic as well.
        struct End;
        impl Drop for End {
            fn drop(&mut self) {
                WATCH.set(None);
            }
        }
        let _end = End;
        WATCH.set(Some(Arc::clone(self)));
        work()
    }
}

/// A bar or a line on stderr, where that is a terminal; removed when it is dropped.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
    is_shown: bool,
    watch: Option<Arc<Watch>>,
}

impl Progress {
    /// A bar of `total` steps, called `what`, with the time left.
    pub fn bar(total: usize, what: &'static str) -> Self {
        let style = ProgressStyle::with_template("[{bar:30}] {pos} of {len} {msg}, about {eta} left");
        let style = style.map(|style| style.progress_chars("## "));
        Self::new(
            Some(total as u64),
            style.unwrap_or_else(|_| ProgressStyle::default_bar()),
            what,
        )
    }

    /// A line about a computation without a number of steps.
    pub fn line() -> Self {
        let style = ProgressStyle::with_template("{msg}");
        Self::new(None, style.unwrap_or_else(|_| ProgressStyle::default_spinner()), "")
    }

    fn new(total: Option<u64>, style: ProgressStyle, what: &'static str) -> Self {
        let bar = ProgressBar::with_draw_target(total, ProgressDrawTarget::hidden());
        let is_shown = io::stderr().is_terminal() && !IS_TAKEN.replace(true);
        let watch = total.and_then(|total| {
            let watch = WATCH.take()?;
            watch.total.store(total, Ordering::Relaxed);
            Some(watch)
        });
        Self {
            bar: bar.with_style(style).with_message(what),
            start: Instant::now(),
            is_shown,
            watch,
        }
    }

    /// Nothing is drawn where the rows go to the terminal meanwhile: rows and bar would run into one another.
    pub fn beside_rows(mut self, are_redirected: bool) -> Self {
        if self.is_shown && !are_redirected && io::stdout().is_terminal() {
            self.is_shown = false;
            IS_TAKEN.set(false);
        }
        self
    }

    /// Goes on by one step.
    pub fn step(&self) {
        self.draw();
        self.bar.inc(1);
        if let Some(watch) = &self.watch {
            watch.done.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// Shows a line in the place of the last one.
    pub fn show(&self, line: impl FnOnce() -> String) {
        self.draw();
        if !self.bar.is_hidden() {
            self.bar.set_message(line());
        }
    }

    /// Passes items on, each of them a step.
    pub fn over<I: Iterator>(self, items: I) -> impl Iterator<Item = I::Item> {
        items.inspect(move |_| self.step())
    }

    fn draw(&self) {
        if self.is_shown && self.bar.is_hidden() && self.start.elapsed() >= PAUSE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
        if self.is_shown {
            IS_TAKEN.set(false);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_a_step_and_is_passed_on() {
        let progress = Progress::bar(5, "values");
        let bar = progress.bar.clone();
        let told: Vec<i32> = progress.over(0..5).collect();
        assert_eq!((told, bar.position()), (vec![0, 1, 2, 3, 4], 5));
    }

    #[test]
    fn the_first_bar_alone_is_counted() {
        let watch = Arc::new(Watch::default());
        assert_eq!(watch.seen(), None);
        watch.during(|| {
            let bar = Progress::bar(3, "claims");
            bar.step();
            Progress::bar(7, "points").step();
        });
        Progress::bar(9, "points").step();
        assert_eq!(watch.seen(), Some((1, 3)));
    }
}
