//! How long the attacks last: quick always, longer where `ATROUS_SOAK` says by how much (scripts/soak.sh).

/// A number of rounds, times `ATROUS_SOAK`.
pub fn times(rounds: u32) -> u32 {
    let Ok(text) = std::env::var("ATROUS_SOAK") else { return rounds };
    rounds * text.parse::<u32>().expect("ATROUS_SOAK is a whole number of 1 or more")
}

/// Whether `ATROUS_SOAK` is set.
pub fn is_on() -> bool {
    std::env::var_os("ATROUS_SOAK").is_some()
}
