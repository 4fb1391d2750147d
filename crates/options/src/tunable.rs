//! A tunable and its number in one word.

use atrous::{Error, Tuning};

/// A tunable and its number, such as `sigma_l=2`: a parser for clap.
///
/// # Errors
/// Text of a different form, a name that no tunable has, which lists them all, and a number out of range.
pub fn tunable(text: &str) -> Result<(String, f32), String> {
    let (name, value) = text.split_once('=').ok_or("give a name and a number, like alpha=0.1")?;
    let (name, value) = (name.trim(), value.trim());
    let value = value.parse().map_err(|_| format!("`{value}` is not a number"))?;
    // Checked here, so that a wrong name is told with the option that has it.
    Tuning::default().set(name, value).map_err(|e| {
        let known = || Tuning::FIELDS.iter().map(|f| format!("{} ({} to {}, default {})", f.name, f.min, f.max, f.default));
        match e {
            Error::UnknownTuning(_) => format!("no tunable `{name}`; there are: {}", known().collect::<Vec<_>>().join(", ")),
            other => other.to_string(),
        }
    })?;
    Ok((name.to_owned(), value))
}

#[cfg(test)]
mod tests {
    use super::tunable;

    #[test]
    fn a_wrong_tunable_is_told_with_what_is_allowed() {
        assert_eq!(tunable("sigma_l=2"), Ok(("sigma_l".to_owned(), 2.0)));
        for (wrong, told) in [
            ("sigma_l", "alpha=0.1"),
            ("sigma_l=much", "`much` is not a number"),
            ("sigma=2", "no tunable `sigma`; there are: "),
            ("sigma=2", "sigma_l ("),
            ("sigma_l=-1", "sigma_l"),
        ] {
            let error = tunable(wrong).expect_err(wrong);
            assert!(error.contains(told), "{wrong}: {error}");
        }
    }
}
