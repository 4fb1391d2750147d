//! Depth, handedness and matrices: the declared geometry, and every other one that is a mistake away.

use atrous::config::{Conventions, DepthEncoding, ViewForward};
use atrous::FrameParams;
use glam::{Mat4, Vec4};

/// Factors between units of length: metres, centimetres, millimetres, decimetres, feet, inches.
const UNITS: [f32; 10] = [0.01, 100.0, 0.001, 1000.0, 0.1, 10.0, 0.3048, 3.280_84, 0.0254, 39.370_08];

/// Depth and matrices as declared, or as they should be.
#[derive(Clone, Debug)]
pub(super) struct Geometry {
    /// The mistake in the declared geometry; empty for the declared one itself.
    pub mistake: &'static str,
    /// The remedy.
    pub remedy: String,
    pub conventions: Conventions,
    /// Factor of the depth, where that is no depth buffer's.
    pub depth_scale: f32,
    pub previous: FrameParams,
    pub current: FrameParams,
}

impl Geometry {
    pub fn declared(conventions: &Conventions, previous: &FrameParams, current: &FrameParams) -> Self {
        Self {
            mistake: "",
            remedy: String::new(),
            conventions: *conventions,
            depth_scale: 1.0,
            previous: *previous,
            current: *current,
        }
    }

    /// Every geometry that is one mistake away, the likelier ones first.
    pub fn alternatives(&self) -> Vec<Self> {
        let mut all = self.depths();
        all.extend(self.handedness());
        all.extend(self.matrices());
        if self.previous.jitter != [0.0; 2] || self.current.jitter != [0.0; 2] {
            all.extend(self.jitters());
        }
        all
    }

    fn depths(&self) -> Vec<Self> {
        let encodings = [
            (DepthEncoding::Linear, "the depth is linear view depth"),
            (DepthEncoding::Device, "the depth is what a depth buffer holds"),
            (DepthEncoding::RayLength, "the depth is the distance along the ray"),
        ];
        let others = encodings.into_iter().filter(|(depth, _)| *depth != self.conventions.depth);
        let mut all: Vec<_> = others
            .map(|(depth, mistake)| {
                let conventions = Conventions { depth, ..self.conventions };
                Self { mistake, remedy: format!("depth: {depth:?}"), conventions, ..self.clone() }
            })
            .collect();
        if self.conventions.depth != DepthEncoding::Device {
            all.extend(UNITS.map(|scale| Self {
                mistake: "the depth is in another unit than the matrices",
                remedy: format!("multiply the depth by {scale}"),
                depth_scale: scale,
                ..self.clone()
            }));
        } else {
            all.push(self.with_clip(
                "the depth buffer runs the other way than clip_from_view",
                "give the projection that the depth was rendered with; reversed where the depth is 1 near and 0 far",
                |clip| replace_row(clip, 2, clip.row(3) - clip.row(2)),
            ));
            all.push(self.with_clip(
                "clip_from_view maps depth to -1..1",
                "give a projection to depth 0..1, as Vulkan has it",
                |clip| replace_row(clip, 2, (clip.row(2) + clip.row(3)) * 0.5),
            ));
        }
        all
    }

    fn handedness(&self) -> [Self; 2] {
        let view_forward = match self.conventions.view_forward {
            ViewForward::NegativeZ => ViewForward::PositiveZ,
            ViewForward::PositiveZ => ViewForward::NegativeZ,
        };
        let up = self.with_clip(
            "y of clip_from_view points up",
            "negate the second row of clip_from_view: y of Vulkan's clip space points down",
            |clip| replace_row(clip, 1, -clip.row(1)),
        );
        let backwards = Self {
            mistake: "the camera looks the other way along z of view space",
            remedy: format!("view_forward: {view_forward:?}"),
            conventions: Conventions { view_forward, ..self.conventions },
            ..self.clone()
        };
        [backwards, up]
    }

    fn matrices(&self) -> [Self; 7] {
        let columns = "give matrices by columns: the translation of a view matrix is its last column";
        let (transposed, same) = (|m: Mat4| m.transpose(), |m: Mat4| m);
        [
            self.exchanged(true),
            self.exchanged(false),
            self.with("view_from_world is transposed", columns, transposed, |clip, _| clip),
            self.with_clip("clip_from_view is transposed", columns, transposed),
            self.with("both matrices are transposed", columns, transposed, |clip, _| clip.transpose()),
            self.with(
                "view_from_world is world from view",
                "give the inverse of the camera's transform",
                |view| view.inverse(),
                |clip, _| clip,
            ),
            self.with("clip_from_view is clip from world", "give the projection alone", same, |clip, view| clip * view.inverse()),
        ]
    }

    /// The matrices of both frames exchanged, with the jitter or without.
    fn exchanged(&self, with_jitter: bool) -> Self {
        let matrices = |of: &FrameParams, from: &FrameParams| FrameParams {
            view_from_world: from.view_from_world,
            clip_from_view: from.clip_from_view,
            jitter: if with_jitter { from.jitter } else { of.jitter },
            ..*of
        };
        Self {
            mistake: "the matrices of the previous and of the current frame are exchanged",
            remedy: "give each frame the matrices and the jitter that it was rendered with".to_owned(),
            previous: matrices(&self.previous, &self.current),
            current: matrices(&self.current, &self.previous),
            ..self.clone()
        }
    }

    fn jitters(&self) -> [Self; 4] {
        let with = |mistake, remedy: &str, change: fn(&mut FrameParams)| {
            let mut geometry = Self { mistake, remedy: remedy.to_owned(), ..self.clone() };
            change(&mut geometry.previous);
            change(&mut geometry.current);
            geometry
        };
        [
            with("the jitter has the opposite sign", "negate jitter: the sample of pixel p lies at p + 0.5 + jitter", |p| {
                p.jitter = p.jitter.map(|j| -j);
            }),
            with("y of the jitter points up", "negate jitter[1]: y of pixels points down", |p| p.jitter[1] = -p.jitter[1]),
            with("clip_from_view includes the jitter", "give clip_from_view without the jitter", |p| unjitter(p, 1.0)),
            with(
                "clip_from_view includes the jitter, and with the opposite sign",
                "give clip_from_view without the jitter, and negate jitter",
                |p| {
                    unjitter(p, -1.0);
                    p.jitter = p.jitter.map(|j| -j);
                },
            ),
        ]
    }

    fn with_clip(&self, mistake: &'static str, remedy: &str, clip: impl Fn(Mat4) -> Mat4) -> Self {
        self.with(mistake, remedy, |view| view, |m, _| clip(m))
    }

    /// A geometry with other matrices: `view` of the view, `clip` of the projection and the view as they are.
    fn with(&self, mistake: &'static str, remedy: &str, view: impl Fn(Mat4) -> Mat4, clip: impl Fn(Mat4, Mat4) -> Mat4) -> Self {
        let change = |params: &FrameParams| {
            let [v, c] = [params.view_from_world, params.clip_from_view].map(|m| Mat4::from_cols_array_2d(&m));
            FrameParams { view_from_world: view(v).to_cols_array_2d(), clip_from_view: clip(c, v).to_cols_array_2d(), ..*params }
        };
        let (previous, current) = (change(&self.previous), change(&self.current));
        Self { mistake, remedy: remedy.to_owned(), previous, current, ..self.clone() }
    }
}

/// Removes a jitter from the projection, which shows a point x of the image at x − jitter.
fn unjitter(params: &mut FrameParams, sign: f32) {
    let mut clip = Mat4::from_cols_array_2d(&params.clip_from_view);
    for i in 0..2 {
        let ndc = sign * 2.0 * params.jitter[i] / params.render_extent[i] as f32;
        clip = replace_row(clip, i, clip.row(i) + clip.row(3) * ndc);
    }
    params.clip_from_view = clip.to_cols_array_2d();
}

fn replace_row(m: Mat4, row: usize, by: Vec4) -> Mat4 {
    let mut rows = m.transpose().to_cols_array_2d();
    rows[row] = by.to_array();
    Mat4::from_cols_array_2d(&rows).transpose()
}
