//! The stage `atrous` \[SVGF 4.3, eq. 1 to 5\]: one level of the edge-avoiding wavelet filter, of irradiance and of its variance.

use super::kernel::Kernel;
use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::geometry_weights::Geometry;
use crate::reference::luminance::texel_luminance;
use crate::reference::rules::FILTERED;
use crate::reference::{render_rect::RenderRect, Image};
#[cfg(test)]
use crate::Tuning;
use crate::{Error, FrameConstants};
use glam::IVec2;
use lobes::Lobes;

#[cfg(test)]
mod edge_tests;
mod lobes;
#[cfg(test)]
mod tests;

/// Tolerated difference of luminance where the variance is 0.
pub(crate) const LUMINANCE_EPSILON: f32 = 1e-4;
/// Share of the tap's deviation in the tolerance, where it has one.
const TAP_SHARE: f32 = 0.25;

/// Inputs of [`atrous`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
#[cfg(test)]
pub(crate) struct AtrousInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `depth_gradient`, from the stage `import`.
    pub depth_gradient: &'a Image<u32>,
    /// What is seen in the surfaces, for specular light.
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
    /// Whether luminance is compared by the deviation of 3×3 pixels.
    pub smooth_deviation: bool,
    /// Whether a quarter of the tolerance is by the deviation of the tap.
    pub shared_deviation: bool,
}

impl AtrousLevel {
    /// A level of \[SVGF\].
    #[cfg(test)]
    pub(crate) fn new(number: u32) -> Self {
        Self { number, kernel: Kernel::Spline, smooth_deviation: true, shared_deviation: false }
    }
}

/// Filters every signal with the taps of a level; they share the geometry weights. Texels of the result are as those of the input.
#[cfg(test)]
pub(crate) fn atrous(frame: &FrameConstants, tuning: &Tuning, level: AtrousLevel, inputs: &AtrousInputs) -> Vec<Image<[f32; 4]>> {
    let lobes = inputs.reflection.map(|reflection| Lobes::new(frame, tuning, inputs.guide, reflection));
    filter(frame, &Geometry::new(frame, tuning, inputs.guide, inputs.depth_gradient), lobes.as_ref(), level, inputs.irradiance)
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
    // Geometry weights cost the most: they are computed once for the two signals that there can be.
    let mut filtered = Vec::with_capacity(irradiance.len());
    for pair in irradiance.chunks(2) {
        let texels = Image::compute(geometry.extent(), frame.render_extent, |p| {
            let mut sums: [Sum; 2] = std::array::from_fn(|i| Sum::new(geometry, rect, level, pair.get(i).copied(), p));
            if geometry.is_background(p) {
                return sums.map(|sum| sum.centre);
            }
            for (offset, q) in rect.window(p, level.kernel.radius(), step) {
                let Some(h) = level.kernel.weight(level.number, offset.x, offset.y) else { continue };
                let weight = h * geometry.weight(p, q) * lobes.map_or(1.0, |lobes| lobes.weight(p, q));
                if weight > 0.0 {
                    sums.iter_mut().zip(pair).for_each(|(sum, image)| sum.add(weight, p == q, image.at(q)));
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
    /// Deviation by which taps are compared, and the share of it that is theirs.
    deviation: f32,
    tap_share: f32,
    sigma_l: f32,
    weight: f32,
    irradiance: [f32; 3],
    variance: f32,
}

impl Sum {
    fn new(geometry: &Geometry, rect: RenderRect, level: AtrousLevel, image: Option<&Image<[f32; 4]>>, p: IVec2) -> Self {
        let Some(image) = image else { return Self::default() };
        let centre = image.at(p);
        if geometry.is_background(p) {
            return Self { centre, ..Self::default() };
        }
        let deviation = if level.smooth_deviation { blurred_deviation(rect, image, p) } else { centre[3] };
        Self {
            centre,
            luminance: texel_luminance(centre),
            deviation,
            tap_share: if level.shared_deviation { TAP_SHARE } else { 0.0 },
            sigma_l: geometry.sigma_l,
            ..Self::default()
        }
    }

    fn add(&mut self, geometry_weight: f32, is_centre: bool, texel: [f32; 4]) {
        // [SVGF eq. 5]
        let deviation = self.deviation + self.tap_share * (texel[3] - self.deviation);
        let tolerance = self.sigma_l * deviation + LUMINANCE_EPSILON;
        let weight_l = if is_centre { 1.0 } else { (-(self.luminance - texel_luminance(texel)).abs() / tolerance).exp() };
        let weight = geometry_weight * weight_l;
        self.weight += weight;
        (0..3).for_each(|i| self.irradiance[i] += weight * texel[i]);
        self.variance += weight * weight * texel[3] * texel[3];
    }

    fn mean(&self) -> [f32; 4] {
        if self.weight == 0.0 {
            return [0.0; 4];
        }
        let [r, g, b] = self.irradiance.map(|c| store(c / self.weight));
        [r, g, b, store(self.variance.sqrt() / self.weight)]
    }
}

/// `sqrt(g3x3(σ²))` without the background, whose deviation is negative: neighbours at distance 1 on every level, since it steadies an estimate of one pixel.
fn blurred_deviation(rect: RenderRect, image: &Image<[f32; 4]>, p: IVec2) -> f32 {
    let (mut sum, mut variance) = (0.0, 0.0);
    for (offset, q) in rect.window(p, 1, 1).filter(|(_, q)| image.at(*q)[3] >= 0.0) {
        let weight = 0.25 / (1 << offset.abs().element_sum()) as f32;
        let deviation = image.at(q)[3];
        sum += weight;
        variance += weight * deviation * deviation;
    }
    (variance / f32::max(sum, 0.25)).sqrt()
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = FILTERED;

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let guide = b.packed("guide")?;
    let geometry = match b.is_on("VOLUME")? {
        true => Geometry::of_volume(b.frame, b.tuning, guide),
        false => Geometry::new(b.frame, b.tuning, guide, b.uint("depth_gradient")?),
    };
    let kernel = Kernel::try_from(b.constant("KERNEL")?)?;
    let (smooth_deviation, shared_deviation) = (b.is_on("SMOOTH")?, b.is_on("SHARED")?);
    let level = AtrousLevel { number: b.level, kernel, smooth_deviation, shared_deviation };
    let reflection = b.has("reflection").then(|| b.uint("reflection")).transpose()?;
    let lobes = reflection.map(|reflection| Lobes::new(b.frame, b.tuning, guide, reflection));
    let filtered = filter(b.frame, &geometry, lobes.as_ref(), level, &b.colours("input")?);
    b.write_signals("output", filtered)
}
