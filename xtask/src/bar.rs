//! How far a run has come: a bar on a terminal, nothing in a pipe.

use std::sync::Mutex;

use indicatif::{ProgressBar, ProgressStyle};
use ogm_eval::Watch;

/// The bar of the current stage.
#[derive(Debug, Default)]
pub(crate) struct Bar(Mutex<Option<ProgressBar>>);

impl Bar {
    fn with(&self, use_it: impl FnOnce(&mut Option<ProgressBar>)) {
        if let Ok(mut bar) = self.0.lock() {
            use_it(&mut bar);
        }
    }
}

impl Watch for Bar {
    fn begin(&self, label: &'static str, length: u64) {
        let style = ProgressStyle::with_template("{msg:24} {wide_bar} {pos}/{len} {eta}");
        let bar = ProgressBar::new(length).with_message(label);
        let bar = match style {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        };
        self.with(|shown| *shown = Some(bar));
    }

    fn step(&self) {
        self.with(|shown| {
            if let Some(bar) = shown {
                bar.inc(1);
            }
        });
    }

    fn end(&self) {
        self.with(|shown| {
            if let Some(bar) = shown.take() {
                bar.finish_and_clear();
            }
        });
    }
}
