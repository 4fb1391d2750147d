//! Colours of the views and their meaning as plain data: for a legend beside the picture.

use crate::DebugView;

/// Frames at the end of the colours of histories.
pub(super) const LONG_HISTORY: f32 = 32.0;
/// Degrees at the end of the colours of lobes.
pub(super) const WIDEST_LOBE: f32 = 45.0;
/// Pixels at the end of the colours of motion.
pub(super) const LARGE_MOTION: f32 = 64.0;
/// Pixels at the end of the colours of penumbrae.
pub(super) const WIDE_PENUMBRA: f32 = 16.0;
/// The deviation in the middle of the colours.
pub(super) const MIDDLE_DEVIATION: f32 = 0.25;
/// sRGB colours of the disocclusion reasons: history, off screen, background or id, depth, normal, reset. Okabe and Ito's.
pub(super) const REASON_COLOURS: [[u8; 3]; 6] =
    [[60, 60, 60], [230, 159, 0], [86, 180, 233], [0, 158, 115], [240, 228, 66], [213, 94, 0]];
/// Pasts of a reflection, linear: where the surface was, where the image was.
pub(super) const PASTS: [[f32; 3]; 2] = [[0.8, 0.35, 0.02], [0.05, 0.3, 0.8]];
/// Viridis (van der Walt, Smith 2015) at nine places, sRGB.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];

/// The meaning of the colours of a view.
#[derive(Clone, Copy, Debug)]
pub struct ViewLegend {
    /// Colours of numbers. Several are mixed in a pixel: one per channel or direction.
    pub ramps: &'static [Ramp],
    /// Colours of cases in 8-bit sRGB.
    pub cases: &'static [(&'static str, [u8; 3])],
    /// A note beyond ramps and cases; may be empty.
    pub note: &'static str,
}

/// Colours of a range of numbers.
#[derive(Clone, Copy, Debug)]
pub struct Ramp {
    /// The number and its unit.
    pub name: &'static str,
    /// Numbers along the ramp, from place 0 to place 1. Those beyond have the colour of the end.
    pub marks: &'static [(f32, &'static str)],
    colour: fn(f32) -> [f32; 3],
}

impl Ramp {
    /// The colour at a place, 0 to 1: display-referred, linear.
    pub fn colour(&self, place: f32) -> [f32; 3] {
        (self.colour)(place.clamp(0.0, 1.0))
    }
}

impl DebugView {
    /// The meaning of the view's colours.
    pub const fn legend(self) -> ViewLegend {
        const UNIT: &[(f32, &str)] = &[(0.0, "0"), (0.5, "0.5"), (1.0, "1")];
        const OPEN: &[(f32, &str)] = &[(0.0, "0"), (0.5, "1"), (0.9, "9"), (1.0, "")];
        const AXIS: &[(f32, &str)] = &[(0.0, "-1"), (0.5, "0"), (1.0, "1")];
        const PIXELS: &[(f32, &str)] = &[(0.0, "-64"), (0.213, "-10"), (0.5, "0"), (0.787, "10"), (1.0, "64")];
        const fn false_coloured(name: &'static str, marks: &'static [(f32, &'static str)]) -> Ramp {
            Ramp { name, marks, colour: false_colour }
        }
        const fn channel(name: &'static str, marks: &'static [(f32, &'static str)], colour: fn(f32) -> [f32; 3]) -> Ramp {
            Ramp { name, marks, colour }
        }
        let ramps: &'static [Ramp] = match self {
            Self::HistoryLength => {
                const { &[false_coloured("history, frames", &[(0.0, "0"), (0.25, "8"), (0.5, "16"), (1.0, "32+")])] }
            }
            Self::Deviation => {
                const { &[false_coloured("deviation of luminance", &[(0.0, "0"), (0.5, "0.25"), (0.8, "1"), (1.0, "")])] }
            }
            Self::MeanAndDeviation => {
                const { &[channel("mean luminance", OPEN, |t| [t, 0.0, 0.0]), channel("its deviation", OPEN, |t| [0.0, t, 0.0])] }
            }
            Self::Gradient => {
                const { &[channel("darker, brighter: change / brighter one", AXIS, |place| gradient_colour(2.0 * place - 1.0))] }
            }
            Self::Lambda => const { &[false_coloured("lambda, history that is dropped", UNIT)] },
            Self::Alpha => const { &[false_coloured("alpha, weight of the new sample", UNIT)] },
            Self::Percentiles => {
                const {
                    &[
                        channel("low percentile of luminance", OPEN, |t| [t, 0.0, 0.0]),
                        channel("upper one", OPEN, |t| [0.0, t, 0.0]),
                        channel("upper one of the second signal", OPEN, |t| [0.0, 0.0, t]),
                    ]
                }
            }
            Self::Fireflies => const { &[false_coloured("share of luminance taken away", UNIT)] },
            Self::ReflectionHistory => {
                const { &[channel("past of specular light", &[(0.0, "surface"), (0.5, "half"), (1.0, "image")], past_colour)] }
            }
            Self::Visibility => const { &[false_coloured("visibility", UNIT)] },
            Self::Penumbra => {
                const { &[false_coloured("radius of the penumbra, pixels", &[(0.0, "0"), (0.25, "4"), (0.5, "8"), (1.0, "16+")])] }
            }
            Self::Motion | Self::VirtualMotion => {
                const {
                    &[
                        channel("was left, right, pixels", PIXELS, |place| {
                            motion_colour([(place - 0.5).signum(), 0.0], (2.0 * place - 1.0).abs())
                        }),
                        channel("was above, below, pixels", PIXELS, |place| {
                            motion_colour([0.0, (place - 0.5).signum()], (2.0 * place - 1.0).abs())
                        }),
                    ]
                }
            }
            Self::Normal => {
                const {
                    &[
                        channel("x", AXIS, |t| [t, 0.5, 0.5]),
                        channel("y", AXIS, |t| [0.5, t, 0.5]),
                        channel("z", AXIS, |t| [0.5, 0.5, t]),
                    ]
                }
            }
            Self::Depth => const { &[false_coloured("linear depth, scene units", OPEN)] },
            Self::HitDistance => const { &[false_coloured("distance / (distance + depth)", UNIT)] },
            Self::LobeAngle => const { &[false_coloured("half angle, degrees", &[(0.0, "0"), (0.5, "22.5"), (1.0, "45+")])] },
            Self::Disocclusion | Self::SurfaceId | Self::BadValues => &[],
        };
        let (cases, note): (&'static [_], _) = match self {
            Self::Disocclusion => (
                const {
                    &[
                        ("history", REASON_COLOURS[0]),
                        ("off screen", REASON_COLOURS[1]),
                        ("other id", REASON_COLOURS[2]),
                        ("depth", REASON_COLOURS[3]),
                        ("normal", REASON_COLOURS[4]),
                        ("reset", REASON_COLOURS[5]),
                    ]
                },
                "",
            ),
            Self::SurfaceId => (&[], "a colour for each id of 8 bits"),
            Self::BadValues => (
                const { &[("values that are not finite", REASON_COLOURS[5])] },
                "from the top: depth, normal, motion, radiance, albedo, emission, forward motion, scattering depth, roughness, \
                 hit distance, visibility, occluder; 0 to all pixels, logarithmic",
            ),
            Self::HitDistance => (&[], "black: not known"),
            Self::ReflectionHistory => (const { &[("none", REASON_COLOURS[5])] }, ""),
            Self::Penumbra => (&[], "black: no occluder"),
            _ => (&[], ""),
        };
        ViewLegend { ramps, cases, note }
    }
}

/// Linear values of a colour in sRGB, 0 to 255. No component lies in the linear part of the curve but black, where this is 0.0009.
pub(super) fn from_srgb(colour: [f32; 3]) -> [f32; 3] {
    colour.map(|c| ((c / 255.0 + 0.055) / 1.055).powf(2.4))
}

pub(super) fn false_colour(t: f32) -> [f32; 3] {
    let x = t.clamp(0.0, 1.0) * 8.0;
    let i = (x as usize).min(7);
    let f = x - i as f32;
    from_srgb([0, 1, 2].map(|c| f32::from(VIRIDIS[i][c]) * (1.0 - f) + f32::from(VIRIDIS[i + 1][c]) * f))
}

/// Red where it became brighter, blue where it became darker; `t` from -1 to 1.
pub(super) fn gradient_colour(t: f32) -> [f32; 3] {
    [t.max(0.0), 0.15 * t.abs(), (-t).max(0.0)]
}

/// Of a past of which this share comes from where the image was.
pub(super) fn past_colour(share: f32) -> [f32; 3] {
    let [surface, image] = PASTS;
    [0, 1, 2].map(|c| surface[c] * (1.0 - share) + image[c] * share)
}

/// Of a motion with a length of `t` on the logarithmic scale, 0 to 1.
pub(super) fn motion_colour([x, y]: [f32; 2], t: f32) -> [f32; 3] {
    [0.5 + 0.5 * t * x, 0.5 + 0.5 * t * y, 0.5 - 0.5 * t]
}
