//! Creation of pipelines: through the cache of the host, on several threads, and without a trace where one fails.

use super::support::examples::{compile, MEAN_3X3};
use super::support::spy::{Spy, REFUSED};
use super::support::{assert_valid, gpu};
use ash::vk;
use atrous::config::Preset;
use atrous::graph::{Graph, Irradiance, Stage};
use atrous::nodes::{Import, Modulate};
use atrous::{Config, Denoiser, Device, Error, SharedPipelines};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("the_cache_is_the_hosts", the_cache_is_the_hosts),
    ("several_threads_create_them", several_threads_create_them),
    ("nothing_is_left_where_one_fails", nothing_is_left_where_one_fails),
    ("denoisers_share_what_they_have_in_common", denoisers_share_what_they_have_in_common),
    ("a_stage_of_the_same_name_has_its_own_code", a_stage_of_the_same_name_has_its_own_code),
    ("several_threads_share_them", several_threads_share_them),
];

fn denoiser(spy: &Spy, cache: vk::PipelineCache) -> Result<Denoiser, Error> {
    let config = Config { preset: Preset::Asvgf, ..Config::new([19, 17]) };
    // SAFETY: the handles are live and outlive the denoiser; the cache is null or one of the device.
    unsafe { Denoiser::new(spy.host(cache), config.declare().expect("valid")) }
}

/// Every pipeline is made with the cache, which lives on; the denoiser needs it no more.
fn the_cache_is_the_hosts() {
    let (spy, gpu) = (Spy::new(), gpu());
    // SAFETY: the device is live, and the cache is destroyed below.
    let cache = unsafe { gpu.device().create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) }.expect("a cache");
    drop(denoiser(&spy, cache).expect("a denoiser"));
    let count = spy.created()["pipeline"] as usize;
    assert!(count > 5, "{count}");
    assert_eq!(spy.caches(), vec![cache; count]);
    // SAFETY: the cache is live: validation would say so if it were not.
    unsafe { gpu.device().get_pipeline_cache_data(cache) }.expect("data");
    let another = denoiser(&spy, cache).expect("another denoiser");
    // SAFETY: the cache is ours, and nothing is being created.
    unsafe { gpu.device().destroy_pipeline_cache(cache, None) };
    drop(another);
    drop(denoiser(&spy, vk::PipelineCache::null()).expect("a denoiser without a cache"));
    assert_eq!(spy.caches()[2 * count..], vec![vk::PipelineCache::null(); count]);
    assert_valid();
}

fn several_threads_create_them() {
    let spy = Spy::new();
    let cores = std::thread::available_parallelism().map_or(1, usize::from).min(4);
    // The first ones wait for each other, so that no thread is done before another has begun.
    spy.make_together(cores);
    drop(denoiser(&spy, vk::PipelineCache::null()).expect("a denoiser"));
    assert!(spy.threads() >= cores, "{} threads on {cores} cores", spy.threads());
    assert_eq!(spy.live().into_iter().collect::<Vec<_>>(), []);
    assert_valid();
}

/// A denoiser of a preset that shares pipelines.
fn sharing(spy: &Spy, pipelines: &SharedPipelines, preset: Preset) -> Result<Denoiser, Error> {
    let config = Config { preset, ..Config::new([19, 17]) };
    let host = Device { pipelines: Some(pipelines), ..spy.host(vk::PipelineCache::null()) };
    // SAFETY: the handles are live and outlive the denoiser and the pipelines.
    unsafe { Denoiser::new(host, config.declare().expect("valid")) }
}

/// Each pipeline is made once, lives as long as one of its owners, and none is kept of a denoiser that could not be made.
fn denoisers_share_what_they_have_in_common() {
    let spy = Spy::new();
    let made = || spy.created().get("pipeline").copied().unwrap_or(0);
    let live = || spy.live().get("pipeline").copied().unwrap_or(0);
    let shared = SharedPipelines::default();
    let first = sharing(&spy, &shared, Preset::Svgf).expect("a denoiser");
    let of_svgf = made();
    assert!(of_svgf > 3, "{of_svgf}");
    let second = sharing(&spy, &shared, Preset::Svgf).expect("a second one");
    assert_eq!(made(), of_svgf);
    drop(second);
    assert_eq!(live(), of_svgf);
    spy.refuse("pipeline", 1);
    assert!(sharing(&spy, &shared, Preset::Asvgf).is_err() && spy.has_refused());
    assert_eq!(live(), of_svgf, "of a denoiser that could not be made");
    let before = made();
    let other = sharing(&spy, &shared, Preset::Asvgf).expect("of another preset");
    let added = made() - before;
    drop((first, other));
    assert_eq!(live(), of_svgf + added, "the store keeps them");
    let alone = SharedPipelines::default();
    drop(sharing(&spy, &alone, Preset::Asvgf).expect("without another"));
    drop(alone);
    let of_asvgf = made() - before - added;
    assert!(added < of_asvgf, "{added} of {of_asvgf} are made beside svgf");
    let kept = sharing(&spy, &shared, Preset::Svgf).expect("once more");
    shared.clear();
    assert_eq!(live(), of_svgf, "those of a denoiser that lives");
    drop((shared, kept));
    assert_eq!(spy.live().into_iter().collect::<Vec<_>>(), []);
    assert_valid();
}

/// A graph with a stage that is named alike for each factor.
fn scaled(spy: &Spy, pipelines: &SharedPipelines, factor: &str) -> Denoiser {
    let source = MEAN_3X3.replace("sum.rgb / sum.a", &format!("{factor} * sum.rgb / sum.a"));
    let stage = Stage::new("mean_3x3", &compile(&source)).expect("a stage");
    let mut g = Graph::new([19, 17]);
    let guides = g.import(Import::default());
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Default::default());
    let filtered = g.stage(&stage).bind("estimate", irradiance.image()).add();
    let denoised = g.modulate(&guides, &Irradiance::of(filtered.written("filtered")), Modulate::default());
    g.output("denoised_radiance", &denoised);
    let host = Device { pipelines: Some(pipelines), ..spy.host(vk::PipelineCache::null()) };
    // SAFETY: the handles are live and outlive the denoiser and the pipelines.
    unsafe { Denoiser::new(host, g.finish().expect("a graph")) }.expect("a denoiser")
}

fn a_stage_of_the_same_name_has_its_own_code() {
    let (spy, shared) = (Spy::new(), SharedPipelines::default());
    let _alone = scaled(&spy, &shared, "1.0");
    let before = spy.created()["pipeline"];
    let _same = scaled(&spy, &shared, "1.0");
    assert_eq!(spy.created()["pipeline"], before);
    let _other = scaled(&spy, &shared, "2.0");
    assert_eq!(spy.created()["pipeline"], before + 1);
    assert_valid();
}

/// One that two threads made at once is there once.
fn several_threads_share_them() {
    let spy = Spy::new();
    let presets = [Preset::Svgf, Preset::Fast, Preset::Svgf, Preset::Svgf];
    let one_by_one = SharedPipelines::default();
    drop(presets.map(|preset| sharing(&spy, &one_by_one, preset).expect("a denoiser")));
    let different = spy.live()["pipeline"];
    drop(one_by_one);
    let shared = SharedPipelines::default();
    let made = std::thread::scope(|scope| {
        let of = |preset| {
            let (spy, shared) = (&spy, &shared);
            scope.spawn(move || sharing(spy, shared, preset))
        };
        presets.map(of).map(|thread| thread.join().expect("no panic").expect("a denoiser"))
    });
    assert_eq!(spy.live()["pipeline"], different);
    drop((made, shared));
    assert_eq!(spy.live().into_iter().collect::<Vec<_>>(), []);
    assert_valid();
}

fn nothing_is_left_where_one_fails() {
    let spy = Spy::new();
    drop(denoiser(&spy, vk::PipelineCache::null()).expect("a denoiser"));
    let calls = [
        ("set layout", "vkCreateDescriptorSetLayout"),
        ("pipeline layout", "vkCreatePipelineLayout"),
        ("shader module", "vkCreateShaderModule"),
        ("pipeline", "vkCreateComputePipelines"),
        ("descriptor pool", "vkCreateDescriptorPool"),
    ];
    for ((kind, call), count) in calls.map(|call| (call, spy.created()[call.0])) {
        for after in [0, count / 2, count - 1] {
            spy.refuse(kind, after);
            let error = denoiser(&spy, vk::PipelineCache::null()).err();
            assert_eq!(error, Some(Error::Vulkan { call, result: REFUSED }), "{kind} {after}");
            assert!(spy.live().is_empty(), "{kind} {after}: {:?}", spy.live());
        }
    }
    assert_valid();
}
