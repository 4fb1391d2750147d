//! The tunables of captures that an older version wrote.

use std::collections::BTreeMap;

/// Tunables that are gone, and the number at which they did nothing.
const GONE: [(&str, f32); 1] = [("edge_falloff", 0.0)];

/// Leaves the tunables that there are. One that is gone and had an effect is an error: the capture would replay as something else.
pub fn without_gone(mut tunables: BTreeMap<String, f32>) -> Result<BTreeMap<String, f32>, String> {
    for (name, without_effect) in GONE {
        if let Some(value) = tunables.remove(name).filter(|value| *value != without_effect) {
            return Err(format!("sets {name} to {value}, and this version has no such tunable; remove it to filter without"));
        }
    }
    Ok(tunables)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_had_no_effect_is_left_out_and_the_rest_is_refused() {
        let of = |value| without_gone([("edge_falloff".to_owned(), value), ("alpha".to_owned(), 0.1)].into_iter().collect());
        assert_eq!(of(0.0), Ok([("alpha".to_owned(), 0.1)].into_iter().collect()));
        let message = of(0.5).expect_err("it had an effect");
        assert!(message.contains("edge_falloff to 0.5") && message.contains("remove it"), "{message}");
    }
}
