//! Options of command lines that are made from the table of the configuration.

use atrous::config::ConfigField;
use atrous::Config;
use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Command};

/// Fields of a configuration as they were given: `--levels 3`. The preset is an option of the program's own, since each has others.
#[derive(Clone, Debug, Default)]
pub struct ConfigArgs(Vec<(&'static str, String)>);

impl ConfigArgs {
    /// Sets what was given.
    ///
    /// # Errors
    /// Text that is no value of its field.
    pub fn apply(&self, config: &mut Config) -> Result<(), atrous::Error> {
        self.0.iter().try_for_each(|(name, text)| config.set(name, text))
    }
}

fn fields() -> impl Iterator<Item = &'static ConfigField> {
    Config::FIELDS.iter().filter(|field| field.name == "signals" || (field.is_of_filter && field.name != "preset"))
}

impl clap::Args for ConfigArgs {
    fn augment_args(command: Command) -> Command {
        fields().fold(command, |command, field| {
            // It lives as long as the program, as the names of the other options do.
            let long: &'static str = field.name.replace('_', "-").leak();
            let option = Arg::new(field.name).long(long).help(field.text());
            let values = (field.values)();
            command.arg(match values.is_empty() {
                true => option.value_name("VALUE"),
                false => option.value_parser(PossibleValuesParser::new(values.into_iter().map(|(name, _)| name))),
            })
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl clap::FromArgMatches for ConfigArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |field: &ConfigField| Some((field.name, matches.get_one::<String>(field.name)?.clone()));
        Ok(Self(fields().filter_map(given).collect()))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        self.0.extend(Self::from_arg_matches(matches)?.0);
        Ok(())
    }
}
