//! What surfaces are made of.

use glam::Vec3;

/// What gives a material its base colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// The base colour alone.
    Plain,
    /// Squares of the base colour and of another one.
    Checker {
        /// The other colour, linear.
        other: Vec3,
        /// Squares for one unit of texture coordinate.
        scale: f32,
    },
    /// Index into `Scene::textures`, multiplied by the base colour.
    Texture(usize),
}

/// How light passes through a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glass {
    /// A thin sheet, which bends nothing.
    Pane,
    /// A closed body, which refracts.
    Body,
}

/// A diffuse base under a dielectric coat, or metal, or a mix of the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Linear reflectance, 0 to 1.
    pub base_color: Vec3,
    /// What varies it over the surface.
    pub pattern: Pattern,
    /// Perceptual roughness, 0 to 1 (below 0.05 counts as 0.05); the GGX alpha is its square.
    pub roughness: f32,
    /// 0: dielectric, 1: metal.
    pub metallic: f32,
    /// Reflectance of the coat at normal incidence: 0.04 for plastic, 0 for no coat.
    pub specular: f32,
    /// Emitted radiance, linear.
    pub emission: Vec3,
    /// Index into `Scene::textures`, multiplied by the emission.
    pub emission_texture: Option<usize>,
    /// Emits on both sides; otherwise only on the side that the triangles' winding faces.
    pub two_sided_emission: bool,
    /// Sprays of leaves: what lies between them in the unit square of texture coordinates is not there.
    pub leaves: bool,
    /// Clear glass, tinted by the base colour. Light that is scattered passes as if a body were not there, and is coloured by panes on its way from
    /// lamps.
    pub glass: Option<Glass>,
}

impl Material {
    /// Lambert.
    pub fn diffuse(base_color: Vec3) -> Self {
        Self {
            base_color,
            pattern: Pattern::Plain,
            roughness: 1.0,
            metallic: 0.0,
            specular: 0.0,
            emission: Vec3::ZERO,
            emission_texture: None,
            two_sided_emission: false,
            leaves: false,
            glass: None,
        }
    }

    /// GGX metal.
    pub fn metal(base_color: Vec3, roughness: f32) -> Self {
        Self { roughness, metallic: 1.0, ..Self::diffuse(base_color) }
    }

    /// Lambert under a GGX coat.
    pub fn plastic(base_color: Vec3, roughness: f32) -> Self {
        Self { roughness, specular: 0.04, ..Self::diffuse(base_color) }
    }

    /// Clear glass.
    pub fn glass(kind: Glass, tint: Vec3) -> Self {
        Self { glass: Some(kind), specular: 0.04, roughness: 0.0, ..Self::diffuse(tint) }
    }

    /// A lamp.
    pub fn emitter(emission: Vec3) -> Self {
        Self { emission, ..Self::diffuse(Vec3::splat(0.7)) }
    }

    /// The same with a checker of two colours.
    pub fn with_checker(self, other: Vec3, scale: f32) -> Self {
        Self { pattern: Pattern::Checker { other, scale }, ..self }
    }
}

/// An sRGB picture; alpha is not used.
#[derive(Clone, Debug)]
pub struct Texture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row by row from the top, red in the lowest byte.
    pub texels: Vec<u32>,
}
