//! Measures all graphs at one size: rounds in which they take turns, contents and yardsticks among them.

use super::clock::{Clock, EmptySubmission};
use super::content::Content;
use super::report::{Case, Floor, HostCost, Memory, Pass};
use super::runner::{Frames, Runner};
use super::statistics::Spread;
use super::{host_cost, inputs, isa, yardsticks};
use atrous::executor::{HeadlessDevice, InputSet};
use atrous::{Declaration, PassDecl, Shape, Tuning};
use std::error::Error;
use std::sync::Arc;

/// Frames before those that are timed.
const WARM_UP: u32 = 3;
/// Submissions without work in a round.
const EMPTY_SUBMISSIONS: u32 = 20;

/// A graph to measure.
pub struct Graph {
    pub label: String,
    pub declaration: Declaration,
    pub tuning: Tuning,
}

pub struct Measurement<'a> {
    pub gpu: &'a Arc<HeadlessDevice>,
    pub clock: Clock,
    pub contents: &'a [Content],
    pub size: [u32; 2],
    pub frames: u32,
    pub rounds: u32,
}

/// A graph that runs with one content.
struct Running<'g> {
    graph: &'g Graph,
    content: Content,
    runner: Runner,
    host: HostCost,
}

impl Measurement<'_> {
    pub fn run(&self, graphs: &[Graph]) -> Result<Vec<Case>, Box<dyn Error>> {
        let mut empty = EmptySubmission::new(self.gpu)?;
        let mut running = Vec::new();
        for &content in self.contents {
            running.extend(self.start(graphs, content, &mut empty)?);
        }
        let mut frames = self.no_frames();
        let mut yardstick = |declaration| self.runner(declaration, Tuning::default(), Content::Moving, &mut frames);
        let (mut copy, mut arithmetic) = (yardstick(yardsticks::copy(self.size)?)?, yardstick(yardsticks::arithmetic(self.size)?)?);
        let mut empty_ms = Vec::new();
        for _ in 0..self.rounds {
            for _ in 0..EMPTY_SUBMISSIONS {
                empty_ms.push(empty.milliseconds()?);
            }
            for runner in [&mut copy, &mut arithmetic].into_iter().chain(running.iter_mut().map(|r| &mut r.runner)) {
                runner.round(self.frames)?;
            }
        }
        let empty = if self.clock == Clock::ProcessCpuTime { Spread::of(&empty_ms) } else { Spread::default() };
        let time = |runner: &Runner, of: fn(Spread) -> f64| {
            runner.samples.iter().map(|s| of(Spread::of(s).less(empty.median))).fold(0.0, f64::max)
        };
        let bytes = |declaration: &Declaration| declaration.passes().iter().map(|p| bytes(declaration, p)).sum::<u64>() as f64;
        let copy_gb_per_s = Some(time(&copy, |t| t.median)).filter(|ms| *ms > 0.0).map(|ms| bytes(copy.declaration()) / ms * 1e-6);
        let floor = Floor {
            copy_gb_per_s,
            arithmetic_ms: time(&arithmetic, |t| t.median),
            least_arithmetic_ms: time(&arithmetic, |t| t.least),
            empty_submission_ms: empty,
        };
        Ok(running.into_iter().map(|running| self.case(running, &floor)).collect())
    }

    /// Opens every graph for a content, and runs it until its times count.
    fn start<'g>(
        &self,
        graphs: &'g [Graph],
        content: Content,
        empty: &mut EmptySubmission,
    ) -> Result<Vec<Running<'g>>, Box<dyn Error>> {
        let mut frames = self.no_frames();
        let mut running = Vec::new();
        for graph in graphs {
            let host = host_cost::start_up(self.gpu, &graph.declaration)?;
            let runner = self.runner(graph.declaration.clone(), graph.tuning, content, &mut frames)?;
            let recording_us = host_cost::recording(self.gpu, &graph.declaration, content, &frames, empty)?;
            running.push(Running { graph, content, runner, host: HostCost { recording_us, ..host } });
        }
        Ok(running)
    }

    fn no_frames(&self) -> Frames {
        std::array::from_fn(|_| InputSet::new(self.gpu.clone()))
    }

    fn runner(
        &self,
        declaration: Declaration,
        tuning: Tuning,
        content: Content,
        frames: &mut Frames,
    ) -> Result<Runner, Box<dyn Error>> {
        let mut runner = Runner::new(self.gpu, declaration, tuning, content, self.clock, frames)?;
        runner.warm_up(WARM_UP)?;
        Ok(runner)
    }

    fn case(&self, running: Running<'_>, floor: &Floor) -> Case {
        let Running { graph, content, runner, host } = running;
        let declaration = runner.declaration();
        let empty = floor.empty_submission_ms.median;
        let pass = |(i, (pass, samples)): (usize, (&PassDecl, &Vec<f64>))| Pass {
            name: pass.name.clone(),
            stage: pass.stage().unwrap_or(&pass.name).to_owned(),
            time: Spread::of(samples).less(empty),
            bytes: bytes(declaration, pass),
            cycles: isa::cycles(declaration, i),
        };
        let passes: Vec<Pass> = declaration.passes().iter().zip(&runner.samples).enumerate().map(pass).collect();
        let count = runner.samples.first().map_or(0, Vec::len);
        let sum = |i: usize| runner.samples.iter().map(|s| (s[i] - empty).max(0.0)).sum();
        let sums: Vec<f64> = (0..count).map(sum).collect();
        let (memory, allocated) = (declaration.memory(), runner.session().executor().allocated());
        Case {
            graph: graph.label.clone(),
            size: self.size,
            content: content.name().to_owned(),
            passes,
            frame: Spread::of(&sums),
            memory: Memory {
                history: memory.history,
                transient: memory.transient,
                allocated: allocated.history + allocated.transient,
            },
            host,
            floor: floor.clone(),
        }
    }
}

/// Texels of all images of a pass, each once: what a perfect cache would move.
pub fn bytes(declaration: &Declaration, pass: &PassDecl) -> u64 {
    let resources = pass.uses.iter().map(|u| declaration.resource(u.resource));
    let images = resources.filter(|r| matches!(r.shape, Shape::Image { .. }) && inputs::is_given(r));
    images.map(|r| r.bytes(declaration.setup())).sum()
}
