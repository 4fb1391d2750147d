//! The stage `atrous` \[SVGF 4.3, eq. 1 to 5\]: one level of the edge-avoiding wavelet filter, of irradiance and of its variance.

use super::kernel::Kernel;
use super::LuminanceWeight;
use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::geometry_weights::Geometry;
use crate::reference::luminance::texel_luminance;
use crate::reference::rare_light::{is_rare, marked};
use crate::reference::rules::{pixels, rare_light, rounded, WEIGHTED};
use crate::reference::{render_rect::RenderRect, Image};
#[cfg(test)]
use crate::Tuning;
use crate::{Error, FrameConstants};
use glam::{IVec2, Vec4};
use lobes::Lobes;

#[cfg(test)]
mod edge_tests;
mod lobes;
#[cfg(test)]
mod specular_tests;
#[cfg(test)]
mod tests;

/// Tolerated difference of luminance where the variance is 0.
pub(crate) const LUMINANCE_EPSILON: f32 = 1e-4;
/// Of the tolerated deviation by that of the tap: a pixel that rare light never hit takes some of what was hit.
const TAP_SHARE: f32 = 0.38;
/// Of the weight that a difference of luminance takes from a tap, the part that stays on the centre.
const KEPT_SHARE: f32 = 0.5;
/// The most that a difference of hue counts, over the luminance of the centre.
const MOST_OF_HUE: f32 = 2.0;

/// Inputs of [`atrous`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
#[cfg(test)]
pub(crate) struct AtrousInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// What is seen in the surfaces, if the last signal is specular light.
    pub reflection: Option<&'a Image<u32>>,
    /// Irradiance of every signal in rgb, standard deviation of its luminance in alpha.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
}

/// One level of the filter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AtrousLevel {
    /// Number of the level: taps are `2^number` pixels apart, those of a box as [`Kernel::Box`] says.
    pub number: u32,
    /// Kernel.
    pub kernel: Kernel,
    /// Weight by luminance.
    pub luminance_weight: LuminanceWeight,
    /// Whether the last signal is specular light alone, whose deviation says whether light is rare.
    pub is_marked: bool,
}

impl AtrousLevel {
    /// A level of \[SVGF\].
    #[cfg(test)]
    pub(crate) fn new(number: u32) -> Self {
        Self { number, kernel: Kernel::Spline, luminance_weight: LuminanceWeight::Published, is_marked: false }
    }
}

/// Filters every signal with the taps of a level; they share the geometry weights. Texels of the result are as those of the input.
#[cfg(test)]
pub(crate) fn atrous(frame: &FrameConstants, tuning: &Tuning, level: AtrousLevel, inputs: &AtrousInputs) -> Vec<Image<[f32; 4]>> {
    let lobes = inputs.reflection.map(|reflection| Lobes::new(frame, tuning, inputs.guide, reflection));
    filter(frame, &Geometry::new(frame, tuning, inputs.guide), lobes.as_ref(), level, inputs.irradiance)
}

/// [`atrous`] for the radiance of a volume before the surfaces of `guide`: weights by the depth behind alone, and no background
/// \[PSVGF\].
#[cfg(test)]
pub(crate) fn volume_atrous(
    frame: &FrameConstants,
    tuning: &Tuning,
    level: AtrousLevel,
    guide: &Image<[u16; 4]>,
    radiance: &Image<[f32; 4]>,
) -> Image<[f32; 4]> {
    let mut filtered = filter(frame, &Geometry::of_volume(frame, tuning, guide), None, level, &[radiance]);
    filtered.pop().unwrap_or_else(|| radiance.clone())
}

fn filter(
    frame: &FrameConstants,
    geometry: &Geometry,
    lobes: Option<&Lobes>,
    level: AtrousLevel,
    irradiance: &[&Image<[f32; 4]>],
) -> Vec<Image<[f32; 4]>> {
    let rect = RenderRect::new(frame.render_extent);
    let step = level.kernel.step(level.number);
    let mut filtered = Vec::with_capacity(irradiance.len());
    for pair in irradiance.chunks(2) {
        let texels = Image::compute(geometry.extent(), frame.render_extent, |p| {
            let centre = |i: usize| pair.get(i).map_or([0.0; 4], |image| image.at(p));
            if geometry.is_background(p) {
                return [centre(0), centre(1)];
            }
            // Specular light is the last signal.
            let lobes_of = |i: usize| lobes.filter(|_| i + 1 == pair.len());
            let shown = |i, q| geometry.weight(p, q) * lobes_of(i).map_or(1.0, |lobes| lobes.weight(p, q));
            let mut sums: [Sum; 2] = std::array::from_fn(|i| {
                let tolerated = lobes_of(i).filter(|_| level.is_marked).map(|lobes| lobes.tolerated(p, centre(i)[3]));
                let variance = pair.get(i).map_or(0.0, |image| match level.luminance_weight {
                    LuminanceWeight::Published => variance_beside(rect, image, p),
                    LuminanceWeight::OfMeans => {
                        variance_of_taps(rect, p, step, |q| counted_deviation(image.at(q)[3], tolerated), |q| shown(i, q))
                    }
                });
                Sum::new(centre(i), variance.sqrt(), tolerated, level.luminance_weight, geometry.sigma_l(p))
            });
            for (offset, q) in rect.window(p, level.kernel.radius(), step) {
                let kernel = level.kernel.weight(offset.x, offset.y);
                for (i, (sum, image)) in sums.iter_mut().zip(pair).enumerate() {
                    let weight = kernel * shown(i, q);
                    if weight > 0.0 {
                        sum.add(weight, p == q, image.at(q));
                    }
                }
            }
            sums.map(|sum| sum.mean())
        });
        filtered.extend((0..pair.len()).map(|i| texels.map(|t| t[i])));
    }
    filtered
}

/// The sums of eq. 1 for one signal of one pixel.
#[derive(Clone, Copy, Default)]
struct Sum {
    centre: [f32; 4],
    luminance: f32,
    /// Deviation by which taps are compared.
    deviation: f32,
    /// Of specular light, the largest deviation of a tap that counts where light is not rare.
    tolerated: Option<f32>,
    luminance_weight: LuminanceWeight,
    sigma_l: f32,
    weight: f32,
    irradiance: [f32; 3],
    variance: f32,
    /// Weight of the centre, and what stays on it besides.
    centre_weight: f32,
    kept: f32,
}

impl Sum {
    fn new(centre: [f32; 4], deviation: f32, tolerated: Option<f32>, luminance_weight: LuminanceWeight, sigma_l: f32) -> Self {
        Self { centre, luminance: texel_luminance(centre), deviation, tolerated, luminance_weight, sigma_l, ..Self::default() }
    }

    fn add(&mut self, geometry_weight: f32, is_centre: bool, texel: [f32; 4]) {
        let share = if is_centre { 1.0 } else { self.share_of(texel) };
        if is_centre {
            self.centre_weight = geometry_weight;
        }
        if self.luminance_weight == LuminanceWeight::OfMeans {
            self.kept += KEPT_SHARE * geometry_weight * (1.0 - share);
        }
        self.add_weighted(geometry_weight * share, texel);
    }

    /// The share of its weight that luminance leaves a tap \[SVGF eq. 5\].
    fn share_of(&self, texel: [f32; 4]) -> f32 {
        let difference = (self.luminance - texel_luminance(texel)).abs();
        let tolerance = |deviation: f32| self.sigma_l * deviation + LUMINANCE_EPSILON;
        match self.luminance_weight {
            LuminanceWeight::Published => (-difference / tolerance(self.deviation)).exp(),
            LuminanceWeight::OfMeans => {
                let difference = if self.tolerated.is_some() { difference.max(self.difference_of_hue(texel)) } else { difference };
                let tap = counted_deviation(texel[3], self.tolerated);
                let x = difference / tolerance(self.deviation + TAP_SHARE * (tap - self.deviation));
                (-0.5 * x * x).exp()
            }
        }
    }

    /// Things in a mirror may be as bright as each other. Of what is dark a hue says little.
    fn difference_of_hue(&self, texel: [f32; 4]) -> f32 {
        let hue = Vec4::from(self.centre).truncate() / self.luminance.max(1e-12);
        let of_hue = Vec4::from(texel).truncate() - texel_luminance(texel) * hue;
        of_hue.length().min(MOST_OF_HUE * self.luminance)
    }

    fn add_weighted(&mut self, weight: f32, texel: [f32; 4]) {
        self.weight += weight;
        (0..3).for_each(|i| self.irradiance[i] += weight * texel[i]);
        self.variance += weight * weight * texel[3] * texel[3];
    }

    fn mean(mut self) -> [f32; 4] {
        if self.weight == 0.0 {
            return [0.0; 4];
        }
        let own = self.centre_weight;
        self.add_weighted(self.kept, self.centre);
        // Weights of the same sample add up before they are squared.
        self.variance += 2.0 * own * self.kept * self.centre[3] * self.centre[3];
        let [r, g, b] = self.irradiance.map(|c| store(c / self.weight));
        let deviation = self.variance.sqrt() / self.weight;
        [r, g, b, store(if self.tolerated.is_some() { marked(deviation, is_rare(self.centre[3])) } else { deviation })]
    }
}

/// `g3x3(σ²)` without the background, whose deviation is negative: neighbours at distance 1 on every level, since it steadies an estimate of one pixel.
fn variance_beside(rect: RenderRect, image: &Image<[f32; 4]>, p: IVec2) -> f32 {
    let deviation = |q| image.at(q)[3];
    let (sum, variance) = blurred_variance(rect, p, 1, deviation, |q| if deviation(q) >= 0.0 { 1.0 } else { 0.0 });
    variance / f32::max(sum, 0.25)
}

/// The same over the taps around, by how far they show the surface of the centre.
fn variance_of_taps(rect: RenderRect, p: IVec2, step: i32, deviation: impl Fn(IVec2) -> f32, shown: impl Fn(IVec2) -> f32) -> f32 {
    let (sum, variance) = blurred_variance(rect, p, step, deviation, shown);
    variance / sum
}

/// Sums of weights and of weighted variances with the kernel g3x3.
fn blurred_variance(
    rect: RenderRect,
    p: IVec2,
    step: i32,
    deviation: impl Fn(IVec2) -> f32,
    weight: impl Fn(IVec2) -> f32,
) -> (f32, f32) {
    rect.window(p, 1, step).fold((0.0, 0.0), |(sum, variance), (offset, q)| {
        let (deviation, weight) = (deviation(q), weight(q) * 0.25 / (1 << offset.abs().element_sum()) as f32);
        (sum + weight, variance + weight * deviation * deviation)
    })
}

/// Of a tap: no more than is tolerated of specular light that is not rare.
fn counted_deviation(deviation: f32, tolerated: Option<f32>) -> f32 {
    match tolerated {
        Some(most) if !is_rare(deviation) => deviation.min(most),
        _ => deviation,
    }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] =
    &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED), rounded("output_0"), rounded("output_1"), rare_light("output_1")];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let guide = b.packed("guide")?;
    let geometry = match b.is_on("VOLUME")? {
        true => Geometry::of_volume(b.frame, b.tuning, guide),
        false => Geometry::new(b.frame, b.tuning, guide),
    };
    let geometry = match b.optional_uint("material_class")? {
        Some(classes) => geometry.with_materials(b.frame, b.tuning, classes),
        None => geometry,
    };
    let kernel = Kernel::try_from(b.constant("KERNEL")?)?;
    let luminance_weight = if b.is_on("OURS")? { LuminanceWeight::OfMeans } else { LuminanceWeight::Published };
    let level = AtrousLevel { number: b.level, kernel, luminance_weight, is_marked: b.is_on("MARKED")? };
    let reflection = b.has("reflection").then(|| b.uint("reflection")).transpose()?;
    let lobes = reflection.map(|reflection| Lobes::new(b.frame, b.tuning, guide, reflection));
    let mut filtered = filter(b.frame, &geometry, lobes.as_ref(), level, &b.colours("input")?);
    if b.is_on("LAST")? {
        // What goes out is in the exposure of the host.
        let scale = b.frame.inverse_filter_exposure;
        filtered = filtered.iter().map(|image| image.map(|texel| texel.map(|c| store(c * scale)))).collect();
    }
    b.write_signals("output", filtered)
}
