//! Fields of the configuration.

use atrous::config::ConfigField;
use atrous::Config;
use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Command};

/// Fields of a configuration as they were given: `--levels 3`. The preset is an option of the program's own, since each has others.
#[derive(Clone, Debug, Default)]
pub struct ConfigArgs(Vec<(&'static str, String)>);

impl ConfigArgs {
    /// One field, by its name in the table, as if it were given as an option.
    pub fn of(field: &'static str, text: &str) -> Self {
        Self(vec![(field, text.to_owned())])
    }

    /// Sets what was given.
    ///
    /// # Errors
    /// Text that is no value of its field.
    pub fn apply(&self, config: &mut Config) -> Result<(), atrous::Error> {
        self.0.iter().try_for_each(|(name, text)| config.set(name, text))
    }

    /// Whether a field was given.
    pub fn has(&self, field: &str) -> bool {
        self.0.iter().any(|(name, _)| *name == field)
    }

    /// Fields that were given, with their text.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.0.iter().map(|(name, text)| (*name, text.as_str()))
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

#[cfg(test)]
mod tests {
    use super::ConfigArgs;
    use atrous::config::Signals;
    use atrous::Config;
    use clap::{Args, Command, FromArgMatches};

    fn parse(words: &[&str]) -> Result<ConfigArgs, clap::Error> {
        let matches = ConfigArgs::augment_args(Command::new("program")).try_get_matches_from([&["program"], words].concat())?;
        ConfigArgs::from_arg_matches(&matches)
    }

    #[test]
    fn fields_that_were_given_are_set_and_no_others() {
        let given = parse(&["--levels", "3", "--signals", "apart"]).expect("both exist");
        let mut config = Config { stratum_size: 2, ..Config::new([64, 32]) };
        given.apply(&mut config).expect("both are values");
        assert_eq!((config.levels, config.signals, config.stratum_size), (Some(3), Signals::Apart, 2));
        assert!(given.has("levels") && !given.has("stratum_size"));
    }

    #[test]
    fn text_that_is_no_value_is_refused() {
        let error = parse(&["--signals", "many"]).expect_err("no such value").to_string();
        assert!(error.contains("--signals") && error.contains("apart"), "{error}");
        let mut config = Config::new([64, 32]);
        let error = parse(&["--levels", "few"]).expect("checked where it is set").apply(&mut config).expect_err("no number");
        assert!(error.to_string().contains("few"), "{error}");
    }
}
