//! Errors with the line they are about.

use std::io::Write as _;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use model::system_file::SystemFileError;

/// Show errors with their source lines, and without a backtrace of the program's inside.
pub fn install() {
    // The hook can be set once per process; a second call would come from a test and is harmless.
    let _ = miette::set_hook(Box::new(|_| {
        Box::new(miette::MietteHandlerOpts::new().context_lines(1).tab_width(4).build())
    }));
}

/// An error in a system file as miette shows it.
#[derive(Debug)]
pub struct SystemFileReport {
    error: SystemFileError,
    source: NamedSource<String>,
}

impl From<SystemFileError> for SystemFileReport {
    fn from(error: SystemFileError) -> Self {
        let source = NamedSource::new(error.file(), error.text().to_owned());
        Self { error, source }
    }
}

impl std::fmt::Display for SystemFileReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for SystemFileReport {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        std::error::Error::source(&self.error)
    }
}

impl Diagnostic for SystemFileReport {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        self.error.help().map(|help| Box::new(help) as Box<dyn std::fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.error.span().is_some().then_some(&self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.error.span()?;
        let label = self.error.key().unwrap_or("here").to_owned();
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(label), span))))
    }
}

/// Tell something on standard error. Nobody may be reading there, and then there is nobody to tell that.
pub fn tell(text: impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr(), "{text}");
}
