//! The tunables of captures that an older version wrote.

use std::collections::BTreeMap;

/// Tunables that are gone, and the number at which they did nothing.
const GONE: [(&str, f32); 1] = [("edge_falloff", 0.0)];

/// Names of older versions, and those of today.
const RENAMED: [(&str, &str); 3] =
    [("sigma_rt", "eaw_sigma_radiance"), ("sigma_rt_n", "eaw_sigma_normal"), ("sigma_rt_x", "eaw_sigma_position")];

/// The tunables of a file by the names of today. One that is gone and had an effect is an error: the capture would replay as
/// something else.
pub fn of_today(mut tunables: BTreeMap<String, f32>) -> Result<BTreeMap<String, f32>, String> {
    for (name, without_effect) in GONE {
        if let Some(value) = tunables.remove(name).filter(|value| *value != without_effect) {
            return Err(format!("sets {name} to {value}, and this version has no such tunable; remove it to filter without"));
        }
    }
    for (before, today) in RENAMED {
        if let Some(value) = tunables.remove(before) {
            tunables.entry(today.to_owned()).or_insert(value);
        }
    }
    Ok(tunables)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tunables<const N: usize>(of: [(&str, f32); N]) -> BTreeMap<String, f32> {
        of.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    #[test]
    fn what_had_no_effect_is_left_out_and_the_rest_is_refused() {
        let of = |value| of_today(tunables([("edge_falloff", value), ("alpha", 0.1)]));
        assert_eq!(of(0.0), Ok(tunables([("alpha", 0.1)])));
        let message = of(0.5).expect_err("it had an effect");
        assert!(message.contains("edge_falloff to 0.5") && message.contains("remove it"), "{message}");
    }

    #[test]
    fn an_old_name_is_read_unless_the_new_one_stands_beside_it() {
        let read = of_today(tunables([("sigma_rt", 4.0), ("sigma_rt_n", 0.3), ("eaw_sigma_normal", 0.5)]));
        assert_eq!(read, Ok(tunables([("eaw_sigma_radiance", 4.0), ("eaw_sigma_normal", 0.5)])));
    }
}
