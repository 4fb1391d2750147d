//! A stage on the CPU: its twin, and how what it writes is compared with the GPU.

use super::bindings::Twin;
use super::compare::Rule;
use super::rules::{strata, WEIGHTED};
use super::texels::Texels;

/// A stage on the CPU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CpuStage {
    /// The twin.
    pub twin: Twin,
    /// Rules by which the bindings that it writes are compared, in no particular order. Some have several, all of which must hold. A
    /// stage of a host has none: see [`compare_host_stage`].
    pub rules: &'static [Rule],
}

impl CpuStage {
    /// The function of a host.
    #[cfg(feature = "host-stages")]
    pub(crate) const fn of_host(twin: Twin) -> Self {
        Self { twin, rules: &[] }
    }

    /// Compares what the GPU and the twin wrote to one binding of a pass, in a picture of `pixels`. `constants` are the
    /// specialisation constants of the pass: they say how large strata are, and which rules hold.
    ///
    /// # Errors
    /// A message that names the binding, with the number of texels that differ and the first of them; or says that there is no rule.
    pub(crate) fn compare(
        &self,
        binding: &str,
        constants: &[(&str, u32)],
        pixels: [u32; 2],
        gpu: &Texels,
        twin: &Texels,
    ) -> Result<(), String> {
        let stratum_size = constants.iter().find(|c| c.0 == "STRATUM_SIZE").map_or(1, |c| c.1);
        let mut rules = self.rules.iter().filter(|rule| rule.binding == binding && rule.holds(constants)).peekable();
        if rules.peek().is_none() {
            return Err(format!("there is no rule by which `{binding}` is compared"));
        }
        rules.try_for_each(|rule| rule.compare(stratum_size, pixels, gpu, twin))
    }
}

/// Compares the output of a host's stage, one texel for every `divisor` × `divisor` pixels: half floats whose weights have the
/// device's own precision.
pub(super) fn compare_host_stage(divisor: u32, pixels: [u32; 2], gpu: &Texels, twin: &Texels) -> Result<(), String> {
    strata("its output", WEIGHTED).compare(divisor, pixels, gpu, twin)
}

#[cfg(test)]
mod tests {
    use super::super::compare::{Condition, Tolerance};
    use super::super::rules::{pixels, EXACT};
    use super::super::Image;
    use super::*;

    const RULES: &[Rule] = &[
        Rule { when: Condition::IsNot("SOURCE", 1), ..strata("gradient", EXACT) },
        Rule { when: Condition::Is("SOURCE", 1), ..strata("gradient", Tolerance { outliers: 0.1, ..EXACT }) },
        pixels("display", EXACT),
    ];

    fn stage() -> CpuStage {
        CpuStage { twin: |_| Ok(()), rules: RULES }
    }

    #[test]
    fn a_constant_may_choose_the_rule() {
        let grey = |l: f32| {
            let mut image = Image::new([4, 4], [1.0; 4]);
            *image.get_mut(1, 1).expect("inside") = [l; 4];
            Texels::Colour(image)
        };
        let compare =
            |source| stage().compare("gradient", &[("SOURCE", source), ("STRATUM_SIZE", 3)], [12, 12], &grey(1.0), &grey(2.0));
        assert!(compare(1).is_ok(), "one stratum of sixteen may differ");
        let message = compare(0).expect_err("none may");
        assert!(message.contains("gradient") && message.contains("1,1"), "{message}");
    }

    #[test]
    fn what_has_no_rule_is_not_equal() {
        let texels = Texels::Scalar(Image::new([1, 1], 0.0));
        let message = stage().compare("output_0", &[], [1, 1], &texels, &texels);
        assert!(message.expect_err("no rule").contains("output_0"));
    }
}
