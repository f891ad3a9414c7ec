//! Names of cases on the command line.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error};

/// Any text: what is no case is told by the registry, with the name that is nearest. Shells
/// complete the names that there are.
#[derive(Debug, Clone)]
pub struct CaseName;

impl TypedValueParser for CaseName {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let value = |(name, about)| PossibleValue::new(name).help(about);
        Some(Box::new(model::cases::named().map(value)))
    }
}
