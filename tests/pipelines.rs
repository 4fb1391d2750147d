//! Creation of pipelines: through the cache of the host, on several threads, and without a trace where one fails.

use super::support::spy::{Spy, REFUSED};
use super::support::{assert_valid, gpu};
use ash::vk;
use atrous::config::Preset;
use atrous::{Config, Denoiser, Error};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("the_cache_is_the_hosts", the_cache_is_the_hosts),
    ("several_threads_create_them", several_threads_create_them),
    ("nothing_is_left_where_one_fails", nothing_is_left_where_one_fails),
];

fn denoiser(spy: &Spy, cache: vk::PipelineCache) -> Result<Denoiser, Error> {
    let config = Config { preset: Preset::Asvgf, ..Config::new([16, 9]) };
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
