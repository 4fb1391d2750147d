//! Jobs that are shared between threads.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Threads that the machine has cores for.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Runs `work` for every job, on as many threads at most. Results in the order of the jobs, whichever thread was first, and the
/// error of the first job that failed. Jobs behind that one may have been left out.
pub(crate) fn run<J: Sync, T: Send, E: Send>(
    jobs: &[J],
    threads: usize,
    work: impl Fn(&J) -> Result<T, E> + Sync,
) -> (Vec<T>, Option<E>) {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(jobs.len()));
    let take_jobs = || loop {
        let index = next.fetch_add(1, Ordering::Relaxed);
        let Some(job) = jobs.get(index) else { return };
        let result = work(job);
        if result.is_err() {
            // Every job before this one was taken already, so the first error does not depend on the threads.
            next.store(jobs.len(), Ordering::Relaxed);
        }
        done.lock().unwrap_or_else(PoisonError::into_inner).push((index, result));
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(jobs.len()) {
            // Without a further thread, this one does its share.
            let _ = std::thread::Builder::new().name("atrous".to_owned()).spawn_scoped(scope, take_jobs);
        }
        take_jobs();
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|(index, _)| *index);
    let (mut results, mut first_error) = (Vec::with_capacity(done.len()), None);
    for (_, result) in done {
        match result {
            Ok(result) => results.push(result),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    (results, first_error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::sync::Barrier;

    #[test]
    fn results_stand_in_the_order_of_the_jobs() {
        let jobs: Vec<u64> = (0..50).collect();
        for threads in [0, 1, 2, 7, 100] {
            // Early jobs take longest.
            let square = |job: &u64| {
                std::thread::sleep(std::time::Duration::from_micros(50 - job));
                Ok::<_, ()>(job * job)
            };
            let (results, error) = run(&jobs, threads, square);
            assert_eq!((results, error), (jobs.iter().map(|job| job * job).collect(), None), "{threads} threads");
        }
    }

    #[test]
    fn as_many_threads_work_as_were_asked_for() {
        for threads in [1, 2, 5] {
            // Nobody leaves a job before all threads have one.
            let barrier = Barrier::new(threads);
            let work = |_: &u32| {
                barrier.wait();
                Ok::<_, ()>(format!("{:?}", std::thread::current().id()))
            };
            let (ids, _) = run(&vec![0; threads], threads, work);
            assert_eq!(ids.into_iter().collect::<BTreeSet<_>>().len(), threads);
        }
    }

    #[test]
    fn the_first_job_that_fails_is_reported_and_what_was_made_is_handed_back() {
        let jobs: Vec<u32> = (0..64).collect();
        // The later failure comes sooner.
        let work = |&job: &u32| match job {
            5 => {
                std::thread::sleep(std::time::Duration::from_millis(20));
                Err(job)
            }
            6 => Err(job),
            _ => Ok(job),
        };
        for threads in [1, 2, 4] {
            let (made, error) = run(&jobs, threads, work);
            assert_eq!(error, Some(5), "{threads} threads");
            assert_eq!(made[..5], [0, 1, 2, 3, 4], "{threads} threads");
            assert!(made.len() < jobs.len() - 2, "{threads} threads went on after the failure");
        }
    }
}
