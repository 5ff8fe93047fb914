//! A progress bar on stderr, shown only where someone can watch it.

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Progress of a known number of equal steps. Shared by reference among threads (rayon workers call [`Progress::step`]);
/// it draws at most 20 times a second. Dropped without [`Progress::finish`], as on an error, it clears itself away.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    what: String,
}

impl Progress {
    /// Starts a bar labelled `what` (e.g. `Monte Carlo`) over `total` steps. It stays hidden when `quiet` is set or
    /// stderr is not a terminal.
    pub fn new(what: &str, total: u64, quiet: bool) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        Self::on(target, what, total)
    }

    fn on(target: ProgressDrawTarget, what: &str, total: u64) -> Self {
        // The templates are constant; were one refused, indicatif's own bar would do.
        let style = ProgressStyle::with_template("{msg} [{bar:32}] {pos}/{len}, {eta} left")
            .map_or_else(|_| ProgressStyle::default_bar(), |style| style.progress_chars("=> "));
        let bar = ProgressBar::with_draw_target(Some(total), target).with_style(style).with_message(what.to_owned());
        Self { bar, what: what.to_owned() }
    }

    /// One step is done.
    pub fn step(&self) {
        self.bar.inc(1);
    }

    /// `steps` more are done.
    pub fn advance(&self, steps: u64) {
        self.bar.inc(steps);
    }

    /// Replaces the bar by one line: what was done, how often, and in what time. Hidden, it prints nothing.
    pub fn finish(self) {
        let summary = format!("{}: {} in {}", self.what, self.bar.position(), HumanDuration(self.bar.elapsed()));
        self.bar.set_style(ProgressStyle::with_template("{msg}").unwrap_or_else(|_| ProgressStyle::default_bar()));
        self.bar.finish_with_message(summary);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::TermLike;
    use rayon::prelude::*;
    use std::{
        io,
        sync::{Arc, Mutex},
    };

    /// Keeps the line under the cursor.
    #[derive(Debug, Clone, Default)]
    struct Screen(Arc<Mutex<String>>);

    impl TermLike for Screen {
        fn width(&self) -> u16 {
            100
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, s: &str) -> io::Result<()> {
            self.write_str(s)
        }
        fn write_str(&self, s: &str) -> io::Result<()> {
            self.0.lock().unwrap().push_str(s);
            Ok(())
        }
        fn clear_line(&self) -> io::Result<()> {
            self.0.lock().unwrap().clear();
            Ok(())
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    fn watched(total: u64) -> (Screen, Progress) {
        let screen = Screen::default();
        let target = ProgressDrawTarget::term_like(Box::new(screen.clone()));
        (screen, Progress::on(target, "Monte Carlo", total))
    }

    #[test]
    fn steps_of_all_workers_count_and_one_line_stays() {
        let (screen, progress) = watched(1000);
        (0..1000).into_par_iter().for_each(|_| progress.step());
        progress.finish();
        let line = screen.0.lock().unwrap().trim_end().to_owned();
        assert!(line.starts_with("Monte Carlo: 1000 in "), "{line}");
        assert!(!line.contains('['), "{line}");
    }

    #[test]
    fn the_bar_tells_how_far_it_is() {
        let (screen, progress) = watched(10);
        progress.advance(5);
        progress.bar.force_draw();
        let line = screen.0.lock().unwrap().clone();
        assert!(line.contains("Monte Carlo") && line.contains("5/10") && line.contains("left"), "{line}");
        drop(progress);
        assert_eq!(screen.0.lock().unwrap().trim(), "");
    }

    #[test]
    fn quiet_is_hidden() {
        let progress = Progress::new("x", 3, true);
        progress.advance(3);
        assert!(progress.bar.is_hidden());
        progress.finish();
    }
}
